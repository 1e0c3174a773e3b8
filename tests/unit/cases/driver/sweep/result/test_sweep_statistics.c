/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_statistics.h"

#include "cases/driver/sweep/sweep_sample.h"
#include "core/base/random.h"
#include "tests/common/near.h"

#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* The sums of 1 to n are closed forms: mean (n + 1) / 2, variance n (n + 1) / 12, quantiles 1 + (n - 1) p. */
static void whole_numbers_have_their_closed_forms(void **state)
{
    enum { N = 21 };
    double values[N];
    mor_sweep_statistics it;
    (void)state;
    for (int k = 0; k < N; ++k) {
        values[k] = 1 + (k * 8) % N; /* in some order */
    }
    mor_sweep_statistics_find(values, N, &it);
    assert_int_equal(it.n, N);
    assert_near(it.mean, 11.0, 1e-14); /* some rounding errors of 1e-16 */
    assert_near(it.deviation, sqrt(N * (N + 1) / 12.0), 1e-14);
    assert_near(it.quantiles[0], 2.0, 1e-14);
    assert_near(it.quantiles[1], 11.0, 1e-14);
    assert_near(it.quantiles[2], 20.0, 1e-14);
    assert_near(it.minimum, 1.0, 0.0);
    assert_near(it.maximum, 21.0, 0.0);
    /* t of 20 degrees of freedom is 2.085963 in the tables of Fisher and Yates. */
    assert_near(it.mean_high - it.mean, 2.0859634472658364 * it.deviation / sqrt(21.0), 1e-12);
    assert_near(it.mean - it.mean_low, it.mean_high - it.mean, 1e-14);
}

static void too_few_values_give_no_number(void **state)
{
    double values[MOR_SWEEP_TAIL_LEAST];
    mor_sweep_statistics it;
    (void)state;
    for (int n = 0; n <= MOR_SWEEP_TAIL_LEAST; ++n) {
        for (int k = 0; k < n; ++k) {
            values[k] = 3.5;
        }
        mor_sweep_statistics_find(values, n, &it);
        assert_int_equal(isnan(it.mean), n < 1);
        assert_int_equal(isnan(it.deviation), n < 2);
        assert_int_equal(isnan(it.mean_low), n < 2);
        assert_int_equal(isnan(it.mean_high), n < 2);
        assert_int_equal(isnan(it.quantiles[1]), n < MOR_SWEEP_MEDIAN_LEAST);
        assert_int_equal(isnan(it.quantiles[0]), n < MOR_SWEEP_TAIL_LEAST);
        assert_int_equal(isnan(it.quantiles[2]), n < MOR_SWEEP_TAIL_LEAST);
    }
}

static void equal_values_have_no_deviation(void **state)
{
    double values[7] = {0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1};
    mor_sweep_statistics it;
    (void)state;
    mor_sweep_statistics_find(values, 7, &it);
    assert_true(it.mean == 0.1 && it.deviation == 0.0 && it.mean_low == 0.1 && it.mean_high == 0.1);
}

/* Members come in any order when variables are listed in another one. */
static void order_of_values_changes_no_bit(void **state)
{
    enum { N = 50, ORDERS = 20 };
    double values[N];
    mor_sweep_statistics first;
    mor_sweep_statistics it;
    (void)state;
    for (int order = 0; order < ORDERS; ++order) {
        for (int k = 0; k < N; ++k) {
            values[k] = mor_random_uniform(1, (uint64_t)((k * (2 * order + 1)) % N), 1);
        }
        if (order % 5 == 2) { /* an odd number that divides 50 gives no order */
            continue;
        }
        mor_sweep_statistics_find(values, N, order == 0 ? &first : &it);
        assert_true(order == 0 || memcmp(&first.mean, &it.mean, sizeof it - offsetof(mor_sweep_statistics, mean)) == 0);
    }
}

