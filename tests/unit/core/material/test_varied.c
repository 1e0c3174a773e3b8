/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/material/checked.h"
#include "core/material/composite.h"
#include "core/material/params.h"
#include "core/material/varied.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Parameters that vary from particle to particle: each particle gets, bit for bit, what a law with its parameters alone
 * gives it, for every built-in law with a strength. */

enum { N = 61, STATES = MOR_MATERIAL_STATES_MAX, WIDTH = 9 };

/* Particles, and what a law makes of them. */
typedef struct particles {
    double density[N], gradient[9 * N], diffusion[6 * N], stress[6 * N];
    double state[STATES][WIDTH * N];
    double stress_out[6 * N], state_out[STATES][WIDTH * N];
    double speed[N], distance[N];
} particles;

static double guess_value(const mor_schema *entry)
{
    if (isfinite(entry->maximum)) {
        return entry->minimum + 0.3 * (entry->maximum - entry->minimum);
    }
    return entry->minimum + (strcmp(entry->unit, "Pa") == 0 ? 1e4 : 1.0);
}

static void set_by_key(const mor_material *law, const char *key, double value, double *values)
{
    const int entry = mor_params_find(law->parameters, key);
    if (entry >= 0) {
        values[mor_params_offset(law->parameters, entry)] = value;
    }
}

/* Sensible values by role, so that any built-in law gets them. */
static void fill_parameters(const mor_material *law, double *values)
{
    static const double by_role[MOR_ROLE_COUNT] = {
        [MOR_ROLE_YOUNGS_MODULUS] = 5.98e6, [MOR_ROLE_POISSONS_RATIO] = 0.3,  [MOR_ROLE_SHEAR_MODULUS] = 2.3e6,
        [MOR_ROLE_BULK_MODULUS] = 4.98e6,   [MOR_ROLE_FRICTION_ANGLE] = 0.45, [MOR_ROLE_COHESION] = 800.0,
        [MOR_ROLE_DILATION_ANGLE] = 0.1,    [MOR_ROLE_TENSION_RATIO] = 1.0};
    mor_params_defaults(law->parameters, values);
    for (int k = 0; law->parameters[k].key != NULL; ++k) {
        const mor_schema *entry = &law->parameters[k];
        if (entry->role != MOR_ROLE_NONE && entry->role < MOR_ROLE_INTEGRATION_METHOD) {
            values[mor_params_offset(law->parameters, k)] = by_role[entry->role];
        } else if (entry->is_required) {
            values[mor_params_offset(law->parameters, k)] = guess_value(entry);
        }
    }
    set_by_key(law, "densest_void_ratio", 0.61, values);
    set_by_key(law, "void_ratio", 0.75, values);
    set_by_key(law, "critical_void_ratio", 0.98, values);
    set_by_key(law, "loosest_void_ratio", 1.1, values);
}

static void fill_particles(particles *it)
{
    memset(it, 0, sizeof *it);
    for (uint64_t k = 0; k < 9 * N; ++k) {
        it->gradient[k] = 40.0 * (mor_random_uniform(3, k, 0) - 0.5);
    }
    for (uint64_t k = 0; k < 6 * N; ++k) {
        it->stress[k] = (k % 6 < 3 ? -3e3 : 0.0) + 2e3 * (mor_random_uniform(3, k, 2) - 0.5);
        it->diffusion[k] = 1e4 * (mor_random_uniform(3, k, 4) - 0.5);
    }
    for (uint64_t k = 0; k < N; ++k) {
        it->density[k] = 2000.0;
    }
}

/* Initial state, a step, wave speed and yield distance of n particles from a first one on. */
static void run(const mor_material_instance *law, particles *it, int first, int n)
{
    const double *state_in[STATES];
    double *state[STATES];
    double *state_out[STATES];
    for (int k = 0; k < law->n_state; ++k) {
        const int width = law->material->state[k].n_components;
        state[k] = it->state[k] + first * width;
        state_in[k] = state[k];
        state_out[k] = it->state_out[k] + first * width;
    }
    mor_batch batch = {.n = n,
                       .time_step = 1e-4,
                       .density = it->density + first,
                       .velocity_gradient = it->gradient + 9 * first,
                       .extra_stress_rate = it->diffusion + 6 * first,
                       .stress_in = it->stress + 6 * first,
                       .stress_out = it->stress_out + 6 * first,
                       .state_in = state_in,
                       .state_out = state};
    assert_int_equal(law->operations.init_state(law, &batch), MOR_OK);
    batch.state_out = state_out;
    assert_int_equal(law->operations.advance_rate(law, &batch), MOR_OK);
    assert_int_equal(law->operations.wave_speed(law, &batch, it->speed + first), MOR_OK);
    batch.stress_in = batch.stress_out;
    batch.state_in = (const double *const *)state_out;
    assert_int_equal(law->operations.admissible(law, &batch, it->distance + first), MOR_OK);
}

