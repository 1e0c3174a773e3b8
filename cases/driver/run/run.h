/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_H
#define MOR_CASES_DRIVER_RUN_RUN_H

#include "cases/driver/run/run_files.h"

/** @file
 *  A whole run: from a case file to a folder with snapshots, series, checkpoint, summary and pictures. */

/** How it went. */
typedef struct mor_run_outcome {
    bool is_finished;    /* the end of the case was reached */
    bool is_interrupted; /* the user stopped it */
    int n_missed;        /* expectations missed; 0 unless finished */
} mor_run_outcome;

/** Builds a case and runs it.
 *  @param context  [in,out]  errors and warnings go to log.txt of the folder and to the sink that was installed
 *  @param files    [in,out]  listening, with options, case and storage for a simulation; to be closed by the caller
 *  @param registry [in]      the material models
 *  Gives: the simulation as the run left it, to be cleared by the caller; zeroed when the case was refused.
 *  Returns: MOR_OK, also when stopped or when an expectation was missed; MOR_ERROR_CONFIG for bad input;
 *  MOR_ERROR_NUMERIC when a guard stopped it (the last good checkpoint is kept); MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run(mor_context *context, mor_run_files *files, const mor_registry *registry, mor_run_outcome *outcome);

#endif
