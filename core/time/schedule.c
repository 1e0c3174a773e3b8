/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/schedule.h"

#include "core/time/stage_check.h"

#include <math.h>
#include <string.h>

/* A run has between 2^51 and 2^52 ticks, so that all times are exact in double precision. */
enum { TICK_BITS = 52 };

/* A run that is made longer may have more, as many as fit into 63 bits; its times are then rounded to a double. */
#define LARGEST_TICKS 9.2e18

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

mor_status mor_schedule_set_end(mor_context *context, mor_schedule *schedule, double end)
{
    const double n_ticks = end / schedule->tick;
    MOR_CHECK(
        context, n_ticks >= 1.0 && n_ticks < LARGEST_TICKS, MOR_ERROR_CONFIG,
        "found end = %g s for a run that counts its time in ticks of %.3g s; allowed are at most %g s; start a new "
        "run for a longer time",
        end, schedule->tick, LARGEST_TICKS * schedule->tick);
    schedule->end = (int64_t)llround(n_ticks);
    return MOR_OK;
}

mor_status mor_schedule_add(mor_context *context, mor_schedule *schedule, const mor_stepper *stepper, uint64_t evolving)
{
    MOR_CHECK(context, schedule->n_steppers < MOR_SCHEDULE_STEPPERS_MAX, MOR_ERROR_ARGUMENT,
              "%d steppers are in the schedule already, the most allowed", MOR_SCHEDULE_STEPPERS_MAX);
    MOR_CHECK(context, stepper->n_before >= 0 && stepper->n_before <= stepper->n_stages, MOR_ERROR_INTERNAL,
              "stepper '%s' has %d stages and claims %d of them before the exchange", stepper->name, stepper->n_stages,
              stepper->n_before);
    MOR_TRY(context, mor_stage_verify(context, stepper->stages, stepper->n_stages, evolving, stepper->set));
    schedule->steppers[schedule->n_steppers] = *stepper;
    schedule->steppers[schedule->n_steppers].evolving = evolving;
    schedule->n_steppers += 1;
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

/* A follower that needs more sub-steps than this in a common step has collapsed. */
enum { SUBSTEPS_MAX = 1 << 20 };

static mor_status ask_steppers(mor_context *context, mor_schedule *schedule)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        schedule->proposals[s] = INFINITY;
        schedule->limits[s] = "";
        MOR_TRY(context,
                stepper->operations->propose(context, stepper->owner, &schedule->proposals[s], &schedule->limits[s]));
    }
    return MOR_OK;
}

static bool has_leader(const mor_schedule *schedule)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        if (schedule->steppers[s].is_leader) {
            return true;
        }
    }
    return false;
}

