/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_settings.h"

#include "core/base/math.h"
#include "core/base/nearest.h"
#include "core/base/number.h"
#include "core/base/units.h"
#include "core/material/params.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { KEY_BYTES = 128, NAMES_MAX = 128, COMPONENTS_MAX = 9, CYCLES_MAX = 1000, STEPS_MAX = 1000000 };

static const double default_tolerance = 1e-9;
static const double full_revolution = 2.0 * MOR_PI;

/* ---- Keys of the test -------------------------------------------------------------------------------------------- */

/* A number of the test and where it goes. */
typedef struct number_key {
    mor_schema schema;
    size_t offset; /* in mor_element_settings; of a double or, for whole numbers, an int */
} number_key;

#define REAL(member, name, its_unit, standard, low, excludes, high, words)                                             \
    {                                                                                                                  \
        .schema = {.key = (name),                                                                                      \
                   .kind = MOR_SCHEMA_REAL,                                                                            \
                   .n_components = 1,                                                                                  \
                   .unit = (its_unit),                                                                                 \
                   .default_value = (standard),                                                                        \
                   .minimum = (low),                                                                                   \
                   .maximum = (high),                                                                                  \
                   .excludes_minimum = (excludes),                                                                     \
                   .text = (words)},                                                                                   \
        .offset = offsetof(mor_element_settings, member)                                                               \
    }
#define WHOLE(member, name, standard, high, words)                                                                     \
    {                                                                                                                  \
        .schema = {.key = (name),                                                                                      \
                   .kind = MOR_SCHEMA_INTEGER,                                                                         \
                   .n_components = 1,                                                                                  \
                   .unit = "1",                                                                                        \
                   .default_value = (standard),                                                                        \
                   .minimum = 1.0,                                                                                     \
                   .maximum = (high),                                                                                  \
                   .text = (words)},                                                                                   \
        .offset = offsetof(mor_element_settings, member)                                                               \
    }

static const number_key numbers[] = {
    REAL(k0, "k0", "1", 1.0, 0.0, 0, 100.0, "lateral over axial stress at the start"),
    REAL(rate, "rate", "1/s", 0.01, 0.0, 1, INFINITY, "strain rate; of no effect on laws without rate effects"),
    WHOLE(n_steps, "steps", 500.0, STEPS_MAX, "steps for the strain, once; rows of the table"),
    WHOLE(n_cycles, "cycles", 10.0, CYCLES_MAX, "cycles of a cyclic path"),
    REAL(b, "b", "1", 0.5, 0.0, 0, 1.0, "intermediate stress of true-triaxial, (yy - xx) / (zz - xx)"),
    REAL(amplitude, "amplitude", "Pa", NAN, 0.0, 1, INFINITY,
         "of a cyclic path, in place of a strain: it turns where deviator or shear stress are off the start by this"),
    REAL(void_ratio, "void_ratio", "1", NAN, 0.0, 1, 30.0, "void ratio at the start, for the table and the chart"),
    REAL(tolerance, "tolerance", "1", default_tolerance, 1e-12, 0, 1e-2, "error of a stress that is held, relative"),
};

enum { N_NUMBERS = sizeof numbers / sizeof *numbers };

static const struct {
    const char *key;
    const char *text;
} word_keys[] = {
    {"path", "how the specimen is deformed: one of the paths"},
    {"stress", "axial stress at the start, >= 0 Pa; several specimens: '100 kPa, 200 kPa'; default 100 kPa"},
    {"strain", "how far: axial or shear strain, or the angle of spin; default 0.1, of cyclic paths 0.01, of spin a "
               "turn; with test.amplitude the strain within which that stress is to be reached"},
    {"control", "in place of a path, six parts for xx, yy, zz, xy, yz, zx: a number, the strain rate as a multiple of "
                "test.rate (tension positive); 'stress', which is kept; 'stress 10 kPa/s', which changes"},
    {"data", "measured values to be drawn as well: a table with columns named as in the results"},
    {"case", "a case whose soil gives law, density and parameters"},
    {"soil", "name of that soil; may be left out where there is one"},
    {"replay", "in place of a test: repeats the stress update that a run failed at, from its failed-point.cfg"},
};

