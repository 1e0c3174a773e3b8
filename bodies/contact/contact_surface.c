/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Where the surface of a shape is, seen from a point in contact: docs/theory/contact.md, "Gap and normal". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* Lengths in spacings. */
#define NORMAL_STEP 0x1p-10 /* of the differences that give a normal */
#define CURVATURE_STEP 1.0  /* of those that give a curvature */
#define CURVATURE_LIFT 0.05 /* how far out these are taken: inside, parts of a shape meet */
#define PROBE 0.01          /* a face is one of the whole shape if so far out of it nothing is */
#define EXIT_STEP 0.02      /* least step on the way out */
#define CLEARANCE 0x1p-9    /* from there on outside, so that differences are taken there */
#define DEEPEST 2.0         /* farther from the surface seams are left alone */

/* An edge is looked for by comparing the gradient of the level set over this reach with the one at the point. */
#define EDGE_REACH 1.5
#define EDGE_NEAR 0.125

enum { EXIT_STEPS_MAX = 128, REFINEMENTS = 3, BISECTIONS = 16 };

/* Place on the surface where a ray along a unit vector leaves the shape, and the normal there; false: not within the
 * depth that is searched. Outside, distances are exact. */
static bool find_exit(const mor_shape *shape, const double *place, const double *direction, double spacing,
                      double *foot, double *normal)
{
    double inside = 0.0;
    double outside = 0.0;
    double distance = 0.0;
    double point[3];
    for (int k = 0; k < EXIT_STEPS_MAX && !(distance > 0.0); ++k) {
        inside = outside;
        outside += fmax(-distance, EXIT_STEP * spacing);
        if (outside > DEEPEST * spacing) {
            return false;
        }
        mor_vector_advance(place, outside, direction, point);
        distance = mor_shape_distance(shape, point);
    }
    for (int k = 0; k < BISECTIONS && distance > 0.0; ++k) {
        const double middle = 0.5 * (inside + outside);
        mor_vector_advance(place, middle, direction, point);
        const bool is_out = mor_shape_distance(shape, point) > 0.0;
        outside = is_out ? middle : outside;
        inside = is_out ? inside : middle;
    }
    mor_vector_advance(place, outside + CLEARANCE * spacing, direction, point);
    distance = mor_shape_distance(shape, point);
    mor_shape_normal(shape, point, NORMAL_STEP * spacing, normal);
    mor_vector_advance(point, -distance, normal, foot);
    return distance > 0.0 && mor_vector_length(normal) > 0.5;
}

/* Direction k of those to the faces, edges and corners of a cube; false: none. */
static bool find_direction(int k, int dimension, double *direction)
{
    direction[0] = k % 3 - 1;
    direction[1] = k / 3 % 3 - 1;
    direction[2] = dimension == 3 ? k / 9 - 1 : 0.0;
    const double length = mor_vector_length(direction);
    for (int a = 0; a < 3 && length > 0.0; ++a) {
        direction[a] /= length;
    }
    return length > 0.0;
}

/* The nearest place on the surface that was found so far. */
typedef struct nearest {
    double depth; /* m; INFINITY: none */
    double foot[3], normal[3];
} nearest;

/* Searches along one ray and keeps the exit if it is the nearest so far. Returns whether it is. */
static bool look_along(const mor_shape *shape, const double *place, const double *direction, double spacing,
                       nearest *best)
{
    nearest it;
    if (!find_exit(shape, place, direction, spacing, it.foot, it.normal)) {
        return false;
    }
    const double offset[3] = {it.foot[0] - place[0], it.foot[1] - place[1], it.foot[2] - place[2]};
    it.depth = mor_vector_length(offset);
    if (!(it.depth < best->depth)) {
        return false;
    }
    *best = it;
    return true;
}

/* Distance of an inner point from the surface of the whole shape: the nearest exit of many rays, and of those along the
 * normals there. Keeps the given gap and normal if no ray leaves the shape. */
