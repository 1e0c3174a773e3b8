/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_SCHEMA_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_SCHEMA_H

#include "cases/driver/case/schema/case_schema.h"

/** @file
 *  The language of sweep files as tables, as case_schema.h for cases. Parts are read by sweep_read.c. */

/** The top level; its record is mor_sweep. */
extern const mor_case_group mor_sweep_root_group;

/** Members of the lists vary, choices, results and exceed; records mor_sweep_variable, mor_sweep_choice,
 *  mor_sweep_measure and, of exceed, mor_sweep_measure as well. */
extern const mor_case_group mor_sweep_variable_group, mor_sweep_choice_group, mor_sweep_result_group,
    mor_sweep_exceed_group;

#endif
