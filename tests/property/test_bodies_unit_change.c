/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/body_variant.h"
#include "tests/common/unit_change.h"

/* Soil and rocks in other units of length, time and mass, all even powers of two, must end in the same bits, each
 * number multiplied by the power of two of its unit. All comparisons are exact. */
enum { N_STEPS = 60 };

/* Probes of rocks, contact and coupling; those of soil alone are in test_unit_change.c. */
static const char *const plane_probes[] = {
    "probes=({type='body_position'; body='buried'; direction=(0, 1, 0);}, {type='body_velocity'; body='lower'; "
    "direction=(1, 0, 0);},"
    "{type='body_rotation_angle'; body='upper'; direction=(0, 0, 1);},"
    "{type='body_angular_velocity'; body='hung'; direction=(0, 0, 1);}, {type='body_force_soil'; body='buried'; "
    "direction=(1, 0, 0);},"
    "{type='body_moment_soil'; body='buried'; direction=(0, 0, 1);}, {type='body_force_contact'; body='lower'; "
    "direction=(1, 0, 0);},"
    "{type='body_impulse_soil_given'; body='plow'; direction=(1, 0, 0);}, {type='body_impulse_soil_received'; "
    "body='plow'; direction=(1, 0, 0);},"
    "{type='penetration_depth'; body='hung';}, {type='body_kinetic_energy'; body='hung';},"
    "{type='body_elastic_energy'; body='lower';}, {type='bodies_kinetic_energy';}, {type='bodies_elastic_energy';},"
    "{type='contact_energy';}, {type='contact_friction_energy';}, {type='contact_damping_energy';},"
    "{type='contact_depth';}, {type='wall_contact_force'; wall='floor'; direction=(0, 1, 0);},"
    "{type='wall_impulse'; wall='floor'; direction=(0, 1, 0);}, {type='angular_momentum'; direction=(0, 0, 1);},"
    "{type='rate_ratio';}, {type='total_energy';}, {type='momentum'; direction=(1, 0, 0);},"
    "{type='soil_work_on_bodies';}, {type='external_work';}, {type='energy_balance';})",
    NULL};
static const char *const space_probes[] = {"probes=({type='body_position'; body='ball'; direction=(0, 1, 0);}, "
                                           "{type='body_velocity'; body='block'; direction=(1, 0, 0);},"
                                           "{type='body_moment_soil'; body='ball'; direction=(0, 1, 1);}, "
                                           "{type='body_force_contact'; body='top'; direction=(1, 0, 0);},"
                                           "{type='total_energy';}, {type='angular_momentum'; direction=(1, 2, 3);})",
                                           NULL};

/* Bodies keep their order; soil keeps it as well, since it is sorted by the same rules. */
static void compare_sets(scene *plain, scene *scaled, const mor_units *units, const unit_change *by,
                         const char *variant)
{
    mor_set *a[MOR_BODY_GROUPS_MAX + 2];
    mor_set *b[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(&plain->simulation, true, a);
    assert_int_equal(mor_simulation_sets(&scaled->simulation, true, b), n_sets);
    for (int s = 0; s < n_sets; ++s) {
        for (int field = 0; field < a[s]->n_fields; ++field) {
            if (a[s]->data[field] == NULL || (a[s]->fields[field].flags & MOR_FIELD_EVOLVES) == 0) {
                continue;
            }
            const int power = unit_change_power(plain, units, by, unit_change_field(plain, a[s], field));
            for (int64_t k = 0; k < a[s]->n_particles * a[s]->fields[field].n_components; ++k) {
                unit_change_expect(b[s]->data[field][k], ldexp(a[s]->data[field][k], power), by, variant,
                                   a[s]->fields[field].name, (long long)k);
            }
        }
    }
}

static void check_scene(const char *text, const char *const *probes)
{
    mor_context context;
    mor_units *units = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_units_new(&context, &units), MOR_OK);
    for (int v = 0; v < BODY_VARIANTS; ++v) {
        const char *const *variant = body_variants[v].settings;
        const scene_request request = {text, (const char *const *[]){variant, probes}, 2, 1};
        scene *plain = scene_new(&request);
        scene_step(plain, N_STEPS);
        for (int k = 0; k < UNIT_CHANGES; ++k) {
            const scene_request changed = {text, (const char *const *[]){variant, probes, unit_changes[k].settings}, 3,
                                           1};
            scene *scaled = scene_new(&changed);
            scene_step(scaled, N_STEPS);
            unit_change_compare_time(plain, scaled, &unit_changes[k], body_variants[v].name);
            compare_sets(plain, scaled, units, &unit_changes[k], body_variants[v].name);
            unit_change_compare_probes(plain, scaled, units, &unit_changes[k], body_variants[v].name);
            scene_free(scaled);
        }
        scene_free(plain);
    }
    mor_units_free(&context, &units);
}

static void rocks_in_plane_strain_are_the_same_in_other_units(void **state)
{
    (void)state;
    check_scene(body_plane, plane_probes);
}

static void rocks_in_space_are_the_same_in_other_units(void **state)
{
    (void)state;
    check_scene(body_space, space_probes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rocks_in_plane_strain_are_the_same_in_other_units),
        cmocka_unit_test(rocks_in_space_are_the_same_in_other_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
