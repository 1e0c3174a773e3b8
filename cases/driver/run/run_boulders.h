/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_BOULDERS_H
#define MOR_CASES_DRIVER_RUN_RUN_BOULDERS_H

#include "cases/driver/scene/simulation.h"
#include "core/io/table.h"

/** @file
 *  Files of what single boulders and particles did, for cases with the probes that remember it: boulders.csv and
 *  boulder_paths.csv with boulder_travel, displacements.csv with displacement. */

#define MOR_RUN_BOULDERS_FILE "boulders.csv"
#define MOR_RUN_BOULDER_PATHS_FILE "boulder_paths.csv"
#define MOR_RUN_DISPLACEMENTS_FILE "displacements.csv"

/** The places of free bodies over time. Zeroed: of none. Owner: the files of the run. */
typedef struct mor_run_boulders {
    mor_table table;
    int *bodies; /* shape [n]; numbers in the case of those that move freely; owned */
    int n;       /* number of them */
    double *row; /* shape [1 + 3 n]; a row, s and m; owned */
} mor_run_boulders;

/** Opens boulder_paths.csv for a new run or behind a restored state; nothing without a probe that asks for it.
 *  @param folder     [in]      zero-terminated; of the run
 *  @param is_resume  [in]      whether the state was restored
 *  Returns: as mor_table_create and mor_table_resume; MOR_ERROR_MEMORY. */
mor_status mor_run_boulders_open(mor_context *context, mor_run_boulders *it, const mor_simulation *simulation,
                                 const char *folder, bool is_resume);

/** Adds where the bodies are now, in the frame of the case.
 *  Returns: as mor_table_append. */
mor_status mor_run_boulders_add_row(mor_context *context, mor_run_boulders *it, const mor_simulation *simulation);

/** Waits until all rows are on the disk.
 *  Returns: as mor_table_sync. */
mor_status mor_run_boulders_sync(mor_context *context, mor_run_boulders *it);

/** Closes the table; accepts a zeroed one. */
void mor_run_boulders_close(mor_context *context, mor_run_boulders *it);

/** Writes boulders.csv and displacements.csv where probes ask for them.
 *  @param folder     [in]      zero-terminated; of the run
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_run_boulders_conclude(mor_context *context, const mor_simulation *simulation, const char *folder);

#endif
