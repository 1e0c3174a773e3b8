/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/units.h"
#include "tests/common/body_variant.h"

#include <math.h>

/* Soil and rocks in other units of length, time and mass, all even powers of two, must end in the same bits, each
 * number multiplied by the power of two of its unit. All comparisons are exact. */
enum { N_STEPS = 60 };

/* Powers of two of the units. */
typedef struct change {
    int length, mass, time;
    const char *settings[4];
} change;

static const change changes[] = {
    {6, 2, 4, {"scale.length=64", "scale.mass=4", "scale.time=16", NULL}},
    {-2, 4, -4, {"scale.length=0.25", "scale.mass=16", "scale.time=0.0625", NULL}},
};

enum { N_CHANGES = sizeof changes / sizeof *changes };

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
    "{type='rate_ratio';}, {type='total_energy';}, {type='momentum'; direction=(1, 0, 0);})",
    NULL};
static const char *const space_probes[] = {"probes=({type='body_position'; body='ball'; direction=(0, 1, 0);}, "
                                           "{type='body_velocity'; body='block'; direction=(1, 0, 0);},"
                                           "{type='body_moment_soil'; body='ball'; direction=(0, 1, 1);}, "
                                           "{type='body_force_contact'; body='top'; direction=(1, 0, 0);},"
                                           "{type='total_energy';}, {type='angular_momentum'; direction=(1, 2, 3);})",
                                           NULL};

static int find_power(scene *it, const mor_units *units, const change *by, const char *unit)
{
    mor_dimension dimension;
    scene_require(it, mor_units_dimension(&it->context, units, unit, &dimension));
    return mor_dimension_scale(&dimension, by->length, by->mass, by->time);
}

static bool has_same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void require_same(double found, double expected, const change *by, const char *variant, const char *what,
                         long long place)
{
    if (!has_same_bits(found, expected) && !(isnan(found) && isnan(expected))) {
        fail_msg("'%s', %s %s %s: %s %lld is %.17g, not %.17g", variant, by->settings[0], by->settings[1],
                 by->settings[2], what, place, found, expected);
    }
}

/* Bodies keep their order; soil keeps it as well, since it is sorted by the same rules. */
static void compare_sets(scene *plain, scene *scaled, const mor_units *units, const change *by, const char *variant)
{
    mor_set *a[MOR_BODY_GROUPS_MAX + 2];
    mor_set *b[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(&plain->simulation, true, a);
    assert_int_equal(mor_simulation_sets(&scaled->simulation, true, b), n_sets);
    for (int s = 0; s < n_sets; ++s) {
        for (int field = 0; field < a[s]->n_fields; ++field) {
            const bool is_mass_in_plane = field == MOR_FIELD_MASS && plain->the_case.dimension == 2;
            const char *unit = is_mass_in_plane ? "kg/m" : a[s]->fields[field].unit;
            if (a[s]->data[field] == NULL || (a[s]->fields[field].flags & MOR_FIELD_EVOLVES) == 0) {
                continue;
            }
            const int power = find_power(plain, units, by, unit);
            for (int64_t k = 0; k < a[s]->n_particles * a[s]->fields[field].n_components; ++k) {
                require_same(b[s]->data[field][k], ldexp(a[s]->data[field][k], power), by, variant,
                             a[s]->fields[field].name, (long long)k);
            }
        }
    }
}

static void compare_probes(scene *plain, scene *scaled, const mor_units *units, const change *by, const char *variant)
{
    for (int k = 0; k < plain->the_case.n_probes; ++k) {
        const char *probe = plain->the_case.probes[k].name;
        const int power = find_power(plain, units, by, mor_probe_unit(&plain->the_case, k));
        require_same(scene_probe(scaled, probe), ldexp(scene_probe(plain, probe), power), by, variant, probe, 0);
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
        for (int k = 0; k < N_CHANGES; ++k) {
            const scene_request changed = {text, (const char *const *[]){variant, probes, changes[k].settings}, 3, 1};
            scene *scaled = scene_new(&changed);
            scene_step(scaled, N_STEPS);
            require_same(mor_schedule_time(&scaled->simulation.schedule),
                         ldexp(mor_schedule_time(&plain->simulation.schedule), changes[k].time), &changes[k],
                         body_variants[v].name, "time", 0);
            compare_sets(plain, scaled, units, &changes[k], body_variants[v].name);
            compare_probes(plain, scaled, units, &changes[k], body_variants[v].name);
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
