/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/write/case_writer.h"

#include "cases/driver/case/write/case_write.h"
#include "core/base/hash.h"
#include "core/io/durable_file.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The case as it was used: the tables of case_schema.c in the other direction. */

/* ---- Soil and walls ---------------------------------------------------------------------------------------------- */

static mor_case_presence presence_of_stress_key(const mor_case_key *key, const void *record)
{
    const mor_case_soil *soil = record;
    const char *name = key->schema.key;
    if (strcmp(name, "type") == 0) {
        return MOR_CASE_WRITE;
    }
    if ((strcmp(name, "pressure") == 0) != (soil->initial_stress == MOR_CASE_STRESS_UNIFORM)) {
        return MOR_CASE_OMIT;
    }
    const bool is_settling = strncmp(name, "settle", strlen("settle")) == 0;
    if (soil->initial_stress == MOR_CASE_STRESS_NONE || soil->initial_stress == MOR_CASE_STRESS_FORMULA ||
        (is_settling && soil->initial_stress == MOR_CASE_STRESS_K0)) {
        return MOR_CASE_OMIT;
    }
    const bool is_relaxed = soil->settle_method == MOR_CASE_SETTLE_RELAXATION;
    const bool is_of_k0 = strcmp(name, "lateral_ratio") == 0 || strcmp(name, "surface_level") == 0;
    if ((is_settling && strcmp(name, is_relaxed ? "settle_speed_ratio" : "settle_force_ratio") == 0) ||
        (soil->initial_stress == MOR_CASE_STRESS_SETTLED && soil->settle_from != 0 && is_of_k0)) {
        return MOR_CASE_OMIT;
    }
    const bool is_left_open = (strcmp(name, "lateral_ratio") == 0 && soil->lateral_ratio < 0.0) ||
                              (strcmp(name, "surface_level") == 0 && isnan(soil->surface_level));
    return is_left_open ? MOR_CASE_MENTION : MOR_CASE_WRITE;
}

static mor_status write_parameters(const mor_case_writer *w, const mor_material *model, const double *values,
                                   uint64_t written)
{
    for (int k = 0; model->parameters[k].key != NULL; ++k) {
        const mor_schema *schema = &model->parameters[k];
        char word[MOR_CASE_NAME_BYTES];
        char value[MOR_CASE_VALUE_BYTES];
        if (schema->kind == MOR_SCHEMA_CHOICE) {
            mor_params_word(schema->choices, (int)values[0], word, sizeof word);
            mor_case_writer_text(word, value, sizeof value);
        } else if (schema->kind == MOR_SCHEMA_BOOLEAN) {
            snprintf(value, sizeof value, "%s", values[0] == 1.0 ? "true" : "false");
        } else if (schema->kind == MOR_SCHEMA_INTEGER) {
            mor_case_writer_whole((int64_t)values[0], value, sizeof value);
        } else {
            MOR_TRY(w->reader.context,
                    mor_case_writer_numbers(w, schema, false, values, schema->n_components, value, sizeof value));
        }
        mor_case_writer_line(w, schema->key, value, (written >> k & 1) == 0);
        values += schema->n_components;
    }
    return MOR_OK;
}

static mor_status find_model(const mor_case_writer *w, const char *name, const mor_material **model)
{
    *model = mor_registry_find(w->reader.registry, name);
    MOR_CHECK(w->reader.context, *model != NULL, MOR_ERROR_ARGUMENT,
              "the case uses the model '%s', which this registry does not have; give the one it was read with", name);
    return MOR_OK;
}

