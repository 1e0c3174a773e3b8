/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_DESIGN_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_DESIGN_H

#include "cases/driver/sweep/sweep.h"

/** @file
 *  The members of a sweep: all combinations of choices, the first variable slowest, each with all samples. Members that
 *  differ in replicates and samples alone are a group. A random variable has one Latin hypercube over the members of a
 *  group, replicates included, so that no two of them repeat a draw; groups of equal size have the same one. */

enum {
    MOR_SWEEP_OVERRIDES_MAX = 256, /* of them that a member can take */
    MOR_SWEEP_ALL_SETTINGS_MAX = MOR_SWEEP_SETTINGS_MAX * (MOR_SWEEP_VARIABLES_MAX + 1) + MOR_SWEEP_OVERRIDES_MAX,
    MOR_SWEEP_LABEL_BYTES = 128
};

/** The members. Owner: the caller, who ends it with mor_sweep_design_clear. */
typedef struct mor_sweep_design {
    const mor_sweep *sweep; /* borrowed */
    int n_members;
    int n_groups;
    int *choices;    /* shape [n_members, n_variables]; -1: the variable has no meaning for the member; 0: at random */
    double *samples; /* shape [n_members, n_variables]; of random variables, in their unit; else NaN */
    int *groups;     /* shape [n_members]; of each */
    int *firsts;     /* shape [n_groups]; first member of each */
} mor_sweep_design;

/** What a member sets over its case, in order. */
typedef struct mor_sweep_settings {
    const char *texts[MOR_SWEEP_ALL_SETTINGS_MAX]; /* shape [n] of "key=value"; owned by the sweep, or in room */
    int n;
    char room[MOR_SWEEP_VARIABLES_MAX][MOR_SWEEP_KEY_BYTES + 64 + MOR_SWEEP_UNIT_BYTES]; /* of random values */
} mor_sweep_settings;

/** Lists the members of a sweep.
 *  @param sweep  [in]   whole; outlives the design
 *  @param design [out]  clear it with mor_sweep_design_clear, after a failure, too
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when there are too many, or something that is set would have no effect;
 *  MOR_ERROR_MEMORY. */
mor_status mor_sweep_design_make(mor_context *context, const mor_sweep *sweep, mor_sweep_design *design);

/** Refuses members of a group that are one and the same case: statistics would count one run as two.
 *  @param hashes [in]  shape [n_members]; of their cases, 1; 0: it is not known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with the file and the first two members. */
mor_status mor_sweep_design_check_distinct(mor_context *context, const mor_sweep_design *design,
                                           const uint64_t *hashes);

/** Frees a design; accepts a zeroed one. */
void mor_sweep_design_clear(mor_context *context, mor_sweep_design *design);

/** Lists what a member sets: what the sweep sets, overrides, then its variables.
 *  @param member   [in]   0 <= member < n_members
 *  @param settings [out]  one record; valid as long as the sweep and itself
 *  Threads: safe to call concurrently. */
void mor_sweep_design_settings(const mor_sweep_design *design, const mor_units *units, int member,
                               mor_sweep_settings *settings);

/** Finds the case file of a member from the folder of the sweep file.
 *  @param member [in]  0 <= member < n_members
 *  Returns: zero-terminated, owned by the sweep. */
const char *mor_sweep_design_case(const mor_sweep_design *design, int member);

/** Returns the number that a variable has in a member, in its unit; NaN where it is none or has no meaning.
 *  @param member   [in]  0 <= member < n_members
 *  @param variable [in]  0 <= variable < n_variables */
double mor_sweep_design_value(const mor_sweep_design *design, int member, int variable);

/** Writes what a variable is in a member, as it was written; "" where it has no meaning.
 *  @param member   [in]   0 <= member < n_members
 *  @param variable [in]   0 <= variable < n_variables
 *  @param text     [out]  shape [MOR_SWEEP_LABEL_BYTES]; zero-terminated */
void mor_sweep_design_label(const mor_sweep_design *design, int member, int variable, char *text);

/** Writes the choices of a group, "content 20 %, friction rough"; "all" where there is one group alone.
 *  @param group   [in]   0 <= group < n_groups
 *  @param without [in]   bits of variables that are left out
 *  @param text    [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in bytes, > 0 */
void mor_sweep_design_describe(const mor_sweep_design *design, int group, unsigned without, char *text,
                               size_t text_bytes);

/** Whether a variable tells groups from one another: it is no replicate and not at random.
 *  @param variable [in]  0 <= variable < n_variables */
bool mor_sweep_design_is_factor(const mor_sweep *sweep, int variable);

#endif
