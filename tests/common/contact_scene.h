/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_CONTACT_SCENE_H
#define MOR_TESTS_COMMON_CONTACT_SCENE_H

#include "bodies/contact/contact.h"
#include "bodies/elastic/elastic.h"
#include "bodies/rigid/rigid.h"
#include "core/base/math.h"
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
 *  Boxes and balls, rigid or elastic, with plane walls, contact and a clock, for tests that need no case. Whatever goes
 *  wrong fails the running test with the library's message. */

enum { CONTACT_SCENE_BODIES_MAX = 8, CONTACT_SCENE_WALLS_MAX = 4, CONTACT_SCENE_GROUPS = 2 };

/** One body. Plain data. */
typedef struct contact_scene_body {
    const mor_body_operations *kind;
    double radius;              /* of a ball (2D: a disc), m; 0: a box */
    double half[3];             /* half the sides of a box, m */
    double position[3];         /* of the center, m */
    double axis[3], angle;      /* of the turn, 1 and rad */
    double velocity[3];         /* m/s */
    double angular_velocity[3]; /* rad/s */
    bool is_held;               /* rigid: moves as given, whatever pushes it */
    double density;             /* kg/m3; 0: that of the scene */
    double modulus;             /* of contact, Pa; 0: that of the scene */
} contact_scene_body;

/** A plane wall. */
typedef struct contact_scene_wall {
    double point[3];    /* m */
    double normal[3];   /* out of the solid, 1 */
    double velocity[3]; /* m/s */
} contact_scene_wall;

/** What a scene is made from. Borrowed. */
typedef struct contact_scene_request {
    int dimension;
    double spacing; /* m */
    const contact_scene_body *bodies;
    int n_bodies;
    const contact_scene_wall *walls;
    int n_walls;
    mor_contact_law law;
    const mor_contact_pair *pairs;
    int n_pairs;
    double modulus; /* of contact, and Young's modulus of elastic bodies, Pa */
    double poisson; /* 1 */
    double density; /* kg/m3 */
    double gravity[3];
    double slowest_impact; /* m/s */
    double damping_factor; /* Kelvin-Voigt, 1 */
    double end;            /* s */
    int n_threads;         /* 0: one */
} contact_scene_request;

/** One scene. Owner: the test, which ends it with contact_scene_close. Body k of the request is body place[k] of the
 *  rigid or the elastic group. */
typedef struct contact_scene {
    mor_context context;
    contact_scene_request request; /* its bodies are those below */
    contact_scene_body bodies[CONTACT_SCENE_BODIES_MAX];
    mor_material_instance *material;
    mor_shape *shapes[CONTACT_SCENE_BODIES_MAX];
    mor_shape *wall_shapes[CONTACT_SCENE_WALLS_MAX];
    int place[CONTACT_SCENE_BODIES_MAX];
    int n_rigid, n_elastic;
    mor_rigid rigid;
    mor_elastic elastic;
    mor_contact contact;
    mor_exchange exchange;
    mor_schedule schedule;
} contact_scene;

static inline void contact_scene_require(const contact_scene *it, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

/** Fails the running test unless found is within tolerance of expected, all in one unit; what is zero-terminated. */
static inline void contact_scene_expect(const char *what, double found, double expected, double tolerance)
{
    if (getenv("MOR_TEST_SHOW") != NULL) {
        fprintf(stderr, "%s: %.9g, expected %.9g within %.3g\n", what, found, expected, tolerance);
    }
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%s is %.9g, not %.9g within %.3g", what, found, expected, tolerance);
    }
}

static inline void contact_scene_make_shape(contact_scene *it, int k)
{
    const contact_scene_body *body = &it->request.bodies[k];
    const double origin[3] = {0.0, 0.0, 0.0};
    if (body->radius > 0.0) {
        contact_scene_require(it, mor_shape_new_sphere(&it->context, origin, body->radius, &it->shapes[k]));
        return;
    }
    double low[3], high[3];
    for (int a = 0; a < 3; ++a) {
        high[a] = a < it->request.dimension ? body->half[a] : INFINITY;
        low[a] = -high[a];
    }
    contact_scene_require(it, mor_shape_new_box(&it->context, low, high, &it->shapes[k]));
}

