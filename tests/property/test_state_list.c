/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/body_variant.h"

#include <math.h>

/* What owners list as state is all that a run needs: put into a run that went elsewhere, whose scratch is poisoned, it
 * goes on with the same bits. Everything is exact. */

enum { N_BEFORE = 30, N_ELSEWHERE = 47, N_AFTER = 20 };

/* Probes bring the audit of energy and what they remember. */
static const char *const with_probes[] = {
    "probes=({type='plastic_energy';}, {type='energy_balance';}, {type='contact_depth';},"
    "{type='contact_friction_energy'; window=(0.001, 0.02);})",
    NULL};

static char *copy_state(const scene *it)
{
    char *bytes = malloc((size_t)mor_state_bytes(&it->simulation.state));
    assert_non_null(bytes);
    mor_state_store(&it->simulation.state, bytes);
    return bytes;
}

static void follow(scene *it, int n_steps)
{
    for (int k = 0; k < n_steps; ++k) {
        scene_step(it, 1);
        scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    }
}

static void poison(double *numbers, int64_t n)
{
    for (int64_t k = 0; numbers != NULL && k < n; ++k) {
        numbers[k] = NAN;
    }
}

/* Whatever is not listed and does not follow from the case alone. */
static void poison_scratch(mor_simulation *s)
{
    for (int k = 0; k < s->state.n_sets; ++k) {
        mor_set *set = s->state.sets[k];
        for (int field = 0; field < set->n_fields; ++field) {
            if ((set->fields[field].flags & MOR_FIELD_SCRATCH) != 0) {
                poison(set->data[field], set->n_particles * set->fields[field].n_components);
            }
        }
    }
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        mor_body_group *group = s->bodies.groups[g];
        const int64_t n = 3 * group->set.n_particles;
        poison(group->start, n);
        poison(group->begin_velocity, n);
        poison(group->mean_velocity, n);
        poison(group->contact_force, n);
        poison(s->has_soil ? group->boundary.force : NULL, n);
        for (int b = 0; b < group->n_bodies; ++b) {
            poison(group->bodies[b].contact_force, 3);
            poison(group->bodies[b].contact_moment, 3);
            poison(group->bodies[b].center, 3);
            poison(group->bodies[b].velocity, 3);
        }
    }
    s->bodies.contact.spring_energy = NAN;
    s->bodies.contact.deepest = NAN;
    s->soil.gravity[0] = NAN;
}

/* Continues from a state in a run that stands elsewhere; returns all of its state after some steps. */
static char *go_on(scene *it, const char *bytes)
{
    follow(it, N_ELSEWHERE);
    poison_scratch(&it->simulation);
    mor_state_load(&it->simulation.state, bytes);
    scene_require(it, mor_simulation_resume(&it->context, &it->simulation));
    follow(it, N_AFTER);
    return copy_state(it);
}

static scene *open_variant(const char *text, int variant)
{
    return scene_new(
        &(scene_request){text, (const char *const *[]){with_probes, body_variants[variant].settings}, 2, 1});
}

static void check_variant(const char *text, int variant)
{
    scene *whole = open_variant(text, variant);
    scene *other = open_variant(text, variant);
    follow(whole, N_BEFORE);
    char *start = copy_state(whole);
    follow(whole, N_AFTER);
    char *expected = copy_state(whole);
    char *found = go_on(other, start);
    if (memcmp(expected, found, (size_t)mor_state_bytes(&whole->simulation.state)) != 0) {
        fail_msg("'%s': something that evolves is not listed as state", body_variants[variant].name);
    }
    free(start);
    free(expected);
    free(found);
    scene_free(whole);
    scene_free(other);
}

static void the_list_is_all_that_a_run_in_the_plane_needs(void **state)
{
    (void)state;
    for (int k = 0; k < BODY_VARIANTS; ++k) {
        check_variant(body_plane, k);
    }
}

static void the_list_is_all_that_a_run_in_space_needs(void **state)
{
    (void)state;
    check_variant(body_space, 0);
}

/* Some of what is listed, of each owner. */
static const char *const names[] = {"schedule.now",
                                    "schedule.n_steps",
                                    "soil.largest_speed",
                                    "soil.wall_impulse",
                                    "energy_audit.integral",
                                    "energy_audit.next",
                                    "neo_hookean.damped_energy",
                                    "neo_hookean.rotation_angle",
                                    "neo_hookean.seen_velocity",
                                    "rigid.center",
                                    "rigid.quaternion",
                                    "rigid.angular_momentum",
                                    "rigid.seen_velocity",
                                    "rigid.impulse_of_soil",
                                    "contact.friction_energy",
                                    "probes.records"};

/* Puts a state into a run that stands elsewhere, but for one array, which keeps what it has. */
static void load_without(scene *it, const char *bytes, const char *name)
{
    mor_state_list *list = &it->simulation.state;
    mor_state_array *left_out = NULL;
    for (int k = 0; k < list->n_arrays; ++k) {
        left_out = strcmp(list->arrays[k].name, name) == 0 ? &list->arrays[k] : left_out;
    }
    if (left_out == NULL) {
        fail_msg("nobody lists '%s'", name);
    }
    void *data = left_out->data;
    left_out->data = calloc((size_t)(left_out->n_rows * left_out->stride), sizeof(double)); /* somewhere else */
    assert_non_null(left_out->data);
    mor_state_load(list, bytes);
    free(left_out->data);
    left_out->data = data;
}

/* A run that goes on from there may as well fail. */
static bool is_same_after(scene *it, const char *expected)
{
    mor_simulation *s = &it->simulation;
    mor_status status = mor_simulation_resume(&it->context, s);
    for (int k = 0; k < N_AFTER && status == MOR_OK; ++k) {
        status = mor_schedule_step(&it->context, &s->schedule, s->schedule.end);
        status = status == MOR_OK ? mor_probe_follow(&it->context, s) : status;
    }
    char *found = copy_state(it);
    const bool is_same = status == MOR_OK && memcmp(expected, found, (size_t)mor_state_bytes(&s->state)) == 0;
    free(found);
    return is_same;
}

/* The check above finds each of these missing. */
static void a_list_that_misses_something_is_found_out(void **state)
{
    (void)state;
    scene *whole = open_variant(body_plane, 0);
    follow(whole, N_BEFORE);
    char *start = copy_state(whole);
    follow(whole, N_AFTER);
    char *expected = copy_state(whole);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        scene *other = open_variant(body_plane, 0);
        follow(other, N_ELSEWHERE);
        poison_scratch(&other->simulation);
        load_without(other, start, names[k]);
        if (is_same_after(other, expected)) {
            fail_msg("'%s' could be left out of the list", names[k]);
        }
        scene_free(other);
    }
    free(start);
    free(expected);
    scene_free(whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_list_is_all_that_a_run_in_the_plane_needs),
        cmocka_unit_test(the_list_is_all_that_a_run_in_space_needs),
        cmocka_unit_test(a_list_that_misses_something_is_found_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
