/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_SHAPE_ANALYTIC_H
#define MOR_CORE_GEOMETRY_SHAPE_ANALYTIC_H

#include "core/geometry/shape.h"

/** @file
 *  The analytic shapes behind core/geometry/shape.h, and the functions of every shape. Distances of box, cylinder,
 *  cone, sphere, ellipsoid, half-space and polygon are exact everywhere. Meshes are made elsewhere; they implement the
 *  same table.
 *
 *  Ownership: a constructor that takes children owns them after MOR_OK and has set the caller's pointers NULL; after
 *  a failure the children and the pointers are untouched and still the caller's. The output pointer is NULL after a
 *  failure. A shape is freed with its whole tree by mor_shape_free.
 *  Threads: constructors and mor_shape_free: neither; the calls on a finished shape: safe to call concurrently. */

/** Makes a box with faces normal to the axes.
 *  @param minimum [in]      shape [3]; unit m; lowest corner; a component may be -INFINITY
 *  @param maximum [in]      shape [3]; unit m; highest corner; a component may be INFINITY
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when a component of minimum is not below that of maximum, or no face is at a
 *  finite place; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_box(mor_context *context, const double *minimum, const double *maximum, mor_shape **shape);

/** Makes a solid cylinder with flat ends: from base to base + height * axis / |axis|.
 *  @param base    [in]      shape [3]; unit m; center of the first end
 *  @param axis    [in]      shape [3]; unit 1; any length but zero
 *  @param radius  [in]      unit m; > 0
 *  @param height  [in]      unit m; > 0
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_cylinder(mor_context *context, const double *base, const double *axis, double radius,
                                  double height, mor_shape **shape);

/** Makes a solid cone with a flat base: from the base to the apex at base + height * axis / |axis|.
 *  @param base    [in]      shape [3]; unit m; center of the base
 *  @param axis    [in]      shape [3]; unit 1; from the base to the apex; any length but zero
 *  @param radius  [in]      unit m; of the base; > 0
 *  @param height  [in]      unit m; > 0
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_cone(mor_context *context, const double *base, const double *axis, double radius,
                              double height, mor_shape **shape);

/** Makes a ball.
 *  @param center  [in]      shape [3]; unit m
 *  @param radius  [in]      unit m; > 0
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_sphere(mor_context *context, const double *center, double radius, mor_shape **shape);

/** Makes an ellipsoid with its axes along x, y and z. In plane strain give a radius along z that is not the least.
 *  @param center  [in]      shape [3]; unit m
 *  @param radii   [in]      shape [3]; half of its extent along x, y, z, unit m; > 0
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_ellipsoid(mor_context *context, const double *center, const double *radii, mor_shape **shape);

/** Makes a half-space: everything on the side of the plane opposite to the normal is solid.
 *  @param point   [in]      shape [3]; unit m; any point of the plane
 *  @param normal  [in]      shape [3]; unit 1; points out of the solid; any length but zero
 *  @param shape   [out]     one pointer; owned by the caller
 *  Gives: infinite bounds, except on the free side of a normal along an axis.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_half_space(mor_context *context, const double *point, const double *normal, mor_shape **shape);

/** Makes the inside of a simple polygon in the x-y plane, unbounded in z. It provides its moments in the plane.
 *  @param points   [in]      shape [n_points,2]; unit m; corners in either orientation, first not repeated; copied
 *  @param n_points [in]      >= 3
 *  @param shape    [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for too few points, points that coincide, edges that cross or touch, or no
 *  area; MOR_ERROR_MEMORY.
 *  Cost: O(n_points^2) here, O(n_points) per distance; allocates. */
mor_status mor_shape_new_polygon(mor_context *context, const double *points, int n_points, mor_shape **shape);

/** Makes the union of shapes. Outside, the distance is exact when those of the parts are; inside, it is a lower bound
 *  of the depth, and zero where two parts only touch: let parts overlap.
 *  @param parts   [in,out]  shape [n_parts]; taken: entries become NULL
 *  @param n_parts [in]      >= 1
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for no parts, a NULL part or one given twice; MOR_ERROR_MEMORY.
 *  Cost: O(n_parts^2), allocates. */
mor_status mor_shape_new_union(mor_context *context, mor_shape **parts, int n_parts, mor_shape **shape);

