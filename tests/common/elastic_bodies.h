/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_ELASTIC_BODIES_H
#define MOR_TESTS_COMMON_ELASTIC_BODIES_H

#include "bodies/elastic/elastic.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/checked.h"
#include "core/time/schedule.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  Small elastic bodies for tests: boxes and balls of particles on a lattice, turned and moved at will, without a case.
 *  Whatever goes wrong fails the running test with the library's message. */

enum { ELASTIC_BODIES_MAX = 4 };

/** One body. */
typedef struct elastic_piece {
    bool is_ball;               /* a ball (disc) in the box */
    double side[3];             /* of the box, m */
    double axis[3], angle;      /* of the turn about the middle; axis of length 1; rad */
    double middle[3];           /* m */
    double velocity[3];         /* m/s */
    double angular_velocity[3]; /* rad/s */
} elastic_piece;

/** What a scene is made from. Borrowed. */
typedef struct elastic_request {
    int dimension;
    double spacing; /* m */
    double jitter;  /* of the lattice, in spacings, 1 */
    const elastic_piece *pieces;
    int n_pieces;
    double youngs, poisson, density; /* Pa, 1, kg/m3 */
    mor_scheme settings;
    int n_threads; /* 0: one */
    double end;    /* longest time that will be asked for, s */
} elastic_request;

/** One scene. Owner: the test, which ends it with elastic_close. */
typedef struct elastic_bodies {
    mor_context context;
    mor_material_instance *material;
    mor_shape *shapes[ELASTIC_BODIES_MAX];
    mor_elastic elastic;
    mor_schedule schedule;
    mor_stepper stepper;
    uint64_t evolving;
} elastic_bodies;

