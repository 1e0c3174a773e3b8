/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/params.h"

#include "core/base/math.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { RANGE_BYTES = 256, WORD_BYTES = 64, FAULT_BYTES = 512 };

int mor_params_entries(const mor_schema *schema)
{
    int n = 0;
    while (schema[n].key != NULL) {
        ++n;
    }
    return n;
}

int mor_params_count(const mor_schema *schema)
{
    return mor_params_offset(schema, mor_params_entries(schema));
}

int mor_params_find(const mor_schema *schema, const char *key)
{
    for (int entry = 0; schema[entry].key != NULL; ++entry) {
        if (strcmp(schema[entry].key, key) == 0) {
            return entry;
        }
    }
    return -1;
}

int mor_params_offset(const mor_schema *schema, int entry)
{
    int offset = 0;
    for (int k = 0; k < entry; ++k) {
        offset += schema[k].n_components;
    }
    return offset;
}

/* Text and unit of each role. */
static const struct {
    const char *text, *unit, *symbol;
} ROLES[MOR_ROLE_COUNT] = {
    [MOR_ROLE_NONE] = {"", "", NULL},
    [MOR_ROLE_YOUNGS_MODULUS] = {"Young's modulus E", "Pa", "E"},
    [MOR_ROLE_POISSONS_RATIO] = {"Poisson's ratio nu", "1", "nu"},
    [MOR_ROLE_SHEAR_MODULUS] = {"shear modulus G", "Pa", "G"},
    [MOR_ROLE_BULK_MODULUS] = {"bulk modulus K", "Pa", "K"},
    [MOR_ROLE_FRICTION_ANGLE] = {"friction angle phi", "rad", "phi"},
    [MOR_ROLE_COHESION] = {"cohesion c", "Pa", "c"},
    [MOR_ROLE_DILATION_ANGLE] = {"dilation angle psi", "rad", "psi"},
    [MOR_ROLE_TENSION_RATIO] = {"tension ratio", "1", NULL},
    [MOR_ROLE_INTEGRATION_METHOD] = {"method of integration", "1", NULL},
    [MOR_ROLE_RELATIVE_TOLERANCE] = {"relative tolerance of the integration", "1", NULL},
    [MOR_ROLE_ABSOLUTE_TOLERANCE] = {"absolute tolerance of the integration", "Pa", NULL},
    [MOR_ROLE_SUB_STEPS_MAX] = {"largest number of sub-steps", "1", NULL},
    [MOR_ROLE_GAS_DENSITY_RATIO] = {"gas density ratio", "1", NULL},
    [MOR_ROLE_FIELD_TIME_SCALE] = {"time scale of the field", "s", NULL},
    [MOR_ROLE_RESIDUAL_FRICTION_ANGLE] = {"residual friction angle", "rad", NULL},
    [MOR_ROLE_RESIDUAL_COHESION] = {"residual cohesion", "Pa", NULL},
    [MOR_ROLE_RESIDUAL_DILATION_ANGLE] = {"residual dilation angle", "rad", NULL},
};

const char *mor_role_text(mor_role role)
{
    return ROLES[role].text;
}

const char *mor_role_unit(mor_role role)
{
    return ROLES[role].unit;
}

int mor_params_find_role(const mor_schema *schema, mor_role role)
{
    for (int entry = 0; schema[entry].key != NULL; ++entry) {
        if (schema[entry].role == role) {
            return entry;
        }
    }
    return -1;
}

int mor_params_find_symbol(const mor_schema *schema, const char *symbol)
{
    for (int role = MOR_ROLE_NONE + 1; role < MOR_ROLE_COUNT; ++role) {
        if (ROLES[role].symbol != NULL && strcmp(ROLES[role].symbol, symbol) == 0) {
            return mor_params_find_role(schema, (mor_role)role);
        }
    }
    return -1;
}

double mor_params_role_value(const mor_schema *schema, const double *values, mor_role role, double fallback)
{
    const int entry = mor_params_find_role(schema, role);
    return entry < 0 ? fallback : values[mor_params_offset(schema, entry)];
}

