/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/units.h"
#include "tests/common/scene_variant.h"

#include <math.h>

/* A case in other units of length, time and mass, all even powers of two, must take the same steps and end in the same
 * bits, each number multiplied by the power of two of its unit. A term with a wrong dimension, an absolute threshold or
 * a constant with a hidden unit breaks that. All comparisons are exact. */
enum { N_STEPS = 200 };

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

/* One probe of each type, so that results are compared as well as fields. */
static const char *const probes[] = {
    "probes=({type='run_out'; percentile=90.0;}, {name='by_thickness'; type='run_out'; measure='thickness';},"
    "{type='front_speed';}, {type='height';}, {type='repose_angle';}, {type='stray_share';}, {type='kinetic_energy';},"
    "{type='potential_energy';}, {type='elastic_energy';}, {type='total_energy';}, {type='energy_left';},"
    "{type='dissipated_energy';}, {type='mass';}, {type='momentum'; direction=(1, 2, 0);},"
    "{type='center_of_mass'; direction=(0, 1, 0);}, {type='wall_force'; wall='floor'; direction=(0, 1, 0);},"
    "{type='largest_speed';}, {type='density_drift';}, {type='stress_error';}, {type='stress_ratio';},"
    "{type='stress_noise';})",
    NULL};

/* Power of two that a number of this unit gets. */
static int find_power(scene *it, const mor_units *units, const change *by, const char *unit)
{
    mor_dimension dimension;
    scene_require(it, mor_units_dimension(&it->context, units, unit, &dimension));
    return mor_dimension_scale(&dimension, by->length, by->mass, by->time);
}

/* In plane strain a particle's mass is per meter of thickness. */
static const char *find_unit(const scene *it, int field)
{
    return field == MOR_FIELD_MASS && it->the_case.dimension == 2 ? "kg/m" : it->simulation.soil.set.fields[field].unit;
}

static bool has_same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* Steps are as long as speeds and accelerations allow: the first thing to go wrong. */
static void compare_time(const scene *plain, const scene *scaled, const change *by, const char *name)
{
    const double expected = ldexp(mor_schedule_time(&plain->simulation.schedule), by->time);
    const double found = mor_schedule_time(&scaled->simulation.schedule);
    if (!has_same_bits(expected, found)) {
        fail_msg("'%s', %s %s %s: after %d steps the time is %.17g s, not %.17g s", name, by->settings[0],
                 by->settings[1], by->settings[2], N_STEPS, found, expected);
    }
}

static void compare_fields(scene *plain, scene *scaled, const mor_units *units, const change *by, const char *name)
{
    const mor_set *a = &plain->simulation.soil.set;
    const mor_set *b = &scaled->simulation.soil.set;
    const int32_t *place_a = scene_find_places(plain);
    const int32_t *place_b = scene_find_places(scaled);
    for (int field = 0; field < a->n_fields; ++field) {
        if (a->data[field] == NULL || (a->fields[field].flags & MOR_FIELD_EVOLVES) == 0) {
            continue;
        }
        const int power = find_power(plain, units, by, find_unit(plain, field));
        const int n = a->fields[field].n_components;
        for (int64_t id = 0; id < a->n_particles; ++id) {
            for (int k = 0; k < n; ++k) {
                const double expected = ldexp(a->data[field][place_a[id] * n + k], power);
                const double found = b->data[field][place_b[id] * n + k];
                if (!has_same_bits(expected, found)) {
                    fail_msg("'%s', %s %s %s: %s[%d] of particle %lld is %.17g, not %.17g", name, by->settings[0],
                             by->settings[1], by->settings[2], a->fields[field].name, k, (long long)id, found,
                             expected);
                }
            }
        }
    }
}

static void compare_probes(scene *plain, scene *scaled, const mor_units *units, const change *by, const char *name)
{
    for (int k = 0; k < plain->the_case.n_probes; ++k) {
        const char *probe = plain->the_case.probes[k].name;
        const int power = find_power(plain, units, by, mor_probe_unit(&plain->the_case, k));
        const double expected = ldexp(scene_probe(plain, probe), power);
        const double found = scene_probe(scaled, probe);
        if (!has_same_bits(expected, found) && !(isnan(expected) && isnan(found))) {
            fail_msg("'%s', %s %s %s: probe %s gives %.17g, not %.17g", name, by->settings[0], by->settings[1],
                     by->settings[2], probe, found, expected);
        }
    }
}

static void check_variant(const char *text, const scene_variant *variant, const mor_units *units)
{
    const scene_request request = {text, (const char *const *[]){variant->settings, probes}, 2, 1};
    scene *plain = scene_new(&request);
    scene_step(plain, N_STEPS);
    for (int k = 0; k < N_CHANGES; ++k) {
        const scene_request changed = {text, (const char *const *[]){variant->settings, probes, changes[k].settings}, 3,
                                       1};
        scene *scaled = scene_new(&changed);
        scene_step(scaled, N_STEPS);
        compare_time(plain, scaled, &changes[k], variant->name);
        compare_fields(plain, scaled, units, &changes[k], variant->name);
        compare_probes(plain, scaled, units, &changes[k], variant->name);
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
