/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_STEPPER_H
#define MOR_CORE_TIME_STEPPER_H

#include "core/time/stage.h"

/** @file
 *  Something that advances at its own rate: soil, a group of elastic bodies, a group of rigid ones. The schedule
 *  (core/time/schedule.h) owns time and tells steppers when to move. */

/** What a stepper can do. One constant table per kind. */
typedef struct mor_stepper_operations {
    const char *kind;
    /** Writes the longest stable step, one number, unit s, and a static word for what limits it. */
    mor_status (*propose)(mor_context *context, void *owner, double *step_length, const char **limit);
} mor_stepper_operations;

/** One stepper. Borrowed by the schedule; the owner object belongs to whoever made it. */
typedef struct mor_stepper {
    const char *name;
    const mor_stepper_operations *operations; /* never NULL */
    void *owner;                              /* first argument of operations and stages */
    const mor_stage *stages;                  /* shape [n_stages]; one step is all of them in order */
    int n_stages;
    int64_t n_particles;                      /* for the unit of account, particle-steps */
} mor_stepper;

#endif