/* The common step: the shortest of the leaders; without leaders, or at a single rate, the shortest of all. */
static mor_status propose_step(mor_context *context, mor_schedule *schedule, int64_t *ticks)
{
    double shortest = (double)schedule->end * schedule->tick;
    const bool is_for_all = schedule->is_single_rate || !has_leader(schedule);
    schedule->limit = "the end of the run";
    MOR_TRY(context, ask_steppers(context, schedule));
    for (int s = 0; s < schedule->n_steppers; ++s) {
        /* Written so that a length that is not a number is taken, and reported below. */
        if ((is_for_all || schedule->steppers[s].is_leader) && !(schedule->proposals[s] >= shortest)) {
            shortest = schedule->proposals[s];
            schedule->limit = schedule->limits[s];
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

/* Sub-steps of each stepper alone, and the groups of those that may touch: island[s] has the bits of s's group. */
static mor_status find_islands(mor_context *context, mor_schedule *schedule, double length, uint64_t *island)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const double ratio = ceil(length / schedule->proposals[s] * (1.0 - 1.0e-12));
        /* Written so that a proposal that is not a number or not positive is reported. */
        MOR_CHECK(
            context, schedule->proposals[s] > 0.0 && ratio <= (double)SUBSTEPS_MAX, MOR_ERROR_NUMERIC,
            "the time step of '%s' collapsed to %.3g s at t = %.9g s (step %llu), limited by %s, while the common "
            "step is %.3g s; at most %d sub-steps are allowed. Look at the last snapshot; a smaller 'courant' may "
            "help",
            schedule->steppers[s].name, schedule->proposals[s], mor_schedule_time(schedule),
            (unsigned long long)schedule->n_steps, schedule->limits[s], length, SUBSTEPS_MAX);
        schedule->substeps[s] = schedule->steppers[s].is_leader || !(ratio > 1.0) ? 1 : (int)ratio;
        island[s] = MOR_BIT(s);
    }
    if (schedule->exchange == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, schedule->exchange->find_partners(context, schedule->exchange->owner, length, island,
                                                       schedule->n_steppers));
    /* As many rounds as there are steppers join every chain of partners. */
    for (int round = 0; round < schedule->n_steppers; ++round) {
        for (int s = 0; s < schedule->n_steppers; ++s) {
            island[s] |= MOR_BIT(s);
            for (int other = 0; other < schedule->n_steppers; ++other) {
                if ((island[s] & MOR_BIT(other)) != 0 || (island[other] & MOR_BIT(s)) != 0) {
                    island[s] |= island[other] | MOR_BIT(other);
                }
            }
        }
    }
    for (int s = 0; s < schedule->n_steppers; ++s) {
        for (int other = 0; other < schedule->n_steppers; ++other) {
            if ((island[s] & MOR_BIT(other)) != 0 && schedule->substeps[other] > schedule->substeps[s]) {
                schedule->substeps[s] = schedule->substeps[other];
            }
        }
    }
    return MOR_OK;
}

static mor_status run_stages(mor_context *context, const mor_stepper *stepper, int first, int last,
                             const mor_step *step)
{
    for (int k = first; k < last; ++k) {
        MOR_TRY(context, mor_stepper_run_stage(context, stepper, k, step));
    }
    return MOR_OK;
}

/* Lets the members act on one another. In a checked run what the exchange does not declare is the same afterwards, in
 * all followers. */
static mor_status run_exchange(mor_context *context, const mor_schedule *schedule, uint64_t members,
                               const mor_step *step)
{
    const mor_exchange *exchange = schedule->exchange;
    const mor_stage on_members = {
        .name = exchange->name, .reads = ~(uint64_t)0, .accumulates = exchange->accumulates | exchange->remembers};
    const mor_stage on_others = {.name = exchange->name, .reads = ~(uint64_t)0, .accumulates = exchange->remembers};
    mor_stage_check checks[MOR_SCHEDULE_STEPPERS_MAX];
    for (int s = 0; s < schedule->n_steppers && context->is_checked; ++s) {
        const mor_stage *stage = (members & MOR_BIT(s)) != 0 ? &on_members : &on_others;
        if (!schedule->steppers[s].is_leader) {
            mor_stage_check_before(&checks[s], &schedule->steppers[s], stage);
        }
    }
    const mor_status status = exchange->run(context, exchange->owner, members, step);
    for (int s = 0; s < schedule->n_steppers && context->is_checked; ++s) {
        const mor_stage *stage = (members & MOR_BIT(s)) != 0 ? &on_members : &on_others;
        if (!schedule->steppers[s].is_leader) {
            MOR_TRY(context, mor_stage_check_after(context, &checks[s], &schedule->steppers[s], stage));
        }
    }
    return status;
}

/* All sub-steps of the followers in one island. They add up to the common step to the tick. */
static mor_status run_island(mor_context *context, mor_schedule *schedule, uint64_t members, int64_t ticks, int n_parts)
{
    int64_t now = schedule->now;
    for (int part = 0; part < n_parts; ++part) {
        const int64_t part_ticks = ticks / n_parts + (part < ticks % n_parts ? 1 : 0);
        const mor_step step = {(double)part_ticks * schedule->tick, (double)now * schedule->tick, schedule->n_steps,
                               part, n_parts};
        for (int s = 0; s < schedule->n_steppers; ++s) {
            if ((members & MOR_BIT(s)) != 0) {
                const mor_stepper *stepper = &schedule->steppers[s];
                MOR_TRY(context, run_stages(context, stepper, 0, stepper->n_before, &step));
            }
        }
        if (schedule->exchange != NULL) {
            MOR_TRY(context, run_exchange(context, schedule, members, &step));
        }
        for (int s = 0; s < schedule->n_steppers; ++s) {
            if ((members & MOR_BIT(s)) != 0) {
                const mor_stepper *stepper = &schedule->steppers[s];
                MOR_TRY(context, run_stages(context, stepper, stepper->n_before, stepper->n_stages, &step));
            }
        }
        now += part_ticks;
    }
    return MOR_OK;
}

static mor_status run_followers(mor_context *context, mor_schedule *schedule, const uint64_t *island, int64_t ticks,
                                const mor_step *common)
{
    uint64_t done = 0;
    for (int s = 0; s < schedule->n_steppers; ++s) {
        if (!schedule->steppers[s].is_leader && (done & MOR_BIT(s)) == 0) {
            MOR_TRY(context, run_island(context, schedule, island[s], ticks, schedule->substeps[s]));
            done |= island[s];
        }
    }
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        schedule->n_particle_steps += (uint64_t)stepper->n_particles * (uint64_t)schedule->substeps[s];
        if (!stepper->is_leader && stepper->operations->finish != NULL) {
            MOR_TRY(context, stepper->operations->finish(context, stepper->owner, common));
        }
    }
    return MOR_OK;
}

