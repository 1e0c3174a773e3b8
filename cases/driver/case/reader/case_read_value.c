/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_reader.h"

#include "core/material/params.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Single values: from a node and a schema to numbers and members of a record. */

enum {
    PATH_BYTES = MOR_CASE_NODE_TEXT_BYTES,
    RANGE_BYTES = 256,
    ALLOWED_BYTES = 320,
    COMPONENTS_MAX = 9,
    CHOICE_WORDS_MAX = 16
};

/* Beyond these a number is a typing error, and its powers approach the range of double. */
static const double largest_size = 1.0e30;
static const double smallest_size = 1.0e-30;

static const double full_revolution = 6.283185307179586;

/* What a key allows, as text. */
static void describe_allowed(const mor_case_reader *reader, const mor_schema *schema, char *text, size_t text_bytes)
{
    char range[RANGE_BYTES];
    mor_params_range(schema, range, sizeof range);
    switch (schema->kind) {
    case MOR_SCHEMA_BOOLEAN:
        snprintf(text, text_bytes, "true or false");
        return;
    case MOR_SCHEMA_INTEGER:
        snprintf(text, text_bytes, "a whole number %s", range);
        return;
    case MOR_SCHEMA_VECTOR:
        snprintf(text, text_bytes, "%s%d numbers in ( ), each %s", reader->dimension == 2 ? "2 or " : "",
                 schema->n_components, range);
        return;
    case MOR_SCHEMA_TEXT:
        snprintf(text, text_bytes, "a text in quotes");
        return;
    case MOR_SCHEMA_REAL:
    case MOR_SCHEMA_CHOICE:
        snprintf(text, text_bytes, "%s", range);
        return;
    }
}

static mor_status fail_value(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                             const char *why, const char *advice)
{
    char path[PATH_BYTES];
    char found[MOR_CASE_NODE_TEXT_BYTES];
    char allowed[ALLOWED_BYTES];
    mor_case_node_path(node, path, sizeof path);
    mor_case_node_format(node, found, sizeof found);
    describe_allowed(reader, schema, allowed, sizeof allowed);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found %s = %s%s%s; allowed: %s (%s); %s", path, found,
                              why[0] == '\0' ? "" : ", ", why, allowed, schema->text, advice);
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static mor_status convert_text(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                               double *value)
{
    const mor_status status = mor_units_convert(reader->context, reader->units, node->text, schema->unit, value);
    if (status == MOR_OK || status == MOR_ERROR_INTERNAL) {
        return status;
    }
    char why[ALLOWED_BYTES];
    char advice[ALLOWED_BYTES];
    snprintf(why, sizeof why, "%.200s", reader->context->message);
    double weight = 0.0;
    if (strcmp(schema->unit, "1") == 0) {
        snprintf(advice, sizeof advice, "write a plain number");
    } else if (strcmp(schema->unit, "kg/m3") == 0 &&
               mor_units_convert(reader->context, reader->units, node->text, "N/m3", &weight) == MOR_OK) {
        snprintf(advice, sizeof advice, "a unit weight is a density times gravity: write \"%.5g kg/m3\" for 9.81 m/s2",
                 weight / 9.81);
    } else {
        snprintf(advice, sizeof advice, "write a number, or a number and a unit that converts to %s", schema->unit);
    }
    return fail_value(reader, node, schema, why, advice);
}

/* A number without a unit, in quotes or not. */
static bool is_bare(const mor_case_node *node)
{
    if (node->kind != MOR_CASE_NODE_TEXT) {
        return true;
    }
    char *end = NULL;
    strtod(node->text, &end);
    return end[strspn(end, " \t")] == '\0';
}

/* A bare angle beyond a full revolution is certainly in degrees, and read as radians it would give a wrong rotation. */
static mor_status refuse_bare_angle(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                                    double value)
{
    char advice[ALLOWED_BYTES];
    snprintf(advice, sizeof advice, "write \"%.6g deg\", or \"%.6g rad\" if radians are intended", value, value);
    return fail_value(reader, node, schema, "an angle of more than a full revolution, 2 pi, without its unit", advice);
}

