/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A table that was measured. */
#include "cases/driver/element/element_record.h"

#include "core/base/memory.h"
#include "core/base/nearest.h"
#include "core/base/number.h"
#include "core/base/units.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_BYTES = 128, FILE_COLUMNS_MAX = 256, ROWS_FIRST = 256, PASSED_BYTES = 1024 };

/* A file while it is read. */
typedef struct reader {
    mor_context *context;
    const char *path;
    mor_units *units;
    char *line; /* of getline */
    size_t line_bytes;
    int64_t line_number;             /* from 1 */
    int n_columns;                   /* of the file */
    int target[FILE_COLUMNS_MAX];    /* shape [n_columns]; column of the record; -1: passed over */
    double factor[FILE_COLUMNS_MAX]; /* shape [n_columns]; unit of the record by that of the file */
    bool is_bare[FILE_COLUMNS_MAX];  /* shape [n_columns]; a number with a unit, but the heading has none */
    int n_passed;                    /* columns that are passed over */
    char passed[PASSED_BYTES];       /* their names, and what they may be meant to be */
    char bare[PASSED_BYTES];         /* columns without a unit, with that which is assumed */
    mor_element_record *record;
} reader;

/* Copies the next cell of a line, without blanks and quotes around it. Returns what follows; NULL behind the last. */
static const char *take_cell(const char *line, char *cell)
{
    if (line == NULL) {
        return NULL;
    }
    line += strspn(line, " \t\"");
    const size_t n_bytes = strcspn(line, ",\r\n");
    size_t length = n_bytes;
    while (length > 0 && strchr(" \t\"", line[length - 1]) != NULL) {
        --length;
    }
    snprintf(cell, CELL_BYTES, "%.*s", (int)(length < CELL_BYTES ? length : CELL_BYTES - 1), line);
    return line[n_bytes] == ',' ? line + n_bytes + 1 : NULL;
}

/* The next line that is no comment; false at the end of the file. */
static bool next_line(reader *r, FILE *stream)
{
    while (getline(&r->line, &r->line_bytes, stream) > 0) {
        r->line_number += 1;
        const char *text = r->line + (strncmp(r->line, "\xef\xbb\xbf", 3) == 0 ? 3 : 0);
        if (text[strspn(text, " \t\r\n,")] != '\0' && text[0] != '#') {
            memmove(r->line, text, strlen(text) + 1);
            return true;
        }
    }
    return false;
}

/* Keeps the name of a column that is passed over; of many, those that fit. */
static void note_passed(reader *r, const char *name)
{
    const char *known[MOR_ELEMENT_COLUMNS];
    char text[3 * CELL_BYTES];
    const size_t used = strlen(r->passed);
    for (int k = 0; k < MOR_ELEMENT_COLUMNS; ++k) {
        const char *unit = NULL;
        known[k] = mor_element_column_name(k, &unit);
    }
    const int near = mor_nearest_find(name, known, MOR_ELEMENT_COLUMNS);
    snprintf(text, sizeof text, "%s'%s'%s%s%s", r->n_passed > 0 ? ", " : "", name, near >= 0 ? " (did you mean '" : "",
             near >= 0 ? known[near] : "", near >= 0 ? "'?)" : "");
    if (used + strlen(text) < sizeof r->passed) {
        memcpy(r->passed + used, text, strlen(text) + 1);
    }
    r->n_passed += 1;
}

/* Strains are what is most often written in percent. */
static bool is_strain(int column)
{
    return column == MOR_ELEMENT_AXIAL_STRAIN || column == MOR_ELEMENT_SHEAR_STRAIN || column == MOR_ELEMENT_EPS_V ||
           column == MOR_ELEMENT_EPS_Q || column >= MOR_ELEMENT_STRAIN;
}

/* Keeps the name of a column whose heading leaves the unit open; of many, those that fit. "[1]" says that it is a plain
 * number; a void ratio is nothing else. */
static void note_bare(reader *r, const char *name, const char *unit, const char *wanted, int column)
{
    char text[2 * CELL_BYTES];
    const bool is_number = strcmp(wanted, "1") == 0;
    const size_t used = strlen(r->bare);
    r->is_bare[column] = unit[0] == '\0' || (!is_number && (strcmp(unit, "1") == 0 || strcmp(unit, "-") == 0));
    if (!r->is_bare[column] || r->target[column] == MOR_ELEMENT_VOID_RATIO) {
        return;
    }
    snprintf(text, sizeof text, "%s'%s [%s]'", used > 0 ? ", " : "", name, wanted);
    if (used + strlen(text) < sizeof r->bare) {
        memcpy(r->bare + used, text, strlen(text) + 1);
    }
}

