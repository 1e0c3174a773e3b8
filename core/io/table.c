/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/table.h"

#include "core/base/memory.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- lines ------------------------------------------------------------------------------------------------------- */

/* Reads a line of any length; true when there is one with its end, which is cut off. line grows as needed. */
static bool read_line(FILE *stream, char **line, size_t *capacity)
{
    const ssize_t n_bytes = getline(line, capacity, stream);
    if (n_bytes <= 0 || (*line)[n_bytes - 1] != '\n') {
        return false;
    }
    (*line)[n_bytes - 1] = '\0';
    for (ssize_t k = (ssize_t)strlen(*line); k < n_bytes - 1; ++k) {
        (*line)[k] = (*line)[k] == '\0' ? '?' : (*line)[k]; /* a zero byte must not hide what follows */
    }
    return true;
}

static bool has_first_line(FILE *stream)
{
    char *line = NULL;
    size_t capacity = 0;
    const bool has_line = read_line(stream, &line, &capacity);
    free(line);
    rewind(stream);
    return has_line;
}

/* Reads exactly n_columns numbers separated by commas; an empty one, of a column that was added later, is NaN. values
 * may be NULL to check only. */
static bool parse_row(const char *line, int n_columns, double *first, double *values)
{
    for (int column = 0; column < n_columns; ++column) {
        char *end = NULL;
        double value = strtod(line, &end);
        const bool is_empty = column > 0 && (*line == ',' || *line == '\0');
        if (is_empty) {
            value = NAN;
            end = (char *)line;
        }
        if ((end == line && !is_empty) || *end != (column + 1 < n_columns ? ',' : '\0')) {
            return false;
        }
        if (column == 0) {
            *first = value;
        }
        if (values != NULL) {
            values[column] = value;
        }
        line = end + 1;
    }
    return isfinite(*first);
}

static mor_status fail_row(mor_context *context, const char *path, int64_t line, const char *text, int n_columns)
{
    return MOR_FAIL(context, MOR_ERROR_IO,
                    "'%s', line %lld is damaged: found '%.60s', expected %d numbers separated by commas, the first a "
                    "time; repair the line or move the file away",
                    path, (long long)line, text, n_columns);
}

/* ---- header ------------------------------------------------------------------------------------------------------ */

static mor_status check_columns(mor_context *context, const mor_table_column *columns, int n_columns)
{
    MOR_CHECK(context, n_columns >= 1, MOR_ERROR_ARGUMENT, "a table of %d columns was asked for", n_columns);
    for (int column = 0; column < n_columns; ++column) {
        const char *name = columns[column].name;
        const char *unit = columns[column].unit;
        MOR_CHECK(context,
                  name[0] != '\0' && unit[0] != '\0' && strpbrk(name, ",\"[]\r\n") == NULL &&
                      strpbrk(unit, ",\"[]\r\n") == NULL,
                  MOR_ERROR_ARGUMENT,
                  "column %d named '%s' with unit '%s' cannot be used: neither may be empty or contain a comma, a "
                  "quote, a bracket or a line break",
                  column + 1, name, unit);
    }
    return MOR_OK;
}

static void write_header(FILE *stream, const mor_table_column *columns, int n_columns)
{
    for (int column = 0; column < n_columns; ++column) {
        fprintf(stream, "%s%s [%s]", column == 0 ? "" : ",", columns[column].name, columns[column].unit);
    }
    fputc('\n', stream);
}

