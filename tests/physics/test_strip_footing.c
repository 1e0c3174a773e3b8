/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shipped strip footing on undrained clay, with ten spacings across the strip and half the settlement. Prandtl
 * (1920): q = (2 + pi) s_u, whatever the weight of the clay, and for a smooth strip as for a rough one. */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

#define STRENGTH 10e3 /* s_u, Pa */
#define WIDTH 1.0     /* of the strip, m */

static const char *const coarse[] = {"spacing=0.1 m", NULL};
static const char *const as_shipped[] = {NULL};
static const char *const with_weight[] = {"gravity=('0 m/s2', '-9.81 m/s2')",
                                          "soil[0].initial_stress={ type='k0'; lateral_ratio=1.0; }", NULL};

/* What the clay answers. */
typedef struct answer {
    double capacity; /* mean pressure between 3 and 5 mm of settlement / s_u, 1 */
    double sideways; /* horizontal over vertical force at the end, 1 */
} answer;

static answer press(const char *const *variant)
{
    const char *const *lists[] = {coarse, variant};
    const scene_request request = {MOR_SOURCE_DIR "/cases/strip-footing/case.cfg", lists, 2, 1};
    scene *it = scene_new(&request);
    scene_advance(it, 0.6);
    const double before = scene_probe(it, "impulse");
    scene_advance(it, 1.0);
    const double force = (scene_probe(it, "impulse") - before) / 0.4;
    const answer found = {force / (WIDTH * STRENGTH), scene_probe(it, "sideways") / force};
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("capacity %.4f s_u, force to the side %.2g\n", found.capacity, found.sideways);
    }
    scene_free(it);
    return found;
}

/* Clay without weight, computed once for all tests. */
static int press_weightless(void **state)
{
    static answer computed;
    computed = press(as_shipped);
    *state = &computed;
    return 0;
}

static void strip_carries_the_load_of_prandtl(void **state)
{
    const double prandtl = 2.0 + 3.14159265358979324;
    const answer found = *(const answer *)*state;
    assert_true(found.capacity < prandtl);        /* from below, and by half at half the spacing */
    assert_true(found.capacity > 0.88 * prandtl); /* about one spacing of ten, at the edges of the strip */
    assert_true(fabs(found.sideways) < 1e-9);     /* symmetry, to rounding */
}

static void weight_of_the_clay_changes_no_bearing_capacity(void **state)
{
    const answer weightless = *(const answer *)*state;
    const answer heavy = press(with_weight);
    /* Soil displaced: 2000 kg/m3 * 9.81 m/s2 * 4 mm = 0.008 s_u. The rest is the error of the stress at the start. */
    scene_expect_near("capacity with weight", heavy.capacity, weightless.capacity, 0.03 * weightless.capacity);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strip_carries_the_load_of_prandtl),
        cmocka_unit_test(weight_of_the_clay_changes_no_bearing_capacity),
    };
    return cmocka_run_group_tests(tests, press_weightless, NULL);
}