/* Which column of the record a heading "name [unit]" names, and the factor of its unit. */
static mor_status read_heading(reader *r, const char *cell, int column)
{
    char name[CELL_BYTES];
    char unit[CELL_BYTES] = "";
    const size_t length = strcspn(cell, "[");
    snprintf(name, sizeof name, "%.*s", (int)(length - (length > 0 && cell[length - 1] == ' ')), cell);
    if (cell[length] == '[') {
        snprintf(unit, sizeof unit, "%.*s", (int)strcspn(cell + length + 1, "]"), cell + length + 1);
    }
    r->target[column] = -1;
    for (int k = 0; k < MOR_ELEMENT_COLUMNS; ++k) {
        const char *wanted = NULL;
        char text[2 * CELL_BYTES];
        if (strcmp(name, mor_element_column_name(k, &wanted)) != 0) {
            continue;
        }
        snprintf(text, sizeof text, "1 %s", strcmp(unit, "1") == 0 || strcmp(unit, "-") == 0 ? "" : unit);
        const mor_status status = mor_units_convert(r->context, r->units, text, wanted, &r->factor[column]);
        if (status == MOR_ERROR_ARGUMENT) {
            char why[256];
            snprintf(why, sizeof why, "%.255s", r->context->message);
            return MOR_FAIL(r->context, MOR_ERROR_CONFIG,
                            "%s:%lld: found the column '%s': %s; allowed: a unit that converts to %s", r->path,
                            (long long)r->line_number, cell, why, wanted);
        }
        MOR_TRY(r->context, status);
        r->target[column] = k;
        note_bare(r, name, unit, wanted, column);
    }
    if (r->target[column] < 0 && name[0] != '\0') {
        note_passed(r, name);
    }
    return MOR_OK;
}

static mor_status read_header(reader *r)
{
    char cell[CELL_BYTES];
    bool has_any = false;
    for (const char *rest = r->line; rest != NULL;) {
        rest = take_cell(rest, cell);
        MOR_CHECK(r->context, r->n_columns < FILE_COLUMNS_MAX, MOR_ERROR_CONFIG,
                  "%s: found more than %d columns; remove those that are not needed", r->path, FILE_COLUMNS_MAX);
        MOR_TRY(r->context, read_heading(r, cell, r->n_columns));
        has_any = has_any || r->target[r->n_columns] >= 0;
        r->n_columns += 1;
    }
    MOR_CHECK(r->context, has_any, MOR_ERROR_CONFIG,
              "%s:%lld: found no column of an element test in the first line, but %s; allowed: names as "
              "'axial_strain [%%]', 'eps_v [%%]', 'eps_q', 'p [kPa]', 'q [kPa]', 'shear_strain', 'normal_stress', "
              "'shear_stress', 'void_ratio'; name the columns so",
              r->path, (long long)r->line_number, r->n_passed > 0 ? r->passed : "no name");
    if (r->n_passed > 0) {
        mor_context_log(r->context, MOR_LOG_WARNING,
                        "%s:%lld: passed over %d column%s, which are none of an element test: %s", r->path,
                        (long long)r->line_number, r->n_passed, r->n_passed == 1 ? "" : "s", r->passed);
    }
    if (r->bare[0] != '\0') {
        mor_context_log(r->context, MOR_LOG_WARNING,
                        "%s:%lld: found columns without a unit, read as %s; write the unit behind the name, as "
                        "'axial_strain [%%]' or 'p [kPa]'",
                        r->path, (long long)r->line_number, r->bare);
    }
    return MOR_OK;
}

static mor_status grow_record(reader *r)
{
    mor_element_record *record = r->record;
    mor_element_record larger = *record;
    if (record->n_rows < record->capacity) {
        return MOR_OK;
    }
    MOR_TRY(r->context, mor_element_record_init(r->context, NULL, record->name, NAN, 2 * record->capacity, &larger));
    memcpy(larger.values, record->values, (size_t)(record->n_rows * record->n_columns) * sizeof *larger.values);
    larger.n_rows = record->n_rows;
    mor_element_record_clear(r->context, record);
    *record = larger;
    return MOR_OK;
}

static int count_cells(const char *line)
{
    char cell[CELL_BYTES];
    int n = 0;
    for (const char *rest = line; rest != NULL; ++n) {
        rest = take_cell(rest, cell);
    }
    return n;
}

