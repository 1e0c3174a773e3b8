/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_TRACK_H
#define MOR_CASES_DRIVER_MAP_MAP_TRACK_H

#include "cases/driver/map/map_spread.h"
#include "core/particle/state.h"

/** @file
 *  Follows what the maps of a run tell: largest values, first times, durations of each cell, and the ways of the rocks.
 *  What is remembered is state, which a checkpoint saves; the sums over particles are found anew. */

struct mor_simulation;

/** What is remembered of each cell. */
typedef enum mor_map_kept {
    MOR_MAP_KEPT_INITIAL,    /* depth at the start, m */
    MOR_MAP_KEPT_DEPTH,      /* largest depth, m; 0: no soil was there */
    MOR_MAP_KEPT_SPEED,      /* largest speed, m/s; of this and the next two NaN: the threshold was never reached */
    MOR_MAP_KEPT_PRESSURE,   /* largest density times squared speed, Pa */
    MOR_MAP_KEPT_FLOW,       /* largest depth times speed, m2/s */
    MOR_MAP_KEPT_ARRIVAL,    /* time the threshold was reached first, s; NaN: never */
    MOR_MAP_KEPT_DURATION,   /* time with at least duration_depth, s */
    MOR_MAP_KEPT_PASSAGES,   /* times that the center of a rock entered, 1 */
    MOR_MAP_KEPT_ROCK_SPEED, /* largest speed of the center of a rock, m/s; NaN: none was there */
    MOR_MAP_KEPT_COUNT
} mor_map_kept;

/** What the maps of a simulation remember. Owner: the simulation. */
typedef struct mor_map_track {
    struct mor_simulation *simulation; /* borrowed; owns this */
    mor_map_grid grid;
    int interval;                     /* steps from one measurement to the next, >= 1 */
    mor_map_sums soil;                /* of the last measurement */
    double *kept[MOR_MAP_KEPT_COUNT]; /* shape [cells] each; NULL: of soil or rocks that the case does not have */
    double *rock_places;              /* shape [n_bodies, 2]; of the centers at the last measurement, m */
    double last;                      /* time of the last measurement, s */
    double frame[4];                  /* origin and cell of the grid as a state has them, m */
} mor_map_track;

/** Prepares to follow a simulation that is built but for this: fills in simulation->maps; nothing where the case wants
 *  no maps.
 *  @param simulation [in,out]  becomes the owner
 *  Returns: MOR_OK; as mor_map_grid_init; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_map_track_new(mor_context *context, struct mor_simulation *simulation);

/** Frees a track and sets the pointer to NULL; NULL is accepted.
 *  @param track   [in,out]  the address of one pointer */
void mor_map_track_free(mor_context *context, mor_map_track **track);

/** Lists what is remembered.
 *  @param track   [in,out]  NULL: nothing is
 *  @param list    [in,out]  borrows from the track
 *  Returns: as mor_state_add. */
mor_status mor_map_track_list_state(mor_context *context, mor_map_track *track, mor_state_list *list);

/** Says whether a state that was put back belongs to this grid.
 *  @param track [in]  NULL: nothing is done
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line where its cells lie elsewhere. */
mor_status mor_map_track_resume(mor_context *context, const mor_map_track *track);

/** Forgets everything and measures the state at time zero. To be called once before the first step, not after a resume.
 *  @param track [in,out]  NULL: nothing is done */
void mor_map_track_start(mor_context *context, mor_map_track *track);

/** Measures after a step, where one is due: after whole intervals, and at the end.
 *  @param track [in,out]  NULL: nothing is done
 *  Cost: allocates nothing. */
void mor_map_follow(mor_context *context, mor_map_track *track);

/** Finds the sums over the soil as it is now.
 *  @param track [in,out]  of a simulation with soil */
void mor_map_measure(mor_context *context, mor_map_track *track);

/** Finds the sums over the rocks as they are now.
 *  @param sums    [in,out]  zero, made for the grid of the track */
void mor_map_measure_rocks(mor_context *context, const mor_map_track *track, mor_map_sums *sums);

#endif
