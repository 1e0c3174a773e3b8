/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/gauge/signal_filter.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Filters of signals that are constant over steps of any length. */

enum { STEPS = 400, SIGNALS = 2 };

static const double pi = 3.14159265358979323846;

static double *new_memory(const mor_signal_filter *filter)
{
    double *memory = malloc((size_t)(mor_signal_filter_numbers(filter, SIGNALS) + 1) * sizeof *memory);
    assert_non_null(memory);
    mor_signal_filter_clear(filter, SIGNALS, memory);
    return memory;
}

/* Uneven steps and values, the same in each run. */
static double pick_step(int k)
{
    return 0.01 * (1.0 + 0.9 * sin(7.0 * k)) + (k % 50 == 0 ? 0.3 : 0.0);
}

static double pick_value(int k)
{
    return sin(0.3 * k) + (k % 17 == 0 ? 5.0 : 0.0);
}

/* Mean of the steps up to number `last` over the time that ends with it. */
static double find_mean(int last, double length)
{
    double sum = 0.0;
    double left = length;
    for (int k = last; k >= 0 && left > 0.0; --k) {
        const double taken = fmin(left, pick_step(k));
        sum += taken * pick_value(k);
        left -= taken;
    }
    return sum / (length - left);
}

static void running_mean_is_that_of_the_last_time(void **state)
{
    const mor_signal_filter filter = {.kind = MOR_SIGNAL_MEAN, .length = 0.7};
    double *memory = new_memory(&filter);
    (void)state;
    for (int k = 0; k < STEPS; ++k) {
        const double values[SIGNALS] = {pick_value(k), 3.0};
        double filtered[SIGNALS];
        mor_signal_filter_add(&filter, SIGNALS, pick_step(k), values, memory, filtered);
        /* The oldest 64th is interpolated: values differ by no more than 7 there. */
        assert_true(fabs(filtered[0] - find_mean(k, filter.length)) <= 7.0 / MOR_SIGNAL_POINTS);
        assert_true(fabs(filtered[1] - 3.0) <= 1e-12); /* rounding of integrals */
    }
    free(memory);
}

static void running_mean_is_exact_where_its_parts_end_with_steps(void **state)
{
    const mor_signal_filter filter = {.kind = MOR_SIGNAL_MEAN, .length = 1.0};
    double *memory = new_memory(&filter);
    double sum = 0.0;
    (void)state;
    for (int k = 0; k < 3 * MOR_SIGNAL_POINTS; ++k) {
        const double step = 1.0 / MOR_SIGNAL_POINTS;
        const double values[SIGNALS] = {pick_value(k), 0.0};
        double filtered[SIGNALS];
        mor_signal_filter_add(&filter, SIGNALS, step, values, memory, filtered);
        sum += values[0] - (k >= MOR_SIGNAL_POINTS ? pick_value(k - MOR_SIGNAL_POINTS) : 0.0);
        const int n = k < MOR_SIGNAL_POINTS ? k + 1 : MOR_SIGNAL_POINTS;
        assert_true(fabs(filtered[0] - sum / n) <= 1e-12); /* rounding */
    }
    free(memory);
}

static void low_pass_follows_the_closed_form_of_a_jump(void **state)
{
    const mor_signal_filter filter = {.kind = MOR_SIGNAL_LOW_PASS, .cutoff = 2.0};
    double *memory = new_memory(&filter);
    const double rate = sqrt(2.0) * pi * filter.cutoff;
    double time = 0.0;
    double largest = 0.0;
    double filtered[SIGNALS];
    (void)state;
    mor_signal_filter_add(&filter, SIGNALS, 0.1, (const double[SIGNALS]){0.0, 1.0}, memory, filtered);
    for (int k = 0; k < STEPS; ++k) {
        const double step = 0.1 * pick_step(k);
        mor_signal_filter_add(&filter, SIGNALS, step, (const double[SIGNALS]){1.0, 1.0}, memory, filtered);
        time += step;
        const double expected = 1.0 - exp(-rate * time) * (cos(rate * time) + sin(rate * time));
        assert_true(fabs(filtered[0] - expected) <= 1e-12); /* rounding of some hundred steps */
        assert_true(filtered[1] == 1.0);                    /* it begins at rest */
        largest = fmax(largest, filtered[0]);
    }
    assert_true(fabs(largest - 1.0 - exp(-pi)) < 2e-3); /* 4.3 %, at one of these times */
    free(memory);
}

static void low_pass_halves_the_power_at_its_cutoff(void **state)
{
    const mor_signal_filter filter = {.kind = MOR_SIGNAL_LOW_PASS, .cutoff = 1.0};
    double *memory = new_memory(&filter);
    double largest = 0.0;
    (void)state;
    for (int k = 0; k < 20000; ++k) {
        const double step = 1e-3;
        const double values[SIGNALS] = {sin(2.0 * pi * (k + 0.5) * step), 0.0};
        double filtered[SIGNALS];
        mor_signal_filter_add(&filter, SIGNALS, step, values, memory, filtered);
        largest = k > 10000 ? fmax(largest, filtered[0]) : 0.0;
    }
    assert_true(fabs(largest - sqrt(0.5)) < 1e-4); /* a sine in a thousand steps */
    free(memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(running_mean_is_that_of_the_last_time),
        cmocka_unit_test(running_mean_is_exact_where_its_parts_end_with_steps),
        cmocka_unit_test(low_pass_follows_the_closed_form_of_a_jump),
        cmocka_unit_test(low_pass_halves_the_power_at_its_cutoff),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
