/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_RECORD_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_RECORD_H

#include "cases/driver/element/element_settings.h"

/** @file
 *  What is recorded of a specimen: a table with a row for each step, its first columns the same for all laws, then the
 *  state of the law. Also a table that was measured, read from a file of such columns. */

/** The columns that all laws have, in the order of the table. */
typedef enum mor_element_column {
    MOR_ELEMENT_TIME,
    MOR_ELEMENT_AXIAL_STRAIN,
    MOR_ELEMENT_SHEAR_STRAIN,
    MOR_ELEMENT_EPS_V,
    MOR_ELEMENT_EPS_Q,
    MOR_ELEMENT_P,
    MOR_ELEMENT_Q,
    MOR_ELEMENT_NORMAL_STRESS,
    MOR_ELEMENT_SHEAR_STRESS,
    MOR_ELEMENT_FRICTION_ANGLE,
    MOR_ELEMENT_VOID_RATIO,
    MOR_ELEMENT_STRESS,
    MOR_ELEMENT_STRAIN = MOR_ELEMENT_STRESS + 6,
    MOR_ELEMENT_COLUMNS = MOR_ELEMENT_STRAIN + 6
} mor_element_column;

/** A table. Owner: the caller, who ends it with mor_element_record_clear. */
typedef struct mor_element_record {
    char name[MOR_ELEMENT_NAME_BYTES]; /* of the specimen, as "100 kPa" */
    const mor_material *material;      /* borrowed; NULL: a table that was measured, without state */
    int n_columns;                     /* of the table */
    int64_t n_rows;                    /* rows filled */
    int64_t capacity;                  /* rows there is room for */
    double *values;                    /* shape [capacity, n_columns]; NaN: not known */
    double start_void_ratio;           /* 1; NaN: not known */
    mor_status status;                 /* why the specimen stopped before the end of its path; MOR_OK: it did not */
    int64_t n_updates, n_rejected, n_iterations;
} mor_element_record;

/** Name and unit of a column that all laws have, static strings.
 *  @param column [in]   0 <= column < MOR_ELEMENT_COLUMNS
 *  @param unit   [out]  one pointer; zero-terminated */
const char *mor_element_column_name(int column, const char **unit);

/** Makes an empty table for a specimen.
 *  @param name       [in]      zero-terminated
 *  @param void_ratio [in]      at the start, 1; NaN: not known
 *  @param capacity   [in]      rows, >= 1
 *  @param record     [out]     the table
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_element_record_init(mor_context *context, const mor_material *material, const char *name,
                                   double void_ratio, int64_t capacity, mor_element_record *record);

/** Adds a row; does nothing when there is no room.
 *  @param is_signed [in]  as of mor_element_measure_all */
void mor_element_record_add(mor_element_record *record, const mor_element *element, bool is_signed);

/** Writes a table as comma-separated values, "name [unit]" in the first line.
 *  @param path [in]  zero-terminated; an existing file is replaced
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_element_record_write(mor_context *context, const mor_element_record *record, const char *path);

/** Whether a file begins as the tables of mor_element_record_write do.
 *  @param path [in]  zero-terminated */
bool mor_element_record_is_table(const char *path);

/** Reads a table that was measured: comma-separated values, "name [unit]" in the first line; columns of other names
 *  are passed over, which is logged as a warning, lines that begin with # too. Units may be any that convert to those
 *  of the results; a column without one is read in that of the results, which is logged as a warning, but for a void
 *  ratio, and a strain above 1 without a unit is refused.
 *  @param path   [in]   zero-terminated
 *  @param record [out]  the table
 *  Returns: MOR_OK; MOR_ERROR_CONFIG naming file and line; MOR_ERROR_IO when the tables of units are missing;
 *  MOR_ERROR_MEMORY. */
mor_status mor_element_record_read(mor_context *context, const char *path, mor_element_record *record);

/** Fills in what follows from what was measured: eps_v of a path that keeps the volume, 0; eps_q from axial_strain and
 *  eps_v, as of a cylinder; the void ratio from eps_v; the mobilized friction of
 *  a cylinder from p and q.
 *  @param path             [in]      that the specimen was taken along; NULL: not known
 *  @param start_void_ratio [in]      1; NaN: not known
 *  @param record           [in,out]  the table */
void mor_element_record_complete(const mor_element_path *path, double start_void_ratio, mor_element_record *record);

/** Frees what a table owns; accepts a zeroed one. */
void mor_element_record_clear(mor_context *context, mor_element_record *record);

#endif
