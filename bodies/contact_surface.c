/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Where the surface of a shape is, seen from a point in contact: docs/theory/contact.md, "Gap and normal". */
#include "bodies/contact_work.h"

#include "core/base/math.h"
#include "core/particle/shape_analytic.h"

/* Lengths in spacings. */
#define NORMAL_STEP 0x1p-10 /* of the differences that give a normal */
#define CURVATURE_STEP 1.0  /* of those that give a curvature */
#define CURVATURE_LIFT 0.05 /* how far out these are taken: inside, parts of a shape meet */
#define PROBE 0.01          /* a face is one of the whole shape if so far out of it nothing is */
#define EXIT_STEP 0.02      /* least step on the way out */
#define DEEPEST 2.0         /* farther from the surface seams are left alone */

/* The surface around a point goes on as it curves there if the gradient of the level set over this reach differs from
 * the one on the spot by no more than this, 1: no edge is so near. */
#define EDGE_REACH 1.5
#define EDGE_NEAR 0.125
#define EDGE_DIFFERENCE 0.05

enum { EXIT_STEPS_MAX = 128, REFINEMENTS = 3 };

static void go(const double *from, double way, const double *direction, double *to)
{
    for (int a = 0; a < 3; ++a) {
        to[a] = from[a] + way * direction[a];
    }
}

/* Way along a unit vector until the point lies outside, m; INFINITY beyond the depth that is looked at. */
static double find_exit(const mor_shape *shape, const double *place, const double *direction, double spacing,
                        double *point)
{
    double way = 0.0;
    for (int k = 0; k < EXIT_STEPS_MAX && way < DEEPEST * spacing; ++k) {
        go(place, way, direction, point);
        const double distance = mor_shape_distance(shape, point);
        if (distance > 0.0) {
            return way;
        }
        way += fmax(-distance, EXIT_STEP * spacing);
    }
    return INFINITY;
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

/* Distance of an inner point from the surface of the whole shape, by the shortest of many ways out, each of which is
 * turned to the normal where it ends: outside, distances are exact. Keeps the gap that is given if there is none. */
static double search_gap(const mor_shape *shape, int dimension, const double *place, double spacing, double gap,
                         double *normal)
{
    double shortest = INFINITY;
    double direction[3], point[3], best[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < (dimension == 3 ? 27 : 9); ++k) {
        const double way =
            find_direction(k, dimension, direction) ? find_exit(shape, place, direction, spacing, point) : INFINITY;
        if (way < shortest) {
            shortest = way;
            go(direction, 0.0, direction, best);
        }
    }
    for (int k = 0; k < REFINEMENTS && shortest < INFINITY; ++k) {
        double foot[3];
        shortest = find_exit(shape, place, best, spacing, point);
        go(point, EXIT_STEP * spacing, best, point);
        mor_shape_normal(shape, point, NORMAL_STEP * spacing, best);
        go(point, -mor_shape_distance(shape, point), best, foot);
        const double offset[3] = {foot[0] - place[0], foot[1] - place[1], foot[2] - place[2]};
        gap = shortest < INFINITY ? -mor_vector_length(offset) : gap;
        go(best, 0.0, best, normal);
    }
    return gap;
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
    go(place, PROBE * spacing - gap, to, beyond);
    return mor_shape_distance(shape, beyond) > 0.5 * PROBE * spacing
               ? gap
               : search_gap(shape, dimension, place, spacing, gap, to);
}

double mor_contact_curvature(const mor_shape *shape, int dimension, const double *place, double gap,
                             const double *normal, double spacing)
{
    const double step = CURVATURE_STEP * spacing;
    double tangents[2][3], center[3], beside[3];
    double sum = 0.0;
    mor_vector_tangents(normal, tangents[0], tangents[1]);
    go(place, CURVATURE_LIFT * spacing - gap, normal, center);
    for (int k = 0; k < dimension - 1; ++k) {
        double rise = -mor_shape_distance(shape, center);
        for (int side = -1; side <= 1; side += 2) {
            go(center, side * step, tangents[k], beside);
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

bool mor_contact_has_edge(const mor_shape *shape, int dimension, const double *place, double spacing, double *normal)
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
    return !(slope > 1.0 - EDGE_DIFFERENCE && difference2 < EDGE_DIFFERENCE * EDGE_DIFFERENCE);
}