/* Whether a line is the header of these columns. */
static bool is_header(const char *line, const mor_table_column *columns, int n_columns)
{
    for (int column = 0; column < n_columns; ++column) {
        const char *parts[5] = {column == 0 ? "" : ",", columns[column].name, " [", columns[column].unit, "]"};
        for (int part = 0; part < 5; ++part) {
            const size_t n_bytes = strlen(parts[part]);
            if (strncmp(line, parts[part], n_bytes) != 0) {
                return false;
            }
            line += n_bytes;
        }
    }
    return *line == '\0';
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

static mor_status fail_write(mor_context *context, const mor_table *table)
{
    return MOR_FAIL(context, MOR_ERROR_IO, "cannot write '%s': %s; check the free space of the disk", table->path,
                    strerror(errno));
}

mor_status mor_table_create(mor_context *context, mor_table *table, const char *path, const mor_table_column *columns,
                            int n_columns)
{
    memset(table, 0, sizeof *table);
    MOR_TRY(context, check_columns(context, columns, n_columns));
    MOR_TRY(context, mor_durable_file_join(context, table->path, "", path));
    table->stream = fopen(path, "wb");
    MOR_CHECK(context, table->stream != NULL, MOR_ERROR_IO, "cannot make '%s': %s", path, strerror(errno));
    table->n_columns = n_columns;
    write_header(table->stream, columns, n_columns);
    if (ferror(table->stream) != 0 || fflush(table->stream) != 0) {
        const mor_status status = fail_write(context, table);
        fclose(table->stream);
        table->stream = NULL;
        return status;
    }
    return MOR_OK;
}

/* Finds where the rows up to last_time end; the stream is initially after the header. */
static mor_status find_end(mor_context *context, mor_table *table, FILE *stream, double last_time, off_t *end)
{
    char *line = NULL;
    size_t capacity = 0;
    mor_status status = MOR_OK;
    for (int64_t n_lines = 2; read_line(stream, &line, &capacity); ++n_lines) {
        double time = 0.0;
        if (!parse_row(line, table->n_columns, &time, NULL)) {
            status = fail_row(context, table->path, n_lines, line, table->n_columns);
            break;
        }
        if (time > last_time) {
            break;
        }
        table->has_rows = true;
        table->last_time = time;
        *end = ftello(stream);
    }
    free(line);
    return status;
}

static mor_status find_rows_to_keep(mor_context *context, mor_table *table, FILE *stream,
                                    const mor_table_column *columns, double last_time, off_t *end)
{
    char *line = NULL;
    size_t capacity = 0;
    const bool has_line = read_line(stream, &line, &capacity);
    mor_status status = MOR_OK;
    if (!has_line || !is_header(line, columns, table->n_columns)) {
        status = MOR_FAIL(context, MOR_ERROR_IO,
                          "'%s' has other columns than this run writes: its first line is '%.200s'; move the file away "
                          "or use the case it was written by",
                          table->path, has_line ? line : "");
    }
    free(line);
    MOR_TRY(context, status);
    *end = ftello(stream);
    MOR_TRY(context, find_end(context, table, stream, last_time, end));
    return MOR_OK;
}

/* ---- more columns ------------------------------------------------------------------------------------------------ */

enum { CELL_BYTES = 256 };

/* Number of a cell in a header, -1: it is not there. */
static int find_cell(const char *header, const char *cell)
{
    const size_t n_bytes = strlen(cell);
    int number = 0;
    for (const char *at = header; at != NULL; ++number) {
        const char *comma = strchr(at, ',');
        const size_t n_here = comma != NULL ? (size_t)(comma - at) : strlen(at);
        if (n_here == n_bytes && memcmp(at, cell, n_bytes) == 0) {
            return number;
        }
        at = comma != NULL ? comma + 1 : NULL;
    }
    return -1;
}

static int count_cells(const char *header)
{
    int n = 1;
    for (const char *comma = strchr(header, ','); comma != NULL; comma = strchr(comma + 1, ',')) {
        n += 1;
    }
    return n;
}

/* Finds which column of the file each column is, -1 for a new one; whether all columns of the file are still there. */
static bool map_columns(const char *header, const mor_table_column *columns, int n_columns, int *source)
{
    int n_found = 0;
    for (int column = 0; column < n_columns; ++column) {
        char cell[CELL_BYTES];
        snprintf(cell, sizeof cell, "%s [%s]", columns[column].name, columns[column].unit);
        source[column] = find_cell(header, cell);
        n_found += source[column] >= 0;
    }
    return source[0] == 0 && n_found == count_cells(header);
}

/* Copies a row digit by digit; a new column stays empty. */
static void copy_row(const char *line, const int *source, int n_columns, FILE *out)
{
    for (int column = 0; column < n_columns; ++column) {
        const char *at = source[column] >= 0 ? line : NULL;
        for (int k = 0; k < source[column] && at != NULL; ++k) {
            at = strchr(at, ',');
            at = at != NULL ? at + 1 : NULL;
        }
        fprintf(out, "%s%.*s", column > 0 ? "," : "", at != NULL ? (int)strcspn(at, ",") : 0, at != NULL ? at : "");
    }
    fputc('\n', out);
}

/* Writes a table whose columns are some of those wanted anew, whole; leaves any other as it is. */
static mor_status add_columns(mor_context *context, const char *path, FILE *stream, const mor_table_column *columns,
                              int n_columns)
{
    char *line = NULL;
    size_t capacity = 0;
    int *source = NULL;
    mor_durable_file file = {.stream = NULL};
    mor_status status = MOR_NEW(context, &source, n_columns, "columns of a table");
    const bool has_header = status == MOR_OK && read_line(stream, &line, &capacity);
    if (has_header && !is_header(line, columns, n_columns) && map_columns(line, columns, n_columns, source)) {
        const int n_old = count_cells(line);
        status = mor_durable_file_open(context, &file, path);
        if (status == MOR_OK) {
            write_header(file.stream, columns, n_columns);
            while (read_line(stream, &line, &capacity)) {
                if (parse_row(line, n_old, &(double){0.0}, NULL)) {
                    copy_row(line, source, n_columns, file.stream);
                } else {
                    fprintf(file.stream, "%s\n", line); /* damaged, and refused as such when it is to be kept */
                }
            }
            status = mor_durable_file_commit(context, &file);
        }
    }
    free(line);
    MOR_FREE(context, &source);
    return status;
}

/* As add_columns, of a file that may be missing. */
static mor_status widen(mor_context *context, const char *path, const mor_table_column *columns, int n_columns)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        return MOR_OK;
    }
    const mor_status status = add_columns(context, path, stream, columns, n_columns);
    fclose(stream);
    return status;
}

