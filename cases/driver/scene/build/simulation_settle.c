/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The settling of the initial stress of a simulation. */
#include "cases/driver/scene/build/settle_internal.h"

#include "cases/driver/map/map_track.h"
#include "cases/driver/probe/probe_track.h"
#include "core/base/math.h"
#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_sum.h"

#include <string.h>

/* Damping rate of settling by damping as a share of sound speed over smoothing length; share of the net force of
 * settling by relaxation. */
#define SETTLE_DAMPING 0.02
#define SETTLE_LOCAL_DAMPING 0.8

/* Steps between checks, by damping and by relaxation. */
enum { SETTLE_CHECK = 50, RELAX_CHECK = 10 };

/* Relaxation stops what moves at peaks of the kinetic energy for so many periods, then damps locally. */
#define KINETIC_PERIODS 4.0

/* Soil without stress is loaded over so many periods: a load at once overshoots, and yield by overshooting stays. */
#define RAMP_PERIODS 1.0

/* Soil that has moved by a spacing has flowed if a hundredth of it has yielded by this plastic strain; where a law does
 * not tell that, if it has moved by so many times its elastic settlement. */
#define FLOW_STRAIN 0.05
#define FLOW_DISPLACEMENT 4.0

/* A single body counts in the limit of relaxation as so much of what is left of it. */
#define BODY_SHARE 0.1

/* The strictest settling that a region asks for; false when none does. Relaxation when a region asks for that. */
static bool find_settling(const mor_case *the_case, mor_settling *it)
{
    bool is_asked = false;
    double speed = INFINITY;
    double force = INFINITY;
    *it = (mor_settling){.speed = INFINITY, .residual = INFINITY};
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *soil = &the_case->soils[k];
        if (soil->initial_stress == MOR_CASE_STRESS_SETTLED) {
            is_asked = true;
            it->longest = fmax(it->longest, soil->settle_time);
            it->is_relaxed = it->is_relaxed || soil->settle_method == MOR_CASE_SETTLE_RELAXATION;
            speed = fmin(speed, soil->settle_speed_ratio);
            force = fmin(force, soil->settle_force_ratio);
        }
    }
    it->ratio = it->is_relaxed ? force : speed;
    return is_asked;
}

/* A settling much longer than the run does not fit into the integer time line: ticks become longer. */
static int64_t find_until(mor_schedule *schedule, double longest)
{
    const double most = 1152921504606846976.0; /* 2^60 ticks */
    if (longest > most * schedule->tick) {
        int exponent = 0;
        frexp(longest / (most * schedule->tick), &exponent);
        schedule->tick = ldexp(schedule->tick, exponent);
    }
    const int64_t until = mor_schedule_ticks(schedule, longest);
    return until > 0 ? until : 1;
}

static bool starts_without_stress(const mor_case *the_case)
{
    bool is_free = true;
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *soil = &the_case->soils[k];
        is_free = is_free && (soil->initial_stress == MOR_CASE_STRESS_NONE ||
                              (soil->initial_stress == MOR_CASE_STRESS_SETTLED && soil->settle_from == 1));
    }
    return is_free;
}

/* The speed below which the soil is at rest, and the period of the wave of which the depth is a quarter. */
static mor_status find_limits(mor_context *context, const mor_simulation *simulation, mor_settling *it)
{
    const mor_measure_points points = mor_simulation_points(simulation, 0);
    double origin[3];
    double height = 0.0;
    double slowest = simulation->soil.sound_speed;
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    MOR_TRY(context, mor_measure_height(context, &points, origin, simulation->up, 0.0, &height));
    height = simulation->surface_height - mor_vector_dot(origin, simulation->up) - height;
    it->limit = it->ratio * sqrt(mor_vector_length(simulation->soil.settings.gravity) * height);
    for (int k = 0; k < simulation->soil.n_kinds; ++k) {
        slowest = fmin(slowest, simulation->soil.kinds[k].sound_speed);
    }
    const double gravity = mor_vector_length(simulation->soil.settings.gravity);
    it->period = 4.0 * simulation->soil_depth / slowest;
    it->settlement = 0.5 * gravity * pow(simulation->soil_depth / slowest, 2.0);
    if (it->is_relaxed) {
        it->limit = it->ratio * gravity * it->period / (2.0 * MOR_PI);
    }
    it->ramp = it->is_relaxed && starts_without_stress(simulation->the_case) ? RAMP_PERIODS * it->period : 0.0;
    return MOR_OK;
}