/** Makes `from` without `minus`. Inside, the distance is exact when those of the two are; outside, it is a lower bound.
 *  @param from    [in,out]  one pointer; taken: becomes NULL
 *  @param minus   [in,out]  one pointer; taken: becomes NULL
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when a shape is NULL or both are the same; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_difference(mor_context *context, mor_shape **from, mor_shape **minus, mor_shape **shape);

/** Makes the child translated: x -> x + translation.
 *  @param translation [in]      shape [3]; unit m
 *  @param child       [in,out]  one pointer; taken: becomes NULL
 *  @param shape       [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_translate(mor_context *context, const double *translation, mor_shape **child,
                                   mor_shape **shape);

/** Makes the child rotated about a line, right-handed. Rotations by quarter circles about a coordinate axis are exact.
 *  @param axis    [in]      shape [3]; unit 1; direction of the line; any length but zero
 *  @param angle   [in]      unit rad
 *  @param center  [in]      shape [3]; unit m; a point of the line
 *  @param child   [in,out]  one pointer; taken: becomes NULL
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_rotate(mor_context *context, const double *axis, double angle, const double *center,
                                mor_shape **child, mor_shape **shape);

/** Makes the child placed: x -> rotation * x + translation.
 *  @param rotation    [in]      shape [3,3]; unit 1; rotation matrix (orthonormal to 1e-9, determinant 1)
 *  @param translation [in]      shape [3]; unit m
 *  @param child       [in,out]  one pointer; taken: becomes NULL
 *  @param shape       [out]     one pointer; owned by the caller
 *  Gives: bounds that hold the shape; exact for a box child, wider for others when the rotation is oblique.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_placed(mor_context *context, const double *rotation, const double *translation,
                                mor_shape **child, mor_shape **shape);

/** Makes the child scaled about the origin: x -> factor * x.
 *  @param factor  [in]      unit 1; > 0
 *  @param child   [in,out]  one pointer; taken: becomes NULL
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_scaled(mor_context *context, double factor, mor_shape **child, mor_shape **shape);

/** Makes a shape that is another one, without owning it: many bodies may share one form.
 *  @param other   [in]      borrowed for the life of the view
 *  @param shape   [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY.
 *  Cost: O(1), allocates. */
mor_status mor_shape_new_view(mor_context *context, const mor_shape *other, mor_shape **shape);

/** Writes the exact moments of the inside if the shape provides them.
 *  @param dimension [in]   2 or 3
 *  @param moments   [out]  undefined if it does not
 *  Returns: whether it does. Threads: safe to call concurrently. */
bool mor_shape_moments_known(const mor_shape *shape, int dimension, mor_shape_moments *moments);

/** Returns the signed distance of a point, unit m, negative inside.
 *  @param point [in]  shape [3]; unit m
 *  Cost: that of the shape. Threads: safe to call concurrently. */
double mor_shape_distance(const mor_shape *shape, const double *point);

/** Returns the signed distance of a point as mor_shape_distance, from the surface itself where that one interpolates.
 *  For use during set-up, such as nodes on a surface.
 *  @param point [in]  shape [3]; unit m
 *  Returns: unit m, negative inside. Cost: of a mesh, a search and some rays. Threads: safe to call concurrently. */
double mor_shape_exact_distance(const mor_shape *shape, const double *point);

/** Whether the distance of a point inside may be that to a face which parts of the shape share, as in a union, and not
 *  to the surface of the whole. Outside distances never are.
 *  Threads: safe to call concurrently. */
bool mor_shape_has_seams(const mor_shape *shape);

/** How the distance of a point, shape [3], unit m, is evaluated: mor_shape_distance or mor_shape_exact_distance.
 *  @param point [in]  shape [3]; unit m
 *  Returns: unit m, negative inside. */
typedef double (*mor_shape_measure)(const mor_shape *shape, const double *point);

/** Writes axis-aligned bounds that hold the inside of the shape.
 *  @param bounds [out]  unit m; infinite where the shape is unbounded
 *  Threads: safe to call concurrently. */
void mor_shape_bounds(const mor_shape *shape, mor_bounds *bounds);

/** Writes the outward unit normal: the gradient of the distance by central differences, brought to length 1.
 *  @param point  [in]   shape [3]; unit m
 *  @param step   [in]   unit m; half the width of the differences; > 0
 *  @param normal [out]  shape [3]; unit 1; zero where the differences vanish (the center of a ball)
 *  Cost: six distances. Threads: safe to call concurrently. */
void mor_shape_normal(const mor_shape *shape, const double *point, double step, double *normal);

/** Moves a point along the normals to a height over the surface, by a few steps of Newton's method.
 *  @param height [in]      unit m; 0: onto the surface
 *  @param step   [in]      unit m; half the width of the differences that give normals, and the tolerance of its
 *      height; > 0
 *  @param point  [in,out]  shape [3]; unit m
 *  @param normal [out]     shape [3]; where it ends, unit 1
 *  Returns: whether it converged. Threads: safe to call concurrently. */
bool mor_shape_project(const mor_shape *shape, double height, double step, double *point, double *normal);

/** Returns whether a ray meets a shape; not where it still grazes the surface after some hundred steps.
 *  @param from      [in]  shape [3]; unit m
 *  @param direction [in]  shape [3]; unit vector, 1
 *  @param reach     [in]  unit m; length of the ray; nothing is met where it is <= 0
 *  @param touch     [in]  unit m; a ray this near to the surface meets it; > 0
 *  Cost: some distances. Threads: safe to call concurrently. */
bool mor_shape_meets_ray(const mor_shape *shape, const double *from, const double *direction, double reach,
                         double touch);

/** Writes the normal as mor_shape_normal, from exact distances.
 *  @param point  [in]   shape [3]; unit m
 *  @param step   [in]   unit m; half the width of the differences; > 0
 *  @param normal [out]  shape [3]; unit 1; zero where the differences vanish
 *  Cost: six exact distances. Threads: safe to call concurrently. */
void mor_shape_exact_normal(const mor_shape *shape, const double *point, double step, double *normal);

/** Frees a shape with its children and sets the pointer to NULL. NULL is accepted.
 *  @param shape   [in,out]  one pointer */
void mor_shape_free(mor_context *context, mor_shape **shape);

#endif
