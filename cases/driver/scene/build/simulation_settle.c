/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The settling of the initial stress of a simulation. */
#include "cases/driver/scene/build/simulation_build.h"

#include "cases/driver/probe/probe_track.h"
#include "cases/driver/scene/build/settle_watch.h"
#include "core/base/math.h"
#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_sum.h"

#include <stdio.h>
#include <string.h>

/* Damping rate of a settling run as a share of sound speed over smoothing length, and steps between checks. */
#define SETTLE_DAMPING 0.02
static const char creep_advice[] = "; stress diffusion alone lets soil creep under a standing load, which "
                                   "numerics.stress_diffusion_limiter = \"motion\" ends";
enum { SETTLE_CHECK = 50, FOUND_BYTES = 512 };

/* A settle_time that is proposed is longer than the one extrapolated. */
#define TIME_MARGIN 1.2

static mor_measure_points points_of(const mor_simulation *simulation)
{
    double *const *data = simulation->soil.set.data;
    return (mor_measure_points){.n_points = simulation->soil.set.n_particles,
                                .dimension = simulation->the_case->dimension,
                                .spacing = simulation->the_case->spacing,
                                .position = data[MOR_FIELD_POSITION],
                                .mass = data[MOR_FIELD_MASS],
                                .density = data[MOR_FIELD_DENSITY]};
}

/* The strictest settling that a region asks for; false when none does. */
static bool find_settling(const mor_case *the_case, double *longest, double *ratio)
{
    bool is_asked = false;
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *soil = &the_case->soils[k];
        if (soil->initial_stress == MOR_CASE_STRESS_SETTLED) {
            *longest = is_asked ? fmax(*longest, soil->settle_time) : soil->settle_time;
            *ratio = is_asked ? fmin(*ratio, soil->settle_speed_ratio) : soil->settle_speed_ratio;
            is_asked = true;
        }
    }
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

/* The speed below which the soil is at rest. */
static mor_status find_limit(mor_context *context, const mor_simulation *simulation, double ratio, double *limit)
{
    const mor_measure_points points = points_of(simulation);
    double origin[3];
    double height = 0.0;
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    MOR_TRY(context, mor_measure_height(context, &points, origin, simulation->up, 0.0, &height));
    height = simulation->surface_height - mor_vector_dot(origin, simulation->up) - height;
    *limit = ratio * sqrt(mor_vector_length(simulation->soil.settings.gravity) * height);
    return MOR_OK;
}

/* Soil that did not come to rest: why, and by how much it misses. */
static mor_status report_unrest(mor_context *context, const mor_simulation *simulation, const mor_settle_watch *watch,
                                double speed, double limit)
{
    const double spacing = simulation->the_case->spacing;
    const mor_scheme *numerics = &simulation->the_case->numerics;
    const bool may_creep = numerics->stress_diffusion > 0.0 && numerics->stress_diffusion_limiter == 0;
    mor_settle_result result;
    char found[FOUND_BYTES];
    mor_settle_watch_evaluate(watch, limit, spacing, &result);
    snprintf(
        found, sizeof found,
        "after settling for %.4g s in %llu steps the 99th percentile of the speed is %.3g m/s, %.3g times the limit "
        "of %.3g m/s",
        mor_schedule_time(&simulation->schedule), (unsigned long long)simulation->schedule.n_steps, speed,
        speed / limit, limit);
    if (result.outcome == MOR_SETTLE_FAILS) {
        return MOR_FAIL(
            context, MOR_NOT_CONVERGED,
            "the soil does not stand under its own weight: %s; it has moved by up to %.3g m (%.3g spacings) and keeps "
            "moving: the mean plastic strain grew by %.3g 1/s in the last quarter of that time, by %.3g 1/s in the one "
            "before. A longer 'settle_time' does not help; give the soil more strength, a gentler slope or a wall that "
            "holds it, or let it flow from the start with type = \"k0\"",
            found, result.displacement, result.displacement / spacing, result.strain_rates[1], result.strain_rates[0]);
    }
    if (result.outcome == MOR_SETTLE_NEEDS_TIME) {
        return MOR_FAIL(context, MOR_NOT_CONVERGED,
                        "the soil needs longer to settle: %s, and it decays by a factor of e every %.3g s, so that the "
                        "limit is reached after about %.3g s; it has moved by up to %.3g m (%.3g spacings). Raise "
                        "'settle_time' to %.2g s or more",
                        found, 1.0 / result.decay, result.time_needed, result.displacement,
                        result.displacement / spacing, TIME_MARGIN * result.time_needed);
    }
    return MOR_FAIL(context, MOR_NOT_CONVERGED,
                    "the soil did not come to rest: %s; it has moved by up to %.3g m (%.3g spacings), and its speed "
                    "neither decays steadily nor does the soil yield steadily, as far as the time given shows. Give a "
                    "longer 'settle_time' to see which, or a larger 'settle_speed_ratio'%s",
                    found, result.displacement, result.displacement / spacing, may_creep ? creep_advice : "");
}

/* Reports how far soil moved until it came to rest. */
static void report_rest(mor_context *context, const mor_simulation *simulation, const mor_settle_watch *watch,
                        double speed, double limit, bool is_stopped)
{
    const double spacing = simulation->the_case->spacing;
    const double moved = watch->n > 0 ? watch->samples[watch->n - 1].displacement : 0.0;
    mor_context_log(context, MOR_LOG_INFO,
                    "initial stress %s after %.4g s and %llu steps: 99 %% of the particles are slower than %.3g m/s, "
                    "the limit is %.3g m/s; 99 %% have moved by less than %.3g m",
                    is_stopped ? "stopped" : "converged", mor_schedule_time(&simulation->schedule),
                    (unsigned long long)simulation->schedule.n_steps, speed, limit, moved);
    if (moved > spacing && !is_stopped) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "the soil moved by up to %.3g m (%.3g spacings) while its initial stress settled, so the run "
                        "starts from a deformed shape: the soil is not stable in the shape that the case describes",
                        moved, moved / spacing);
    }
}

