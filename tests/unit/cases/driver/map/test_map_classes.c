/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_classes.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

static const mor_map_kind *find_kind(const char *name)
{
    const mor_map_kind *kind = mor_map_kinds;
    while (kind->name != NULL && strcmp(kind->name, name) != 0) {
        ++kind;
    }
    assert_non_null(kind->name);
    return kind;
}

static void every_value_has_a_class_that_holds_it(void **state)
{
    (void)state;
    for (double largest = 1.0e-3; largest < 2.0e6; largest *= 1.37) {
        mor_map_classes it;
        mor_map_classes_init(find_kind("deposit"), largest, &it);
        assert_in_range(it.n, 1, MOR_MAP_CLASSES_MAX);
        assert_true(it.limits[0] == 0.0 && it.limits[it.n] >= largest * (1.0 - 1.0e-9));
        assert_true(it.limits[it.n] < largest + it.step); /* no class is empty for lack of values */
        for (int k = 0; k <= 50; ++k) {
            const double value = largest * k / 50.0;
            const int of = mor_map_classes_find(&it, value);
            assert_true(value >= it.limits[of] && value <= it.limits[of + 1] * (1.0 + 1.0e-9));
        }
    }
}

static void counts_have_classes_of_whole_numbers(void **state)
{
    (void)state;
    char text[MOR_TICKS_LABEL_BYTES];
    mor_map_classes it;
    mor_map_classes_init(find_kind("rock_passages"), 2.0, &it);
    assert_true(it.step == 1.0 && it.n == 2);
    mor_map_classes_label(find_kind("rock_passages"), &it, 1, 1.0, text);
    assert_string_equal(text, "2");
    mor_map_classes_label(find_kind("rock_passages"), &it, 0, 1.0, text);
    assert_string_equal(text, "1"); /* none is no class: it has no color */
}

static void a_map_without_values_has_one_class(void **state)
{
    (void)state;
    mor_map_classes it;
    mor_map_classes_init(find_kind("arrival"), NAN, &it);
    assert_true(it.n >= 1 && it.limits[it.n] == 1.0);
}

static double lightness(const double *color)
{
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

static void large_depths_and_early_arrivals_are_dark(void **state)
{
    (void)state;
    mor_map_classes it;
    mor_map_classes_init(find_kind("depth_max"), 10.0, &it);
    assert_true(lightness(it.colors[0]) > lightness(it.colors[it.n - 1]));
    mor_map_classes_init(find_kind("arrival"), 10.0, &it);
    assert_true(lightness(it.colors[0]) < lightness(it.colors[it.n - 1]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_value_has_a_class_that_holds_it),
        cmocka_unit_test(counts_have_classes_of_whole_numbers),
        cmocka_unit_test(a_map_without_values_has_one_class),
        cmocka_unit_test(large_depths_and_early_arrivals_are_dark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
