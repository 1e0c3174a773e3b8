/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/probe/probe_measure.h"
#include "core/base/units.h"
#include "core/material/params.h"
#include "materials/builtin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { GROUPS_MAX = 48 };

typedef struct fixture {
    mor_context context;
    mor_units *units;
    mor_registry *registry;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    if (f == NULL) {
        return 1;
    }
    *state = f;
    mor_context_init(&f->context);
    return mor_units_new(&f->context, &f->units) != MOR_OK || mor_registry_new(&f->context, &f->registry) != MOR_OK ||
           mor_registry_add_list(&f->context, f->registry, mor_materials_builtin(NULL)) != MOR_OK;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    mor_registry_free(&f->context, &f->registry);
    mor_units_free(&f->context, &f->units);
    const int is_leaking = f->context.memory_bytes != 0;
    free(f);
    return is_leaking;
}

static size_t stored_bytes(const mor_case_key *key)
{
    switch (key->storage) {
    case MOR_CASE_STORE_REALS:
        return sizeof(double) * (size_t)key->schema.n_components;
    case MOR_CASE_STORE_INT:
    case MOR_CASE_STORE_CHOICE:
        return sizeof(int);
    case MOR_CASE_STORE_SEED:
        return sizeof(uint64_t);
    case MOR_CASE_STORE_BOOL:
        return sizeof(bool);
    case MOR_CASE_STORE_TEXT:
    case MOR_CASE_STORE_NAME:
    case MOR_CASE_STORE_WORD:
        break;
    }
    return key->size > 16 ? key->size : 0;
}

static void check_table(fixture *f, const mor_case_group *group)
{
    mor_dimension dimension;
    int n_keys = 0;
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        const mor_schema *s = &key->schema;
        const bool is_sound =
            stored_bytes(key) == key->size && s->text != NULL && s->minimum <= s->maximum &&
            mor_case_key_find(group->keys, s->key) == n_keys &&
            mor_units_dimension(&f->context, f->units, s->unit, &dimension) == MOR_OK &&
            mor_units_dimension(&f->context, f->units, mor_case_key_schema(key, 2).unit, &dimension) == MOR_OK &&
            (key->storage != MOR_CASE_STORE_BOOL || s->choices == NULL || mor_params_choice(s->choices, NULL) == 2) &&
            (s->is_required || key->computed != NULL || s->kind == MOR_SCHEMA_TEXT ||
             (s->default_value >= s->minimum && s->default_value <= s->maximum)) &&
            (s->kind == MOR_SCHEMA_CHOICE) == (s->choices != NULL);
        if (!is_sound) {
            fail_msg("the entry '%s' of '%s' is not sound", s->key, group->name);
        }
        ++n_keys;
    }
    assert_true(n_keys <= 64); /* exact: bits of the mask */
}

static int list_groups(const mor_case_group **groups)
{
    static const mor_case_group *const single[] = {
        &mor_case_root_group,          &mor_case_soil_group,     &mor_case_material_group,    &mor_case_stress_group,
        &mor_case_wall_group,          &mor_case_probe_group,    &mor_case_expectation_group, &mor_case_body_group,
        &mor_case_body_material_group, &mor_case_spring_group,   &mor_case_start_group,       &mor_case_contact_group,
        &mor_case_pair_group,          &mor_case_friction_group, &mor_case_maps_group,        &mor_case_gauge_group};
    int n = 0;
    for (size_t k = 0; k < sizeof single / sizeof single[0]; ++k) {
        groups[n++] = single[k];
    }
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        groups[n++] = group;
    }
    for (int k = 0; k < MOR_CASE_SHAPE_COUNT; ++k) {
        groups[n++] = &mor_case_shape_groups[k];
    }
    return n;
}

