/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/material/checked.h"
#include "core/material/kit/integration.h"
#include "core/material/rate_integration.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* An elastic solid that forgets: d(stress)/dt = 2 G D - stress / T, with a tensor that counts the strain. */
enum { MODULUS, TIME, INTEGRATION, N_VALUES = INTEGRATION + MOR_INTEGRATION_COUNT };

static const mor_schema PARAMETERS[] = {
    {.key = "modulus",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "Pa",
     .is_required = 1,
     .maximum = 1e12,
     .text = "twice the shear modulus"},
    {.key = "time",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "s",
     .is_required = 1,
     .maximum = 1e12,
     .text = "relaxation time"},
    MOR_INTEGRATION_SCHEMAS("explicit|implicit|bdf", 1e-6, 1e-3, 500.0),
    {.key = NULL},
};

static const mor_schema STATE[] = {
    {.key = "strain",
     .kind = MOR_SCHEMA_VECTOR,
     .n_components = 6,
     .unit = "1",
     .minimum = -INFINITY,
     .maximum = INFINITY,
     .text = "strain that turns with the particle"},
    {.key = NULL},
};

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
        speed[i] = 1.0;
    }
    return MOR_OK;
}

static mor_status stress_rate(const mor_material_instance *instance, const mor_batch *batch, double *rate,
                              double *const *state_rate)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *l = batch->velocity_gradient + 9 * i;
        const double d[6] = {l[0], l[4], l[8], l[1], l[5], l[6]};
        for (int a = 0; a < 6; ++a) {
            const double stress = batch->stress_in[6 * i + a];
            if (!(fabs(stress) < 1e9)) {
                return MOR_RETRY_SMALLER_STEP; /* not defined */
            }
            rate[6 * i + a] = instance->parameters[MODULUS] * d[a] - stress / instance->parameters[TIME];
            state_rate[0][6 * i + a] = d[a];
        }
    }
    return MOR_OK;
}

static const mor_material FORGETFUL = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "forgetful",
    .version = "1",
    .text = "Maxwell solid",
    .literature = "Maxwell (1867)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_RATE_DEPENDENT,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations = {.create = create, .destroy = destroy, .wave_speed = wave_speed, .stress_rate = stress_rate},
};

static mor_status skip_state_rate(const mor_material_instance *instance, const mor_batch *batch, double *rate,
                                  double *const *state_rate)
{
    (void)state_rate;
    for (int64_t k = 0; k < 6 * batch->n; ++k) {
        rate[k] = -batch->stress_in[k] / instance->parameters[TIME];
    }
    return MOR_OK;
}

static mor_status skip_stress_rate(const mor_material_instance *instance, const mor_batch *batch, double *rate,
                                   double *const *state_rate)
{
    (void)instance;
    for (int64_t k = 0; k < 6 * batch->n; ++k) {
        rate[k] = k % 6 == 4 ? rate[k] : 0.0; /* all but one component */
        state_rate[0][k] = 0.0;
    }
    return MOR_OK;
}

static mor_material_instance *make_of(mor_context *context, const mor_material *law, double time, int method,
                                      int n_threads)
{
    const double values[N_VALUES] = {1e6, time, method, 1e-6, 1e-3, 500.0};
    mor_material_instance *instance = NULL;
    mor_context_init(context);
    context->n_threads = n_threads;
    if (mor_material_create(context, law, 1000.0, values, &instance) != MOR_OK) {
        fail_msg("%s", context->message);
    }
    return instance;
}

static mor_material_instance *make(mor_context *context, double time, int method, int n_threads)
{
    return make_of(context, &FORGETFUL, time, method, n_threads);
}

static void discard(mor_context *context, mor_material_instance **instance)
{
    mor_material_destroy(context, instance);
    assert_int_equal(context->memory_bytes, 0);
}

enum { N = 517 }; /* no multiple of the blocks that are worked on at once */

typedef struct arrays {
    double density[N], gradient[9 * N], extra[6 * N], stress[6 * N], strain[6 * N];
    double stress_out[6 * N], strain_out[6 * N];
} arrays;

