/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Tables as comma-separated values (RFC 4180). */
#include "cases/driver/sweep/result/sweep_write.h"

#include "core/base/hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void mor_sweep_write_number(int member, char *text)
{
    snprintf(text, 16, "%03d", member + 1);
}

mor_status mor_sweep_write_find_folder(mor_context *context, const char *folder, int member, char *path)
{
    char number[16];
    mor_sweep_write_number(member, number);
    const int n = snprintf(path, MOR_PATH_BYTES, "%s/members/%s", folder, number);
    MOR_CHECK(context, n > 0 && n < MOR_PATH_BYTES, MOR_ERROR_IO, "the path of the member's folder is too long");
    return MOR_OK;
}

/* ---- Commands ---------------------------------------------------------------------------------------------------- */

mor_status mor_sweep_write_find_case(mor_context *context, const mor_sweep_design *design, int member, char *path)
{
    char folder[MOR_PATH_BYTES];
    const char *file = mor_sweep_design_case(design, member);
    const char *slash = strrchr(design->sweep->path, '/');
    if (slash == NULL || file[0] == '/') {
        return mor_durable_file_join(context, path, "", file);
    }
    snprintf(folder, sizeof folder, "%.*s", slash == design->sweep->path ? 1 : (int)(slash - design->sweep->path),
             design->sweep->path);
    return mor_durable_file_join(context, path, folder, file);
}

/* A word as a shell reads it. */
static void write_word(const char *word, FILE *out)
{
    if (word[0] != '\0' && word[strcspn(word, " \t\n()[]{}*?$;&|<>\"'\\`!#~")] == '\0') {
        fputs(word, out);
        return;
    }
    fputc('\'', out);
    for (const char *c = word; *c != '\0'; ++c) {
        fputs(*c == '\'' ? "'\\''" : (char[]){*c, '\0'}, out);
    }
    fputc('\'', out);
}

mor_status mor_sweep_write_command(mor_context *context, const mor_sweep_design *design,
                                   const mor_sweep_provenance *provenance, int member, FILE *out)
{
    char path[MOR_PATH_BYTES];
    mor_sweep_settings settings;
    MOR_TRY(context, mor_sweep_write_find_case(context, design, member, path));
    mor_sweep_design_settings(design, provenance->units, member, &settings);
    fprintf(out, "%s ", provenance->run_word);
    write_word(path, out);
    for (int k = 0; k < settings.n; ++k) {
        fprintf(out, " %s ", provenance->set_word);
        write_word(settings.texts[k], out);
    }
    return MOR_OK;
}

/* Text on one line, so that each member has one. */
static void write_line(const char *text, FILE *out)
{
    for (; *text != '\0'; ++text) {
        fputc(*text == '\n' || *text == '\r' ? ' ' : *text, out);
    }
}

