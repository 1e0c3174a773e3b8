/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_analytic.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_check.h"
#include "core/geometry/shape_moments.h"

#include <string.h>

/* A simple polygon in x-y, unbounded in z. */
typedef struct polygon_shape {
    mor_shape base;
    mor_bounds limits;
    double *points; /* shape [n_points, 2] */
    int n_points;
} polygon_shape;

static double squared_distance_to_edge(const double *a, const double *b, const double *point)
{
    const double edge[2] = {b[0] - a[0], b[1] - a[1]};
    const double offset[2] = {point[0] - a[0], point[1] - a[1]};
    const double length2 = edge[0] * edge[0] + edge[1] * edge[1];
    const double place = fmin(1.0, fmax(0.0, (offset[0] * edge[0] + offset[1] * edge[1]) / length2));
    const double dx = offset[0] - place * edge[0];
    const double dy = offset[1] - place * edge[1];
    return dx * dx + dy * dy;
}

static double polygon_distance(const mor_shape *shape, const double *point)
{
    const polygon_shape *polygon = (const polygon_shape *)shape;
    double nearest2 = INFINITY;
    bool is_inside = false;
    const double *a = polygon->points + 2 * (polygon->n_points - 1);
    for (int i = 0; i < polygon->n_points; ++i) {
        const double *b = polygon->points + 2 * i;
        nearest2 = fmin(nearest2, squared_distance_to_edge(a, b, point));
        /* Half-open in y: a ray through a corner meets exactly one of the two edges there. */
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (b[0] - a[0]) * ((point[1] - a[1]) / (b[1] - a[1]))) {
            is_inside = !is_inside;
        }
        a = b;
    }
    return is_inside ? -sqrt(nearest2) : sqrt(nearest2);
}

static void polygon_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    *bounds = ((const polygon_shape *)shape)->limits;
}

static void polygon_free(mor_context *context, mor_shape *shape)
{
    polygon_shape *polygon = (polygon_shape *)shape;
    MOR_FREE(context, &polygon->points);
    MOR_FREE(context, &polygon);
}

static bool polygon_moments(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    const polygon_shape *polygon = (const polygon_shape *)shape;
    if (dimension != 2) {
        return false; /* unbounded in z */
    }
    mor_shape_find_polygon_moments(polygon->points, polygon->n_points, moments);
    return true;
}

static const mor_shape_operations polygon_operations = {.kind = "polygon",
                                                        .distance = polygon_distance,
                                                        .bounds = polygon_bounds,
                                                        .free = polygon_free,
                                                        .moments = polygon_moments};

/* Sums over the triangles between an edge and the first corner (Green's theorem), then brought to the center. */
void mor_shape_find_polygon_moments(const double *points, int n_points, mor_shape_moments *moments)
{
    double area = 0.0;
    double first[2] = {0.0, 0.0};
    double second[3] = {0.0, 0.0, 0.0}; /* xx, yy, xy */
    for (int i = 1; i + 1 < n_points; ++i) {
        const double b[2] = {points[2 * i] - points[0], points[2 * i + 1] - points[1]};
        const double c[2] = {points[2 * i + 2] - points[0], points[2 * i + 3] - points[1]};
        const double doubled = b[0] * c[1] - b[1] * c[0];
        area += doubled / 2.0;
        for (int a = 0; a < 2; ++a) {
            first[a] += doubled * (b[a] + c[a]) / 6.0;
            second[a] += doubled * (b[a] * b[a] + b[a] * c[a] + c[a] * c[a]) / 12.0;
        }
        second[2] += doubled * (2.0 * (b[0] * b[1] + c[0] * c[1]) + b[0] * c[1] + c[0] * b[1]) / 24.0;
    }
    const double sign = area < 0.0 ? -1.0 : 1.0; /* clockwise corners make all sums negative */
    const double offset[2] = {first[0] / area, first[1] / area};
    memset(moments, 0, sizeof *moments);
    moments->volume = sign * area;
    moments->center[0] = points[0] + offset[0];
    moments->center[1] = points[1] + offset[1];
    moments->inertia[MOR_XX] = sign * (second[1] - area * offset[1] * offset[1]);
    moments->inertia[MOR_YY] = sign * (second[0] - area * offset[0] * offset[0]);
    moments->inertia[MOR_ZZ] = moments->inertia[MOR_XX] + moments->inertia[MOR_YY];
    moments->inertia[MOR_XY] = sign * (area * offset[0] * offset[1] - second[2]);
}

