/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_GAUGES_H
#define MOR_CASES_DRIVER_RUN_RUN_GAUGES_H

#include "cases/driver/gauge/gauge.h"
#include "cases/driver/gauge/gauge_table.h"
#include "core/io/summary/summary.h"
#include "core/io/table.h"

/** @file
 *  The files of gauges in the folder of a run: gauges.csv over time; gauge_peaks.csv and maps of pressure
 *  at its end. Their peaks are in summary.json, too. */

enum {
    MOR_RUN_GAUGE_NAME_BYTES = MOR_CASE_NAME_BYTES + 32,
    MOR_RUN_GAUGE_RESULTS = MOR_GAUGE_PEAKS + 3, /* of a gauge: its peaks, the last normal force, two impulses */
    MOR_RUN_GAUGE_RESULTS_MAX = MOR_CASE_GAUGES_MAX * MOR_RUN_GAUGE_RESULTS
};

/** The texts of the results of gauges. */
typedef struct mor_run_gauge_texts {
    char names[MOR_RUN_GAUGE_RESULTS_MAX][MOR_RUN_GAUGE_NAME_BYTES];
    char filters[MOR_CASE_GAUGES_MAX][MOR_GAUGE_FILTER_BYTES + 16];
} mor_run_gauge_texts;

/** The table of the gauges of a run. Zeroed: of none. Owner: the files of the run. */
typedef struct mor_run_gauges {
    mor_table table;
    char names[MOR_CASE_GAUGES_MAX * MOR_GAUGE_COLUMNS][MOR_RUN_GAUGE_NAME_BYTES];
} mor_run_gauges;

/** Opens gauges.csv for a new run or behind a restored state; nothing where there are no gauges.
 *  @param folder    [in]      zero-terminated; of the run
 *  @param is_resume [in]      whether the state was restored
 *  @param time      [in]      of that state, unit s
 *  Returns: as mor_table_create and mor_table_resume. */
mor_status mor_run_gauges_open(mor_context *context, mor_run_gauges *it, const mor_case *the_case, const char *folder,
                               bool is_resume, double time);

/** Adds a row: means since the last one, and the largest filtered normal force in between.
 *  @param gauges  [in,out]  a new row begins
 *  @param time    [in]      now, unit s
 *  Returns: as mor_table_append. */
mor_status mor_run_gauges_add_row(mor_context *context, mor_run_gauges *it, mor_gauges *gauges, double time);

/** Waits until all rows are on the disk.
 *  Returns: as mor_table_sync. */
mor_status mor_run_gauges_sync(mor_context *context, mor_run_gauges *it);

/** Closes the table; accepts a zeroed one. */
void mor_run_gauges_close(mor_context *context, mor_run_gauges *it);

/** Writes gauge_peaks.csv and, for each gauge with a map, gauge_NAME_map.csv; nothing where there are no gauges.
 *  @param folder  [in]      zero-terminated; of the run
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_run_gauges_conclude(mor_context *context, const mor_gauges *gauges, const char *folder);

/** Warns of each gauge whose peak rose in the last tenth of the run by more than 2 %, so that its largest load may come
 *  later, or which is loaded against its direction, so that its peak is the smallest load.
 *  @param folder  [in]      zero-terminated; of the run, which holds gauges.csv up to its end
 *  Returns: as mor_table_data_read. */
mor_status mor_run_gauges_warn(mor_context *context, const mor_gauges *gauges, const char *folder);

/** Lists the numbers of gauge_peaks.csv as results "gauge.NAME.peak_normal" and so on, each with the filter of its
 *  gauge as a remark where it is filtered. No probe can have such a name.
 *  @param texts   [out]  what the results borrow
 *  @param results [out]  shape [MOR_RUN_GAUGE_RESULTS_MAX]; NaN where nothing was measured
 *  Returns: how many there are. */
int mor_run_gauges_results(const mor_gauges *gauges, mor_run_gauge_texts *texts, mor_summary_result *results);

/** Prints the peaks as a table; nothing where there are no gauges.
 *  @param out     [in,out]  one open stream */
void mor_run_gauges_print(const mor_gauges *gauges, FILE *out);

#endif