static double search_gap(const mor_shape *shape, int dimension, const double *place, double spacing, double gap,
                         double *normal)
{
    nearest best = {.depth = INFINITY};
    double direction[3];
    for (int k = 0; k < (dimension == 3 ? 27 : 9); ++k) {
        if (find_direction(k, dimension, direction)) {
            look_along(shape, place, direction, spacing, &best);
        }
    }
    bool is_better = isfinite(best.depth);
    for (int k = 0; k < REFINEMENTS && is_better; ++k) {
        memcpy(direction, best.normal, sizeof direction);
        is_better = look_along(shape, place, direction, spacing, &best);
    }
    if (!isfinite(best.depth)) {
        return gap;
    }
    memcpy(normal, best.normal, sizeof best.normal);
    return -best.depth;
}

double mor_contact_shape_gap(const mor_shape *shape, int dimension, const double *place, double spacing, double *normal)
{
    const double gap = mor_shape_distance(shape, place);
    const bool may_be_seam = gap <= 0.0 && gap > -DEEPEST * spacing && mor_shape_has_seams(shape);
    double own[3], beyond[3];
    double *to = normal != NULL ? normal : own;
    if (normal != NULL || may_be_seam) {
        mor_shape_normal(shape, place, NORMAL_STEP * spacing, to);
    }
    if (!may_be_seam) {
        return gap;
    }
    /* Beside an inner corner another part is near, but what lies just beyond the face is free. */
    mor_vector_advance(place, PROBE * spacing - gap, to, beyond);
    return mor_shape_distance(shape, beyond) > 0.0 ? gap : search_gap(shape, dimension, place, spacing, gap, to);
}

double mor_contact_curvature(const mor_shape *shape, int dimension, const double *place, double gap,
                             const double *normal, double spacing)
{
    const double step = CURVATURE_STEP * spacing;
    double tangents[2][3], center[3], beside[3];
    double sum = 0.0;
    mor_vector_tangents(normal, tangents[0], tangents[1]);
    mor_vector_advance(place, CURVATURE_LIFT * spacing - gap, normal, center);
    const double at_center = mor_shape_distance(shape, center);
    for (int k = 0; k < dimension - 1; ++k) {
        double rise = -at_center;
        for (int side = -1; side <= 1; side += 2) {
            mor_vector_advance(center, side * step, tangents[k], beside);
            rise += 0.5 * mor_shape_distance(shape, beside);
        }
        /* Of a circle, sqrt(R^2 + step^2) - R. */
        sum += 2.0 * rise / fmax(step * step - rise * rise, 0.25 * step * step);
    }
    sum /= dimension - 1;
    /* Of the surface itself: out there circles are wider. */
    return sum / fmax(0.5, 1.0 - CURVATURE_LIFT * spacing * sum);
}

/* Gradient of the level set by central differences, in the frame of the shape. */
static void find_gradient(const mor_shape *shape, int dimension, const double *place, double step, double *gradient)
{
    gradient[2] = 0.0;
    for (int a = 0; a < dimension; ++a) {
        double before[3] = {place[0], place[1], place[2]};
        double behind[3] = {place[0], place[1], place[2]};
        before[a] -= step;
        behind[a] += step;
        gradient[a] = 0.5 * (mor_shape_distance(shape, behind) - mor_shape_distance(shape, before)) / step;
    }
}

bool mor_contact_has_edge(const mor_shape *shape, int dimension, const double *place, double spacing, double limit,
                          double *normal)
{
    double far[3];
    double difference2 = 0.0;
    find_gradient(shape, dimension, place, EDGE_NEAR * spacing, normal);
    find_gradient(shape, dimension, place, EDGE_REACH * spacing, far);
    for (int a = 0; a < dimension; ++a) {
        difference2 += (far[a] - normal[a]) * (far[a] - normal[a]);
    }
    const double slope = mor_vector_length(normal);
    for (int a = 0; a < 3; ++a) {
        normal[a] /= slope > 0.0 ? slope : 1.0;
    }
    return !(slope > 1.0 - limit && difference2 < limit * limit);
}
