/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case_read.h"

#include "cases/driver/case_reader.h"
#include "core/material/params.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The case as it was used: the tables of case_schema.c walked the other way. */

enum { VALUE_BYTES = 640, NUMBER_BYTES = 64, INDENT = 4, VALUES_MAX = 9 };

typedef struct writer {
    mor_case_reader reader; /* knows units, dimension and scale */
    FILE *stream;
    int depth;
} writer;

/* Whether a key that the record holds is written: a key without effect would be refused when read again. */
typedef enum presence { WRITE, OMIT, MENTION } presence;
typedef presence (*presence_of)(const mor_case_key *key, const void *record);

static presence write_always(const mor_case_key *key, const void *record)
{
    (void)key, (void)record;
    return WRITE;
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static void print_text(const char *text, char *out, size_t out_bytes)
{
    size_t used = 0;
    out[used++] = '"';
    for (; *text != '\0' && used + 4 < out_bytes; ++text) {
        if (*text == '"' || *text == '\\') {
            out[used++] = '\\';
        }
        out[used++] = *text;
    }
    out[used++] = '"';
    out[used] = '\0';
}

static void print_whole(int64_t value, char *out, size_t out_bytes)
{
    snprintf(out, out_bytes, "%" PRId64 "%s", value, value > INT_MAX || value < INT_MIN ? "L" : "");
}

static void print_real(const writer *w, double value, const char *unit, char *out, size_t out_bytes)
{
    char number[NUMBER_BYTES];
    mor_units_print(w->reader.units, value, number, sizeof number);
    if (strcmp(unit, "1") == 0) {
        snprintf(out, out_bytes, "%s", number);
    } else {
        snprintf(out, out_bytes, "\"%s %s\"", number, unit);
    }
}

/* Numbers of any kind, with their unit and before the scale. */
static mor_status print_numbers(const writer *w, const mor_schema *schema, bool keeps_scale, const double *given, int n,
                                char *out, size_t out_bytes)
{
    double values[VALUES_MAX];
    memcpy(values, given, (size_t)n * sizeof *values);
    if (!keeps_scale) {
        MOR_TRY(w->reader.context, mor_case_reader_scale(&w->reader, schema->unit, values, n, -1));
    }
    if (schema->kind != MOR_SCHEMA_VECTOR) {
        print_real(w, values[0], schema->unit, out, out_bytes);
        return MOR_OK;
    }
    size_t used = (size_t)snprintf(out, out_bytes, "(");
    for (int k = 0; k < n && used + NUMBER_BYTES < out_bytes; ++k) {
        char number[2 * NUMBER_BYTES];
        print_real(w, values[k], schema->unit, number, sizeof number);
        used += (size_t)snprintf(out + used, out_bytes - used, "%s%s", k > 0 ? ", " : "", number);
    }
    snprintf(out + used, out_bytes - used, ")");
    return MOR_OK;
}

static mor_status print_member(const writer *w, const mor_case_key *key, const void *member, char *out,
                               size_t out_bytes)
{
    char word[MOR_CASE_NAME_BYTES];
    const mor_schema schema = mor_case_key_schema(key, w->reader.dimension);
    switch (key->storage) {
    case MOR_CASE_STORE_REALS:
        return print_numbers(w, &schema, key->keeps_scale, member, schema.n_components, out, out_bytes);
    case MOR_CASE_STORE_INT:
        print_whole(*(const int *)member, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_SEED:
        print_whole((int64_t) * (const uint64_t *)member, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_BOOL:
        if (schema.kind == MOR_SCHEMA_BOOLEAN) {
            snprintf(out, out_bytes, "%s", *(const bool *)member ? "true" : "false");
            return MOR_OK;
        }
        mor_params_word(schema.choices, *(const bool *)member ? 1 : 0, word, sizeof word);
        print_text(word, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_CHOICE:
        mor_params_word(schema.choices, *(const int *)member, word, sizeof word);
        print_text(word, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_TEXT:
    case MOR_CASE_STORE_NAME:
    case MOR_CASE_STORE_WORD:
        print_text(member, out, out_bytes);
        return MOR_OK;
    }
    return MOR_OK;
}

static void put_line(const writer *w, const char *key, const char *value, bool is_default)
{
    fprintf(w->stream, "%*s%s = %s;%s\n", w->depth * INDENT, "", key, value, is_default ? " # default" : "");
}

static void open_group(writer *w, const char *name, const char *bracket)
{
    fprintf(w->stream, "%*s%s%s%s\n", w->depth * INDENT, "", name, name[0] == '\0' ? "" : " = ", bracket);
    w->depth += 1;
}

static void close_group(writer *w, const char *bracket)
{
    w->depth -= 1;
    fprintf(w->stream, "%*s%s\n", w->depth * INDENT, "", bracket);
}

static mor_status write_keys(const writer *w, const mor_case_group *group, const void *record, presence_of judge)
{
    uint64_t written = 0;
    memcpy(&written, (const char *)record + group->written_offset, sizeof written);
    for (int k = 0; group->keys[k].schema.key != NULL; ++k) {
        const mor_case_key *key = &group->keys[k];
        const presence judged = judge(key, record);
        if (judged == MENTION) {
            fprintf(w->stream, "%*s# %s: %s (default)\n", w->depth * INDENT, "", key->schema.key, key->computed);
        }
        if (judged != WRITE) {
            continue;
        }
        char value[VALUE_BYTES];
        MOR_TRY(w->reader.context, print_member(w, key, (const char *)record + key->offset, value, sizeof value));
        put_line(w, key->schema.key, value, (written >> k & 1) == 0);
    }
    return MOR_OK;
}

/* ---- Shapes ------------------------------------------------------------------------------------------------------ */

static mor_status write_shape(writer *w, const char *name, const mor_case_shape *outline, const char *end);

static mor_status write_shape_list(writer *w, const char *name, const mor_case_shape *shapes, int n_shapes)
{
    open_group(w, name, "(");
    for (int k = 0; k < n_shapes; ++k) {
        MOR_TRY(w->reader.context, write_shape(w, "", &shapes[k], k + 1 < n_shapes ? "}," : "}"));
    }
    close_group(w, ");");
    return MOR_OK;
}

static mor_status write_corners(writer *w, const mor_case_shape *outline)
{
    static const mor_schema corner = {.kind = MOR_SCHEMA_VECTOR, .unit = "m"};
    open_group(w, "points", "(");
    for (int k = 0; k < outline->n_points; ++k) {
        char value[VALUE_BYTES];
        MOR_TRY(w->reader.context, print_numbers(w, &corner, false, &outline->points[2 * k], 2, value, sizeof value));
        fprintf(w->stream, "%*s%s%s\n", w->depth * INDENT, "", value, k + 1 < outline->n_points ? "," : "");
    }
    close_group(w, ");");
    return MOR_OK;
}

static mor_status write_flat_box(const writer *w, const mor_case_shape *outline)
{
    static const mor_schema corner = {.kind = MOR_SCHEMA_VECTOR, .unit = "m"};
    char value[VALUE_BYTES];
    MOR_TRY(w->reader.context, print_numbers(w, &corner, false, outline->first, 2, value, sizeof value));
    put_line(w, "min", value, false);
    MOR_TRY(w->reader.context, print_numbers(w, &corner, false, outline->second, 2, value, sizeof value));
    put_line(w, "max", value, false);
    return MOR_OK;
}

static mor_status write_parts(writer *w, const mor_case_shape *outline)
{
    switch (outline->kind) {
    case MOR_CASE_SHAPE_POLYGON:
        return write_corners(w, outline);
    case MOR_CASE_SHAPE_UNION:
        return write_shape_list(w, "parts", outline->children, outline->n_children);
    case MOR_CASE_SHAPE_DIFFERENCE:
        MOR_TRY(w->reader.context, write_shape(w, "from", &outline->children[0], "};"));
        return write_shape_list(w, "minus", outline->children + 1, outline->n_children - 1);
    case MOR_CASE_SHAPE_TRANSLATE:
    case MOR_CASE_SHAPE_ROTATE:
        return write_shape(w, "shape", &outline->children[0], "};");
    case MOR_CASE_SHAPE_BOX:
    case MOR_CASE_SHAPE_CYLINDER:
    case MOR_CASE_SHAPE_CONE:
    case MOR_CASE_SHAPE_SPHERE:
    case MOR_CASE_SHAPE_HALF_SPACE:
    case MOR_CASE_SHAPE_COUNT:
        break;
    }
    return MOR_OK;
}

static mor_status write_shape(writer *w, const char *name, const mor_case_shape *outline, const char *end)
{
    const mor_case_group *group = &mor_case_shape_groups[outline->kind];
    char type[MOR_CASE_NAME_BYTES];
    print_text(group->name, type, sizeof type);
    open_group(w, name, "{");
    put_line(w, "type", type, false);
    if (outline->is_flat) {
        MOR_TRY(w->reader.context, write_flat_box(w, outline));
    } else {
        MOR_TRY(w->reader.context, write_keys(w, group, outline, write_always));
    }
    MOR_TRY(w->reader.context, write_parts(w, outline));
    close_group(w, end);
    return MOR_OK;
}

/* ---- Soil and walls ---------------------------------------------------------------------------------------------- */

static presence judge_stress(const mor_case_key *key, const void *record)
{
    const mor_case_soil *soil = record;
    const char *name = key->schema.key;
    if (strcmp(name, "type") == 0) {
        return WRITE;
    }
    const bool is_settling = strncmp(name, "settle", strlen("settle")) == 0;
    if (soil->initial_stress == MOR_CASE_STRESS_NONE || (is_settling && soil->initial_stress == MOR_CASE_STRESS_K0)) {
        return OMIT;
    }
    const bool is_left_open = (strcmp(name, "lateral_ratio") == 0 && soil->lateral_ratio < 0.0) ||
                              (strcmp(name, "surface_level") == 0 && isnan(soil->surface_level));
    return is_left_open ? MENTION : WRITE;
}

static mor_status write_parameters(const writer *w, const mor_material *model, const double *values, uint64_t written)
{
    for (int k = 0; model->parameters[k].key != NULL; ++k) {
        const mor_schema *schema = &model->parameters[k];
        char word[MOR_CASE_NAME_BYTES];
        char value[VALUE_BYTES];
        if (schema->kind == MOR_SCHEMA_CHOICE) {
            mor_params_word(schema->choices, (int)values[0], word, sizeof word);
            print_text(word, value, sizeof value);
        } else if (schema->kind == MOR_SCHEMA_BOOLEAN) {
            snprintf(value, sizeof value, "%s", values[0] == 1.0 ? "true" : "false");
        } else if (schema->kind == MOR_SCHEMA_INTEGER) {
            print_whole((int64_t)values[0], value, sizeof value);
        } else {
            MOR_TRY(w->reader.context,
                    print_numbers(w, schema, false, values, schema->n_components, value, sizeof value));
        }
        put_line(w, schema->key, value, (written >> k & 1) == 0);
        values += schema->n_components;
    }
    return MOR_OK;
}

static mor_status find_model(const writer *w, const char *name, const mor_material **model)
{
    *model = mor_registry_find(w->reader.registry, name);
    MOR_CHECK(w->reader.context, *model != NULL, MOR_ERROR_ARGUMENT,
              "the case uses the model '%s', which this registry does not have; give the one it was read with", name);
    return MOR_OK;
}

static mor_status write_soil(writer *w, const mor_case_soil *soil)
{
    const mor_material *model = NULL;
    MOR_TRY(w->reader.context, find_model(w, soil->model, &model));
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_soil_group, soil, write_always));
    MOR_TRY(w->reader.context, write_shape(w, "shape", &soil->outline, "};"));
    open_group(w, "material", "{");
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_material_group, soil, write_always));
    MOR_TRY(w->reader.context, write_parameters(w, model, soil->parameters, soil->written_parameters));
    close_group(w, "};");
    open_group(w, "initial_stress", "{");
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_stress_group, soil, judge_stress));
    close_group(w, "};");
    return MOR_OK;
}

