/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/column_table.h"

#include "core/base/memory.h"
#include "core/base/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_BYTES = 64, SHOWN = 40, NAMES_BYTES = 256, FIRST_ROOM = 64 };

static const double largest = 1e12; /* in SI; nothing on Earth is larger */

/* A table while it is read. */
typedef struct table {
    mor_context *context;
    const mor_units *units;
    const char *name;
    const char *text;
    int64_t n_bytes;
    int64_t at;         /* next byte */
    int64_t line_start; /* first byte of the line */
    int line;
    const mor_column_spec *spec;
    int kind_of[MOR_COLUMNS_MAX]; /* shape [n_columns] */
    char unit_of[MOR_COLUMNS_MAX][CELL_BYTES];
    int n_columns;
} table;

/* One cell: its bytes without blanks around. */
typedef struct cell {
    int64_t first;
    int n;
    char text[CELL_BYTES]; /* what fits, zero-terminated */
} cell;

#define CELL_FAIL(t, place, format, ...)                                                                               \
    MOR_FAIL((t)->context, MOR_ERROR_CONFIG, "%s:%d:%lld: " format, (t)->name, (t)->line,                              \
             (long long)((place) - (t)->line_start + 1), __VA_ARGS__)

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static bool is_line_end(const table *t)
{
    return t->at >= t->n_bytes || t->text[t->at] == '\n';
}

/* Takes the cell up to the next comma or the end of the line. */
static mor_status take_cell(table *t, cell *taken)
{
    while (!is_line_end(t) && is_blank(t->text[t->at])) {
        t->at += 1;
    }
    taken->first = t->at;
    while (!is_line_end(t) && t->text[t->at] != ',') {
        const unsigned char c = (unsigned char)t->text[t->at];
        if (c == ';' || c == '"' || (c < ' ' && !is_blank((char)c)) || c == 127) {
            return CELL_FAIL(t, t->at,
                             "found the byte %d, '%c'; allowed: numbers with a decimal point between commas, "
                             "without quotes; save the table as comma-separated values",
                             c, c > ' ' && c < 127 ? c : '?');
        }
        t->at += 1;
    }
    int64_t end = t->at;
    while (end > taken->first && is_blank(t->text[end - 1])) {
        end -= 1;
    }
    taken->n = end - taken->first < CELL_BYTES ? (int)(end - taken->first) : CELL_BYTES;
    snprintf(taken->text, sizeof taken->text, "%.*s", taken->n < CELL_BYTES ? taken->n : CELL_BYTES - 1,
             t->text + taken->first);
    if (taken->n == CELL_BYTES) {
        return CELL_FAIL(t, taken->first,
                         "found '%.*s...', a cell of more than %d letters; allowed: a number or the "
                         "name of a column; correct it",
                         SHOWN, taken->text, CELL_BYTES - 1);
    }
    return MOR_OK;
}

static void skip_line(table *t)
{
    while (!is_line_end(t)) {
        t->at += 1;
    }
    t->at += t->at < t->n_bytes;
    t->line += 1;
    t->line_start = t->at;
}

/* Goes on to the next line that is not blank; false at the end. */
static bool find_line(table *t)
{
    while (t->at < t->n_bytes) {
        int64_t look = t->at;
        while (look < t->n_bytes && is_blank(t->text[look])) {
            look += 1;
        }
        if (look < t->n_bytes && t->text[look] != '\n') {
            return true;
        }
        skip_line(t);
    }
    return false;
}

/* ---- Header ------------------------------------------------------------------------------------------------------ */

/* Splits "x [cm]" into the name and the unit. */
static mor_status split_unit(const table *t, cell *head, char *unit)
{
    char *open = strchr(head->text, '[');
    unit[0] = '\0';
    if (open == NULL) {
        return MOR_OK;
    }
    char *close = strchr(open, ']');
    if (close == NULL || close[1] != '\0' || close == open + 1) {
        return CELL_FAIL(t, head->first,
                         "found the heading '%s'; allowed: a name and its unit, such as x [m]; correct "
                         "the brackets",
                         head->text);
    }
    snprintf(unit, CELL_BYTES, "%.*s", (int)(close - open - 1), open + 1);
    while (open > head->text && is_blank(open[-1])) {
        open -= 1;
    }
    *open = '\0';
    return MOR_OK;
}

