/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_WRITE_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_WRITE_H

#include "cases/driver/sweep/result/sweep_table.h"
#include "cases/driver/sweep/result/sweep_warnings.h"
#include "core/io/durable_file.h"

/** @file
 *  The files of a sweep: docs/guide/sweep.md describes them. Cells without a number are empty, members are null. */

#define MOR_SWEEP_MEMBERS_FILE "members.csv"
#define MOR_SWEEP_STATISTICS_FILE "sweep.csv"
#define MOR_SWEEP_EXCEED_FILE "exceed.csv"
#define MOR_SWEEP_SUMMARY_FILE "sweep.json"

/** How commands are written, and where a sweep comes from. Strings are zero-terminated and borrowed. */
typedef struct mor_sweep_provenance {
    const char *run_word, *set_word; /* what runs a case, and what stands before a setting */
    const mor_units *units;
    const char *version, *commit, *command; /* of the program */
    int n_threads;
    uint64_t sweep_hash; /* of the sweep file */
} mor_sweep_provenance;

/** Finds the path of a member's case: from the folder of the sweep file.
 *  @param member [in]   0 <= member < n_members
 *  @param path   [out]  shape [MOR_PATH_BYTES]; zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO when it is too long. */
mor_status mor_sweep_write_find_case(mor_context *context, const mor_sweep_design *design, int member, char *path);

/** Writes the command that repeats a member, words quoted for a shell, without an end of line.
 *  @param member [in]      0 <= member < n_members
 *  @param out    [in,out]  one open stream
 *  Returns: MOR_OK; MOR_ERROR_IO when a path is too long. */
mor_status mor_sweep_write_command(mor_context *context, const mor_sweep_design *design,
                                   const mor_sweep_provenance *provenance, int member, FILE *out);

/** Writes what tells one sweep from another: a line for the program, then one for each member: number, hash of its
 *  whole case, case file and settings.
 *  @param case_hashes [in]      shape [n_members]; 0: the case is refused
 *  @param out         [in,out]  one open stream */
void mor_sweep_write_design(const mor_sweep_design *design, const mor_sweep_provenance *provenance,
                            const uint64_t *case_hashes, FILE *out);

/** Replaces members.csv of a folder.
 *  @param folder [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_sweep_write_members(mor_context *context, const mor_sweep_table *table,
                                   const mor_sweep_provenance *provenance, const char *folder);

/** Replaces sweep.csv and, where thresholds are asked for, exceed.csv of a folder.
 *  @param folder [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_sweep_write_statistics(mor_context *context, mor_sweep_table *table, const char *folder);

/** Replaces sweep.json of a folder.
 *  @param warnings [in]  of the members
 *  @param folder   [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_sweep_write_summary(mor_context *context, mor_sweep_table *table, const mor_sweep_provenance *provenance,
                                   const mor_sweep_warnings *warnings, const char *folder);

/** Prints the statistics of the results, a table for each, the members that failed, and what members warned of.
 *  @param warnings [in]      of the members
 *  @param out      [in,out]  one open stream
 *  Returns: MOR_OK; MOR_ERROR_IO when a path is too long. */
mor_status mor_sweep_write_report(mor_context *context, mor_sweep_table *table, const mor_sweep_provenance *provenance,
                                  const mor_sweep_warnings *warnings, FILE *out);

/** Finds the folder of a member.
 *  @param folder [in]   of the sweep, zero-terminated
 *  @param member [in]   0 <= member < n_members
 *  @param path   [out]  shape [MOR_PATH_BYTES]; zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO when it is too long. */
mor_status mor_sweep_write_find_folder(mor_context *context, const char *folder, int member, char *path);

/** Writes the number of a member as its folder is named.
 *  @param member [in]   0 <= member < n_members
 *  @param text   [out]  shape [16]; zero-terminated: "007" */
void mor_sweep_write_number(int member, char *text);

#endif
