/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/sph/measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { N_MAX = 1000 };

/* Particles in the making. */
typedef struct heap {
    mor_measure_points points;
    double position[3 * N_MAX];
    double mass[N_MAX];
    double stress[6 * N_MAX];
} heap;

static heap ground; /* emptied by every test */

static void start_heap(int dimension, double spacing)
{
    ground.points = (mor_measure_points){
        .dimension = dimension, .spacing = spacing, .position = ground.position, .mass = ground.mass};
}

static void add_grain(double x, double y, double z, double mass)
{
    const int64_t i = ground.points.n_points++;
    assert_true(i < N_MAX);
    ground.position[3 * i] = x;
    ground.position[3 * i + 1] = y;
    ground.position[3 * i + 2] = z;
    ground.mass[i] = mass;
}

/* A 2D column along a slanted up direction with a given error of the vertical stress. */
static mor_measure_column build_column(double scale, double noise)
{
    mor_measure_column column = {.origin = {0.3, -0.2, 0.0},
                                 .up = {0.6, 0.8, 0.0},
                                 .surface_height = 1.0,
                                 .density = 2000.0,
                                 .gravity = 10.0,
                                 .lowest = -INFINITY,
                                 .highest = INFINITY};
    start_heap(2, 0.01);
    for (int i = 0; i < 1000; ++i) {
        const double height = 0.01 * (i / 10 + 0.5);
        const double side = 0.01 * (i % 10);
        add_grain(0.3 + 0.6 * height + 0.8 * side, -0.2 + 0.8 * height - 0.6 * side, 0.0, 0.2);
        const double along = scale * -2e4 * (1.0 - height) + (i % 2 == 0 ? noise : -noise);
        const double lateral = 0.5 * along;
        double *s = ground.stress + 6 * i;
        s[MOR_XX] = 0.36 * along + 0.64 * lateral;
        s[MOR_YY] = 0.64 * along + 0.36 * lateral;
        s[MOR_XY] = 0.48 * (along - lateral);
        s[MOR_ZZ] = -777.0; /* out of the plane: not to be counted */
        s[MOR_YZ] = 0.0;
        s[MOR_ZX] = 0.0;
    }
    return column;
}

static void column_at_rest_is_compared_with_the_weight_above(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_stress result;
    mor_measure_column column = build_column(1.03, 0.0);
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result), MOR_OK);
    assert_true(fabs(result.error_l2 - 0.03) < 1e-12);         /* rounding, as all below */
    assert_true(fabs(result.lateral_ratio - 0.5) < 1e-12);     /* rounding */
    assert_true(fabs(result.slope - 1.03 * 2e4) < 1e-8);       /* rounding of 2e4 */
    assert_true(fabs(result.base_stress + 1.03 * 2e4) < 1e-8); /* rounding of 2e4 */
    assert_true(result.noise < 1e-8);                          /* rounding of 2e4 */
    assert_int_equal(result.n_used, 1000);
    column = build_column(1.0, 50.0);
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result), MOR_OK);
    assert_true(fabs(result.noise - 50.0) < 1e-8); /* the alternation has no slope in a row: rounding */
    assert_true(fabs(result.error_l2 - 50.0 / (2e4 / sqrt(3.0))) < 1e-6); /* midpoint rule: 1e-5 of it */
    column.lowest = 0.2;
    column.highest = 0.4;
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result), MOR_OK);
    assert_int_equal(result.n_used, 200);
    column.gravity = 0.0;
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result), MOR_OK);
    assert_true(isnan(result.error_l2));
    column.highest = 0.201;
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result),
                     MOR_ERROR_ARGUMENT);
    column = build_column(1.0, 0.0);
    column.up[2] = 0.5;
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result),
                     MOR_ERROR_ARGUMENT);
}

static void column_in_space_averages_both_sides(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_stress result;
    const mor_measure_column column = {.up = {0.0, 0.0, 1.0},
                                       .surface_height = 4.0,
                                       .density = 1.0,
                                       .gravity = 1.0,
                                       .lowest = -INFINITY,
                                       .highest = INFINITY};
    start_heap(3, 1.0);
    for (int i = 0; i < 5; ++i) {
        const double height = i + 0.5; /* the last one lies above the surface, where the reference is 0 */
        const double along = -fmax(0.0, 4.0 - height);
        add_grain(0.0, 0.0, height, 1.0);
        double *s = ground.stress + 6 * i;
        s[MOR_XX] = 0.25 * along;
        s[MOR_YY] = 0.75 * along;
        s[MOR_ZZ] = along;
        s[MOR_XY] = 3.0;
        s[MOR_YZ] = s[MOR_ZX] = 0.0;
    }
    assert_int_equal(mor_measure_column_stress(&context, &ground.points, ground.stress, &column, &result), MOR_OK);
    assert_true(result.error_l2 == 0.0);      /* exact: binary fractions */
    assert_true(result.lateral_ratio == 0.5); /* exact: binary fractions */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_at_rest_is_compared_with_the_weight_above),
        cmocka_unit_test(column_in_space_averages_both_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
