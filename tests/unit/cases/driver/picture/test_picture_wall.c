/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_wall.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double spacing = 0.1; /* m */
static const double up[3] = {0.0, 0.0, 1.0};
static const mor_bounds moving = {{0.0, 0.0, 0.0}, {4.0, 3.0, 2.0}}; /* m */

/* A case with one wall; takes the shape. */
static void set_wall(mor_case *the_case, mor_shape *shape)
{
    memset(the_case, 0, sizeof *the_case);
    the_case->dimension = 3;
    the_case->spacing = spacing;
    the_case->rotation[0] = the_case->rotation[4] = the_case->rotation[8] = 1.0;
    the_case->n_walls = 1;
    the_case->walls[0].shape = shape;
}

static mor_shape *new_box(mor_context *context, const double *low, const double *high)
{
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_box(context, low, high, &shape), MOR_OK);
    return shape;
}

/* Two particles, half a spacing inside opposite corners, stand for all of them. */
static bool judge(const mor_case *the_case, const double *low, const double *high)
{
    double ends[6];
    for (int a = 0; a < 3; ++a) {
        ends[a] = low[a] + 0.5 * spacing;
        ends[3 + a] = high[a] - 0.5 * spacing;
    }
    const mor_lattice_points points = {ends, 2};
    return mor_picture_wall_is_structure(the_case, 0, &points, &moving, up);
}

/* A screen half a meter thick beside all that moves, up to a height. */
static void set_screen(mor_context *context, mor_case *the_case, double top)
{
    const double low[3] = {5.0, -1.0, -1.0};
    const double high[3] = {5.5, 4.0, top};
    mor_context_init(context);
    set_wall(the_case, new_box(context, low, high));
}

static bool judge_box(mor_context *context, const double *low, const double *high)
{
    static mor_case the_case; /* large */
    set_wall(&the_case, new_box(context, low, high));
    const bool is = judge(&the_case, low, high);
    mor_shape_free(context, &the_case.walls[0].shape);
    return is;
}

static void houses_and_dams_are_structures_floors_and_what_dwarfs_the_scene_are_not(void **state)
{
    mor_context context;
    (void)state;
    mor_context_init(&context);
    const double house[2][3] = {{5.0, 1.0, 0.0}, {6.0, 2.0, 5.0}};
    const double dam[2][3] = {{5.0, -2.0, 0.0}, {6.0, 5.0, 1.0}};     /* wider than what moves */
    const double floor[2][3] = {{-1.0, -1.0, -0.5}, {5.0, 4.0, 0.0}}; /* under all that moves */
    const double tower[2][3] = {{5.0, 1.0, 0.0}, {6.0, 2.0, 17.0}};   /* 4.25 times the 4 m of the scene */
    const double distant[2][3] = {{16.0, 1.0, 0.0}, {17.0, 2.0, 1.0}};
    assert_true(judge_box(&context, house[0], house[1]));
    assert_true(judge_box(&context, dam[0], dam[1]));
    assert_false(judge_box(&context, floor[0], floor[1]));
    assert_false(judge_box(&context, tower[0], tower[1]));
    assert_false(judge_box(&context, distant[0], distant[1]));
}

static void what_has_no_end_or_moves_is_no_structure(void **state)
{
    static mor_case the_case; /* large */
    mor_context context;
    mor_shape *shape = NULL;
    (void)state;
    mor_context_init(&context);
    const double low[3] = {5.0, 1.0, 0.0};
    const double high[3] = {6.0, 2.0, 1.0};
    assert_int_equal(mor_shape_new_half_space(&context, low, up, &shape), MOR_OK);
    set_wall(&the_case, shape);
    assert_false(judge(&the_case, low, high));
    mor_shape_free(&context, &the_case.walls[0].shape);
    set_wall(&the_case, new_box(&context, low, high));
    assert_true(judge(&the_case, low, high));
    the_case.walls[0].velocity[2] = 0.1;
    assert_false(judge(&the_case, low, high));
    mor_shape_free(&context, &the_case.walls[0].shape);
}

static void a_screen_hides_what_is_behind_it_and_not_what_is_before_it(void **state)
{
    static mor_case the_case; /* large */
    mor_context context;
    (void)state;
    const double front[3] = {1.0, 0.0, 0.0};
    const double back[3] = {-1.0, 0.0, 0.0};
    const double steep[3] = {0.1, 0.0, sqrt(0.99)}; /* over the screen from nearly all places */
    set_screen(&context, &the_case, 3.0);
    assert_true(mor_picture_wall_hides(&the_case, 0, &moving, front));
    assert_false(mor_picture_wall_hides(&the_case, 0, &moving, back));
    assert_false(mor_picture_wall_hides(&the_case, 0, &moving, steep));
    mor_shape_free(&context, &the_case.walls[0].shape);
}

static void the_share_that_a_low_wall_hides_decides(void **state)
{
    static mor_case the_case; /* large */
    mor_context context;
    (void)state;
    const double front[3] = {1.0, 0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
        /* Of 2 m: less than two of eight rows, less than three. */
        set_screen(&context, &the_case, k == 0 ? 0.45 : 0.7);
        assert_true(mor_picture_wall_hides(&the_case, 0, &moving, front) == (k == 1));
        mor_shape_free(&context, &the_case.walls[0].shape);
    }
}

static void a_placed_case_hides_as_the_unplaced_one(void **state)
{
    static mor_case the_case; /* large */
    mor_context context;
    (void)state;
    const double front[3] = {0.0, 1.0, 0.0}; /* x of the case, turned by 90 degrees about z */
    const double rotation[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
    const mor_bounds placed = {{-3.0 + 7.0, 0.0, 0.0}, {0.0 + 7.0, 4.0, 2.0}};
    set_screen(&context, &the_case, 3.0);
    memcpy(the_case.rotation, rotation, sizeof rotation);
    the_case.translation[0] = 7.0;
    assert_true(mor_picture_wall_hides(&the_case, 0, &placed, front));
    the_case.translation[0] = 70.0; /* now the wall stands elsewhere */
    assert_false(mor_picture_wall_hides(&the_case, 0, &placed, front));
    mor_shape_free(&context, &the_case.walls[0].shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(houses_and_dams_are_structures_floors_and_what_dwarfs_the_scene_are_not),
        cmocka_unit_test(what_has_no_end_or_moves_is_no_structure),
        cmocka_unit_test(a_screen_hides_what_is_behind_it_and_not_what_is_before_it),
        cmocka_unit_test(the_share_that_a_low_wall_hides_decides),
        cmocka_unit_test(a_placed_case_hides_as_the_unplaced_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
