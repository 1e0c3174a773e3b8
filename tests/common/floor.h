/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FLOOR_H
#define MOR_TESTS_COMMON_FLOOR_H

#include "core/sph/boundary/soil_contact.h"
#include "tests/common/assembly.h"

#include <float.h>
#include <math.h>
#include <string.h>

/** @file
 *  Soil over a floor of wall particles, for tests of walls. The floor's upper face is z = 0; in plane strain, y = 0. */

enum { FLOOR_SIDE = 7, FLOOR_LAYERS = 4, FLOOR_MAX = FLOOR_SIDE * FLOOR_SIDE * FLOOR_LAYERS };

/** Where the single particle stands. */
#define FLOOR_HEIGHT (0.6 * ASSEMBLY_SPACING)

typedef struct floor_case {
    assembly soil;
    mor_soil_contact wall;
    double points[3 * FLOOR_MAX]; /* shape [n_points, 3], m */
    int n_points;
    bool presses_only;                          /* with Coulomb friction: it does not hold soil under tension */
    double acceleration[3 * ASSEMBLY_MAX];      /* of the soil by the wall, m/s2 */
    double velocity_gradient[9 * ASSEMBLY_MAX]; /* the wall's part, 1/s */
    double density_rate[ASSEMBLY_MAX];          /* the wall's part, kg/m3/s */
} floor_case;

/** Volume of a particle, m3 (m2). */
static inline double floor_cell(int dimension)
{
    return pow(ASSEMBLY_SPACING, dimension);
}

/** Fills in the points of the floor, centered below the origin. */
static inline void floor_fill(floor_case *f, int dimension)
{
    f->n_points = 0;
    f->presses_only = false;
    for (int x = 0; x < FLOOR_SIDE; ++x) {
        for (int y = 0; y < (dimension == 3 ? FLOOR_SIDE : 1); ++y) {
            for (int layer = 0; layer < FLOOR_LAYERS; ++layer) {
                double *point = f->points + 3 * f->n_points++;
                const double depth = -ASSEMBLY_SPACING * (layer + 0.5);
                point[0] = ASSEMBLY_SPACING * (x - FLOOR_SIDE / 2);
                point[1] = dimension == 3 ? ASSEMBLY_SPACING * (y - FLOOR_SIDE / 2) : depth;
                point[2] = dimension == 3 ? depth : 0.0;
            }
        }
    }
}

/** The floor as it is at rest and with uniform stress. */
static inline mor_wall_request floor_request(const floor_case *f, mor_wall_friction friction, double coefficient)
{
    return (mor_wall_request){.name = "floor",
                              .points = f->points,
                              .n_points = f->n_points,
                              .point_volume = floor_cell(f->soil.constants.dimension),
                              .friction = friction,
                              .friction_coefficient = coefficient,
                              .dimension = f->soil.constants.dimension,
                              .stress = MOR_WALL_STRESS_UNIFORM};
}

/** Makes the wall, in place of the one that was there. */
static inline void floor_add(floor_case *f, const mor_wall_request *request)
{
    mor_soil_contact_clear(&f->soil.context, &f->wall);
    assert_int_equal(mor_soil_contact_init(&f->soil.context, &f->wall, request, NULL, f->soil.tree.n_clusters), MOR_OK);
}

/** Puts the floor below the soil, which is open. */
static inline void floor_open(floor_case *f, mor_wall_friction friction, double coefficient)
{
    memset(&f->wall, 0, sizeof f->wall);
    floor_fill(f, f->soil.constants.dimension);
    const mor_wall_request request = floor_request(f, friction, coefficient);
    floor_add(f, &request);
}

/** One particle above the middle of the floor. */
static inline void floor_open_single(floor_case *f, int dimension, mor_wall_friction friction, double coefficient)
{
    double point[3] = {0.0, 0.0, 0.0};
    point[dimension - 1] = FLOOR_HEIGHT;
    assembly_open(&f->soil, dimension, point, 1);
    floor_open(f, friction, coefficient);
}

static inline void floor_close(floor_case *f)
{
    mor_soil_contact_clear(&f->soil.context, &f->wall);
    assembly_close(&f->soil);
}

/** Record of the first particle, which may be changed. */
static inline double *floor_record(floor_case *f)
{
    return f->soil.records;
}

/** The soil as the wall sees it. */
static inline mor_contact_soil floor_soil(const floor_case *f, mor_dissipation dissipation)
{
    static const double rest[6 * ASSEMBLY_MAX];
    return (mor_contact_soil){
        .coulomb_pulls = !f->presses_only,
        .dissipation = dissipation,
        .limiter_rate = f->soil.constants.limiter_rate,
        .records = f->soil.records,
        .strain_rate = f->presses_only ? rest : NULL,
        .length = f->presses_only ? 1.0 : 0.0, /* so long that what sticks in it may load next to nothing */
        .n_particles = f->soil.n};
}

