/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_analytic.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_check.h"

#include <string.h>

/* A box; the members of its bounds may be infinite. */
typedef struct box_shape {
    mor_shape base;
    mor_bounds limits;
} box_shape;

typedef struct cylinder_shape {
    mor_shape base;
    double foot[3]; /* center of the first end */
    double axis[3]; /* unit vector */
    double radius;
    double height;
} cylinder_shape;

typedef struct cone_shape {
    mor_shape base;
    double foot[3]; /* center of the base */
    double axis[3]; /* unit vector to the apex */
    double radius;
    double height;
    double slant; /* from the rim to the apex */
} cone_shape;

typedef struct sphere_shape {
    mor_shape base;
    double center[3];
    double radius;
} sphere_shape;

typedef struct half_space_shape {
    mor_shape base;
    double point[3];
    double normal[3]; /* unit vector out of the solid */
} half_space_shape;

/* None of these shapes owns more than its own block. */
static void free_plain(mor_context *context, mor_shape *shape)
{
    MOR_FREE(context, &shape);
}

static double box_distance(const mor_shape *shape, const double *point)
{
    const mor_bounds *limits = &((const box_shape *)shape)->limits;
    double outside = 0.0;
    double nearest = -INFINITY;
    for (int a = 0; a < 3; ++a) {
        const double excess = fmax(limits->minimum[a] - point[a], point[a] - limits->maximum[a]);
        nearest = fmax(nearest, excess);
        outside += excess > 0.0 ? excess * excess : 0.0;
    }
    return nearest > 0.0 ? sqrt(outside) : nearest;
}

static void box_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    *bounds = ((const box_shape *)shape)->limits;
}

static double cylinder_distance(const mor_shape *shape, const double *point)
{
    const cylinder_shape *cylinder = (const cylinder_shape *)shape;
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = point[a] - cylinder->foot[a];
    }
    const double along = mor_vector_dot(offset, cylinder->axis);
    for (int a = 0; a < 3; ++a) {
        offset[a] -= along * cylinder->axis[a];
    }
    const double side = mor_vector_length(offset) - cylinder->radius;
    const double end = fmax(-along, along - cylinder->height);
    if (side > 0.0 && end > 0.0) {
        return sqrt(side * side + end * end);
    }
    return fmax(side, end);
}

static void cylinder_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const cylinder_shape *cylinder = (const cylinder_shape *)shape;
    for (int a = 0; a < 3; ++a) {
        const double axis = cylinder->axis[a];
        const double reach = cylinder->radius * sqrt(fmax(0.0, 1.0 - axis * axis));
        const double rise = cylinder->height * axis;
        bounds->minimum[a] = cylinder->foot[a] + fmin(rise, 0.0) - reach;
        bounds->maximum[a] = cylinder->foot[a] + fmax(rise, 0.0) + reach;
    }
}

/* In the plane of the axis and the point the cone is a triangle: the base, and the side from the rim to the apex. */
static double cone_distance(const mor_shape *shape, const double *point)
{
    const cone_shape *cone = (const cone_shape *)shape;
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = point[a] - cone->foot[a];
    }
    const double along = mor_vector_dot(offset, cone->axis);
    for (int a = 0; a < 3; ++a) {
        offset[a] -= along * cone->axis[a];
    }
    const double excess = mor_vector_length(offset) - cone->radius;
    const double side = (excess * cone->height + along * cone->radius) / cone->slant;
    const double up_side =
        (along * cone->height - excess * cone->radius) / cone->slant; /* place on the side, from rim */
    if (along <= 0.0) {
        return excess <= 0.0 ? -along : sqrt(excess * excess + along * along);
    }
    if (side <= 0.0) {
        return fmax(side, -along);
    }
    if (up_side > cone->slant) {
        return sqrt(side * side + (up_side - cone->slant) * (up_side - cone->slant));
    }
    return up_side < 0.0 ? sqrt(excess * excess + along * along) : side;
}

static void cone_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const cone_shape *cone = (const cone_shape *)shape;
    for (int a = 0; a < 3; ++a) {
        const double axis = cone->axis[a];
        const double reach = cone->radius * sqrt(fmax(0.0, 1.0 - axis * axis));
        const double apex = cone->foot[a] + cone->height * axis;
        bounds->minimum[a] = fmin(apex, cone->foot[a] - reach);
        bounds->maximum[a] = fmax(apex, cone->foot[a] + reach);
    }
}

static double sphere_distance(const mor_shape *shape, const double *point)
{
    const sphere_shape *sphere = (const sphere_shape *)shape;
    const double offset[3] = {point[0] - sphere->center[0], point[1] - sphere->center[1], point[2] - sphere->center[2]};
    return mor_vector_length(offset) - sphere->radius;
}