double mor_params_youngs_modulus(const mor_schema *schema, const double *values, double fallback)
{
    const double shear = mor_params_role_value(schema, values, MOR_ROLE_SHEAR_MODULUS, NAN);
    const double bulk = mor_params_role_value(schema, values, MOR_ROLE_BULK_MODULUS, NAN);
    const double derived = 9.0 * bulk * shear / (3.0 * bulk + shear);
    return mor_params_role_value(schema, values, MOR_ROLE_YOUNGS_MODULUS, isnan(derived) ? fallback : derived);
}

const char *mor_params_stiffness_key(const mor_schema *schema)
{
    const int youngs = mor_params_find_role(schema, MOR_ROLE_YOUNGS_MODULUS);
    const int entry = youngs >= 0 ? youngs : mor_params_find_role(schema, MOR_ROLE_BULK_MODULUS);
    return entry >= 0 ? schema[entry].key : "its stiffness";
}

int mor_params_choice(const char *choices, const char *word)
{
    const char *start = choices;
    for (int index = 0;; ++index) {
        const size_t length = strcspn(start, "|");
        if (word != NULL && strlen(word) == length && strncmp(start, word, length) == 0) {
            return index;
        }
        if (start[length] == '\0') {
            return word != NULL ? -1 : index + 1;
        }
        start += length + 1;
    }
}

void mor_params_word(const char *choices, int index, char *word, size_t word_bytes)
{
    const char *start = choices;
    for (int k = 0; k < index && start[0] != '\0'; ++k) {
        start += strcspn(start, "|");
        start += start[0] == '|';
    }
    const int length = index < 0 ? 0 : (int)strcspn(start, "|");
    snprintf(word, word_bytes, "%.*s", length, start);
}

void mor_params_defaults(const mor_schema *schema, double *values)
{
    for (const mor_schema *entry = schema; entry->key != NULL; ++entry) {
        const double choice_default = entry->kind == MOR_SCHEMA_CHOICE ? 0.0 : entry->default_value;
        for (int a = 0; a < entry->n_components; ++a) {
            *values++ = entry->is_required ? NAN : choice_default;
        }
    }
}

/* Bounds in multiples of a size, with its name. */
static void format_bounds(const mor_schema *entry, double size, const char *unit, char *text, size_t text_bytes)
{
    const char *space = unit[0] == '\0' ? "" : " ";
    const int has_minimum = isfinite(entry->minimum);
    const int has_maximum = isfinite(entry->maximum);
    const double minimum = entry->minimum / size;
    const double maximum = entry->maximum / size;
    if (has_minimum && has_maximum) {
        snprintf(text, text_bytes, "in %c%g, %g%c%s%s", entry->excludes_minimum ? '(' : '[', minimum, maximum,
                 entry->excludes_maximum ? ')' : ']', space, unit);
    } else if (has_minimum) {
        snprintf(text, text_bytes, "%s %g%s%s", entry->excludes_minimum ? ">" : ">=", minimum, space, unit);
    } else if (has_maximum) {
        snprintf(text, text_bytes, "%s %g%s%s", entry->excludes_maximum ? "<" : "<=", maximum, space, unit);
    } else {
        snprintf(text, text_bytes, "any finite number%s%s", space, unit);
    }
}

void mor_params_range(const mor_schema *entry, char *text, size_t text_bytes)
{
    const double degree = MOR_PI / 180.0;
    const int is_bounded = isfinite(entry->minimum) || isfinite(entry->maximum);
    if (entry->kind == MOR_SCHEMA_CHOICE) {
        snprintf(text, text_bytes, "one of %s", entry->choices);
    } else if (entry->kind == MOR_SCHEMA_BOOLEAN) {
        snprintf(text, text_bytes, "0 or 1");
    } else if (strcmp(entry->unit, "rad") == 0 && is_bounded) {
        /* People write degrees; a number without a unit is in radians. */
        char degrees[RANGE_BYTES];
        char radians[RANGE_BYTES];
        format_bounds(entry, degree, "deg", degrees, sizeof degrees);
        format_bounds(entry, 1.0, "rad", radians, sizeof radians);
        snprintf(text, text_bytes, "%s, or %s", degrees, radians);
    } else {
        format_bounds(entry, 1.0, strcmp(entry->unit, "1") == 0 ? "" : entry->unit, text, text_bytes);
    }
}

