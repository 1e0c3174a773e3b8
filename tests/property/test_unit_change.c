/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene_variant.h"
#include "tests/common/unit_change.h"

/* A case in other units of length, time and mass, all even powers of two, must take the same steps and end in the same
 * bits, each number multiplied by the power of two of its unit. A term with a wrong dimension, an absolute threshold or
 * a constant with a hidden unit breaks that. All comparisons are exact. */
enum { N_STEPS = 200 };

/* One probe of each type, so that results are compared as well as fields. */
static const char *const probes[] = {
    "probes=({type='run_out'; percentile=90.0;}, {name='by_thickness'; type='run_out'; measure='thickness';},"
    "{type='front_speed';}, {type='height';}, {type='repose_angle';}, {type='stray_share';}, {type='kinetic_energy';},"
    "{type='potential_energy';}, {type='elastic_energy';}, {type='total_energy';}, {type='energy_left';},"
    "{type='dissipated_energy';}, {type='mass';}, {type='momentum'; direction=(1, 2, 0);},"
    "{type='center_of_mass'; direction=(0, 1, 0);}, {type='wall_force'; wall='floor'; direction=(0, 1, 0);},"
    "{type='largest_speed';}, {type='density_drift';}, {type='stress_error';}, {type='stress_ratio';},"
    "{type='stress_noise';}, {type='plastic_energy';}, {type='boundary_dissipation';}, "
    "{type='friction_strain_energy';},"
    "{type='numerical_dissipation';}, {type='riemann_energy';}, {type='artificial_stress_energy';},"
    "{type='stress_diffusion_energy';}, {type='external_work';}, {type='energy_balance';})",
    NULL};

static void compare_fields(scene *plain, scene *scaled, const mor_units *units, const unit_change *by, const char *name)
{
    const mor_set *a = &plain->simulation.soil.set;
    const mor_set *b = &scaled->simulation.soil.set;
    const int32_t *place_a = scene_find_places(plain);
    const int32_t *place_b = scene_find_places(scaled);
    for (int field = 0; field < a->n_fields; ++field) {
        if (a->data[field] == NULL || (a->fields[field].flags & MOR_FIELD_EVOLVES) == 0) {
            continue;
        }
        const int power = unit_change_power(plain, units, by, unit_change_field(plain, a, field));
        const int n = a->fields[field].n_components;
        for (int64_t id = 0; id < a->n_particles; ++id) {
            for (int k = 0; k < n; ++k) {
                const double expected = ldexp(a->data[field][place_a[id] * n + k], power);
                const double found = b->data[field][place_b[id] * n + k];
                unit_change_expect(found, expected, by, name, a->fields[field].name, (long long)id);
            }
        }
    }
}

static void check_variant(const char *text, const scene_variant *variant, const mor_units *units)
{
    const scene_request request = {text, (const char *const *[]){variant->settings, probes}, 2, 1};
    scene *plain = scene_new(&request);
    scene_step(plain, N_STEPS);
    for (int k = 0; k < UNIT_CHANGES; ++k) {
        const scene_request changed = {
            text, (const char *const *[]){variant->settings, probes, unit_changes[k].settings}, 3, 1};
        scene *scaled = scene_new(&changed);
        scene_step(scaled, N_STEPS);
        unit_change_compare_time(plain, scaled, &unit_changes[k], variant->name);
        compare_fields(plain, scaled, units, &unit_changes[k], variant->name);
        unit_change_compare_probes(plain, scaled, units, &unit_changes[k], variant->name);
        scene_free(scaled);
    }
    scene_free(plain);
}

static void check_scene(const char *text)
{
    mor_context context;
    mor_units *units = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_units_new(&context, &units), MOR_OK);
    for (int k = 0; k < SCENE_VARIANTS; ++k) {
        check_variant(text, &scene_variants[k], units);
    }
    mor_units_free(&context, &units);
}

static void plane_soil_is_the_same_in_other_units(void **state)
{
    (void)state;
    check_scene(scene_plane);
}

static void space_soil_is_the_same_in_other_units(void **state)
{
    (void)state;
    check_scene(scene_space);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plane_soil_is_the_same_in_other_units),
        cmocka_unit_test(space_soil_is_the_same_in_other_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
