/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_SHAPE_CHECK_H
#define MOR_CORE_GEOMETRY_SHAPE_CHECK_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  Checks of numbers that describe places and directions, shared by the shape constructors and the lattice. */

/** Refuses a vector with a component that is not finite.
 *  @param vector  [in]      shape [3]; any unit
 *  @param what    [in]      zero-terminated; names the vector in the message
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_shape_check_vector(mor_context *context, const double *vector, const char *what);

/** Refuses a length that is not finite and above zero.
 *  @param length  [in]      unit m
 *  @param what    [in]      zero-terminated; names the length in the message
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_shape_check_length(mor_context *context, double length, const char *what);

/** Brings a direction to length 1. Components below rounding become zero, so that near-axis directions are exact.
 *  @param direction [in]      shape [3]; unit 1; any length but zero
 *  @param what      [in]      zero-terminated; names the direction in the message
 *  @param unit      [out]     shape [3]; unit 1; may be direction itself
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a zero or non-finite direction. */
mor_status mor_shape_check_direction(mor_context *context, const double *direction, const char *what, double *unit);

/** Refuses a matrix that is not a rotation: rows orthonormal to 1e-9, determinant 1.
 *  @param rotation [in]      shape [3,3]; unit 1
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_shape_check_rotation(mor_context *context, const double *rotation);

/** Finds two edges of a closed line that cross or touch, other than neighbors at their common corner.
 *  @param points   [in]   shape [n_points,2]; unit m; edge i joins points i and i + 1, the last one n_points - 1 and 0
 *  @param n_points [in]   >= 3
 *  @param first    [out]  one number; the lower edge; untouched when there are none
 *  @param second   [out]  one number; the other edge
 *  Returns: whether there are such edges.
 *  Cost: O(n_points^2). Threads: safe to call concurrently. */
bool mor_shape_find_crossing(const double *points, int n_points, int *first, int *second);

#endif
