/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_PATH_H
#define MOR_CORE_SPH_MEASURE_MEASURE_PATH_H

#include "core/base/context.h"

/** @file
 *  Places along a polyline on a map, as along the thalweg of a valley: a point belongs to the nearest place of the line
 *  seen from above, and distances count level, as on a map. Before its first and beyond its last corner the line goes
 *  straight on. */

/** A line on a map. Made by mor_measure_path_new. Owner: the caller. */
typedef struct mor_measure_path {
    int n_points;     /* corners, >= 2 */
    double up[3];     /* shape [3]; unit vector, 1 */
    double *points;   /* shape [n_points, 3]; corners without their heights, m */
    double *tangents; /* shape [n_points - 1, 3]; unit vectors of the legs, 1 */
    double *along;    /* shape [n_points]; distance of the corners from the first one, m */
} mor_measure_path;

/** Where a point lies beside a line. */
typedef struct mor_measure_station {
    double along;      /* distance along the line from its first corner, m; negative before it */
    double beside;     /* distance from the line, m; positive to its left, seen from above */
    double tangent[3]; /* shape [3]; unit vector of the leg, 1 */
} mor_measure_station;

/** Makes a line.
 *  @param points   [in]   shape [n_points, 3]; corners, unit m
 *  @param n_points [in]   >= 2
 *  @param up       [in]   shape [3]; unit vector, 1
 *  @param path     [out]  cleared by the caller, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for too few corners, or two in a row above one another; MOR_ERROR_MEMORY. */
mor_status mor_measure_path_new(mor_context *context, const double *points, int n_points, const double *up,
                                mor_measure_path *path);

/** Frees what a line owns; accepts a zeroed one. */
void mor_measure_path_clear(mor_context *context, mor_measure_path *path);

/** Length of a line, unit m. */
double mor_measure_path_length(const mor_measure_path *path);

/** Finds where a point lies.
 *  @param position [in]   shape [3]; unit m
 *  @param station  [out]  the nearest place of the line; of several the first
 *  Cost: O(corners). Threads: safe to call concurrently. */
void mor_measure_path_locate(const mor_measure_path *path, const double *position, mor_measure_station *station);

#endif
