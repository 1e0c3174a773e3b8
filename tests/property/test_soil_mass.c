/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene_variant.h"

/* The mass of the soil: particles times density times the cell of each, and not a bit of it changes. */

enum { N_STEPS = 40 }; /* three sorts, four density summations */

static const char *const probed[] = {"probes=({type='mass';})", NULL};

static void check_mass(const char *text, const scene_variant *variant)
{
    const scene_request request = {text, (const char *const *[]){variant->settings, probed}, 2, 1};
    scene *it = scene_new(&request);
    const mor_set *set = &it->simulation.soil.set;
    const int64_t n = set->n_particles;
    const double spacing = it->the_case.spacing;
    const double cell = spacing * spacing * (it->the_case.dimension == 3 ? spacing : 1.0);
    const double expected = (double)n * cell * 2000.0;
    scene_expect_near(variant->name, scene_probe(it, "mass"), expected, 1e-12 * expected); /* rounding of the sum */
    double *before = calloc((size_t)n, sizeof *before);
    assert_non_null(before);
    for (int64_t i = 0; i < n; ++i) {
        before[set->id[i]] = set->data[MOR_FIELD_MASS][i];
    }
    scene_step(it, N_STEPS);
    assert_int_equal(set->n_particles, n);
    for (int64_t i = 0; i < n; ++i) {
        if (memcmp(&before[set->id[i]], &set->data[MOR_FIELD_MASS][i], sizeof *before) != 0) {
            fail_msg("'%s': the mass of particle %lld changes", variant->name, (long long)set->id[i]);
        }
    }
    scene_expect_near(variant->name, scene_probe(it, "mass"), expected, 1e-12 * expected); /* likewise, other order */
    free(before);
    scene_free(it);
}

static void mass_of_the_soil_does_not_change(void **state)
{
    (void)state;
    for (int k = 0; k < SCENE_VARIANTS; ++k) {
        check_mass(scene_plane, &scene_variants[k]);
        check_mass(scene_space, &scene_variants[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_of_the_soil_does_not_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