/** Lattice points inside shape k, placed, shape [n, 3], unit m; the caller frees them. */
static inline double *contact_scene_fill(const contact_scene *it, int k, const mor_body_request *to, int64_t *n)
{
    const contact_scene_body *body = &it->request.bodies[k];
    const double dp = it->request.spacing;
    int64_t cells[3] = {1, 1, 1};
    for (int a = 0; a < it->request.dimension; ++a) {
        cells[a] = (int64_t)ceil((body->radius > 0.0 ? body->radius : body->half[a]) / dp);
    }
    const int64_t layers = it->request.dimension == 3 ? 2 * cells[2] : 1;
    double *points = calloc((size_t)(3 * 4 * cells[0] * cells[1] * layers), sizeof *points);
    assert_non_null(points);
    *n = 0;
    for (int64_t m = 0; m < 4 * cells[0] * cells[1] * layers; ++m) {
        const int64_t at[3] = {m % (2 * cells[0]), m / (2 * cells[0]) % (2 * cells[1]), m / (4 * cells[0] * cells[1])};
        double own[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < it->request.dimension; ++a) {
            own[a] = ((double)(at[a] - cells[a]) + 0.5) * dp;
        }
        if (mor_shape_distance(it->shapes[k], own) < 0.0) {
            mor_matrix_apply(to->shape_rotation, own, points + 3 * *n);
            for (int a = 0; a < 3; ++a) {
                points[3 * *n + a] += to->shape_translation[a];
            }
            *n += 1;
        }
    }
    return points;
}

/** What the library is asked for body k; its positions are the caller's to free. */
static inline mor_body_request contact_scene_ask(contact_scene *it, int k)
{
    static const char *const names[CONTACT_SCENE_BODIES_MAX] = {"b0", "b1", "b2", "b3", "b4", "b5", "b6", "b7"};
    const contact_scene_body *body = &it->request.bodies[k];
    mor_body_request ask = {.name = names[k],
                            .shape = it->shapes[k],
                            .shape_rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                            .density = body->density > 0.0 ? body->density : it->request.density,
                            .soil_friction = MOR_WALL_ROUGH,
                            .contact_modulus = body->modulus > 0.0 ? body->modulus : it->request.modulus,
                            .contact_poisson = it->request.poisson};
    const double length = mor_vector_length(body->axis);
    if (length > 0.0) {
        const double axis[3] = {body->axis[0] / length, body->axis[1] / length, body->axis[2] / length};
        mor_matrix_rotation(axis, body->angle, ask.shape_rotation);
    }
    memcpy(ask.shape_translation, body->position, sizeof ask.shape_translation);
    memcpy(ask.velocity, body->velocity, sizeof ask.velocity);
    memcpy(ask.angular_velocity, body->angular_velocity, sizeof ask.angular_velocity);
    contact_scene_require(it,
                          mor_shape_find_moments(&it->context, it->shapes[k], it->request.dimension, &ask.geometry));
    mor_shape_moments_place(&ask.geometry, ask.shape_rotation, ask.shape_translation);
    ask.positions = contact_scene_fill(it, k, &ask, &ask.n_particles);
    return ask;
}

static inline void contact_scene_make_groups(contact_scene *it)
{
    const contact_scene_request *request = &it->request;
    mor_body_request asks[2][CONTACT_SCENE_BODIES_MAX];
    mor_rigid_motion motions[CONTACT_SCENE_BODIES_MAX];
    memset(motions, 0, sizeof motions);
    for (int k = 0; k < request->n_bodies; ++k) {
        const contact_scene_body *body = &request->bodies[k];
        const bool is_rigid = body->kind == &mor_rigid_operations;
        contact_scene_make_shape(it, k);
        it->place[k] = is_rigid ? it->n_rigid : it->n_elastic;
        asks[is_rigid][it->place[k]] = contact_scene_ask(it, k);
        if (is_rigid) {
            mor_rigid_motion *motion = &motions[it->n_rigid];
            motion->is_prescribed = body->is_held;
            memcpy(motion->velocity, body->velocity, sizeof motion->velocity);
            memcpy(motion->angular_velocity, body->angular_velocity, sizeof motion->angular_velocity);
        }
        it->n_rigid += is_rigid;
        it->n_elastic += !is_rigid;
    }
    if (it->n_rigid > 0) {
        contact_scene_require(it, mor_rigid_init(&it->context, &it->rigid, "stones", request->dimension,
                                                 request->spacing, asks[1], motions, it->n_rigid));
    }
    if (it->n_elastic > 0) {
        const double values[MOR_HOOKE_COUNT] = {request->modulus, request->poisson};
        const mor_scheme settings = {.body_smoothing_ratio = 1.15,
                                     .body_courant = 0.4,
                                     .body_damping = request->damping_factor,
                                     .hourglass = 0.0};
        contact_scene_require(
            it, mor_material_create(&it->context, law_named("neo_hookean"), request->density, values, &it->material));
        contact_scene_require(it, mor_checked_wrap(&it->context, &it->material));
        contact_scene_require(it, mor_elastic_init(&it->context, &it->elastic, "rubber", &settings, it->material,
                                                   request->dimension, request->spacing, asks[0], it->n_elastic));
    }
    for (int k = 0; k < request->n_bodies; ++k) {
        free((void *)(uintptr_t)asks[request->bodies[k].kind == &mor_rigid_operations][it->place[k]].positions);
    }
}

