/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_SHAPE_MOMENTS_H
#define MOR_CORE_GEOMETRY_SHAPE_MOMENTS_H

#include "core/geometry/shape.h"

/** @file
 *  Volume, center and inertia of any bounded shape: provided by the shape, or else integrated from its distances. */

/** Finds the moments of a shape in its own frame.
 *  Theory: docs/theory/rigid.md, Mass properties.
 *  @param shape     [in]      bounded (in x, y for plane strain)
 *  @param dimension [in]      2 or 3
 *  @param moments   [out]     zero after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for an empty or unbounded shape; MOR_ERROR_MEMORY. Accuracy: 1e-5 relative or
 *  better; exact for axis-aligned boxes and shapes that provide their moments. Cost: adaptive cells, milliseconds. */
mor_status mor_shape_find_moments(mor_context *context, const mor_shape *shape, int dimension,
                                  mor_shape_moments *moments);

/** Finds area, center and inertia of the inside of a simple closed line, exact; volume per meter of thickness.
 *  @param points   [in]   shape [n_points,2]; unit m; corners in either orientation, around an area
 *  @param n_points [in]   >= 3
 *  Cost: O(n_points). Threads: safe to call concurrently. */
void mor_shape_find_polygon_moments(const double *points, int n_points, mor_shape_moments *moments);

/** Places moments: X = rotation * x + translation.
 *  @param rotation    [in]      shape [3,3], rotation matrix, unit 1
 *  @param translation [in]      shape [3], unit m */
void mor_shape_moments_place(mor_shape_moments *moments, const double *rotation, const double *translation);

#endif
