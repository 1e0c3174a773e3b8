/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_RELAX_SCENE_H
#define MOR_TESTS_COMMON_RELAX_SCENE_H

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/relax.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  Shapes to fill with particles, in units of a given length, and the filling. For tests. */

/** A rock without a file: a ball whose radius varies with the direction, by up to a quarter. */
typedef struct relax_rock {
    mor_shape base;
    double radius; /* mean, m */
} relax_rock;

/** Distance of a rock, m, exact to first order near its surface. Tables of operations point here. */
static inline double relax_rock_distance(const mor_shape *shape, const double *point)
{
    const double radius = ((const relax_rock *)shape)->radius;
    const double length = mor_vector_length(point);
    if (!(length > 0.0)) {
        return -0.5 * radius;
    }
    const double d[3] = {point[0] / length, point[1] / length, point[2] / length};
    const double wave[3] = {4.0 * d[0] + 1.0, 5.0 * d[2] + 2.0 * d[0], 9.0 * d[1] * d[2]};
    const double bump = 0.12 * sin(wave[0]) * cos(3.0 * d[1]) + 0.08 * sin(wave[1]) + 0.05 * cos(wave[2]);
    /* The slope of the surface, without the part along the radius. */
    const double slope[3] = {0.48 * cos(wave[0]) * cos(3.0 * d[1]) + 0.16 * cos(wave[1]),
                             -0.36 * sin(wave[0]) * sin(3.0 * d[1]) - 0.45 * d[2] * sin(wave[2]),
                             0.4 * cos(wave[1]) - 0.45 * d[1] * sin(wave[2])};
    const double along = mor_vector_dot(slope, d);
    const double slope2 = (mor_vector_dot(slope, slope) - along * along) / ((1.0 + bump) * (1.0 + bump));
    return (length - radius * (1.0 + bump)) / sqrt(1.0 + slope2);
}

/** Bounds of a rock. */
static inline void relax_rock_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    for (int a = 0; a < 3; ++a) {
        bounds->maximum[a] = 1.25 * ((const relax_rock *)shape)->radius;
        bounds->minimum[a] = -bounds->maximum[a];
    }
}

static const mor_shape_operations relax_rock_operations = {
    .kind = "rock", .distance = relax_rock_distance, .bounds = relax_rock_bounds};

/** Makes a shape of the list: ball, box, rock, cone, cylinder, angle (concave), plate, disc, polygon. Lengths in m. */
static inline mor_shape *new_relax_shape(mor_context *context, const char *name, double unit)
{
    const double zero[3] = {0.0, 0.0, 0.0};
    const double under[3] = {0.0, 0.0, -10.0 * unit};
    const double box[3] = {20.0 * unit, 16.0 * unit, 16.0 * unit};
    const double plate[3] = {24.3 * unit, 18.7 * unit, 4.4 * unit};
    const double oblique[3] = {1.0, 0.5, 0.2};
    const double upright[3] = {0.0, 0.0, 1.0};
    mor_shape *shape = NULL;
    mor_shape *minus = NULL;
    if (strcmp(name, "ball") == 0) {
        assert_int_equal(mor_shape_new_sphere(context, zero, 10.6 * unit, &shape), MOR_OK);
    } else if (strcmp(name, "box") == 0) {
        assert_int_equal(mor_shape_new_box(context, zero, box, &shape), MOR_OK);
    } else if (strcmp(name, "plate") == 0) {
        assert_int_equal(mor_shape_new_box(context, zero, plate, &shape), MOR_OK);
    } else if (strcmp(name, "cone") == 0) {
        assert_int_equal(mor_shape_new_cone(context, zero, upright, 12.0 * unit, 25.0 * unit, &shape), MOR_OK);
    } else if (strcmp(name, "cylinder") == 0) {
        assert_int_equal(mor_shape_new_cylinder(context, zero, oblique, 8.0 * unit, 20.0 * unit, &shape), MOR_OK);
    } else if (strcmp(name, "disc") == 0) {
        assert_int_equal(mor_shape_new_cylinder(context, under, upright, 20.3 * unit, 20.0 * unit, &shape), MOR_OK);
    } else if (strcmp(name, "angle") == 0) {
        const double low[3] = {9.3 * unit, 9.3 * unit, -1.0 * unit};
        const double high[3] = {30.0 * unit, 30.0 * unit, 30.0 * unit};
        assert_int_equal(mor_shape_new_box(context, zero, box, &minus), MOR_OK);
        mor_shape *from = minus;
        minus = NULL;
        assert_int_equal(mor_shape_new_box(context, low, high, &minus), MOR_OK);
        assert_int_equal(mor_shape_new_difference(context, &from, &minus, &shape), MOR_OK);
    } else {
        const double corners[12] = {0, 0, 30, 3, 41, 20, 25, 38, 18, 22, 3, 30};
        double points[12];
        for (int k = 0; k < 12; ++k) {
            points[k] = corners[k] * unit;
        }
        assert_string_equal(name, "polygon");
        assert_int_equal(mor_shape_new_polygon(context, points, 6, &shape), MOR_OK);
    }
    return shape;
}

/** A request with the defaults but for shape, dimension (2 or 3) and spacing [m]. */
static inline mor_relax_request new_relax_request(const mor_shape *shape, int dimension, double spacing)
{
    mor_relax_request request;
    mor_relax_request_init(&request);
    request.shape = shape;
    request.dimension = dimension;
    request.spacing = spacing;
    return request;
}

#endif
