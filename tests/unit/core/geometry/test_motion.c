/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/motion.h"
#include "tests/common/near.h"

#include <string.h>

/* Prescribed motions: poses between rows, velocities as their derivatives, bounds, refusals. */

static const double point[3] = {0.3, -0.2, 0.5};
static const double axis[3] = {1.0, 2.0, -2.0};
static const mor_motion_row rows[] = {{0.5, {0.0, 0.0, 0.0}, 0.0},
                                      {1.0, {0.2, -0.1, 0.0}, 1.0},
                                      {1.5, {0.3, -0.1, 0.4}, 9.0},
                                      {3.0, {0.3, -0.2, 0.1}, 8.0}};
enum { N_ROWS = sizeof rows / sizeof *rows };

static void open_motion(mor_context *context, mor_motion *motion, bool is_smooth)
{
    mor_context_init(context);
    assert_int_equal(mor_motion_init(context, motion, rows, N_ROWS, point, axis, is_smooth), MOR_OK);
}

static void close_motion(mor_context *context, mor_motion *motion)
{
    mor_motion_clear(context, motion);
    assert_int_equal(context->memory_bytes, 0);
}

static void rows_are_met_and_held_outside(void **state)
{
    (void)state;
    for (int is_smooth = 0; is_smooth < 2; ++is_smooth) {
        mor_context context;
        mor_motion motion;
        mor_pose pose;
        open_motion(&context, &motion, is_smooth != 0);
        for (int k = 0; k < N_ROWS; ++k) {
            double place[3];
            mor_motion_find(&motion, rows[k].time, &pose);
            mor_pose_place(&pose, point, place); /* the point of the axis is only translated */
            for (int a = 0; a < 3; ++a) {
                assert_near(place[a], point[a] + rows[k].translation[a], 1e-15); /* rounding of a rotation */
            }
            assert_near(pose.angle, rows[k].angle, 1e-15);
        }
        const double outside[] = {0.0, 0.49, 3.0, 100.0};
        for (int k = 0; k < 4; ++k) {
            mor_motion_find(&motion, outside[k], &pose);
            assert_true(pose.angle == rows[k < 2 ? 0 : N_ROWS - 1].angle);
            assert_true(mor_vector_length(pose.velocity) == 0.0 && mor_vector_length(pose.angular_velocity) == 0.0);
        }
        close_motion(&context, &motion);
    }
}

static void velocity_is_the_derivative_of_the_place(void **state)
{
    (void)state;
    const double start[3] = {-0.4, 0.7, 0.1};
    const double step = 1e-6;
    for (int k = 0; k < 200; ++k) {
        mor_context context;
        mor_motion motion;
        mor_pose before, at, after;
        double x0[3], x[3], x1[3], v[3];
        const double time = 0.5 + 2.5 * (k + 0.5) / 200.0; /* between rows */
        open_motion(&context, &motion, k % 2 == 0);
        mor_motion_find(&motion, time - step, &before);
        mor_motion_find(&motion, time, &at);
        mor_motion_find(&motion, time + step, &after);
        mor_pose_place(&before, start, x0);
        mor_pose_place(&at, start, x);
        mor_pose_place(&after, start, x1);
        mor_pose_velocity(&at, x, v);
        for (int a = 0; a < 3; ++a) {
            /* a central difference: step^2 times the third derivative, about 16^3 m/s3, and rounding / step */
            assert_near((x1[a] - x0[a]) / (2.0 * step), v[a], 1e-8);
        }
        double back[3];
        mor_pose_take_back(&at, x, back);
        for (int a = 0; a < 3; ++a) {
            assert_near(back[a], start[a], 1e-14); /* rounding of two rotations */
        }
        close_motion(&context, &motion);
    }
}

static void smooth_motion_has_no_jump_of_velocity_and_overshoots_no_row(void **state)
{
    (void)state;
    mor_context context;
    mor_motion motion;
    open_motion(&context, &motion, true);
    mor_pose last, pose;
    const int n = 20000;
    mor_motion_find(&motion, 0.49, &last);
    for (int k = 1; k <= n; ++k) {
        mor_motion_find(&motion, 0.49 + 2.52 * k / n, &pose);
        const double jump = fabs(pose.angular_velocity[0] - last.angular_velocity[0]);
        assert_true(jump < 0.04); /* the largest second derivative, about 6 * 8 / 0.5^2, times the step, times 1/3 */
        assert_true(pose.angle >= 0.0 && pose.angle <= 9.0);
        last = pose;
    }
    close_motion(&context, &motion);
}

