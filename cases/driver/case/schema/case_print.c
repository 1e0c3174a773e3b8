/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The reference of case files, printed from the tables. */

enum { CELL_BYTES = 320 };

static const char *name_kind(const mor_schema *schema)
{
    switch (schema->kind) {
    case MOR_SCHEMA_REAL:
        return "number";
    case MOR_SCHEMA_INTEGER:
        return "whole number";
    case MOR_SCHEMA_BOOLEAN:
        return "true or false";
    case MOR_SCHEMA_TEXT:
        return "text";
    case MOR_SCHEMA_CHOICE:
        return "word";
    case MOR_SCHEMA_VECTOR:
        return "vector";
    }
    return "";
}

static void describe_default(const mor_schema *schema, const char *computed, char *text, size_t text_bytes)
{
    if (schema->is_required) {
        snprintf(text, text_bytes, "**required**");
    } else if (computed != NULL) {
        snprintf(text, text_bytes, "%s", computed);
    } else if (schema->kind == MOR_SCHEMA_CHOICE) {
        mor_params_word(schema->choices, (int)schema->default_value, text, text_bytes);
    } else if (schema->kind == MOR_SCHEMA_BOOLEAN) {
        snprintf(text, text_bytes, "%s", schema->default_value == 1.0 ? "true" : "false");
    } else if (schema->kind == MOR_SCHEMA_TEXT) {
        snprintf(text, text_bytes, "empty");
    } else if (schema->kind == MOR_SCHEMA_VECTOR) {
        snprintf(text, text_bytes, "%g in each", schema->default_value);
    } else {
        snprintf(text, text_bytes, "%.10g", schema->default_value);
    }
}

/* Words in a table cell: a bar would end the cell. */
static void describe_range(const mor_schema *schema, char *text, size_t text_bytes)
{
    text[0] = '\0';
    if (schema->kind == MOR_SCHEMA_CHOICE) {
        size_t used = 0;
        for (const char *c = schema->choices; *c != '\0' && used + 3 < text_bytes; ++c) {
            text[used++] = *c == '|' ? ',' : *c;
            if (*c == '|') {
                text[used++] = ' ';
            }
        }
        text[used] = '\0';
    } else if (isfinite(schema->minimum) || isfinite(schema->maximum)) {
        mor_schema bare = *schema;
        bare.unit = "1";
        mor_params_range(&bare, text, text_bytes);
    }
}

/* The default of the scheme that is chosen where none is, then that of the other one where it is another. */
static void describe_defaults(const mor_case_key *key, const mor_schema *schemes, char *text, size_t text_bytes)
{
    const int standard = (int)schemes->default_value;
    mor_schema schema = key->schema;
    char other[CELL_BYTES];
    char scheme[CELL_BYTES];
    schema.default_value = mor_case_key_default(key, standard);
    describe_default(&schema, key->computed, text, text_bytes);
    if (key->computed == NULL && mor_case_key_default(key, 1 - standard) != schema.default_value) {
        const size_t used = strlen(text);
        schema.default_value = mor_case_key_default(key, 1 - standard);
        describe_default(&schema, NULL, other, sizeof other);
        mor_params_word(schemes->choices, 1 - standard, scheme, sizeof scheme);
        snprintf(text + used, text_bytes - used, "; %s: %s", scheme, other);
    }
}

static void print_row(FILE *stream, const mor_schema *schema, const char *unit_plane, const char *fallback)
{
    char range[CELL_BYTES];
    describe_range(schema, range, sizeof range);
    const bool has_unit = schema->kind != MOR_SCHEMA_TEXT && strcmp(schema->unit, "1") != 0;
    fprintf(stream, "| `%s` | %s | %s%s%s%s | %s | %s | %s |\n", schema->key, name_kind(schema),
            has_unit ? schema->unit : "", unit_plane == NULL ? "" : " (", unit_plane == NULL ? "" : unit_plane,
            unit_plane == NULL ? "" : ")", fallback, range, schema->text);
}

static void print_parameter(FILE *stream, const mor_schema *schema)
{
    char fallback[CELL_BYTES];
    describe_default(schema, NULL, fallback, sizeof fallback);
    print_row(stream, schema, NULL, fallback);
}

static void print_heading(FILE *stream, int level, const char *title, const char *name)
{
    fprintf(stream, "\n%.*s %s", level, "####", title);
    if (name[0] != '\0') {
        fprintf(stream, ": `%s`", name);
    }
    fprintf(stream, "\n\n| key | type | unit | default | allowed | meaning |\n| --- | --- | --- | --- | --- | --- |\n");
}

static void print_group(FILE *stream, int level, const mor_case_group *group, const char *extra)
{
    print_heading(stream, level, group->text, group->name);
    if (extra != NULL) {
        fprintf(stream, "| `type` | word |  | **required** | %s | type of the shape |\n", extra);
    }
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        char fallback[CELL_BYTES];
        if (key->has_schemes) {
            describe_defaults(key, &group->keys[0].schema, fallback, sizeof fallback);
        } else {
            describe_default(&key->schema, key->computed, fallback, sizeof fallback);
        }
        print_row(stream, &key->schema, key->unit_plane, fallback);
    }
    for (const mor_case_part *part = group->parts; part != NULL && part->name != NULL; ++part) {
        fprintf(stream, "| `%s` | %s |  | %s |  | %s |\n", part->name, part->form,
                part->is_required ? "**required**" : "optional", part->text);
    }
}

