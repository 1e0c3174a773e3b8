/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_H
#define MOR_CASES_DRIVER_RUN_RUN_H

#include "cases/driver/run/stop.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "core/material/registry.h"

#include <stdio.h>

/** @file
 *  A whole run: from a case file to a folder with snapshots, series, checkpoint, summary and pictures. */

/** What the command line asked for. All strings are zero-terminated and borrowed. */
typedef struct mor_run_options {
    const char *case_path;
    const char *folder;          /* of the run; made when missing */
    const char *const *settings; /* shape [n_settings] of "key=value" over the case file */
    int n_settings;
    bool is_resume;      /* go on from the folder's checkpoint */
    double stop_at;      /* stop with a checkpoint once this time is reached, s; NaN: at the end */
    const char *command; /* command line, for the provenance */
    const char *version; /* of the program */
    const char *commit;  /* the program was built from */
    mor_stop *stop;      /* asked whether the user wants to stop, told what the run is at; NULL: never */
    FILE *output;        /* where the final table goes */
    FILE *progress;      /* where progress is shown; NULL: nowhere */
    bool is_terminal;    /* it can write over the line before */
} mor_run_options;

/** How it went. */
typedef struct mor_run_outcome {
    bool is_finished;    /* the end of the case was reached */
    bool is_interrupted; /* the user stopped it */
    int n_missed;        /* expectations missed; 0 unless finished */
} mor_run_outcome;

/** Runs a case.
 *  @param context  [in,out]  its log sink is replaced during the call by log.txt of the folder, errors and
 *                            warnings still reach the sink that was installed
 *  @param registry [in]      the material models
 *  Returns: MOR_OK, also when stopped or when an expectation was missed; MOR_ERROR_CONFIG for bad input;
 *  MOR_ERROR_NUMERIC when a guard stopped it (the last good checkpoint is kept); MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run(mor_context *context, const mor_run_options *options, const mor_registry *registry,
                   mor_run_outcome *outcome);

#endif
