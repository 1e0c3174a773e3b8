/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_SHAPE_H
#define MOR_CORE_GEOMETRY_SHAPE_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  The signed-distance contract that soil regions, walls and meshes share, and the analytic shapes. Distances are
 *  negative inside. A shape is a small tree owned by its root. */

typedef struct mor_shape mor_shape;

/** Bound of the gradient of a distance (Lipschitz constant), 1: exact distances have 1, those interpolated on a grid up
 *  to a tenth more over two of its cells and more (over less, up to 1.4 at a kink). Searches that skip distant parts
 *  rely on it. */
#define MOR_SHAPE_SLOPE_MOST 1.1

/** Axis-aligned bounds; a component is -INFINITY or INFINITY where the shape is unbounded. */
typedef struct mor_bounds {
    double minimum[3]; /* shape [3], unit m */
    double maximum[3]; /* shape [3], unit m */
} mor_bounds;

/** Volume, center and inertia of the inside of a shape. Per meter of thickness in plane strain. */
typedef struct mor_shape_moments {
    double volume;     /* m3 (m2) */
    double center[3];  /* m */
    double inertia[6]; /* about the center, per unit of density: integral of (r2 I - r r), symmetric tensor, m5 (m4) */
} mor_shape_moments;

/** Operations of a shape. One constant table per kind. */
typedef struct mor_shape_operations {
    const char *kind; /* word used in messages */
    /** Signed distance [m] from point, shape [3], unit m: negative inside. Exact near the surface; for differences and
     *  unions a lower bound of the magnitude elsewhere. Safe to call concurrently. */
    double (*distance)(const mor_shape *shape, const double *point);
    /** Writes the bounds of the inside. */
    void (*bounds)(const mor_shape *shape, mor_bounds *bounds);
    /** Frees what the shape owns, children included, and the shape itself. */
    void (*free)(mor_context *context, mor_shape *shape);
    /** Writes the exact moments of the inside, of plane strain when dimension is 2. Returns false if the shape does not
     *  provide them; they must then be integrated. NULL: never provided. Safe to call concurrently. */
    bool (*moments)(const mor_shape *shape, int dimension, mor_shape_moments *moments);
    /** Signed distance [m] of a point, shape [3], unit m, as `distance`, but from the surface itself where that only
     *  approximates it; may be slow. NULL: `distance` is exact enough. Safe to call concurrently. */
    double (*exact_distance)(const mor_shape *shape, const double *point);
    /** Whether distances inside may be those to faces that parts share, not to the whole surface. NULL: never. */
    bool (*has_seams)(const mor_shape *shape);
} mor_shape_operations;

/** Base of every shape; a concrete shape has it as first member. */
struct mor_shape {
    const mor_shape_operations *operations; /* never NULL */
};

#endif
