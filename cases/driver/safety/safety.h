/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_H

#include "cases/driver/run/run_warnings.h"
#include "cases/driver/safety/safety_body.h"
#include "cases/driver/safety/safety_search.h"
#include "cases/driver/safety/safety_trial.h"

#include <stdio.h>

/** @file
 *  The factor of safety of a case by reduction of the strength: prepares the state at the start, makes trials, and
 *  keeps what is to be told of them. Theory: docs/theory/strength_reduction.md. */

/** What is asked. Everything in it is borrowed. */
typedef struct mor_safety_request {
    const mor_case *the_case;
    const mor_registry *registry;
    double lower;  /* factor of the state at the start, 1; halved until the soil stands */
    double height; /* of the slope, m; NaN: found */
    mor_safety_bracket bracket;
    const atomic_int *stop;                                                   /* NULL: never */
    void (*report)(void *user, double factor, const mor_safety_sample *last); /* at each sample; NULL: not */
    void *user;                                                               /* handed to report */
    FILE *output;                                                             /* one line for each trial */
} mor_safety_request;

/** What was found. Owner: the caller, who ends it with mor_safety_clear. */
typedef struct mor_safety {
    mor_safety_setup setup;                         /* with the state at the start */
    mor_safety_trial trials[MOR_SAFETY_TRIALS_MAX]; /* in the order they were made */
    int n_trials;
    mor_safety_band band;
    bool is_stopped;
    bool stands;               /* the soil stands at the lowest factor that was tried */
    mor_simulation *mechanism; /* at the end of the failing trial of the smallest factor; NULL: none failed; owned */
    int mechanism_trial;       /* its index */
    mor_safety_body body;      /* of that trial */
    mor_run_warnings warnings; /* of the start and of the result; trials log nothing */
} mor_safety;

/** Finds the factor of safety.
 *  @param request [in]      what is asked
 *  @param it      [out]     to be cleared by the caller, after a failure, too
 *  Returns: MOR_OK, also when it was stopped or no bound was found; MOR_ERROR_CONFIG for a case whose strength cannot
 *  be reduced or that cannot be built; what settling and stepping return. */
mor_status mor_safety_find(mor_context *context, const mor_safety_request *request, mor_safety *it);

/** Frees what it owns; accepts a zeroed one. */
void mor_safety_clear(mor_context *context, mor_safety *it);

#endif
