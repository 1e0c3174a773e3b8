/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_ROCK_H
#define MOR_TESTS_COMMON_ROCK_H

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/particle/boundary.h"
#include "core/particle/tree.h"
#include "core/time/stepper.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  Rigid rocks for tests of the soil's coupling: boxes of points on a lattice, moved by the plainest solver there is,
 *  so that what a test finds belongs to the soil. A rock turns as a body whose moment of inertia is the same about all
 *  axes. */

enum { ROCK_MAX = 8, ROCK_POINTS_MAX = 4096 };

/** One rock. Plain data; set what is known at the start. */
typedef struct rock {
    double center[3], velocity[3], spin[3]; /* m, m/s, rad/s */
    int sides[3];                           /* points along each axis */
    double density;                         /* kg/m3; the mass and the moment of inertia follow */
    mor_wall_friction friction;
    double friction_coefficient; /* 1 */
    double gravity[3];           /* m/s2 */
    bool is_fixed[3];            /* the velocity along an axis stays as it is */
    bool cannot_turn;
    double mass, inertia;    /* kg, kg m2 (kg/m, kg m) */
    double impulse[3];       /* received from the soil, N s */
    double given[2 * 3];     /* force and moment about the center in the present common step */
    double rotation[9];      /* since the start, shape [3,3] */
    double seen[3];          /* center in the middle of the common step, as the soil saw it, m */
    int64_t first, n_points; /* range of points */
} rock;

/** Rocks as one boundary. Owner: the test. */
typedef struct rock_pile {
    mor_boundary boundary;
    mor_boundary_patch patches[ROCK_MAX];
    rock rocks[ROCK_MAX];
    int n_rocks, dimension;
    double spacing;    /* m */
    double step;       /* longest sub-step, s */
    double *reference; /* shape [n_points, 3]; from the center at the start, m */
    double *start;     /* shape [n_points, 3]; positions at the start of the common step, m */
} rock_pile;

