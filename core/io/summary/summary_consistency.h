/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_SUMMARY_SUMMARY_CONSISTENCY_H
#define MOR_CORE_IO_SUMMARY_SUMMARY_CONSISTENCY_H

#include "core/io/summary/summary.h"

/** @file
 *  Whether a summary that is to be written is consistent. For the writer of summaries alone. */

/** Checks a summary before it is written.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT as mor_summary_write. */
mor_status mor_summary_check_consistency(mor_context *context, const mor_summary *summary);

/** Returns the result of a probe, or NULL.
 *  @param probe   [in]  zero-terminated */
const mor_summary_result *mor_summary_find_result(const mor_summary *summary, const char *probe);

/** Returns the unit of a statistic of a result, zero-terminated.
 *  @param statistic [in]  zero-terminated */
const char *mor_summary_find_unit(const mor_summary_result *result, const char *statistic);

#endif
