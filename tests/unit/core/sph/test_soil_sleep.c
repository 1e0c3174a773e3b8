/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What soil that may sleep asks of the walls beside it. */
#include "tests/common/rock_scene.h"

static mor_status place_nothing(mor_context *context, const void *owner, const int64_t *numbers, int64_t n,
                                const mor_wall_points *points)
{
    (void)context, (void)owner, (void)numbers, (void)n, (void)points;
    return MOR_OK;
}

/* Adds a wall of two points that is filled where soil is near, and rotates by an angle in rad. */
static mor_status add_wall(double sleep_after, double released, double angle, bool is_filled_at_once)
{
    static const double points[6] = {0.005, -0.005, 0.0, 0.015, -0.005, 0.0};
    static const int64_t numbers[2] = {0, 1};
    static const double axis[3] = {0.0, 0.0, 1.0};
    static const int sides[3] = {2, 2, 1};
    const mor_motion_row rows[2] = {{.time = 0.0}, {.time = 1.0, .translation = {0.1, 0.0, 0.0}, .angle = angle}};
    const mor_wall_source source = {.place = place_nothing};
    mor_motion motion;
    rock_scene it;
    rock_scene_open(&it, 2, 0.01, 1);
    it.settings.scheme.sleep_after = sleep_after;
    it.settings.released[0] = released;
    rock_scene_add_soil(&it, (const double[3]){0.0, 0.0, 0.0}, sides);
    rock_scene_build(&it);
    rock_scene_require(&it, mor_motion_init(&it.context, &motion, rows, 2, (const double[3]){0.0}, axis, false));
    const mor_wall_request request = {.name = "drum",
                                      .points = points,
                                      .n_points = 2,
                                      .point_volume = 1e-4,
                                      .dimension = 2,
                                      .motion = &motion,
                                      .source = is_filled_at_once ? NULL : &source,
                                      .numbers = is_filled_at_once ? NULL : numbers};
    const mor_status status = mor_soil_add_wall(&it.context, &it.soil, &request);
    assert_true(status == MOR_OK || strstr(it.context.message, "wall 'drum' rotates") != NULL);
    assert_int_equal(it.soil.n_walls, status == MOR_OK);
    mor_soil_clear(&it.context, &it.soil);
    mor_motion_clear(&it.context, &motion);
    rock_scene_close(&it);
    return status;
}

/* The box of such a wall would be taken for what moves, with the speed of one of its points. */
static void wall_that_rotates_beside_soil_that_stands_still_holds_all_its_particles(void **state)
{
    (void)state;
    assert_int_equal(add_wall(1.0, 0.0, 0.5, false), MOR_ERROR_ARGUMENT);
    assert_int_equal(add_wall(0.0, 2.0, 0.5, false), MOR_ERROR_ARGUMENT);
    assert_int_equal(add_wall(0.0, 0.0, 0.5, false), MOR_OK);
    assert_int_equal(add_wall(1.0, 0.0, 0.0, false), MOR_OK); /* it is translated */
    assert_int_equal(add_wall(1.0, 2.0, 0.5, true), MOR_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wall_that_rotates_beside_soil_that_stands_still_holds_all_its_particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
