/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_WRITE_H
#define MOR_CASES_DRIVER_MAP_MAP_WRITE_H

#include "cases/driver/map/map_list.h"

#include <stdio.h>

/** @file
 *  The maps of a run as files: one GeoTIFF for each, and a style beside it that QGIS takes by itself. */

enum { MOR_MAP_RESULTS_MAX = 48, MOR_MAP_RESULT_NAME_BYTES = 64 };

/** One number of a map, for the summary: "map.deposit.volume". */
typedef struct mor_map_result {
    char name[MOR_MAP_RESULT_NAME_BYTES];
    double value;     /* in unit; NaN: there is no data */
    const char *unit; /* static */
} mor_map_result;

/** Numbers of all maps. */
typedef struct mor_map_results {
    mor_map_result of[MOR_MAP_RESULTS_MAX]; /* shape [n] */
    int n;
} mor_map_results;

/** Writes the maps of the present state into maps/ of a folder.
 *  @param track   [in,out]  NULL: nothing is written
 *  @param folder  [in]      zero-terminated; of the run
 *  @param results [out]     of each map the largest value, the area and, where it means something, the volume
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_map_write(mor_context *context, mor_map_track *track, const char *folder, mor_map_results *results);

/** Removes the maps that an earlier end of the same run left in a folder, with their styles and pictures: of a run that
 *  goes on they are no longer true.
 *  @param track   [in]      NULL: nothing is removed
 *  @param folder  [in]      zero-terminated; of the run
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_map_remove(mor_context *context, const mor_map_track *track, const char *folder);

/** Prints a table of the numbers of all maps; nothing where there are none.
 *  @param track   [in]      NULL: there are none
 *  @param out     [in,out]  one open stream */
void mor_map_print(const mor_map_track *track, const mor_map_results *results, FILE *out);

#endif
