/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_ROCK_SCENE_H
#define MOR_TESTS_COMMON_ROCK_SCENE_H

#include "core/base/math.h"
#include "core/material/checked.h"
#include "core/sph/boundary/soil_contact.h"
#include "core/sph/soil.h"
#include "core/time/schedule.h"
#include "materials/drucker_prager.h"
#include "tests/common/cloud.h"
#include "tests/common/laws.h"
#include "tests/common/rock.h"

#include <math.h>

/** @file
 *  Soil of boxes on a lattice, rigid rocks and walls on one schedule, for tests of the coupling as a whole. */

enum { ROCK_SCENE_POINTS_MAX = 20000 };

/** The stiffness of a barrier with which a particle of a mass, kg (kg/m), at a fifth of the radius needs no shorter
 *  step than sound of a speed, m/s, at a spacing, m, Jiang et al. (2022) eqs. 26, 27; N/m (N/m2). */
static inline double rock_scene_barrier_stiffness(double mass, double spacing, double speed)
{
    const mor_soil_barrier unit = {true, 1.0, 1.0};
    const double rate = 2.0 * MOR_PI * speed / spacing;
    return mass * rate * rate / mor_soil_barrier_slope(&unit, 0.2);
}

/** Soil, rocks and time. Owner: the test, which ends it with rock_scene_close. */
typedef struct rock_scene {
    mor_context context;
    mor_material_instance *sand;
    mor_soil_settings settings;                  /* to be changed before rock_scene_build */
    double parameters[MOR_DRUCKER_PRAGER_COUNT]; /* likewise */
    const mor_material *law;                     /* likewise, of the soil; NULL: Drucker-Prager */
    const double *law_parameters;                /* of that law; borrowed */
    mor_soil soil;
    rock_pile pile; /* rocks are filled in before rock_scene_build */
    mor_schedule schedule;
    double *points; /* shape [n_points, 3], m */
    int64_t n_points;
    double velocity[3];     /* of the soil at the start, m/s */
    mor_wall_stress stress; /* that the soil sees in rocks */
} rock_scene;