static void make(mor_context *context, const mor_material *law, const double *values, mor_material_instance **instance)
{
    assert_int_equal(mor_material_create(context, law, 2000.0, values, instance), MOR_OK);
}

/* Runs of equal values, one of them those of the law's own instance, and single ones. */
static double vary(int i, double value)
{
    return i < 20 ? 1.25 * value : i < 35 ? value : (1.0 + 0.01 * (i % 7)) * value;
}

static void compare(mor_context *context, const mor_material *law, int entry, const double *values)
{
    static particles varied;
    static particles alone;
    mor_material_instance *inner = NULL;
    mor_material_instance *instance = NULL;
    const int offset = mor_params_offset(law->parameters, entry);
    make(context, law, values, &inner);
    assert_int_equal(mor_varied_create(context, &inner, &entry, 1, &instance), MOR_OK);
    assert_null(inner);
    fill_particles(&varied);
    fill_particles(&alone);
    const int own = instance->n_state - 1;
    for (int i = 0; i < N; ++i) {
        varied.state[own][i] = vary(i, values[offset]);
    }
    mor_varied_set_assigned(instance, 1);
    run(instance, &varied, 0, N);
    for (int i = 0; i < N; ++i) {
        double of_particle[MOR_MATERIAL_PARAMETERS_MAX];
        mor_material_instance *single = NULL;
        memcpy(of_particle, values, sizeof of_particle);
        of_particle[offset] = vary(i, values[offset]);
        make(context, law, of_particle, &single);
        run(single, &alone, i, 1);
        mor_material_destroy(context, &single);
        assert_true(varied.state_out[own][i] == of_particle[offset]); /* exact: passed on */
    }
    assert_memory_equal(varied.stress_out, alone.stress_out, sizeof alone.stress_out);
    assert_memory_equal(varied.state_out, alone.state_out, (size_t)own * sizeof *alone.state_out);
    assert_memory_equal(varied.speed, alone.speed, sizeof alone.speed);
    assert_memory_equal(varied.distance, alone.distance, sizeof alone.distance);
    mor_material_destroy(context, &instance);
}

static void each_particle_gets_the_bits_of_a_law_with_its_parameters(void **state)
{
    static const mor_role roles[] = {MOR_ROLE_COHESION, MOR_ROLE_FRICTION_ANGLE, MOR_ROLE_DILATION_ANGLE,
                                     MOR_ROLE_YOUNGS_MODULUS};
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    mor_context context;
    int n_compared = 0;
    (void)state;
    mor_context_init(&context);
    for (int k = 0; k < list->n_materials; ++k) {
        const mor_material *law = list->materials[k];
        for (size_t r = 0; r < sizeof roles / sizeof *roles && law->form == MOR_MATERIAL_RATE; ++r) {
            double values[MOR_MATERIAL_PARAMETERS_MAX] = {0.0};
            const int entry = mor_params_find_role(law->parameters, roles[r]);
            fill_parameters(law, values);
            if (entry >= 0) {
                compare(&context, law, entry, values);
                n_compared += 1;
            }
        }
    }
    assert_true(n_compared >= 15); /* nine laws have a strength, and most of them more than one of the roles */
    assert_int_equal(context.memory_bytes, 0);
}

/* A law inside of a composite and behind the checks: inputs untouched, outputs whole, the same bits in parts. */
static void checks_find_no_breach(void **state)
{
    static particles it;
    const mor_material *law = law_named("mohr_coulomb");
    const int entries[] = {mor_params_find(law->parameters, "cohesion"),
                           mor_params_find(law->parameters, "friction_angle")};
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0.0};
    mor_context context;
    mor_material_instance *parts[2] = {NULL};
    mor_material_instance *both = NULL;
    mor_material_instance *checked = NULL;
    mor_material_instance *inner = NULL;
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    (void)state;
    mor_context_init(&context);
    fill_parameters(law, values);
    make(&context, law, values, &inner);
    assert_int_equal(mor_varied_create(&context, &inner, entries, 2, &parts[0]), MOR_OK);
    make(&context, law, values, &parts[1]);
    mor_varied_set_assigned(parts[0], 1);
    assert_int_equal(mor_composite_create(&context, (const mor_material_instance *const *)parts, 2, &both), MOR_OK);
    assert_int_equal(mor_checked_create(&context, &both, 1, &checked), MOR_OK);
    fill_particles(&it);
    for (int i = 0; i < N; ++i) {
        it.state[0][i] = i % 3 == 0;
        it.state[2][i] = vary(i, 800.0);
        it.state[3][i] = vary(i + 17, 0.4);
    }
    run(checked, &it, 0, N);
    if (mor_checked_fault(checked, text, sizeof text)) {
        fail_msg("%s", text);
    }
    mor_material_destroy(&context, &checked);
    mor_material_destroy(&context, &parts[0]);
    mor_material_destroy(&context, &parts[1]);
    /* Alone behind the checks, too. */
    make(&context, law, values, &inner);
    assert_int_equal(mor_varied_create(&context, &inner, entries, 2, &parts[0]), MOR_OK);
    mor_varied_set_assigned(parts[0], 1);
    assert_int_equal(mor_checked_create(&context, &parts[0], 1, &checked), MOR_OK);
    fill_particles(&it);
    for (int i = 0; i < N; ++i) {
        it.state[1][i] = vary(i, 800.0);
        it.state[2][i] = vary(i + 17, 0.4);
    }
    run(checked, &it, 0, N);
    if (mor_checked_fault(checked, text, sizeof text)) {
        fail_msg("%s", text);
    }
    mor_material_destroy(&context, &checked);
    assert_int_equal(context.memory_bytes, 0);
}