static bool is_stopping(const mor_settle_observer *observer)
{
    return observer != NULL && observer->stop != NULL && *observer->stop != 0;
}

static mor_status watch_settling(mor_context *context, mor_simulation *simulation, mor_settle_watch *watch,
                                 double longest, double limit, const mor_settle_observer *observer)
{
    mor_schedule *schedule = &simulation->schedule;
    const mor_measure_points points = points_of(simulation);
    const int64_t until = find_until(schedule, longest);
    double speed = INFINITY;
    /* At least one check's worth of steps: at the start everything is at rest because nothing has moved yet. */
    while (schedule->now < until && !(speed < limit) && !is_stopping(observer)) {
        for (int k = 0; k < SETTLE_CHECK && schedule->now < until; ++k) {
            MOR_TRY(context, mor_schedule_step(context, schedule, until));
        }
        MOR_TRY(context,
                mor_measure_speed(context, &points, simulation->soil.set.data[MOR_FIELD_VELOCITY], 99.0, &speed));
        MOR_TRY(context,
                mor_settle_watch_add(context, watch, &simulation->soil.set, mor_schedule_time(schedule), speed));
        if (observer != NULL && observer->report != NULL) {
            observer->report(observer->user, &(mor_settle_course){mor_schedule_time(schedule), longest,
                                                                  schedule->n_steps, speed, limit});
        }
    }
    const bool is_stopped = is_stopping(observer);
    if (!(speed < limit) && !is_stopped) {
        return report_unrest(context, simulation, watch, speed, limit);
    }
    report_rest(context, simulation, watch, speed, limit, is_stopped);
    return MOR_OK;
}

static mor_status run_settling(mor_context *context, mor_simulation *simulation, double longest, double ratio,
                               const mor_settle_observer *observer)
{
    mor_settle_watch watch;
    const double tick = simulation->schedule.tick;
    double limit = 0.0;
    MOR_TRY(context, find_limit(context, simulation, ratio, &limit));
    mor_status status = mor_settle_watch_init(context, &watch, &simulation->soil.set);
    if (status == MOR_OK) {
        status = watch_settling(context, simulation, &watch, longest, limit, observer);
    }
    mor_settle_watch_clear(context, &watch);
    simulation->schedule.tick = tick;
    return status;
}

mor_status mor_simulation_settle(mor_context *context, mor_simulation *simulation, const mor_settle_observer *observer)
{
    double longest = 0.0;
    double ratio = 0.0;
    mor_soil *soil = &simulation->soil;
    if (find_settling(simulation->the_case, &longest, &ratio)) {
        const double damping = soil->settings.scheme.damping;
        const double ramp = soil->settings.scheme.gravity_ramp;
        soil->settings.scheme.damping = SETTLE_DAMPING * soil->sound_speed / soil->smoothing_length;
        soil->settings.scheme.gravity_ramp = 0.0;
        soil->settings.removes_outflow = false; /* what is to come to rest may not leave */
        double velocities[MOR_SOIL_WALLS_MAX][3];
        mor_contact *contact = &simulation->bodies.contact;
        for (int w = 0; w < soil->n_walls; ++w) {
            memcpy(velocities[w], soil->walls[w].velocity, sizeof velocities[w]);
            memset(soil->walls[w].velocity, 0, sizeof velocities[w]);
        }
        for (int w = 0; w < contact->n_walls; ++w) {
            memset(contact->walls[w].velocity, 0, sizeof contact->walls[w].velocity);
        }
        MOR_TRY(context, mor_simulation_bodies_settle(context, &simulation->bodies, simulation->the_case,
                                                      soil->settings.scheme.damping));
        MOR_TRY(context, run_settling(context, simulation, longest, ratio, observer));
        MOR_TRY(context, mor_simulation_bodies_settle(context, &simulation->bodies, simulation->the_case, 0.0));
        for (int w = 0; w < soil->n_walls; ++w) {
            memcpy(soil->walls[w].velocity, velocities[w], sizeof velocities[w]);
        }
        for (int w = 0; w < contact->n_walls; ++w) {
            memcpy(contact->walls[w].velocity, velocities[w], sizeof velocities[w]);
        }
        contact->time = 0.0;
        soil->settings.scheme.damping = damping;
        soil->settings.scheme.gravity_ramp = ramp;
        soil->settings.removes_outflow = simulation->the_case->outflow == 1;
        const int64_t n = soil->set.n_particles;
        memset(soil->set.data[MOR_FIELD_VELOCITY], 0, (size_t)(3 * n) * sizeof(double));
        memset(soil->set.data[MOR_FIELD_DENSITY_RATE], 0, (size_t)n * sizeof(double));
        if (soil->set.data[MOR_FIELD_STRAIN_RATE] != NULL) {
            memset(soil->set.data[MOR_FIELD_STRAIN_RATE], 0, (size_t)n * 6 * sizeof(double));
        }
        memset(soil->wall_impulse, 0, sizeof soil->wall_impulse); /* forces stay those of the last step, as of bodies */
        soil->largest_speed = 0.0;
        MOR_TRY(context, mor_soil_init_state(context, soil));
        simulation->schedule.now = 0;
        simulation->schedule.n_steps = 0;
        simulation->schedule.step_length = 0.0;
        simulation->schedule.n_particle_steps = 0;
    }
    mor_soil_restart_energy(soil);
    mor_simulation_energies(simulation, context->n_threads, simulation->initial_energies);
    return mor_probe_track_start(context, simulation->probes);
}
