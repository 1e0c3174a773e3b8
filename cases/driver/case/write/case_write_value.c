/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/write/case_writer.h"

#include "core/material/params.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { NUMBER_BYTES = 64, VALUES_MAX = 9 };

mor_case_presence mor_case_presence_always(const mor_case_key *key, const void *record)
{
    (void)key, (void)record;
    return MOR_CASE_WRITE;
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

void mor_case_writer_text(const char *text, char *out, size_t out_bytes)
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

void mor_case_writer_whole(int64_t value, char *out, size_t out_bytes)
{
    snprintf(out, out_bytes, "%" PRId64 "%s", value, value > INT_MAX || value < INT_MIN ? "L" : "");
}

static void format_real(const mor_case_writer *w, double value, const char *unit, char *out, size_t out_bytes)
{
    char number[NUMBER_BYTES];
    mor_units_format(w->reader.units, value, number, sizeof number);
    if (strcmp(unit, "1") == 0) {
        snprintf(out, out_bytes, "%s", number);
    } else {
        snprintf(out, out_bytes, "\"%s %s\"", number, unit);
    }
}

/* Numbers of any kind, with their unit and before the scale. */
mor_status mor_case_writer_numbers(const mor_case_writer *w, const mor_schema *schema, bool keeps_scale,
                                   const double *given, int n, char *out, size_t out_bytes)
{
    double values[VALUES_MAX];
    memcpy(values, given, (size_t)n * sizeof *values);
    if (!keeps_scale) {
        MOR_TRY(w->reader.context, mor_case_reader_scale(&w->reader, schema->unit, values, n, -1));
    }
    if (schema->kind != MOR_SCHEMA_VECTOR) {
        format_real(w, values[0], schema->unit, out, out_bytes);
        return MOR_OK;
    }
    size_t used = (size_t)snprintf(out, out_bytes, "(");
    for (int k = 0; k < n && used + NUMBER_BYTES < out_bytes; ++k) {
        char number[2 * NUMBER_BYTES];
        format_real(w, values[k], schema->unit, number, sizeof number);
        used += (size_t)snprintf(out + used, out_bytes - used, "%s%s", k > 0 ? ", " : "", number);
    }
    snprintf(out + used, out_bytes - used, ")");
    return MOR_OK;
}

mor_status mor_case_writer_member(const mor_case_writer *w, const mor_case_key *key, const void *member, char *out,
                                  size_t out_bytes)
{
    char word[MOR_CASE_NAME_BYTES];
    const mor_schema schema = mor_case_key_schema(key, w->reader.dimension);
    switch (key->storage) {
    case MOR_CASE_STORE_REALS:
        return mor_case_writer_numbers(w, &schema, key->keeps_scale, member, schema.n_components, out, out_bytes);
    case MOR_CASE_STORE_INT:
        mor_case_writer_whole(*(const int *)member, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_SEED:
        mor_case_writer_whole((int64_t) * (const uint64_t *)member, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_BOOL:
        if (schema.kind == MOR_SCHEMA_BOOLEAN) {
            snprintf(out, out_bytes, "%s", *(const bool *)member ? "true" : "false");
            return MOR_OK;
        }
        mor_params_word(schema.choices, *(const bool *)member ? 1 : 0, word, sizeof word);
        mor_case_writer_text(word, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_CHOICE:
        mor_params_word(schema.choices, *(const int *)member, word, sizeof word);
        mor_case_writer_text(word, out, out_bytes);
        return MOR_OK;
    case MOR_CASE_STORE_TEXT:
    case MOR_CASE_STORE_NAME:
    case MOR_CASE_STORE_WORD:
        mor_case_writer_text(member, out, out_bytes);
        return MOR_OK;
    }
    return MOR_OK;
}

void mor_case_writer_line(const mor_case_writer *w, const char *key, const char *value, bool is_default)
{
    fprintf(w->stream, "%*s%s = %s;%s\n", w->depth * MOR_CASE_INDENT, "", key, value, is_default ? " # default" : "");
}

void mor_case_writer_open(mor_case_writer *w, const char *name, const char *bracket)
{
    fprintf(w->stream, "%*s%s%s%s\n", w->depth * MOR_CASE_INDENT, "", name, name[0] == '\0' ? "" : " = ", bracket);
    w->depth += 1;
}

void mor_case_writer_close(mor_case_writer *w, const char *bracket)
{
    w->depth -= 1;
    fprintf(w->stream, "%*s%s\n", w->depth * MOR_CASE_INDENT, "", bracket);
}

mor_status mor_case_writer_keys(const mor_case_writer *w, const mor_case_group *group, const void *record,
                                mor_case_key_presence presence_of)
{
    uint64_t written = 0;
    memcpy(&written, (const char *)record + group->written_offset, sizeof written);
    for (int k = 0; group->keys[k].schema.key != NULL; ++k) {
        const mor_case_key *key = &group->keys[k];
        const mor_case_presence presence = presence_of(key, record);
        if (presence == MOR_CASE_MENTION) {
            fprintf(w->stream, "%*s# %s: %s (default)\n", w->depth * MOR_CASE_INDENT, "", key->schema.key,
                    key->computed);
        }
        if (presence != MOR_CASE_WRITE) {
            continue;
        }
        char value[MOR_CASE_VALUE_BYTES];
        MOR_TRY(w->reader.context,
                mor_case_writer_member(w, key, (const char *)record + key->offset, value, sizeof value));
        mor_case_writer_line(w, key->schema.key, value, (written >> k & 1) == 0);
    }
    return MOR_OK;
}
