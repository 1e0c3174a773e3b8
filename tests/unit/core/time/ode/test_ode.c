/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/time/ode/ode.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double LOOSE[8] = {1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10, 1e-10};

typedef struct bounds {
    double least, most; /* times at which the rate was requested */
    double decay;
    mor_status refusal;
    double threshold;
} bounds;

static mor_ode *make(mor_context *context, mor_ode_method method, int n)
{
    mor_context_init(context);
    mor_ode *ode = NULL;
    const mor_ode_settings settings = {
        .method = method, .n = n, .relative_tolerance = 1e-9, .absolute_tolerance = LOOSE, .n_steps_max = 20000};
    assert_int_equal(mor_ode_new(context, &settings, &ode), MOR_OK);
    return ode;
}

static void discard(mor_context *context, mor_ode **ode)
{
    mor_ode_free(context, ode);
    assert_null(*ode);
    assert_int_equal(context->memory_bytes, 0);
}

static mor_status decay(double t, const double *y, double *y_rate, void *user)
{
    bounds *seen = user;
    seen->least = fmin(seen->least, t);
    seen->most = fmax(seen->most, t);
    y_rate[0] = -seen->decay * y[0];
    return MOR_OK;
}

static void decay_is_exponential_and_asked_inside_the_span(void **state)
{
    (void)state;
    for (int method = MOR_ODE_EXPLICIT; method <= MOR_ODE_IMPLICIT; ++method) {
        mor_context context;
        mor_ode *ode = make(&context, (mor_ode_method)method, 1);
        bounds seen = {.least = INFINITY, .most = -INFINITY, .decay = 3.0};
        double y = 2.0;
        mor_ode_report report;
        assert_int_equal(mor_ode_solve(ode, decay, &seen, (const double[]){5.0, 6.0}, &y, &report), MOR_OK);
        assert_true(fabs(y - 2.0 * exp(-3.0)) < 1e-6);             /* local tolerance 1e-9, a few hundred steps */
        assert_true(seen.least >= 5.0 && seen.most <= 6.0 + 1e-9); /* the difference quotient may round at the end */
        assert_true(report.n_steps > 1 && report.n_rates > report.n_steps);
        assert_string_equal(mor_ode_reason(ode), "");
        discard(&context, &ode);
    }
}

static mor_status robertson(double t, const double *y, double *y_rate, void *user)
{
    (void)t;
    (void)user;
    y_rate[0] = -0.04 * y[0] + 1e4 * y[1] * y[2];
    y_rate[2] = 3e7 * y[1] * y[1];
    y_rate[1] = -y_rate[0] - y_rate[2];
    return MOR_OK;
}

static void stiff_method_solves_robertson(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double small[3] = {1e-12, 1e-14, 1e-12};
    const mor_ode_settings settings = {
        .method = MOR_ODE_STIFF, .n = 3, .relative_tolerance = 1e-8, .absolute_tolerance = small, .n_steps_max = 5000};
    mor_ode *ode = NULL;
    assert_int_equal(mor_ode_new(&context, &settings, &ode), MOR_OK);
    double y[3] = {1.0, 0.0, 0.0};
    mor_ode_report report;
    assert_int_equal(mor_ode_solve(ode, robertson, NULL, (const double[]){0.0, 40.0}, y, &report), MOR_OK);
    /* Reference at t = 40 to seven digits (Hairer and Wanner, Solving ODEs II). */
    assert_true(fabs(y[0] - 0.7158270687) < 1e-6);      /* local tolerance 1e-8, some hundred steps */
    assert_true(fabs(y[1] - 9.185534765e-6) < 1e-10);   /* likewise, relative 1e-5 */
    assert_true(fabs(y[0] + y[1] + y[2] - 1.0) < 1e-9); /* linear invariant kept by the method to Newton's tolerance */
    assert_true(report.n_steps < 1000);                 /* an explicit method would need some ten thousand */
    discard(&context, &ode);
}

/* Jaumann rate of an elastic solid in simple shear at rate 1: d(s12) = G - s11, d(s11) = s12, G = 1. */
static mor_status hypoelastic_shear(double t, const double *y, double *y_rate, void *user)
{
    (void)t;
    (void)user;
    y_rate[0] = y[1];
    y_rate[1] = 1.0 - y[0];
    return MOR_OK;
}

static void hypoelastic_shear_follows_sine_and_cosine(void **state)
{
    (void)state;
    for (int method = MOR_ODE_EXPLICIT; method <= MOR_ODE_IMPLICIT; ++method) {
        mor_context context;
        mor_ode *ode = make(&context, (mor_ode_method)method, 2);
        double y[2] = {0.0, 0.0};
        assert_int_equal(mor_ode_solve(ode, hypoelastic_shear, NULL, (const double[]){0.0, 1.0}, y, NULL), MOR_OK);
        assert_true(fabs(y[0] - (1.0 - cos(1.0))) < 1e-6); /* local tolerance 1e-9, a few hundred steps */
        assert_true(fabs(y[1] - sin(1.0)) < 1e-6);         /* likewise */
        discard(&context, &ode);
    }
}

