/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The scheme of a case, and what the case sets in its place. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/case/schema/case_schema.h"

#include <string.h>

static const mor_case_key *find_numerics(void)
{
    const mor_case_group *group = mor_case_settings_groups;
    while (strcmp(group->name, "numerics") != 0) {
        ++group;
    }
    return group->keys;
}

/* A word of a list with bars between. */
static void print_word(FILE *out, const char *words, int place)
{
    for (int k = 0; k < place; ++k) {
        words = strchr(words, '|') + 1;
    }
    fprintf(out, "%.*s", (int)strcspn(words, "|"), words);
}

static double read_number(const mor_case *c, const mor_case_key *key)
{
    const char *member = (const char *)c + key->offset;
    switch (key->storage) {
    case MOR_CASE_STORE_BOOL:
        return *(const bool *)member;
    case MOR_CASE_STORE_REALS:
        return *(const double *)member;
    default:
        return *(const int *)member;
    }
}

static void print_setting(FILE *out, const mor_case *c, const mor_case_key *key)
{
    const mor_schema schema = mor_case_key_schema(key, c->dimension);
    const double value = read_number(c, key);
    fprintf(out, "%s ", schema.key);
    if (schema.kind == MOR_SCHEMA_CHOICE) {
        print_word(out, schema.choices, (int)value);
    } else if (schema.kind == MOR_SCHEMA_BOOLEAN) {
        fprintf(out, "%s", value != 0.0 ? "true" : "false");
    } else {
        fprintf(out, "%g%s%s", value, strcmp(schema.unit, "1") == 0 ? "" : " ",
                strcmp(schema.unit, "1") == 0 ? "" : schema.unit);
    }
}

void mor_session_print_scheme(FILE *out, const mor_case *the_case)
{
    const mor_case_key *keys = find_numerics();
    const int scheme = the_case->numerics.scheme;
    const char *before = "; but ";
    fprintf(out, "  scheme                  ");
    for (int k = 0; keys[k].schema.key != NULL; ++k) {
        const bool is_number = keys[k].schema.kind != MOR_SCHEMA_TEXT && keys[k].schema.n_components == 1;
        const bool is_scheme = strcmp(keys[k].schema.key, "scheme") == 0;
        const bool is_written = (the_case->written_numerics >> k & 1) != 0;
        if (is_scheme) {
            print_word(out, keys[k].schema.choices, scheme);
        } else if (is_number && is_written &&
                   (keys[k].computed != NULL ||
                    read_number(the_case, &keys[k]) != mor_case_key_default(&keys[k], scheme))) {
            fprintf(out, "%s", before);
            print_setting(out, the_case, &keys[k]);
            before = ", ";
        }
    }
    fprintf(out, "\n");
}
