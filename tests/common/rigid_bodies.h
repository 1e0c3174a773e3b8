/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_RIGID_BODIES_H
#define MOR_TESTS_COMMON_RIGID_BODIES_H

#include "bodies/rigid/rigid.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "core/time/schedule.h"
#include "tests/common/cloud.h"

/** @file
 *  Rigid boxes for tests, and a leader that stands in for the soil: it sets the common step and pushes points. */

enum { RIGID_BODIES = 4, RIGID_POINTS = 4096 };

/** One box. Lengths in spacings until rigid_open multiplies them. */
typedef struct rigid_box {
    int sides[3];       /* particles along each side */
    double place[3];    /* of the center, in spacings */
    double density;     /* kg/m3 */
    double velocity[3]; /* m/s */
    double spin[3];     /* rad/s */
    mor_rigid_motion motion;
} rigid_box;

/** A group of boxes with its clock. The units stretch all numbers: for tests of unit changes. */
typedef struct rigid_scene {
    mor_context context;
    mor_rigid rigid;
    mor_schedule schedule;
    mor_shape *shapes[RIGID_BODIES];
    double points[3 * RIGID_POINTS]; /* shape [n, 3], m */
    double common_step;              /* what the leader proposes, s */
    double push[3];                  /* on particle pushed, N */
    int64_t pushed;                  /* particle; -1: none */
    double given_moment[3];          /* angular impulse given by the leader about the origin, N m s */
} rigid_scene;

/** Units of length [m], mass [kg] and time [s] for a scene. */
typedef struct rigid_units {
    double length, mass, time;
} rigid_units;

/** Unit of a body's mass: kg, in plane strain kg/m. */
static inline double rigid_mass_unit(const rigid_units *units, int dimension)
{
    return dimension == 3 ? units->mass : units->mass / units->length;
}

static inline mor_status rigid_propose(mor_context *context, void *owner, double *step_length, const char **limit)
{
    (void)context;
    *step_length = ((rigid_scene *)owner)->common_step;
    *limit = "the leader";
    return MOR_OK;
}

/** The push of the soil: a force on one point where the leader sees it. */
static inline mor_status rigid_push(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    rigid_scene *it = owner;
    (void)context;
    if (it->pushed >= 0) {
        const double *x = it->rigid.group.boundary.records + it->pushed * MOR_BOUNDARY_RECORD;
        memcpy(it->rigid.group.boundary.force + 3 * it->pushed, it->push, sizeof it->push);
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            it->given_moment[a] += step->length * (x[b] * it->push[c] - x[c] * it->push[b]);
        }
    }
    return MOR_OK;
}

/** Mass properties of a box about the origin, from its corners, shape [3] each; unit m. */
static inline void rigid_geometry(const double *low, const double *high, int dimension, mor_shape_moments *geometry)
{
    *geometry = (mor_shape_moments){.volume = 1.0};
    for (int a = 0; a < dimension; ++a) {
        geometry->volume *= high[a] - low[a];
    }
    for (int a = 0; a < dimension; ++a) {
        const double side = high[a] - low[a];
        for (int b = 0; b < 3; ++b) {
            geometry->inertia[b] += b != a ? geometry->volume * side * side / 12.0 : 0.0;
        }
    }
}

/** Fills in the request of a box: lattice points and true mass. */
static inline void rigid_request(rigid_scene *it, const rigid_box *box, int b, int dimension, double spacing,
                                 const rigid_units *units, double *points, mor_body_request *request)
{
    static const char *const names[RIGID_BODIES] = {"first", "second", "third", "fourth"};
    const double speed = units->length / units->time;
    const int layers = dimension == 3 ? box->sides[2] : 1;
    double low[3];
    double high[3];
    *request = (mor_body_request){.name = names[b],
                                  .positions = points,
                                  .density = box->density * units->mass / pow(units->length, 3.0),
                                  .contact_modulus = 1e6 * units->mass / (units->length * units->time * units->time)};
    for (int a = 0; a < 3; ++a) {
        high[a] = 0.5 * spacing * (a < dimension ? box->sides[a] : 2);
        low[a] = -high[a];
        request->shape_rotation[4 * a] = 1.0;
        request->shape_translation[a] = box->place[a] * spacing;
        request->velocity[a] = box->velocity[a] * speed;
        request->angular_velocity[a] = box->spin[a] / units->time;
    }
    for (int i = 0; i < box->sides[0] * box->sides[1] * layers; ++i) {
        const int index[3] = {i % box->sides[0], i / box->sides[0] % box->sides[1], i / box->sides[0] / box->sides[1]};
        for (int a = 0; a < 3; ++a) {
            const double offset = a < dimension ? index[a] + 0.5 - 0.5 * box->sides[a] : 0.0;
            points[3 * request->n_particles + a] = spacing * (box->place[a] + offset);
        }
        request->n_particles++;
    }
    assert_int_equal(mor_shape_new_box(&it->context, low, high, &it->shapes[b]), MOR_OK);
    request->shape = it->shapes[b];
    rigid_geometry(low, high, dimension, &request->geometry);
    mor_shape_moments_place(&request->geometry, request->shape_rotation, request->shape_translation);
}

