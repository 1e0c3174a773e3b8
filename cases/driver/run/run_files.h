/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_FILES_H
#define MOR_CASES_DRIVER_RUN_RUN_FILES_H

#include "cases/driver/case/schema/case_compare.h"
#include "cases/driver/run/run_boulders.h"
#include "cases/driver/run/run_folder.h"
#include "cases/driver/run/run_gauges.h"
#include "cases/driver/run/run_progress.h"
#include "cases/driver/run/run_warnings.h"
#include "cases/driver/run/stop.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "core/io/checkpoint.h"
#include "core/io/snapshot.h"
#include "core/io/summary/summary.h"
#include "core/io/table.h"

/** @file
 *  The files of a run's folder as the run loop uses them: what goes into a checkpoint, a row of the series, the
 *  summary. The formats are those of core/io. */

/** The case as it was used, in the folder of a run. */
#define MOR_RUN_CASE_FILE "case.resolved.cfg"

enum { MOR_RUN_COLUMNS_MAX = MOR_CASE_PROBES_MAX + 8, MOR_RUN_FACTS_MAX = 16, MOR_RUN_PLUGIN_BYTES = 640 };

/** What was asked for. All strings are zero-terminated and borrowed. */
typedef struct mor_run_options {
    const char *folder;  /* of the run; made when missing */
    bool is_resume;      /* go on from the folder's checkpoint */
    double stop_at;      /* stop with a checkpoint once this time is reached, s; NaN: at the end */
    const char *command; /* command line, for the provenance */
    const char *version; /* of the program */
    const char *commit;  /* the program was built from */
    mor_stop *stop;      /* whether the user requested a stop, and the phase of the run; NULL: never */
    FILE *output;        /* where the final table goes */
    FILE *progress;      /* where progress is shown; NULL: nowhere */
    bool is_terminal;    /* it can write over the line before */
} mor_run_options;

/** Numbers of what a run writes next. */
typedef struct mor_run_due {
    int64_t row; /* of the series */
    int64_t snapshot;
} mor_run_due;

/** A state of the run in memory, to which a run that fails can go back. */
typedef struct mor_run_kept {
    char *bytes;     /* a copy of the state, see mor_state_store */
    mor_run_due due; /* at that time */
    bool is_valid;   /* a state was kept */
} mor_run_kept;

/** Open files of a run and the numbers that go into them. Owner: the run. */
typedef struct mor_run_files {
    mor_context *context;           /* borrowed; that it listens to */
    const mor_run_options *options; /* borrowed */
    const mor_case *the_case;       /* borrowed */
    mor_simulation *simulation;     /* borrowed */
    FILE *log;                      /* log.txt; before it is open, early_text */
    char *early_text;               /* lines of the log before there was a folder */
    size_t n_early_bytes;           /* length of early_text */
    mor_run_warnings warnings;      /* what was warned of, before a resume as well */
    mor_log_sink previous_sink;     /* where warnings and errors go as well */
    void *previous_user;            /* its argument */
    bool is_folder_new;             /* there was no such folder before */
    mor_snapshot_writer snapshots;
    mor_snapshot_fact facts[MOR_RUN_FACTS_MAX]; /* provenance, shape [n_facts] */
    int n_facts;
    char seed_text[24];                                            /* seed as text, for the provenance */
    char hash_text[24];                                            /* hash of the case file as text */
    char plugin_text[MOR_CASE_PLUGINS_MAX * MOR_RUN_PLUGIN_BYTES]; /* path, models and hash of each plug-in, by lines */
    uint64_t case_hash;                                            /* of the case file; set by the caller */
    char *case_text;  /* zero-terminated; the case as it is used, which every checkpoint carries; freed by close */
    char *saved_text; /* zero-terminated; the case the folder was started with; NULL: a new run; likewise */
    mor_run_kept kept;
    mor_table series;
    mor_table_column columns[MOR_RUN_COLUMNS_MAX]; /* shape [n_columns] */
    int n_columns;
    int first_probe; /* column of the first probe */
    mor_run_gauges gauges;
    mor_run_boulders boulders;
    mor_run_progress progress;
} mor_run_files;

/** Begins to collect what is logged, for the log of a folder that is not there yet.
 *  @param context [in,out]  gets files as its sink
 *  @param files   [out]     to be closed, after a failure, too
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_run_files_listen(mor_context *context, mor_run_files *files);

/** Makes the folder and opens its log, which begins with what was collected.
 *  @param files   [in,out]  listening, with options
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_CONFIG when a new run would overwrite an old one. */
mor_status mor_run_files_open(mor_context *context, mor_run_files *files);