static inline void contact_scene_make_contact(contact_scene *it)
{
    const contact_scene_request *request = &it->request;
    mor_contact_wall walls[CONTACT_SCENE_WALLS_MAX];
    mor_body_group *groups[CONTACT_SCENE_GROUPS];
    uint64_t bits[CONTACT_SCENE_GROUPS];
    memset(walls, 0, sizeof walls);
    int n = 0;
    for (int w = 0; w < request->n_walls; ++w) {
        contact_scene_require(it, mor_shape_new_half_space(&it->context, request->walls[w].point,
                                                           request->walls[w].normal, &it->wall_shapes[w]));
        snprintf(walls[w].name, sizeof walls[w].name, "w%d", w);
        walls[w].shape = it->wall_shapes[w];
        memcpy(walls[w].rotation, ((const double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}), sizeof walls[w].rotation);
        memcpy(walls[w].velocity, request->walls[w].velocity, sizeof walls[w].velocity);
    }
    if (it->n_rigid > 0) {
        bits[n] = MOR_BIT(n);
        groups[n++] = &it->rigid.group;
    }
    if (it->n_elastic > 0) {
        bits[n] = MOR_BIT(n);
        groups[n++] = &it->elastic.group;
    }
    for (int g = 0; g < n; ++g) {
        memcpy(groups[g]->gravity, request->gravity, sizeof groups[g]->gravity);
        for (int a = 0; a < 3; ++a) {
            groups[g]->domain_minimum[a] = -INFINITY;
            groups[g]->domain_maximum[a] = INFINITY;
        }
    }
    double fastest = 0.0;
    for (int k = 0; k < request->n_bodies; ++k) {
        fastest = fmax(fastest, mor_vector_length(request->bodies[k].velocity));
    }
    const mor_contact_settings settings = {request->law,  request->pairs, request->n_pairs, request->slowest_impact,
                                           2.0 * fastest, false};
    contact_scene_require(
        it, mor_contact_init(&it->context, &it->contact, &settings, groups, bits, n, walls, request->n_walls));
    mor_contact_exchange(&it->contact, &it->exchange);
}

static inline void contact_scene_open(contact_scene *it, const contact_scene_request *request)
{
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    it->request = *request;
    it->context.n_threads = request->n_threads > 0 ? request->n_threads : 1;
    assert_true(request->n_bodies <= CONTACT_SCENE_BODIES_MAX && request->n_walls <= CONTACT_SCENE_WALLS_MAX);
    memcpy(it->bodies, request->bodies, (size_t)request->n_bodies * sizeof *request->bodies);
    it->request.bodies = it->bodies;
    contact_scene_make_groups(it);
    contact_scene_make_contact(it);
    contact_scene_require(it, mor_schedule_init(&it->context, &it->schedule, request->end));
    mor_stepper stepper;
    uint64_t evolving = 0;
    if (it->n_rigid > 0) {
        mor_rigid_stepper(&it->rigid, &stepper, &evolving);
        contact_scene_require(it, mor_schedule_add(&it->context, &it->schedule, &stepper, evolving));
    }
    if (it->n_elastic > 0) {
        contact_scene_require(it, mor_elastic_prepare(&it->context, &it->elastic));
        mor_elastic_stepper(&it->elastic, &stepper, &evolving);
        contact_scene_require(it, mor_schedule_add(&it->context, &it->schedule, &stepper, evolving));
    }
    it->schedule.exchange = &it->exchange;
}

