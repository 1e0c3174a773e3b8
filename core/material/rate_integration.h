/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_RATE_INTEGRATION_H
#define MOR_CORE_MATERIAL_RATE_INTEGRATION_H

#include "core/base/guard.h"
#include "core/material/kit/material.h"

/** @file
 *  The operation advance_rate of a law that gives rates only (stress_rate): SUNDIALS integrates them over the step, one
 *  particle after the other, by one integrator per thread. Each particle starts anew, so that results do not depend on
 *  the particle before, the thread or the grouping.
 *
 *  Before that, a whole block of particles tries one step of the explicit method: those whose error passes are done.
 *
 *  Stress and tensors of the state are turned by half of the step's spin, integrated with the strain rate of the middle
 *  of the step, and turned by the other half: of second order in the angle of a step, as the built-in laws do it, and a
 *  rigid rotation is exact. */

/** What the integrations of an instance have taken; the same for any number of threads. */
typedef struct mor_integration_statistics {
    int64_t n_updates;   /* steps of particles, of calls of advance_rate that succeeded */
    int64_t n_sub_steps; /* accepted steps of the integrator */
    int64_t n_rejected;  /* steps repeated because the error was too large */
    int64_t n_rates;     /* evaluations of the law */
    int64_t n_failures;  /* calls of advance_rate that asked for a smaller step, each for its batch of particles */
} mor_integration_statistics;

enum { MOR_INTEGRATION_COUNTS = sizeof(mor_integration_statistics) / sizeof(int64_t) };

/** Gives an instance of a law with stress_rate its integrators, as many as the context has threads, and its
 *  advance_rate, to be called from loops of that context; does nothing to other instances.
 *  @param instance [in,out]  made by the model
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN for more than 32 numbers of stress and state; MOR_ERROR_ARGUMENT for settings out
 *  of range; MOR_ERROR_MEMORY. Cost: allocates here, never in an update. */
mor_status mor_rate_integration_init(mor_context *context, mor_material_instance *instance);

/** Guards each call of the law from now on: one that crashes ends the update with MOR_ERROR_CRASH, and the integrators
 *  can be used again. Accepts an instance without integrators.
 *  @param instance [in,out]  NULL: does nothing
 *  @param guard    [in]      NULL: none, as after mor_rate_integration_init
 *  Threads: outside of parallel loops. */
void mor_rate_integration_set_guard(mor_material_instance *instance, mor_guard guard);

/** Frees the integrators; accepts an instance without. */
void mor_rate_integration_clear(mor_context *context, mor_material_instance *instance);

/** The counts of an instance in the order of mor_integration_statistics, for saving and restoring them; NULL for one
 *  without integrators.
 *  Returns: shape [MOR_INTEGRATION_COUNTS], owned by the instance. Threads: outside of parallel loops. */
int64_t *mor_rate_integration_counts(mor_material_instance *instance);

/** Adds what an instance has taken since it was made or set; an instance without integrators adds nothing.
 *  @param statistics [in,out]  numbers
 *  Threads: after the parallel loop. */
void mor_rate_integration_add(const mor_material_instance *instance, mor_integration_statistics *statistics);

#endif
