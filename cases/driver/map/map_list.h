/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_LIST_H
#define MOR_CASES_DRIVER_MAP_MAP_LIST_H

#include "cases/driver/map/map_track.h"

/** @file
 *  The list of maps: what each is called, its unit, what a cell holds and where it holds nothing. Files, styles,
 *  pictures and the summary walk this list. */

/** Folder of the maps in that of a run. */
#define MOR_MAP_FOLDER "maps"

/** What a map needs to be made. */
enum { MOR_MAP_NEEDS_SOIL = 1, MOR_MAP_NEEDS_ROCKS = 2, MOR_MAP_NEEDS_GROUND = 4 };

/** The depth that decides whether soil counts. */
typedef enum mor_map_depth { MOR_MAP_DEPTH_NONE, MOR_MAP_DEPTH_THRESHOLD, MOR_MAP_DEPTH_DURATION } mor_map_depth;

/** What maps are found from. */
typedef struct mor_map_source {
    const mor_map_track *track; /* with sums of the soil as it is at the end */
    mor_map_sums rocks;         /* likewise of the rocks; zeroed: there are none */
} mor_map_source;

/** One map. */
typedef struct mor_map_kind {
    const char *name;  /* of its file */
    const char *title; /* for legends */
    const char *unit;
    const char *text; /* a sentence */
    unsigned needs;   /* one MOR_MAP_NEEDS_ bit */
    /** Value of a cell, in that unit; NaN: no data. */
    double (*value)(const mor_map_source *source, int64_t cell);
    mor_map_depth depth;
    bool is_depth;      /* its area counts from the threshold on; else wherever there is data */
    bool has_volume;    /* a volume is told: of depths times area, of volumes alone */
    bool is_early_dark; /* small values have the dark colors; else large ones */
    bool is_drawn;      /* has a picture */
} mor_map_kind;

/** The list; ends with name NULL. */
extern const mor_map_kind mor_map_kinds[];

/** Whether a run has a map.
 *  @param kind [in]  of the list */
bool mor_map_is_made(const mor_map_track *track, const mor_map_kind *kind);

#endif
