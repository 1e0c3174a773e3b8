/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/material/checked.h"
#include "materials/drucker_prager.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { N = 77, TEXT_BYTES = 256 };

static const double SOIL[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};

/* A material with every operation, whose misdeed is a parameter. */

typedef enum misdeed {
    GOOD,
    SKIPS_STRESS,
    SKIPS_STATE,
    SKIPS_DISSIPATION,
    WRITES_BEFORE,
    WRITES_BEHIND,
    CHANGES_STRESS_IN,
    CHANGES_STATE_IN,
    ASKS_FOR_N,
    INFINITE_SPEED,
    NAN_PRESSURE,
    SKIPS_DIFFUSIVITY,
    SKIPS_TANGENT,
    N_MISDEEDS
} misdeed;

static const mor_schema PARAMETERS[] = {{.key = "misdeed",
                                         .kind = MOR_SCHEMA_INTEGER,
                                         .n_components = 1,
                                         .unit = "1",
                                         .minimum = 0.0,
                                         .maximum = N_MISDEEDS - 1,
                                         .text = "what to do wrong"},
                                        {.key = NULL}};
static const mor_schema STATE[] = {
    {.key = "age", .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "1", .maximum = INFINITY, .text = "a number"},
    {.key = "fabric",
     .kind = MOR_SCHEMA_VECTOR,
     .n_components = 3,
     .unit = "1",
     .minimum = -INFINITY,
     .maximum = INFINITY,
     .text = "a vector"},
    {.key = NULL},
};

static int does(const mor_material_instance *instance, misdeed what)
{
    return (misdeed)instance->parameters[0] == what;
}

static double *unlock(const double *array)
{
    return (double *)(uintptr_t)array;
}

static mor_status rogue_create(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
    return MOR_OK;
}

static void rogue_destroy(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
}

static mor_status fill_result(const mor_batch *batch, int n_components, double value, double *result)
{
    for (int64_t i = 0; i < n_components * batch->n; ++i) {
        result[i] = value;
    }
    return MOR_OK;
}

static mor_status rogue_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    return fill_result(batch, 1, does(instance, INFINITE_SPEED) ? INFINITY : 2.0, speed);
}

/* It reads the state, as it may. */
static mor_status rogue_pressure(const mor_material_instance *instance, const mor_batch *batch, double *pressure)
{
    if (batch->state_in == NULL || isnan(batch->state_in[0][0])) {
        return MOR_ERROR_ARGUMENT;
    }
    return fill_result(batch, 1, does(instance, NAN_PRESSURE) ? NAN : 3.0, pressure);
}

static mor_status rogue_tangent(const mor_material_instance *instance, const mor_batch *batch, double *tangent)
{
    return fill_result(batch, does(instance, SKIPS_TANGENT) ? 35 : 36, 4.0, tangent);
}

static mor_status rogue_diffusivity(const mor_material_instance *instance, const mor_batch *batch, double *diffusivity)
{
    return does(instance, SKIPS_DIFFUSIVITY) ? MOR_OK : fill_result(batch, 1, 5.0, diffusivity);
}

static mor_status rogue_advance(const mor_material_instance *instance, const mor_batch *batch)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        const int is_last = i == batch->n - 1;
        for (int a = 0; a < 6; ++a) {
            if (!(does(instance, SKIPS_STRESS) && is_last && a == 5)) {
                batch->stress_out[6 * i + a] =
                    batch->stress_in[6 * i + a] + (does(instance, ASKS_FOR_N) ? (double)batch->n : 1.0);
            }
        }
        batch->state_out[0][i] = batch->state_in[0][i] + 1.0;
        for (int a = 0; a < (does(instance, SKIPS_STATE) ? 2 : 3); ++a) {
            batch->state_out[1][3 * i + a] = batch->state_in[1][3 * i + a];
        }
        if (batch->dissipation != NULL && !does(instance, SKIPS_DISSIPATION)) {
            batch->dissipation[i] = 0.0;
        }
    }
    if (does(instance, WRITES_BEFORE)) {
        batch->stress_out[-1] = 0.0;
    }
    if (does(instance, WRITES_BEHIND)) {
        batch->state_out[1][3 * batch->n] = 0.0;
    }
    if (does(instance, CHANGES_STRESS_IN)) {
        unlock(batch->stress_in)[2] += 1.0;
    }
    if (does(instance, CHANGES_STATE_IN)) {
        unlock(batch->state_in[0])[0] = -1.0;
    }
    return MOR_OK;
}

