/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_BENCH_METER_H
#define MOR_TESTS_BENCH_METER_H

#include "cases/driver/run/wall_time.h"
#include "core/time/schedule.h"

#include <stdlib.h>
#include <string.h>

/** @file
 *  Clocks between a schedule and its steppers: each stage is replaced by one that runs it and notes the time. The
 *  schedule itself steps as ever. */

enum { METER_STAGES_MAX = 32 };

/** One stepper with clocks. */
typedef struct meter_stepper {
    mor_stepper plain;                      /* as it was */
    mor_stage stages[METER_STAGES_MAX];     /* the same with clocks */
    mor_stepper_operations operations;      /* the same with clocks */
    int next;                               /* stage that comes next; they come in turn */
    double stage_seconds[METER_STAGES_MAX]; /* spent in each stage, s */
    double limit_seconds;                   /* spent finding the longest step, s */
    double begin_seconds;                   /* spent before and after the leaders' first stages, s */
    double last_seconds[METER_STAGES_MAX];  /* of each stage's last run, s */
} meter_stepper;

/** All clocks of a schedule. Outlives the schedule's steps. Owner: the bench. */
typedef struct meter {
    meter_stepper steppers[MOR_SCHEDULE_STEPPERS_MAX];
    int n_steppers;
    const mor_exchange *plain_exchange; /* as it was; NULL: none */
    mor_exchange exchange;              /* the same with clocks */
    double exchange_seconds;            /* spent in contact, the search for partners included, s */
} meter;

static inline mor_status meter_run_stage(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    meter_stepper *it = owner;
    const double start = mor_wall_time();
    const int stage = it->next;
    const mor_stage *plain = &it->plain.stages[stage];
    const bool is_active = plain->is_active == NULL || plain->is_active(it->plain.owner);
    const mor_status status = is_active ? plain->run(context, it->plain.owner, view, step) : MOR_OK;
    it->last_seconds[stage] = mor_wall_time() - start;
    it->stage_seconds[stage] += it->last_seconds[stage];
    it->next = (stage + 1) % it->plain.n_stages;
    return status;
}

static inline mor_status meter_propose(mor_context *context, void *owner, double *step_length, const char **limit)
{
    meter_stepper *it = owner;
    const double start = mor_wall_time();
    const mor_status status = it->plain.operations->propose(context, it->plain.owner, step_length, limit);
    it->limit_seconds += mor_wall_time() - start;
    return status;
}

/* Runs what a stepper does once in a common step. */
static inline mor_status meter_run_once(meter_stepper *it, mor_context *context, const mor_step *step,
                                        mor_status (*run)(mor_context *context, void *owner, const mor_step *step))
{
    const double start = mor_wall_time();
    const mor_status status = run(context, it->plain.owner, step);
    it->begin_seconds += mor_wall_time() - start;
    return status;
}

static inline mor_status meter_begin(mor_context *context, void *owner, const mor_step *step)
{
    meter_stepper *it = owner;
    return meter_run_once(it, context, step, it->plain.operations->begin);
}

static inline mor_status meter_finish(mor_context *context, void *owner, const mor_step *step)
{
    meter_stepper *it = owner;
    return meter_run_once(it, context, step, it->plain.operations->finish);
}

static inline mor_status meter_find_partners(mor_context *context, void *owner, double length, uint64_t *partners,
                                             int n_steppers)
{
    meter *it = owner;
    const double start = mor_wall_time();
    const mor_status status =
        it->plain_exchange->find_partners(context, it->plain_exchange->owner, length, partners, n_steppers);
    it->exchange_seconds += mor_wall_time() - start;
    return status;
}

static inline mor_status meter_run_exchange(mor_context *context, void *owner, uint64_t members, const mor_step *step)
{
    meter *it = owner;
    const double start = mor_wall_time();
    const mor_status status = it->plain_exchange->run(context, it->plain_exchange->owner, members, step);
    it->exchange_seconds += mor_wall_time() - start;
    return status;
}

/** Puts clocks into a schedule.
 *  @param it       [out]     outlives the schedule's steps
 *  @param schedule [in,out]  its steppers have at most METER_STAGES_MAX stages */
static inline void meter_attach(meter *it, mor_schedule *schedule)
{
    memset(it, 0, sizeof *it);
    it->n_steppers = schedule->n_steppers;
    for (int s = 0; s < schedule->n_steppers; ++s) {
        meter_stepper *timed = &it->steppers[s];
        mor_stepper *stepper = &schedule->steppers[s];
        timed->plain = *stepper;
        timed->operations =
            (mor_stepper_operations){.kind = stepper->operations->kind,
                                     .propose = meter_propose,
                                     .begin = stepper->operations->begin != NULL ? meter_begin : NULL,
                                     .finish = stepper->operations->finish != NULL ? meter_finish : NULL};
        for (int k = 0; k < stepper->n_stages; ++k) {
            timed->stages[k] = stepper->stages[k];
            timed->stages[k].run = meter_run_stage;
            timed->stages[k].is_active = NULL; /* asked with the owner it knows, above */
        }
        stepper->owner = timed;
        stepper->operations = &timed->operations;
        stepper->stages = timed->stages;
    }
    it->plain_exchange = schedule->exchange;
    if (schedule->exchange != NULL) {
        it->exchange = *schedule->exchange;
        it->exchange.owner = it;
        it->exchange.find_partners = meter_find_partners;
        it->exchange.run = meter_run_exchange;
        schedule->exchange = &it->exchange;
    }
}

/** Sets all clocks to zero. */
static inline void meter_reset(meter *it)
{
    for (int s = 0; s < it->n_steppers; ++s) {
        memset(it->steppers[s].stage_seconds, 0, sizeof it->steppers[s].stage_seconds);
        it->steppers[s].limit_seconds = 0.0;
        it->steppers[s].begin_seconds = 0.0;
    }
    it->exchange_seconds = 0.0;
}

/** Returns the time spent in all stages of a stepper and in finding its step, unit s. */
static inline double meter_stepper_seconds(const meter_stepper *it)
{
    double sum = it->limit_seconds;
    for (int k = 0; k < it->plain.n_stages; ++k) {
        sum += it->stage_seconds[k];
    }
    return sum;
}

#endif