static mor_case_presence presence_of_soil_key(const mor_case_key *key, const void *record)
{
    const mor_case_soil *soil = record;
    const bool is_replaced = strcmp(key->schema.key, "velocity") == 0 && soil->velocity_formula[0][0] != '\0';
    return is_replaced ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

static mor_case_presence presence_of_material_key(const mor_case_key *key, const void *record)
{
    const mor_case_soil *soil = record;
    return strcmp(key->schema.key, "law") == 0 && soil->external.law[0] == '\0' ? MOR_CASE_MENTION : MOR_CASE_WRITE;
}

static void write_numbers(const mor_case_writer *w, const char *key, const double *values, int n)
{
    fprintf(w->stream, "%*s%s = (", w->depth * MOR_CASE_INDENT, "", key);
    for (int k = 0; k < n; ++k) {
        char number[32];
        snprintf(number, sizeof number, "%.17g", values[k]);
        /* Else a large whole number would not be one of the language. */
        fprintf(w->stream, "%s%s%s", k > 0 ? ", " : "", number, strpbrk(number, ".e") != NULL ? "" : ".0");
    }
    fprintf(w->stream, ");\n");
}

static void write_external(const mor_case_writer *w, const mor_case_external *external)
{
    write_numbers(w, "props", external->constants, external->n_constants);
    fprintf(w->stream, "%*sstate = (", w->depth * MOR_CASE_INDENT, "");
    for (int k = 0; k < external->n_states; ++k) {
        fprintf(w->stream, "%s\"%s\"", k > 0 ? ", " : "", external->states[k]);
    }
    fprintf(w->stream, ");\n");
    write_numbers(w, "state_start", external->state_start, external->n_state_start);
    mor_case_writer_hash(w, external->file_hash);
}

static mor_case_presence presence_of_field_key(const mor_case_key *key, const void *record)
{
    const mor_case_field *field = record;
    const char *name = key->schema.key;
    const bool is_random = field->distribution != MOR_CASE_DISTRIBUTION_NONE;
    const bool is_correlated = field->other >= 0;
    const struct {
        const char *key;
        bool is_written;
    } rules[] = {{"formula", field->formula[0] != '\0'},
                 {"coefficient_of_variation", is_random && isnan(field->standard_deviation)},
                 {"correlation", is_random && !is_correlated},
                 {"correlation_length", is_random && !is_correlated},
                 {"seed", is_random && !is_correlated},
                 {"correlated_with", is_correlated},
                 {"cross_correlation", is_correlated}};
    for (size_t k = 0; k < sizeof rules / sizeof *rules; ++k) {
        if (strcmp(name, rules[k].key) == 0) {
            return rules[k].is_written ? MOR_CASE_WRITE : MOR_CASE_OMIT;
        }
    }
    return MOR_CASE_WRITE;
}

static mor_status write_field(mor_case_writer *w, const mor_case_field *field, const mor_schema *parameter)
{
    const struct {
        const char *key;
        double value;
    } numbers[] = {
        {"standard_deviation", field->standard_deviation}, {"minimum", field->minimum}, {"maximum", field->maximum}};
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_field_group, field, presence_of_field_key));
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        char value[MOR_CASE_VALUE_BYTES];
        if (isfinite(numbers[k].value)) {
            MOR_TRY(w->reader.context,
                    mor_case_writer_numbers(w, parameter, false, &numbers[k].value, 1, value, sizeof value));
            mor_case_writer_line(w, numbers[k].key, value, false);
        }
    }
    return MOR_OK;
}

static mor_status write_fields(mor_case_writer *w, const mor_case_soil *soil)
{
    if (soil->n_fields == 0) {
        return MOR_OK;
    }
    mor_case_writer_open(w, "fields", "(");
    for (int k = 0; k < soil->n_fields; ++k) {
        const mor_case_field *field = &soil->fields[k];
        mor_case_writer_open(w, "", "{");
        MOR_TRY(w->reader.context, write_field(w, field, &soil->law->parameters[field->entry]));
        mor_case_writer_close(w, k + 1 < soil->n_fields ? "}," : "}");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

static mor_status write_soil(mor_case_writer *w, const mor_case_soil *soil)
{
    const bool is_external = soil->external.made != NULL;
    const mor_case_group *group = is_external ? &mor_case_external_group : &mor_case_material_group;
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_soil_group, soil, presence_of_soil_key));
    mor_case_writer_formulas(w, "velocity_formula", soil->velocity_formula, 3);
    MOR_TRY(w->reader.context, mor_case_writer_shape(w, "shape", &soil->outline, "};"));
    mor_case_writer_open(w, "material", "{");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, group, soil, presence_of_material_key));
    MOR_TRY(w->reader.context, write_parameters(w, soil->law, soil->parameters, soil->written_parameters));
    if (is_external) {
        write_external(w, &soil->external);
    }
    mor_case_writer_close(w, "};");
    MOR_TRY(w->reader.context, write_fields(w, soil));
    mor_case_writer_open(w, "initial_stress", "{");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_stress_group, soil, presence_of_stress_key));
    mor_case_writer_formulas(w, "formula", soil->stress_formula, 6);
    mor_case_writer_close(w, "};");
    return MOR_OK;
}