static mor_status check_range(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                              double value)
{
    if (!isfinite(value) || fabs(value) > largest_size) {
        return fail_value(reader, node, schema, "which is not finite or above 1e30 in magnitude", "correct the number");
    }
    if (value != 0.0 && fabs(value) < smallest_size) {
        return fail_value(reader, node, schema, "which is neither zero nor above 1e-30 in magnitude",
                          "correct the number");
    }
    const bool is_above = schema->excludes_minimum ? value > schema->minimum : value >= schema->minimum;
    const bool is_below = schema->excludes_maximum ? value < schema->maximum : value <= schema->maximum;
    const bool is_bare_angle = strcmp(schema->unit, "rad") == 0 && is_bare(node);
    if (is_above && is_below && is_bare_angle && fabs(value) > full_revolution) {
        return refuse_bare_angle(reader, node, schema, value);
    }
    if (!is_above || !is_below) {
        return fail_value(reader, node, schema, "out of range",
                          is_bare_angle ? "write degrees with their unit, as \"30 deg\"" : "correct the value");
    }
    return MOR_OK;
}

static mor_status read_real(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                            double *value)
{
    if (node->kind == MOR_CASE_NODE_INTEGER || node->kind == MOR_CASE_NODE_REAL) {
        *value = node->real;
    } else if (node->kind == MOR_CASE_NODE_TEXT) {
        MOR_TRY(reader->context, convert_text(reader, node, schema, value));
    } else {
        return fail_value(reader, node, schema, "which is no number", "write a number, or a text with number and unit");
    }
    return check_range(reader, node, schema, *value);
}

/* A list whose values have units without quotes is parsed as a text; shows how to write it. */
static mor_status refuse_bare_list(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema)
{
    char advice[ALLOWED_BYTES];
    char meant[RANGE_BYTES] = "";
    size_t used = 0;
    const char *item = node->text + 1;
    while (*item != '\0' && *item != ')' && used + 4 < sizeof meant) {
        item += strspn(item, " \t,");
        size_t length = strcspn(item, ",)");
        const char *end = item + length;
        while (length > 0 && (item[length - 1] == ' ' || item[length - 1] == '\t')) {
            --length;
        }
        const int n =
            snprintf(meant + used, sizeof meant - used, "%s\"%.*s\"", used > 0 ? ", " : "", (int)length, item);
        used += n > 0 ? (size_t)n : 0;
        item = end;
    }
    snprintf(advice, sizeof advice, "put each value with a unit in quotes: (%s)", meant);
    return fail_value(reader, node, schema, "", advice);
}

static mor_status read_vector(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                              double *values)
{
    const bool may_be_flat = reader->dimension == 2 && schema->n_components == 3;
    if (node->kind == MOR_CASE_NODE_TEXT && node->text[0] == '(' && strchr(node->text, '"') == NULL) {
        return refuse_bare_list(reader, node, schema);
    }
    if (node->kind != MOR_CASE_NODE_LIST ||
        (node->n_children != schema->n_components && !(may_be_flat && node->n_children == 2))) {
        return fail_value(reader, node, schema, "", "write one number for each direction");
    }
    values[schema->n_components - 1] = 0.0;
    int k = 0;
    for (const mor_case_node *child = node->first_child; child != NULL; child = child->next) {
        mor_schema component = *schema;
        component.kind = MOR_SCHEMA_REAL;
        MOR_TRY(reader->context, read_real(reader, child, &component, &values[k++]));
    }
    return MOR_OK;
}

static mor_status read_choice(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                              double *value)
{
    const int index = node->kind == MOR_CASE_NODE_TEXT ? mor_params_choice(schema->choices, node->text) : -1;
    *value = (double)index;
    if (index >= 0) {
        return MOR_OK;
    }
    char storage[CHOICE_WORDS_MAX][MOR_CASE_NAME_BYTES];
    const char *words[CHOICE_WORDS_MAX];
    const int n_all = mor_params_choice(schema->choices, NULL);
    const int n_words = n_all < CHOICE_WORDS_MAX ? n_all : CHOICE_WORDS_MAX;
    for (int k = 0; k < n_words; ++k) {
        mor_params_word(schema->choices, k, storage[k], sizeof storage[k]);
        words[k] = storage[k];
    }
    return mor_case_reader_refuse(reader, node, schema->text, words, n_words);
}