/** Puts every point where its rock has it after moving on for a time, unit s, at constant speed. */
static inline void rock_place(rock_pile *pile, double time)
{
    for (int r = 0; r < pile->n_rocks; ++r) {
        rock *it = &pile->rocks[r];
        double rotation[9];
        double further[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        const double speed = mor_vector_length(it->spin);
        if (speed > 0.0) {
            const double axis[3] = {it->spin[0] / speed, it->spin[1] / speed, it->spin[2] / speed};
            mor_matrix_rotation(axis, speed * time, further);
        }
        for (int k = 0; k < 9; ++k) {
            rotation[k] = further[k / 3 * 3] * it->rotation[k % 3] + further[k / 3 * 3 + 1] * it->rotation[3 + k % 3] +
                          further[k / 3 * 3 + 2] * it->rotation[6 + k % 3];
        }
        for (int64_t j = it->first; j < it->first + it->n_points; ++j) {
            double arm[3];
            mor_matrix_apply(rotation, pile->reference + 3 * j, arm);
            for (int a = 0; a < 3; ++a) {
                pile->boundary.records[MOR_BOUNDARY_RECORD * j + a] = it->center[a] + it->velocity[a] * time + arm[a];
            }
        }
        for (int a = 0; a < 3; ++a) {
            it->seen[a] = it->center[a] + it->velocity[a] * time;
        }
    }
}

/** Fills in the points of one rock in cluster order; returns their number. */
static inline int64_t rock_fill(rock_pile *pile, const rock *it, double *points)
{
    static double loose[3 * ROCK_POINTS_MAX];
    static int32_t order[ROCK_POINTS_MAX];
    const int n_z = pile->dimension == 3 ? it->sides[2] : 1;
    const int64_t n = (int64_t)it->sides[0] * it->sides[1] * n_z;
    assert_true(n <= ROCK_POINTS_MAX);
    for (int64_t j = 0; j < n; ++j) {
        const int64_t place[3] = {j % it->sides[0], j / it->sides[0] % it->sides[1], j / it->sides[0] / it->sides[1]};
        const int sides[3] = {it->sides[0], it->sides[1], n_z};
        for (int a = 0; a < 3; ++a) {
            loose[3 * j + a] = pile->spacing * ((double)place[a] - 0.5 * (sides[a] - 1));
        }
    }
    mor_tree_order(loose, 3, n, order);
    for (int64_t j = 0; j < n; ++j) {
        memcpy(points + 3 * j, loose + 3 * order[j], 3 * sizeof *points);
    }
    return n;
}

/** Makes the boundary of the rocks that stand in pile->rocks; pile->n_rocks, dimension, spacing and step are set. */
static inline void rock_open(mor_context *context, rock_pile *pile, const char *name)
{
    int64_t n = 0;
    const double volume =
        pile->dimension == 3 ? pile->spacing * pile->spacing * pile->spacing : pile->spacing * pile->spacing;
    for (int r = 0; r < pile->n_rocks; ++r) {
        n += (int64_t)pile->rocks[r].sides[0] * pile->rocks[r].sides[1] *
             (pile->dimension == 3 ? pile->rocks[r].sides[2] : 1);
    }
    mor_boundary *b = &pile->boundary;
    memset(b, 0, sizeof *b);
    memset(pile->patches, 0, sizeof pile->patches);
    strncpy(b->name, name, sizeof b->name - 1);
    b->n_points = n;
    b->patches = pile->patches;
    b->n_patches = pile->n_rocks;
    assert_int_equal(MOR_NEW(context, &b->records, (n + 8) * MOR_BOUNDARY_RECORD, "rock points"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &b->force, 3 * n, "rock forces"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &pile->reference, 3 * n, "rock reference"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &pile->start, 3 * n, "rock start"), MOR_OK);
    n = 0;
    for (int r = 0; r < pile->n_rocks; ++r) {
        rock *it = &pile->rocks[r];
        memcpy(it->rotation, ((const double[9]){1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}), sizeof it->rotation);
        it->first = n;
        it->n_points = rock_fill(pile, it, pile->reference + 3 * n);
        it->mass = it->density * volume * (double)it->n_points;
        const double side = pile->spacing * it->sides[0];
        it->inertia = it->mass * side * side / 6.0;
        pile->patches[r] = (mor_boundary_patch){.first = n,
                                                .n_points = it->n_points,
                                                .friction = it->friction,
                                                .friction_coefficient = it->friction_coefficient};
        n += it->n_points;
    }
    rock_place(pile, 0.0);
    for (int r = 0; r < pile->n_rocks; ++r) {
        const rock *it = &pile->rocks[r];
        for (int64_t j = it->first; j < it->first + it->n_points; ++j) {
            double *record = b->records + MOR_BOUNDARY_RECORD * j;
            double arm[3];
            record[MOR_BOUNDARY_VOLUME] = volume;
            for (int a = 0; a < 3; ++a) {
                arm[a] = record[a] - it->center[a];
            }
            for (int a = 0; a < 3; ++a) {
                const int u = (a + 1) % 3;
                const int v = (a + 2) % 3;
                record[MOR_BOUNDARY_VELOCITY + a] = it->velocity[a] + it->spin[u] * arm[v] - it->spin[v] * arm[u];
            }
            b->largest_speed = fmax(b->largest_speed, mor_vector_length(record + MOR_BOUNDARY_VELOCITY));
        }
    }
}

static inline void rock_close(mor_context *context, rock_pile *pile)
{
    MOR_FREE(context, &pile->boundary.records);
    MOR_FREE(context, &pile->boundary.force);
    MOR_FREE(context, &pile->reference);
    MOR_FREE(context, &pile->start);
}

static inline mor_status rock_propose(mor_context *context, void *owner, double *step_length, const char **limit)
{
    (void)context;
    *step_length = ((rock_pile *)owner)->step;
    *limit = "the rocks";
    return MOR_OK;
}

static inline mor_status rock_begin(mor_context *context, void *owner, const mor_step *step)
{
    (void)context;
    rock_pile *pile = owner;
    rock_place(pile, 0.0);
    for (int64_t k = 0; k < 3 * pile->boundary.n_points; ++k) {
        pile->start[k] = pile->boundary.records[MOR_BOUNDARY_RECORD * (k / 3) + k % 3];
    }
    rock_place(pile, 0.5 * step->length);
    return MOR_OK;
}

/** Force and moment, from the forces on the points, where the soil saw them. */
static inline void rock_collect(const rock_pile *pile, const rock *it, double *given)
{
    memset(given, 0, 6 * sizeof *given);
    for (int64_t j = it->first; j < it->first + it->n_points; ++j) {
        const double *record = pile->boundary.records + MOR_BOUNDARY_RECORD * j;
        const double *force = pile->boundary.force + 3 * j;
        for (int a = 0; a < 3; ++a) {
            const int u = (a + 1) % 3;
            const int v = (a + 2) % 3;
            given[a] += force[a];
            given[3 + a] += (record[u] - it->seen[u]) * force[v] - (record[v] - it->seen[v]) * force[u];
        }
    }
}

/** One sub-step under the force that is held; exact for a constant force. */
static inline mor_status rock_move(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    (void)context;
    rock_pile *pile = owner;
    const double dt = step->length;
    for (int r = 0; r < pile->n_rocks; ++r) {
        rock *it = &pile->rocks[r];
        if (step->part == 0) {
            rock_collect(pile, it, it->given);
        }
        for (int a = 0; a < 3; ++a) {
            const double before = it->velocity[a];
            it->velocity[a] += it->is_fixed[a] ? 0.0 : dt * (it->given[a] / it->mass + it->gravity[a]);
            it->center[a] += 0.5 * dt * (before + it->velocity[a]);
            it->impulse[a] += dt * it->given[a];
            it->spin[a] += it->cannot_turn ? 0.0 : dt * it->given[3 + a] / it->inertia;
        }
        const double speed = mor_vector_length(it->spin);
        if (speed > 0.0) {
            double further[9];
            double rotation[9];
            mor_matrix_rotation((const double[3]){it->spin[0] / speed, it->spin[1] / speed, it->spin[2] / speed},
                                speed * dt, further);
            for (int k = 0; k < 9; ++k) {
                rotation[k] = further[k / 3 * 3] * it->rotation[k % 3] +
                              further[k / 3 * 3 + 1] * it->rotation[3 + k % 3] +
                              further[k / 3 * 3 + 2] * it->rotation[6 + k % 3];
            }
            memcpy(it->rotation, rotation, sizeof rotation);
        }
    }
    return MOR_OK;
}

/** Mean velocities over the step, Zhang et al. (2024) eq. 60; the points stay where the soil saw them. */
static inline mor_status rock_finish(mor_context *context, void *owner, const mor_step *step)
{
    (void)context;
    rock_pile *pile = owner;
    mor_boundary *b = &pile->boundary;
    b->largest_speed = 0.0;
    for (int r = 0; r < pile->n_rocks; ++r) {
        const rock *it = &pile->rocks[r];
        for (int64_t j = it->first; j < it->first + it->n_points; ++j) {
            double arm[3];
            double *velocity = b->records + MOR_BOUNDARY_RECORD * j + MOR_BOUNDARY_VELOCITY;
            mor_matrix_apply(it->rotation, pile->reference + 3 * j, arm);
            for (int a = 0; a < 3; ++a) {
                velocity[a] = (it->center[a] + arm[a] - pile->start[3 * j + a]) / step->length;
            }
            b->largest_speed = fmax(b->largest_speed, mor_vector_length(velocity));
        }
    }
    return MOR_OK;
}

/** The rocks as a follower. */
static inline mor_stepper rock_stepper(rock_pile *pile)
{
    static const mor_stepper_operations operations = {
        .kind = "rocks", .propose = rock_propose, .begin = rock_begin, .finish = rock_finish};
    static const mor_stage stages[] = {{"move", rock_move, 0, 0, 0, "moves the rocks", NULL}};
    return (mor_stepper){.name = pile->boundary.name,
                         .operations = &operations,
                         .owner = pile,
                         .stages = stages,
                         .n_stages = 1,
                         .n_before = 1,
                         .n_particles = pile->boundary.n_points};
}

#endif