enum { N_WORDS = sizeof word_keys / sizeof *word_keys };

static const mor_schema stress_schema = {.key = "stress",
                                         .kind = MOR_SCHEMA_REAL,
                                         .n_components = 1,
                                         .unit = "Pa",
                                         .minimum = 0.0,
                                         .maximum = INFINITY,
                                         .text = "axial stress at the start"};

static const mor_schema strain_schema = {.key = "strain",
                                         .kind = MOR_SCHEMA_REAL,
                                         .n_components = 1,
                                         .unit = "1",
                                         .minimum = 0.0,
                                         .maximum = 100.0,
                                         .excludes_minimum = 1,
                                         .text = "strain at the end, or amplitude"};

static const mor_schema angle_schema = {.key = "strain",
                                        .kind = MOR_SCHEMA_REAL,
                                        .n_components = 1,
                                        .unit = "rad",
                                        .minimum = 0.0,
                                        .maximum = 100.0,
                                        .excludes_minimum = 1,
                                        .text = "angle of the rotation"};

static const mor_schema density_schema = {.key = "density",
                                          .kind = MOR_SCHEMA_REAL,
                                          .n_components = 1,
                                          .unit = "kg/m3",
                                          .minimum = 0.0,
                                          .maximum = INFINITY,
                                          .excludes_minimum = 1,
                                          .text = "density at the start"};

/* ---- Reading one value ------------------------------------------------------------------------------------------- */

/* What the parts of reading share. */
typedef struct reader {
    mor_context *context;
    mor_units *units;
    const mor_material *material;
    const mor_element_names *names;
    const char *const *list;
    int n;
} reader;

/* A key as the user writes it. */
static const char *name_of(const reader *r, const char *key)
{
    return mor_element_names_find(r->names, key);
}

static mor_status refuse_value(const reader *r, const char *key, const char *text, const mor_schema *schema,
                               const char *why)
{
    char range[256];
    mor_params_range(schema, range, sizeof range);
    return MOR_FAIL(r->context, MOR_ERROR_CONFIG, "found %s = '%s'%s%s; allowed: %s (%s); correct the value",
                    name_of(r, key), text, why[0] != '\0' ? ", " : "", why, range, schema->text);
}

static mor_status read_number(const reader *r, const char *key, const char *text, const mor_schema *schema,
                              double *value)
{
    const mor_status status = mor_units_convert(r->context, r->units, text, schema->unit, value);
    if (status == MOR_ERROR_ARGUMENT) {
        char why[256];
        snprintf(why, sizeof why, "%.255s", r->context->message);
        return refuse_value(r, key, text, schema, why);
    }
    MOR_TRY(r->context, status);
    const bool is_above = schema->excludes_minimum ? *value > schema->minimum : *value >= schema->minimum;
    const bool is_below = schema->excludes_maximum ? *value < schema->maximum : *value <= schema->maximum;
    const bool is_whole = schema->kind != MOR_SCHEMA_INTEGER || floor(*value) == *value;
    if (!isfinite(*value) || !is_above || !is_below || !is_whole) {
        return refuse_value(r, key, text, schema, is_whole ? "out of range" : "which is no whole number");
    }
    return MOR_OK;
}

/* Copies the next part of a list, up to a comma or its end, without blanks around it. Returns what follows; NULL behind
 * the last part. */
static const char *take_part(const char *list, char *part, size_t part_bytes)
{
    if (list == NULL) {
        return NULL;
    }
    list += strspn(list, " \t(");
    size_t length = strcspn(list, ",)");
    const char *end = list + length;
    while (length > 0 && (list[length - 1] == ' ' || list[length - 1] == '\t')) {
        --length;
    }
    snprintf(part, part_bytes, "%.*s", (int)length, list);
    return *end == ',' ? end + 1 : "";
}

