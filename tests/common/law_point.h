/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_LAW_POINT_H
#define MOR_TESTS_COMMON_LAW_POINT_H

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/material/kit/material.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  One particle of a built-in law of rate form with any state variables; its density follows the change of volume. */

/** A particle. */
typedef struct law_point {
    mor_context context;
    mor_material_instance *law;
    double density;                            /* kg/m3 */
    double stress[6];                          /* Pa */
    double state[9 * MOR_MATERIAL_STATES_MAX]; /* variable after variable; units of the schema */
    double dissipation;                        /* summed, J/m3 */
} law_point;

static const double LAW_POINT_DENSITY = 2000.0; /* reference, kg/m3 */

/** Views of the state variables in an array like law_point.state. */
static inline void law_point_view(const law_point *p, double *numbers, double **arrays)
{
    for (int k = 0; k < p->law->n_state; ++k) {
        arrays[k] = numbers;
        numbers += p->law->material->state[k].n_components;
    }
}

/** Sets stress, shape [6], reference density, the state that belongs to them, and no dissipation. */
static inline void law_point_start(law_point *p, const double *stress)
{
    double *state[MOR_MATERIAL_STATES_MAX] = {0};
    law_point_view(p, p->state, state);
    memcpy(p->stress, stress, sizeof p->stress);
    p->dissipation = 0.0;
    const mor_batch batch = {.n = 1, .density = &p->density, .stress_in = p->stress, .state_out = state};
    assert_int_equal(p->law->operations.init_state(p->law, &batch), MOR_OK);
}

/** As law_point_start with an isotropic pressure. */
static inline void law_point_start_isotropic(law_point *p, double pressure)
{
    const double stress[6] = {-pressure, -pressure, -pressure, 0.0, 0.0, 0.0};
    law_point_start(p, stress);
}

/** Makes an unstressed particle; values in schema order. */
static inline void law_point_open(law_point *p, const char *name, const double *values)
{
    memset(p, 0, sizeof *p);
    mor_context_init(&p->context);
    p->density = LAW_POINT_DENSITY;
    if (mor_material_create(&p->context, law_named(name), LAW_POINT_DENSITY, values, &p->law) != MOR_OK) {
        fail_msg("%s", p->context.message);
    }
    law_point_start_isotropic(p, 0.0);
}

static inline void law_point_close(law_point *p)
{
    mor_material_destroy(&p->context, &p->law);
    assert_int_equal(p->context.memory_bytes, 0);
}

/** One step; gradient shape [3,3] or NULL, extra shape [6] or NULL. After a failure the point is as before. */
static inline mor_status law_point_try(law_point *p, const double *gradient, const double *extra, double time_step)
{
    static const double none[9] = {0};
    const double *l = gradient != NULL ? gradient : none;
    double end[9 * MOR_MATERIAL_STATES_MAX] = {0};
    double *before[MOR_MATERIAL_STATES_MAX] = {0};
    double *after[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    law_point_view(p, p->state, before);
    law_point_view(p, end, after);
    for (int k = 0; k < MOR_MATERIAL_STATES_MAX; ++k) {
        state_in[k] = before[k];
    }
    const double density = p->density * exp(-(l[0] + l[4] + l[8]) * time_step);
    double stress[6];
    double dissipation = 0.0;
    const mor_batch batch = {.n = 1,
                             .time_step = time_step,
                             .density = &density,
                             .velocity_gradient = l,
                             .extra_stress_rate = extra,
                             .stress_in = p->stress,
                             .stress_out = stress,
                             .state_in = state_in,
                             .state_out = after,
                             .dissipation = &dissipation};
    const mor_status status = p->law->operations.advance_rate(p->law, &batch);
    if (status == MOR_OK) {
        memcpy(p->stress, stress, sizeof stress);
        memcpy(p->state, end, sizeof end);
        p->density = density;
        p->dissipation += dissipation;
    }
    return status;
}

/** n equal steps of a total length; gradient shape [3,3]. */
static inline void law_point_steps(law_point *p, const double *gradient, double length, int n)
{
    for (int k = 0; k < n; ++k) {
        assert_int_equal(law_point_try(p, gradient, NULL, length / n), MOR_OK);
    }
}

/** Simple shear by gamma in n steps over a time: with its spin, or without. */
static inline void law_point_shear(law_point *p, double gamma, double length, int n, int has_spin)
{
    const double rate = gamma / length;
    const double gradient[9] = {0.0, has_spin ? rate : 0.5 * rate, 0.0, has_spin ? 0.0 : 0.5 * rate, 0, 0, 0, 0, 0};
    law_point_steps(p, gradient, length, n);
}

/** An axial strain increment along z at a lateral stress that stays; the lateral strain by the secant method. */
static inline void law_point_triaxial(law_point *p, double axial, double lateral_stress)
{
    const law_point start = *p;
    double guess[2] = {0.0, -0.4 * axial};
    double miss[2] = {0.0};
    for (int iteration = 0; iteration < 60; ++iteration) {
        const int k = iteration < 2 ? iteration : 1;
        const double gradient[9] = {guess[k], 0, 0, 0, guess[k], 0, 0, 0, axial};
        *p = start;
        law_point_steps(p, gradient, 1.0, 1);
        miss[k] = p->stress[MOR_XX] - lateral_stress;
        if (fabs(miss[k]) <= 1e-11 * fabs(lateral_stress)) {
            return;
        }
        if (k == 1) {
            const double next = guess[1] - miss[1] * (guess[1] - guess[0]) / (miss[1] - miss[0]);
            guess[0] = guess[1];
            miss[0] = miss[1];
            guess[1] = next;
        }
    }
    fail_msg("the lateral stress was not reached");
}

/** Mean pressure of a stress, shape [6]. */
static inline double stress_pressure(const double *stress)
{
    return -mor_symmetric_trace(stress) / 3.0;
}

/** sqrt(J2) of a stress, shape [6]. */
static inline double stress_root_j2(const double *stress)
{
    const double pressure = stress_pressure(stress);
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double s = stress[a] + pressure;
        sum += 0.5 * s * s + stress[3 + a] * stress[3 + a];
    }
    return sqrt(sum);
}

static inline double law_point_pressure(const law_point *p)
{
    return stress_pressure(p->stress);
}

static inline double law_point_root_j2(const law_point *p)
{
    return stress_root_j2(p->stress);
}

static inline void law_point_check_close(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("found %.17g, expected %.17g, tolerance %g", found, expected, tolerance);
    }
}

#endif
