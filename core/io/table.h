/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_TABLE_H
#define MOR_CORE_IO_TABLE_H

#include "core/io/durable_file.h"

#include <stdbool.h>

/** @file
 *  A table of numbers that grows by rows, as comma-separated values: series.csv. The first line names the columns with
 *  their units, "time [s],kinetic_energy [J]"; the first column is the time and never falls. Numbers have 17 digits, so
 *  that they are read back exactly; not-a-number is nan, infinities are inf and -inf. A cell is empty where a column
 *  was added later, which reads as not-a-number. Numbers are written and read with a decimal point, which is what a
 *  program has that does not change its locale. */

#define MOR_TABLE_SERIES_FILE "series.csv"

/** Names one column. */
typedef struct mor_table_column {
    const char *name; /* zero-terminated; without comma, quote, bracket or line break */
    const char *unit; /* zero-terminated; "1" for dimensionless; likewise */
} mor_table_column;

/** A table open for adding rows. Owner: the caller, who ends it with mor_table_close. */
typedef struct mor_table {
    FILE *stream;              /* NULL when closed */
    int n_columns;             /* numbers per row, the time included */
    bool has_rows;             /* whether last_time holds */
    double last_time;          /* first number of the last row, s */
    char path[MOR_PATH_BYTES]; /* for messages */
} mor_table;

/** A table read back. Owner: the caller, who ends it with mor_table_data_clear. */
typedef struct mor_table_data {
    int64_t n_rows;
    int n_columns;
    char *header;   /* zero-terminated first line; owned */
    double *values; /* shape [n_rows, n_columns], each column in the unit its header names; owned */
} mor_table_data;

/** Starts a new table, replacing a file of that name.
 *  @param table     [out]     storage supplied by the caller; closed on failure
 *  @param path      [in]      zero-terminated; copied
 *  @param columns   [in]      shape [n_columns]; the first is the time
 *  @param n_columns [in]      number of columns, >= 1
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_ARGUMENT for a name or unit that cannot be used. */
mor_status mor_table_create(mor_context *context, mor_table *table, const char *path, const mor_table_column *columns,
                            int n_columns);

/** Continues a table: rows later than a time are removed, and so is a last line without its end, which a killed program
 *  leaves. A missing or empty file is started again and logged as a warning. A file with some of the columns is written
 *  anew, whole, with empty cells in the columns that it did not have.
 *  @param table     [out]     storage supplied by the caller; closed on failure
 *  @param path      [in]      zero-terminated; copied
 *  @param columns   [in]      shape [n_columns]; those of the file must be among them
 *  @param n_columns [in]      number of columns, >= 1
 *  @param last_time [in]      time of the state the run goes on from, s; rows up to and including it stay
 *  Returns: MOR_OK; MOR_ERROR_IO, also when the columns differ or a row that would stay is damaged; the file is then
 *           unchanged; MOR_ERROR_ARGUMENT as mor_table_create. */
mor_status mor_table_resume(mor_context *context, mor_table *table, const char *path, const mor_table_column *columns,
                            int n_columns, double last_time);

/** Adds a row and flushes it to the operating system, so that a killed program loses nothing.
 *  @param values  [in]      shape [n_columns]; unit of each column as declared; values[0] finite, s, never falling
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_ARGUMENT for a time that is not finite or falls. */
mor_status mor_table_append(mor_context *context, mor_table *table, const double *values);

/** Waits until all rows are on the disk. Call it before a checkpoint is written, so that rows up to a checkpoint
 *  outlive a power failure.
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_table_sync(mor_context *context, mor_table *table);

/** Closes the table; accepts a zeroed or closed one.
 *  Returns: MOR_OK; MOR_ERROR_IO when the last rows cannot be written. */
mor_status mor_table_close(mor_context *context, mor_table *table);

/** Reads a table of any columns; a last line without its end is left out.
 *  @param data    [out]     storage supplied by the caller; empty on failure
 *  @param path    [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO, also for a damaged row, naming its line; MOR_ERROR_MEMORY.
 *  Cost: reads the file twice; allocates. */
mor_status mor_table_data_read(mor_context *context, mor_table_data *data, const char *path);

/** Frees what was read; accepts a zeroed object. */
void mor_table_data_clear(mor_context *context, mor_table_data *data);

#endif