/* The numbers of an entry of a law's schema. */
static mor_status read_entry(const reader *r, const char *key, const char *text, const mor_schema *schema,
                             double *values)
{
    if (schema->kind == MOR_SCHEMA_CHOICE) {
        const int index = mor_params_choice(schema->choices, text);
        MOR_CHECK(r->context, index >= 0, MOR_ERROR_CONFIG, "found %s = '%s'; allowed: %s (%s); choose one", key, text,
                  schema->choices, schema->text);
        values[0] = index;
        return MOR_OK;
    }
    if (schema->kind == MOR_SCHEMA_BOOLEAN) {
        const bool is_true = strcmp(text, "true") == 0;
        MOR_CHECK(r->context, is_true || strcmp(text, "false") == 0, MOR_ERROR_CONFIG,
                  "found %s = '%s'; allowed: true or false (%s)", key, text, schema->text);
        values[0] = is_true;
        return MOR_OK;
    }
    MOR_CHECK(r->context, schema->kind != MOR_SCHEMA_TEXT, MOR_ERROR_CONFIG,
              "found %s = '%s', which is a text; take the soil of a case for such a law", key, text);
    const char *rest = text;
    for (int a = 0; a < schema->n_components; ++a) {
        char part[KEY_BYTES];
        MOR_CHECK(r->context, rest[0] != '\0', MOR_ERROR_CONFIG, "found %s = '%s'; allowed: %d numbers (%s)", key, text,
                  schema->n_components, schema->text);
        rest = take_part(rest, part, sizeof part);
        MOR_TRY(r->context, read_number(r, key, part, schema, &values[a]));
    }
    MOR_CHECK(r->context, rest[0] == '\0', MOR_ERROR_CONFIG, "found %s = '%s'; allowed: %d numbers (%s)", key, text,
              schema->n_components, schema->text);
    return MOR_OK;
}

/* ---- Keys -------------------------------------------------------------------------------------------------------- */

/* The value of the last setting of a key, without blanks; NULL when there is none. */
static const char *find_value(const char *const *list, int n, const char *key)
{
    const char *value = NULL;
    const size_t n_bytes = strlen(key);
    for (int k = 0; k < n; ++k) {
        const char *end = list[k] + n_bytes;
        if (strncmp(list[k], key, n_bytes) == 0 && end[strspn(end, " \t")] == '=') {
            value = strchr(end, '=') + 1;
            value += strspn(value, " \t");
        }
    }
    return value;
}

static const char *find_test_value(const reader *r, const char *key, char *full)
{
    snprintf(full, KEY_BYTES, "test.%s", key);
    return find_value(r->list, r->n, full);
}

void mor_element_words_find(const char *const *list, int n, mor_element_words *words)
{
    *words = (mor_element_words){.path = find_value(list, n, "test.path"),
                                 .case_file = find_value(list, n, "test.case"),
                                 .soil = find_value(list, n, "test.soil"),
                                 .data = find_value(list, n, "test.data"),
                                 .replay = find_value(list, n, "test.replay")};
}

/* All keys there are; returns their number. */
static int list_keys(const mor_material *material, char (*keys)[KEY_BYTES])
{
    int n = 0;
    for (int k = 0; k < N_WORDS; ++k) {
        snprintf(keys[n++], KEY_BYTES, "test.%s", word_keys[k].key);
    }
    for (int k = 0; k < N_NUMBERS; ++k) {
        snprintf(keys[n++], KEY_BYTES, "test.%s", numbers[k].schema.key);
    }
    snprintf(keys[n++], KEY_BYTES, "%s", density_schema.key);
    for (const mor_schema *entry = material->parameters; entry->key != NULL && n < NAMES_MAX; ++entry) {
        snprintf(keys[n++], KEY_BYTES, "%s", entry->key);
    }
    for (const mor_schema *entry = material->state; entry->key != NULL && n < NAMES_MAX; ++entry) {
        snprintf(keys[n++], KEY_BYTES, "state.%s", entry->key);
    }
    return n;
}