/** Puts the spring and the prescribed motion of a box into units. */
static inline mor_rigid_motion rigid_motion_in(const mor_rigid_motion *motion, double spacing, const rigid_units *units,
                                               double mass)
{
    mor_rigid_motion scaled = *motion;
    for (int a = 0; a < 3; ++a) {
        scaled.velocity[a] *= units->length / units->time;
        scaled.angular_velocity[a] /= units->time;
        scaled.spring_point[a] *= spacing;
        scaled.spring_anchor[a] *= spacing;
    }
    scaled.spring_length *= spacing;
    scaled.spring_stiffness *= mass / (units->time * units->time);
    scaled.spring_damping *= mass / units->time;
    return scaled;
}

/** Makes a scene without a schedule and returns what mor_rigid_init says. */
static inline mor_status rigid_make(rigid_scene *it, const rigid_box *boxes, int n, int dimension, double spacing,
                                    const rigid_units *units)
{
    mor_body_request requests[RIGID_BODIES];
    mor_rigid_motion motions[RIGID_BODIES];
    int64_t n_points = 0;
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    for (int b = 0; b < n; ++b) {
        rigid_request(it, &boxes[b], b, dimension, spacing * units->length, units, it->points + 3 * n_points,
                      &requests[b]);
        motions[b] =
            rigid_motion_in(&boxes[b].motion, spacing * units->length, units, rigid_mass_unit(units, dimension));
        n_points += requests[b].n_particles;
        assert_true(n_points <= RIGID_POINTS);
    }
    it->pushed = -1;
    return mor_rigid_init(&it->context, &it->rigid, "rocks", dimension, spacing * units->length, requests, motions, n);
}

/** Makes a scene that takes common steps of a length [s] until an end [s]. */
static inline rigid_scene *rigid_open_in(const rigid_box *boxes, int n, int dimension, double spacing,
                                         double common_step, double end, const rigid_units *units)
{
    static const mor_stepper_operations operations = {.kind = "leader", .propose = rigid_propose};
    static const mor_stage stages[] = {{"push", rigid_push, 0, 0, 0, "pushes a point", NULL}};
    rigid_scene *it = malloc(sizeof *it);
    assert_non_null(it);
    assert_int_equal(rigid_make(it, boxes, n, dimension, spacing, units), MOR_OK);
    const mor_stepper leader = {.name = "leader",
                                .operations = &operations,
                                .owner = it,
                                .stages = stages,
                                .n_stages = 1,
                                .n_before = 1,
                                .is_leader = true};
    mor_stepper follower;
    uint64_t evolving = 0;
    it->common_step = common_step * units->time;
    assert_int_equal(mor_schedule_init(&it->context, &it->schedule, end * units->time), MOR_OK);
    assert_int_equal(mor_schedule_add(&it->context, &it->schedule, &leader, 0), MOR_OK);
    mor_rigid_stepper(&it->rigid, &follower, &evolving);
    assert_int_equal(mor_schedule_add(&it->context, &it->schedule, &follower, evolving), MOR_OK);
    return it;
}

/** As rigid_open_in, in meters, kilograms and seconds. */
static inline rigid_scene *rigid_open(const rigid_box *boxes, int n, int dimension, double spacing, double common_step,
                                      double end)
{
    const rigid_units units = {1.0, 1.0, 1.0};
    return rigid_open_in(boxes, n, dimension, spacing, common_step, end, &units);
}

/** Steps to a time [s]. */
static inline void rigid_run(rigid_scene *it, double time)
{
    const int64_t until = mor_schedule_ticks(&it->schedule, time);
    while (it->schedule.now < until) {
        if (mor_schedule_step(&it->context, &it->schedule, until) != MOR_OK) {
            fail_msg("%s", it->context.message);
        }
    }
}

/** Frees what rigid_make took. */
static inline void rigid_drop(rigid_scene *it)
{
    mor_rigid_clear(&it->context, &it->rigid);
    for (int b = 0; b < RIGID_BODIES; ++b) {
        mor_shape_free(&it->context, &it->shapes[b]);
    }
    assert_int_equal(it->context.memory_bytes, 0);
}

static inline void rigid_close(rigid_scene *it)
{
    rigid_drop(it);
    free(it);
}

#endif