mor_status mor_table_resume(mor_context *context, mor_table *table, const char *path, const mor_table_column *columns,
                            int n_columns, double last_time)
{
    memset(table, 0, sizeof *table);
    MOR_TRY(context, check_columns(context, columns, n_columns));
    MOR_TRY(context, widen(context, path, columns, n_columns));
    FILE *stream = fopen(path, "r+b");
    const bool is_missing = stream == NULL && errno == ENOENT;
    if (is_missing || (stream != NULL && !has_first_line(stream))) {
        mor_context_log(context, MOR_LOG_WARNING, "'%s' is %s; a new one is started without earlier rows", path,
                        is_missing ? "missing" : "empty");
        if (stream != NULL) {
            fclose(stream);
        }
        MOR_TRY(context, mor_table_create(context, table, path, columns, n_columns));
        return MOR_OK;
    }
    MOR_CHECK(context, stream != NULL, MOR_ERROR_IO, "cannot open '%s': %s", path, strerror(errno));
    table->n_columns = n_columns;
    off_t end = 0;
    mor_status status = mor_durable_file_join(context, table->path, "", path);
    if (status == MOR_OK) {
        status = find_rows_to_keep(context, table, stream, columns, last_time, &end);
    }
    if (status == MOR_OK && (ftruncate(fileno(stream), end) != 0 || fseeko(stream, end, SEEK_SET) != 0)) {
        status = fail_write(context, table);
    }
    if (status != MOR_OK) {
        fclose(stream);
        return mor_context_pass(context, status, MOR_HERE);
    }
    table->stream = stream;
    return MOR_OK;
}

