/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shipped slope of the ACADS survey, problem 1(a), with a factor of safety of 1.00 (0.958 to 1.010 by various
 * methods), coarse: it stands with c and tan(phi) divided by 0.9 and slides with both divided by 1.1. */
#include "tests/common/scene.h"

#include <stdio.h>

#define MOHR_COULOMB(cohesion, angle)                                                                                  \
    "soil[0].material={ model='mohr_coulomb'; density=2038.74; youngs_modulus='20 MPa'; poissons_ratio=0.3;"           \
    " cohesion='" cohesion "'; friction_angle='" angle "'; }"

static const char *const coarse[] = {"spacing=1 m", NULL};
static const char *const cone_stronger[] = {"soil[0].material.cohesion=3.3333 kPa",
                                            "soil[0].material.friction_angle=21.5862 deg", NULL};
static const char *const cone_weaker[] = {"soil[0].material.cohesion=2.7273 kPa",
                                          "soil[0].material.friction_angle=17.9374 deg", NULL};
static const char *const pyramid_stronger[] = {MOHR_COULOMB("3.3333 kPa", "21.5862 deg"), NULL};
static const char *const pyramid_weaker[] = {MOHR_COULOMB("2.7273 kPa", "17.9374 deg"), NULL};

/* Motions of the center of mass of all soil towards the toe, m: at the end, and since gravity is whole. */
typedef struct motion {
    double whole, late;
} motion;

static motion load(const char *const *strength)
{
    const char *const *lists[] = {coarse, strength};
    const scene_request request = {MOR_SOURCE_DIR "/cases/slope-acads/case.cfg", lists, 2, 1};
    scene *it = scene_new(&request);
    const double start = scene_probe(it, "shift");
    scene_advance(it, 4.5);
    const double loaded = scene_probe(it, "shift");
    scene_advance(it, 9.0);
    const double end = scene_probe(it, "shift");
    scene_free(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%-60.60s moved by %.4f m, of which late %.5f m\n", strength[0], end - start, end - loaded);
    }
    return (motion){end - start, end - loaded};
}

/* The sliding mass, a third of the soil, would move by more than a tenth of the height of the slope if it slid freely;
 * the elastic settlement moves the center by a centimeter. */
static void expect_stands(const char *const *strength)
{
    const motion found = load(strength);
    assert_true(fabs(found.whole) < 0.02); /* elastic: rho g H^2 / 2 E = 5 cm at the crest, less elsewhere */
    assert_true(fabs(found.late) < 0.001); /* nothing moves once the weight is there: a thousandth of a spacing */
}

static void expect_slides(const char *const *strength)
{
    const motion found = load(strength);
    assert_true(found.whole > 0.08); /* a third of the soil by a quarter of a spacing at least, 0.11 were measured */
    assert_true(found.late > 0.04);
}

static void slope_stands_with_a_stronger_cone(void **state)
{
    (void)state;
    expect_stands(cone_stronger);
}

static void slope_slides_with_a_weaker_cone(void **state)
{
    (void)state;
    expect_slides(cone_weaker);
}

static void slope_stands_with_a_stronger_mohr_coulomb_soil(void **state)
{
    (void)state;
    expect_stands(pyramid_stronger);
}

static void slope_slides_with_a_weaker_mohr_coulomb_soil(void **state)
{
    (void)state;
    expect_slides(pyramid_weaker);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_stands_with_a_stronger_cone),
        cmocka_unit_test(slope_slides_with_a_weaker_cone),
        cmocka_unit_test(slope_stands_with_a_stronger_mohr_coulomb_soil),
        cmocka_unit_test(slope_slides_with_a_weaker_mohr_coulomb_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