/** Fails the running test with the library's message unless a call went well. */
static inline void rock_scene_require(const rock_scene *it, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

/** Begins a scene without gravity: loose sand that is held together by a little cohesion. */
static inline void rock_scene_open(rock_scene *it, int dimension, double spacing, int n_threads)
{
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    it->context.n_threads = n_threads;
    it->settings = (mor_soil_settings){.scheme = {.smoothing_ratio = 1.3,
                                                  .courant = 0.3,
                                                  .dissipation = MOR_DISSIPATION_SEPARATION,
                                                  .wall_dissipation = MOR_DISSIPATION_BOTH,
                                                  .dissipation_factor = 20.0 * dimension,
                                                  .lattice_normalization = true,
                                                  .skin_ratio = 0.25,
                                                  .sort_interval = 40},
                                       .reference_density = 1600.0,
                                       .dimension = dimension,
                                       .spacing = spacing,
                                       .lateral_ratio = 0.5};
    for (int a = 0; a < 3; ++a) {
        it->settings.domain_minimum[a] = -1000.0 * spacing;
        it->settings.domain_maximum[a] = 1000.0 * spacing;
    }
    const double parameters[MOR_DRUCKER_PRAGER_COUNT] = {1e6, 0.3, 0.5, 1000.0, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN,
                                                         1.0};
    memcpy(it->parameters, parameters, sizeof parameters);
    it->pile.dimension = dimension;
    it->pile.spacing = spacing;
    it->pile.step = 1e300;
    it->stress = MOR_WALL_STRESS_UNIFORM;
    rock_scene_require(it, MOR_NEW(&it->context, &it->points, 3 * (int64_t)ROCK_SCENE_POINTS_MAX, "points of a scene"));
}

/** Adds a box of soil: lowest corner, shape [3], in m, and particles along each axis, shape [3]. */
static inline void rock_scene_add_soil(rock_scene *it, const double *corner, const int *sides)
{
    const double dp = it->settings.spacing;
    const int n_z = it->settings.dimension == 3 ? sides[2] : 1;
    for (int z = 0; z < n_z; ++z) {
        for (int y = 0; y < sides[1]; ++y) {
            for (int x = 0; x < sides[0]; ++x) {
                assert_true(it->n_points < ROCK_SCENE_POINTS_MAX);
                double *point = it->points + 3 * it->n_points++;
                point[0] = corner[0] + dp * (x + 0.5);
                point[1] = corner[1] + dp * (y + 0.5);
                point[2] = it->settings.dimension == 3 ? corner[2] + dp * (z + 0.5) : 0.0;
            }
        }
    }
}

/** Takes away the soil within a distance, unit m, of a box: center and half sides, shape [3] each, in m. */
static inline void rock_scene_dig(rock_scene *it, const double *center, const double *half)
{
    int64_t n = 0;
    for (int64_t i = 0; i < it->n_points; ++i) {
        bool is_inside = true;
        for (int a = 0; a < it->settings.dimension; ++a) {
            is_inside = is_inside && fabs(it->points[3 * i + a] - center[a]) < half[a];
        }
        if (!is_inside) {
            memmove(it->points + 3 * n++, it->points + 3 * i, 3 * sizeof(double));
        }
    }
    it->n_points = n;
}

/** Makes the soil from what was added. Walls may be added after this. */
static inline void rock_scene_build(rock_scene *it)
{
    const double dp = it->settings.spacing;
    const double volume = it->settings.dimension == 3 ? dp * dp * dp : dp * dp;
    const double density = it->settings.reference_density;
    const mor_material *law = it->law != NULL ? it->law : law_named("drucker_prager");
    const double *parameters = it->law != NULL ? it->law_parameters : it->parameters;
    rock_scene_require(it, mor_material_create(&it->context, law, density, parameters, &it->sand));
    rock_scene_require(it, mor_checked_wrap(&it->context, &it->sand));
    rock_scene_require(it, mor_soil_init(&it->context, &it->soil, "sand", &it->settings, it->sand, it->n_points));
    double *const *data = it->soil.set.data;
    memcpy(data[MOR_FIELD_POSITION], it->points, (size_t)(3 * it->n_points) * sizeof(double));
    for (int64_t i = 0; i < it->n_points; ++i) {
        memcpy(data[MOR_FIELD_VELOCITY] + 3 * i, it->velocity, sizeof it->velocity);
        data[MOR_FIELD_MASS][i] = density * volume;
        data[MOR_FIELD_DENSITY][i] = density;
    }
    it->soil.largest_speed = mor_vector_length(it->velocity);
    if (it->pile.n_rocks > 0) {
        rock_open(&it->context, &it->pile, "rocks");
        rock_scene_require(it, mor_soil_add_boundary(&it->context, &it->soil, &it->pile.boundary, it->stress));
    }
}

/** Adds a wall of lattice points: lowest corner, shape [3], in m, and points along each axis, shape [3]. */
static inline void rock_scene_add_wall(rock_scene *it, const char *name, const double *corner, const int *sides,
                                       mor_wall_friction friction, mor_wall_stress stress)
{
    const int64_t n_soil = it->n_points;
    rock_scene_add_soil(it, corner, sides);
    const double dp = it->settings.spacing;
    const mor_wall_request request = {.name = name,
                                      .points = it->points + 3 * n_soil,
                                      .n_points = it->n_points - n_soil,
                                      .point_volume = it->settings.dimension == 3 ? dp * dp * dp : dp * dp,
                                      .friction = friction,
                                      .dimension = it->settings.dimension,
                                      .stress = stress};
    rock_scene_require(it, mor_soil_add_wall(&it->context, &it->soil, &request));
    it->n_points = n_soil;
}

/** Ends the making: state of the material, order, clock of a length, unit s. */
static inline void rock_scene_start(rock_scene *it, double end)
{
    mor_stepper stepper;
    uint64_t evolving = 0;
    rock_scene_require(it, mor_soil_init_state(&it->context, &it->soil));
    mor_soil_sort(&it->context, &it->soil);
    rock_scene_require(it, mor_schedule_init(&it->context, &it->schedule, end));
    mor_soil_stepper(&it->soil, &stepper, &evolving);
    rock_scene_require(it, mor_schedule_add(&it->context, &it->schedule, &stepper, evolving));
    if (it->pile.n_rocks > 0) {
        stepper = rock_stepper(&it->pile);
        rock_scene_require(it, mor_schedule_add(&it->context, &it->schedule, &stepper, 0));
    }
}

static inline void rock_scene_close(rock_scene *it)
{
    mor_soil_clear(&it->context, &it->soil);
    rock_close(&it->context, &it->pile);
    mor_material_destroy(&it->context, &it->sand);
    MOR_FREE(&it->context, &it->points);
    assert_int_equal(it->context.memory_bytes, 0);
}

static inline void rock_scene_step(rock_scene *it)
{
    rock_scene_require(it, mor_schedule_step(&it->context, &it->schedule, it->schedule.end));
}

/** What is kept, of soil and rocks together. */
typedef struct rock_scene_sums {
    double momentum[3], angular[3]; /* kg m/s, kg m2/s about the origin */
    double kinetic, elastic;        /* J (J/m) */
    double momentum_size;           /* sum of magnitudes, kg m/s */
    double angular_size;            /* likewise, kg m2/s */
} rock_scene_sums;

static inline void rock_scene_add_motion(rock_scene_sums *sums, double mass, const double *place, const double *v)
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        sums->momentum[a] += mass * v[a];
        sums->angular[a] += mass * (place[b] * v[c] - place[c] * v[b]);
    }
    sums->momentum_size += mass * mor_vector_length(v);
    sums->angular_size += mass * mor_vector_length(v) * mor_vector_length(place);
    sums->kinetic += 0.5 * mass * mor_vector_dot(v, v);
}