static mor_status check_unit(const table *t, const cell *head, int kind, const char *unit)
{
    if (unit[0] == '\0' && t->spec->columns[kind].has_unit) {
        return CELL_FAIL(t, head->first,
                         "found the heading %s without a unit; allowed: one with it, such as %s [deg] or "
                         "%s [%s]; add the unit",
                         t->spec->columns[kind].name, t->spec->columns[kind].name, t->spec->columns[kind].name,
                         t->spec->columns[kind].unit);
    }
    char one[CELL_BYTES + 4];
    double factor = 0.0;
    snprintf(one, sizeof one, "1 %s", unit);
    if (unit[0] == '\0' ||
        mor_units_convert(t->context, t->units, one, t->spec->columns[kind].unit, &factor) == MOR_OK) {
        return MOR_OK;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1000s", t->context->message);
    return CELL_FAIL(t, head->first, "found the unit [%s] of %s: %s; allowed: a unit like %s; correct it", unit,
                     t->spec->columns[kind].name, why, t->spec->columns[kind].unit);
}

/* The names of the columns that must be there, or of all, with commas. */
static void list_names(const mor_column_spec *spec, bool needed_only, char *text, size_t n_bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < spec->n_columns && used < n_bytes; ++k) {
        if (spec->columns[k].is_needed || !needed_only) {
            used += (size_t)snprintf(text + used, n_bytes - used, "%s%s", used > 0 ? ", " : "", spec->columns[k].name);
        }
    }
}

static mor_status read_heading(table *t)
{
    const mor_column_spec *spec = t->spec;
    char allowed[NAMES_BYTES];
    cell head;
    int kind = 0;
    list_names(spec, false, allowed, sizeof allowed);
    MOR_TRY(t->context, take_cell(t, &head));
    if (t->n_columns == spec->n_columns) {
        return CELL_FAIL(t, head.first, "found more than %d columns; allowed: %s%s, each once; remove the others",
                         spec->n_columns, allowed, spec->remark);
    }
    char *unit = t->unit_of[t->n_columns];
    MOR_TRY(t->context, split_unit(t, &head, unit));
    while (kind < spec->n_columns && strcmp(spec->columns[kind].name, head.text) != 0) {
        kind += 1;
    }
    if (kind == spec->n_columns) {
        return CELL_FAIL(t, head.first, "found the column '%s'; allowed: %s%s; rename or remove it", head.text, allowed,
                         spec->remark);
    }
    for (int k = 0; k < t->n_columns; ++k) {
        if (t->kind_of[k] == kind) {
            return CELL_FAIL(t, head.first, "found the column '%s' again; allowed: each once; remove one", head.text);
        }
    }
    MOR_TRY(t->context, check_unit(t, &head, kind, unit));
    t->kind_of[t->n_columns++] = kind;
    return MOR_OK;
}