static void write_number(FILE *stream, double value)
{
    if (isnan(value)) {
        fputs("nan", stream); /* without the sign that some libraries print */
    } else {
        fprintf(stream, "%.17g", value);
    }
}

mor_status mor_table_append(mor_context *context, mor_table *table, const double *values)
{
    MOR_CHECK(context, isfinite(values[0]) && (!table->has_rows || values[0] >= table->last_time), MOR_ERROR_ARGUMENT,
              "a row at %.17g s was to follow one at %.17g s in '%s'; times must be finite and not fall", values[0],
              table->last_time, table->path);
    for (int column = 0; column < table->n_columns; ++column) {
        if (column > 0) {
            fputc(',', table->stream);
        }
        write_number(table->stream, values[column]);
    }
    fputc('\n', table->stream);
    if (ferror(table->stream) != 0 || fflush(table->stream) != 0) {
        return fail_write(context, table);
    }
    table->has_rows = true;
    table->last_time = values[0];
    return MOR_OK;
}

mor_status mor_table_sync(mor_context *context, mor_table *table)
{
    if (fflush(table->stream) != 0 || fsync(fileno(table->stream)) != 0) {
        return fail_write(context, table);
    }
    return MOR_OK;
}

mor_status mor_table_close(mor_context *context, mor_table *table)
{
    if (table->stream == NULL) {
        return MOR_OK;
    }
    const int error = fclose(table->stream);
    table->stream = NULL;
    return error != 0 ? fail_write(context, table) : MOR_OK;
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

static mor_status keep_header(mor_context *context, mor_table_data *data, const char *line)
{
    const size_t n_bytes = strlen(line) + 1;
    MOR_TRY(context, MOR_NEW(context, &data->header, (int64_t)n_bytes, "the header of a table"));
    memcpy(data->header, line, n_bytes);
    data->n_columns = count_cells(line);
    return MOR_OK;
}

/* One pass over the file: counts rows while data->values is NULL, fills it in otherwise. */
static mor_status pass_over(mor_context *context, mor_table_data *data, const char *path, FILE *stream, char **line)
{
    size_t capacity = 0;
    rewind(stream);
    MOR_CHECK(context, read_line(stream, line, &capacity), MOR_ERROR_IO, "'%s' is not a table: it has no first line",
              path);
    if (data->header == NULL) {
        MOR_TRY(context, keep_header(context, data, *line));
    }
    int64_t n_rows = 0;
    while (read_line(stream, line, &capacity)) {
        double first = 0.0;
        double *row = data->values == NULL || n_rows >= data->n_rows ? NULL : data->values + n_rows * data->n_columns;
        if (!parse_row(*line, data->n_columns, &first, row)) {
            return fail_row(context, path, n_rows + 2, *line, data->n_columns);
        }
        n_rows += 1;
    }
    data->n_rows = data->values == NULL || n_rows < data->n_rows ? n_rows : data->n_rows;
    return MOR_OK;
}

mor_status mor_table_data_read(mor_context *context, mor_table_data *data, const char *path)
{
    memset(data, 0, sizeof *data);
    FILE *stream = fopen(path, "rb");
    MOR_CHECK(context, stream != NULL, MOR_ERROR_IO, "cannot open '%s': %s", path, strerror(errno));
    char *line = NULL;
    mor_status status = pass_over(context, data, path, stream, &line);
    free(line);
    line = NULL;
    if (status == MOR_OK && data->n_rows > 0) {
        status = MOR_NEW(context, &data->values, data->n_rows * data->n_columns, "the rows of a table");
        if (status == MOR_OK) {
            status = pass_over(context, data, path, stream, &line);
        }
        free(line);
    }
    fclose(stream);
    if (status != MOR_OK) {
        mor_table_data_clear(context, data);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_table_data_clear(mor_context *context, mor_table_data *data)
{
    MOR_FREE(context, &data->header);
    MOR_FREE(context, &data->values);
    memset(data, 0, sizeof *data);
}