static void particles_start_with_the_parameters_of_the_law(void **state)
{
    static particles it;
    const mor_material *law = law_named("tresca");
    const int entry = mor_params_find(law->parameters, "undrained_strength");
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0.0};
    double found[MOR_MATERIAL_PARAMETERS_MAX];
    mor_context context;
    mor_material_instance *inner = NULL;
    mor_material_instance *varied = NULL;
    (void)state;
    mor_context_init(&context);
    fill_parameters(law, values);
    make(&context, law, values, &inner);
    const mor_material_instance *own = inner;
    assert_int_equal(mor_varied_create(&context, &inner, &entry, 1, &varied), MOR_OK);
    fill_particles(&it);
    run(varied, &it, 0, N);
    assert_true(it.state_out[2][N - 1] == 800.0); /* exact: copied */
    assert_true(mor_varied_is(varied));
    assert_false(mor_varied_is(own));
    const double of_particle[] = {0.0, 1.0, 900.0};
    assert_ptr_equal(mor_varied_find_law(varied, of_particle, found), own);
    assert_true(found[mor_params_offset(law->parameters, entry)] == 900.0); /* exact: copied */
    assert_true(found[0] == values[0]);
    mor_material_destroy(&context, &varied);
    assert_int_equal(context.memory_bytes, 0);
}

static void expect_refusal(const char *name, const char *key, double value, const char *part)
{
    const mor_material *law = law_named(name);
    const int entry = mor_params_find(law->parameters, key);
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0.0};
    mor_context context;
    mor_material_instance *inner = NULL;
    mor_material_instance *varied = NULL;
    mor_context_init(&context);
    fill_parameters(law, values);
    make(&context, law, values, &inner);
    mor_status status = mor_varied_create(&context, &inner, &entry, 1, &varied);
    if (status == MOR_OK) {
        values[mor_params_offset(law->parameters, entry)] = value;
        status = mor_varied_check(&context, varied, values);
    }
    assert_int_equal(status, MOR_ERROR_ARGUMENT);
    if (strstr(context.message, part) == NULL) {
        fail_msg("the message is '%s'; it does not hold '%s'", context.message, part);
    }
    mor_material_destroy(&context, &varied);
    mor_material_destroy(&context, &inner);
    assert_int_equal(context.memory_bytes, 0);
}

static void what_a_law_cannot_take_is_refused_with_the_reason(void **state)
{
    (void)state;
    expect_refusal("mohr_coulomb", "cohesion", -1.0, "cohesion");
    expect_refusal("mohr_coulomb", "friction_angle", 0.05, "would create energy"); /* below the dilation angle */
    expect_refusal("mohr_coulomb", "youngs_modulus", 1e8, "waves run at");
    expect_refusal("drucker_prager", "cone", 0.0, "no real number");
}

/* A law whose constants do not fit on the stack. */
static mor_status create_large(const mor_services *services, mor_material_instance *instance)
{
    return services->memory_new(services->context, &instance->data, 8192, 1, "large constants");
}

static void a_law_with_large_constants_is_refused(void **state)
{
    const mor_material *tresca = law_named("tresca");
    mor_material large = *tresca;
    const int entry = mor_params_find(large.parameters, "undrained_strength");
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0.0};
    mor_context context;
    mor_material_instance *inner = NULL;
    mor_material_instance *varied = NULL;
    (void)state;
    large.operations.create = create_large;
    mor_context_init(&context);
    fill_parameters(&large, values);
    make(&context, &large, values, &inner);
    assert_int_equal(mor_varied_create(&context, &inner, &entry, 1, &varied), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "cannot have parameters that vary in space"));
    mor_material_destroy(&context, &inner);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_particle_gets_the_bits_of_a_law_with_its_parameters),
        cmocka_unit_test(checks_find_no_breach),
        cmocka_unit_test(particles_start_with_the_parameters_of_the_law),
        cmocka_unit_test(what_a_law_cannot_take_is_refused_with_the_reason),
        cmocka_unit_test(a_law_with_large_constants_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
