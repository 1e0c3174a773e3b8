/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_TABLE_H
#define MOR_CASES_DRIVER_RUN_RUN_TABLE_H

#include "cases/driver/case/case.h"
#include "core/io/summary/summary.h"

#include <stdio.h>

/** @file
 *  The tables at the end of a run: results with what they did over time, and measured against expected. */

/** Returns the index of the probe that an expectation names; the reader made sure that there is one.
 *  @param name     [in]  zero-terminated */
int mor_run_table_probe(const mor_case *the_case, const char *name);

/** Writes the lowest and the highest number that passes, in the unit of the expectation's statistic, 1 for numbers.
 *  @param low         [out]  one number
 *  @param high        [out]  one number */
void mor_run_table_limits(const mor_case_expectation *expectation, double *low, double *high);

/** Prints results and expectations. Remarks, windows and steps with nothing to measure stand under the table, with a
 *  number that the names of the results they are about carry.
 *  @param summary  [in]      its results have statistics
 *  @param out      [in,out]  one open stream
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_run_table_print(mor_context *context, const mor_case *the_case, const mor_summary *summary, FILE *out);

#endif
