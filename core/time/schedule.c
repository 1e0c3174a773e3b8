/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/schedule.h"

#include <math.h>
#include <string.h>

/* A run has between 2^51 and 2^52 ticks, so that all times are exact in double precision. */
enum { TICK_BITS = 52 };

/* Runs whose ticks are ordinary numbers, in s. */
#define SHORTEST_RUN 1.0e-290
#define LONGEST_RUN 1.0e300

/* A step shorter than this part of the run is a collapse, not a step. */
#define SHORTEST_STEP_TICKS ((int64_t)1 << 22)

mor_status mor_schedule_init(mor_context *context, mor_schedule *schedule, double end)
{
    memset(schedule, 0, sizeof *schedule);
    MOR_CHECK(context, end >= SHORTEST_RUN && end <= LONGEST_RUN, MOR_ERROR_ARGUMENT,
              "the simulated time is %g s; it must be between %g and %g s", end, SHORTEST_RUN, LONGEST_RUN);
    int exponent = 0;
    frexp(end, &exponent);
    schedule->tick = ldexp(1.0, exponent - TICK_BITS);
    schedule->end = (int64_t)llround(end / schedule->tick);
    schedule->limit = "the first step";
    return MOR_OK;
}

mor_status mor_schedule_add(mor_context *context, mor_schedule *schedule, const mor_stepper *stepper,
                            uint64_t evolving)
{
    MOR_CHECK(context, schedule->n_steppers < MOR_SCHEDULE_STEPPERS_MAX, MOR_ERROR_ARGUMENT,
              "%d steppers are in the schedule already, the most allowed", MOR_SCHEDULE_STEPPERS_MAX);
    MOR_TRY(context, mor_stage_verify(context, stepper->stages, stepper->n_stages, evolving));
    schedule->steppers[schedule->n_steppers++] = *stepper;
    return MOR_OK;
}

int64_t mor_schedule_ticks(const mor_schedule *schedule, double time)
{
    return (int64_t)llround(time / schedule->tick);
}

double mor_schedule_time(const mor_schedule *schedule)
{
    return (double)schedule->now * schedule->tick;
}

static mor_status propose_step(mor_context *context, mor_schedule *schedule, int64_t *ticks)
{
    double shortest = (double)schedule->end * schedule->tick;
    schedule->limit = "the end of the run";
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        double length = INFINITY;
        const char *limit = "";
        MOR_TRY(context, stepper->operations->propose(context, stepper->owner, &length, &limit));
        /* Written so that a length that is not a number is taken, and reported below. */
        if (!(length >= shortest)) {
            shortest = length;
            schedule->limit = limit;
        }
    }
    const double n_ticks = floor(shortest / schedule->tick);
    MOR_CHECK(context, n_ticks >= (double)SHORTEST_STEP_TICKS, MOR_ERROR_NUMERIC,
              "the time step collapsed to %.3g s at t = %.9g s (step %llu), limited by %s; the run needs steps of at "
              "least %.3g s. Look at the last snapshot for runaway particles; a smaller 'courant' may help",
              shortest, mor_schedule_time(schedule), (unsigned long long)schedule->n_steps, schedule->limit,
              (double)SHORTEST_STEP_TICKS * schedule->tick);
    *ticks = (int64_t)n_ticks;
    return MOR_OK;
}

mor_status mor_schedule_step(mor_context *context, mor_schedule *schedule, int64_t until)
{
    int64_t ticks = 0;
    MOR_TRY(context, propose_step(context, schedule, &ticks));
    const int64_t left = until - schedule->now;
    if (ticks >= left) {
        ticks = left;
    } else if (2 * ticks > left) {
        ticks = left - left / 2;
    }
    const mor_step step = {(double)ticks * schedule->tick, mor_schedule_time(schedule), schedule->n_steps};
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        for (int k = 0; k < stepper->n_stages; ++k) {
            MOR_TRY(context, stepper->stages[k].run(context, stepper->owner, &step));
        }
    }
    schedule->now += ticks;
    schedule->n_steps += 1;
    schedule->step_length = step.length;
    return MOR_OK;
}
