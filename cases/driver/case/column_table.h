/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_COLUMN_TABLE_H
#define MOR_CASES_DRIVER_CASE_COLUMN_TABLE_H

#include "core/base/context.h"
#include "core/base/units.h"

#include <stdbool.h>

/** @file
 *  A table of comma-separated values with named columns in any order, each with its unit in brackets behind its name,
 *  or in SI. */

enum { MOR_COLUMNS_MAX = 8, MOR_COLUMN_TABLE_BYTES_MAX = 1 << 23 };

/** A column that a table may have. */
typedef struct mor_column {
    const char *name; /* as in the heading */
    const char *unit; /* in which its values are returned */
    bool is_positive; /* values are above zero */
    bool is_needed;   /* the table must have it */
    bool has_unit;    /* its heading must tell its unit: the one it is returned in is not what most expect */
} mor_column;

/** What a table may hold. */
typedef struct mor_column_spec {
    const mor_column *columns; /* shape [n_columns] */
    int n_columns;             /* at most MOR_COLUMNS_MAX */
    int rows_max;
    const char *what;   /* for messages: "a table of rocks" */
    const char *row;    /* likewise, what a row is of: "rock" */
    const char *remark; /* likewise, behind the names of the columns; "" */
} mor_column_spec;

/** A table. Owner: the caller, who ends it with mor_column_table_clear. */
typedef struct mor_column_table {
    double *values; /* shape [n_rows, n_columns of its spec]; units of the columns; NaN: the table has no such column */
    int n_rows;
} mor_column_table;

/** Reads a table from its text.
 *  @param name    [in]      zero-terminated; the file's name, for messages
 *  @param text    [in]      shape [n_bytes]; any bytes
 *  @param n_bytes [in]      length of text, >= 0
 *  @param spec    [in]      what it may hold
 *  @param out     [out]     empty after a failure
 *  Returns: MOR_OK, with at least one row; MOR_ERROR_CONFIG with a message "name:line:column: found ...; allowed: ...;
 *  do ..."; the column counts bytes from 1; MOR_ERROR_MEMORY. */
mor_status mor_column_table_parse(mor_context *context, const mor_units *units, const char *name, const char *text,
                                  int64_t n_bytes, const mor_column_spec *spec, mor_column_table *out);

/** Reads a table from a file.
 *  @param path [in]      zero-terminated
 *  @param spec [in]      what it may hold
 *  @param out  [out]     empty after a failure
 *  Returns: as mor_column_table_parse; MOR_ERROR_CONFIG, too, for a file that cannot be read. */
mor_status mor_column_table_read(mor_context *context, const mor_units *units, const char *path,
                                 const mor_column_spec *spec, mor_column_table *out);

/** Frees the values; accepts an empty table. */
void mor_column_table_clear(mor_context *context, mor_column_table *out);

#endif