static bool is_stopping(const mor_settle_observer *observer)
{
    return observer != NULL && observer->stop != NULL && *observer->stop != 0;
}

/* A stop is no change of motion by forces: what tells these from the change over a step must not see it. */
static void forget_motion(mor_body *body)
{
    for (int a = 0; a < 3; ++a) {
        body->begin_velocity[a] -= body->velocity[a];
        body->begin_angular_velocity[a] -= body->angular_velocity[a];
    }
}

/* Stops all soil and bodies where they are. */
static mor_status stop_motion(mor_context *context, mor_simulation *simulation, const mor_simulation_settling *settling)
{
    mor_soil *soil = &simulation->soil;
    mor_set_stop(&soil->set, 0, soil->set.n_particles);
    soil->largest_speed = 0.0;
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        for (int b = 0; b < simulation->bodies.groups[g]->n_bodies; ++b) {
            forget_motion(&simulation->bodies.groups[g]->bodies[b]);
        }
    }
    return mor_simulation_bodies_settle(context, &simulation->bodies, simulation->the_case, settling);
}

/* Kinetic damping: where the kinetic energy has passed a peak, forces are about balanced, and what moves is stopped. */
static mor_status stop_at_peak(mor_context *context, mor_simulation *simulation, mor_settling *it)
{
    const double datum[3] = {0.0, 0.0, 0.0};
    mor_measure_points points = mor_simulation_points(simulation, 0);
    double energies[3];
    points.n_threads = context->n_threads;
    mor_simulation_bodies_energy(&simulation->bodies, datum, &energies[0], &energies[1], &energies[2]);
    const double kinetic =
        energies[0] + mor_measure_kinetic_energy(&points, simulation->soil.set.data[MOR_FIELD_VELOCITY]);
    const bool has_passed = kinetic < it->kinetic;
    it->kinetic = has_passed ? 0.0 : kinetic;
    return has_passed ? stop_motion(context, simulation, &it->means) : MOR_OK;
}

/* Soil that has not come to rest in a few periods may be flowing. Stops would hide whether it gains speed, and local
 * damping does not. */
static void damp_locally(mor_simulation *simulation, mor_settling *it)
{
    it->means.local_damping = SETTLE_LOCAL_DAMPING;
    simulation->soil.settings.scheme.local_damping = SETTLE_LOCAL_DAMPING;
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        simulation->bodies.groups[g]->local_damping = SETTLE_LOCAL_DAMPING;
    }
}

/* Measures what is reached. Forces of a wave vanish where its speed is largest, so that relaxation counts speed, too,
 * as the force it becomes in a quarter of the longest period. */
static mor_status measure(mor_context *context, const mor_simulation *simulation, mor_settling *it)
{
    const mor_measure_points points = mor_simulation_points(simulation, 0);
    mor_settle_sample sample = {.time = mor_schedule_time(&simulation->schedule)};
    MOR_TRY(context,
            mor_measure_speed(context, &points, simulation->soil.set.data[MOR_FIELD_VELOCITY], 99.0, &it->speed));
    if (it->is_relaxed) {
        const double rate = it->ratio / it->limit;
        mor_simulation_motion motion;
        mor_simulation_find_imbalance(simulation, context->n_threads, &it->imbalance);
        mor_simulation_find_motion(simulation, context->n_threads, &motion);
        it->residual = fmax(fmax(it->imbalance.mean, rate * motion.mean),
                            BODY_SHARE * fmax(it->imbalance.bodies, rate * motion.bodies));
        sample.mean_speed = motion.mean;
    }
    sample.speed = it->is_relaxed ? it->residual / it->ratio * it->limit : it->speed;
    return mor_settle_watch_add(context, &it->watch, &simulation->soil, &sample);
}

/* Soil that is being loaded, or has only just begun to move, is not at rest. */
static bool is_done(const mor_schedule *schedule, const mor_settling *it)
{
    return it->is_relaxed ? it->residual < it->ratio && mor_schedule_time(schedule) > it->ramp : it->speed < it->limit;
}

