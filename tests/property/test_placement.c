/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene_variant.h"

#include <math.h>

/* A scene that is turned and moved as a whole, gravity included, must do the same: no axis is special, no place either.
 * Rounding differs, so positions agree to a tolerance. Some steps later a particle at a Coulomb wall begins to slip,
 * where a rounding of 1e-15 m grows to 2e-9 m. */
enum { N_STEPS = 70 };

static const char *const quarter_turns[][4] = {
    {"placement.axis=(1, 0, 0)", "placement.angle=90 deg", NULL},
    {"placement.axis=(0, 1, 0)", "placement.angle=90 deg", NULL},
    {"placement.axis=(0, 0, 1)", "placement.angle=90 deg", NULL},
};

/* Largest distance between a particle of one scene and the same particle of another, turned and moved back, m. */
static double find_largest_gap(scene *plain, scene *placed)
{
    const int32_t *place_a = scene_find_places(plain);
    const int32_t *place_b = scene_find_places(placed);
    const double *a = plain->simulation.soil.set.data[MOR_FIELD_POSITION];
    const double *b = placed->simulation.soil.set.data[MOR_FIELD_POSITION];
    double largest = 0.0;
    for (int64_t id = 0; id < plain->simulation.soil.set.n_particles; ++id) {
        double expected[3];
        mor_simulation_place_point(&placed->the_case, a + 3 * place_a[id], expected);
        const double *found = b + 3 * place_b[id];
        const double gap[3] = {found[0] - expected[0], found[1] - expected[1], found[2] - expected[2]};
        largest = fmax(largest, mor_vector_length(gap));
    }
    return largest;
}

static void check_variant(const char *text, const scene_variant *variant, const char *const *rotation)
{
    const double size = 0.2; /* of the scenes, m */
    const scene_request request = {text, (const char *const *[]){variant->settings}, 1, 1};
    const scene_request turned = {text, (const char *const *[]){variant->settings, rotation}, 2, 1};
    scene *plain = scene_new(&request);
    scene *placed = scene_new(&turned);
    scene_step(plain, N_STEPS);
    scene_step(placed, N_STEPS);
    const double gap = find_largest_gap(plain, placed);
    if (!(gap <= 1e-9 * size)) { /* rounding of 1e-16, grown by the unstable motion of grains */
        fail_msg("'%s' with %s: particles are %.3g m away from where they should be", variant->name, rotation[0], gap);
    }
    scene_free(placed);
    scene_free(plain);
}

static void plane_soil_is_the_same_after_a_quarter_turn(void **state)
{
    (void)state;
    for (int k = 0; k < SCENE_VARIANTS; ++k) {
        check_variant(scene_plane, &scene_variants[k], quarter_turns[2]);
    }
}

static void space_soil_is_the_same_after_quarter_turns(void **state)
{
    (void)state;
    for (int k = 0; k < SCENE_VARIANTS; ++k) {
        check_variant(scene_space, &scene_variants[k], quarter_turns[k % 3]);
    }
    for (int axis = 1; axis < 3; ++axis) {
        check_variant(scene_space, &scene_variants[0], quarter_turns[axis]);
    }
}

/* A turn that maps no axis onto another, and a move by many times the size of the scene. Grains tumble, so rounding
 * grows until single grains end elsewhere; what a user reads off the deposit must not change. */
static void collapse_reaches_as_far_elsewhere(void **state)
{
    static const char *const coarse[] = {"spacing=12.5 mm", NULL};
    static const char *const elsewhere[] = {"placement.axis=(1, 2, 3)", "placement.angle=30 deg",
                                            "placement.translation=(1000, -500, 200)", NULL};
    const scene_request request = {MOR_SOURCE_DIR "/cases/column-3d/case.cfg",
                                   (const char *const *[]){coarse, elsewhere}, 1, 1};
    scene_request turned = request;
    turned.n_lists = 2;
    (void)state;
    scene *plain = scene_new(&request);
    scene *placed = scene_new(&turned);
    const double spacing = plain->the_case.spacing;
    assert_int_equal(plain->simulation.soil.set.n_particles, placed->simulation.soil.set.n_particles);
    scene_advance(plain, plain->the_case.end);
    scene_advance(placed, placed->the_case.end);
    const double run_out = scene_probe(plain, "run_out");
    const double tolerance = fmin(0.01 * run_out, 0.1 * spacing); /* statistical: grains end elsewhere, the heap not */
    scene_expect_near("run-out", scene_probe(placed, "run_out"), run_out, tolerance);
    scene_expect_near("energy left", scene_probe(placed, "energy_left"), scene_probe(plain, "energy_left"), 0.003);
    scene_free(placed);
    scene_free(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_soil_is_the_same_after_a_quarter_turn),
        cmocka_unit_test(space_soil_is_the_same_after_quarter_turns),
        cmocka_unit_test(collapse_reaches_as_far_elsewhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
