/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SAND_SPECIMEN_H
#define MOR_TESTS_COMMON_SAND_SPECIMEN_H

#include "core/base/math.h"
#include "core/material/kit/material.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  A specimen of hypoplastic sand. */

/** Karlsruhe-type medium sand; the initial void ratio is set by each test. */
#define PHI (30.0 * MOR_PI / 180.0)
static const double HARDNESS = 2.6e9;
static const double EXPONENT = 0.27;
static const double E_D0 = 0.61;
static const double E_C0 = 0.98;
static const double E_I0 = 1.10;
static const double ALPHA = 0.18;
static const double BETA = 1.1;
static const double SHIFT = 100.0; /* Pa, added to the pressure by the law */
static const double M_R = 5.0;
static const double M_T = 2.0;
static const double BETA_R = 0.5;
static const double CHI = 6.0;

/** One particle under the built-in law. */
typedef struct specimen {
    mor_context context;
    mor_material_instance *instance;
    double stress[6];
    double void_ratio;
    double intergranular[6];
} specimen;

/** Sets a parameter by its key, zero-terminated. */
static inline void set(const mor_material *law, double *values, const char *key, double value)
{
    const int entry = mor_params_find(law->parameters, key);
    assert_true(entry >= 0);
    values[mor_params_offset(law->parameters, entry)] = value;
}

/** Makes an unstressed particle; range 0: without intergranular strain. */
static inline void make(specimen *s, double void_ratio, double range, double tolerance)
{
    const mor_material *law = law_named("hypoplastic_sand");
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    mor_params_defaults(law->parameters, values);
    set(law, values, "critical_friction_angle", PHI);
    set(law, values, "granulate_hardness", HARDNESS);
    set(law, values, "exponent", EXPONENT);
    set(law, values, "densest_void_ratio", E_D0);
    set(law, values, "critical_void_ratio", E_C0);
    set(law, values, "loosest_void_ratio", E_I0);
    set(law, values, "alpha", ALPHA);
    set(law, values, "beta", BETA);
    set(law, values, "void_ratio", fmin(fmax(void_ratio, E_D0), E_I0));
    set(law, values, "elastic_range", range);
    set(law, values, "minimum_pressure", SHIFT);
    set(law, values, "relative_tolerance", tolerance);
    set(law, values, "absolute_tolerance", 1e3 * tolerance);
    memset(s, 0, sizeof *s);
    mor_context_init(&s->context);
    s->context.n_threads = 2;
    if (mor_material_create(&s->context, law, 1600.0, values, &s->instance) != MOR_OK) {
        fail_msg("%s", s->context.message);
    }
    s->void_ratio = void_ratio;
}

static inline void discard(specimen *s)
{
    mor_material_destroy(&s->context, &s->instance);
    assert_int_equal(s->context.memory_bytes, 0);
}

/** Axial and lateral pressure; the axis is z. */
static inline void press(specimen *s, double axial, double lateral)
{
    const double stress[6] = {-lateral, -lateral, -axial, 0.0, 0.0, 0.0};
    memcpy(s->stress, stress, sizeof stress);
}

/** One step of a unit of time; gradient shape [3,3]. */
static inline mor_status step(specimen *s, const double *gradient)
{
    const double density = 1600.0;
    const double *state_in[] = {&s->void_ratio, s->intergranular};
    double *state_out[] = {&s->void_ratio, s->intergranular};
    const mor_batch batch = {.n = 1,
                             .time_step = 1.0,
                             .density = &density,
                             .velocity_gradient = gradient,
                             .stress_in = s->stress,
                             .stress_out = s->stress,
                             .state_in = state_in,
                             .state_out = state_out};
    return s->instance->operations.advance_rate(s->instance, &batch);
}

/** Strains in equal steps. */
static inline void strain(specimen *s, double lateral, double axial, int n_steps)
{
    const double gradient[9] = {lateral / n_steps, 0.0, 0.0, 0.0, lateral / n_steps, 0.0, 0.0, 0.0, axial / n_steps};
    for (int k = 0; k < n_steps; ++k) {
        assert_int_equal(step(s, gradient), MOR_OK);
    }
}

/** Mean pressure as the law sees it, with its minimum pressure. */
static inline double pressure_of(const double *stress)
{
    return SHIFT - mor_symmetric_trace(stress) / 3.0;
}

/** Void ratios of the loosest, critical and densest packing over those at no pressure. */
static inline double decay(double pressure)
{
    return exp(-pow(3.0 * pressure / HARDNESS, EXPONENT));
}

#endif