static mor_case_presence presence_of_wall_key(const mor_case_key *key, const void *record)
{
    const mor_case_wall *wall = record;
    const bool is_idle =
        (strcmp(key->schema.key, "friction_coefficient") == 0 && wall->friction != MOR_CASE_FRICTION_COULOMB) ||
        (strcmp(key->schema.key, "velocity") == 0 && wall->path.n_rows > 0);
    if (strcmp(key->schema.key, "removed_at") == 0 && isnan(wall->removed_at)) {
        return MOR_CASE_MENTION;
    }
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

static mor_case_presence presence_of_friction_key(const mor_case_key *key, const void *record)
{
    const mor_case_soil_friction *it = record;
    const bool is_idle =
        strcmp(key->schema.key, "friction_coefficient") == 0 && it->friction != MOR_CASE_FRICTION_COULOMB;
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

static mor_status write_frictions(mor_case_writer *w, const mor_case_frictions *frictions)
{
    if (frictions->n == 0) {
        return MOR_OK;
    }
    mor_case_writer_open(w, "friction_with", "(");
    for (int k = 0; k < frictions->n; ++k) {
        mor_case_writer_open(w, "", "{");
        MOR_TRY(w->reader.context,
                mor_case_writer_keys(w, &mor_case_friction_group, &frictions->of[k], presence_of_friction_key));
        mor_case_writer_close(w, k + 1 < frictions->n ? "}," : "}");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

static mor_status write_wall(mor_case_writer *w, const mor_case_wall *wall)
{
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_wall_group, wall, presence_of_wall_key));
    MOR_TRY(w->reader.context, write_frictions(w, &wall->friction_with));
    MOR_TRY(w->reader.context, mor_case_writer_path(w, &wall->path));
    return mor_case_writer_shape(w, "shape", &wall->outline, "};");
}

/* ---- Bodies and contact ------------------------------------------------------------------------------------------ */

static mor_case_presence presence_of_body_key(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    const char *name = key->schema.key;
    const bool is_open = (strcmp(name, "contact_modulus") == 0 && isnan(body->contact_modulus)) ||
                         (strcmp(name, "height_over_ground") == 0 && isnan(body->height_over_ground));
    const bool is_replaced =
        body->path.n_rows > 0 && (strcmp(name, "velocity") == 0 || strcmp(name, "angular_velocity") == 0);
    const bool stays = strcmp(name, "removed_at") == 0 && isnan(body->removed_at);
    if (is_open) {
        return MOR_CASE_MENTION;
    }
    const bool is_idle =
        mor_case_body_condition(body, name) != NULL || is_replaced || stays ||
        (strcmp(name, "friction_coefficient") == 0 && body->soil_friction != MOR_CASE_FRICTION_COULOMB);
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

static mor_case_presence presence_of_spring_key(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    return strcmp(key->schema.key, "length") == 0 && isnan(body->spring_length) ? MOR_CASE_MENTION : MOR_CASE_WRITE;
}

static mor_case_presence presence_of_start_key(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    return mor_case_start_condition(body->motion, key->schema.key) == NULL ? MOR_CASE_WRITE : MOR_CASE_OMIT;
}

static mor_status write_body_material(mor_case_writer *w, const mor_case_body *body)
{
    mor_case_writer_open(w, "material", "{");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_body_material_group, body, mor_case_presence_always));
    if (!mor_case_body_is_rigid(body)) {
        const mor_material *model = NULL;
        MOR_TRY(w->reader.context, find_model(w, body->model, &model));
        MOR_TRY(w->reader.context, write_parameters(w, model, body->parameters, body->written_parameters));
    }
    mor_case_writer_close(w, "};");
    return MOR_OK;
}

static void write_locks(const mor_case_writer *w, const mor_case_body *body)
{
    char value[MOR_CASE_VALUE_BYTES] = "(";
    size_t used = 1;
    for (int k = 0; k < MOR_CASE_LOCKS; ++k) {
        if (body->is_locked[k]) {
            used += (size_t)snprintf(value + used, sizeof value - used, "%s\"%s\"", used > 1 ? ", " : "",
                                     mor_case_lock_words[k]);
        }
    }
    if (used > 1) {
        snprintf(value + used, sizeof value - used, ")");
        mor_case_writer_line(w, "locked", value, false);
    }
}

/* The stiffness that was chosen where none is given: forces of contacts depend on it. */
static mor_status mention_modulus(const mor_case_writer *w, const mor_case *the_case, const mor_case_body *body)
{
    if (!isnan(body->contact_modulus)) {
        return MOR_OK;
    }
    const int at = mor_case_key_find(mor_case_body_group.keys, "contact_modulus");
    const double modulus = mor_case_contact_modulus(the_case, body);
    char value[MOR_CASE_VALUE_BYTES];
    MOR_TRY(w->reader.context,
            mor_case_writer_numbers(w, &mor_case_body_group.keys[at].schema, false, &modulus, 1, value, sizeof value));
    fprintf(w->stream, "%*s# contact_modulus used: %s\n", w->depth * MOR_CASE_INDENT, "", value);
    return MOR_OK;
}

static mor_status write_body(mor_case_writer *w, const mor_case *the_case, const mor_case_body *body)
{
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_body_group, body, presence_of_body_key));
    MOR_TRY(w->reader.context, mention_modulus(w, the_case, body));
    MOR_TRY(w->reader.context, write_frictions(w, &body->friction_with));
    MOR_TRY(w->reader.context, mor_case_writer_shape(w, "shape", &body->outline, "};"));
    MOR_TRY(w->reader.context, write_body_material(w, body));
    MOR_TRY(w->reader.context, mor_case_writer_path(w, &body->path));
    write_locks(w, body);
    if (body->has_spring) {
        mor_case_writer_open(w, "spring", "{");
        MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_spring_group, body, presence_of_spring_key));
        mor_case_writer_close(w, "};");
    }
    if (body->clamp != NULL) {
        MOR_TRY(w->reader.context, mor_case_writer_shape(w, "clamp", &body->clamp_outline, "};"));
    }
    if (mor_case_body_condition(body, "start") == NULL) {
        mor_case_writer_open(w, "start", "{");
        MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_start_group, body, presence_of_start_key));
        mor_case_writer_close(w, "};");
    }
    return MOR_OK;
}