/** Ends a scene; fails when it left memory behind. */
static inline void contact_scene_close(contact_scene *it)
{
    mor_contact_clear(&it->context, &it->contact);
    if (it->n_rigid > 0) {
        mor_rigid_clear(&it->context, &it->rigid);
    }
    if (it->n_elastic > 0) {
        mor_elastic_clear(&it->context, &it->elastic);
        mor_material_destroy(&it->context, &it->material);
    }
    for (int k = 0; k < CONTACT_SCENE_BODIES_MAX; ++k) {
        mor_shape_free(&it->context, &it->shapes[k]);
    }
    for (int w = 0; w < CONTACT_SCENE_WALLS_MAX; ++w) {
        mor_shape_free(&it->context, &it->wall_shapes[w]);
    }
    assert_int_equal(it->context.memory_bytes, 0);
}

/** Present time, s. */
static inline double contact_scene_time(const contact_scene *it)
{
    return mor_schedule_time(&it->schedule);
}

/** Takes one step, not beyond a time [s]. */
static inline void contact_scene_step(contact_scene *it, double until)
{
    contact_scene_require(it, mor_schedule_step(&it->context, &it->schedule, mor_schedule_ticks(&it->schedule, until)));
}

/** Takes steps until a time, s. */
static inline void contact_scene_run(contact_scene *it, double until)
{
    while (it->schedule.now < mor_schedule_ticks(&it->schedule, until)) {
        contact_scene_step(it, until);
    }
}

/** The group of body k of the request, one object. */
static inline mor_body_group *contact_scene_group(contact_scene *it, int k)
{
    return it->request.bodies[k].kind == &mor_rigid_operations ? &it->rigid.group : &it->elastic.group;
}

/** Body k of the request, one object. */
static inline mor_body *contact_scene_of(contact_scene *it, int k)
{
    return &contact_scene_group(it, k)->bodies[it->place[k]];
}

/** Momenta of body k, shape [3] each, unit kg m/s and kg m2/s about the origin; returns the kinetic energy, J. */
static inline double contact_scene_momentum(contact_scene *it, int k, double *momentum, double *angular)
{
    if (it->request.bodies[k].kind == &mor_rigid_operations) {
        return mor_rigid_energy(&it->rigid, it->place[k], momentum, angular);
    }
    return mor_body_group_momentum(&it->elastic.group, it->place[k], momentum, angular);
}

/** Velocity of body k as a whole, shape [3], unit m/s. */
static inline void contact_scene_velocity(contact_scene *it, int k, double *velocity)
{
    double angular[3];
    contact_scene_momentum(it, k, velocity, angular);
    for (int a = 0; a < 3; ++a) {
        velocity[a] /= contact_scene_of(it, k)->mass;
    }
}

/** Center of mass of body k, shape [3], unit m. */
static inline void contact_scene_center(contact_scene *it, int k, double *center)
{
    const mor_body *body = contact_scene_of(it, k);
    const mor_body_group *group = contact_scene_group(it, k);
    if (group->operations == &mor_rigid_operations) {
        memcpy(center, body->center, 3 * sizeof *center);
        return;
    }
    center[0] = center[1] = center[2] = 0.0;
    for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
        for (int a = 0; a < 3; ++a) {
            center[a] += group->set.data[MOR_FIELD_POSITION][3 * i + a] / (double)body->n_particles;
        }
    }
}

/** Sums over all bodies, shape [3] each; returns kinetic, strain, contact spring and potential energy, J. */
static inline double contact_scene_totals(contact_scene *it, double *momentum, double *angular)
{
    double energy = it->contact.spring_energy;
    memset(momentum, 0, 3 * sizeof *momentum);
    memset(angular, 0, 3 * sizeof *angular);
    for (int k = 0; k < it->request.n_bodies; ++k) {
        double p[3], l[3], center[3];
        energy += contact_scene_momentum(it, k, p, l);
        contact_scene_center(it, k, center);
        energy -= contact_scene_of(it, k)->mass * mor_vector_dot(it->request.gravity, center);
        for (int a = 0; a < 3; ++a) {
            momentum[a] += p[a];
            angular[a] += l[a];
        }
    }
    return energy + (it->n_elastic > 0 ? mor_elastic_energy(&it->elastic, -1) : 0.0);
}

#endif
