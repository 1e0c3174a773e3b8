/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void expect_refusal(mor_context *context, mor_status status, const mor_shape *shape, const char *word)
{
    assert_int_equal(status, MOR_ERROR_ARGUMENT);
    assert_null(shape);
    if (strstr(context->message, word) == NULL) {
        fail_msg("'%s' does not say '%s'", context->message, word);
    }
    assert_int_equal(context->memory_bytes, 0);
    mor_context_clear_error(context);
}

static void wrong_simple_shapes_are_refused_by_value(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double zero[3] = {0.0, 0.0, 0.0};
    const double one[3] = {1.0, 1.0, 1.0};
    const double flat[3] = {1.0, 0.0, 1.0};
    const double all_low[3] = {-INFINITY, -INFINITY, -INFINITY};
    const double all_high[3] = {INFINITY, INFINITY, INFINITY};
    const double broken[3] = {0.0, NAN, 0.0};
    mor_shape *shape = NULL;
    expect_refusal(&context, mor_shape_new_box(&context, zero, flat, &shape), shape, "empty along y");
    expect_refusal(&context, mor_shape_new_box(&context, broken, one, &shape), shape, "nan");
    expect_refusal(&context, mor_shape_new_box(&context, all_low, all_high, &shape), shape, "no face");
    expect_refusal(&context, mor_shape_new_box(&context, all_low, all_low, &shape), shape, "-inf");
    expect_refusal(&context, mor_shape_new_cylinder(&context, zero, zero, 1.0, 1.0, &shape), shape, "(0, 0, 0)");
    expect_refusal(&context, mor_shape_new_cylinder(&context, zero, one, 0.0, 1.0, &shape), shape, "radius");
    expect_refusal(&context, mor_shape_new_cylinder(&context, zero, one, 1.0, -2.0, &shape), shape, "-2");
    expect_refusal(&context, mor_shape_new_cylinder(&context, broken, one, 1.0, 1.0, &shape), shape, "nan");
    expect_refusal(&context, mor_shape_new_cone(&context, zero, zero, 1.0, 1.0, &shape), shape, "axis of the cone");
    expect_refusal(&context, mor_shape_new_cone(&context, zero, one, -1.0, 1.0, &shape), shape, "radius of the cone");
    expect_refusal(&context, mor_shape_new_cone(&context, zero, one, 1.0, 0.0, &shape), shape, "height of the cone");
    expect_refusal(&context, mor_shape_new_cone(&context, broken, one, 1.0, 1.0, &shape), shape, "nan");
    expect_refusal(&context, mor_shape_new_sphere(&context, zero, 0.0, &shape), shape, "above zero");
    expect_refusal(&context, mor_shape_new_sphere(&context, zero, INFINITY, &shape), shape, "inf");
    expect_refusal(&context, mor_shape_new_half_space(&context, zero, zero, &shape), shape, "normal");
}

static void wrong_polygons_are_refused_by_cause(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *shape = NULL;
    const double bow_tie[] = {0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0};
    const double line[] = {0.0, 0.0, 1.0, 1.0, 2.0, 2.0};
    const double twice[] = {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0};
    const double closed[] = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
    const double touching[] = {0.0, 0.0, 2.0, 0.0, 2.0, 1.0, 1.0, 0.0, 0.0, 1.0};
    const double spike[] = {0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 1.0, 0.5, 0.0, 0.5};
    const double broken[] = {0.0, 0.0, 1.0, INFINITY, 1.0, 1.0};
    expect_refusal(&context, mor_shape_new_polygon(&context, bow_tie, 2, &shape), shape, "2 points");
    expect_refusal(&context, mor_shape_new_polygon(&context, bow_tie, 4, &shape), shape, "cross or touch");
    expect_refusal(&context, mor_shape_new_polygon(&context, line, 3, &shape), shape, "no area");
    expect_refusal(&context, mor_shape_new_polygon(&context, twice, 4, &shape), shape, "points 2 and 3");
    expect_refusal(&context, mor_shape_new_polygon(&context, closed, 4, &shape), shape, "points 4 and 1");
    expect_refusal(&context, mor_shape_new_polygon(&context, touching, 5, &shape), shape, "cross or touch");
    expect_refusal(&context, mor_shape_new_polygon(&context, spike, 6, &shape), shape, "cross or touch");
    expect_refusal(&context, mor_shape_new_polygon(&context, broken, 3, &shape), shape, "point 2");
    const double fold[] = {0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 2.0, 2.0, 0.5, 0.5};
    expect_refusal(&context, mor_shape_new_polygon(&context, fold, 5, &shape), shape, "cross or touch");
    const double needle[] = {0.0, 0.0, 2.0, 0.0, 1.0, 0.0, 1.0, 1.0};
    expect_refusal(&context, mor_shape_new_polygon(&context, needle, 4, &shape), shape, "cross or touch");
}

static void failed_compounds_leave_the_children_with_the_caller(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *parts[3] = {NULL, NULL, NULL};
    mor_shape *shape = NULL;
    const double one[3] = {1.0, 2.0, 3.0};
    assert_int_equal(mor_shape_new_box(&context, (double[]){0.0, 0.0, 0.0}, one, &parts[0]), MOR_OK);
    mor_shape *const box = parts[0];
    const double mirror[9] = {-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const double skew[9] = {1.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 1.0};
    const double zero[3] = {0.0, 0.0, 0.0};
    const double broken[3] = {0.0, NAN, 0.0};
    assert_int_equal(mor_shape_new_union(&context, parts, 3, &shape), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "part 2 of 3"));
    assert_int_equal(mor_shape_new_union(&context, parts, 0, &shape), MOR_ERROR_ARGUMENT);
    parts[1] = box;
    assert_int_equal(mor_shape_new_union(&context, parts, 2, &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_difference(&context, &parts[0], &parts[1], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_difference(&context, &parts[0], &parts[2], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_placed(&context, mirror, zero, &parts[0], &shape), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "reflection"));
    assert_int_equal(mor_shape_new_placed(&context, skew, zero, &parts[0], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_translate(&context, broken, &parts[0], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_rotate(&context, zero, 1.0, zero, &parts[0], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_rotate(&context, one, INFINITY, zero, &parts[0], &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_translate(&context, zero, &parts[2], &shape), MOR_ERROR_ARGUMENT);
    assert_null(shape);
    assert_ptr_equal(parts[0], box);
    assert_int_equal(context.n_allocations, 1);
    mor_shape_free(&context, &parts[0]);
    mor_shape_free(&context, &parts[0]); /* NULL is accepted */
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_simple_shapes_are_refused_by_value),
        cmocka_unit_test(wrong_polygons_are_refused_by_cause),
        cmocka_unit_test(failed_compounds_leave_the_children_with_the_caller),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