/* One degree of freedom is Cauchy's distribution, two have a closed form; the others are tabulated with ten digits. */
static void quantiles_of_student_are_those_of_the_tables(void **state)
{
    static const struct {
        int freedom;
        double t975;
    } table[] = {{3, 3.182446305},  {4, 2.776445105},  {5, 2.570581836},  {9, 2.262157163},  {10, 2.228138852},
                 {19, 2.093024054}, {30, 2.042272456}, {60, 2.000297822}, {120, 1.979930405}};
    (void)state;
    for (size_t k = 0; k < sizeof table / sizeof *table; ++k) {
        assert_near(mor_sweep_student_quantile(0.975, table[k].freedom), table[k].t975, 1e-9); /* digits of the table */
    }
    for (double p = 0.55; p < 0.999; p += 0.04) {
        const double one = tan(M_PI * (p - 0.5));
        const double two = (2.0 * p - 1.0) / sqrt(2.0 * p * (1.0 - p));
        assert_near(mor_sweep_student_quantile(p, 1), one, 1e-12 * one); /* p itself is rounded */
        assert_near(mor_sweep_student_quantile(p, 2), two, 1e-12 * two);
    }
    /* t = z + (z^3 + z) / 4f + ..., Abramowitz and Stegun (1964) 26.7.5; the next term is 3e-10. */
    const double z = mor_sweep_normal_quantile(0.975);
    assert_near(mor_sweep_student_quantile(0.975, 100000), z + (z * z * z + z) / 400000.0, 1e-9);
}

/* The interval of the mean holds the true one in 95 % of many samples, within three deviations of that share. */
static void interval_of_the_mean_holds_it_as_often_as_it_says(void **state)
{
    enum { TRIALS = 4000, N = 5 };
    int n_held = 0;
    (void)state;
    for (int trial = 0; trial < TRIALS; ++trial) {
        double values[N];
        mor_sweep_statistics it;
        for (int k = 0; k < N; ++k) {
            values[k] =
                7.0 + 2.0 * mor_sweep_normal_quantile(0x1p-54 + mor_random_uniform(2, (uint64_t)trial, (uint64_t)k));
        }
        mor_sweep_statistics_find(values, N, &it);
        n_held += it.mean_low <= 7.0 && it.mean_high >= 7.0;
    }
    assert_near((double)n_held / TRIALS, 0.95, 3.0 * sqrt(0.95 * 0.05 / TRIALS));
}

/* Newcombe (1998), Table I, method 3. */
static void intervals_of_wilson_are_those_of_the_table(void **state)
{
    static const struct {
        int hits, n;
        double low, high;
    } table[] = {{81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0, 0.1611}, {1, 29, 0.0061, 0.1718}};
    (void)state;
    for (size_t k = 0; k < sizeof table / sizeof *table; ++k) {
        double low;
        double high;
        mor_sweep_wilson(table[k].hits, table[k].n, &low, &high);
        assert_near(low, table[k].low, 0.5e-4); /* four digits */
        assert_near(high, table[k].high, 0.5e-4);
    }
}

/* Its ends are the probabilities at which the share found lies z deviations away. */
static void ends_of_wilson_solve_their_equation(void **state)
{
    const double z = mor_sweep_normal_quantile(0.975);
    (void)state;
    for (int n = 1; n <= 40; ++n) {
        for (int hits = 0; hits <= n; ++hits) {
            double ends[2];
            mor_sweep_wilson(hits, n, &ends[0], &ends[1]);
            for (int end = 0; end < 2; ++end) {
                const double p = ends[end];
                const double away = (double)hits / n - p;
                assert_true(p >= 0.0 && p <= 1.0);
                assert_near(away * away, z * z * p * (1.0 - p) / n, 1e-14);
            }
            assert_true(ends[0] <= (double)hits / n && ends[1] >= (double)hits / n);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_numbers_have_their_closed_forms),
        cmocka_unit_test(too_few_values_give_no_number),
        cmocka_unit_test(equal_values_have_no_deviation),
        cmocka_unit_test(order_of_values_changes_no_bit),
        cmocka_unit_test(quantiles_of_student_are_those_of_the_tables),
        cmocka_unit_test(interval_of_the_mean_holds_it_as_often_as_it_says),
        cmocka_unit_test(intervals_of_wilson_are_those_of_the_table),
        cmocka_unit_test(ends_of_wilson_solve_their_equation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