/* Whether soil that is not at rest is known not to come to rest where it was put. */
static bool has_failed(const mor_simulation *simulation, mor_settling *it)
{
    const double spacing = simulation->the_case->spacing;
    const double loaded = mor_schedule_time(&simulation->schedule) - it->ramp;
    const mor_settle_sample *last = &it->watch.samples[it->watch.n - 1];
    it->has_flowed =
        last->displacement > spacing && (isnan(last->strained) ? last->displacement > FLOW_DISPLACEMENT * it->settlement
                                                               : last->strained > FLOW_STRAIN);
    it->gives_way = loaded > (KINETIC_PERIODS + MOR_SETTLE_PERIODS) * it->period &&
                    mor_settle_watch_gives_way(&it->watch, it->period, spacing, it->speeds);
    return it->has_flowed || it->gives_way;
}

/* What the summary of the run says of it. */
static void record(const mor_context *context, mor_simulation *simulation, const mor_settling *it)
{
    mor_simulation_imbalance imbalance;
    mor_simulation_find_imbalance(simulation, context->n_threads, &imbalance);
    const double numbers[MOR_SIMULATION_SETTLED_NUMBERS] = {
        [MOR_SIMULATION_SETTLED_TIME] = mor_schedule_time(&simulation->schedule),
        [MOR_SIMULATION_SETTLED_STEPS] = (double)simulation->schedule.n_steps,
        [MOR_SIMULATION_SETTLED_FORCE] = imbalance.mean,
        [MOR_SIMULATION_SETTLED_LARGEST] = imbalance.largest,
        [MOR_SIMULATION_SETTLED_DISPLACEMENT] = it->watch.n > 0 ? it->watch.samples[it->watch.n - 1].displacement : 0.0,
        [MOR_SIMULATION_SETTLED_RELAXED] = it->is_relaxed};
    memcpy(simulation->settled, numbers, sizeof numbers);
}

static mor_status run_settling(mor_context *context, mor_simulation *simulation, mor_settling *it,
                               const mor_settle_observer *observer)
{
    mor_schedule *schedule = &simulation->schedule;
    const int64_t until = find_until(schedule, it->longest);
    /* At least one check's worth of steps: at the start everything is at rest because nothing has moved yet. */
    while (schedule->now < until && !is_done(schedule, it) && !is_stopping(observer)) {
        for (int k = 0; k < (it->is_relaxed ? RELAX_CHECK : SETTLE_CHECK) && schedule->now < until; ++k) {
            MOR_TRY(context, mor_schedule_step(context, schedule, until));
            if (it->is_relaxed && it->means.local_damping == 0.0) {
                MOR_TRY(context, stop_at_peak(context, simulation, it));
            }
        }
        MOR_TRY(context, measure(context, simulation, it));
        if (observer != NULL && observer->report != NULL) {
            observer->report(observer->user,
                             &(mor_settle_course){mor_schedule_time(schedule), it->longest, schedule->n_steps,
                                                  it->speed, it->limit, it->is_relaxed, it->residual, it->ratio});
        }
        if (it->is_relaxed && has_failed(simulation, it)) {
            return mor_settling_report_unrest(context, simulation, it);
        }
        if (it->is_relaxed && mor_schedule_time(schedule) > it->ramp + KINETIC_PERIODS * it->period) {
            damp_locally(simulation, it);
        }
    }
    const bool is_stopped = is_stopping(observer);
    if (!is_done(schedule, it) && !is_stopped) {
        return mor_settling_report_unrest(context, simulation, it);
    }
    mor_settling_report_rest(context, simulation, it, is_stopped);
    record(context, simulation, it);
    return MOR_OK;
}

static mor_status settle(mor_context *context, mor_simulation *simulation, mor_settling *it,
                         const mor_settle_observer *observer)
{
    const double tick = simulation->schedule.tick;
    mor_status status = mor_settle_watch_init(context, &it->watch, &simulation->soil);
    if (status == MOR_OK) {
        status = run_settling(context, simulation, it, observer);
    }
    mor_settle_watch_clear(context, &it->watch);
    if (status == MOR_OK) {
        simulation->schedule.tick = tick; /* else the time of the failure is still told */
    }
    return status;
}

/* What settling changes for its duration. */
typedef struct kept_settings {
    mor_scheme scheme;
    double velocities[MOR_SOIL_WALLS_MAX][3];      /* of walls, m/s */
    const mor_motion *motions[MOR_SOIL_WALLS_MAX]; /* of walls; NULL: none */
    double removal_times[MOR_SOIL_WALLS_MAX];      /* of walls, s; 0: never */
} kept_settings;

