/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

#include <string.h>

/* Probes of one soil among several, against what the lattice tells: two layers of one material or of two. */

#define LAYER(name, low, high, modulus)                                                                                \
    "{ name = '" name "'; shape = { type = 'box'; min = (0, " low "); max = (1, " high "); }; velocity = (0, " low     \
    ", 0);  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '" modulus                            \
    "'; poissons_ratio = 0.3; }; }"
#define PROBES_OF(soil)                                                                                                \
    "{ name = '" soil "_mass'; type = 'mass'; soil = '" soil "'; },"                                                   \
    "{ name = '" soil "_center'; type = 'center_of_mass'; soil = '" soil "'; direction = (0, 1, 0); },"                \
    "{ name = '" soil "_height'; type = 'height'; soil = '" soil "'; },"                                               \
    "{ name = '" soil "_toe'; type = 'toe'; soil = '" soil "'; origin = (0.2, -1); direction = (1, 0); },"             \
    "{ name = '" soil "_speed'; type = 'largest_speed'; soil = '" soil "'; },"                                         \
    "{ name = '" soil "_energy'; type = 'soil_kinetic_energy'; soil = '" soil "'; },"                                  \
    "{ name = '" soil "_drift'; type = 'density_drift'; soil = '" soil "'; },"                                         \
    "{ name = '" soil "_gap'; type = 'wall_gap'; wall = 'floor'; soil = '" soil "'; }"
#define CASE(lower, upper)                                                                                             \
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, -10, 0);"                                            \
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); }; soil = ( " lower ", " upper " );"                              \
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; } );"        \
    "bodies = ( { name = 'rock'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"                     \
    "  position = (2.5, 1); material = { model = 'rigid'; density = 2400; }; } );"                                     \
    "probes = ( { type = 'mass'; }, { type = 'soil_kinetic_energy'; }, { type = 'toe'; origin = (0.2, -1); "           \
    "}," PROBES_OF("lower") ", " PROBES_OF("upper") " );"

static void expect(scene *it, const char *name, double expected)
{
    scene_expect_near(name, scene_probe(it, name), expected, 1e-12 * (1.0 + fabs(expected))); /* rounding of sums */
}

static void expect_layers(const char *text)
{
    const scene_request request = {.text = text};
    scene *it = scene_new(&request);
    expect(it, "lower_mass", 0.5 * 2000.0);
    expect(it, "upper_mass", 0.3 * 2000.0);
    expect(it, "mass", 0.8 * 2000.0);
    expect(it, "lower_center", 0.25);
    expect(it, "upper_center", 0.65);
    expect(it, "lower_height", 0.5);
    expect(it, "upper_height", 0.8);
    expect(it, "upper_toe", 0.75); /* particles lie half a spacing inside; without the rock */
    expect(it, "toe", 2.45);       /* with it */
    expect(it, "lower_speed", 0.0);
    expect(it, "upper_speed", 0.5);
    expect(it, "lower_energy", 0.0);
    expect(it, "upper_energy", 0.5 * 600.0 * 0.25);
    expect(it, "soil_kinetic_energy", 0.5 * 600.0 * 0.25); /* asked between those of one soil */
    expect(it, "lower_gap", 0.05);
    expect(it, "upper_gap", 0.55);
    mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const int is_upper = set->data[MOR_FIELD_POSITION][3 * i + 1] > 0.5;
        set->data[MOR_FIELD_DENSITY][i] = 2000.0 * (is_upper ? 1.25 : 0.5);
    }
    expect(it, "upper_drift", 0.25);
    expect(it, "lower_drift", 0.5);
    scene_free(it);
}

static void probe_of_one_soil_measures_its_particles_alone(void **state)
{
    (void)state;
    expect_layers(CASE(LAYER("lower", "0", "0.5", "5 MPa"), LAYER("upper", "0.5", "0.8", "5 MPa")));
    expect_layers(CASE(LAYER("lower", "0", "0.5", "5 MPa"), LAYER("upper", "0.5", "0.8", "2 MPa")));
}

static void particles_keep_their_soil_when_sorted(void **state)
{
    (void)state;
    const scene_request request = {
        .text = CASE(LAYER("lower", "0", "0.5", "5 MPa"), LAYER("upper", "0.5", "0.8", "5 MPa")),
        .settings = (const char *const *[]){(const char *[]){"numerics.sort_interval=1", NULL}},
        .n_lists = 1};
    scene *it = scene_new(&request);
    scene_step(it, 20);
    expect(it, "lower_mass", 0.5 * 2000.0);
    expect(it, "upper_mass", 0.3 * 2000.0);
    assert_true(scene_probe(it, "lower_height") < 0.55); /* m: the layers have hardly moved */
    assert_true(scene_probe(it, "upper_gap") > 0.5);
    scene_free(it);
}

/* Of the upper soil no particle is there any more; without a particle there is no distance, however large. */
static void soil_that_has_left_has_no_place(void **state)
{
    static const char *const names[] = {"upper_gap", "upper_height", "upper_center", "upper_speed"};
    (void)state;
    const scene_request request = {
        .text = CASE(LAYER("lower", "0", "0.5", "5 MPa"), LAYER("upper", "0.5", "0.8", "5 MPa"))};
    scene *it = scene_new(&request);
    const mor_soil *soil = &it->simulation.soil;
    memset(soil->set.data[soil->region_field], 0, (size_t)soil->set.n_particles * sizeof(double));
    expect(it, "upper_mass", 0.0);
    expect(it, "lower_mass", 0.8 * 2000.0);
    expect(it, "lower_gap", 0.05);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        assert_true(isnan(scene_probe(it, names[k])));
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(probe_of_one_soil_measures_its_particles_alone),
        cmocka_unit_test(particles_keep_their_soil_when_sorted),
        cmocka_unit_test(soil_that_has_left_has_no_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