static inline void elastic_require(const elastic_bodies *it, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

/** Places the lattice points of a piece, shape [n, 3], unit m; returns how many there are. NULL: only counts. */
static inline int64_t elastic_fill(const elastic_request *r, const elastic_piece *piece, const double *rotation,
                                   double *points)
{
    int64_t n = 0;
    int64_t counts[3];
    for (int a = 0; a < 3; ++a) {
        counts[a] = a < r->dimension ? (int64_t)llround(piece->side[a] / r->spacing) : 1;
    }
    for (int64_t k = 0; k < counts[0] * counts[1] * counts[2]; ++k) {
        const int64_t places[3] = {k / (counts[1] * counts[2]), k / counts[2] % counts[1], k % counts[2]};
        double x[3] = {0.0};
        double turned[3];
        double ratio2 = 0.0;
        for (int a = 0; a < r->dimension; ++a) {
            const double shift = r->jitter * (mor_random_uniform(1, (uint64_t)k, (uint64_t)a) - 0.5);
            x[a] = ((double)places[a] + 0.5 + shift) * r->spacing - 0.5 * piece->side[a];
            ratio2 += 4.0 * x[a] * x[a] / (piece->side[a] * piece->side[a]);
        }
        if (piece->is_ball && ratio2 > 1.0) {
            continue;
        }
        mor_matrix_apply(rotation, x, turned);
        for (int a = 0; a < 3 && points != NULL; ++a) {
            points[3 * n + a] = turned[a] + piece->middle[a];
        }
        ++n;
    }
    return n;
}

/** The shape of a piece about the origin. */
static inline void elastic_shape(elastic_bodies *it, const elastic_request *r, const elastic_piece *piece,
                                 mor_shape **shape)
{
    const double half[3] = {0.5 * piece->side[0], 0.5 * piece->side[1], 0.5 * piece->side[2]};
    const double low[3] = {-half[0], -half[1], r->dimension == 3 ? -half[2] : -INFINITY};
    const double high[3] = {half[0], half[1], r->dimension == 3 ? half[2] : INFINITY};
    const double origin[3] = {0.0};
    if (piece->is_ball && r->dimension == 3) {
        elastic_require(it, mor_shape_new_sphere(&it->context, origin, half[0], shape));
    } else if (piece->is_ball) {
        enum { CORNERS = 64 };
        double corners[2 * CORNERS];
        for (int k = 0; k < CORNERS; ++k) {
            corners[2 * k] = half[0] * cos(2.0 * MOR_PI * k / CORNERS);
            corners[2 * k + 1] = half[0] * sin(2.0 * MOR_PI * k / CORNERS);
        }
        elastic_require(it, mor_shape_new_polygon(&it->context, corners, CORNERS, shape));
    } else {
        elastic_require(it, mor_shape_new_box(&it->context, low, high, shape));
    }
}

/** Fills in one request; the points are the caller's to free. */
static inline void elastic_describe(elastic_bodies *it, const elastic_request *r, int b, mor_body_request *out,
                                    double **points)
{
    static const char *const names[ELASTIC_BODIES_MAX] = {"first", "second", "third", "fourth"};
    const elastic_piece *piece = &r->pieces[b];
    *out = (mor_body_request){.name = names[b], .density = r->density};
    if (piece->angle != 0.0) {
        mor_matrix_rotation(piece->axis, piece->angle, out->shape_rotation);
    } else {
        out->shape_rotation[0] = out->shape_rotation[4] = out->shape_rotation[8] = 1.0;
    }
    elastic_shape(it, r, piece, &it->shapes[b]);
    out->shape = it->shapes[b];
    memcpy(out->shape_translation, piece->middle, sizeof out->shape_translation);
    memcpy(out->geometry.center, piece->middle, sizeof out->geometry.center);
    memcpy(out->velocity, piece->velocity, sizeof out->velocity);
    memcpy(out->angular_velocity, piece->angular_velocity, sizeof out->angular_velocity);
    out->n_particles = elastic_fill(r, piece, out->shape_rotation, NULL);
    out->geometry.volume = (double)out->n_particles * r->spacing * r->spacing * (r->dimension == 3 ? r->spacing : 1.0);
    elastic_require(it, MOR_NEW(&it->context, points, 3 * out->n_particles, "particles of a test"));
    elastic_fill(r, piece, out->shape_rotation, *points);
    out->positions = *points;
}

static inline mor_status elastic_try_open(elastic_bodies *it, const elastic_request *r)
{
    mor_body_request bodies[ELASTIC_BODIES_MAX];
    double *points[ELASTIC_BODIES_MAX] = {NULL};
    const double parameters[2] = {r->youngs, r->poisson};
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    it->context.n_threads = r->n_threads > 0 ? r->n_threads : 1;
    elastic_require(it,
                    mor_material_create(&it->context, law_named("neo_hookean"), r->density, parameters, &it->material));
    elastic_require(it, mor_checked_wrap(&it->context, &it->material));
    for (int b = 0; b < r->n_pieces; ++b) {
        elastic_describe(it, r, b, &bodies[b], &points[b]);
    }
    const mor_status status = mor_elastic_init(&it->context, &it->elastic, "rocks", &r->settings, it->material,
                                               r->dimension, r->spacing, bodies, r->n_pieces);
    for (int b = 0; b < r->n_pieces; ++b) {
        MOR_FREE(&it->context, &points[b]);
    }
    if (status == MOR_OK) {
        mor_elastic_stepper(&it->elastic, &it->stepper, &it->evolving);
        elastic_require(it, mor_schedule_init(&it->context, &it->schedule, r->end > 0.0 ? r->end : 1.0));
        elastic_require(it, mor_schedule_add(&it->context, &it->schedule, &it->stepper, it->evolving));
    }
    return status;
}

static inline void elastic_open(elastic_bodies *it, const elastic_request *r)
{
    elastic_require(it, elastic_try_open(it, r));
}

static inline void elastic_close(elastic_bodies *it)
{
    mor_elastic_clear(&it->context, &it->elastic);
    for (int b = 0; b < ELASTIC_BODIES_MAX; ++b) {
        if (it->shapes[b] != NULL) {
            it->shapes[b]->operations->free(&it->context, it->shapes[b]);
        }
    }
    mor_material_destroy(&it->context, &it->material);
    assert_int_equal(it->context.memory_bytes, 0);
}

/** Takes a number of steps. */
static inline void elastic_steps(elastic_bodies *it, int n_steps)
{
    for (int k = 0; k < n_steps; ++k) {
        elastic_require(it, mor_schedule_step(&it->context, &it->schedule, it->schedule.end));
    }
}

/** Takes steps until a time, unit s. */
static inline void elastic_run(elastic_bodies *it, double time)
{
    const int64_t until = mor_schedule_ticks(&it->schedule, time);
    while (it->schedule.now < until) {
        elastic_require(it, mor_schedule_step(&it->context, &it->schedule, until));
    }
}

/** Kinetic energy of all bodies, unit J (J/m), and their momenta: momentum shape [3], kg m/s; angular momentum about
 *  the origin shape [3], kg m2/s. */
static inline double elastic_momenta(const elastic_bodies *it, double *momentum, double *angular)
{
    double energy = 0.0;
    memset(momentum, 0, 3 * sizeof *momentum);
    memset(angular, 0, 3 * sizeof *angular);
    for (int b = 0; b < it->elastic.group.n_bodies; ++b) {
        double p[3];
        double l[3];
        energy += mor_body_group_momentum(&it->elastic.group, b, p, l);
        for (int a = 0; a < 3; ++a) {
            momentum[a] += p[a];
            angular[a] += l[a];
        }
    }
    return energy;
}

#endif