static mor_status begin_settling(mor_context *context, mor_simulation *simulation, mor_settling *it,
                                 kept_settings *kept)
{
    mor_soil *soil = &simulation->soil;
    mor_scheme *scheme = &soil->settings.scheme;
    mor_contact *contact = &simulation->bodies.contact;
    it->means = (mor_simulation_settling){
        .damping = it->is_relaxed ? 0.0 : SETTLE_DAMPING * soil->sound_speed / soil->smoothing_length,
        .gravity_ramp = it->ramp};
    kept->scheme = *scheme;
    scheme->damping = it->means.damping;
    scheme->local_damping = 0.0;
    scheme->damping_time = 0.0;
    scheme->gravity_ramp = it->means.gravity_ramp;
    scheme->gravity_ramp_form = 1;
    soil->is_relaxing = it->is_relaxed;
    soil->is_settling = true;
    soil->settings.removes_outflow = false; /* what is to come to rest may not leave */
    for (int w = 0; w < soil->n_walls; ++w) {
        memcpy(kept->velocities[w], soil->walls[w].velocity, sizeof kept->velocities[w]);
        memset(soil->walls[w].velocity, 0, sizeof kept->velocities[w]);
        kept->motions[w] = soil->walls[w].motion;
        kept->removal_times[w] = soil->walls[w].removed_at;
        soil->walls[w].motion = NULL;
        soil->walls[w].removed_at = 0.0;
    }
    for (int w = 0; w < contact->n_walls; ++w) {
        memset(contact->walls[w].velocity, 0, sizeof contact->walls[w].velocity);
        contact->walls[w].motion = NULL;
        contact->walls[w].removed_at = 0.0;
    }
    return mor_simulation_bodies_settle(context, &simulation->bodies, simulation->the_case, &it->means);
}

/* Positions and stress stay; everything else is as at the start. */
static mor_status end_settling(mor_context *context, mor_simulation *simulation, const kept_settings *kept)
{
    mor_soil *soil = &simulation->soil;
    mor_contact *contact = &simulation->bodies.contact;
    MOR_TRY(context, stop_motion(context, simulation, NULL));
    for (int w = 0; w < soil->n_walls; ++w) {
        memcpy(soil->walls[w].velocity, kept->velocities[w], sizeof kept->velocities[w]);
        soil->walls[w].motion = kept->motions[w];
        soil->walls[w].removed_at = kept->removal_times[w];
    }
    for (int w = 0; w < contact->n_walls; ++w) {
        memcpy(contact->walls[w].velocity, kept->velocities[w], sizeof kept->velocities[w]);
        contact->walls[w].motion = kept->motions[w];
        contact->walls[w].removed_at = kept->removal_times[w];
    }
    contact->time = 0.0;
    soil->settings.scheme = kept->scheme;
    soil->is_relaxing = false;
    soil->is_settling = false;
    soil->settings.removes_outflow = simulation->the_case->outflow == 1;
    memset(soil->wall_impulse, 0, sizeof soil->wall_impulse); /* forces stay those of the last step, as of bodies */
    MOR_TRY(context, mor_soil_init_state(context, soil));
    simulation->schedule.now = 0;
    simulation->schedule.n_steps = 0;
    simulation->schedule.step_length = 0.0;
    simulation->schedule.n_particle_steps = 0;
    return MOR_OK;
}

mor_status mor_simulation_settle(mor_context *context, mor_simulation *simulation, const mor_settle_observer *observer)
{
    mor_settling it;
    kept_settings kept;
    if (find_settling(simulation->the_case, &it)) {
        MOR_TRY(context, find_limits(context, simulation, &it));
        MOR_TRY(context, begin_settling(context, simulation, &it, &kept));
        MOR_TRY(context, settle(context, simulation, &it, observer));
        MOR_TRY(context, end_settling(context, simulation, &kept));
    }
    mor_soil_restart_energy(&simulation->soil);
    mor_simulation_energies(simulation, context->n_threads, simulation->initial_energies);
    mor_map_track_start(context, simulation->maps);
    return mor_probe_track_start(context, simulation->probes);
}