static void the_bound_of_the_speed_is_met_and_not_passed(void **state)
{
    (void)state;
    for (int is_smooth = 0; is_smooth < 2; ++is_smooth) {
        mor_context context;
        mor_motion motion;
        open_motion(&context, &motion, is_smooth != 0);
        const double start[3] = {0.3, 0.8, 0.5};
        const double bound = mor_motion_fastest(&motion, mor_motion_radius(&motion, start));
        double fastest = 0.0;
        for (int k = 0; k < 30000; ++k) {
            mor_pose pose;
            double place[3], velocity[3];
            mor_motion_find(&motion, k * 1e-4, &pose);
            mor_pose_place(&pose, start, place);
            mor_pose_velocity(&pose, place, velocity);
            fastest = fmax(fastest, mor_vector_length(velocity));
        }
        assert_true(fastest <= bound * (1.0 + 1e-12));
        assert_true(fastest > 0.8 * bound); /* translation and rotation need not point alike */
        close_motion(&context, &motion);
    }
}

static void a_full_revolution_returns_and_a_uniform_pose_is_a_translation(void **state)
{
    (void)state;
    const mor_motion_row turn[] = {{0.0, {0.0, 0.0, 0.0}, 0.0}, {1.0, {0.0, 0.0, 0.0}, 200.0 * MOR_PI}};
    const double start[3] = {4.0, 5.0, 6.0};
    const double velocity[3] = {1.0, -2.0, 0.5};
    mor_context context;
    mor_motion motion;
    mor_pose pose;
    double place[3];
    mor_context_init(&context);
    assert_int_equal(mor_motion_init(&context, &motion, turn, 2, point, axis, false), MOR_OK);
    assert_true(mor_motion_rotates(&motion));
    mor_motion_find(&motion, 0.5, &pose); /* 50 revolutions */
    mor_pose_place(&pose, start, place);
    for (int a = 0; a < 3; ++a) {
        assert_near(place[a], start[a], 1e-12); /* rounding of an angle of 314 over a radius of 8 */
    }
    mor_motion_clear(&context, &motion);
    pose = mor_pose_uniform(velocity, 2.0);
    mor_pose_place(&pose, start, place);
    assert_true(place[0] == 6.0 && place[1] == 1.0 && place[2] == 7.0);
}

static void nonsense_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_motion motion;
    mor_motion_row wrong[2] = {{1.0, {0.0, 0.0, 0.0}, 0.0}, {1.0, {0.0, 0.0, 0.0}, 0.0}};
    const double none[3] = {0.0, 0.0, 0.0};
    mor_context_init(&context);
    assert_int_equal(mor_motion_init(&context, &motion, wrong, 2, point, axis, false), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "rising times"));
    wrong[1].time = NAN;
    assert_int_equal(mor_motion_init(&context, &motion, wrong, 2, point, axis, false), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_motion_init(&context, &motion, wrong, 0, point, axis, false), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_motion_init(&context, &motion, rows, N_ROWS, point, none, false), MOR_ERROR_ARGUMENT);
    assert_null(motion.rows);
    assert_int_equal(context.memory_bytes, 0);
}

static void motions_are_equal_number_by_number(void **state)
{
    (void)state;
    mor_context context;
    mor_motion first, second;
    open_motion(&context, &first, true);
    assert_int_equal(mor_motion_init(&context, &second, rows, N_ROWS, point, axis, true), MOR_OK);
    assert_true(mor_motion_equals(&first, &second));
    second.rows[2].angle += 1.0;
    assert_false(mor_motion_equals(&first, &second));
    mor_motion_clear(&context, &second);
    close_motion(&context, &first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_met_and_held_outside),
        cmocka_unit_test(velocity_is_the_derivative_of_the_place),
        cmocka_unit_test(smooth_motion_has_no_jump_of_velocity_and_overshoots_no_row),
        cmocka_unit_test(the_bound_of_the_speed_is_met_and_not_passed),
        cmocka_unit_test(a_full_revolution_returns_and_a_uniform_pose_is_a_translation),
        cmocka_unit_test(nonsense_is_refused),
        cmocka_unit_test(motions_are_equal_number_by_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
