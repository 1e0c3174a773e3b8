/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_STEPPER_H
#define MOR_CORE_TIME_STEPPER_H

#include "core/particle/state.h"
#include "core/time/view.h"

#include <stdbool.h>

/** @file
 *  Something that advances at its own rate: soil, a group of elastic bodies, a group of rigid ones. The schedule
 *  (core/time/schedule.h) owns time and tells steppers when to move. */

/** What a stepper can do. One constant table per kind. */
typedef struct mor_stepper_operations {
    const char *kind;
    /** Writes the longest stable step, one number, unit s (INFINITY: any), and a static word for what limits it. */
    mor_status (*propose)(mor_context *context, void *owner, double *step_length, const char **limit);
    /** Of a follower, NULL: nothing to do. Called once before the leaders' first stages of a common step: the follower
     *  shows the leaders where it will be in the middle of the step. */
    mor_status (*begin)(mor_context *context, void *owner, const mor_step *step);
    /** Of a follower, NULL: nothing to do. Called once after the sub-steps of a common step. */
    mor_status (*finish)(mor_context *context, void *owner, const mor_step *step);
    /** Lists what a run that is resumed needs of the owner and that does not follow from the case. NULL: nothing. */
    mor_status (*list_state)(mor_context *context, void *owner, mor_state_list *list);
    /** Makes everything else of the owner follow what was listed and has been put back. NULL: nothing does. */
    mor_status (*resume)(mor_context *context, void *owner);
} mor_stepper_operations;

/** Is shown one shared array: job, MOR_RESOURCE_..., values of any unit or NULL, number of values. */
typedef void (*mor_shared_visit)(void *job, int resource, double *values, int64_t n_values);

/** One stepper. Borrowed by the schedule; the owner object belongs to whoever made it. */
typedef struct mor_stepper {
    const char *name;
    const mor_stepper_operations *operations; /* never NULL */
    void *owner;                              /* first argument of operations and stages */
    const mor_stage *stages;                  /* shape [n_stages]; one step is all of them in order */
    int n_stages;
    int n_before;        /* stages before the exchange: of a leader, with all followers; of a
                                               * follower, with its partners (contact) */
    int64_t n_particles; /* for the unit of account, particle-steps */
    bool is_leader;      /* takes the common step; followers take sub-steps within it */
    mor_set *set;        /* whose fields the stages declare; borrowed; NULL: none */
    uint64_t evolving;   /* bits that hold valid data when a step begins; mor_schedule_add sets it */
    /** Of a checked run, NULL: none. Calls visit(job, ...) for each array of numbers that stages hand on beside the
     *  fields, or must leave alone. A stage that declares to write one sets every value of it; what does not evolve is
     *  filled with NaN when a step begins. */
    void (*visit_shared)(void *owner, mor_shared_visit visit, void *job);
} mor_stepper;

/** Runs one stage of a stepper with its view, or skips it when it is switched off. In a checked run its declaration is
 *  proved.
 *  @param index [in]  of the stage
 *  Returns: what the stage returns; MOR_ERROR_INTERNAL for a breach of its declaration. */
mor_status mor_stepper_run_stage(mor_context *context, const mor_stepper *stepper, int index, const mor_step *step);

/** What happens among followers in the middle of a sub-step. Borrowed by the schedule. */
typedef struct mor_exchange {
    void *owner; /* first argument of the functions */
    /** For each of the n_steppers steppers writes into partners, shape [n_steppers], the bits of the steppers it may
     *  touch within a common step of the given length [s]. Those take their sub-steps together. */
    mor_status (*find_partners)(mor_context *context, void *owner, double length, uint64_t *partners, int n_steppers);
    /** Lets the steppers of a set of bits act on one another. */
    mor_status (*run)(mor_context *context, void *owner, uint64_t members, const mor_step *step);
    const char *name;     /* static string, for messages of a checked run */
    uint64_t accumulates; /* bits of the members that it changes */
    uint64_t remembers;   /* bits of its own data, which all followers show and no stage changes */
} mor_exchange;

#endif