static const mor_material ROGUE = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "rogue",
    .version = "1",
    .text = "breaks one rule",
    .literature = "none",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_NONLOCAL | MOR_MATERIAL_TANGENT | MOR_MATERIAL_DISSIPATION,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations = {.create = rogue_create,
                   .destroy = rogue_destroy,
                   .wave_speed = rogue_wave_speed,
                   .advance_rate = rogue_advance,
                   .pressure = rogue_pressure,
                   .diffusivity = rogue_diffusivity,
                   .tangent = rogue_tangent},
};

/* Arrays of one range. */
typedef struct range {
    double density[N], gradient[9 * N], extra[6 * N], stress[6 * N], stress_out[6 * N];
    double age[N], fabric[3 * N], age_out[N], fabric_out[3 * N], dissipation[N];
    const double *state_in[2];
    double *state_out[2];
    int64_t failed;
} range;

static mor_batch view(range *r)
{
    r->state_in[0] = r->age;
    r->state_in[1] = r->fabric;
    r->state_out[0] = r->age_out;
    r->state_out[1] = r->fabric_out;
    r->failed = -1;
    return (mor_batch){.n = N,
                       .time_step = 1e-3,
                       .density = r->density,
                       .velocity_gradient = r->gradient,
                       .extra_stress_rate = r->extra,
                       .stress_in = r->stress,
                       .stress_out = r->stress_out,
                       .state_in = r->state_in,
                       .state_out = r->state_out,
                       .dissipation = r->dissipation,
                       .failed = &r->failed};
}

static mor_material_instance *wrap(mor_context *context, const mor_material *material, const double *parameters,
                                   int checks_splits)
{
    mor_material_instance *inner = NULL;
    mor_material_instance *checked = NULL;
    assert_int_equal(mor_material_create(context, material, 2000.0, parameters, &inner), MOR_OK);
    assert_int_equal(mor_checked_create(context, &inner, checks_splits, &checked), MOR_OK);
    assert_null(inner);
    return checked;
}

static mor_status run_all(const mor_material_instance *m, const mor_batch *batch)
{
    static double result[36 * N];
    const mor_material_operations *o = &m->operations;
    mor_status status = o->init_state(m, batch);
    status = status == MOR_OK ? o->wave_speed(m, batch, result) : status;
    status = status == MOR_OK ? o->advance_rate(m, batch) : status;
    status = status == MOR_OK ? o->admissible(m, batch, result) : status;
    status = status == MOR_OK ? o->pressure(m, batch, result) : status;
    status = status == MOR_OK ? o->max_step(m, batch, result) : status;
    if (status == MOR_OK && o->diffusivity != NULL) {
        status = o->diffusivity(m, batch, result);
    }
    if (status == MOR_OK && o->tangent != NULL) {
        status = o->tangent(m, batch, result);
    }
    return status;
}

static void good_material_passes_and_numbers_are_its_own(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    range r = {0};
    range plain = {0};
    for (uint64_t k = 0; k < 9 * N; ++k) {
        r.gradient[k] = mor_random_uniform(1, k, 0) - 0.5;
    }
    for (uint64_t k = 0; k < N; ++k) {
        r.density[k] = 2000.0;
        r.stress[6 * k] = r.stress[6 * k + 1] = r.stress[6 * k + 2] = -1e3;
    }
    plain = r;
    mor_material_instance *inner = NULL;
    assert_int_equal(mor_material_create(&context, law_named("drucker_prager"), 2000.0, SOIL, &inner), MOR_OK);
    const mor_batch plain_batch = view(&plain);
    assert_int_equal(inner->operations.advance_rate(inner, &plain_batch), MOR_OK);
    mor_material_destroy(&context, &inner);
    mor_material_instance *checked = wrap(&context, law_named("drucker_prager"), SOIL, 1);
    const mor_batch batch = view(&r);
    assert_int_equal(run_all(checked, &batch), MOR_OK);
    char text[TEXT_BYTES];
    assert_int_equal(mor_checked_fault(checked, text, sizeof text), 0);
    assert_string_equal(text, "");
    assert_memory_equal(r.stress_out, plain.stress_out, sizeof r.stress_out);    /* exact */
    assert_memory_equal(r.age_out, plain.age_out, sizeof r.age_out);             /* exact */
    assert_memory_equal(r.dissipation, plain.dissipation, sizeof r.dissipation); /* exact */
    char description[MOR_MATERIAL_TEXT_BYTES];
    mor_material_describe(&context, checked, description, sizeof description);
    assert_non_null(strstr(description, "youngs_modulus = 5980000 Pa"));
    mor_material_destroy(&context, &checked);
    assert_int_equal(context.memory_bytes, 0);
}