/** Gives the first particle a stress with a normal and a shear traction on the floor, Pa; other components are not
 *  zero either. */
static inline void floor_set_stress(floor_case *f, double normal, double shear)
{
    double *stress = floor_record(f) + MOR_RECORD_STRESS;
    memset(stress, 0, 6 * sizeof *stress);
    stress[MOR_XX] = -3e3;
    if (f->soil.constants.dimension == 3) {
        stress[MOR_YY] = -2e3;
        stress[MOR_ZZ] = normal;
        stress[MOR_ZX] = 0.8 * shear;
        stress[MOR_YZ] = -0.6 * shear;
    } else {
        stress[MOR_YY] = normal;
        stress[MOR_ZZ] = -2e3;
        stress[MOR_XY] = shear;
    }
    memset(floor_record(f) + MOR_RECORD_VELOCITY, 0, 3 * sizeof(double));
}

/** The wall's work in one step, after the lists have been made anew. */
static inline void floor_run(floor_case *f, mor_dissipation dissipation)
{
    mor_context *context = &f->soil.context;
    const mor_pair_table *table = mor_pair_select(NULL);
    const mor_pair_constants *constants = &f->soil.constants;
    assembly_list(&f->soil, 0.0);
    memset(f->acceleration, 0, sizeof f->acceleration);
    memset(f->velocity_gradient, 0, sizeof f->velocity_gradient);
    memset(f->density_rate, 0, sizeof f->density_rate);
    const mor_relation_points points = {&f->soil.tree, f->soil.records, MOR_RECORD_SIZE};
    const double reach = MOR_KERNEL_SUPPORT * constants->smoothing_length;
    assert_int_equal(mor_soil_contact_build(context, &f->wall, &points, reach), MOR_OK);
    mor_soil_contact_sum(context, &f->wall, table, constants, f->soil.records);
    if (f->wall.normals != NULL) {
        mor_wall_clusters at = {.has_corners = true};
        assert_int_equal(mor_wall_clusters_init(context, &at, f->soil.tree.n_clusters), MOR_OK);
        mor_wall_clusters_begin(&at, f->soil.tree.n_clusters);
        mor_wall_clusters_count(&at, &f->wall);
        assert_int_equal(mor_wall_clusters_end(context, &at, f->soil.tree.n_clusters), MOR_OK);
        const mor_wall_clusters seen = {.places = at.places, .corners = at.corners}; /* all are solved at the end */
        mor_soil_contact_project(context, &f->wall, f->soil.n, !f->presses_only, &seen);
        mor_soil_contact_solve_corners(context, f->soil.n, NULL, &seen);
        mor_soil_contact_close_corners(context, &f->wall, f->soil.n, &seen);
        mor_wall_clusters_clear(context, &at);
        mor_soil_contact_hold(context, &f->wall, constants->smoothing_length, f->soil.n);
    }
    mor_soil_contact_sum_divergence(context, &f->wall, table, constants, f->soil.records, &f->soil.relation, NULL);
    const mor_contact_soil seen = floor_soil(f, dissipation);
    mor_soil_contact_sum_forces(context, &f->wall, &seen, f->acceleration);
    const mor_contact_rates rates = {.velocity_gradient = f->velocity_gradient, .density_rate = f->density_rate};
    mor_soil_contact_sum_gradient(context, &f->wall, &seen, &rates);
}

/** Kernel gradient over the floor at a place, shape [3], m; out in 1/m. It points into the wall, against eq. 33. */
static inline void floor_gradient(const floor_case *f, const double *place, double *gradient)
{
    const int dimension = f->soil.constants.dimension;
    memset(gradient, 0, 3 * sizeof *gradient);
    for (int j = 0; j < f->n_points; ++j) {
        double r[3];
        for (int a = 0; a < 3; ++a) {
            r[a] = place[a] - f->points[3 * j + a];
        }
        const double distance = mor_vector_length(r);
        const double slope = mor_kernel_derivative(distance, f->soil.constants.smoothing_length, dimension);
        for (int a = 0; a < 3; ++a) {
            gradient[a] += floor_cell(dimension) * slope * r[a] / distance;
        }
    }
}

/** Compares two vectors, shape [3], that are sums of a few dozen terms of a size, in the unit of the vectors. */
static inline void floor_assert_vector(const double *value, const double *expected, double size)
{
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(value[a] - expected[a]) <= 256 * DBL_EPSILON * size); /* some ulp of each term */
    }
}

#endif
