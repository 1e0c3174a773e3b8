/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_analytic.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_check.h"

#include <float.h>
#include <string.h>

typedef struct union_shape {
    mor_shape base;
    int n_parts;
    mor_shape **parts; /* shape [n_parts]; owned, as what they point to */
} union_shape;

typedef struct difference_shape {
    mor_shape base;
    mor_shape *from;  /* owned */
    mor_shape *minus; /* owned */
} difference_shape;

typedef struct scaled_shape {
    mor_shape base;
    mor_shape *child; /* owned */
    double factor;
} scaled_shape;

typedef struct view_shape {
    mor_shape base;
    const mor_shape *other; /* borrowed */
} view_shape;

typedef struct placed_shape {
    mor_shape base;
    mor_shape *child; /* owned */
    double rotation[9];
    double translation[3];
} placed_shape;

static double measure_union(const mor_shape *shape, const double *point, mor_shape_measure measure)
{
    const union_shape *whole = (const union_shape *)shape;
    double nearest = INFINITY;
    for (int i = 0; i < whole->n_parts; ++i) {
        nearest = fmin(nearest, measure(whole->parts[i], point));
    }
    return nearest;
}

static void union_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const union_shape *whole = (const union_shape *)shape;
    mor_shape_bounds(whole->parts[0], bounds);
    for (int i = 1; i < whole->n_parts; ++i) {
        mor_bounds part;
        mor_shape_bounds(whole->parts[i], &part);
        for (int a = 0; a < 3; ++a) {
            bounds->minimum[a] = fmin(bounds->minimum[a], part.minimum[a]);
            bounds->maximum[a] = fmax(bounds->maximum[a], part.maximum[a]);
        }
    }
}

static void union_free(mor_context *context, mor_shape *shape)
{
    union_shape *whole = (union_shape *)shape;
    for (int i = 0; i < whole->n_parts; ++i) {
        mor_shape_free(context, &whole->parts[i]);
    }
    MOR_FREE(context, &whole->parts);
    MOR_FREE(context, &whole);
}

static double measure_difference(const mor_shape *shape, const double *point, mor_shape_measure measure)
{
    const difference_shape *rest = (const difference_shape *)shape;
    return fmax(measure(rest->from, point), -measure(rest->minus, point));
}

static void difference_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    mor_shape_bounds(((const difference_shape *)shape)->from, bounds);
}

static void difference_free(mor_context *context, mor_shape *shape)
{
    difference_shape *rest = (difference_shape *)shape;
    mor_shape_free(context, &rest->from);
    mor_shape_free(context, &rest->minus);
    MOR_FREE(context, &rest);
}

static double measure_placed(const mor_shape *shape, const double *point, mor_shape_measure measure)
{
    const placed_shape *placed = (const placed_shape *)shape;
    const double offset[3] = {point[0] - placed->translation[0], point[1] - placed->translation[1],
                              point[2] - placed->translation[2]};
    double local[3];
    mor_matrix_apply_transposed(placed->rotation, offset, local);
    return measure(placed->child, local);
}

static void placed_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const placed_shape *placed = (const placed_shape *)shape;
    mor_bounds child;
    mor_shape_bounds(placed->child, &child);
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = placed->translation[a];
        bounds->maximum[a] = placed->translation[a];
        for (int b = 0; b < 3; ++b) {
            const double part = placed->rotation[3 * a + b];
            /* Zero times infinity would be NaN: a direction that does not contribute is left out. */
            if (part != 0.0) {
                bounds->minimum[a] += part * (part > 0.0 ? child.minimum[b] : child.maximum[b]);
                bounds->maximum[a] += part * (part > 0.0 ? child.maximum[b] : child.minimum[b]);
            }
        }
    }
}

static void placed_free(mor_context *context, mor_shape *shape)
{
    placed_shape *placed = (placed_shape *)shape;
    mor_shape_free(context, &placed->child);
    MOR_FREE(context, &placed);
}

static double measure_scaled(const mor_shape *shape, const double *point, mor_shape_measure measure)
{
    const scaled_shape *scaled = (const scaled_shape *)shape;
    const double local[3] = {point[0] / scaled->factor, point[1] / scaled->factor, point[2] / scaled->factor};
    return scaled->factor * measure(scaled->child, local);
}

static void scaled_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const scaled_shape *scaled = (const scaled_shape *)shape;
    mor_shape_bounds(scaled->child, bounds);
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] *= scaled->factor;
        bounds->maximum[a] *= scaled->factor;
    }
}

static bool scaled_moments(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    const scaled_shape *scaled = (const scaled_shape *)shape;
    const double area = scaled->factor * scaled->factor;
    const double volume = dimension == 3 ? area * scaled->factor : area;
    if (!mor_shape_moments_known(scaled->child, dimension, moments)) {
        return false;
    }
    moments->volume *= volume;
    for (int a = 0; a < 3; ++a) {
        moments->center[a] *= scaled->factor;
    }
    for (int k = 0; k < 6; ++k) {
        moments->inertia[k] *= volume * area;
    }
    return true;
}