static int is_value_allowed(const mor_schema *entry, double value)
{
    const int is_whole = value == floor(value);
    switch (entry->kind) {
    case MOR_SCHEMA_CHOICE:
        return is_whole && value >= 0.0 && value < (double)mor_params_choice(entry->choices, NULL);
    case MOR_SCHEMA_BOOLEAN:
        return value == 0.0 || value == 1.0;
    case MOR_SCHEMA_TEXT:
        return 0;
    case MOR_SCHEMA_INTEGER:
    case MOR_SCHEMA_REAL:
    case MOR_SCHEMA_VECTOR:
        break;
    }
    const int is_above = entry->excludes_minimum ? value > entry->minimum : value >= entry->minimum;
    const int is_below = entry->excludes_maximum ? value < entry->maximum : value <= entry->maximum;
    return isfinite(value) && is_above && is_below && (entry->kind != MOR_SCHEMA_INTEGER || is_whole);
}

mor_status mor_params_check(mor_context *context, const mor_schema *schema, const char *owner, const double *values)
{
    for (const mor_schema *entry = schema; entry->key != NULL; ++entry) {
        for (int a = 0; a < entry->n_components; ++a) {
            const double value = *values++;
            if (is_value_allowed(entry, value)) {
                continue;
            }
            char range[RANGE_BYTES];
            mor_params_range(entry, range, sizeof range);
            const char *advice = isnan(value) && entry->is_required ? "; it is required: give it a value" : "";
            return MOR_FAIL(context, MOR_ERROR_ARGUMENT, "%s: %s is %.17g%s%s; allowed: %s%s", owner, entry->key, value,
                            strcmp(entry->unit, "1") == 0 ? "" : " ", strcmp(entry->unit, "1") == 0 ? "" : entry->unit,
                            range, advice);
        }
    }
    return MOR_OK;
}

static int is_key_wellformed(const char *key)
{
    return key[0] >= 'a' && key[0] <= 'z' && key[strspn(key, "abcdefghijklmnopqrstuvwxyz0123456789_")] == '\0';
}

static const char *const KIND_WORDS[] = {
    [MOR_SCHEMA_REAL] = "a real number",    [MOR_SCHEMA_INTEGER] = "a whole number",
    [MOR_SCHEMA_BOOLEAN] = "true or false", [MOR_SCHEMA_TEXT] = "a text",
    [MOR_SCHEMA_CHOICE] = "a choice",       [MOR_SCHEMA_VECTOR] = "a vector"};

/* Returns what is wrong with the role of an entry, in text of FAULT_BYTES; NULL when nothing is. */
static const char *find_role_fault(const mor_schema *schema, const mor_schema *entry, char *text)
{
    if ((int)entry->role < MOR_ROLE_NONE || entry->role >= MOR_ROLE_COUNT) {
        return "its role must be one of MOR_ROLE_...";
    }
    if (entry->role == MOR_ROLE_NONE) {
        return NULL;
    }
    const mor_schema *first = &schema[mor_params_find_role(schema, entry->role)];
    if (first != entry) {
        snprintf(text, FAULT_BYTES, "entry '%s' has the same role, %s; give it to one of them", first->key,
                 mor_role_text(entry->role));
        return text;
    }
    const mor_schema_kind kind = entry->role == MOR_ROLE_INTEGRATION_METHOD ? MOR_SCHEMA_CHOICE
                                 : entry->role == MOR_ROLE_SUB_STEPS_MAX    ? MOR_SCHEMA_INTEGER
                                                                            : MOR_SCHEMA_REAL;
    if (entry->kind != kind || strcmp(entry->unit, mor_role_unit(entry->role)) != 0) {
        snprintf(
            text, FAULT_BYTES,
            "it is %s in \"%s\", but its role, %s, needs %s in \"%s\", the unit of the role; change that, or leave "
            "the role out",
            KIND_WORDS[entry->kind], entry->unit, mor_role_text(entry->role), KIND_WORDS[kind],
            mor_role_unit(entry->role));
        return text;
    }
    return NULL;
}

static int is_text_present(const char *text)
{
    return text != NULL && text[0] != '\0';
}