void mor_sweep_write_design(const mor_sweep_design *design, const mor_sweep_provenance *provenance,
                            const uint64_t *case_hashes, FILE *out)
{
    mor_sweep_settings settings;
    fprintf(out, "moraine %s, commit %s\n", provenance->version, provenance->commit);
    for (int m = 0; m < design->n_members; ++m) {
        char number[16];
        char hash[MOR_HASH_TEXT_BYTES];
        mor_sweep_write_number(m, number);
        mor_hash_format(case_hashes[m], hash);
        mor_sweep_design_settings(design, provenance->units, m, &settings);
        fprintf(out, "%s %s %s", number, hash, mor_sweep_design_case(design, m));
        for (int k = 0; k < settings.n; ++k) {
            fprintf(out, " | ");
            write_line(settings.texts[k], out);
        }
        fputc('\n', out);
    }
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

static void write_text(const char *text, FILE *out)
{
    const bool is_quoted = text[strcspn(text, ",\"\n\r")] != '\0';
    fputs(is_quoted ? "\"" : "", out);
    for (const char *c = text; *c != '\0'; ++c) {
        fputs(*c == '"' ? "\"\"" : (char[]){*c == '\n' || *c == '\r' ? ' ' : *c, '\0'}, out);
    }
    fputs(is_quoted ? "\"" : "", out);
}

/* A number with all its digits, and a separator in front. */
static void write_value(double value, FILE *out)
{
    fputc(',', out);
    if (isfinite(value)) {
        fprintf(out, "%.17g", value);
    }
}

/* Choices with numbers have labels, too, which alone tell those apart that share a number. */
static bool has_labels(const mor_sweep_variable *it)
{
    return it->is_number && it->n_choices > 0 && it->key[0] == '\0';
}

/* Heads of the columns of variables. */
static void write_variable_heads(const mor_sweep *sweep, bool has_all, FILE *out)
{
    for (int v = 0; v < sweep->n_variables; ++v) {
        const mor_sweep_variable *it = &sweep->variables[v];
        if (has_all || mor_sweep_design_is_factor(sweep, v)) {
            fprintf(out, "%s%s%s%s,", it->name, it->unit[0] != '\0' ? " [" : "", it->unit,
                    it->unit[0] != '\0' ? "]" : "");
            if (has_labels(it)) {
                fprintf(out, "%s_label,", it->name);
            }
        }
    }
}

/* What the variables are in a member: a number, a label, or both. */
static void write_variables(const mor_sweep_design *design, int member, bool has_all, FILE *out)
{
    const mor_sweep *sweep = design->sweep;
    for (int v = 0; v < sweep->n_variables; ++v) {
        const mor_sweep_variable *it = &sweep->variables[v];
        const double value = mor_sweep_design_value(design, member, v);
        const bool has_value = it->is_number && isfinite(value);
        char label[MOR_SWEEP_LABEL_BYTES];
        if (!has_all && !mor_sweep_design_is_factor(sweep, v)) {
            continue;
        }
        mor_sweep_design_label(design, member, v, label);
        if (has_value) {
            fprintf(out, "%.17g", value);
        }
        fputs(has_labels(it) ? "," : "", out);
        if (has_labels(it) || !has_value) {
            write_text(label, out);
        }
        fputc(',', out);
    }
}

/* ---- Members ----------------------------------------------------------------------------------------------------- */

static mor_status write_member(mor_context *context, const mor_sweep_table *table,
                               const mor_sweep_provenance *provenance, int member, FILE *out)
{
    const mor_sweep_outcome *outcome = &table->outcomes[member];
    char number[16];
    char *command = NULL;
    size_t n_bytes = 0;
    mor_sweep_write_number(member, number);
    fprintf(out, "%s,", number);
    write_variables(table->design, member, true, out);
    fprintf(out, "%s,%d,%d", mor_sweep_state_words[outcome->state], outcome->n_missed, outcome->n_warnings);
    for (int c = 0; c < table->n_columns; ++c) {
        write_value(table->values[(int64_t)member * table->n_columns + c], out);
    }
    fputc(',', out);
    write_text(outcome->reason, out);
    fputc(',', out);
    FILE *stream = open_memstream(&command, &n_bytes);
    MOR_CHECK(context, stream != NULL, MOR_ERROR_MEMORY, "no memory for a command");
    const mor_status status = mor_sweep_write_command(context, table->design, provenance, member, stream);
    if (fclose(stream) == 0 && status == MOR_OK) {
        write_text(command, out);
    }
    free(command);
    fputc('\n', out);
    return status;
}

static mor_status write_members(mor_context *context, const mor_sweep_table *table,
                                const mor_sweep_provenance *provenance, FILE *out)
{
    fprintf(out, "member,");
    write_variable_heads(table->design->sweep, true, out);
    fprintf(out, "state,missed_expectations,warnings");
    for (int c = 0; c < table->n_columns; ++c) {
        char name[MOR_SWEEP_NAME_BYTES];
        mor_sweep_table_name(table, c, name);
        fprintf(out, ",%s [%s]", name, table->columns[c].unit);
    }
    fprintf(out, ",reason,command\n");
    for (int m = 0; m < table->design->n_members; ++m) {
        MOR_TRY(context, write_member(context, table, provenance, m, out));
    }
    return MOR_OK;
}

mor_status mor_sweep_write_members(mor_context *context, const mor_sweep_table *table,
                                   const mor_sweep_provenance *provenance, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_SWEEP_MEMBERS_FILE));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    const mor_status status = write_members(context, table, provenance, file.stream);
    if (status != MOR_OK) {
        mor_durable_file_discard(&file);
        return status;
    }
    return mor_durable_file_commit(context, &file);
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

