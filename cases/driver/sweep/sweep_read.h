/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_READ_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_READ_H

#include "cases/driver/case/reader/case_reader.h"
#include "cases/driver/sweep/sweep.h"

/** @file
 *  Parts of the reader of sweep files; used by this folder only. */

/** Reads what a variable takes: values, a range, choices or a distribution.
 *  @param node     [in]      its group
 *  @param variable [in,out]  its keys are read; receives choices or a distribution, and its unit
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_sweep_read_values(const mor_case_reader *reader, const mor_case_node *node,
                                 mor_sweep_variable *variable);

/** Reads a list of texts.
 *  @param group [in]   the group that has it
 *  @param name  [in]   zero-terminated; its name
 *  @param texts [out]  none where there is no such member; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_sweep_read_settings(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                   mor_sweep_texts *texts);

#endif