static mor_status read_header(table *t)
{
    const mor_column_spec *spec = t->spec;
    char needed[NAMES_BYTES];
    char all[NAMES_BYTES];
    unsigned given = 0;
    list_names(spec, true, needed, sizeof needed);
    list_names(spec, false, all, sizeof all);
    if (!find_line(t)) {
        return CELL_FAIL(t, t->at,
                         "found an empty table; allowed: a line of headings, %s, and a line for each %s; write them",
                         needed, spec->row);
    }
    MOR_TRY(t->context, read_heading(t));
    while (!is_line_end(t)) {
        t->at += 1; /* the comma */
        MOR_TRY(t->context, read_heading(t));
    }
    for (int k = 0; k < t->n_columns; ++k) {
        given |= 1u << t->kind_of[k];
    }
    for (int kind = 0; kind < spec->n_columns; ++kind) {
        if ((given >> kind & 1u) == 0 && spec->columns[kind].is_needed) {
            return CELL_FAIL(t, t->line_start,
                             "found no column '%s'; allowed: the columns %s, of which %s are needed; add it",
                             spec->columns[kind].name, all, needed);
        }
    }
    skip_line(t);
    return MOR_OK;
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

static mor_status read_number(const table *t, const cell *found, int column, double *value)
{
    const mor_column *kind = &t->spec->columns[t->kind_of[column]];
    const char *unit = t->unit_of[column][0] != '\0' ? t->unit_of[column] : kind->unit;
    char text[2 * CELL_BYTES];
    double plain;
    if (!mor_number_read(found->text, (size_t)found->n, &plain)) {
        return CELL_FAIL(t, found->first, "found '%s' as %s; allowed: a number with a decimal point; correct it",
                         found->text, kind->name);
    }
    snprintf(text, sizeof text, "%s %s", found->text, unit);
    if (mor_units_convert(t->context, t->units, text, kind->unit, value) != MOR_OK || !isfinite(*value) ||
        fabs(*value) > largest || (kind->is_positive && *value <= 0.0)) {
        return CELL_FAIL(t, found->first, "found %s = %s [%s]; allowed: a number %sup to %g %s; correct it", kind->name,
                         found->text, unit, kind->is_positive ? "above zero, " : "", largest, kind->unit);
    }
    return MOR_OK;
}

static mor_status read_row(table *t, double *values)
{
    for (int k = 0; k < t->spec->n_columns; ++k) {
        values[k] = NAN;
    }
    for (int k = 0; k < t->n_columns; ++k) {
        cell found;
        MOR_TRY(t->context, take_cell(t, &found));
        MOR_TRY(t->context, read_number(t, &found, k, &values[t->kind_of[k]]));
        if (is_line_end(t) != (k + 1 == t->n_columns)) {
            return CELL_FAIL(t, t->at, "found a row with %s than %d cells; allowed: one for each heading; correct it",
                             is_line_end(t) ? "fewer" : "more", t->n_columns);
        }
        t->at += k + 1 < t->n_columns;
    }
    skip_line(t);
    return MOR_OK;
}

static mor_status make_room(table *t, mor_column_table *out, int *room)
{
    const int next = *room == 0 ? FIRST_ROOM : 2 * *room;
    double *values = NULL;
    if (out->n_rows < *room) {
        return MOR_OK;
    }
    MOR_TRY(t->context, MOR_NEW(t->context, &values, (int64_t)next * t->spec->n_columns, "rows of a table"));
    if (out->n_rows > 0) {
        memcpy(values, out->values, (size_t)out->n_rows * (size_t)t->spec->n_columns * sizeof *values);
    }
    MOR_FREE(t->context, &out->values);
    out->values = values;
    *room = next;
    return MOR_OK;
}

static mor_status read_rows(table *t, mor_column_table *out)
{
    const mor_column_spec *spec = t->spec;
    int room = 0;
    MOR_TRY(t->context, read_header(t));
    while (find_line(t)) {
        if (out->n_rows == spec->rows_max) {
            return CELL_FAIL(t, t->at,
                             "found more than %d rows, one for each %s; allowed: at most these; shorten the "
                             "table",
                             spec->rows_max, spec->row);
        }
        MOR_TRY(t->context, make_room(t, out, &room));
        MOR_TRY(t->context, read_row(t, out->values + (int64_t)out->n_rows * spec->n_columns));
        out->n_rows += 1;
    }
    if (out->n_rows == 0) {
        return CELL_FAIL(t, t->at, "found a table without a %s; allowed: a line for each after the headings; add one",
                         spec->row);
    }
    return MOR_OK;
}

mor_status mor_column_table_parse(mor_context *context, const mor_units *units, const char *name, const char *text,
                                  int64_t n_bytes, const mor_column_spec *spec, mor_column_table *out)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* before UTF-8 by some programs */
    const bool has_mark = n_bytes >= 3 && memcmp(text, mark, 3) == 0;
    table t = {.context = context,
               .units = units,
               .name = name,
               .text = text + (has_mark ? 3 : 0),
               .n_bytes = n_bytes - (has_mark ? 3 : 0),
               .line = 1,
               .spec = spec};
    *out = (mor_column_table){.values = NULL};
    const mor_status status = read_rows(&t, out);
    if (status != MOR_OK) {
        mor_column_table_clear(context, out);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

mor_status mor_column_table_read(mor_context *context, const mor_units *units, const char *path,
                                 const mor_column_spec *spec, mor_column_table *out)
{
    char *text = NULL;
    *out = (mor_column_table){.values = NULL};
    FILE *file = fopen(path, "rb");
    MOR_CHECK(context, file != NULL, MOR_ERROR_CONFIG,
              "%s: found a file that cannot be read (%s); allowed: %s; check the path", path, strerror(errno),
              spec->what);
    mor_status status = MOR_NEW(context, &text, MOR_COLUMN_TABLE_BYTES_MAX + 1, "text of a table");
    if (status == MOR_OK) {
        const size_t n = fread(text, 1, MOR_COLUMN_TABLE_BYTES_MAX + 1, file);
        if (ferror(file) != 0 || n > MOR_COLUMN_TABLE_BYTES_MAX) {
            status = MOR_FAIL(context, MOR_ERROR_CONFIG,
                              "%s: found a file that cannot be read or has more than %d bytes; allowed: %s; shorten it",
                              path, MOR_COLUMN_TABLE_BYTES_MAX, spec->what);
        } else {
            status = mor_column_table_parse(context, units, path, text, (int64_t)n, spec, out);
        }
    }
    fclose(file);
    MOR_FREE(context, &text);
    return status;
}

void mor_column_table_clear(mor_context *context, mor_column_table *out)
{
    MOR_FREE(context, &out->values);
    out->n_rows = 0;
}