static void result_does_not_depend_on_what_was_solved_before(void **state)
{
    (void)state;
    for (int method = MOR_ODE_EXPLICIT; method <= MOR_ODE_IMPLICIT; ++method) {
        mor_context context;
        mor_ode *ode = make(&context, (mor_ode_method)method, 2);
        double first[2] = {0.1, 0.2};
        double other[2] = {-40.0, 7.0};
        double again[2] = {0.1, 0.2};
        assert_int_equal(mor_ode_solve(ode, hypoelastic_shear, NULL, (const double[]){0.0, 1.0}, first, NULL), MOR_OK);
        assert_int_equal(mor_ode_solve(ode, hypoelastic_shear, NULL, (const double[]){0.0, 9.0}, other, NULL), MOR_OK);
        assert_int_equal(mor_ode_solve(ode, hypoelastic_shear, NULL, (const double[]){0.0, 1.0}, again, NULL), MOR_OK);
        assert_memory_equal(first, again, sizeof first); /* exact */
        discard(&context, &ode);
    }
}

static void short_span_late_in_a_run_is_not_lost(void **state)
{
    (void)state;
    mor_context context;
    mor_ode *ode = make(&context, MOR_ODE_EXPLICIT, 1);
    bounds seen = {.least = INFINITY, .most = -INFINITY, .decay = 1e12};
    double y = 1.0;
    const double span[2] = {1000.0, 1000.0 + 4.0 * 1.1368683772161603e-13};
    assert_int_equal(mor_ode_solve(ode, decay, &seen, span, &y, NULL), MOR_OK);
    assert_true(fabs(y - exp(-1e12 * (span[1] - span[0]))) < 1e-6); /* local tolerance 1e-9, a few hundred steps */
    double same = 1.0;
    assert_int_equal(mor_ode_solve(ode, decay, &seen, (const double[]){3.0, 3.0}, &same, NULL), MOR_OK);
    assert_true(same == 1.0); /* exact: an empty span is the identity */
    discard(&context, &ode);
}

static mor_status refuse_below(double t, const double *y, double *y_rate, void *user)
{
    const bounds *limit = user;
    (void)t;
    y_rate[0] = -1.0;
    if (y[0] >= limit->threshold) {
        return MOR_OK;
    }
    if (limit->refusal == MOR_OK) {
        y_rate[0] = NAN;
    }
    return limit->refusal;
}

static void failures_are_values_and_leave_the_start(void **state)
{
    (void)state;
    const mor_status refusals[3] = {MOR_RETRY_SMALLER_STEP, MOR_ERROR_NUMERIC, MOR_OK};
    const mor_status expected[3] = {MOR_RETRY_SMALLER_STEP, MOR_ERROR_NUMERIC, MOR_RETRY_SMALLER_STEP};
    for (int method = MOR_ODE_EXPLICIT; method <= MOR_ODE_IMPLICIT; ++method) {
        for (int k = 0; k < 3; ++k) {
            mor_context context;
            mor_ode *ode = make(&context, (mor_ode_method)method, 1);
            bounds limit = {.refusal = refusals[k], .threshold = 0.5};
            double y = 1.0;
            const mor_status status = mor_ode_solve(ode, refuse_below, &limit, (const double[]){0.0, 1.0}, &y, NULL);
            /* Creeping up to the place where f ends may also exhaust the smallest step: both ask for a retry. */
            assert_true(status == expected[k] || (expected[k] > MOR_OK && status == MOR_NOT_CONVERGED));
            assert_true(y == 1.0); /* exact: untouched */
            assert_true(strlen(mor_ode_reason(ode)) > 0);
            discard(&context, &ode);
        }
    }
}

static void too_few_steps_is_not_converged(void **state)
{
    (void)state;
    for (int method = MOR_ODE_EXPLICIT; method <= MOR_ODE_IMPLICIT; ++method) {
        mor_context context;
        mor_context_init(&context);
        const mor_ode_settings settings = {.method = (mor_ode_method)method,
                                           .n = 2,
                                           .relative_tolerance = 1e-10,
                                           .absolute_tolerance = LOOSE,
                                           .n_steps_max = 5};
        mor_ode *ode = NULL;
        assert_int_equal(mor_ode_new(&context, &settings, &ode), MOR_OK);
        double y[2] = {3.0, 0.0};
        const double span[2] = {0.0, 100.0};
        assert_int_equal(mor_ode_solve(ode, hypoelastic_shear, NULL, span, y, NULL), MOR_NOT_CONVERGED);
        assert_true(y[0] == 3.0 && y[1] == 0.0); /* exact: untouched */
        discard(&context, &ode);
    }
}