static void every_breach_is_found_and_named(void **state)
{
    (void)state;
    static const char *const WORDS[N_MISDEEDS][2] = {
        [GOOD] = {"", ""},
        [SKIPS_STRESS] = {"left NaN", "stress_out"},
        [SKIPS_STATE] = {"left NaN", "fabric"},
        [SKIPS_DISSIPATION] = {"left NaN", "dissipation"},
        [WRITES_BEFORE] = {"wrote outside", "stress_out"},
        [WRITES_BEHIND] = {"wrote outside", "fabric"},
        [CHANGES_STRESS_IN] = {"changed its input", "stress_in"},
        [CHANGES_STATE_IN] = {"changed its input", "age"},
        [ASKS_FOR_N] = {"when the range is split", "stress_out"},
        [INFINITE_SPEED] = {"wave_speed", "the result"},
        [NAN_PRESSURE] = {"pressure", "the result"},
        [SKIPS_DIFFUSIVITY] = {"diffusivity", "the result"},
        [SKIPS_TANGENT] = {"tangent", "the result"},
    };
    for (int what = 0; what < N_MISDEEDS; ++what) {
        mor_context context;
        mor_context_init(&context);
        range r = {0};
        const double parameter = what;
        mor_material_instance *checked = wrap(&context, &ROGUE, &parameter, 1);
        const mor_batch batch = view(&r);
        const mor_status status = run_all(checked, &batch);
        char text[TEXT_BYTES];
        assert_int_equal(status, what == GOOD ? MOR_OK : MOR_ERROR_PLUGIN);
        assert_int_equal(mor_checked_fault(checked, text, sizeof text), what != GOOD);
        if (strstr(text, WORDS[what][0]) == NULL || strstr(text, WORDS[what][1]) == NULL) {
            fail_msg("misdeed %d: '%s' lacks '%s' or '%s'", what, text, WORDS[what][0], WORDS[what][1]);
        }
        mor_material_destroy(&context, &checked);
        assert_int_equal(context.memory_bytes, 0);
    }
}

static void splits_are_tried_only_when_asked(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    range r = {0};
    const double parameter = ASKS_FOR_N;
    mor_material_instance *checked = wrap(&context, &ROGUE, &parameter, 0);
    const mor_batch batch = view(&r);
    char text[TEXT_BYTES];
    assert_int_equal(run_all(checked, &batch), MOR_OK);
    assert_int_equal(mor_checked_fault(checked, text, sizeof text), 0);
    mor_material_destroy(&context, &checked);
}

static void failures_of_the_material_pass_through_with_the_place(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    range r = {0};
    mor_material_instance *checked = wrap(&context, law_named("drucker_prager"), SOIL, 1);
    const mor_batch batch = view(&r);
    r.gradient[9 * 70 + 1] = 1e9;
    assert_int_equal(checked->operations.advance_rate(checked, &batch), MOR_RETRY_SMALLER_STEP);
    assert_int_equal(r.failed, 70);
    char text[TEXT_BYTES];
    assert_int_equal(mor_checked_fault(checked, text, sizeof text), 0); /* refusing is no breach */
    double stored[N];
    assert_int_equal(checked->operations.energy(checked, &batch, stored), MOR_OK);
    mor_material_destroy(&context, &checked);
}

static void in_place_update_is_checked_with_separate_arrays(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    range r = {0};
    const double parameter = GOOD;
    mor_material_instance *checked = wrap(&context, &ROGUE, &parameter, 1);
    mor_batch batch = view(&r);
    double *in_place[2] = {r.age, r.fabric};
    batch.stress_out = r.stress;
    batch.state_out = in_place;
    assert_int_equal(checked->operations.advance_rate(checked, &batch), MOR_OK);
    for (int k = 0; k < 6 * N; ++k) {
        assert_true(r.stress[k] == 1.0); /* exact */
    }
    assert_true(r.age[0] == 1.0 && r.age[N - 1] == 1.0); /* exact */
    mor_material_destroy(&context, &checked);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_material_passes_and_numbers_are_its_own),
        cmocka_unit_test(every_breach_is_found_and_named),
        cmocka_unit_test(splits_are_tried_only_when_asked),
        cmocka_unit_test(failures_of_the_material_pass_through_with_the_place),
        cmocka_unit_test(in_place_update_is_checked_with_separate_arrays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