static void scaled_free(mor_context *context, mor_shape *shape)
{
    scaled_shape *scaled = (scaled_shape *)shape;
    mor_shape_free(context, &scaled->child);
    MOR_FREE(context, &scaled);
}

static double measure_view(const mor_shape *shape, const double *point, mor_shape_measure measure)
{
    return measure(((const view_shape *)shape)->other, point);
}

static void view_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    mor_shape_bounds(((const view_shape *)shape)->other, bounds);
}

static bool view_moments(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    return mor_shape_moments_known(((const view_shape *)shape)->other, dimension, moments);
}

static void view_free(mor_context *context, mor_shape *shape)
{
    view_shape *view = (view_shape *)shape;
    MOR_FREE(context, &view);
}

/* Both ways to measure a compound, from those of its parts. */
#define MEASURE(kind)                                                                                                  \
    static double kind##_distance(const mor_shape *shape, const double *point)                                         \
    {                                                                                                                  \
        return measure_##kind(shape, point, mor_shape_distance);                                                       \
    }                                                                                                                  \
    static double kind##_exact_distance(const mor_shape *shape, const double *point)                                   \
    {                                                                                                                  \
        return measure_##kind(shape, point, mor_shape_exact_distance);                                                 \
    }

MEASURE(union)
MEASURE(difference)
MEASURE(placed)
MEASURE(scaled)
MEASURE(view)

static bool union_has_seams(const mor_shape *shape)
{
    const union_shape *whole = (const union_shape *)shape;
    return whole->n_parts > 1 || mor_shape_has_seams(whole->parts[0]);
}

static bool difference_has_seams(const mor_shape *shape)
{
    return mor_shape_has_seams(((const difference_shape *)shape)->from);
}

static bool placed_has_seams(const mor_shape *shape)
{
    return mor_shape_has_seams(((const placed_shape *)shape)->child);
}

static bool scaled_has_seams(const mor_shape *shape)
{
    return mor_shape_has_seams(((const scaled_shape *)shape)->child);
}

static bool view_has_seams(const mor_shape *shape)
{
    return mor_shape_has_seams(((const view_shape *)shape)->other);
}

static const mor_shape_operations union_operations = {.kind = "union",
                                                      .distance = union_distance,
                                                      .bounds = union_bounds,
                                                      .free = union_free,
                                                      .moments = NULL,
                                                      .exact_distance = union_exact_distance,
                                                      .has_seams = union_has_seams};
static const mor_shape_operations difference_operations = {.kind = "difference",
                                                           .distance = difference_distance,
                                                           .bounds = difference_bounds,
                                                           .free = difference_free,
                                                           .moments = NULL,
                                                           .exact_distance = difference_exact_distance,
                                                           .has_seams = difference_has_seams};
static const mor_shape_operations placed_operations = {.kind = "placed",
                                                       .distance = placed_distance,
                                                       .bounds = placed_bounds,
                                                       .free = placed_free,
                                                       .moments = NULL,
                                                       .exact_distance = placed_exact_distance,
                                                       .has_seams = placed_has_seams};
static const mor_shape_operations scaled_operations = {.kind = "scaled",
                                                       .distance = scaled_distance,
                                                       .bounds = scaled_bounds,
                                                       .free = scaled_free,
                                                       .moments = scaled_moments,
                                                       .exact_distance = scaled_exact_distance,
                                                       .has_seams = scaled_has_seams};
static const mor_shape_operations view_operations = {.kind = "view",
                                                     .distance = view_distance,
                                                     .bounds = view_bounds,
                                                     .free = view_free,
                                                     .moments = view_moments,
                                                     .exact_distance = view_exact_distance,
                                                     .has_seams = view_has_seams};

mor_status mor_shape_new_union(mor_context *context, mor_shape **parts, int n_parts, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, parts != NULL && n_parts >= 1, MOR_ERROR_ARGUMENT,
              "the union has %d parts: give at least one shape", n_parts);
    for (int i = 0; i < n_parts; ++i) {
        MOR_CHECK(context, parts[i] != NULL, MOR_ERROR_ARGUMENT, "part %d of %d of the union is missing: give a shape",
                  i + 1, n_parts);
        for (int j = 0; j < i; ++j) {
            MOR_CHECK(context, parts[i] != parts[j], MOR_ERROR_ARGUMENT,
                      "parts %d and %d of the union are the same object: make one shape for each", j + 1, i + 1);
        }
    }
    union_shape *whole = NULL;
    MOR_TRY(context, MOR_NEW(context, &whole, 1, "union"));
    const mor_status status = MOR_NEW(context, &whole->parts, n_parts, "parts of a union");
    if (status != MOR_OK) {
        MOR_FREE(context, &whole);
        return mor_context_pass(context, status, MOR_HERE);
    }
    whole->base.operations = &union_operations;
    whole->n_parts = n_parts;
    for (int i = 0; i < n_parts; ++i) {
        whole->parts[i] = parts[i];
        parts[i] = NULL;
    }
    *shape = &whole->base;
    return MOR_OK;
}

