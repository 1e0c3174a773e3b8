/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_BODY_SCENE_H
#define MOR_TESTS_COMMON_BODY_SCENE_H

#include "bodies/elastic/elastic.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "core/material/checked.h"
#include "core/time/schedule.h"
#include "materials/frame/hooke.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  One elastic body made of boxes, with its clock, for tests that need no case. Whatever goes wrong fails the running
 *  test with the library's message. */

enum { BODY_SCENE_BOXES_MAX = 4 };

/** What a scene is made from. Borrowed. */
typedef struct body_scene_request {
    int dimension;                /* 2: plane strain in x, y; 3 */
    double spacing;               /* m; the lattice has a particle at half a spacing from the origin */
    const double (*boxes)[6];     /* shape [n_boxes, 6]; lowest and highest corner, m; z is ignored in plane strain */
    int n_boxes;                  /* they overlap, or there is one */
    const mor_material *material; /* NULL: neo_hookean */
    double youngs, poisson;       /* Pa, 1 */
    double density;               /* kg/m3 */
    double end;                   /* longest time that will be asked for, s */
    mor_scheme settings;          /* zeros: body_smoothing_ratio 1.15, body_courant 0.4, body_damping 1, hourglass 0 */
    int n_threads;                /* 0: one */
} body_scene_request;

/** One scene. Owner: the test, which ends it with body_scene_close. */
typedef struct body_scene {
    mor_context context;
    mor_material_instance *material;
    mor_shape *shape;
    mor_elastic elastic;
    mor_schedule schedule;
    mor_stepper stepper;
} body_scene;

static inline void body_scene_require(const body_scene *it, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

/** Fails the running test unless found is within tolerance of expected, all in one unit; what is zero-terminated. */
static inline void body_scene_expect(const char *what, double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s is %.9g, not %.9g within %.3g", what, found, expected, tolerance);
    }
}

static inline void body_scene_make_shape(body_scene *it, const body_scene_request *request)
{
    mor_shape *parts[BODY_SCENE_BOXES_MAX] = {NULL};
    assert_true(request->n_boxes >= 1 && request->n_boxes <= BODY_SCENE_BOXES_MAX);
    for (int k = 0; k < request->n_boxes; ++k) {
        double corner[6];
        memcpy(corner, request->boxes[k], sizeof corner);
        corner[2] = request->dimension == 2 ? -INFINITY : corner[2];
        corner[5] = request->dimension == 2 ? INFINITY : corner[5];
        body_scene_require(it, mor_shape_new_box(&it->context, corner, corner + 3, &parts[k]));
    }
    if (request->n_boxes == 1) {
        it->shape = parts[0];
        return;
    }
    body_scene_require(it, mor_shape_new_union(&it->context, parts, request->n_boxes, &it->shape));
}

/** Lattice points inside the shape, shape [n, 3], unit m; the caller frees them. */
static inline double *body_scene_fill(const body_scene *it, const body_scene_request *request, int64_t *n)
{
    mor_bounds bounds;
    mor_shape_bounds(it->shape, &bounds);
    int64_t low[3] = {0, 0, 0};
    int64_t high[3] = {0, 0, 0};
    int64_t room = 1;
    for (int a = 0; a < request->dimension; ++a) {
        low[a] = (int64_t)floor(bounds.minimum[a] / request->spacing - 0.5);
        high[a] = (int64_t)ceil(bounds.maximum[a] / request->spacing + 0.5);
        room *= high[a] - low[a] + 1;
    }
    double *points = calloc((size_t)(3 * room), sizeof *points);
    assert_non_null(points);
    *n = 0;
    for (int64_t i = low[0]; i <= high[0]; ++i) {
        for (int64_t j = low[1]; j <= high[1]; ++j) {
            for (int64_t k = low[2]; k <= high[2]; ++k) {
                const int64_t place[3] = {i, j, k};
                double *point = points + 3 * *n;
                for (int a = 0; a < 3; ++a) {
                    point[a] = a < request->dimension ? ((double)place[a] + 0.5) * request->spacing : 0.0;
                }
                *n += mor_shape_distance(it->shape, point) < 0.0;
            }
        }
    }
    return points;
}

static inline mor_scheme body_scene_settings(const body_scene_request *request)
{
    const mor_scheme source = {
        .body_smoothing_ratio = 1.15, .body_courant = 0.4, .body_damping = 1.0, .hourglass = 0.0};
    return request->settings.body_courant > 0.0 ? request->settings : source;
}