static presence judge_wall(const mor_case_key *key, const void *record)
{
    const mor_case_wall *wall = record;
    const bool is_idle =
        strcmp(key->schema.key, "friction_coefficient") == 0 && wall->friction != MOR_CASE_FRICTION_COULOMB;
    return is_idle ? OMIT : WRITE;
}

static mor_status write_wall(writer *w, const mor_case_wall *wall)
{
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_wall_group, wall, judge_wall));
    return write_shape(w, "shape", &wall->outline, "};");
}

/* ---- Bodies and contact ------------------------------------------------------------------------------------------ */

static presence judge_body(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    const char *name = key->schema.key;
    if (strcmp(name, "contact_modulus") == 0 && isnan(body->contact_modulus)) {
        return MENTION;
    }
    const bool is_idle =
        mor_case_body_condition(body, name) != NULL ||
        (strcmp(name, "friction_coefficient") == 0 && body->soil_friction != MOR_CASE_FRICTION_COULOMB);
    return is_idle ? OMIT : WRITE;
}

static presence judge_spring(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    return strcmp(key->schema.key, "length") == 0 && isnan(body->spring_length) ? MENTION : WRITE;
}

static presence judge_start(const mor_case_key *key, const void *record)
{
    const mor_case_body *body = record;
    return mor_case_start_condition(body->motion, key->schema.key) == NULL ? WRITE : OMIT;
}