static void write_groups(mor_sweep_table *table, FILE *out)
{
    const mor_sweep_design *design = table->design;
    write_variable_heads(design->sweep, false, out);
    fprintf(out,
            "result,unit,members,failed,missed_expectations,used,absent,mean,standard_deviation,mean_low,mean_high,"
            "quantile_5,quantile_50,quantile_95,minimum,maximum\n");
    for (int g = 0; g < design->n_groups; ++g) {
        mor_sweep_counts counts;
        mor_sweep_table_count(table, g, &counts);
        for (int c = 0; c < table->n_results; ++c) {
            char name[MOR_SWEEP_NAME_BYTES];
            mor_sweep_statistics it;
            mor_sweep_table_name(table, c, name);
            mor_sweep_table_evaluate(table, g, c, &it);
            write_variables(design, design->firsts[g], false, out);
            fprintf(out, "%s,%s,%d,%d,%d,%d,%d", name, table->columns[c].unit, counts.n_members,
                    counts.by_state[MOR_SWEEP_STATE_FAILED], counts.by_state[MOR_SWEEP_STATE_MISSED], it.n,
                    mor_sweep_table_count_absent(table, g, c));
            const double numbers[] = {it.mean,         it.deviation,    it.mean_low, it.mean_high, it.quantiles[0],
                                      it.quantiles[1], it.quantiles[2], it.minimum,  it.maximum};
            for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
                write_value(numbers[k], out);
            }
            fputc('\n', out);
        }
    }
}

static void write_exceed(mor_sweep_table *table, FILE *out)
{
    const mor_sweep_design *design = table->design;
    write_variable_heads(design->sweep, false, out);
    fprintf(out, "result,side,threshold,unit,members,failed,used,absent,absent_are,hits,probability,probability_low,"
                 "probability_high\n");
    for (int g = 0; g < design->n_groups; ++g) {
        mor_sweep_counts counts;
        mor_sweep_table_count(table, g, &counts);
        for (int k = 0; k < design->sweep->n_exceed; ++k) {
            const mor_sweep_threshold *threshold = &table->thresholds[k];
            char name[MOR_SWEEP_NAME_BYTES];
            mor_sweep_probability it;
            mor_sweep_table_name(table, threshold->column, name);
            mor_sweep_table_exceed(table, g, k, &it);
            write_variables(design, design->firsts[g], false, out);
            fprintf(out, "%s,%s", name, design->sweep->exceed[k].is_below ? "below" : "above");
            write_value(threshold->value, out);
            fprintf(out, ",%s,%d,%d,%d,%d,%s,%d", table->columns[threshold->column].unit, counts.n_members,
                    counts.by_state[MOR_SWEEP_STATE_FAILED], it.n, it.n_absent,
                    mor_sweep_absent_word(design->sweep->exceed[k].absent), it.n_hits);
            write_value(it.share, out);
            write_value(it.low, out);
            write_value(it.high, out);
            fputc('\n', out);
        }
    }
}

static mor_status write_table(mor_context *context, mor_sweep_table *table, const char *folder, const char *name,
                              void (*write)(mor_sweep_table *table, FILE *out))
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    write(table, file.stream);
    return mor_durable_file_commit(context, &file);
}

mor_status mor_sweep_write_statistics(mor_context *context, mor_sweep_table *table, const char *folder)
{
    MOR_TRY(context, write_table(context, table, folder, MOR_SWEEP_STATISTICS_FILE, write_groups));
    return table->design->sweep->n_exceed == 0
               ? MOR_OK
               : write_table(context, table, folder, MOR_SWEEP_EXCEED_FILE, write_exceed);
}