static mor_status read_row(reader *r)
{
    char cell[CELL_BYTES];
    const char *unit = NULL;
    MOR_TRY(r->context, grow_record(r));
    double *row = r->record->values + r->record->n_rows * r->record->n_columns;
    for (int k = 0; k < r->record->n_columns; ++k) {
        row[k] = NAN;
    }
    int column = 0;
    for (const char *rest = r->line; rest != NULL && column < r->n_columns; ++column) {
        double value = NAN;
        rest = take_cell(rest, cell);
        const bool is_empty = cell[0] == '\0' || mor_number_is_nan(cell, strlen(cell));
        if (r->target[column] < 0 || is_empty) {
            continue;
        }
        MOR_CHECK(r->context, mor_number_read(cell, strlen(cell), &value) && isfinite(value), MOR_ERROR_CONFIG,
                  "%s:%lld: found '%s' in column %d; allowed: a number with a decimal point, or nothing", r->path,
                  (long long)r->line_number, cell, column + 1);
        MOR_CHECK(
            r->context, !r->is_bare[column] || !is_strain(r->target[column]) || fabs(value) <= 1.0, MOR_ERROR_CONFIG,
            "%s:%lld: found %s in column %d, '%s' without a unit: a strain of more than 100 %%; write '%s [%%]' "
            "or '%s [1]' in the first line, whichever is meant",
            r->path, (long long)r->line_number, cell, column + 1, mor_element_column_name(r->target[column], &unit),
            mor_element_column_name(r->target[column], &unit), mor_element_column_name(r->target[column], &unit));
        row[r->target[column]] = value * r->factor[column];
    }
    const int n_cells = count_cells(r->line);
    MOR_CHECK(r->context, n_cells == r->n_columns, MOR_ERROR_CONFIG,
              "%s:%lld: found %d cells under %d names of columns; allowed: one for each name, empty where nothing was "
              "measured; numbers have a decimal point, not a comma",
              r->path, (long long)r->line_number, n_cells, r->n_columns);
    r->record->n_rows += 1;
    return MOR_OK;
}

static mor_status read_file(reader *r, FILE *stream)
{
    MOR_TRY(r->context, mor_units_new(r->context, &r->units));
    MOR_CHECK(r->context, next_line(r, stream), MOR_ERROR_CONFIG, "%s: found no line with names of columns", r->path);
    MOR_TRY(r->context, read_header(r));
    while (next_line(r, stream)) {
        MOR_TRY(r->context, read_row(r));
    }
    MOR_CHECK(r->context, r->record->n_rows > 0, MOR_ERROR_CONFIG, "%s: found no row of numbers", r->path);
    return MOR_OK;
}

mor_status mor_element_record_read(mor_context *context, const char *path, mor_element_record *record)
{
    reader r = {.context = context, .path = path, .record = record};
    const char *slash = strrchr(path, '/');
    memset(record, 0, sizeof *record);
    FILE *stream = fopen(path, "rb");
    MOR_CHECK(context, stream != NULL, MOR_ERROR_CONFIG, "cannot open '%s': %s", path, strerror(errno));
    mor_status status =
        mor_element_record_init(context, NULL, slash != NULL ? slash + 1 : path, NAN, ROWS_FIRST, record);
    if (status == MOR_OK) {
        status = read_file(&r, stream);
    }
    if (status != MOR_OK) {
        mor_element_record_clear(context, record);
    }
    mor_units_free(context, &r.units);
    free(r.line);
    fclose(stream);
    return status;
}

/* Of a cylinder, from p and q, which is negative where the axial stress is the smaller compression. */
static double find_friction(const double *row)
{
    const double q = fabs(row[MOR_ELEMENT_Q]);
    const double minor = row[MOR_ELEMENT_P] - (row[MOR_ELEMENT_Q] < 0.0 ? 2.0 : 1.0) * q / 3.0;
    return minor >= 0.0 && minor + q > 0.0 ? asin(q / (2.0 * minor + q)) : NAN;
}

/* eps_q of a cylinder: 2/3 (axial - radial) = axial - eps_v / 3. */
void mor_element_record_complete(const mor_element_path *path, double start_void_ratio, mor_element_record *record)
{
    const bool is_cylinder = path != NULL && path->measure == MOR_ELEMENT_AXIAL && !path->has_b;
    for (int64_t i = 0; i < record->n_rows; ++i) {
        double *row = record->values + i * record->n_columns;
        if (path != NULL && mor_element_path_keeps_volume(path) && isnan(row[MOR_ELEMENT_EPS_V])) {
            row[MOR_ELEMENT_EPS_V] = 0.0;
        }
        if (isnan(row[MOR_ELEMENT_EPS_Q]) && !(path != NULL && path->has_b)) {
            row[MOR_ELEMENT_EPS_Q] = row[MOR_ELEMENT_AXIAL_STRAIN] - row[MOR_ELEMENT_EPS_V] / 3.0;
        }
        if (isnan(row[MOR_ELEMENT_VOID_RATIO])) {
            row[MOR_ELEMENT_VOID_RATIO] = (1.0 + start_void_ratio) * exp(-row[MOR_ELEMENT_EPS_V]) - 1.0;
        }
        if (is_cylinder && isnan(row[MOR_ELEMENT_FRICTION_ANGLE])) {
            row[MOR_ELEMENT_FRICTION_ANGLE] = find_friction(row);
        }
    }
}
