/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe_record.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* Records of what a number did over time, against sums by hand. Exact unless a line says otherwise. */

static const mor_probe_window whole = {0.0, INFINITY};

static void empty_record_knows_nothing(void **state)
{
    double record[MOR_PROBE_RECORD_NUMBERS];
    (void)state;
    mor_probe_record_clear(record);
    mor_probe_record_add_instant(record, &whole, 0.0, NAN);
    mor_probe_record_add_instant(record, &whole, 1.0, INFINITY);
    mor_probe_record_add_step(record, &whole, 1.0, 2.0, NAN, NAN);
    assert_true(isnan(record[MOR_PROBE_RECORD_MAXIMUM]) && isnan(record[MOR_PROBE_RECORD_MINIMUM]));
    assert_true(isnan(record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM]));
    assert_true(isnan(mor_probe_record_mean(record)) && isnan(mor_probe_record_integral(record)));
    assert_true(record[MOR_PROBE_RECORD_MEASURED] == 3.0 && record[MOR_PROBE_RECORD_SKIPPED] == 3.0);
}

static void extremes_are_the_first_of_several_inside_the_window(void **state)
{
    static const double values[] = {9.0, -9.0, 2.0, 7.0, 7.0, -1.0, -1.0, 8.5, -8.5};
    const mor_probe_window window = {2.0, 6.0};
    double record[MOR_PROBE_RECORD_NUMBERS];
    (void)state;
    mor_probe_record_clear(record);
    for (int k = 0; k < 9; ++k) {
        mor_probe_record_add_instant(record, &window, k, values[k]);
    }
    assert_true(record[MOR_PROBE_RECORD_MAXIMUM] == 7.0 && record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM] == 3.0);
    assert_true(record[MOR_PROBE_RECORD_MINIMUM] == -1.0 && record[MOR_PROBE_RECORD_TIME_OF_MINIMUM] == 5.0);
    assert_true(record[MOR_PROBE_RECORD_MEASURED] == 5.0);
}

/* A straight line has its mean in the middle of a window, wherever the measurements lie. */
static void mean_of_a_line_is_its_middle(void **state)
{
    static const double times[] = {0.0, 0.5, 0.75, 2.0, 3.5};
    const mor_probe_window window = {0.625, 3.0};
    double record[MOR_PROBE_RECORD_NUMBERS];
    (void)state;
    mor_probe_record_clear(record);
    for (int k = 0; k < 5; ++k) {
        mor_probe_record_add_instant(record, &window, times[k], 4.0 + 2.0 * times[k]);
    }
    assert_true(fabs(mor_probe_record_mean(record) - (4.0 + 2.0 * 1.8125)) < 1e-14); /* rounding of a few terms */
    assert_true(record[MOR_PROBE_RECORD_SPAN] == 2.375);
}

/* Where nothing was measured no line is drawn. */
static void mean_leaves_out_times_without_a_value(void **state)
{
    static const double values[] = {1.0, 1.0, NAN, 5.0, 5.0};
    double record[MOR_PROBE_RECORD_NUMBERS];
    (void)state;
    mor_probe_record_clear(record);
    for (int k = 0; k < 5; ++k) {
        mor_probe_record_add_instant(record, &whole, k, values[k]);
    }
    assert_true(mor_probe_record_mean(record) == 3.0 && record[MOR_PROBE_RECORD_SPAN] == 2.0);
    assert_true(record[MOR_PROBE_RECORD_MEASURED] == 5.0 && record[MOR_PROBE_RECORD_SKIPPED] == 1.0);
}

static void steps_count_with_the_part_inside_the_window(void **state)
{
    const mor_probe_window window = {1.5, 3.25};
    double record[MOR_PROBE_RECORD_NUMBERS];
    (void)state;
    mor_probe_record_clear(record);
    for (int k = 0; k < 5; ++k) {
        mor_probe_record_add_step(record, &window, k, k + 1.0, 10.0 * k, 10.0 * k);
    }
    assert_true(mor_probe_record_integral(record) == 10.0 * 0.5 + 20.0 + 30.0 * 0.25);
    assert_true(record[MOR_PROBE_RECORD_MAXIMUM] == 30.0 && record[MOR_PROBE_RECORD_MINIMUM] == 10.0);
    assert_true(record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM] == 3.25); /* the step ends beyond the window */
    assert_true(record[MOR_PROBE_RECORD_TIME_OF_MINIMUM] == 2.0);
    assert_true(record[MOR_PROBE_RECORD_MEASURED] == 3.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_record_knows_nothing),
        cmocka_unit_test(extremes_are_the_first_of_several_inside_the_window),
        cmocka_unit_test(mean_of_a_line_is_its_middle),
        cmocka_unit_test(mean_leaves_out_times_without_a_value),
        cmocka_unit_test(steps_count_with_the_part_inside_the_window),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
