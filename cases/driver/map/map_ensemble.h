/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_ENSEMBLE_H
#define MOR_CASES_DRIVER_MAP_MAP_ENSEMBLE_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  Maps of several runs taken together: the share of the runs whose map reaches a value in a cell, with the interval
 *  that this many runs allow. Knows the files of the runs alone. */

/** What is asked. Strings are zero-terminated and borrowed. */
typedef struct mor_map_ensemble {
    const char *const *folders; /* shape [n]; of the runs; those with the map have one grid */
    int n;                      /* >= 1 */
    const char *map;            /* name of a map */
    double value;               /* a cell counts from it on, or, of an arrival, up to it; unit of the map, [1] */
} mor_map_ensemble;

/** Finds the interval of a share by Wilson's score with 95 % confidence.
 *  @param k    [in]   that have the property, 0 <= k <= n
 *  @param n    [in]   of all, >= 1
 *  @param low  [out]  one number, 1
 *  @param high [out]  one number, 1
 *  Theory: Wilson (1927). */
void mor_map_ensemble_interval(int k, int n, double *low, double *high);

/** Returns the SI unit of a map, a static string; NULL when there is no map of that name.
 *  @param map [in]  zero-terminated */
const char *mor_map_ensemble_unit(const char *map);

/** Lists the names of the maps, as "deposit, erosion, ...".
 *  @param text    [out]  shape [n_bytes]; zero-terminated
 *  @param n_bytes [in]   room in text */
void mor_map_ensemble_names(char *text, size_t n_bytes);

/** Writes maps/exceed-<map>.tif, the share in percent, and -low and -high, the ends of its interval, with styles, and
 *  the picture images/map-exceed-<map>.png.
 *  @param folder [in]      zero-terminated; made when missing
 *  @param output [in,out]  one open stream; receives the paths, and the runs without the map, which are left out
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when no run has the map, or one has it on another grid, in another
 *  reference system, or of another end, spacing or depths, or does not tell these; MOR_ERROR_IO;
 *  MOR_ERROR_MEMORY. */
mor_status mor_map_ensemble_write(mor_context *context, const mor_map_ensemble *ensemble, const char *folder,
                                  FILE *output);

#endif
