/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_CATALOG_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_CATALOG_H

#include "cases/driver/sweep/result/sweep_table.h"

/** @file
 *  The probes that the cases of a sweep have, and the columns that follow from what the sweep file asks for. */

/** A probe. */
typedef struct mor_sweep_probe {
    char name[MOR_CASE_NAME_BYTES];
    char unit[MOR_SWEEP_UNIT_BYTES];         /* SI */
    char impulse_unit[MOR_SWEEP_UNIT_BYTES]; /* SI; "": it is no force */
    int member, place;                       /* the first member that has it, and where: the order of columns */
} mor_sweep_probe;

/** Probes of all members, whatever the order they were found in. A record filled with zeros is empty. */
typedef struct mor_sweep_catalog {
    mor_sweep_probe probes[MOR_CASE_PROBES_MAX]; /* shape [n] */
    int n;
    bool is_full;                       /* there are more */
    char conflict[MOR_CASE_NAME_BYTES]; /* a name with different units; "": none */
} mor_sweep_catalog;

/** Adds a probe of a member.
 *  @param found [in]  one probe */
void mor_sweep_catalog_add(mor_sweep_catalog *catalog, const mor_sweep_probe *found);

/** Finds the columns and thresholds of a table.
 *  @param catalog [in,out]  whole; put into order
 *  @param sweep   [in]      what is asked for
 *  @param table   [in,out]  receives them
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a probe that no case has, or a threshold of another kind. */
mor_status mor_sweep_catalog_columns(mor_context *context, mor_sweep_catalog *catalog, const mor_units *units,
                                     const mor_sweep *sweep, mor_sweep_table *table);

#endif