static void sphere_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const sphere_shape *sphere = (const sphere_shape *)shape;
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = sphere->center[a] - sphere->radius;
        bounds->maximum[a] = sphere->center[a] + sphere->radius;
    }
}

static double half_space_distance(const mor_shape *shape, const double *point)
{
    const half_space_shape *half = (const half_space_shape *)shape;
    const double offset[3] = {point[0] - half->point[0], point[1] - half->point[1], point[2] - half->point[2]};
    return mor_vector_dot(half->normal, offset);
}

static void half_space_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const half_space_shape *half = (const half_space_shape *)shape;
    for (int a = 0; a < 3; ++a) {
        const bool is_along = half->normal[(a + 1) % 3] == 0.0 && half->normal[(a + 2) % 3] == 0.0;
        bounds->minimum[a] = is_along && half->normal[a] < 0.0 ? half->point[a] : -INFINITY;
        bounds->maximum[a] = is_along && half->normal[a] > 0.0 ? half->point[a] : INFINITY;
    }
}

static const mor_shape_operations box_operations = {
    .kind = "box", .distance = box_distance, .bounds = box_bounds, .free = free_plain};
static const mor_shape_operations cylinder_operations = {
    .kind = "cylinder", .distance = cylinder_distance, .bounds = cylinder_bounds, .free = free_plain};
static const mor_shape_operations cone_operations = {
    .kind = "cone", .distance = cone_distance, .bounds = cone_bounds, .free = free_plain};
static const mor_shape_operations sphere_operations = {
    .kind = "sphere", .distance = sphere_distance, .bounds = sphere_bounds, .free = free_plain};
static const mor_shape_operations half_space_operations = {
    .kind = "half_space", .distance = half_space_distance, .bounds = half_space_bounds, .free = free_plain};

mor_status mor_shape_new_box(mor_context *context, const double *minimum, const double *maximum, mor_shape **shape)
{
    *shape = NULL;
    bool has_face = false;
    for (int a = 0; a < 3; ++a) {
        MOR_CHECK(context, minimum[a] < maximum[a], MOR_ERROR_ARGUMENT,
                  "the box is empty along %c: its minimum is %g m and its maximum %g m; give a minimum below the "
                  "maximum",
                  'x' + a, minimum[a], maximum[a]);
        MOR_CHECK(context, minimum[a] < INFINITY && maximum[a] > -INFINITY, MOR_ERROR_ARGUMENT,
                  "the box lies at infinity along %c: from %g m to %g m; only the minimum may be -inf and the maximum "
                  "inf",
                  'x' + a, minimum[a], maximum[a]);
        has_face = has_face || isfinite(minimum[a]) || isfinite(maximum[a]);
    }
    MOR_CHECK(context, has_face, MOR_ERROR_ARGUMENT,
              "the box has no face: every corner coordinate is infinite; give at least one finite one");
    box_shape *box = NULL;
    MOR_TRY(context, MOR_NEW(context, &box, 1, "box"));
    box->base.operations = &box_operations;
    memcpy(box->limits.minimum, minimum, sizeof box->limits.minimum);
    memcpy(box->limits.maximum, maximum, sizeof box->limits.maximum);
    *shape = &box->base;
    return MOR_OK;
}

mor_status mor_shape_new_cylinder(mor_context *context, const double *base, const double *axis, double radius,
                                  double height, mor_shape **shape)
{
    *shape = NULL;
    double unit[3];
    MOR_TRY(context, mor_shape_check_vector(context, base, "the base of the cylinder"));
    MOR_TRY(context, mor_shape_check_direction(context, axis, "the axis of the cylinder", unit));
    MOR_TRY(context, mor_shape_check_length(context, radius, "the radius of the cylinder"));
    MOR_TRY(context, mor_shape_check_length(context, height, "the height of the cylinder"));
    cylinder_shape *cylinder = NULL;
    MOR_TRY(context, MOR_NEW(context, &cylinder, 1, "cylinder"));
    cylinder->base.operations = &cylinder_operations;
    memcpy(cylinder->foot, base, sizeof cylinder->foot);
    memcpy(cylinder->axis, unit, sizeof cylinder->axis);
    cylinder->radius = radius;
    cylinder->height = height;
    *shape = &cylinder->base;
    return MOR_OK;
}

