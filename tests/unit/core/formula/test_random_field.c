/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/formula/random_field.h"
#include "tests/common/near.h"

#include "core/base/math.h"

#include <math.h>
#include <string.h>

/* Random fields: mean, variance, distribution and correlation of many independent fields are those prescribed; one
 * field has in space what the ensemble has; seeds and purposes are independent; nothing depends on what else is asked
 * for. */

enum { FIELDS = 1500, LAGS = 4 };

/* A bound that a right program breaks once in 16 000 tries, standard errors. */
static const double sure = 4.0;

static const double lengths[3] = {2.0, 0.5, 1.0};

/* Places at lags along x, y and aslant from the first one. */
static const double places[1 + LAGS][3] = {
    {0.3, -1.2, 4.0}, {0.8, -1.2, 4.0}, {0.3, -1.0, 4.0}, {0.9, -1.1, 4.2}, {4.3, -1.2, 4.0}};

/* Values of all fields at all places. */
typedef struct ensemble {
    double values[1 + LAGS][FIELDS];
} ensemble;

static void fill(mor_context *context, mor_random_correlation correlation, ensemble *it)
{
    for (int k = 0; k < FIELDS; ++k) {
        mor_random_field *field = NULL;
        assert_int_equal(mor_random_field_new(context, correlation, lengths, NULL, (uint64_t)k, 5, &field), MOR_OK);
        for (int at = 0; at <= LAGS; ++at) {
            it->values[at][k] = mor_random_field_value(field, places[at]);
        }
        mor_random_field_free(context, &field);
    }
}

static double mean_product(const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < FIELDS; ++k) {
        sum += a[k] * b[k];
    }
    return sum / FIELDS;
}

static double mean_power(const double *values, int power)
{
    double sum = 0.0;
    for (int k = 0; k < FIELDS; ++k) {
        sum += pow(values[k], power);
    }
    return sum / FIELDS;
}

static void check_ensemble(const ensemble *it, mor_random_correlation correlation)
{
    const double error = sure / sqrt(FIELDS); /* of a mean of numbers of variance one */
    for (int at = 0; at <= LAGS; ++at) {
        assert_near(mean_power(it->values[at], 1), 0.0, error);
        assert_near(mean_power(it->values[at], 2), 1.0, error * sqrt(2.0));
        assert_near(mean_power(it->values[at], 3), 0.0, error * sqrt(15.0)); /* variance of the cube of a normal one */
        assert_near(mean_power(it->values[at], 4), 3.0, error * sqrt(96.0));
    }
    for (int at = 1; at <= LAGS; ++at) {
        const double lag[3] = {places[at][0] - places[0][0], places[at][1] - places[0][1],
                               places[at][2] - places[0][2]};
        const double expected = mor_random_correlation_at(correlation, lengths, lag);
        const double found = mean_product(it->values[0], it->values[at]);
        assert_near(found, expected,
                    error * sqrt(1.0 + expected * expected)); /* Isserlis: of a product of normal ones */
    }
}

static void ensembles_have_the_distribution_and_the_correlation_prescribed(void **state)
{
    static ensemble it;
    mor_context context;
    (void)state;
    mor_context_init(&context);
    for (int k = 0; k < 2; ++k) {
        fill(&context, (mor_random_correlation)k, &it);
        check_ensemble(&it, (mor_random_correlation)k);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* The length is the scale of fluctuation: the integral of the correlation over all lags. */
static void the_correlation_length_is_the_scale_of_fluctuation(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        for (int a = 0; a < 3; ++a) {
            const double step = 1.0e-3 * lengths[a];
            double sum = 0.0;
            for (int i = -8000; i <= 8000; ++i) {
                double lag[3] = {0.0};
                lag[a] = i * step;
                sum += step * mor_random_correlation_at((mor_random_correlation)k, lengths, lag);
            }
            assert_near(sum / lengths[a], 1.0,
                        1.0e-5); /* the sum's error is of the step squared; the tails are e^-16 */
        }
    }
}

/* Over a line of many correlation lengths, one field has the variance and the correlation of the ensemble. */
static void one_field_has_in_space_what_the_ensemble_has(void **state)
{
    enum { POINTS = 20000, LAG = 10 };
    static double values[POINTS];
    mor_context context;
    mor_random_field *field = NULL;
    double squares = 0.0;
    double products = 0.0;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_random_field_new(&context, MOR_RANDOM_SQUARED_EXPONENTIAL, lengths, NULL, 11, 0, &field),
                     MOR_OK);
    for (int i = 0; i < POINTS; ++i) {
        values[i] = mor_random_field_value(field, (const double[3]){0.1 * i, 0.0, 0.0});
    }
    for (int i = 0; i + LAG < POINTS; ++i) {
        squares += values[i] * values[i] / (POINTS - LAG);
        products += values[i] * values[i + LAG] / (POINTS - LAG);
    }
    /* 1000 correlation lengths, and 1024 waves: both leave 1 / sqrt(1000), of a variance sqrt(2) of it. */
    assert_near(squares, 1.0, sure * sqrt(2.0 / 1000.0));
    assert_near(products, exp(-MOR_PI * 0.25), sure * sqrt(2.0 / 1000.0));
    mor_random_field_free(&context, &field);
}

