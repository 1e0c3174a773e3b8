/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil whose stiffness grows with its stress: steps follow it (docs/theory/time.md). */
#include "cases/driver/scene/check/simulation_warnings.h"
#include "cases/driver/scene/check/soil_stiffness.h"
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

/* Speed of a sand at 20 kPa, whatever its stress. */
static mor_status tell_one_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = 150.0;
    }
    return MOR_OK;
}

static void keep_text(void *user, mor_log_level level, const char *text)
{
    char *kept = user;
    if (level == MOR_LOG_WARNING) {
        snprintf(kept, MOR_CONTEXT_MESSAGE_BYTES, "%s", text);
    }
}

/* What a law does tells how stiff it is, where its own word does not. */
static void stiffness_that_a_law_does_not_tell_is_warned_of(void **state)
{
    (void)state;
    char text[MOR_CONTEXT_MESSAGE_BYTES] = "";
    mor_soil_stiffness found;
    scene *it = scene_new(&(scene_request){.text = sand});
    mor_soil *soil = &it->simulation.soil;
    mor_soil_stiffness_find(soil, &found);
    assert_true(found.measured > 500.0 && found.measured <= 1.001 * found.told); /* K of strains of 2e-6 */
    const mor_material_instance *law = soil->material;
    mor_material_instance silent = *law;
    silent.operations.wave_speed = tell_one_speed;
    soil->material = &silent;
    it->context.log_sink = keep_text;
    it->context.log_user = text;
    mor_simulation_warn_of_stiffening(&it->context, &it->simulation, "");
    mor_soil_stiffness silently = {0};
    mor_soil_stiffness_find(soil, &silently);
    soil->material = law;
    assert_true(silently.measured == found.measured);
    assert_non_null(strstr(text, "becomes stiffer than the wave speed that it tells"));
    scene_free(it);
}

static void stiffness_of_a_law_that_keeps_it_is_what_it_tells(void **state)
{
    (void)state;
    static const char *const block[] = {"soil[0].material={model='mohr_coulomb'; density=1600; youngs_modulus=4e6; "
                                        "poissons_ratio=0.3; friction_angle=0.5;}",
                                        NULL};
    mor_soil_stiffness found;
    scene *it = scene_new(&(scene_request){sand, (const char *const *[]){block}, 1, 1});
    mor_soil_stiffness_find(&it->simulation.soil, &found);
    assert_true(found.ratio == 1.0);
    scene_expect_near("speed", found.measured, found.told, 1e-5 * found.told); /* strains of 2e-6 */
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_in_sand_under_pressure_gain_no_energy),
        cmocka_unit_test(stiffness_that_a_law_does_not_tell_is_warned_of),
        cmocka_unit_test(stiffness_of_a_law_that_keeps_it_is_what_it_tells),
        cmocka_unit_test(steps_are_those_of_the_pressure_in_the_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