mor_status mor_shape_new_cone(mor_context *context, const double *base, const double *axis, double radius,
                              double height, mor_shape **shape)
{
    *shape = NULL;
    double unit[3];
    MOR_TRY(context, mor_shape_check_vector(context, base, "the base of the cone"));
    MOR_TRY(context, mor_shape_check_direction(context, axis, "the axis of the cone", unit));
    MOR_TRY(context, mor_shape_check_length(context, radius, "the radius of the cone"));
    MOR_TRY(context, mor_shape_check_length(context, height, "the height of the cone"));
    cone_shape *cone = NULL;
    MOR_TRY(context, MOR_NEW(context, &cone, 1, "cone"));
    cone->base.operations = &cone_operations;
    memcpy(cone->foot, base, sizeof cone->foot);
    memcpy(cone->axis, unit, sizeof cone->axis);
    cone->radius = radius;
    cone->height = height;
    cone->slant = sqrt(radius * radius + height * height);
    *shape = &cone->base;
    return MOR_OK;
}

mor_status mor_shape_new_sphere(mor_context *context, const double *center, double radius, mor_shape **shape)
{
    *shape = NULL;
    MOR_TRY(context, mor_shape_check_vector(context, center, "the center of the sphere"));
    MOR_TRY(context, mor_shape_check_length(context, radius, "the radius of the sphere"));
    sphere_shape *sphere = NULL;
    MOR_TRY(context, MOR_NEW(context, &sphere, 1, "sphere"));
    sphere->base.operations = &sphere_operations;
    memcpy(sphere->center, center, sizeof sphere->center);
    sphere->radius = radius;
    *shape = &sphere->base;
    return MOR_OK;
}

mor_status mor_shape_new_half_space(mor_context *context, const double *point, const double *normal, mor_shape **shape)
{
    *shape = NULL;
    double unit[3];
    MOR_TRY(context, mor_shape_check_vector(context, point, "the point of the half-space"));
    MOR_TRY(context, mor_shape_check_direction(context, normal, "the normal of the half-space", unit));
    half_space_shape *half = NULL;
    MOR_TRY(context, MOR_NEW(context, &half, 1, "half-space"));
    half->base.operations = &half_space_operations;
    memcpy(half->point, point, sizeof half->point);
    memcpy(half->normal, unit, sizeof half->normal);
    *shape = &half->base;
    return MOR_OK;
}

bool mor_shape_moments_known(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    return shape->operations->moments != NULL && shape->operations->moments(shape, dimension, moments);
}

double mor_shape_distance(const mor_shape *shape, const double *point)
{
    return shape->operations->distance(shape, point);
}

double mor_shape_exact_distance(const mor_shape *shape, const double *point)
{
    return shape->operations->exact_distance != NULL ? shape->operations->exact_distance(shape, point)
                                                     : shape->operations->distance(shape, point);
}

void mor_shape_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    shape->operations->bounds(shape, bounds);
}

static void find_normal(const mor_shape *shape, mor_shape_measure measure, const double *point, double step,
                        double *normal)
{
    for (int a = 0; a < 3; ++a) {
        double ahead[3] = {point[0], point[1], point[2]};
        double behind[3] = {point[0], point[1], point[2]};
        ahead[a] += step;
        behind[a] -= step;
        normal[a] = measure(shape, ahead) - measure(shape, behind);
    }
    const double length = mor_vector_length(normal);
    for (int a = 0; a < 3 && length > 0.0; ++a) {
        normal[a] /= length;
    }
}

bool mor_shape_has_seams(const mor_shape *shape)
{
    return shape->operations->has_seams != NULL && shape->operations->has_seams(shape);
}

void mor_shape_normal(const mor_shape *shape, const double *point, double step, double *normal)
{
    find_normal(shape, mor_shape_distance, point, step, normal);
}

bool mor_shape_project(const mor_shape *shape, double height, double step, double *point, double *normal)
{
    enum { NEWTON_STEPS = 3 };
    for (int k = 0; k < NEWTON_STEPS; ++k) {
        mor_shape_normal(shape, point, step, normal);
        mor_vector_advance(point, height - mor_shape_distance(shape, point), normal, point);
    }
    return mor_vector_length(normal) > 0.5 && fabs(mor_shape_distance(shape, point) - height) < step;
}

/* Advances by the distance that is certainly free. */
bool mor_shape_meets_ray(const mor_shape *shape, const double *from, const double *direction, double reach,
                         double touch)
{
    enum { STEPS_MAX = 400 };
    double way = 0.0;
    for (int step = 0; step < STEPS_MAX && way < reach; ++step) {
        double point[3];
        mor_vector_advance(from, way, direction, point);
        const double free_way = mor_shape_distance(shape, point) / MOR_SHAPE_SLOPE_MOST;
        if (free_way < touch) {
            return true;
        }
        way += free_way;
    }
    return false;
}

void mor_shape_exact_normal(const mor_shape *shape, const double *point, double step, double *normal)
{
    find_normal(shape, mor_shape_exact_distance, point, step, normal);
}

void mor_shape_free(mor_context *context, mor_shape **shape)
{
    if (*shape != NULL) {
        (*shape)->operations->free(context, *shape);
        *shape = NULL;
    }
}
