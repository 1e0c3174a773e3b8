/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_FAILURE_H
#define MOR_CASES_DRIVER_RUN_RUN_FAILURE_H

#include "cases/driver/run/run_files.h"

/** @file
 *  What is written of a run that a check stopped: results, pictures and a snapshot of its last finished step. A step
 *  that fails leaves arrays half changed; the run goes back to a state kept in memory and takes the steps since then
 *  once more, which gives the same bits. */

enum { MOR_RUN_KEEP_INTERVAL = 64 /* steps from one state kept in memory to the next */ };

/** Writes the stress update that failed, where one did, to failed-point.cfg; goes back to the last finished step, adds
 *  its row and a snapshot, prints the table, writes summary.json and the pictures.
 *  @param context [in,out]  holds the error that stopped the run, and does so again on return; what cannot
 *                           be written is logged as a warning
 *  @param files   [in,out]  started, with a state kept
 *  @param retake  [in]      takes one step of the run, without files but with what a row does to the state; what is
 *                           due next in and out
 *  Returns: the status of the error that stopped the run. */
mor_status mor_run_conclude_failure(mor_context *context, mor_run_files *files,
                                    mor_status (*retake)(mor_context *context, mor_run_files *files, mor_run_due *due));

#endif