/* Twice the signed area of a triangle. */
static double orient(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool is_between(const double *a, const double *b, const double *c)
{
    return fmin(a[0], b[0]) <= c[0] && c[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= c[1] && c[1] <= fmax(a[1], b[1]);
}

/* Puts the ends of an edge in an order of their own. */
static void order_ends(const double **a, const double **b)
{
    if ((*a)[0] > (*b)[0] || ((*a)[0] == (*b)[0] && (*a)[1] > (*b)[1])) {
        const double *const kept = *a;
        *a = *b;
        *b = kept;
    }
}

/* Whether edges ab and cd share a point; rounding does not depend on which way round they are given. */
static bool edges_intersect(const double *a, const double *b, const double *c, const double *d)
{
    order_ends(&a, &b);
    order_ends(&c, &d);
    const double c_side = orient(a, b, c);
    const double d_side = orient(a, b, d);
    const double a_side = orient(c, d, a);
    const double b_side = orient(c, d, b);
    if (((c_side > 0.0 && d_side < 0.0) || (c_side < 0.0 && d_side > 0.0)) &&
        ((a_side > 0.0 && b_side < 0.0) || (a_side < 0.0 && b_side > 0.0))) {
        return true;
    }
    return (c_side == 0.0 && is_between(a, b, c)) || (d_side == 0.0 && is_between(a, b, d)) ||
           (a_side == 0.0 && is_between(c, d, a)) || (b_side == 0.0 && is_between(c, d, b));
}

static mor_status check_points(mor_context *context, const double *points, int n_points)
{
    for (int i = 0; i < n_points; ++i) {
        const double *a = points + 2 * i;
        const double *b = points + 2 * ((i + 1) % n_points);
        MOR_CHECK(context, isfinite(a[0]) && isfinite(a[1]), MOR_ERROR_ARGUMENT,
                  "point %d of the polygon is (%g, %g): give finite numbers", i + 1, a[0], a[1]);
        MOR_CHECK(context, a[0] != b[0] || a[1] != b[1], MOR_ERROR_ARGUMENT,
                  "points %d and %d of the polygon are both (%g, %g): leave one out; the last is joined to the first "
                  "without repeating it",
                  i + 1, (i + 1) % n_points + 1, a[0], a[1]);
    }
    return MOR_OK;
}

/* Whether the boxes around edges ab and cd are apart: a faster test than for the edges. */
static bool are_boxes_apart(const double *a, const double *b, const double *c, const double *d)
{
    return fmax(a[0], b[0]) < fmin(c[0], d[0]) || fmax(c[0], d[0]) < fmin(a[0], b[0]) ||
           fmax(a[1], b[1]) < fmin(c[1], d[1]) || fmax(c[1], d[1]) < fmin(a[1], b[1]);
}

bool mor_shape_find_crossing(const double *points, int n_points, int *first, int *second)
{
    for (int i = 0; i < n_points; ++i) {
        /* Edge i joins points i and i + 1. The edges next to it share a corner; where one folds back onto it, the one
         * after that touches it, or a triangle has no area. */
        for (int j = i + 2; j < n_points - (i == 0); ++j) {
            const double *a = points + 2 * i;
            const double *b = points + 2 * (i + 1);
            const double *c = points + 2 * j;
            const double *d = points + 2 * ((j + 1) % n_points);
            if (!are_boxes_apart(a, b, c, d) && edges_intersect(a, b, c, d)) {
                *first = i;
                *second = j;
                return true;
            }
        }
    }
    return false;
}

static mor_status check_crossings(mor_context *context, const double *points, int n_points)
{
    int i;
    int j;
    if (!mor_shape_find_crossing(points, n_points, &i, &j)) {
        return MOR_OK;
    }
    const double *a = points + 2 * i;
    const double *b = points + 2 * (i + 1);
    const double *c = points + 2 * j;
    const double *d = points + 2 * ((j + 1) % n_points);
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                    "the polygon meets itself: the edge from point %d (%g, %g) to point %d (%g, %g) and the edge from "
                    "point %d (%g, %g) to point %d (%g, %g) cross or touch; give a simple polygon",
                    i + 1, a[0], a[1], i + 2, b[0], b[1], j + 1, c[0], c[1], (j + 1) % n_points + 1, d[0], d[1]);
}

static mor_status check_area(mor_context *context, const double *points, int n_points, const mor_bounds *limits)
{
    double doubled = 0.0;
    for (int i = 1; i + 1 < n_points; ++i) {
        doubled += orient(points, points + 2 * i, points + 2 * (i + 1));
    }
    const double extent = fmax(limits->maximum[0] - limits->minimum[0], limits->maximum[1] - limits->minimum[1]);
    MOR_CHECK(context, fabs(doubled) > 1e-12 * extent * extent, MOR_ERROR_ARGUMENT,
              "the polygon has no area: its %d points lie on one line; give points around a surface", n_points);
    return MOR_OK;
}

static void find_limits(const double *points, int n_points, mor_bounds *limits)
{
    for (int a = 0; a < 3; ++a) {
        limits->minimum[a] = a < 2 ? points[a] : -INFINITY;
        limits->maximum[a] = a < 2 ? points[a] : INFINITY;
    }
    for (int i = 1; i < n_points; ++i) {
        for (int a = 0; a < 2; ++a) {
            limits->minimum[a] = fmin(limits->minimum[a], points[2 * i + a]);
            limits->maximum[a] = fmax(limits->maximum[a], points[2 * i + a]);
        }
    }
}

mor_status mor_shape_new_polygon(mor_context *context, const double *points, int n_points, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, points != NULL && n_points >= 3, MOR_ERROR_ARGUMENT,
              "the polygon has %d points: give at least 3", n_points);
    mor_bounds limits;
    MOR_TRY(context, check_points(context, points, n_points));
    find_limits(points, n_points, &limits);
    MOR_TRY(context, check_crossings(context, points, n_points));
    MOR_TRY(context, check_area(context, points, n_points, &limits));
    polygon_shape *polygon = NULL;
    MOR_TRY(context, MOR_NEW(context, &polygon, 1, "polygon"));
    polygon->base.operations = &polygon_operations;
    polygon->limits = limits;
    polygon->n_points = n_points;
    const mor_status status = MOR_NEW(context, &polygon->points, 2 * (int64_t)n_points, "polygon points");
    if (status != MOR_OK) {
        MOR_FREE(context, &polygon);
        return mor_context_pass(context, status, MOR_HERE);
    }
    memcpy(polygon->points, points, 2 * (size_t)n_points * sizeof *points);
    *shape = &polygon->base;
    return MOR_OK;
}
