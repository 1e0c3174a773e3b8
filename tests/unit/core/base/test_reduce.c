/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/reduce.h"
#include "tests/common/cloud.h"

enum { N = 1000, BLOCKS_MAX = 64 };

static double value_of(int64_t i)
{
    return cloud_number((uint64_t)i, 7, -1.0, 1.0);
}

static void add_values(void *job, int64_t first, int64_t last, double *values)
{
    (void)job;
    for (int64_t i = first; i < last; ++i) {
        values[0] += value_of(i);
        values[1] += 1.0;
    }
}

static void bound_values(void *job, int64_t first, int64_t last, double *values)
{
    const int64_t *bad = job;
    for (int64_t i = first; i < last; ++i) {
        values[0] = mor_larger(values[0], i == *bad ? NAN : value_of(i));
    }
}

static int64_t find_beyond(const void *job, int64_t first, int64_t last)
{
    const int64_t *limit = job;
    for (int64_t i = first; i < last; ++i) {
        if (i > *limit) {
            return i;
        }
    }
    return -1;
}

static mor_status refuse_one(void *job, int64_t first, int64_t last)
{
    const int64_t *bad = job;
    return *bad >= first && *bad < last ? MOR_ERROR_NUMERIC : MOR_OK;
}

static void blocks_cover_all_items_once(void **state)
{
    (void)state;
    const mor_blocks ways[] = {{N, 64, 0, 1}, {N, 1024, 0, 1}, {N, 0, 64, 1}, {5, 0, 64, 1}, {0, 64, 0, 1}};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; ++k) {
        const int64_t n = mor_blocks_count(&ways[k]);
        int64_t next = 0;
        for (int64_t block = 0; block < n; ++block) {
            assert_int_equal(mor_blocks_first(&ways[k], block), next);
            next = mor_blocks_first(&ways[k], block + 1);
        }
        assert_int_equal(next, ways[k].n_items);
    }
}

static void sums_are_those_of_blocks_in_order_for_any_number_of_threads(void **state)
{
    (void)state;
    const mor_blocks blocks = {N, 64, 0, 2};
    double expected = 0.5;
    for (int64_t first = 0; first < N; first += 64) {
        double part = 0.0;
        for (int64_t i = first; i < first + 64 && i < N; ++i) {
            part += value_of(i);
        }
        expected += part;
    }
    for (int n_threads = 1; n_threads <= 4; ++n_threads) {
        double partial[2 * BLOCKS_MAX];
        double results[2] = {0.5, 0.0};
        mor_reduce(&blocks, n_threads, MOR_REDUCE_SUM, 2, add_values, NULL, partial, results);
        assert_true(results[0] == expected && results[1] == N); /* exact: the same additions in the same order */
    }
}

static void largest_value_is_found_and_not_a_number_wins_wherever_it_stands(void **state)
{
    (void)state;
    const mor_blocks blocks = {N, 64, 0, 1};
    double expected = -1.0;
    for (int64_t i = 0; i < N; ++i) {
        expected = fmax(expected, value_of(i));
    }
    for (int64_t bad = -1; bad < N; bad += 111) {
        double partial[BLOCKS_MAX];
        double result = -INFINITY;
        mor_reduce(&blocks, 2, MOR_REDUCE_LARGEST, 1, bound_values, &bad, partial, &result);
        assert_true(bad < 0 ? result == expected : isnan(result)); /* exact: a choice */
    }
}

static void compensated_sum_keeps_what_rounding_takes(void **state)
{
    (void)state;
    mor_sum sum = {0.0, 0.0};
    mor_sum_add(&sum, 1e16);
    mor_sum_add(&sum, 1.0);
    mor_sum_add(&sum, -1e16);
    assert_true(mor_sum_value(sum) == 1.0); /* exact: two-sum loses nothing here */
}

static void first_item_and_first_failing_block_are_found(void **state)
{
    (void)state;
    const mor_blocks blocks = {N, 64, 0, 1};
    int64_t indices[BLOCKS_MAX];
    mor_status statuses[BLOCKS_MAX];
    for (int64_t k = -1; k < N; k += 37) {
        assert_int_equal(mor_reduce_first(&blocks, 2, find_beyond, &k, indices), k + 1 < N ? k + 1 : -1);
        int64_t bad = k;
        assert_int_equal(mor_reduce_status(&blocks, 2, refuse_one, &bad, statuses), k < 0 ? -1 : k / 64);
        assert_true(k < 0 || statuses[k / 64] == MOR_ERROR_NUMERIC);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_cover_all_items_once),
        cmocka_unit_test(sums_are_those_of_blocks_in_order_for_any_number_of_threads),
        cmocka_unit_test(largest_value_is_found_and_not_a_number_wins_wherever_it_stands),
        cmocka_unit_test(compensated_sum_keeps_what_rounding_takes),
        cmocka_unit_test(first_item_and_first_failing_block_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
