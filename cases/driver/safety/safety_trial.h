/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_TRIAL_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_TRIAL_H

#include "cases/driver/safety/reduced_case.h"
#include "cases/driver/safety/safety_measure.h"
#include "core/material/registry.h"

#include <stdatomic.h>

/** @file
 *  One trial: the state at the start with the strength over a factor, until it is known whether it stands. */

/** What trials have in common. */
typedef struct mor_safety_setup {
    mor_reduced_case *reduced;
    const mor_registry *registry; /* borrowed */
    mor_safety_rules rules;
    mor_safety_reference reference; /* displacements count from here */
    char *state;                    /* shape [state_bytes]; all trials start from it; owned */
    int64_t state_bytes;
    double start;           /* time of that state, s */
    const atomic_int *stop; /* borrowed; ends a trial early when it becomes non-zero; NULL: never */
    void (*report)(void *user, double factor, const mor_safety_sample *last); /* called at each sample; NULL: not */
    void *user;                                                               /* handed to report */
} mor_safety_setup;

/** One trial. */
typedef struct mor_safety_trial {
    double factor; /* F, 1 */
    mor_safety_finding finding;
    mor_safety_sample *samples; /* shape [n_samples]; owned */
    int n_samples;
    double seconds;   /* simulated, s */
    uint64_t n_steps; /* taken */
} mor_safety_trial;

/** Takes the state of a simulation as that which trials start from, and displacements count from.
 *  @param height [in]  of the slope, m; NaN: found
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_safety_setup_keep(mor_context *context, mor_safety_setup *setup, const mor_simulation *simulation,
                                 double height);

/** Frees what it owns; accepts a zeroed one. */
void mor_safety_setup_clear(mor_context *context, mor_safety_setup *setup);

/** Makes a trial.
 *  @param factor     [in]   F > 0, 1
 *  @param trial      [out]  its samples are the caller's, who frees them with MOR_FREE, after a failure, too
 *  @param simulation [out]  one pointer; the simulation at the end of the trial, to be freed with
 *                           mor_safety_simulation_free; NULL after a failure
 *  Returns: MOR_OK, also when it was stopped: its verdict is then open; what building and stepping return. */
mor_status mor_safety_trial_run(mor_context *context, mor_safety_setup *setup, double factor, mor_safety_trial *trial,
                                mor_simulation **simulation);

/** The last sample of a trial, without units; NaN in all where it broke down before the first. */
mor_safety_sample mor_safety_trial_last(const mor_safety_trial *trial);

/** Builds the simulation of the reduced case as it is.
 *  @param simulation [out]  one pointer; NULL after a failure
 *  Returns: MOR_OK; as mor_simulation_init. */
mor_status mor_safety_simulation_new(mor_context *context, const mor_safety_setup *setup, mor_simulation **simulation);

/** Frees a simulation and sets the pointer to NULL; NULL is accepted.
 *  @param simulation [in,out]  the address of one pointer */
void mor_safety_simulation_free(mor_context *context, mor_simulation **simulation);

#endif
