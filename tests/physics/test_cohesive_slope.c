/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shipped cohesive slopes, ten particles high: loaded slowly, they stand without creep at 0.9 of their critical
 * height and fail at 1.2 of it. */
#include "tests/common/scene.h"

#include <stdio.h>

#define SLOPE MOR_SOURCE_DIR "/cases/cohesive-slope/case.cfg"
#define CUT MOR_SOURCE_DIR "/cases/cohesive-slope/case-cut.cfg"

static const char *const coarse_slope[] = {"spacing=0.5 m", NULL};
static const char *const coarse_cut[] = {"spacing=0.4 m", NULL};
static const char *const as_it_is[] = {NULL};
static const char *const weak_slope[] = {"soil[0].material.cohesion=8.0205 kPa", NULL};
static const char *const weak_cut[] = {"soil[0].material.cohesion=11.008 kPa", NULL};

/* Distance, m, by which the center of all soil moves outwards in the first two seconds without damping; path is
 * zero-terminated, both lists end with NULL. */
static double find_shift(const char *path, const char *const *spacing, const char *const *strength)
{
    const char *const *lists[] = {spacing, strength};
    scene *it = scene_new(&(scene_request){path, lists, 2, 1});
    scene_advance(it, 2.0);
    const double loaded = scene_probe(it, "shift");
    scene_advance(it, 4.0);
    const double shift = scene_probe(it, "shift") - loaded;
    scene_free(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%s %s: %.6f m\n", path, strength[0] != NULL ? strength[0] : "", shift);
    }
    return shift;
}

static void cohesive_slope_stands_below_its_critical_height(void **state)
{
    (void)state;
    /* A tenth of the millimeter that the crest may move. */
    scene_expect_near("shift of the slope", find_shift(SLOPE, coarse_slope, as_it_is), 0.0, 1e-4);
    scene_expect_near("shift of the cut", find_shift(CUT, coarse_cut, as_it_is), 0.0, 1e-4);
}

static void cohesive_slope_fails_above_its_critical_height(void **state)
{
    (void)state;
    /* A tenth of the soil slides by half a spacing at least. */
    assert_true(find_shift(SLOPE, coarse_slope, weak_slope) > 0.02);
    assert_true(find_shift(CUT, coarse_cut, weak_cut) > 0.02);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cohesive_slope_stands_below_its_critical_height),
        cmocka_unit_test(cohesive_slope_fails_above_its_critical_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