/* Returns what is wrong with one entry, perhaps in text of FAULT_BYTES; NULL when nothing is. */
static const char *find_entry_fault(const mor_schema *schema, const mor_schema *entry, char *text)
{
    if (!is_key_wellformed(entry->key)) {
        return "its key must be lower-case letters, digits and '_', a letter first";
    }
    if (mor_params_find(schema, entry->key) != (int)(entry - schema)) {
        return "its key stands twice";
    }
    if (!is_text_present(entry->unit) || !is_text_present(entry->text)) {
        return "it needs a unit (\"1\" when dimensionless) and a text";
    }
    if ((int)entry->kind < MOR_SCHEMA_REAL || entry->kind > MOR_SCHEMA_VECTOR || entry->kind == MOR_SCHEMA_TEXT) {
        return "its kind must be real, integer, boolean, choice or vector";
    }
    const int most_components = entry->kind == MOR_SCHEMA_VECTOR ? 9 : 1;
    if (entry->n_components < 1 || entry->n_components > most_components) {
        return "n_components must be 1, or 1 to 9 for a vector";
    }
    if (entry->kind == MOR_SCHEMA_CHOICE) {
        return is_text_present(entry->choices) ? find_role_fault(schema, entry, text) : "a choice needs its words";
    }
    if (entry->kind == MOR_SCHEMA_BOOLEAN) {
        return is_value_allowed(entry, entry->default_value) ? NULL : "its default must be 0 or 1";
    }
    if (!(entry->minimum <= entry->maximum)) {
        return "its minimum must not exceed its maximum (use -INFINITY and INFINITY for none)";
    }
    if (!entry->is_required && !is_value_allowed(entry, entry->default_value)) {
        return "its default is out of its own range";
    }
    return find_role_fault(schema, entry, text);
}

mor_status mor_params_verify_schema(mor_context *context, const mor_schema *schema, const char *owner, int n_max)
{
    MOR_CHECK(context, schema != NULL, MOR_ERROR_PLUGIN, "%s: the schema is missing; give a table ended by key NULL",
              owner);
    int n_values = 0;
    for (int k = 0; schema[k].key != NULL; ++k) {
        MOR_CHECK(context, k < n_max, MOR_ERROR_PLUGIN, "%s: the schema has more than %d entries, or no end (key NULL)",
                  owner, n_max);
        char text[FAULT_BYTES];
        const char *fault = find_entry_fault(schema, &schema[k], text);
        MOR_CHECK(context, fault == NULL, MOR_ERROR_PLUGIN, "%s: schema entry %d ('%s') is wrong: %s", owner, k,
                  schema[k].key, fault);
        n_values += schema[k].n_components;
    }
    MOR_CHECK(context, n_values <= n_max, MOR_ERROR_PLUGIN, "%s: the schema has %d values; at most %d are allowed",
              owner, n_values, n_max);
    return MOR_OK;
}

static void format_entry(const mor_schema *entry, const double *values, char *line, size_t line_bytes)
{
    char numbers[RANGE_BYTES] = "";
    size_t used = 0;
    for (int a = 0; a < entry->n_components && used < sizeof numbers; ++a) {
        used += (size_t)snprintf(numbers + used, sizeof numbers - used, "%s%.17g", a == 0 ? "" : ", ", values[a]);
    }
    if (entry->kind == MOR_SCHEMA_CHOICE) {
        mor_params_word(entry->choices, (int)values[0], numbers, WORD_BYTES);
    } else if (entry->kind == MOR_SCHEMA_BOOLEAN) {
        snprintf(numbers, sizeof numbers, "%s", values[0] != 0.0 ? "true" : "false");
    }
    const int has_unit = strcmp(entry->unit, "1") != 0;
    snprintf(line, line_bytes, "%s = %s%s%s\n", entry->key, numbers, has_unit ? " " : "", has_unit ? entry->unit : "");
}

void mor_params_format(const mor_schema *schema, const double *values, char *text, size_t text_bytes)
{
    text[0] = '\0';
    size_t used = 0;
    for (const mor_schema *entry = schema; entry->key != NULL && used + 1 < text_bytes; ++entry) {
        format_entry(entry, values, text + used, text_bytes - used);
        used += strlen(text + used);
        values += entry->n_components;
    }
}