/* Refuses settings with a key that nobody reads. */
static mor_status check_keys(const reader *r)
{
    char keys[NAMES_MAX][KEY_BYTES];
    const char *names[NAMES_MAX];
    char all[MOR_ELEMENT_TEXT_BYTES] = "";
    const int n_keys = list_keys(r->material, keys);
    for (int k = 0; k < n_keys; ++k) {
        const size_t used = strlen(all);
        names[k] = keys[k];
        snprintf(all + used, sizeof all - used, "%s%s", k == 0 ? "" : ", ", keys[k]);
    }
    for (int k = 0; k < r->n; ++k) {
        char found[KEY_BYTES];
        bool is_known = false;
        size_t length = strcspn(r->list[k], "=");
        while (length > 0 && (r->list[k][length - 1] == ' ' || r->list[k][length - 1] == '\t')) {
            --length;
        }
        snprintf(found, sizeof found, "%.*s", (int)length, r->list[k]);
        for (int a = 0; a < n_keys && !is_known; ++a) {
            is_known = strcmp(found, keys[a]) == 0;
        }
        const int near = mor_nearest_find(found, names, n_keys);
        const int entry = mor_params_find_symbol(r->material->parameters, found);
        const char *meant = entry >= 0 ? r->material->parameters[entry].key : near >= 0 ? names[near] : NULL;
        MOR_CHECK(r->context, is_known, MOR_ERROR_CONFIG,
                  "found '%s', which is no key of a test of '%s'%s%s%s; allowed: %s", found, r->material->name,
                  meant != NULL ? "; did you mean " : "", meant != NULL ? meant : "", meant != NULL ? "?" : "", all);
    }
    return MOR_OK;
}

/* ---- Parts of a test --------------------------------------------------------------------------------------------- */

static mor_status read_numbers(const reader *r, mor_element_settings *settings)
{
    for (int k = 0; k < N_NUMBERS; ++k) {
        char key[KEY_BYTES];
        const mor_schema *schema = &numbers[k].schema;
        const char *text = find_test_value(r, schema->key, key);
        double value = schema->default_value;
        void *place = (char *)settings + numbers[k].offset;
        if (text != NULL) {
            MOR_TRY(r->context, read_number(r, key, text, schema, &value));
        }
        if (schema->kind == MOR_SCHEMA_INTEGER) {
            *(int *)place = (int)value;
        } else {
            *(double *)place = value;
        }
    }
    return MOR_OK;
}

static mor_status read_stresses(const reader *r, mor_element_settings *settings)
{
    char key[KEY_BYTES];
    const char *rest = find_test_value(r, "stress", key);
    settings->n_specimens = 0;
    if (rest == NULL) {
        settings->stress[settings->n_specimens++] = 100e3;
    }
    while (rest != NULL && rest[0] != '\0') {
        char part[KEY_BYTES];
        rest = take_part(rest, part, sizeof part);
        MOR_CHECK(r->context, settings->n_specimens < MOR_ELEMENT_SPECIMENS_MAX, MOR_ERROR_CONFIG,
                  "found more than %d stresses for %s; test some of them at a time", MOR_ELEMENT_SPECIMENS_MAX,
                  name_of(r, key));
        MOR_TRY(r->context, read_number(r, key, part, &stress_schema, &settings->stress[settings->n_specimens++]));
    }
    MOR_CHECK(r->context, settings->n_specimens > 0, MOR_ERROR_CONFIG,
              "found no stress for %s; allowed: numbers as '100 kPa, 200 kPa'", name_of(r, key));
    return MOR_OK;
}

/* The strain that a test without one goes to: a usual one of its kind. */
static double find_usual_strain(const mor_element_path *path)
{
    if (path != NULL && path->measure == MOR_ELEMENT_ROTATION) {
        return full_revolution;
    }
    return path != NULL && path->is_cyclic ? 0.01 : 0.1;
}