/* Motions of very different size, so that some need one step, some many. */
static void fill(arrays *a)
{
    memset(a, 0, sizeof *a);
    for (uint64_t k = 0; k < N; ++k) {
        const double size = pow(10.0, -5.0 + 4.5 * mor_random_uniform(4, k, 0));
        a->density[k] = 1000.0;
        for (uint64_t c = 0; c < 9; ++c) {
            a->gradient[9 * k + c] = size * (2.0 * mor_random_uniform(4, k, 1 + c) - 1.0);
        }
        for (uint64_t c = 0; c < 6; ++c) {
            a->stress[6 * k + c] = 1e4 * (2.0 * mor_random_uniform(4, k, 10 + c) - 1.0);
            a->extra[6 * k + c] = 10.0 * (2.0 * mor_random_uniform(4, k, 16 + c) - 1.0);
        }
    }
}

static mor_status advance(const mor_material_instance *instance, arrays *a, int64_t first, int64_t n)
{
    const double *state_in[] = {a->strain + 6 * first};
    double *state_out[] = {a->strain_out + 6 * first};
    const mor_batch batch = {.n = n,
                             .time_step = 1.0,
                             .density = a->density + first,
                             .velocity_gradient = a->gradient + 9 * first,
                             .extra_stress_rate = a->extra + 6 * first,
                             .stress_in = a->stress + 6 * first,
                             .stress_out = a->stress_out + 6 * first,
                             .state_in = state_in,
                             .state_out = state_out};
    return instance->operations.advance_rate(instance, &batch);
}

static void bits_and_counts_depend_on_no_grouping_order_or_thread(void **state)
{
    (void)state;
    static arrays whole;
    static arrays parts;
    for (int method = 0; method < 3; ++method) {
        mor_context context;
        mor_integration_statistics expected = {0};
        mor_material_instance *instance = make(&context, 2.0, method, 1);
        fill(&whole);
        assert_int_equal(advance(instance, &whole, 0, N), MOR_OK);
        mor_rate_integration_add(instance, &expected);
        assert_int_equal(expected.n_updates, N);
        assert_true(expected.n_sub_steps > N && expected.n_rates > 2 * N);
        discard(&context, &instance);
        for (int chunk = 1; chunk < 60; chunk += 19) {
            mor_integration_statistics taken = {0};
            fill(&parts);
            instance = make(&context, 2.0, method, 3);
            const int64_t n_chunks = (N + chunk - 1) / chunk;
            MOR_PARALLEL_FOR (&context, k, n_chunks, 1) {
                const int64_t first = (n_chunks - 1 - k) * chunk; /* the last ones first */
                advance(instance, &parts, first, N - first < chunk ? N - first : chunk);
            }
            mor_rate_integration_add(instance, &taken);
            assert_memory_equal(&parts, &whole, sizeof whole);    /* exact */
            assert_memory_equal(&taken, &expected, sizeof taken); /* exact */
            discard(&context, &instance);
        }
    }
}

/* stress' = 2 G D + extra - stress / T has the solution s = s_end + (s_start - s_end) exp(-t / T). */
static void relaxation_has_its_closed_form_by_every_method(void **state)
{
    (void)state;
    static const double times[2] = {1.0, 1e-4}; /* not stiff, stiff */
    for (int method = 0; method < 3; ++method) {
        for (int stiff = 0; stiff < (method == 0 ? 1 : 2); ++stiff) {
            static arrays a;
            mor_context context;
            mor_material_instance *instance = make(&context, times[stiff], method, 1);
            fill(&a);
            a.gradient[1] = a.gradient[2] = a.gradient[3] = a.gradient[5] = a.gradient[6] = a.gradient[7] = 0.0;
            assert_int_equal(advance(instance, &a, 0, 1), MOR_OK);
            for (int c = 0; c < 3; ++c) {
                const double end = times[stiff] * (1e6 * a.gradient[4 * c] + a.extra[c]);
                const double expected = end + (a.stress[c] - end) * exp(-1.0 / times[stiff]);
                assert_true(fabs(a.stress_out[c] - expected) <
                            1.0); /* 1e-6 of 1e4 Pa per sub-step, at most a hundred */
                assert_true(fabs(a.strain_out[c] - a.gradient[4 * c]) < 1e-12); /* linear: exact but for rounding */
            }
            discard(&context, &instance);
        }
    }
}

