/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_WARNINGS_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_WARNINGS_H

#include "cases/driver/sweep/result/sweep_table.h"

/** @file
 *  What the members of a sweep warned of, each text once. Texts that differ in their numbers only are one. */

enum { MOR_SWEEP_WARNINGS_MAX = 64, MOR_SWEEP_WARNING_MEMBERS = 8 };

/** A text and who warned of it. */
typedef struct mor_sweep_warning {
    char *text;                             /* of the first of them, zero-terminated; owned */
    int members[MOR_SWEEP_WARNING_MEMBERS]; /* the first of them, from 0, ascending */
    int n_members;                          /* all of them, also those beyond the list */
    int last;                               /* the last of them */
} mor_sweep_warning;

/** All texts in the order of the members. Zeroed: none. Owner: the caller, who ends it with
 *  mor_sweep_warnings_clear. */
typedef struct mor_sweep_warnings {
    mor_sweep_warning items[MOR_SWEEP_WARNINGS_MAX]; /* shape [n] */
    int n;
    int n_left_out; /* warnings of members for which there was no room */
} mor_sweep_warnings;

/** Says whether two texts are the same but for their numbers.
 *  @param a, b [in]  zero-terminated */
bool mor_sweep_warnings_are_alike(const char *a, const char *b);

/** Adds the warnings of a member. Members are to come in ascending order.
 *  @param warnings [in,out]
 *  @param member   [in]      from 0
 *  @param path     [in]      zero-terminated; of its summary
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_sweep_warnings_add(mor_context *context, mor_sweep_warnings *warnings, int member, const char *path);

/** Adds the warnings of all members that are used.
 *  @param table    [in]      of a sweep that has ended
 *  @param folder   [in]      of the sweep, zero-terminated
 *  @param warnings [in,out]
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_sweep_warnings_collect(mor_context *context, const mor_sweep_table *table, const char *folder,
                                      mor_sweep_warnings *warnings);

/** Frees the texts.
 *  @param warnings [in,out]  becomes zeroed */
void mor_sweep_warnings_clear(mor_context *context, mor_sweep_warnings *warnings);

#endif
