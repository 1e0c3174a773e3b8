/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_sum.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Percentiles by selection against those by sorting, and sums over threads against one. */

enum { N = 2100, ROUNDS = 42 };

static double values[N];

static double draw(int64_t i, int round)
{
    return mor_random_uniform(7, (uint64_t)i, (uint64_t)round);
}

/* Values that drift, spread and jump, with many that are the same. */
static void fill_round(int round)
{
    for (int64_t i = 0; i < N; ++i) {
        const double value = draw(i, 0) * (1.0 + 0.05 * round) + 0.02 * draw(i, round) + (round == 40 ? 5.0 : 0.0);
        values[i] = round % 7 == 3 ? floor(20.0 * value) : value;
    }
}

static void selection_agrees_with_sorting_whatever_came_before(void **state)
{
    static const double percents[] = {0.0, 0.003, 1.0, 50.0, 99.5, 99.999, 100.0};
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (size_t p = 0; p < sizeof percents / sizeof *percents; ++p) {
        mor_measure_order order = {.capacity = 0};
        assert_int_equal(mor_measure_order_reserve(&context, &order, N), MOR_OK);
        for (int round = 0; round < ROUNDS; ++round) {
            double sorted = 0.0;
            double selected = 0.0;
            const int64_t n = round == 20 ? 1 : round == 21 ? 2 : N;
            fill_round(round);
            for (int64_t i = 0; i < n; ++i) {
                order.values[i] = values[i];
            }
            const uint64_t before = context.n_allocations;
            assert_int_equal(mor_measure_order_find(&context, &order, n, percents[p], &selected), MOR_OK);
            assert_true(context.n_allocations == before);
            assert_int_equal(mor_measure_percentile(&context, values, NULL, n, percents[p], &sorted), MOR_OK);
            assert_true(fabs(selected - sorted) <= 1e-11 * fabs(sorted)); /* the place between two neighbors */
        }
        mor_measure_order_clear(&context, &order);
    }
}

static void value_that_is_no_number_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_order order = {.capacity = 0};
    double result = 0.0;
    assert_int_equal(mor_measure_order_reserve(&context, &order, 3), MOR_OK);
    order.values[0] = order.values[2] = 1.0;
    order.values[1] = NAN;
    assert_int_equal(mor_measure_order_find(&context, &order, 3, 50.0, &result), MOR_ERROR_NUMERIC);
    assert_non_null(strstr(context.message, "entry 1 of 3"));
    order.values[1] = 2.0;
    assert_int_equal(mor_measure_order_find(&context, &order, 3, 100.0, &result), MOR_OK);
    assert_true(result == 2.0);
    mor_measure_order_clear(&context, &order);
}

static void fill_terms(const void *job, int64_t first, int64_t n, double *terms)
{
    (void)job;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] = (first + i) % 3 == 0 ? 1.0e16 : (first + i) % 3 == 1 ? 0.5 : -1.0e16;
    }
}

static void sum_keeps_what_rounding_takes_for_any_number_of_threads(void **state)
{
    (void)state;
    for (int64_t n = 3; n < 30000; n = 3 * (n + 7)) {
        const double expected = 0.5 * (double)(n / 3);
        for (int n_threads = 0; n_threads <= 5; ++n_threads) {
            assert_true(mor_sum_over(n, n_threads, fill_terms, NULL) == expected); /* exact: representable */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(selection_agrees_with_sorting_whatever_came_before),
        cmocka_unit_test(value_that_is_no_number_is_refused),
        cmocka_unit_test(sum_keeps_what_rounding_takes_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
