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

/* A speed far below that of sand at 1 MPa, whatever its stress. */
static mor_status declare_one_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
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

/* Warns of a scene whose soil is of another law, but with the same state; the text of the warning, empty for none. */
static void warn_with(scene *it, const mor_material_instance *law, char *text)
{
    const mor_material_instance *own = it->simulation.soil.material;
    text[0] = '\0';
    it->context.log_sink = keep_text;
    it->context.log_user = text;
    it->simulation.soil.material = law;
    mor_simulation_warn_of_stiffening(&it->context, &it->simulation, "");
    it->simulation.soil.material = own;
}

static void stiffness_that_a_law_does_not_declare_is_warned_of(void **state)
{
    (void)state;
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    scene *it = scene_new(&(scene_request){.text = sand});
    const mor_material_instance *law = it->simulation.soil.material;
    mor_material_instance silent = *law;
    silent.operations.wave_speed = declare_one_speed;
    warn_with(it, &silent, text);
    assert_non_null(strstr(text, "is stiffer than the wave speed that it declares"));
    mor_material undeclared = *law->material;
    mor_material_instance other = *law;
    undeclared.capabilities &= ~(unsigned)MOR_MATERIAL_STIFFENS;
    other.material = &undeclared;
    warn_with(it, &other, text);
    assert_non_null(strstr(text, "does not declare the capability MOR_MATERIAL_STIFFENS"));
    warn_with(it, law, text);
    assert_null(strstr(text, "as the time step assumes"));
    scene_free(it);
}

/* Strains of 2e-6: K of laws whose stiffness stays is that of their parameters, of others to a part of it. */
static void measured_speed_is_the_declared_one(void **state)
{
    (void)state;
    static const char *const laws[][2] = {
        {NULL, NULL},
        {"soil[0].material.elastic_range=0", NULL}, /* without intergranular strain: softer in compression */
        {"soil[0].material={model='mohr_coulomb'; density=1600; youngs_modulus=4e6; poissons_ratio=0.3; "
         "friction_angle=0.5;}",
         NULL},
        {"soil[0].material={model='drucker_prager'; density=1600; youngs_modulus=4e6; poissons_ratio=0.3; "
         "friction_angle=0.7; dilation_angle=0.3;}",
         NULL},
        {"soil[0].material={model='modified_cam_clay'; density=1600; compression_index=0.1; "
         "swelling_index=0.02; friction_angle=0.5; "
         "shear_modulus=5e6; void_ratio=0.8; preconsolidation=1e5;}",
         NULL}};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; ++k) {
        mor_soil_stiffness found;
        scene *it = scene_new(&(scene_request){sand, (const char *const *[]){laws[k]}, 1, 1});
        mor_soil_stiffness_find(&it->simulation.soil, &found);
        if (!(found.measured > 0.9 * found.declared && found.measured < 1.001 * found.declared)) {
            fail_msg("law %zu: %.9g m/s measured, %.9g declared", k, found.measured, found.declared);
        }
        scene_free(it);
    }
}

/* A stress outside of what the law admits returns to it without any strain: that is no stiffness. */
static void stress_that_returns_is_no_stiffness(void **state)
{
    (void)state;
    static const char *const dilatant[] = {"soil[0].material={model='drucker_prager'; density=1600; "
                                           "youngs_modulus=4e6; poissons_ratio=0.3; friction_angle=0.7; "
                                           "dilation_angle=0.3;}",
                                           NULL};
    mor_soil_stiffness found;
    scene *it = scene_new(&(scene_request){sand, (const char *const *[]){dilatant}, 1, 1});
    mor_soil *soil = &it->simulation.soil;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        soil->set.data[MOR_FIELD_STRESS][6 * i] *= 20.0;
    }
    mor_soil_stiffness_find(soil, &found);
    assert_true(found.measured > 0.5 * found.declared && found.measured < 1.001 * found.declared);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_in_sand_under_pressure_gain_no_energy),
        cmocka_unit_test(stiffness_that_a_law_does_not_declare_is_warned_of),
        cmocka_unit_test(measured_speed_is_the_declared_one),
        cmocka_unit_test(stress_that_returns_is_no_stiffness),
        cmocka_unit_test(steps_are_those_of_the_pressure_in_the_soil),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
