/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil whose stiffness grows with its stress: steps follow it (docs/theory/time.md). */
#include "tests/common/scene.h"

/* Sand at a pressure of 1 MPa between smooth walls, in which a wave runs to and fro. Dissipation is made for 20 kPa. */
static const char sand[] =
    "dimension = 2; spacing = '20 mm'; gravity = (0, 0, 0); end = '0.03 s';"
    "domain = { min = (-0.1, -0.1, -1); max = (0.5, 0.5, 1); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.4, 0.4); };"
    "  material = { model = 'hypoplastic_sand'; density = '1600 kg/m3'; critical_friction_angle = '30 deg';"
    "    granulate_hardness = '2.6 GPa'; exponent = 0.27; densest_void_ratio = 0.61; critical_void_ratio = 0.98;"
    "    loosest_void_ratio = 1.1; alpha = 0.18; beta = 1.1; void_ratio = 0.75; wave_pressure = '20 kPa'; };"
    "  velocity_formula = ( '0.02*sin(3.14159265*x/0.4)', '0' );"
    "  initial_stress = { type = 'formula'; formula = ( '-1e6', '-1e6', '-1e6', '0' ); }; } );"
    "walls = ( { name = 'box'; friction = 'smooth'; shape = { type = 'difference';"
    "    from = { type = 'box'; min = (-0.1, -0.1, -1); max = (0.5, 0.5, 1); };"
    "    minus = { type = 'box'; min = (0, 0, -2); max = (0.4, 0.4, 2); }; }; } );"
    "probes = ( { type = 'kinetic_energy'; } );";

/* With the step of soil at 20 kPa, four times as long, it had 13 times of its kinetic energy after 0.025 s. */
static void waves_in_sand_under_pressure_gain_no_energy(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = sand});
    const double start = scene_probe(it, "kinetic_energy");
    assert_true(start > 0.02);
    for (int k = 1; k <= 30; ++k) {
        scene_advance(it, 0.001 * k);
        assert_true(scene_probe(it, "kinetic_energy") < start);
    }
    assert_true(scene_probe(it, "kinetic_energy") < 0.5 * start); /* a law with plastic strain from the start */
    scene_free(it);
}

static double find_step(const char *const *settings)
{
    double step = 0.0;
    const char *limit = NULL;
    scene *it = scene_new(&(scene_request){sand, (const char *const *[]){settings}, 1, 1});
    mor_stepper stepper;
    uint64_t evolving = 0;
    mor_soil_stepper(&it->simulation.soil, &stepper, &evolving);
    scene_require(it, stepper.operations->propose(&it->context, stepper.owner, &step, &limit));
    const bool is_by_stress = strcmp(limit, "the speed of sound in the soil under its stress") == 0;
    assert_int_equal(is_by_stress, settings[0] == NULL);
    scene_free(it);
    return step;
}

/* Whether the pressure of the soil or the one that the user tells is the larger: the step is that of the larger. */
static void steps_are_those_of_the_pressure_in_the_soil(void **state)
{
    (void)state;
    const double by_soil = find_step((const char *[]){NULL});
    const double by_user = find_step((const char *[]){"soil[0].material.wave_pressure='1 MPa'", NULL});
    scene_expect_near("step", by_soil, by_user, 1e-9 * by_user); /* rounding of the density under that pressure */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_in_sand_under_pressure_gain_no_energy),
        cmocka_unit_test(steps_are_those_of_the_pressure_in_the_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
