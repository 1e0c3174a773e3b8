/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shipped glass ball on sand that can become a gas, coarse and in a smaller box to be short: what the sand gives
 * the ball, what the box weighs, and how friction shows. */
#include "tests/common/scene.h"

#include <stdio.h>

#define MASS 0.0675756809 /* of the ball, 2290 kg/m3 * 4/3 pi (19.17 mm)^3, kg */
#define IMPACT 2.80143    /* m/s */
#define GRAVITY 9.81      /* m/s2 */
#define REST 0.03         /* by then the ball has nearly stopped, s */

static const char *const small_box[] = {"spacing=5 mm",
                                        "lattice.origin=('-50 mm', '-40 mm', '-60 mm')",
                                        "soil[0].shape.min=('-50 mm', '-40 mm', '-60 mm')",
                                        "soil[0].shape.max=('50 mm', '40 mm', '0 mm')",
                                        "walls[0].shape.point=('0 mm', '0 mm', '-60 mm')",
                                        "walls[1].shape.point=('-50 mm', '0 mm', '0 mm')",
                                        "walls[2].shape.point=('50 mm', '0 mm', '0 mm')",
                                        "walls[3].shape.point=('0 mm', '-40 mm', '0 mm')",
                                        "walls[4].shape.point=('0 mm', '40 mm', '0 mm')",
                                        NULL};
static const char *const as_shipped[] = {NULL};
static const char *const stronger[] = {"soil[0].material.friction_angle=34 deg", NULL};

/* What an impact leaves behind; impulses in N s, upwards on the ball, downwards on the box. */
typedef struct outcome {
    double depth, speed, peak; /* m, m/s, N */
    double on_ball, on_box, weight,
        momentum; /* weight: of sand and ball, times the time; momentum: downwards, gained */
} outcome;

static double find_load(scene *it)
{
    static const char *const walls[] = {"floor_force", "left_force", "right_force", "front_force", "back_force"};
    double sum = 0.0;
    for (int k = 0; k < 5; ++k) {
        sum += scene_probe(it, walls[k]);
    }
    return sum;
}

static outcome drop(const char *const *variant)
{
    const char *const *lists[] = {small_box, variant};
    const scene_request request = {MOR_SOURCE_DIR "/cases/toyoura-impact/case.cfg", lists, 2, 1};
    outcome found = {0};
    scene *it = scene_new(&request);
    const double before = scene_probe(it, "momentum");
    const double sand = 1280.0 * 0.1 * 0.08 * 0.06; /* kg */
    double time = 0.0;
    while (time < REST) {
        scene_step(it, 1);
        const double now = mor_schedule_time(&it->simulation.schedule);
        const double force = scene_probe(it, "ball_force");
        found.on_ball += force * (now - time);
        found.on_box += find_load(it) * (now - time);
        found.peak = fmax(found.peak, force);
        time = now;
    }
    found.weight = (sand + MASS) * GRAVITY * time;
    found.momentum = scene_probe(it, "momentum") - before;
    found.speed = scene_probe(it, "fall");
    found.depth = scene_probe(it, "depth_now");
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("depth %.2f mm, speed %.3f m/s, peak %.1f N, on the ball %.5f N s, on the box less weight %.5f N s\n",
               1e3 * found.depth, found.speed, found.peak, found.on_ball, found.on_box - found.weight);
    }
    scene_free(it);
    return found;
}

/* Both impacts, computed once for all tests. */
typedef struct impacts {
    outcome weak, strong;
} impacts;

static int compute_impacts(void **state)
{
    static impacts computed;
    computed = (impacts){drop(as_shipped), drop(stronger)};
    *state = &computed;
    return 0;
}

static void impulses_on_ball_and_box_are_those_of_the_momentum(void **state)
{
    const outcome found = ((const impacts *)*state)->weak;
    const double on_ball = MASS * (IMPACT - found.speed + GRAVITY * REST);
    /* Its mass to 1e-9, the time by the last step: 0.13 ms of 30 ms of its weight. */
    scene_expect_near("impulse on the ball", found.on_ball, on_ball, 1e-3 * on_ball);
    /* Rounding; the weight of the sand is that of its particles. */
    scene_expect_near("impulse on the box", found.on_box, found.weight - found.momentum, 1e-6 * found.weight);
}

static void stronger_sand_stops_the_ball_sooner(void **state)
{
    const outcome weak = ((const impacts *)*state)->weak;
    const outcome strong = ((const impacts *)*state)->strong;
    assert_true(strong.depth < 0.95 * weak.depth); /* 1.15 times the friction, whose inverse the depth follows */
    assert_true(strong.peak > weak.peak);
    /* Uehara et al. (2003) in a wide bed with mu = tan(phi) has 27.8 mm; coarse sand is too stiff. */
    assert_true(weak.depth > 0.5 * 27.8e-3 && weak.depth < 1.3 * 27.8e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impulses_on_ball_and_box_are_those_of_the_momentum),
        cmocka_unit_test(stronger_sand_stops_the_ball_sooner),
    };
    return cmocka_run_group_tests(tests, compute_impacts, NULL);
}
