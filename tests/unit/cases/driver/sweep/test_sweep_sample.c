/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_sample.h"

#include "tests/common/near.h"

#include <stdbool.h>
#include <stdlib.h>

#include <cmocka.h>

enum { SAMPLES_MAX = 2000 };

/* Each stratum [k, k + 1) / n has one sample, whatever the number of samples, the variable and the seed. */
static void each_stratum_has_one_sample(void **state)
{
    static const int numbers[] = {1, 2, 3, 7, 20, 100, 1000, SAMPLES_MAX};
    static double u[SAMPLES_MAX];
    (void)state;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        for (uint64_t variable = 0; variable < 5; ++variable) {
            const int n = numbers[k];
            bool is_taken[SAMPLES_MAX] = {false};
            mor_sweep_latin(3 + k, variable, n, u);
            for (int i = 0; i < n; ++i) {
                const int stratum = (int)(u[i] * n);
                assert_true(u[i] > 0.0 && u[i] < 1.0);
                assert_false(is_taken[stratum]);
                is_taken[stratum] = true;
            }
        }
    }
}

static double correlate(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
        sum += (a[k] - 0.5) * (b[k] - 0.5);
    }
    return 12.0 * sum / n; /* the variance of a uniform variable is 1/12 */
}

/* Orders of two variables have nothing to do with each other: their correlation is within four of its deviations. */
static void variables_and_seeds_are_independent(void **state)
{
    static double u[3][SAMPLES_MAX];
    (void)state;
    mor_sweep_latin(1, 1, SAMPLES_MAX, u[0]);
    mor_sweep_latin(1, 2, SAMPLES_MAX, u[1]);
    mor_sweep_latin(2, 1, SAMPLES_MAX, u[2]);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < a; ++b) {
            assert_near(correlate(u[a], u[b], SAMPLES_MAX), 0.0, 4.0 / sqrt(SAMPLES_MAX));
        }
    }
}

/* Whether the places of one hypercube within its strata, taken as the random numbers of a shuffle, give the order of
 * another one: then the two share their random numbers. */
static bool gives_order(const double *places, const double *order, int n)
{
    int strata[SAMPLES_MAX];
    for (int k = 0; k < n; ++k) {
        strata[k] = k;
    }
    for (int k = n - 1; k > 0; --k) {
        const int other = (int)((places[k] * n - floor(places[k] * n)) * (k + 1));
        const int kept = strata[k];
        strata[k] = strata[other];
        strata[other] = kept;
    }
    int n_alike = 0;
    for (int k = 0; k < n; ++k) {
        n_alike += strata[k] == (int)(order[k] * n);
    }
    return n_alike > n / 2; /* of two random orders about one place is alike */
}

/* Sweeps of several seeds may be put together: none uses numbers of another for something else. */
static void seeds_share_no_random_numbers(void **state)
{
    enum { N = 50, SEEDS = 8 };
    double u[SEEDS][N];
    (void)state;
    for (int k = 0; k < SEEDS; ++k) {
        mor_sweep_latin((uint64_t)k, 7, N, u[k]);
    }
    for (int a = 0; a < SEEDS; ++a) {
        for (int b = 0; b < SEEDS; ++b) {
            assert_false(gives_order(u[a], u[b], N));
        }
    }
}

/* Digits of Wichura (1988) and of tables. */
static void normal_quantiles_are_those_of_the_tables(void **state)
{
    static const double table[][2] = {{0.5, 0.0},
                                      {0.75, 0.67448975019608171},
                                      {0.975, 1.9599639845400545},
                                      {0.995, 2.5758293035489004},
                                      {0.001, -3.0902323061678132},
                                      {1e-10, -6.3613409024040562},
                                      {1e-20, -9.2623400897984}};
    (void)state;
    for (size_t k = 0; k < sizeof table / sizeof *table; ++k) {
        assert_near(mor_sweep_normal_quantile(table[k][0]), table[k][1], 1e-13 * (1.0 + fabs(table[k][1])));
    }
    for (double z = -8.0; z < 5.0; z += 0.37) { /* above, 1 - p has too few digits to tell z */
        assert_near(mor_sweep_normal_quantile(0.5 * erfc(-z * M_SQRT1_2)), z, 1e-9);
    }
}