static mor_status write_body_material(writer *w, const mor_case_body *body)
{
    open_group(w, "material", "{");
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_body_material_group, body, write_always));
    if (!mor_case_body_is_rigid(body)) {
        const mor_material *model = NULL;
        MOR_TRY(w->reader.context, find_model(w, body->model, &model));
        MOR_TRY(w->reader.context, write_parameters(w, model, body->parameters, body->written_parameters));
    }
    close_group(w, "};");
    return MOR_OK;
}

static void write_locks(const writer *w, const mor_case_body *body)
{
    char value[VALUE_BYTES] = "(";
    size_t used = 1;
    for (int k = 0; k < MOR_CASE_LOCKS; ++k) {
        if (body->is_locked[k]) {
            used += (size_t)snprintf(value + used, sizeof value - used, "%s\"%s\"", used > 1 ? ", " : "",
                                     mor_case_lock_words[k]);
        }
    }
    if (used > 1) {
        snprintf(value + used, sizeof value - used, ")");
        put_line(w, "locked", value, false);
    }
}

static mor_status write_body(writer *w, const mor_case_body *body)
{
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_body_group, body, judge_body));
    MOR_TRY(w->reader.context, write_shape(w, "shape", &body->outline, "};"));
    MOR_TRY(w->reader.context, write_body_material(w, body));
    write_locks(w, body);
    if (body->has_spring) {
        open_group(w, "spring", "{");
        MOR_TRY(w->reader.context, write_keys(w, &mor_case_spring_group, body, judge_spring));
        close_group(w, "};");
    }
    if (body->clamp != NULL) {
        MOR_TRY(w->reader.context, write_shape(w, "clamp", &body->clamp_outline, "};"));
    }
    if (mor_case_body_condition(body, "start") == NULL) {
        open_group(w, "start", "{");
        MOR_TRY(w->reader.context, write_keys(w, &mor_case_start_group, body, judge_start));
        close_group(w, "};");
    }
    return MOR_OK;
}

