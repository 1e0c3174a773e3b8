/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_SCHEDULE_H
#define MOR_CORE_TIME_SCHEDULE_H

#include "core/time/stepper.h"

#include <stdbool.h>

/** @file
 *  Several clocks, one time. Leaders (soil) take the common step; followers (rocks) divide it into as many equal
 *  sub-steps as their own limit asks for, between two halves of the leaders' stages:
 *
 *      begin of followers | leaders: forces | followers: kappa x (first half, exchange, second half), finish |
 *      leaders: motion
 *
 *  so that the forces between leaders and followers are held over the sub-steps, Zhang et al. (2024) eqs. 51-60.
 *  Followers that may touch in a step take their sub-steps together, at the rate of the fastest.
 *
 *  Time on an integer line. A tick is a power of two of a second so small that the whole run has about 2^52 of them;
 *  every time is a whole number of ticks and therefore exact: steps add up to output times and to the end without
 *  rounding, and a change of the unit of time by a power of two changes no bit of the rest. */

enum { MOR_SCHEDULE_STEPPERS_MAX = 16 };

/** The clock and what it drives. Owner: the run. */
typedef struct mor_schedule {
    double tick;        /* length of a tick, s */
    int64_t now;        /* ticks since the start */
    int64_t end;        /* ticks of the whole run */
    uint64_t n_steps;   /* steps done */
    double step_length; /* of the last step, s; 0 before the first */
    const char *limit;  /* what limited it; static */
    mor_stepper steppers[MOR_SCHEDULE_STEPPERS_MAX];
    int n_steppers;
    const mor_exchange *exchange;                  /* among followers; borrowed; NULL: none */
    bool is_single_rate;                           /* every stepper takes the shortest step of all */
    int substeps[MOR_SCHEDULE_STEPPERS_MAX];       /* sub-steps of each stepper in the last common step, kappa */
    double proposals[MOR_SCHEDULE_STEPPERS_MAX];   /* longest step of each before the last common step, s */
    const char *limits[MOR_SCHEDULE_STEPPERS_MAX]; /* what limits each; static */
    uint64_t n_particle_steps;                     /* sum of particles times sub-steps over all steps */
} mor_schedule;

/** Sets the clock to zero.
 *  @param end      [in]      simulated time, > 0 and finite, unit s
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_schedule_init(mor_context *context, mor_schedule *schedule, double end);

/** Sets another end; the tick stays, so that every time of the run so far stays exact. A run that began with the longer
 *  end has the same ticks when both ends lie between the same two powers of two of a second.
 *  @param end      [in]      simulated time, > 0, unit s; at most 2048 times the end that the tick was made for
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when the end is too far for the tick. */
mor_status mor_schedule_set_end(mor_context *context, mor_schedule *schedule, double end);

/** Adds a stepper after checking its stages.
 *  @param stepper  [in]      copied
 *  @param evolving [in]      bits valid at the start of a step, see mor_stage_verify
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL; MOR_ERROR_ARGUMENT when the table is full. */
mor_status mor_schedule_add(mor_context *context, mor_schedule *schedule, const mor_stepper *stepper,
                            uint64_t evolving);

/** Finds the lengths that the next step would have without taking it: fills proposals, limits and substeps.
 *  @param length   [out]     one number; length of the common step, unit s
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC when the step collapses. */
mor_status mor_schedule_preview(mor_context *context, mor_schedule *schedule, double *length);

/** Lists the clock, and what each stepper lists.
 *  @param list     [in,out]  borrows from the schedule and from the owners of the steppers
 *  Returns: MOR_OK; what the steppers return. */
mor_status mor_schedule_list_state(mor_context *context, mor_schedule *schedule, mor_state_list *list);

/** After a state was put back: lets each stepper make the rest follow.
 *  Returns: MOR_OK; what the steppers return. */
mor_status mor_schedule_resume(mor_context *context, const mor_schedule *schedule);

/** Returns the most sub-steps that any stepper took in the last common step, 1 when there was none. */
int mor_schedule_rate_ratio(const mor_schedule *schedule);

/** Returns the number of whole ticks nearest to a time, unit s.
 *  @param time     [in]  time, unit s */
int64_t mor_schedule_ticks(const mor_schedule *schedule, double time);

/** Returns the present time, unit s. */
double mor_schedule_time(const mor_schedule *schedule);

/** Takes one common step, not beyond a given tick. Two steps of equal length are taken where one and a crumb would be
 *  needed.
 *  @param until    [in]      tick not to be passed, > now
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT unless until > now; MOR_ERROR_NUMERIC when the step collapses, naming what
 *  limits it; what a stage returns. */
mor_status mor_schedule_step(mor_context *context, mor_schedule *schedule, int64_t until);

#endif
