/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Probes of the soil at a place, and soil that starts under the same pressure everywhere. */

static const char block[] =
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, 0);"
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (1, 0.6); };"
    "  initial_stress = { type = 'uniform'; pressure = '3 kPa'; };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "probes = ( { name = 'inside'; type = 'soil_velocity'; origin = (0.5, 0.3); direction = (0, 2); },"
    "  { name = 'outside'; type = 'soil_velocity'; origin = (3, 0.3); direction = (0, 1); } );";

static void velocity_is_that_of_the_soil_around(void **state)
{
    (void)state;
    const scene_request request = {.text = block};
    scene *it = scene_new(&request);
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        set->data[MOR_FIELD_VELOCITY][3 * i + 1] = 4.0 + 3.0 * (x[0] - 0.5) - 7.0 * (x[1] - 0.3);
    }
    /* The particles lie evenly around the place, which is a corner of four cells. */
    scene_expect_near("the velocity inside", scene_probe(it, "inside"), 4.0, 1e-12);
    assert_true(isnan(scene_probe(it, "outside"))); /* an expectation of rest is not met by a void */
    scene_free(it);
}

/* Two soils side by side, of different velocity. */
static const char pair[] =
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, 0);"
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); };"
    "soil = ( { name = 'left'; shape = { type = 'box'; min = (0, 0); max = (1, 0.6); }; velocity = (0, 5);"
    "    material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; },"
    "  { name = 'right'; shape = { type = 'box'; min = (1, 0); max = (2, 0.6); }; velocity = (0, -2);"
    "    material = { model = 'hypoelastic'; density = 1000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "probes = ( { name = 'both'; type = 'soil_velocity'; origin = (1, 0.3); direction = (0, 1); },"
    "  { name = 'left'; type = 'soil_velocity'; soil = 'left'; origin = (1, 0.3); direction = (0, 1); },"
    "  { name = 'right'; type = 'soil_velocity'; soil = 'right'; origin = (1, 0.3); direction = (0, 1); },"
    "  { name = 'none'; type = 'soil_velocity'; soil = 'right'; origin = (0.5, 0.3); direction = (0, 1); } );";

static void velocity_is_that_of_one_soil_if_named(void **state)
{
    (void)state;
    const scene_request request = {.text = pair};
    scene *it = scene_new(&request);
    scene_expect_near("the velocity at the interface", scene_probe(it, "both"), 1.5, 1e-12); /* as many of each */
    scene_expect_near("that of the left soil", scene_probe(it, "left"), 5.0, 1e-12);
    scene_expect_near("that of the right soil", scene_probe(it, "right"), -2.0, 1e-12);
    assert_true(isnan(scene_probe(it, "none")));
    scene_free(it);
}

/* Two soils, one on the other, under gravity. */
static const char layers[] =
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, -10, 0);"
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); };"
    "soil = ( { name = 'below'; shape = { type = 'box'; min = (0, 0); max = (2, 1); };"
    "    initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"
    "    material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; },"
    "  { name = 'above'; shape = { type = 'box'; min = (0, 1); max = (2, 2); };"
    "    initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"
    "    material = { model = 'hypoelastic'; density = 1500; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "probes = ( { name = 'vertical'; type = 'soil_stress'; origin = (1, 0.5); direction = (0, 3); },"
    "  { name = 'lateral'; type = 'soil_stress'; origin = (1, 0.5); direction = (1, 0); },"
    "  { name = 'slanted'; type = 'soil_stress'; origin = (1, 0.5); direction = (1, 1); },"
    "  { name = 'above'; type = 'soil_stress'; soil = 'above'; origin = (1, 1.5); direction = (0, 1); },"
    "  { name = 'top'; type = 'soil_stress'; soil = 'above'; origin = (1, 1); direction = (0, 1); },"
    "  { name = 'bottom'; type = 'soil_stress'; soil = 'below'; origin = (1, 1); direction = (0, 1); },"
    "  { name = 'none'; type = 'soil_stress'; soil = 'above'; origin = (1, 0.5); direction = (0, 1); } );";

/* rho g h: 1 m of 1500 kg/m3, then 0.5 m of 2000 kg/m3. The stress is linear around the places, which are corners of
 * four cells, so that its mean is the one there. */
static void stress_is_the_weight_of_the_soils_above(void **state)
{
    (void)state;
    const scene_request request = {.text = layers};
    scene *it = scene_new(&request);
    scene_expect_near("the vertical stress", scene_probe(it, "vertical"), -25000.0, 1e-7); /* rounding of 1e4 Pa */
    scene_expect_near("the lateral stress", scene_probe(it, "lateral"), -12500.0, 1e-7);
    scene_expect_near("the stress on a slanted plane", scene_probe(it, "slanted"), -18750.0, 1e-7);
    scene_expect_near("that of the upper soil", scene_probe(it, "above"), -7500.0, 1e-7);
    /* Only the particles on one side, within two spacings of the interface, where the stress is 15000 Pa. */
    assert_in_range((int)-scene_probe(it, "top"), 12000, 14250);
    assert_in_range((int)-scene_probe(it, "bottom"), 16000, 19000);
    assert_true(isnan(scene_probe(it, "none")));
    scene_free(it);
}

static void uniform_stress_is_a_pressure_without_gravity(void **state)
{
    (void)state;
    const scene_request request = {.text = block};
    scene *it = scene_new(&request);
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t k = 0; k < 6 * set->n_particles; ++k) {
        assert_true(set->data[MOR_FIELD_STRESS][k] == (k % 6 < 3 ? -3000.0 : 0.0)); /* exact */
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocity_is_that_of_the_soil_around),
        cmocka_unit_test(velocity_is_that_of_one_soil_if_named),
        cmocka_unit_test(stress_is_the_weight_of_the_soils_above),
        cmocka_unit_test(uniform_stress_is_a_pressure_without_gravity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