mor_status mor_shape_new_difference(mor_context *context, mor_shape **from, mor_shape **minus, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, from != NULL && *from != NULL && minus != NULL && *minus != NULL, MOR_ERROR_ARGUMENT,
              "the difference needs two shapes: the one to cut from and the one to cut away");
    MOR_CHECK(context, *from != *minus, MOR_ERROR_ARGUMENT,
              "the difference of a shape and itself is empty: make two shapes");
    difference_shape *rest = NULL;
    MOR_TRY(context, MOR_NEW(context, &rest, 1, "difference"));
    rest->base.operations = &difference_operations;
    rest->from = *from;
    rest->minus = *minus;
    *from = NULL;
    *minus = NULL;
    *shape = &rest->base;
    return MOR_OK;
}

mor_status mor_shape_new_scaled(mor_context *context, double factor, mor_shape **child, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, child != NULL && *child != NULL, MOR_ERROR_ARGUMENT, "there is no shape to scale: give one");
    MOR_CHECK(context, isfinite(factor) && factor > 0.0, MOR_ERROR_ARGUMENT,
              "the factor of a scaled shape is %g: give one above zero", factor);
    scaled_shape *scaled = NULL;
    MOR_TRY(context, MOR_NEW(context, &scaled, 1, "scaled shape"));
    scaled->base.operations = &scaled_operations;
    scaled->factor = factor;
    scaled->child = *child;
    *child = NULL;
    *shape = &scaled->base;
    return MOR_OK;
}

mor_status mor_shape_new_view(mor_context *context, const mor_shape *other, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, other != NULL, MOR_ERROR_ARGUMENT, "there is no shape to view: give one");
    view_shape *view = NULL;
    MOR_TRY(context, MOR_NEW(context, &view, 1, "view of a shape"));
    view->base.operations = &view_operations;
    view->other = other;
    *shape = &view->base;
    return MOR_OK;
}

mor_status mor_shape_new_placed(mor_context *context, const double *rotation, const double *translation,
                                mor_shape **child, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, child != NULL && *child != NULL, MOR_ERROR_ARGUMENT, "there is no shape to place: give one");
    MOR_TRY(context, mor_shape_check_rotation(context, rotation));
    MOR_TRY(context, mor_shape_check_vector(context, translation, "the translation"));
    placed_shape *placed = NULL;
    MOR_TRY(context, MOR_NEW(context, &placed, 1, "placed shape"));
    placed->base.operations = &placed_operations;
    memcpy(placed->rotation, rotation, sizeof placed->rotation);
    memcpy(placed->translation, translation, sizeof placed->translation);
    placed->child = *child;
    *child = NULL;
    *shape = &placed->base;
    return MOR_OK;
}

mor_status mor_shape_new_translate(mor_context *context, const double *translation, mor_shape **child,
                                   mor_shape **shape)
{
    const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    MOR_TRY(context, mor_shape_new_placed(context, identity, translation, child, shape));
    return MOR_OK;
}

/* A quarter rotation by a rounded angle leaves 6e-17 in place of 0: that would make bounds infinite. */
static void snap_matrix(double *matrix)
{
    for (int i = 0; i < 9; ++i) {
        const double whole = round(matrix[i]);
        if (fabs(matrix[i] - whole) < 4.0 * DBL_EPSILON) {
            matrix[i] = whole;
        }
    }
}

mor_status mor_shape_new_rotate(mor_context *context, const double *axis, double angle, const double *center,
                                mor_shape **child, mor_shape **shape)
{
    *shape = NULL;
    double unit[3];
    MOR_TRY(context, mor_shape_check_direction(context, axis, "the axis of the rotation", unit));
    MOR_TRY(context, mor_shape_check_vector(context, center, "the center of the rotation"));
    MOR_CHECK(context, isfinite(angle), MOR_ERROR_ARGUMENT, "the angle of the rotation is %g rad: give a finite angle",
              angle);
    double rotation[9];
    double translation[3];
    mor_matrix_rotation(unit, angle, rotation);
    snap_matrix(rotation);
    mor_matrix_apply(rotation, center, translation);
    for (int a = 0; a < 3; ++a) {
        translation[a] = center[a] - translation[a];
    }
    MOR_TRY(context, mor_shape_new_placed(context, rotation, translation, child, shape));
    return MOR_OK;
}