static void the_tables_are_sound(void **state)
{
    fixture *f = *state;
    const mor_case_group *groups[GROUPS_MAX];
    mor_dimension dimension;
    const int n_groups = list_groups(groups);
    for (int k = 0; k < n_groups; ++k) {
        check_table(f, groups[k]);
    }
    const mor_case_probe_type *type = NULL;
    for (int n = 0; (type = mor_probe_type_at(n)) != NULL; ++n) {
        assert_int_equal(mor_units_dimension(&f->context, f->units, type->unit, &dimension), MOR_OK);
        assert_int_equal(mor_units_dimension(&f->context, f->units, type->unit_plane, &dimension), MOR_OK);
        assert_int_equal(type->required & ~type->allowed, 0);
        assert_int_equal(mor_case_probe_required(type, 3), type->required);
        const bool is_free_of_axis = (mor_case_probe_required(type, 2) & MOR_CASE_PROBE_DIRECTION) == 0;
        assert_true((type->traits & MOR_CASE_PROBE_OF_ROTATION) == 0 || is_free_of_axis);
        /* What is recorded from the start on cannot begin later. */
        const mor_probe_measure *measure = (const mor_probe_measure *)type;
        const bool looks_back = measure->past != NULL || measure->remember != NULL;
        assert_int_equal((type->traits & MOR_CASE_PROBE_OF_PAST) != 0, looks_back);
        /* A key that names a body or a wall is never left open. */
        const unsigned named = MOR_CASE_PROBE_BODY | MOR_CASE_PROBE_WALL;
        assert_int_equal(type->allowed & named, type->required & named);
        assert_true((type->allowed & MOR_CASE_PROBE_BODY) == 0 || (type->traits & MOR_CASE_PROBE_OF_BODIES) != 0);
        assert_ptr_equal(mor_case_probe_type_find(mor_probe_type_at, type->name), type);
    }
    for (int k = 0; mor_case_probe_key_names[k] != NULL; ++k) {
        bool is_known = mor_case_key_find(mor_case_probe_group.keys, mor_case_probe_key_names[k]) >= 0;
        for (const mor_case_part *part = mor_case_probe_group.parts; part->name != NULL; ++part) {
            is_known = is_known || strcmp(part->name, mor_case_probe_key_names[k]) == 0;
        }
        assert_true(is_known);
    }
}

/* Each condition must be about a name that the tables have, and hold for every kind it says. */
static void conditions_of_bodies_name_what_the_tables_have(void **state)
{
    static const char *const names[] = {"motion", "locked", "spring", "clamp", "start"};
    static const struct {
        const char *model;
        bool is_prescribed;
        bool has[5]; /* in the order of names */
    } kinds[] = {{"rigid", false, {true, true, true, false, false}},
                 {"rigid", true, {true, false, false, false, false}},
                 {"neo_hookean", false, {false, false, false, true, true}}};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; ++k) {
        mor_case_body body = {.is_prescribed = kinds[k].is_prescribed};
        snprintf(body.model, sizeof body.model, "%s", kinds[k].model);
        for (size_t n = 0; n < sizeof names / sizeof names[0]; ++n) {
            assert_int_equal(mor_case_body_condition(&body, names[n]) == NULL, kinds[k].has[n]);
        }
        assert_null(mor_case_body_condition(&body, "velocity"));
    }
    for (const mor_case_key *key = mor_case_start_group.keys; key->schema.key != NULL; ++key) {
        const bool is_type = strcmp(key->schema.key, "type") == 0;
        assert_int_equal(mor_case_start_condition(MOR_CASE_MOTION_UNIFORM, key->schema.key) == NULL, is_type);
    }
}

static void the_printed_reference_names_every_key(void **state)
{
    fixture *f = *state;
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    mor_case_schema_print(f->registry, mor_probe_type_at, stream);
    assert_int_equal(fclose(stream), 0);
    const mor_case_group *groups[GROUPS_MAX];
    const int n_groups = list_groups(groups);
    for (int g = 0; g < n_groups; ++g) {
        for (const mor_case_key *key = groups[g]->keys; key->schema.key != NULL; ++key) {
            char row[128];
            snprintf(row, sizeof row, "\n| `%s` | ", key->schema.key);
            assert_non_null(strstr(text, row));
        }
    }
    assert_non_null(strstr(text, "`drucker_prager`"));
    assert_non_null(strstr(text, "\n| `youngs_modulus` | number | Pa | **required** | > 0 |"));
    assert_non_null(strstr(text, "\n| `wall_dissipation` | word |  | separation | separation, approach, both |"));
    assert_non_null(strstr(text, "\n| `kinetic_energy` | J (J/m) |"));
    assert_non_null(strstr(text, "\n| `stiffness` | number | N/m (N/m2) | **required** | >= 0 |"));
    assert_non_null(strstr(text, "\n| `motion` | word |  | free | free, prescribed |"));
    assert_non_null(strstr(text, "\n| `body_rotation_angle` | rad | `direction` (required in 3D) `body` (required) |"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tables_are_sound),
        cmocka_unit_test(conditions_of_bodies_name_what_the_tables_have),
        cmocka_unit_test(the_printed_reference_names_every_key),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
