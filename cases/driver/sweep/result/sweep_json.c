/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* sweep.json: what summary.json is of a run. Nothing is read back, so it is printed member by member. */
#include "cases/driver/sweep/result/sweep_write.h"

#include "core/base/hash.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* Bytes of the UTF-8 letter at the start of a text; 0 where there is none. */
static int measure_letter(const unsigned char *text)
{
    const int n = text[0] < 0x80 ? 1 : text[0] >= 0xf0 ? 4 : text[0] >= 0xe0 ? 3 : 2;
    if (text[0] >= 0xf5 || (text[0] >= 0x80 && text[0] < 0xc2)) {
        return 0;
    }
    for (int k = 1; k < n; ++k) {
        if ((text[k] & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool is_long = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    const bool is_beyond = (text[0] == 0xed && text[1] > 0x9f) || (text[0] == 0xf4 && text[1] > 0x8f);
    return is_long || is_beyond ? 0 : n;
}

/* A text; bytes that are not UTF-8 become question marks, as in summary.json. */
static void write_text(const char *text, FILE *out)
{
    fputc('"', out);
    while (*text != '\0') {
        const int n = measure_letter((const unsigned char *)text);
        if (n != 1) {
            fprintf(out, "%.*s", n > 0 ? n : 1, n > 0 ? text : "?");
        } else if (*text == '"' || *text == '\\') {
            fprintf(out, "\\%c", *text);
        } else if ((unsigned char)*text < 0x20) {
            fprintf(out, "\\u%04x", (unsigned)*text);
        } else {
            fputc(*text, out);
        }
        text += n > 0 ? n : 1;
    }
    fputc('"', out);
}

/* The name of a member and, in front of it, what stands between it and the one before. */
static void write_name(const char *separator, const char *name, FILE *out)
{
    fputs(separator, out);
    write_text(name, out);
    fputs(": ", out);
}

static void write_number(const char *name, double value, FILE *out)
{
    write_name(", ", name, out);
    fprintf(out, isfinite(value) ? "%.17g" : "null", value);
}

static void write_word(const char *separator, const char *name, const char *text, FILE *out)
{
    write_name(separator, name, out);
    write_text(text, out);
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

static void write_counts(const mor_sweep_counts *counts, FILE *out)
{
    fprintf(out, "\"members\": %d, \"used\": %d, \"failed\": %d, \"missed_expectations\": %d", counts->n_members,
            counts->n_used, counts->by_state[MOR_SWEEP_STATE_FAILED], counts->by_state[MOR_SWEEP_STATE_MISSED]);
}

static void write_choices(const mor_sweep_design *design, int group, FILE *out)
{
    const char *separator = "";
    fprintf(out, "\"choices\": {");
    for (int v = 0; v < design->sweep->n_variables; ++v) {
        char label[MOR_SWEEP_LABEL_BYTES];
        if (mor_sweep_design_is_factor(design->sweep, v)) {
            mor_sweep_design_label(design, design->firsts[group], v, label);
            write_name(separator, design->sweep->variables[v].name, out);
            if (label[0] == '\0') {
                fputs("null", out);
            } else {
                write_text(label, out);
            }
            separator = ", ";
        }
    }
    fprintf(out, "}");
}

static void write_result(mor_sweep_table *table, int group, int column, FILE *out)
{
    char name[MOR_SWEEP_NAME_BYTES];
    mor_sweep_statistics it;
    mor_sweep_table_name(table, column, name);
    mor_sweep_table_evaluate(table, group, column, &it);
    write_name(column == 0 ? "\n        " : ",\n        ", name, out);
    write_word("{", "unit", table->columns[column].unit, out);
    fprintf(out, ", \"used\": %d, \"absent\": %d", it.n, mor_sweep_table_count_absent(table, group, column));
    write_number("mean", it.mean, out);
    write_number("standard_deviation", it.deviation, out);
    write_number("mean_low", it.mean_low, out);
    write_number("mean_high", it.mean_high, out);
    write_number("quantile_5", it.quantiles[0], out);
    write_number("quantile_50", it.quantiles[1], out);
    write_number("quantile_95", it.quantiles[2], out);
    write_number("minimum", it.minimum, out);
    write_number("maximum", it.maximum, out);
    fprintf(out, "}");
}

static void write_exceed(mor_sweep_table *table, int group, int index, FILE *out)
{
    const mor_sweep_threshold *threshold = &table->thresholds[index];
    char name[MOR_SWEEP_NAME_BYTES];
    mor_sweep_probability it;
    mor_sweep_table_name(table, threshold->column, name);
    mor_sweep_table_exceed(table, group, index, &it);
    write_word(index == 0 ? "\n        {" : ",\n        {", "result", name, out);
    write_number(table->design->sweep->exceed[index].is_below ? "below" : "above", threshold->value, out);
    write_word(", ", "unit", table->columns[threshold->column].unit, out);
    fprintf(out, ", \"used\": %d, \"absent\": %d", it.n, it.n_absent);
    write_word(", ", "absent_are", mor_sweep_absent_word(table->design->sweep->exceed[index].absent), out);
    fprintf(out, ", \"hits\": %d", it.n_hits);
    write_number("probability", it.share, out);
    write_number("probability_low", it.low, out);
    write_number("probability_high", it.high, out);
    fprintf(out, "}");
}

static void write_group(mor_sweep_table *table, int group, FILE *out)
{
    mor_sweep_counts counts;
    mor_sweep_table_count(table, group, &counts);
    fprintf(out, group == 0 ? "\n    {" : ",\n    {");
    write_choices(table->design, group, out);
    fprintf(out, ", ");
    write_counts(&counts, out);
    fprintf(out, ",\n      \"results\": {");
    for (int c = 0; c < table->n_results; ++c) {
        write_result(table, group, c, out);
    }
    fprintf(out, "},\n      \"exceed\": [");
    for (int k = 0; k < table->design->sweep->n_exceed; ++k) {
        write_exceed(table, group, k, out);
    }
    fprintf(out, "]}");
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

static mor_status write_failed(mor_context *context, const mor_sweep_table *table,
                               const mor_sweep_provenance *provenance, FILE *out)
{
    const char *separator = "\n    {";
    fprintf(out, "  \"failed\": [");
    for (int m = 0; m < table->design->n_members; ++m) {
        char number[16];
        char *command = NULL;
        size_t n_bytes = 0;
        if (table->outcomes[m].state != MOR_SWEEP_STATE_FAILED) {
            continue;
        }
        FILE *stream = open_memstream(&command, &n_bytes);
        MOR_CHECK(context, stream != NULL, MOR_ERROR_MEMORY, "no memory for a command");
        mor_status status = mor_sweep_write_command(context, table->design, provenance, m, stream);
        status = fclose(stream) == 0 ? status : MOR_FAIL(context, MOR_ERROR_MEMORY, "no memory for a command");
        if (status == MOR_OK) {
            mor_sweep_write_number(m, number);
            write_word(separator, "member", number, out);
            write_word(", ", "reason", table->outcomes[m].reason, out);
            write_word(", ", "command", command, out);
            fprintf(out, "}");
        }
        free(command);
        MOR_TRY(context, status);
        separator = ",\n    {";
    }
    fprintf(out, "],\n");
    return MOR_OK;
}

static void write_warnings(const mor_sweep_warnings *warnings, FILE *out)
{
    fprintf(out, "  \"warnings\": [");
    for (int k = 0; k < warnings->n; ++k) {
        char number[16];
        mor_sweep_write_number(warnings->items[k].members[0], number);
        write_word(k > 0 ? ",\n    {" : "\n    {", "text", warnings->items[k].text, out);
        fprintf(out, ", \"members\": %d", warnings->items[k].n_members);
        write_word(", ", "first", number, out);
        fprintf(out, "}");
    }
    fprintf(out, "],\n");
}

/* The files that cases were read from, each once. */
static mor_status write_inputs(mor_context *context, const mor_sweep_design *design,
                               const mor_sweep_provenance *provenance, FILE *out)
{
    char hash[MOR_HASH_TEXT_BYTES];
    char path[MOR_PATH_BYTES];
    mor_hash_format(provenance->sweep_hash, hash);
    write_word("{", design->sweep->path, hash, out);
    for (int m = 0; m < design->n_members; ++m) {
        const char *file = mor_sweep_design_case(design, m);
        bool is_new = true;
        for (int other = 0; other < m && is_new; ++other) {
            is_new = strcmp(mor_sweep_design_case(design, other), file) != 0;
        }
        if (is_new) {
            uint64_t value = 0;
            MOR_TRY(context, mor_sweep_write_find_case(context, design, m, path));
            MOR_TRY(context, mor_hash_file(context, path, &value));
            mor_hash_format(value, hash);
            write_word(", ", path, hash, out);
        }
    }
    fprintf(out, "}");
    return MOR_OK;
}

static mor_status write_all(mor_context *context, mor_sweep_table *table, const mor_sweep_provenance *provenance,
                            const mor_sweep_warnings *warnings, FILE *out)
{
    const mor_sweep *sweep = table->design->sweep;
    mor_sweep_counts counts;
    mor_sweep_table_count(table, -1, &counts);
    fprintf(out, "{ \"version\": 1,\n  \"title\": ");
    write_text(sweep->title, out);
    fprintf(out, ",\n  \"confidence\": %g,\n  ", MOR_SWEEP_CONFIDENCE);
    write_counts(&counts, out);
    fprintf(out, ",\n  \"groups\": [");
    for (int g = 0; g < table->design->n_groups; ++g) {
        write_group(table, g, out);
    }
    fprintf(out, "],\n");
    MOR_TRY(context, write_failed(context, table, provenance, out));
    write_warnings(warnings, out);
    fprintf(out, "  \"provenance\": ");
    write_word("{", "version", provenance->version, out);
    write_word(", ", "commit", provenance->commit, out);
    write_word(", ", "command", provenance->command, out);
    fprintf(out, ", \"seed\": %" PRIu64 ", \"samples\": %d, \"threads\": %d,\n    \"inputs\": ", sweep->seed,
            sweep->n_samples, provenance->n_threads);
    MOR_TRY(context, write_inputs(context, table->design, provenance, out));
    fprintf(out, "} }\n");
    return MOR_OK;
}

mor_status mor_sweep_write_summary(mor_context *context, mor_sweep_table *table, const mor_sweep_provenance *provenance,
                                   const mor_sweep_warnings *warnings, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_SWEEP_SUMMARY_FILE));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    const mor_status status = write_all(context, table, provenance, warnings, file.stream);
    if (status != MOR_OK) {
        mor_durable_file_discard(&file);
        return status;
    }
    return mor_durable_file_commit(context, &file);
}
