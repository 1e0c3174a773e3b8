/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shipped plow in a smaller tank: without cohesion and without an effect of the rate of shear all stresses are in
 * proportion to the density, and so is the drag; it grows with the depth, faster than the depth and slower than its
 * square: pressure grows with the depth as well, inertia does not. */
#include "tests/common/scene.h"

#include <stdio.h>

static const char *const small_tank[] = {
    "lattice.origin=('0 m', '-0.09 m', '-0.11 m')",  "soil[0].shape.min=('0 m', '-0.09 m', '-0.11 m')",
    "soil[0].shape.max=('0.28 m', '0.09 m', '0 m')", "walls[0].shape.point=('0 m', '0 m', '-0.11 m')",
    "walls[2].shape.point=('0.28 m', '0 m', '0 m')", "walls[3].shape.point=('0 m', '-0.09 m', '0 m')",
    "walls[4].shape.point=('0 m', '0.09 m', '0 m')", NULL};
static const char *const as_shipped[] = {NULL};
static const char *const heavy[] = {"soil[0].material.density=3200 kg/m3", NULL};
static const char *const shallow[] = {"bodies[0].position=('0.1 m', '0 m', '-0.03 m')", NULL};
static const char *const strong[] = {"soil[0].material.friction_angle=26.7437 deg", NULL};

/* Mean drag from 25 to 45 ms, 22 mm of way at most, N. */
static double pull(const char *const *variant)
{
    const char *const *lists[] = {small_tank, variant};
    const scene_request request = {MOR_SOURCE_DIR "/cases/plow/case.cfg", lists, 2, 1};
    scene *it = scene_new(&request);
    scene_advance(it, 0.025);
    const double before = scene_probe(it, "impulse");
    scene_advance(it, 0.045);
    const double drag = (scene_probe(it, "impulse") - before) / 0.02;
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%s: %.3f N\n", variant[0] != NULL ? variant[0] : "as shipped", drag);
    }
    scene_free(it);
    return drag;
}

static void drag_grows_with_density_friction_and_depth(void **state)
{
    (void)state;
    const double drag = pull(as_shipped);
    const double ratio = pull(heavy) / drag;
    /* The stiffness stays: the denser soil is compressed more, by 0.2 % of the depth. */
    scene_expect_near("drag of the denser soil", ratio, 3200.0 / 1700.0, 0.05 * 3200.0 / 1700.0);
    assert_true(pull(strong) > 1.2 * drag); /* the friction is 1.8 times as high; the part of inertia stays */
    const double power = log(drag / pull(shallow)) / log(0.06 / 0.03);
    assert_true(power > 1.0 && power < 2.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_grows_with_density_friction_and_depth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
