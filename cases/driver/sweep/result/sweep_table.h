/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_TABLE_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_TABLE_H

#include "cases/driver/sweep/result/sweep_statistics.h"
#include "cases/driver/sweep/sweep_design.h"

/** @file
 *  What the members of a sweep gave, and what their groups say. */

enum {
    MOR_SWEEP_COLUMNS_MAX = MOR_CASE_PROBES_MAX + MOR_SWEEP_MEASURES_MAX,
    MOR_SWEEP_REASON_BYTES = 1024,
    MOR_SWEEP_NAME_BYTES = MOR_CASE_NAME_BYTES + 16
};

/** What a member is at. */
typedef enum mor_sweep_state {
    MOR_SWEEP_STATE_WAITING,
    MOR_SWEEP_STATE_RUNNING,
    MOR_SWEEP_STATE_FINISHED,
    MOR_SWEEP_STATE_MISSED, /* finished, and an expectation of its case was missed */
    MOR_SWEEP_STATE_FAILED,
    MOR_SWEEP_STATE_INTERRUPTED, /* it can be resumed */
    MOR_SWEEP_STATES
} mor_sweep_state;

/** Words for the states, in their order, for tables. */
extern const char *const mor_sweep_state_words[MOR_SWEEP_STATES];

/** One result of all members. */
typedef struct mor_sweep_column {
    char probe[MOR_CASE_NAME_BYTES];
    mor_case_statistic statistic;
    char unit[MOR_SWEEP_UNIT_BYTES]; /* SI, "1" for none */
} mor_sweep_column;

/** How a member ended. */
typedef struct mor_sweep_outcome {
    mor_sweep_state state;
    int n_missed;                        /* expectations */
    int n_warnings;                      /* in its summary */
    char reason[MOR_SWEEP_REASON_BYTES]; /* why it failed, zero-terminated */
} mor_sweep_outcome;

/** A question of exceedance, in the unit of its column. */
typedef struct mor_sweep_threshold {
    int column;
    double value; /* unit of the column */
} mor_sweep_threshold;

/** The table. Owner: the caller, who ends it with mor_sweep_table_clear. */
typedef struct mor_sweep_table {
    const mor_sweep_design *design;                  /* borrowed */
    mor_sweep_column columns[MOR_SWEEP_COLUMNS_MAX]; /* shape [n_columns]; results, then what exceed asks for besides */
    int n_results;
    int n_columns;
    mor_sweep_threshold thresholds[MOR_SWEEP_MEASURES_MAX]; /* shape [n_exceed of the sweep] */
    double *values;              /* shape [n_members, n_columns]; unit of the column; NaN: there is none */
    bool *has_probe;             /* shape [n_members, n_columns]; the case of the member has the probe */
    mor_sweep_outcome *outcomes; /* shape [n_members] */
    double *room;                /* shape [n_members]; values of a group while they are evaluated */
} mor_sweep_table;

/** Numbers of members. */
typedef struct mor_sweep_counts {
    int n_members;
    int by_state[MOR_SWEEP_STATES];
    int n_used; /* finished, expectations missed or not */
} mor_sweep_counts;

/** What a question of exceedance comes to; NaN: no member is counted, or it is not said what absent ones count as. */
typedef struct mor_sweep_probability {
    int n, n_hits;           /* members that are counted, and those beyond the threshold */
    int n_absent;            /* members that have the probe and had nothing to measure, counted or not */
    double share, low, high; /* probability and its interval, 1 */
} mor_sweep_probability;

/** Makes the table of a design, without columns: all members are waiting.
 *  @param design [in]   outlives the table
 *  @param table  [out]  clear it with mor_sweep_table_clear, after a failure, too
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_sweep_table_make(mor_context *context, const mor_sweep_design *design, mor_sweep_table *table);

/** Makes room for the values of the columns, which are known from here on.
 *  @param table  [in,out]  with columns
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_sweep_table_add_values(mor_context *context, mor_sweep_table *table);

/** Frees a table; accepts a zeroed one. */
void mor_sweep_table_clear(mor_context *context, mor_sweep_table *table);

/** Counts the members of a group.
 *  @param group  [in]   0 <= group < n_groups; -1: all
 *  @param counts [out]  one record */
void mor_sweep_table_count(const mor_sweep_table *table, int group, mor_sweep_counts *counts);

/** Whether the values of a member are used.
 *  @param member [in]  0 <= member < n_members */
bool mor_sweep_table_is_used(const mor_sweep_table *table, int member);

/** Finds the statistics of a result over a group, of the members that have it.
 *  @param group  [in]   0 <= group < n_groups
 *  @param column [in]   0 <= column < n_columns
 *  @param found  [out]  one record, unit of the column */
void mor_sweep_table_evaluate(mor_sweep_table *table, int group, int column, mor_sweep_statistics *found);

/** Counts the members of a group that ran to their end and have the probe of a column, but had nothing to measure.
 *  @param group  [in]   0 <= group < n_groups; -1: all
 *  @param column [in]   0 <= column < n_columns */
int mor_sweep_table_count_absent(const mor_sweep_table *table, int group, int column);

/** Finds how often a result is beyond a threshold in a group, of the members that ran to their end and have the probe.
 *  Those that had nothing to measure count as the sweep says.
 *  @param group  [in]   0 <= group < n_groups
 *  @param index  [in]   0 <= index < n_exceed of the sweep
 *  @param found  [out]  one record */
void mor_sweep_table_exceed(mor_sweep_table *table, int group, int index, mor_sweep_probability *found);

/** Names a column: "run_out", or "force maximum" where it is not the last value.
 *  @param column [in]   0 <= column < n_columns
 *  @param name   [out]  shape [MOR_SWEEP_NAME_BYTES]; zero-terminated */
void mor_sweep_table_name(const mor_sweep_table *table, int column, char *name);

/** Returns the word for what absent members count as, a static string; "" where the file does not say it.
 *  @param absent [in]  which */
const char *mor_sweep_absent_word(mor_sweep_absent absent);

/** Returns the word of a statistic, a static string.
 *  @param statistic [in]  which */
const char *mor_sweep_statistic_word(mor_case_statistic statistic);

#endif