static void seeds_and_purposes_are_independent(void **state)
{
    static double values[3][FIELDS];
    mor_context context;
    (void)state;
    mor_context_init(&context);
    for (int k = 0; k < FIELDS; ++k) {
        for (int which = 0; which < 3; ++which) {
            mor_random_field *field = NULL;
            const uint64_t seed = (uint64_t)(2 * k) + (which == 1);
            assert_int_equal(
                mor_random_field_new(&context, MOR_RANDOM_EXPONENTIAL, lengths, NULL, seed, which == 2, &field),
                MOR_OK);
            values[which][k] = mor_random_field_value(field, places[0]);
            mor_random_field_free(&context, &field);
        }
    }
    for (int which = 1; which < 3; ++which) {
        assert_near(mean_product(values[0], values[which]), 0.0, sure / sqrt(FIELDS));
    }
}

/* Exact: a field is its waves, and the units of lengths do not matter when they change by powers of two. */
static void values_depend_on_place_and_seed_alone(void **state)
{
    static const double larger[3] = {8.0, 2.0, 4.0};
    mor_context context;
    mor_random_field *first = NULL;
    mor_random_field *second = NULL;
    mor_random_field *scaled = NULL;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_random_field_new(&context, MOR_RANDOM_EXPONENTIAL, lengths, NULL, 3, 1, &first), MOR_OK);
    assert_int_equal(mor_random_field_new(&context, MOR_RANDOM_EXPONENTIAL, lengths, NULL, 3, 1, &second), MOR_OK);
    assert_int_equal(mor_random_field_new(&context, MOR_RANDOM_EXPONENTIAL, larger, NULL, 3, 1, &scaled), MOR_OK);
    for (int at = LAGS; at >= 0; --at) {
        const double value = mor_random_field_value(first, places[at]);
        double far[3];
        for (int a = 0; a < 3; ++a) {
            far[a] = 4.0 * places[at][a];
        }
        mor_random_field_value(second, places[LAGS - at]);
        assert_true(mor_random_field_value(second, places[at]) == value);
        assert_true(mor_random_field_value(scaled, far) == value);
    }
    mor_random_field_free(&context, &first);
    mor_random_field_free(&context, &second);
    mor_random_field_free(&context, &scaled);
}

static void an_infinite_length_means_no_change(void **state)
{
    static const double layered[3] = {INFINITY, 0.5, INFINITY};
    mor_context context;
    mor_random_field *field = NULL;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_random_field_new(&context, MOR_RANDOM_SQUARED_EXPONENTIAL, layered, NULL, 1, 0, &field),
                     MOR_OK);
    const double value = mor_random_field_value(field, (const double[3]){0.0, 1.0, 0.0});
    assert_true(mor_random_field_value(field, (const double[3]){1.0e3, 1.0, -7.0}) == value); /* exact: zero times it */
    assert_true(mor_random_field_value(field, (const double[3]){0.0, 2.0, 0.0}) != value);
    mor_random_field_free(&context, &field);
}

/* [RF6] along one axis, with a tail of images that falls as exp(-2 n L / length). */
static double find_periodic(mor_random_correlation correlation, double lag, double period)
{
    double sum = 0.0;
    for (int n = -20; n <= 20; ++n) {
        const double at = lag + n * period;
        const double turn = MOR_PI * at / period;
        sum += mor_random_correlation_at(correlation, lengths, (const double[3]){at, 0.0, 0.0}) *
               (turn == 0.0 ? 1.0 : sin(turn) / turn);
    }
    return sum;
}

/* A period of three correlation lengths: values come back exactly but for the rounding of angles, and the correlation
 * of the ensemble is that of the waves that fit. Halfway it is not that of a field without period. */
static void a_field_repeats_itself_with_its_period(void **state)
{
    static const double period[3] = {6.0, 0.0, 0.0};
    static const double at[3] = {0.1, -1.2, 4.0};
    static const double lags[3] = {0.5, 2.0, 3.0};
    mor_context context;
    (void)state;
    mor_context_init(&context);
    for (int which = 0; which < 2; ++which) {
        const mor_random_correlation correlation = which == 0 ? MOR_RANDOM_EXPONENTIAL : MOR_RANDOM_SQUARED_EXPONENTIAL;
        double products[4] = {0.0, 0.0, 0.0, 0.0};
        for (int k = 0; k < FIELDS; ++k) {
            mor_random_field *field = NULL;
            assert_int_equal(mor_random_field_new(&context, correlation, lengths, period, (uint64_t)k, 5, &field),
                             MOR_OK);
            const double value = mor_random_field_value(field, at);
            assert_near(mor_random_field_value(field, (const double[3]){at[0] + 6.0, at[1], at[2]}), value, 1.0e-6);
            products[3] += value * value / FIELDS;
            for (int k_lag = 0; k_lag < 3; ++k_lag) {
                const double other[3] = {at[0] + lags[k_lag], at[1], at[2]};
                products[k_lag] += value * mor_random_field_value(field, other) / FIELDS;
            }
            mor_random_field_free(&context, &field);
        }
        assert_near(products[3], 1.0, sure * sqrt(2.0 / FIELDS));
        for (int k = 0; k < 3; ++k) {
            assert_near(products[k], find_periodic(correlation, lags[k], 6.0), sure * sqrt(2.0 / FIELDS));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ensembles_have_the_distribution_and_the_correlation_prescribed),
        cmocka_unit_test(the_correlation_length_is_the_scale_of_fluctuation),
        cmocka_unit_test(one_field_has_in_space_what_the_ensemble_has),
        cmocka_unit_test(seeds_and_purposes_are_independent),
        cmocka_unit_test(values_depend_on_place_and_seed_alone),
        cmocka_unit_test(an_infinite_length_means_no_change),
        cmocka_unit_test(a_field_repeats_itself_with_its_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
