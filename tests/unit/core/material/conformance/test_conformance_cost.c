/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance_cost.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* A law that moves the clock itself: a microsecond for a particle and for each 1e-5 of its strain, and refuses steps
 * from some strain on. */
static double elapsed; /* s */

static double read_clock(void)
{
    return elapsed;
}

static const mor_schema PARAMETERS[] = {
    {.key = "largest",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "1",
     .is_required = 1,
     .maximum = 1.0,
     .text = "strain from which on a step is refused"},
    {.key = NULL},
};

static const mor_schema STATE[] = {{.key = NULL}};

static mor_status create(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
    return MOR_OK;
}

static void destroy(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
}

static mor_status wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = 10.0;
    }
    return MOR_OK;
}

static mor_status advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *l = batch->velocity_gradient + 9 * i;
        double norm2 = 0.0;
        for (int a = 0; a < 9; ++a) {
            const double d = 0.5 * (l[a] + l[a % 3 * 3 + a / 3]);
            norm2 += d * d;
        }
        const double strain = sqrt(norm2) * batch->time_step;
        for (int a = 0; a < 6; ++a) {
            batch->stress_out[6 * i + a] = 0.0;
        }
        /* The way to the states to be timed has larger strains. */
        if (strain > instance->parameters[0] && strain < 1.5e-4) {
            return MOR_RETRY_SMALLER_STEP;
        }
        elapsed += 1e-6 * (1.0 + strain / 1e-5);
    }
    return MOR_OK;
}

static const mor_material TICKING = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "ticking",
    .version = "1",
    .text = "a law that moves a clock",
    .literature = "none",
    .form = MOR_MATERIAL_RATE,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations = {.create = create, .destroy = destroy, .wave_speed = wave_speed, .advance_rate = advance_rate},
};

static void cost_is_the_time_of_one_particle_at_each_strain(void **state)
{
    (void)state;
    static const double expected[MOR_COST_STRAINS] = {1.1e-6, 2e-6, 11e-6};
    const double largest = 1.0;
    double seconds[MOR_COST_STRAINS];
    mor_context context;
    mor_context_init(&context);
    elapsed = 0.0;
    assert_int_equal(mor_conformance_cost(&context, &TICKING, &largest, 2000.0, read_clock, seconds), MOR_OK);
    for (int k = 0; k < MOR_COST_STRAINS; ++k) {
        assert_true(fabs(seconds[k] / expected[k] - 1.0) < 1e-6); /* differences of sums of a million roundings */
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void strain_that_the_law_refuses_has_no_cost(void **state)
{
    (void)state;
    const double largest = 5e-5;
    double seconds[MOR_COST_STRAINS];
    mor_context context;
    mor_context_init(&context);
    elapsed = 0.0;
    assert_int_equal(mor_conformance_cost(&context, &TICKING, &largest, 2000.0, read_clock, seconds), MOR_OK);
    assert_true(isfinite(seconds[0]) && isfinite(seconds[1]));
    assert_true(isnan(seconds[2]));
    assert_int_equal(context.memory_bytes, 0);
}

static void law_that_refuses_its_parameters_is_an_error_with_its_reason(void **state)
{
    (void)state;
    const double wrong = -1.0;
    double seconds[MOR_COST_STRAINS];
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_conformance_cost(&context, &TICKING, &wrong, 2000.0, read_clock, seconds), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "largest"));
    assert_true(isnan(seconds[0]));
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cost_is_the_time_of_one_particle_at_each_strain),
        cmocka_unit_test(strain_that_the_law_refuses_has_no_cost),
        cmocka_unit_test(law_that_refuses_its_parameters_is_an_error_with_its_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