/* A large number without a unit may be meant in percent, or in degrees. */
static mor_status check_bare_strain(const reader *r, const char *key, const char *text, bool is_angle, double strain)
{
    char part[KEY_BYTES];
    double bare = 0.0;
    take_part(text, part, sizeof part);
    const bool is_bare = mor_number_read(part, strlen(part), &bare);
    MOR_CHECK(r->context, !is_bare || is_angle || strain <= 1.0, MOR_ERROR_CONFIG,
              "found %s = '%s', a strain of more than 100 %% without a unit; write '%s %%' or '%.6g %%', whichever is "
              "meant",
              name_of(r, key), text, part, 100.0 * strain);
    MOR_CHECK(r->context, !is_bare || !is_angle || strain <= full_revolution * (1.0 + 1e-6), MOR_ERROR_CONFIG,
              "found %s = '%s', an angle of more than a full revolution without a unit; write '%s deg' or '%s rad', "
              "whichever is meant",
              name_of(r, key), text, part, part);
    return MOR_OK;
}

static mor_status read_strain(const reader *r, mor_element_settings *settings)
{
    char key[KEY_BYTES];
    const bool is_angle = settings->path != NULL && settings->path->measure == MOR_ELEMENT_ROTATION;
    const mor_schema *schema = is_angle ? &angle_schema : &strain_schema;
    const char *text = find_test_value(r, schema->key, key);
    settings->strain = find_usual_strain(settings->path);
    if (text == NULL) {
        return MOR_OK;
    }
    MOR_TRY(r->context, read_number(r, key, text, schema, &settings->strain));
    return check_bare_strain(r, key, text, is_angle, settings->strain);
}

/* A setting that the path or the law has no use for is a mistake. */
static mor_status check_unused(const reader *r, const mor_element_settings *settings)
{
    const bool is_cyclic = settings->path != NULL && settings->path->is_cyclic;
    const struct {
        const char *key, *why;
        bool is_used;
    } uses[] = {
        {"amplitude", "which does not turn; give it with a cyclic path", is_cyclic},
        {"cycles", "which does not turn; give it with a cyclic path", is_cyclic},
        {"b", "which has no stress between two others; give it with true-triaxial",
         settings->path != NULL && settings->path->has_b},
        {"void_ratio", "but the state of the law has one of its own; give state.void_ratio",
         mor_params_find(r->material->state, "void_ratio") < 0},
    };
    for (size_t k = 0; k < sizeof uses / sizeof *uses; ++k) {
        char key[KEY_BYTES];
        MOR_CHECK(r->context, uses[k].is_used || find_test_value(r, uses[k].key, key) == NULL, MOR_ERROR_CONFIG,
                  "found test.%s for '%s', %s, or leave it out", uses[k].key, settings->name, uses[k].why);
    }
    return MOR_OK;
}

/* Creep and relaxation need no drive. A law of another program, whose constants have no units, does not tell whether
 * it creeps. */
static mor_status check_drive(const reader *r, const char *text, const mor_element_control *control)
{
    const unsigned moves_by_itself = MOR_MATERIAL_RATE_DEPENDENT | MOR_MATERIAL_FIXED_UNITS;
    bool is_driven = (r->material->capabilities & moves_by_itself) != 0;
    for (int k = 0; k < 6; ++k) {
        is_driven = is_driven || control->stress_rate[k] != 0.0 || control->strain_rate[k] != 0.0;
    }
    MOR_CHECK(r->context, is_driven, MOR_ERROR_CONFIG,
              "found test.control = '%s', in which nothing drives the specimen, and stress and strain of '%s' do not "
              "change by themselves; allowed: at least one strain rate other than 0, or a 'stress' with a rate, as "
              "'stress -10 kPa/s'",
              text, r->material->name);
    return MOR_OK;
}