static const mor_sweep_distribution distributions[] = {{MOR_SWEEP_LAW_NORMAL, 25.0, 2.0, NAN, -INFINITY, INFINITY},
                                                       {MOR_SWEEP_LAW_NORMAL, 25.0, 2.0, NAN, 24.0, INFINITY},
                                                       {MOR_SWEEP_LAW_NORMAL, 25.0, 2.0, NAN, 20.0, 26.0},
                                                       {MOR_SWEEP_LAW_LOGNORMAL, 8.4, 4.2, NAN, -INFINITY, INFINITY},
                                                       {MOR_SWEEP_LAW_LOGNORMAL, 8.4, 4.2, NAN, 2.0, 20.0},
                                                       {MOR_SWEEP_LAW_UNIFORM, NAN, NAN, NAN, -3.0, 5.0},
                                                       {MOR_SWEEP_LAW_TRIANGULAR, NAN, NAN, 1.0, -3.0, 5.0},
                                                       {MOR_SWEEP_LAW_TRIANGULAR, NAN, NAN, -3.0, -3.0, 5.0},
                                                       {MOR_SWEEP_LAW_TRIANGULAR, NAN, NAN, 5.0, -3.0, 5.0}};

enum { DISTRIBUTIONS = sizeof distributions / sizeof *distributions };

/* Of what is not cut off, a part u lies below the quantile of u. */
static void quantiles_have_their_probability_below_them(void **state)
{
    (void)state;
    for (int k = 0; k < DISTRIBUTIONS; ++k) {
        const mor_sweep_distribution *it = &distributions[k];
        const double low = mor_sweep_distribution_below(it, it->minimum);
        const double high = mor_sweep_distribution_below(it, it->maximum);
        for (double u = 0.001; u < 1.0; u += 0.0237) {
            const double x = mor_sweep_distribution_quantile(it, u);
            assert_true(x >= it->minimum && x <= it->maximum);
            assert_near((mor_sweep_distribution_below(it, x) - low) / (high - low), u, 1e-12); /* rounding, magnified */
        }
    }
}

/* Mean and deviation of as many samples as resolve the integrals over u; tails that the midpoint rule misses are of the
 * order of the tolerance. */
static void samples_have_the_moments_they_were_asked_for(void **state)
{
    enum { N = 200000 };
    static const double expected[DISTRIBUTIONS][2] = {
        [0] = {25.0, 2.0}, [3] = {8.4, 4.2}, [5] = {1.0, 2.3094010767585029}, [6] = {1.0, 1.6329931618554521}};
    (void)state;
    for (int k = 0; k < DISTRIBUTIONS; ++k) {
        double sums[2] = {0.0, 0.0};
        for (int i = 0; i < N && expected[k][1] > 0.0; ++i) {
            const double x = mor_sweep_distribution_quantile(&distributions[k], (i + 0.5) / N) - expected[k][0];
            sums[0] += x / N;
            sums[1] += x * x / N;
        }
        assert_near(sums[0], 0.0, 1e-3 * expected[k][1]);
        assert_near(sqrt(sums[1]), expected[k][1], 1e-3 * expected[k][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_stratum_has_one_sample),
        cmocka_unit_test(variables_and_seeds_are_independent),
        cmocka_unit_test(seeds_share_no_random_numbers),
        cmocka_unit_test(normal_quantiles_are_those_of_the_tables),
        cmocka_unit_test(quantiles_have_their_probability_below_them),
        cmocka_unit_test(samples_have_the_moments_they_were_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