/* ---- Probes and expectations ------------------------------------------------------------------------------------- */

static presence judge_probe(const mor_case_key *key, const void *record)
{
    const mor_case_probe *probe = record;
    const mor_case_probe_type *type = mor_case_probe_type_find(probe->type);
    const char *name = key->schema.key;
    for (int k = 0; mor_case_probe_key_names[k] != NULL; ++k) {
        if (strcmp(mor_case_probe_key_names[k], name) == 0 && (type->allowed >> k & 1U) == 0) {
            return OMIT;
        }
    }
    const bool has_measure = (type->allowed & MOR_CASE_PROBE_MEASURE) != 0;
    const bool is_by_thickness = strcmp(probe->measure, "thickness") == 0;
    const bool is_idle = (strcmp(name, "direction") == 0 && probe->is_radial) ||
                         (strcmp(name, "percentile") == 0 && has_measure && is_by_thickness) ||
                         (strcmp(name, "thickness") == 0 && has_measure && !is_by_thickness);
    return is_idle ? OMIT : WRITE;
}

static const char *find_unit(const mor_case *the_case, const char *probe)
{
    for (int k = 0; k < the_case->n_probes; ++k) {
        if (strcmp(the_case->probes[k].name, probe) == 0) {
            return mor_case_probe_unit(mor_case_probe_type_find(the_case->probes[k].type), the_case->dimension);
        }
    }
    return "1";
}