/* ---- Packed rocks ------------------------------------------------------------------------------------------------ */

static mor_case_presence presence_of_rocks_key(const mor_case_key *key, const void *record)
{
    const mor_case_rocks *rocks = record;
    const mor_case_body *body = &rocks->body;
    const bool is_packed = rocks->list[0] == '\0';
    const struct {
        const char *key;
        bool is_written;
    } rules[] = {{"content", is_packed && rocks->count == 0},
                 {"count", rocks->count > 0},
                 {"list", !is_packed},
                 {"gap", is_packed},
                 {"margin", is_packed},
                 {"seed", is_packed}};
    for (size_t k = 0; k < sizeof rules / sizeof *rules; ++k) {
        if (strcmp(key->schema.key, rules[k].key) == 0) {
            return rules[k].is_written ? MOR_CASE_WRITE : MOR_CASE_OMIT;
        }
    }
    return strncmp(key->schema.key, "contact_", 8) == 0 || strcmp(key->schema.key, "friction_coefficient") == 0
               ? presence_of_body_key(key, body)
               : MOR_CASE_WRITE;
}

static mor_status write_form(mor_case_writer *w, const mor_case_shape *form)
{
    const mor_case_group *group = mor_case_rock_form_group(form->kind);
    char type[MOR_CASE_NAME_BYTES];
    mor_case_writer_text(group->name, type, sizeof type);
    mor_case_writer_line(w, "type", type, false);
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, group, form, mor_case_presence_of_shape));
    mor_case_writer_hash(w, form->file_hash);
    return MOR_OK;
}