static mor_status begin_followers(mor_context *context, const mor_schedule *schedule, const mor_step *common)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        if (!stepper->is_leader && stepper->operations->begin != NULL) {
            MOR_TRY(context, stepper->operations->begin(context, stepper->owner, common));
        }
    }
    return MOR_OK;
}

/* The leaders' stages before or after the exchange with the followers. */
static mor_status run_leaders(mor_context *context, const mor_schedule *schedule, bool is_after, const mor_step *common)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        if (stepper->is_leader) {
            MOR_TRY(context, is_after ? run_stages(context, stepper, stepper->n_before, stepper->n_stages, common)
                                      : run_stages(context, stepper, 0, stepper->n_before, common));
        }
    }
    return MOR_OK;
}

mor_status mor_schedule_step(mor_context *context, mor_schedule *schedule, int64_t until)
{
    int64_t ticks = 0;
    MOR_CHECK(
        context, until > schedule->now, MOR_ERROR_ARGUMENT,
        "a step that ends by t = %.9g s (tick %lld) was asked for at t = %.9g s (tick %lld); its end must be later "
        "than that: take no step, or extend the end of the run first",
        (double)until * schedule->tick, (long long)until, mor_schedule_time(schedule), (long long)schedule->now);
    MOR_TRY(context, propose_step(context, schedule, &ticks));
    const int64_t left = until - schedule->now;
    if (ticks >= left) {
        ticks = left;
    } else if (2 * ticks > left) {
        ticks = left - left / 2;
    }
    const mor_step common = {(double)ticks * schedule->tick, mor_schedule_time(schedule), schedule->n_steps, 0, 1};
    uint64_t island[MOR_SCHEDULE_STEPPERS_MAX];
    MOR_TRY(context, find_islands(context, schedule, common.length, island)); /* may fail: before anything moves */
    MOR_TRY(context, begin_followers(context, schedule, &common));
    MOR_TRY(context, run_leaders(context, schedule, false, &common));
    MOR_TRY(context, run_followers(context, schedule, island, ticks, &common));
    MOR_TRY(context, run_leaders(context, schedule, true, &common));
    schedule->now += ticks;
    schedule->n_steps += 1;
    schedule->step_length = common.length;
    return MOR_OK;
}

mor_status mor_schedule_preview(mor_context *context, mor_schedule *schedule, double *length)
{
    int64_t ticks = 0;
    uint64_t island[MOR_SCHEDULE_STEPPERS_MAX];
    MOR_TRY(context, propose_step(context, schedule, &ticks));
    *length = (double)ticks * schedule->tick;
    return find_islands(context, schedule, *length, island);
}

int mor_schedule_rate_ratio(const mor_schedule *schedule)
{
    int ratio = 1;
    for (int s = 0; s < schedule->n_steppers; ++s) {
        ratio = schedule->substeps[s] > ratio ? schedule->substeps[s] : ratio;
    }
    return ratio;
}

mor_status mor_schedule_list_state(mor_context *context, mor_schedule *schedule, mor_state_list *list)
{
    static const char own[] = "schedule";
    MOR_TRY(context, mor_state_add(context, list, own, "now", MOR_STATE_INT64, 1, &schedule->now));
    MOR_TRY(context, mor_state_add(context, list, own, "tick", MOR_STATE_DOUBLE, 1, &schedule->tick));
    MOR_TRY(context, mor_state_add(context, list, own, "n_steps", MOR_STATE_UINT64, 1, &schedule->n_steps));
    MOR_TRY(context,
            mor_state_add(context, list, own, "n_particle_steps", MOR_STATE_UINT64, 1, &schedule->n_particle_steps));
    MOR_TRY(context, mor_state_add(context, list, own, "step_length", MOR_STATE_DOUBLE, 1, &schedule->step_length));
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        if (stepper->operations->list_state != NULL) {
            MOR_TRY(context, stepper->operations->list_state(context, stepper->owner, list));
        }
    }
    return MOR_OK;
}

mor_status mor_schedule_resume(mor_context *context, const mor_schedule *schedule)
{
    for (int s = 0; s < schedule->n_steppers; ++s) {
        const mor_stepper *stepper = &schedule->steppers[s];
        if (stepper->operations->resume != NULL) {
            MOR_TRY(context, stepper->operations->resume(context, stepper->owner));
        }
    }
    return MOR_OK;
}