static mor_status climb(double t, const double *y, double *y_rate, void *user)
{
    (void)t;
    (void)y;
    (void)user;
    y_rate[0] = 1.0;
    return MOR_OK;
}

/* The fewest steps that may be allowed are enough for a solution that is a straight line. */
static void one_step_can_be_all_that_is_allowed(void **state)
{
    (void)state;
    const mor_ode_method methods[] = {MOR_ODE_EXPLICIT, MOR_ODE_STIFF, MOR_ODE_IMPLICIT};
    for (int k = 0; k < 3; ++k) {
        for (int64_t n_steps = 1; n_steps <= 4; ++n_steps) {
            mor_context context;
            mor_context_init(&context);
            const mor_ode_settings settings = {.method = methods[k],
                                               .n = 1,
                                               .order = k == 1 ? 0 : 3,
                                               .relative_tolerance = 1e-4,
                                               .absolute_tolerance = LOOSE,
                                               .n_steps_max = n_steps};
            mor_ode *ode = NULL;
            mor_ode_report report = {0};
            double y = 2.0;
            if (mor_ode_new(&context, &settings, &ode) != MOR_OK) {
                fail_msg("%s", context.message);
            }
            mor_ode_set_first_step(ode, 0.5);
            assert_int_equal(mor_ode_solve(ode, climb, NULL, (const double[]){0.0, 0.5}, &y, &report), MOR_OK);
            assert_int_equal(report.n_steps, 1);
            assert_true(fabs(y - 2.5) < 1e-12); /* rounding, and of Newton's method */
            discard(&context, &ode);
        }
    }
}

static mor_ode_settings ask(mor_ode_method method, int n, double relative, const double *absolute, int64_t n_steps)
{
    return (mor_ode_settings){.method = method,
                              .n = n,
                              .relative_tolerance = relative,
                              .absolute_tolerance = absolute,
                              .n_steps_max = n_steps};
}

static void wrong_settings_are_refused_with_their_value(void **state)
{
    (void)state;
    const double negative[1] = {-1.0};
    const struct {
        mor_ode_settings settings;
        const char *word;
    } cases[] = {
        {ask(MOR_ODE_EXPLICIT, 0, 1e-6, LOOSE, 10), "n is 0"},
        {ask(MOR_ODE_STIFF, MOR_ODE_MAX + 1, 1e-6, LOOSE, 10), "n is 33"},
        {ask(MOR_ODE_EXPLICIT, 1, 0.5, LOOSE, 10), "relative_tolerance is 0.5"},
        {ask(MOR_ODE_EXPLICIT, 1, NAN, LOOSE, 10), "relative_tolerance"},
        {ask(MOR_ODE_EXPLICIT, 1, 1e-6, NULL, 10), "absolute_tolerance is missing"},
        {ask(MOR_ODE_EXPLICIT, 1, 1e-6, negative, 10), "absolute_tolerance[0] is -1"},
        {ask(MOR_ODE_EXPLICIT, 1, 1e-6, LOOSE, 0), "n_steps_max is 0"},
        {ask((mor_ode_method)7, 1, 1e-6, LOOSE, 10), "method is 7"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_ode *ode = NULL;
        assert_int_equal(mor_ode_new(&context, &cases[k].settings, &ode), MOR_ERROR_ARGUMENT);
        assert_null(ode);
        assert_non_null(strstr(context.message, cases[k].word));
        assert_int_equal(context.memory_bytes, 0);
    }
}

static void wrong_calls_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_ode *ode = make(&context, MOR_ODE_EXPLICIT, 1);
    bounds seen = {.decay = 1.0};
    double y = 1.0;
    double bad = NAN;
    const double span[2] = {0.0, 1.0};
    assert_int_equal(mor_ode_solve(ode, NULL, &seen, span, &y, NULL), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_ode_solve(ode, decay, &seen, NULL, &y, NULL), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_ode_solve(ode, decay, &seen, span, NULL, NULL), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_ode_solve(ode, decay, &seen, span, &bad, NULL), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_ode_solve(ode, decay, &seen, (const double[]){1.0, 0.0}, &y, NULL), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(mor_ode_reason(ode), "span"));
    discard(&context, &ode);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decay_is_exponential_and_asked_inside_the_span),
        cmocka_unit_test(stiff_method_solves_robertson),
        cmocka_unit_test(hypoelastic_shear_follows_sine_and_cosine),
        cmocka_unit_test(result_does_not_depend_on_what_was_solved_before),
        cmocka_unit_test(short_span_late_in_a_run_is_not_lost),
        cmocka_unit_test(failures_are_values_and_leave_the_start),
        cmocka_unit_test(one_step_can_be_all_that_is_allowed),
        cmocka_unit_test(too_few_steps_is_not_converged),
        cmocka_unit_test(wrong_settings_are_refused_with_their_value),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
