/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_ROCK_LIST_H
#define MOR_CASES_DRIVER_CASE_ROCK_LIST_H

#include "core/base/context.h"
#include "core/base/units.h"

/** @file
 *  Rocks from a table of comma-separated values: the columns x, y, z (not in plane strain), diameter and, if wanted,
 *  density, in any order, each with its unit in brackets or in SI. */

enum { MOR_ROCK_LIST_ROWS_MAX = 4096 };

/** One row. */
typedef struct mor_rock_row {
    double position[3]; /* of the center, m; z = 0 in plane strain */
    double diameter;    /* of the ball (disc) of the same volume (area), m; > 0 */
    double density;     /* kg/m3; > 0; NaN: the table has none */
} mor_rock_row;

/** A table. Owner: the caller, who ends it with mor_rock_list_clear. */
typedef struct mor_rock_list {
    mor_rock_row *rows; /* shape [n_rows] */
    int n_rows;
} mor_rock_list;

/** Reads a table from its text.
 *  @param name      [in]      zero-terminated; the file's name, for messages
 *  @param text      [in]      shape [n_bytes]; any bytes
 *  @param n_bytes   [in]      length of text, >= 0
 *  @param dimension [in]      2 or 3
 *  @param list      [out]     empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "name:line:column: found ...; allowed: ...; do ..."; the column
 *  counts bytes from 1; MOR_ERROR_MEMORY. */
mor_status mor_rock_list_parse(mor_context *context, const mor_units *units, const char *name, const char *text,
                               int64_t n_bytes, int dimension, mor_rock_list *list);

/** Reads a table from a file.
 *  @param path      [in]      zero-terminated
 *  @param dimension [in]      2 or 3
 *  @param list      [out]     empty after a failure
 *  Returns: as mor_rock_list_parse; MOR_ERROR_CONFIG, too, for a file that cannot be read. */
mor_status mor_rock_list_read(mor_context *context, const mor_units *units, const char *path, int dimension,
                              mor_rock_list *list);

/** Frees the rows; accepts an empty list. */
void mor_rock_list_clear(mor_context *context, mor_rock_list *list);

#endif