static void stress_and_tensors_turn_with_a_rigid_rotation(void **state)
{
    (void)state;
    static arrays a;
    mor_context context;
    mor_material_instance *instance = make(&context, 1e12, 0, 1);
    memset(&a, 0, sizeof a);
    a.density[0] = 1000.0;
    a.stress[0] = 1e4;
    a.strain[0] = 0.5;
    a.gradient[3] = 0.02;
    a.gradient[1] = -0.02;
    for (int k = 0; k < 50; ++k) { /* one radian about z */
        assert_int_equal(advance(instance, &a, 0, 1), MOR_OK);
        memcpy(a.stress, a.stress_out, sizeof a.stress);
        memcpy(a.strain, a.strain_out, sizeof a.strain);
    }
    const double cosine2 = cos(1.0) * cos(1.0);
    assert_true(fabs(a.stress[0] / 1e4 - cosine2) < 1e-5);              /* angle^2/48 of each step */
    assert_true(fabs(a.strain[0] / 0.5 - cosine2) < 1e-5);              /* likewise */
    assert_true(fabs((a.stress[0] + a.stress[1]) / 1e4 - 1.0) < 1e-10); /* relaxation of 50 s in 1e12 s */
    discard(&context, &instance);
}

static void failures_ask_for_a_smaller_step_and_name_the_particle(void **state)
{
    (void)state;
    static arrays a;
    mor_context context;
    mor_integration_statistics taken = {0};
    mor_material_instance *instance = make(&context, 2.0, 0, 1);
    int64_t failed = -1;
    fill(&a);
    a.stress[6 * 40 + 2] = 2e9; /* where the law has no rate */
    const double *state_in[] = {a.strain};
    double *state_out[] = {a.strain_out};
    mor_batch batch = {.n = N,
                       .time_step = 1.0,
                       .density = a.density,
                       .velocity_gradient = a.gradient,
                       .stress_in = a.stress,
                       .stress_out = a.stress_out,
                       .state_in = state_in,
                       .state_out = state_out,
                       .failed = &failed};
    assert_int_equal(instance->operations.advance_rate(instance, &batch), MOR_RETRY_SMALLER_STEP);
    assert_int_equal(failed, 40);
    mor_rate_integration_add(instance, &taken);
    assert_int_equal(taken.n_failures, 1);
    assert_int_equal(taken.n_updates, 0);
    a.stress[6 * 40 + 2] = 0.0;
    a.gradient[9 * 50] = NAN;
    assert_int_equal(instance->operations.advance_rate(instance, &batch), MOR_ERROR_NUMERIC);
    assert_int_equal(failed, 50);
    taken = (mor_integration_statistics){0};
    mor_rate_integration_add(instance, &taken);
    assert_int_equal(taken.n_failures, 1); /* nothing is repeated after an error that is fatal */
    assert_int_equal(taken.n_updates, 0);
    a.gradient[9 * 50] = 2.0; /* no small increment */
    assert_int_equal(instance->operations.advance_rate(instance, &batch), MOR_RETRY_SMALLER_STEP);
    discard(&context, &instance);
}

/* By every method; the rates of a good law, which lie where the next one's will, are none of it. */
static void law_that_leaves_rates_unwritten_is_refused(void **state)
{
    (void)state;
    static arrays a;
    mor_status (*const skips[])(const mor_material_instance *, const mor_batch *, double *,
                                double *const *) = {skip_state_rate, skip_stress_rate};
    for (int k = 0; k < 2; ++k) {
        for (int method = 0; method < 3; ++method) {
            mor_context context;
            mor_material law = FORGETFUL;
            mor_material_instance *good = make(&context, 2.0, method, 1);
            fill(&a);
            assert_int_equal(advance(good, &a, 0, N), MOR_OK);
            discard(&context, &good);
            law.operations.stress_rate = skips[k];
            mor_material_instance *instance = make_of(&context, &law, 2.0, method, 1);
            assert_int_equal(advance(instance, &a, 0, N), MOR_RETRY_SMALLER_STEP);
            assert_int_equal(advance(instance, &a, 7, 1), MOR_RETRY_SMALLER_STEP);
            discard(&context, &instance);
        }
    }
}