static mor_status write_packing(mor_case_writer *w, const mor_case_rocks *rocks)
{
    MOR_TRY(w->reader.context, mor_case_writer_shape(w, "region", &rocks->region_outline, "};"));
    mor_case_writer_open(w, "sizes", "(");
    for (int k = 0; k < rocks->n_sizes; ++k) {
        mor_case_writer_open(w, "", "{");
        MOR_TRY(w->reader.context,
                mor_case_writer_keys(w, &mor_case_size_group, &rocks->sizes[k], mor_case_presence_always));
        mor_case_writer_close(w, k + 1 < rocks->n_sizes ? "}," : "}");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

static mor_status write_rocks(mor_case_writer *w, const mor_case_rocks *rocks)
{
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_rocks_group, rocks, presence_of_rocks_key));
    mor_case_writer_hash(w, rocks->list_hash);
    MOR_TRY(w->reader.context, write_frictions(w, &rocks->body.friction_with));
    if (rocks->list[0] == '\0') {
        MOR_TRY(w->reader.context, write_packing(w, rocks));
    }
    mor_case_writer_open(w, "forms", "(");
    for (int k = 0; k < rocks->n_forms; ++k) {
        mor_case_writer_open(w, "", "{");
        MOR_TRY(w->reader.context, write_form(w, &rocks->forms[k]));
        mor_case_writer_close(w, k + 1 < rocks->n_forms ? "}," : "}");
    }
    mor_case_writer_close(w, ");");
    return write_body_material(w, &rocks->body);
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

/* The lists, so that one function writes all of them. */
typedef enum list_kind { SOIL, WALLS, BODIES, ROCKS, PAIRS, GAUGES, PROBES, EXPECT, LIST_COUNT } list_kind;

static mor_status write_entry(mor_case_writer *w, const mor_case *the_case, list_kind kind, int k)
{
    switch (kind) {
    case SOIL:
        return write_soil(w, &the_case->soils[k]);
    case WALLS:
        return write_wall(w, &the_case->walls[k]);
    case BODIES:
        return write_body(w, the_case, &the_case->bodies[k]);
    case ROCKS:
        return write_rocks(w, &the_case->rocks[k]);
    case PAIRS:
        return mor_case_writer_keys(w, &mor_case_pair_group, &the_case->contact.pairs[k], mor_case_presence_always);
    case GAUGES:
        return mor_case_writer_gauge(w, &the_case->gauges[k]);
    case PROBES:
        return mor_case_writer_probe(w, &the_case->probes[k]);
    case EXPECT:
        return mor_case_writer_expectation(w, the_case, &the_case->expectations[k]);
    case LIST_COUNT:
        break;
    }
    return MOR_OK;
}

static mor_status write_list(mor_case_writer *w, const mor_case *the_case, list_kind kind)
{
    static const char *const names[LIST_COUNT] = {"soil",  "walls",  "bodies", "rocks",
                                                  "pairs", "gauges", "probes", "expect"};
    const int counts[LIST_COUNT] = {the_case->n_soils,  the_case->n_walls,         the_case->n_listed_bodies,
                                    the_case->n_rocks,  the_case->contact.n_pairs, the_case->n_gauges,
                                    the_case->n_probes, the_case->n_expectations};
    if (counts[kind] == 0) {
        return MOR_OK;
    }
    mor_case_writer_open(w, names[kind], "(");
    for (int k = 0; k < counts[kind]; ++k) {
        mor_case_writer_open(w, "", "{");
        MOR_TRY(w->reader.context, write_entry(w, the_case, kind, k));
        mor_case_writer_close(w, k + 1 < counts[kind] ? "}," : "}");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

/* Without bodies a contact would be refused when read again. */
static mor_status write_contact(mor_case_writer *w, const mor_case *the_case)
{
    if (the_case->n_bodies == 0) {
        return MOR_OK;
    }
    mor_case_writer_open(w, mor_case_contact_group.name, "{");
    MOR_TRY(w->reader.context,
            mor_case_writer_keys(w, &mor_case_contact_group, &the_case->contact, mor_case_presence_always));
    MOR_TRY(w->reader.context, write_list(w, the_case, PAIRS));
    mor_case_writer_close(w, "};");
    return MOR_OK;
}

/* A plug-in that has changed is recognized by the line behind it. */
static void write_plugins(mor_case_writer *w, const mor_case *the_case)
{
    if (the_case->n_plugins == 0) {
        return;
    }
    mor_case_writer_open(w, "plugins", "(");
    for (int k = 0; k < the_case->n_plugins; ++k) {
        const mor_case_plugin *it = &the_case->plugins[k];
        char value[MOR_CASE_VALUE_BYTES];
        mor_case_writer_text(it->file, value, sizeof value);
        fprintf(w->stream, "%*s# %s\n", w->depth * MOR_CASE_INDENT, "", it->models);
        fprintf(w->stream, "%*s%s%s\n", w->depth * MOR_CASE_INDENT, "", value, k + 1 < the_case->n_plugins ? "," : "");
        mor_case_writer_hash(w, it->file_hash);
    }
    mor_case_writer_close(w, ");");
}

static mor_case_presence presence_of_root_key(const mor_case_key *key, const void *record)
{
    const mor_case *the_case = record;
    const bool is_idle = strcmp(key->schema.key, "start_from") == 0 && the_case->stage.run[0] == '\0';
    return is_idle ? MOR_CASE_OMIT : MOR_CASE_WRITE;
}

/* What of the run before is taken over; a run that has changed is recognized by the line of its hash. */
static mor_status write_stage(mor_case_writer *w, const mor_case_stage *stage)
{
    mor_case_writer_hash(w, stage->hash);
    return stage->n_excavations == 0
               ? MOR_OK
               : mor_case_writer_shapes(w, "excavate", stage->excavation_outlines, stage->n_excavations);
}

static mor_status write_case(mor_case_writer *w, const mor_case *the_case)
{
    fprintf(w->stream, "# The case as it was used: every value, in SI, before the scale. \"# default\" marks what the "
                       "case file\n# did not give.\n");
    MOR_TRY(w->reader.context, mor_case_writer_keys(w, &mor_case_root_group, the_case, presence_of_root_key));
    MOR_TRY(w->reader.context, write_stage(w, &the_case->stage));
    write_plugins(w, the_case);
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        mor_case_writer_open(w, group->name, "{");
        MOR_TRY(w->reader.context, mor_case_writer_keys(w, group, the_case, mor_case_presence_always));
        mor_case_writer_close(w, "};");
    }
    for (list_kind kind = SOIL; kind < LIST_COUNT; ++kind) {
        MOR_TRY(w->reader.context, kind == PAIRS ? write_contact(w, the_case) : write_list(w, the_case, kind));
    }
    return mor_case_writer_maps(w, &the_case->maps);
}

mor_status mor_case_write_stream(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                                 FILE *stream)
{
    mor_units *units = NULL;
    MOR_TRY(context, mor_units_new(context, &units));
    mor_case_writer w = {.reader = {.context = context,
                                    .units = units,
                                    .registry = registry,
                                    .dimension = the_case->dimension,
                                    .length_power = ilogb(the_case->scale_length),
                                    .time_power = ilogb(the_case->scale_time),
                                    .mass_power = ilogb(the_case->scale_mass)},
                         .stream = stream};
    const mor_status status = write_case(&w, the_case);
    mor_units_free(context, &units);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_case_write(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                          const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    const mor_status status = mor_case_write_stream(context, the_case, registry, file.stream);
    if (status != MOR_OK) {
        mor_durable_file_discard(&file);
        return mor_context_pass(context, status, MOR_HERE);
    }
    MOR_TRY(context, mor_durable_file_commit(context, &file));
    return MOR_OK;
}