mor_status mor_case_reader_scale(const mor_case_reader *reader, const char *unit, double *values, int n, int sign)
{
    mor_dimension dimension;
    MOR_CHECK(reader->context, mor_units_dimension(reader->context, reader->units, unit, &dimension) == MOR_OK,
              MOR_ERROR_INTERNAL, "the unit '%s' of a schema is not a unit; correct the schema", unit);
    const int power =
        mor_dimension_scale(&dimension, reader->length_power, reader->mass_power, reader->time_power) * sign;
    for (int k = 0; k < n; ++k) {
        values[k] = ldexp(values[k], power);
    }
    return MOR_OK;
}

mor_status mor_case_reader_numbers(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                                   bool keeps_scale, double *values)
{
    switch (schema->kind) {
    case MOR_SCHEMA_REAL:
        MOR_TRY(reader->context, read_real(reader, node, schema, values));
        break;
    case MOR_SCHEMA_VECTOR:
        MOR_TRY(reader->context, read_vector(reader, node, schema, values));
        break;
    case MOR_SCHEMA_INTEGER:
        if (node->kind != MOR_CASE_NODE_INTEGER) {
            return fail_value(reader, node, schema, "which is no whole number", "write digits only");
        }
        values[0] = node->real;
        return check_range(reader, node, schema, values[0]);
    case MOR_SCHEMA_BOOLEAN:
        if (node->kind != MOR_CASE_NODE_BOOLEAN) {
            return fail_value(reader, node, schema, "", "write true or false, without quotes");
        }
        values[0] = node->truth ? 1.0 : 0.0;
        return MOR_OK;
    case MOR_SCHEMA_CHOICE:
        return read_choice(reader, node, schema, values);
    case MOR_SCHEMA_TEXT:
        return MOR_FAIL(reader->context, MOR_ERROR_INTERNAL, "key '%s' is a text, not a number; correct its schema",
                        schema->key);
    }
    return keeps_scale ? MOR_OK : mor_case_reader_scale(reader, schema->unit, values, schema->n_components, 1);
}

/* ---- Members of a record ----------------------------------------------------------------------------------------- */

static mor_status read_text(const mor_case_reader *reader, const mor_case_node *node, const mor_case_key *key,
                            char *text)
{
    const mor_schema *schema = &key->schema;
    if (node->kind != MOR_CASE_NODE_TEXT) {
        return fail_value(reader, node, schema, "which is no text", "put it into double quotes");
    }
    const size_t length = strlen(node->text);
    if (length >= key->size) {
        char why[ALLOWED_BYTES];
        snprintf(why, sizeof why, "%zu bytes long where fewer than %zu fit", length, key->size);
        return fail_value(reader, node, schema, why, "shorten it");
    }
    for (const char *c = node->text; *c != '\0'; ++c) {
        if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            return fail_value(reader, node, schema, "which has a control character", "write one line of plain text");
        }
    }
    const char *name_bytes = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    if (key->storage == MOR_CASE_STORE_NAME && (length == 0 || node->text[strspn(node->text, name_bytes)] != '\0')) {
        return fail_value(reader, node, schema, "which is no name", "use letters, digits, '_' and '-' only");
    }
    memcpy(text, node->text, length + 1);
    return MOR_OK;
}

static void store_numbers(const mor_case_key *key, const double *values, void *member)
{
    switch (key->storage) {
    case MOR_CASE_STORE_REALS:
        memcpy(member, values, (size_t)key->schema.n_components * sizeof *values);
        return;
    case MOR_CASE_STORE_INT:
    case MOR_CASE_STORE_CHOICE:
        memcpy(member, &(int){(int)values[0]}, sizeof(int));
        return;
    case MOR_CASE_STORE_SEED:
        memcpy(member, &(uint64_t){(uint64_t)values[0]}, sizeof(uint64_t));
        return;
    case MOR_CASE_STORE_BOOL:
        memcpy(member, &(bool){values[0] == 1.0}, sizeof(bool));
        return;
    case MOR_CASE_STORE_WORD:
        mor_params_word(key->schema.choices, (int)values[0], member, key->size);
        return;
    case MOR_CASE_STORE_TEXT:
    case MOR_CASE_STORE_NAME:
        return;
    }
}