static inline rock_scene_sums rock_scene_measure(const rock_scene *it)
{
    rock_scene_sums sums;
    memset(&sums, 0, sizeof sums);
    double *const *data = it->soil.set.data;
    const double young = it->parameters[MOR_DRUCKER_PRAGER_YOUNGS_MODULUS];
    const double poisson = it->parameters[MOR_DRUCKER_PRAGER_POISSONS_RATIO];
    const double shear = 0.5 * young / (1.0 + poisson);
    const double bulk = young / (3.0 * (1.0 - 2.0 * poisson));
    for (int64_t i = 0; i < it->soil.set.n_particles; ++i) {
        const double mass = data[MOR_FIELD_MASS][i];
        const double *s = data[MOR_FIELD_STRESS] + 6 * i;
        const double pressure = -mor_symmetric_trace(s) / 3.0;
        double j2 = s[MOR_XY] * s[MOR_XY] + s[MOR_YZ] * s[MOR_YZ] + s[MOR_ZX] * s[MOR_ZX];
        for (int a = 0; a < 3; ++a) {
            j2 += 0.5 * (s[a] + pressure) * (s[a] + pressure);
        }
        rock_scene_add_motion(&sums, mass, data[MOR_FIELD_POSITION] + 3 * i, data[MOR_FIELD_VELOCITY] + 3 * i);
        sums.elastic += mass / data[MOR_FIELD_DENSITY][i] * (0.5 * pressure * pressure / bulk + 0.5 * j2 / shear);
    }
    for (int r = 0; r < it->pile.n_rocks; ++r) {
        const rock *rk = &it->pile.rocks[r];
        rock_scene_add_motion(&sums, rk->mass, rk->center, rk->velocity);
        for (int a = 0; a < 3; ++a) {
            sums.angular[a] += rk->inertia * rk->spin[a];
        }
        sums.kinetic += 0.5 * rk->inertia * mor_vector_dot(rk->spin, rk->spin);
    }
    return sums;
}

#endif