static mor_status read_control(const reader *r, const char *text, mor_element_settings *settings)
{
    static const mor_schema rate = {.key = "control",
                                    .kind = MOR_SCHEMA_REAL,
                                    .n_components = 1,
                                    .unit = "Pa/s",
                                    .minimum = -INFINITY,
                                    .maximum = INFINITY,
                                    .text = "rate of a stress component"};
    const char *rest = text;
    for (int k = 0; k < 6; ++k) {
        char part[KEY_BYTES];
        double value = 0.0;
        MOR_CHECK(r->context, rest[0] != '\0', MOR_ERROR_CONFIG,
                  "found test.control = '%s' with %d parts; allowed: six, for xx, yy, zz, xy, yz, zx", text, k);
        rest = take_part(rest, part, sizeof part);
        const char *behind = part + (strncmp(part, "stress", 6) == 0 ? 6 : 0);
        behind += strspn(behind, " \t");
        if (behind != part) {
            MOR_TRY(r->context, behind[0] == '\0' ? MOR_OK : read_number(r, "test.control", behind, &rate, &value));
            mor_element_control_stress(&settings->control, k, value);
        } else {
            MOR_CHECK(r->context, mor_number_read(part, strlen(part), &value) && isfinite(value), MOR_ERROR_CONFIG,
                      "found test.control = '%s' with '%s'; allowed: a number, 'stress', or 'stress' and a rate as "
                      "'stress 10 kPa/s'",
                      text, part);
            settings->control.strain_rate[k] = value * settings->rate;
        }
    }
    MOR_CHECK(r->context, rest[0] == '\0', MOR_ERROR_CONFIG,
              "found test.control = '%s' with more than six parts; allowed: six, for xx, yy, zz, xy, yz, zx", text);
    snprintf(settings->name, sizeof settings->name, "control");
    return check_drive(r, text, &settings->control);
}

/* Every path, or the one asked for. */
static mor_status read_path(const reader *r, mor_element_settings *settings)
{
    char all[MOR_ELEMENT_TEXT_BYTES] = "";
    const char *names[NAMES_MAX];
    const char *name = find_value(r->list, r->n, "test.path");
    const char *control = find_value(r->list, r->n, "test.control");
    int n = 0;
    MOR_CHECK(r->context, name == NULL || control == NULL, MOR_ERROR_CONFIG,
              "found %s and test.control; give one of them", name_of(r, "test.path"));
    if (control != NULL) {
        return read_control(r, control, settings);
    }
    for (; mor_element_path_at(n) != NULL && n < NAMES_MAX; ++n) {
        const size_t used = strlen(all);
        names[n] = mor_element_path_at(n)->name;
        snprintf(all + used, sizeof all - used, "%s%s", n == 0 ? "" : ", ", names[n]);
        if (name != NULL && strcmp(name, names[n]) == 0) {
            settings->path = mor_element_path_at(n);
        }
    }
    MOR_CHECK(r->context, name != NULL, MOR_ERROR_CONFIG, "found no path for the test; allowed: %s; choose one by %s",
              all, name_of(r, "test.path"));
    const int near = mor_nearest_find(name, names, n);
    MOR_CHECK(r->context, settings->path != NULL, MOR_ERROR_CONFIG, "found the path '%s'%s%s; allowed: %s", name,
              near >= 0 ? "; did you mean " : "", near >= 0 ? names[near] : "", all);
    MOR_CHECK(r->context, !settings->path->has_b || settings->k0 == 1.0, MOR_ERROR_CONFIG,
              "found test.k0 = %g for %s; allowed: 1, equal stresses at the start", settings->k0, name);
    snprintf(settings->name, sizeof settings->name, "%s", name);
    return MOR_OK;
}