static mor_status write_expectation(const writer *w, const mor_case *the_case, const mor_case_expectation *expectation)
{
    const mor_case_group *group = &mor_case_expectation_group;
    const char *unit = find_unit(the_case, expectation->probe);
    for (int k = 0; group->keys[k].schema.key != NULL; ++k) {
        mor_case_key key = group->keys[k];
        const bool is_tolerance = strncmp(key.schema.key, "tolerance", strlen("tolerance")) == 0;
        if (strcmp(key.schema.key, "value") == 0 || (is_tolerance && expectation->is_absolute)) {
            key.schema.unit = unit;
        }
        char value[VALUE_BYTES];
        MOR_TRY(w->reader.context, print_member(w, &key, (const char *)expectation + key.offset, value, sizeof value));
        put_line(w, key.schema.key, value, (expectation->written >> k & 1) == 0);
    }
    return MOR_OK;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

/* The lists, so that one function writes all of them. */
typedef enum list_kind { SOIL, WALLS, BODIES, PAIRS, PROBES, EXPECT, LIST_COUNT } list_kind;

static mor_status write_entry(writer *w, const mor_case *the_case, list_kind kind, int k)
{
    switch (kind) {
    case SOIL:
        return write_soil(w, &the_case->soils[k]);
    case WALLS:
        return write_wall(w, &the_case->walls[k]);
    case BODIES:
        return write_body(w, &the_case->bodies[k]);
    case PAIRS:
        return write_keys(w, &mor_case_pair_group, &the_case->contact.pairs[k], write_always);
    case PROBES:
        return write_keys(w, &mor_case_probe_group, &the_case->probes[k], judge_probe);
    case EXPECT:
        return write_expectation(w, the_case, &the_case->expectations[k]);
    case LIST_COUNT:
        break;
    }
    return MOR_OK;
}

static mor_status write_list(writer *w, const mor_case *the_case, list_kind kind)
{
    static const char *const names[LIST_COUNT] = {"soil", "walls", "bodies", "pairs", "probes", "expect"};
    const int counts[LIST_COUNT] = {the_case->n_soils,         the_case->n_walls,  the_case->n_bodies,
                                    the_case->contact.n_pairs, the_case->n_probes, the_case->n_expectations};
    if (counts[kind] == 0) {
        return MOR_OK;
    }
    open_group(w, names[kind], "(");
    for (int k = 0; k < counts[kind]; ++k) {
        open_group(w, "", "{");
        MOR_TRY(w->reader.context, write_entry(w, the_case, kind, k));
        close_group(w, k + 1 < counts[kind] ? "}," : "}");
    }
    close_group(w, ");");
    return MOR_OK;
}

/* Without bodies a contact would be refused when read again. */
static mor_status write_contact(writer *w, const mor_case *the_case)
{
    if (the_case->n_bodies == 0) {
        return MOR_OK;
    }
    open_group(w, mor_case_contact_group.name, "{");
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_contact_group, &the_case->contact, write_always));
    MOR_TRY(w->reader.context, write_list(w, the_case, PAIRS));
    close_group(w, "};");
    return MOR_OK;
}

static mor_status write_case(writer *w, const mor_case *the_case)
{
    fprintf(w->stream, "# The case as it was used: every value, in SI, before the scale. \"# default\" marks what the "
                       "case file\n# did not give.\n");
    MOR_TRY(w->reader.context, write_keys(w, &mor_case_root_group, the_case, write_always));
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        open_group(w, group->name, "{");
        MOR_TRY(w->reader.context, write_keys(w, group, the_case, write_always));
        close_group(w, "};");
    }
    for (list_kind kind = SOIL; kind < LIST_COUNT; ++kind) {
        MOR_TRY(w->reader.context, kind == PAIRS ? write_contact(w, the_case) : write_list(w, the_case, kind));
    }
    return MOR_OK;
}

mor_status mor_case_write_stream(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                                 FILE *stream)
{
    mor_units *units = NULL;
    MOR_TRY(context, mor_units_new(context, &units));
    writer w = {.reader = {.context = context,
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
    FILE *stream = fopen(path, "w");
    MOR_CHECK(context, stream != NULL, MOR_ERROR_IO, "%s cannot be opened for writing (%s); check folder and rights",
              path, strerror(errno));
    const mor_status status = mor_case_write_stream(context, the_case, registry, stream);
    const bool has_failed = ferror(stream) != 0;
    const bool is_closed = fclose(stream) == 0;
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    MOR_CHECK(context, !has_failed && is_closed, MOR_ERROR_IO, "%s could not be written whole (%s); free some space",
              path, strerror(errno));
    return MOR_OK;
}