void mor_case_schema_print_group(const mor_case_group *group, int level, const char *type, FILE *stream)
{
    print_group(stream, level, group, type);
}

static void print_probe_types(mor_case_probe_catalog catalog, FILE *stream)
{
    fprintf(stream, "\n### Types of probes\n\nUnits in parentheses hold in plane strain. A key that a type does not "
                    "take is refused.\n\n| type | unit | keys it takes | percentile | meaning |\n"
                    "| --- | --- | --- | --- | --- |\n");
    const mor_case_probe_type *type = NULL;
    for (int n = 0; (type = catalog(n)) != NULL; ++n) {
        const bool is_same = strcmp(type->unit, type->unit_plane) == 0;
        fprintf(stream, "| `%s` | %s%s%s%s | ", type->name, type->unit, is_same ? "" : " (",
                is_same ? "" : type->unit_plane, is_same ? "" : ")");
        for (int k = 0; mor_case_probe_key_names[k] != NULL; ++k) {
            if ((type->allowed >> k & 1U) != 0) {
                const bool is_required = (mor_case_probe_required(type, 2) >> k & 1U) != 0;
                const bool is_required_in_space = (mor_case_probe_required(type, 3) >> k & 1U) != 0;
                fprintf(stream, "`%s`%s ", mor_case_probe_key_names[k],
                        is_required            ? " (required)"
                        : is_required_in_space ? " (required in 3D)"
                                               : "");
            }
        }
        const bool has_percentile = (type->allowed & MOR_CASE_PROBE_PERCENTILE) != 0;
        if (has_percentile) {
            fprintf(stream, "| %g | %s |\n", type->percentile, type->text);
        } else {
            fprintf(stream, "|  | %s |\n", type->text);
        }
    }
}

static void print_interfaces(const mor_registry *registry, FILE *stream)
{
    const mor_external_interface *interface = NULL;
    fprintf(stream,
            "\nHow laws written for other programs are built and used: [use_a_umat.md](../guide/use_a_umat.md).\n");
    for (int k = 0; (interface = mor_registry_interface(registry, k)) != NULL; ++k) {
        print_heading(stream, 3, interface->text, interface->name);
        for (const mor_schema *entry = interface->parameters; entry->key != NULL; ++entry) {
            print_parameter(stream, entry);
        }
    }
}

static void print_models(const mor_registry *registry, FILE *stream)
{
    fprintf(stream, "\n## Material models\n");
    for (int k = 0; k < mor_registry_count(registry); ++k) {
        const mor_material *model = mor_registry_get(registry, k);
        print_heading(stream, 3, model->text, model->name);
        for (const mor_schema *entry = model->parameters; entry->key != NULL; ++entry) {
            print_parameter(stream, entry);
        }
    }
}

void mor_case_schema_print(const mor_registry *registry, mor_case_probe_catalog probe_types, FILE *stream)
{
    fprintf(stream,
            "# Case files\n\nA case file is in the language of libconfig: `name = value;`, groups in `{ }`, lists in "
            "`( )`, texts in\ndouble quotes, comments after `#`. A bare number is in the SI unit of the table; a value "
            "with another unit\nis a text: `\"5.98 MPa\"`, `\"30 deg\"`. In plane strain a vector may have two "
            "numbers, and "
            "units in parentheses\nhold. A name that is not listed here is refused.\n");
    print_group(stream, 2, &mor_case_root_group, NULL);
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        print_group(stream, 2, group, NULL);
    }
    print_group(stream, 2, &mor_case_soil_group, NULL);
    print_group(stream, 3, &mor_case_material_group, NULL);
    print_group(stream, 3, &mor_case_external_group, NULL);
    print_group(stream, 3, &mor_case_field_group, NULL);
    print_group(stream, 3, &mor_case_stress_group, NULL);
    print_group(stream, 2, &mor_case_wall_group, NULL);
    print_group(stream, 3, &mor_case_friction_group, NULL);
    print_group(stream, 3, &mor_case_path_group, NULL);
    print_group(stream, 3, &mor_case_path_row_group, NULL);
    print_group(stream, 2, &mor_case_body_group, NULL);
    print_group(stream, 3, &mor_case_body_material_group, NULL);
    print_group(stream, 3, &mor_case_spring_group, NULL);
    print_group(stream, 3, &mor_case_start_group, NULL);
    print_group(stream, 2, &mor_case_rocks_group, NULL);
    print_group(stream, 3, &mor_case_size_group, NULL);
    for (int k = 0; k < MOR_CASE_ROCK_FORM_COUNT; ++k) {
        print_group(stream, 3, &mor_case_rock_form_groups[k], mor_case_rock_form_groups[k].name);
    }
    print_group(stream, 2, &mor_case_contact_group, NULL);
    print_group(stream, 3, &mor_case_pair_group, NULL);
    fprintf(stream, "\n## Shapes\n");
    for (int k = 0; k < MOR_CASE_SHAPE_COUNT; ++k) {
        print_group(stream, 3, &mor_case_shape_groups[k], mor_case_shape_groups[k].name);
    }
    print_group(stream, 2, &mor_case_gauge_group, NULL);
    print_group(stream, 2, &mor_case_probe_group, NULL);
    print_probe_types(probe_types, stream);
    print_group(stream, 2, &mor_case_expectation_group, NULL);
    print_group(stream, 2, &mor_case_maps_group, NULL);
    print_models(registry, stream);
    print_interfaces(registry, stream);
}