/** Prints the case. Of a new run it becomes case.resolved.cfg; on a resume it is compared with the case that the
 *  newest checkpoint carries, or, before the first checkpoint, with case.resolved.cfg: what a resume may not change
 *  (cases/driver/case/schema/case_compare.h) must be the same, the content of files included.
 *  @param is_resume [in]  the folder holds the case that is gone on with
 *  Returns: MOR_OK; MOR_ERROR_CONFIG naming the first difference; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_keep_case(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                   bool is_resume);

/** Finds the hash of the case, of all its values and of the contents of its files.
 *  @param files [in,out]  with the case
 *  @param hash  [out]     one number; 0 on failure
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_hash_case(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                   uint64_t *hash);

/** Finds the hash of the case that a folder holds, case.resolved.cfg.
 *  @param folder [in]   zero-terminated
 *  @param hash   [out]  one number; 0: it holds none
 *  Returns: MOR_OK; MOR_ERROR_IO for a path that is too long; MOR_ERROR_MEMORY. */
mor_status mor_run_files_hash_folder(mor_context *context, const char *folder, uint64_t *hash);

/** Finds the first difference between the case and the one that a folder holds, in whatever value.
 *  @param files      [in,out]  with the case
 *  @param folder     [in]      zero-terminated
 *  @param difference [out]     one record; none is found where the folder holds no case
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_compare_folder(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                        const char *folder, mor_case_difference *difference);

/** Writes case.resolved.cfg of a run that goes on, where it is missing or no longer tells the case.
 *  @param files   [in,out]  with the case
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_run_files_renew_case(mor_context *context, mor_run_files *files);

/** Opens snapshots and series, for a new run or behind the restored state.
 *  @param is_resume [in]      whether the state was restored from a checkpoint
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_start(mor_context *context, mor_run_files *files, bool is_resume);

/** Takes away a folder that was made by mor_run_files_open, with its log and the case, so that a case that is refused
 *  leaves no results behind. A folder that was there before, or holds anything else, stays, as do folders above it.
 *  @param files   [in,out]  still to be closed */
void mor_run_files_discard(mor_context *context, mor_run_files *files);

/** Leaves the folder of a run that was refused, or ended before its first row: listening again, with what was collected
 *  before, so that another folder may be opened. To be closed after a failure, too.
 *  @param context [in,out]  keeps its last error unless this fails
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_run_files_withdraw(mor_context *context, mor_run_files *files);

/** Closes everything and gives the context its sink back; accepts a zeroed object. */
void mor_run_files_close(mor_context *context, mor_run_files *files);

/** Adds a row to the series.
 *  Returns: MOR_OK; MOR_ERROR_IO; what a probe returns. */
mor_status mor_run_files_add_row(mor_context *context, mor_run_files *files);

/** Does to the state what adding a row does, without a row: measures the probes, and begins a new mean of the gauges.
 *  Returns: MOR_OK; what a probe returns. */
mor_status mor_run_files_take_row(mor_context *context, mor_run_files *files);

/** Adds a snapshot.
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_add_snapshot(mor_context *context, mor_run_files *files);

/** Writes the checkpoint.
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_save(mor_context *context, mor_run_files *files);

/** Saves the state alone, without a run's other files, into options->folder, which is made when missing.
 *  A checkpoint that it holds already must be of the same case.
 *  @param registry [in]  the models that the case was read with
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for the folder of a run, for another case, naming the first difference, and for a
 *  folder that another program is at work in; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_run_files_save_state(mor_context *context, mor_run_files *files, const mor_registry *registry);

/** Keeps the present state in memory, in place of the one kept before.
 *  @param files   [in,out]  started
 *  @param due     [in]      what is written next
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: copies the evolving fields; allocates the first time. */
mor_status mor_run_files_keep(mor_context *context, mor_run_files *files, const mor_run_due *due);

/** Goes back to the state kept in memory.
 *  @param files   [in,out]  with a state kept
 *  Returns: MOR_OK; what a material returns. */
mor_status mor_run_files_recall(mor_context *context, mor_run_files *files);

/** Restores the newest good checkpoint of the folder.
 *  @param is_restored [out]     one flag; false when the folder has no checkpoint yet
 *  Returns: MOR_OK; MOR_ERROR_IO naming the damaged files; MOR_ERROR_CONFIG for the state of another case. */
mor_status mor_run_files_restore(mor_context *context, mor_run_files *files, bool *is_restored);

/** Returns the hash of the state that stands in the summary. */
uint64_t mor_run_state_hash(mor_simulation *simulation);

/** Evaluates all probes and expectations, prints the table, writes summary.json. Of a run that failed no expectation is
 *  reached, and a probe that cannot be evaluated is not a number.
 *  @param particle_steps_per_second [in]      speed of the time loop, unit 1/s; NaN: no step was taken, the
 *                                             speed in a summary that is there already is kept
 *  @param failure                   [in]      NULL: the run reached its end
 *  @param n_missed                  [out]     one number; expectations missed
 *  Returns: MOR_OK; MOR_ERROR_IO; what a probe returns. */
mor_status mor_run_files_conclude(mor_context *context, mor_run_files *files, double particle_steps_per_second,
                                  const mor_summary_failure *failure, int *n_missed);

#endif