static mor_status read_material(const reader *r, mor_element_settings *settings)
{
    const mor_material *material = r->material;
    const char *density = find_value(r->list, r->n, density_schema.key);
    if (density != NULL) {
        MOR_TRY(r->context, read_number(r, density_schema.key, density, &density_schema, &settings->density));
    }
    for (int k = 0; material->parameters[k].key != NULL; ++k) {
        const mor_schema *schema = &material->parameters[k];
        double *values = settings->parameters + mor_params_offset(material->parameters, k);
        const char *text = find_value(r->list, r->n, schema->key);
        if (text != NULL) {
            MOR_TRY(r->context, read_entry(r, schema->key, text, schema, values));
        }
        char range[256];
        mor_params_range(schema, range, sizeof range);
        MOR_CHECK(r->context, !isnan(values[0]), MOR_ERROR_CONFIG,
                  "found no '%s' for '%s'; allowed: %s (%s); give it, or take the soil of a case", schema->key,
                  material->name, range, schema->text);
    }
    for (int k = 0; material->state[k].key != NULL; ++k) {
        char key[KEY_BYTES];
        double *values = settings->state + mor_params_offset(material->state, k);
        snprintf(key, sizeof key, "state.%s", material->state[k].key);
        const char *text = find_value(r->list, r->n, key);
        for (int a = 0; a < material->state[k].n_components; ++a) {
            values[a] = NAN;
        }
        if (text != NULL) {
            MOR_TRY(r->context, read_entry(r, key, text, &material->state[k], values));
        }
    }
    return MOR_OK;
}

static mor_status read_all(const reader *r, mor_element_settings *settings)
{
    settings->path = NULL;
    settings->control = (mor_element_control){0};
    MOR_TRY(r->context, check_keys(r));
    MOR_TRY(r->context, read_numbers(r, settings));
    MOR_TRY(r->context, read_path(r, settings));
    MOR_TRY(r->context, check_unused(r, settings));
    MOR_TRY(r->context, read_stresses(r, settings));
    MOR_TRY(r->context, read_strain(r, settings));
    return read_material(r, settings);
}

mor_status mor_element_settings_read(mor_context *context, const mor_material *material, const char *const *list, int n,
                                     mor_element_settings *settings)
{
    reader r = {.context = context, .material = material, .names = settings->names, .list = list, .n = n};
    MOR_TRY(context, mor_units_new(context, &r.units));
    const mor_status status = read_all(&r, settings);
    mor_units_free(context, &r.units);
    return status;
}

void mor_element_settings_print(FILE *out)
{
    fprintf(out, "Settings of an element test\n");
    for (int k = 0; k < N_WORDS; ++k) {
        fprintf(out, "  test.%-12s %s", word_keys[k].key, word_keys[k].text);
        if (strcmp(word_keys[k].key, strain_schema.key) == 0) {
            char range[2][256];
            mor_params_range(&strain_schema, range[0], sizeof range[0]);
            mor_params_range(&angle_schema, range[1], sizeof range[1]);
            fprintf(out, "; %s, of spin %s; above 1, of spin above a turn, with its unit, as '150 %%'", range[0],
                    range[1]);
        }
        fputc('\n', out);
    }
    for (int k = 0; k < N_NUMBERS; ++k) {
        char range[256];
        char standard[64] = "";
        const mor_schema *schema = &numbers[k].schema;
        mor_params_range(schema, range, sizeof range);
        if (!isnan(schema->default_value)) {
            snprintf(standard, sizeof standard, "; default %g", schema->default_value);
        }
        fprintf(out, "  test.%-12s %s; %s%s\n", schema->key, schema->text, range, standard);
    }
    fprintf(out, "  %-17s density at the start; > 0 kg/m3; default 2000\n", density_schema.key);
    fprintf(out, "  %-17s parameters of the law, as in a case\n  %-17s what the state of the law starts from\n", "KEY",
            "state.KEY");
    fprintf(out, "Paths\n");
    for (int k = 0; mor_element_path_at(k) != NULL; ++k) {
        fprintf(out, "  %-26s %s\n", mor_element_path_at(k)->name, mor_element_path_at(k)->text);
    }
}