/** Makes the body at rest; velocities, held particles and gravity may be set before body_scene_start. */
static inline void body_scene_open(body_scene *it, const body_scene_request *request)
{
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    it->context.n_threads = request->n_threads > 0 ? request->n_threads : 1;
    const double values[MOR_HOOKE_COUNT] = {request->youngs, request->poisson};
    const mor_material *model = request->material != NULL ? request->material : law_named("neo_hookean");
    body_scene_require(it, mor_material_create(&it->context, model, request->density, values, &it->material));
    body_scene_require(it, mor_checked_wrap(&it->context, &it->material));
    body_scene_make_shape(it, request);
    mor_body_request body = {.name = "body",
                             .shape = it->shape,
                             .shape_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                             .density = request->density,
                             .soil_friction = MOR_WALL_ROUGH,
                             .contact_modulus = request->youngs};
    body_scene_require(it, mor_shape_find_moments(&it->context, it->shape, request->dimension, &body.geometry));
    double *points = body_scene_fill(it, request, &body.n_particles);
    body.positions = points;
    const mor_scheme settings = body_scene_settings(request);
    body_scene_require(it, mor_elastic_init(&it->context, &it->elastic, "rock", &settings, it->material,
                                            request->dimension, request->spacing, &body, 1));
    free(points);
    for (int a = 0; a < 3; ++a) {
        it->elastic.group.domain_minimum[a] = -INFINITY;
        it->elastic.group.domain_maximum[a] = INFINITY;
    }
    body_scene_require(it, mor_schedule_init(&it->context, &it->schedule, request->end));
}

/** Makes the body ready to move; once, before the first step. */
static inline void body_scene_start(body_scene *it)
{
    uint64_t evolving = 0;
    body_scene_require(it, mor_elastic_prepare(&it->context, &it->elastic));
    mor_elastic_stepper(&it->elastic, &it->stepper, &evolving);
    body_scene_require(it, mor_schedule_add(&it->context, &it->schedule, &it->stepper, evolving));
}

/** Ends a scene; fails when it left memory behind. */
static inline void body_scene_close(body_scene *it)
{
    mor_elastic_clear(&it->context, &it->elastic);
    mor_shape_free(&it->context, &it->shape);
    mor_material_destroy(&it->context, &it->material);
    assert_int_equal(it->context.memory_bytes, 0);
}

/** Takes one step, not beyond a time [s]. */
static inline void body_scene_step(body_scene *it, double until)
{
    body_scene_require(it, mor_schedule_step(&it->context, &it->schedule, mor_schedule_ticks(&it->schedule, until)));
}

/** Present time, s. */
static inline double body_scene_time(const body_scene *it)
{
    return mor_schedule_time(&it->schedule);
}

/** Takes steps until a time, s. */
static inline void body_scene_run(body_scene *it, double until)
{
    while (it->schedule.now < mor_schedule_ticks(&it->schedule, until)) {
        body_scene_step(it, until);
    }
}

/** Particles of the body. */
static inline int64_t body_scene_count(const body_scene *it)
{
    return it->elastic.group.set.n_particles;
}

/** Reference positions, shape [n, 3], m. */
static inline const double *body_scene_reference(const body_scene *it)
{
    return it->elastic.group.reference;
}

/** Present positions, shape [n, 3], m. */
static inline double *body_scene_positions(const body_scene *it)
{
    return it->elastic.group.set.data[MOR_FIELD_POSITION];
}

/** Velocities, shape [n, 3], m/s. */
static inline double *body_scene_velocities(const body_scene *it)
{
    return it->elastic.group.set.data[MOR_FIELD_VELOCITY];
}

/** Kinetic energy, strain energy, and what damping took, J (J/m). */
static inline double body_scene_energy(const body_scene *it, double *kinetic)
{
    double momentum[3];
    double angular[3];
    *kinetic = mor_body_group_momentum(&it->elastic.group, 0, momentum, angular);
    return *kinetic + mor_elastic_energy(&it->elastic, -1) + it->elastic.damped_energy;
}

/** Mean displacement along an axis of the particles whose reference position lies in a box, m; shape [6] of the box. */
static inline double body_scene_displacement(const body_scene *it, const double *box, int axis)
{
    const double *x0 = body_scene_reference(it);
    const double *x = body_scene_positions(it);
    double sum = 0.0;
    int64_t n = 0;
    for (int64_t i = 0; i < body_scene_count(it); ++i) {
        bool is_inside = true;
        for (int a = 0; a < 3; ++a) {
            is_inside = is_inside && x0[3 * i + a] > box[a] && x0[3 * i + a] < box[3 + a];
        }
        if (is_inside) {
            sum += x[3 * i + axis] - x0[3 * i + axis];
            ++n;
        }
    }
    assert_true(n > 0);
    return sum / (double)n;
}

/** Watches a signal pass zero. */
typedef struct body_scene_watch {
    double time, value; /* of the last sample, s and any unit */
    int n_samples;
    int n_crossings;
    double last_crossing; /* by interpolation, s */
    double largest;       /* magnitude so far, unit of the value */
} body_scene_watch;

/** Takes a sample: time [s] and value [any unit]. The zero at the start does not count. */
static inline void body_scene_sample(body_scene_watch *watch, double time, double value)
{
    if (watch->n_samples++ > 0 && watch->value * value < 0.0) {
        watch->last_crossing = watch->time + (time - watch->time) * watch->value / (watch->value - value);
        watch->n_crossings += 1;
    }
    watch->time = time;
    watch->value = value;
    watch->largest = fabs(value) > watch->largest ? fabs(value) : watch->largest;
}

#endif