static mor_status read_key(const mor_case_reader *reader, const mor_case_node *node, const mor_case_key *key,
                           void *member)
{
    if (key->storage == MOR_CASE_STORE_TEXT || key->storage == MOR_CASE_STORE_NAME) {
        return read_text(reader, node, key, member);
    }
    double values[COMPONENTS_MAX];
    const mor_schema schema = mor_case_key_schema(key, reader->dimension);
    MOR_TRY(reader->context, mor_case_reader_numbers(reader, node, &schema, key->keeps_scale, values));
    if (key->is_direction && values[0] == 0.0 && values[1] == 0.0 && values[2] == 0.0) {
        return fail_value(reader, node, &schema, "a direction of length zero", "give it a length");
    }
    store_numbers(key, values, member);
    if (key->storage == MOR_CASE_STORE_SEED) {
        /* Through double a long seed would lose its last digits. */
        memcpy(member, &(uint64_t){(uint64_t)node->integer}, sizeof(uint64_t));
    }
    return MOR_OK;
}

static mor_status store_default(const mor_case_reader *reader, const mor_case_key *key, void *member)
{
    double values[COMPONENTS_MAX];
    const mor_schema schema = mor_case_key_schema(key, reader->dimension);
    if (key->shares_member) {
        return MOR_OK;
    }
    for (int k = 0; k < schema.n_components; ++k) {
        values[k] = mor_case_key_default(key, reader->scheme);
    }
    if (!key->keeps_scale) {
        MOR_TRY(reader->context, mor_case_reader_scale(reader, schema.unit, values, schema.n_components, 1));
    }
    if (key->storage == MOR_CASE_STORE_BOOL || key->storage == MOR_CASE_STORE_REALS || !isnan(values[0])) {
        store_numbers(key, values, member);
    }
    return MOR_OK;
}

/* The node of a key, also under the name that the key had in earlier versions. A setting of the command line takes
 * precedence over the case file under either name. */
static mor_status find_key(const mor_case_reader *reader, const mor_case_node *node, const mor_case_key *key,
                           const mor_case_node **found)
{
    *found = mor_case_node_find(node, key->schema.key);
    const mor_case_node *former = key->former == NULL ? NULL : mor_case_node_find(node, key->former);
    if (former == NULL) {
        return MOR_OK;
    }
    char place[MOR_CASE_PLACE_BYTES];
    mor_case_node_place(former, place, sizeof place);
    mor_context_log(reader->context, MOR_LOG_WARNING,
                    "%s: '%s' is named '%s' now; the old name still works in this version; rename it", place,
                    key->former, key->schema.key);
    const bool is_former_set = former->line == 0;
    if (*found != NULL && ((*found)->line == 0) == is_former_set) {
        return MOR_CASE_NODE_FAIL(reader->context, former,
                                  "found both '%s' and '%s', its name now; allowed: one; "
                                  "remove '%s'",
                                  key->former, key->schema.key, key->former);
    }
    *found = *found == NULL || is_former_set ? former : *found;
    return MOR_OK;
}

mor_status mor_case_reader_group(const mor_case_reader *reader, const mor_case_node *node, const mor_case_group *group,
                                 void *record)
{
    uint64_t written = 0;
    for (int k = 0; group->keys[k].schema.key != NULL; ++k) {
        const mor_case_key *key = &group->keys[k];
        void *member = (char *)record + key->offset;
        const mor_case_node *child = NULL;
        MOR_TRY(reader->context, find_key(reader, node, key, &child));
        if (child != NULL) {
            MOR_TRY(reader->context, read_key(reader, child, key, member));
            written |= (uint64_t)1 << k;
        } else if (key->schema.is_required) {
            char range[ALLOWED_BYTES];
            char allowed[MOR_CONTEXT_MESSAGE_BYTES];
            const mor_schema schema = mor_case_key_schema(key, reader->dimension);
            describe_allowed(reader, &schema, range, sizeof range);
            snprintf(allowed, sizeof allowed, "%s (%s)", range, key->schema.text);
            return mor_case_reader_refuse_missing(reader, node, key->schema.key, allowed);
        } else {
            MOR_TRY(reader->context, store_default(reader, key, member));
        }
    }
    memcpy((char *)record + group->written_offset, &written, sizeof written);
    return MOR_OK;
}

bool mor_case_reader_has(const mor_case_group *group, uint64_t written, const char *name)
{
    const int k = mor_case_key_find(group->keys, name);
    return k >= 0 && (written >> k & 1) != 0;
}

void mor_case_reader_place(const mor_case_node *node, mor_case_place *place)
{
    snprintf(place->file, sizeof place->file, "%s", node->origin);
    place->line = node->line;
}