static void a_guarded_instance_counts_and_is_freed_once(void **state)
{
    (void)state;
    static arrays a;
    mor_context context;
    mor_integration_statistics taken = {0};
    mor_material_instance *inner = make(&context, 2.0, 0, 1);
    mor_material_instance *checked = NULL;
    char fault[256];
    assert_int_equal(mor_checked_create(&context, &inner, 0, &checked), MOR_OK);
    fill(&a);
    assert_int_equal(advance(checked, &a, 0, N), MOR_OK);
    assert_false(mor_checked_fault(checked, fault, sizeof fault));
    mor_rate_integration_add(checked, &taken);
    assert_int_equal(taken.n_updates, N);
    discard(&context, &checked);
}

static mor_status do_nothing(const mor_material_instance *instance, const mor_batch *batch)
{
    (void)instance;
    (void)batch;
    return MOR_OK;
}

static void wrong_tables_of_operations_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_material wrong = FORGETFUL;
    wrong.operations.stress_rate = NULL;
    assert_int_equal(mor_material_verify(&context, &wrong), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "one of advance_rate and stress_rate"));
    wrong = FORGETFUL;
    wrong.capabilities |= MOR_MATERIAL_DISSIPATION;
    assert_int_equal(mor_material_verify(&context, &wrong), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "no dissipation"));
    wrong = FORGETFUL;
    wrong.form = MOR_MATERIAL_TOTAL;
    wrong.operations.stress_total = do_nothing;
    assert_int_equal(mor_material_verify(&context, &wrong), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "neither stress_rate nor limit"));
    wrong.operations.stress_rate = NULL;
    wrong.operations.limit = do_nothing;
    assert_int_equal(mor_material_verify(&context, &wrong), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "neither stress_rate nor limit"));
    wrong.operations.limit = NULL;
    assert_int_equal(mor_material_verify(&context, &wrong), MOR_OK);
}

/* A run would stop at its first snapshot, after all that comes before. */
static void state_that_no_snapshot_can_name_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    char text[MOR_MATERIAL_STATE_TEXT_BYTES + 1];
    memset(text, 'a', sizeof text);
    text[MOR_MATERIAL_STATE_TEXT_BYTES] = '\0';
    mor_schema table[2] = {FORGETFUL.state[0], {.key = NULL}};
    mor_material law = FORGETFUL;
    law.state = table;
    table[0].text = text + 1; /* as long as may be */
    assert_int_equal(mor_material_verify(&context, &law), MOR_OK);
    table[0].text = text;
    assert_int_equal(mor_material_verify(&context, &law), MOR_ERROR_PLUGIN);
    assert_non_null(
        strstr(context.message, "a text of 192 bytes; allowed in snapshots are 47, 31 and 191; shorten it"));
    table[0] = FORGETFUL.state[0];
    table[0].key = text + MOR_MATERIAL_STATE_TEXT_BYTES - MOR_MATERIAL_STATE_KEY_BYTES;
    assert_int_equal(mor_material_verify(&context, &law), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "with a key of 48,"));
    table[0] = FORGETFUL.state[0];
    table[0].unit = text + MOR_MATERIAL_STATE_TEXT_BYTES - MOR_MATERIAL_STATE_UNIT_BYTES;
    assert_int_equal(mor_material_verify(&context, &law), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "a unit of 32 "));
    table[0] = FORGETFUL.state[0];
    table[0].key = "id";
    assert_int_equal(mor_material_verify(&context, &law), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "named 'id', which is the name of the numbers of particles"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_and_counts_depend_on_no_grouping_order_or_thread),
        cmocka_unit_test(relaxation_has_its_closed_form_by_every_method),
        cmocka_unit_test(stress_and_tensors_turn_with_a_rigid_rotation),
        cmocka_unit_test(failures_ask_for_a_smaller_step_and_name_the_particle),
        cmocka_unit_test(law_that_leaves_rates_unwritten_is_refused),
        cmocka_unit_test(a_guarded_instance_counts_and_is_freed_once),
        cmocka_unit_test(wrong_tables_of_operations_are_refused),
        cmocka_unit_test(state_that_no_snapshot_can_name_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
