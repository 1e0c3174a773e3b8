/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/simulation_check.h"

#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <stdio.h>
#include <string.h>

/* Steps that the integer line of time has room for: a step has at least 2^22 of some 2^52 ticks. */
#define STEPS_MOST 1.073741824e9

/* Speed for estimates of time, particle-steps per second of one thread, and the time from which on it is reported. */
static const double usual_speed = 1.0e6;
static const double step_overhead = 5.0e-5; /* of a step whatever the particles, s */
static const double long_time = 2.0 * 86400.0;
static const double many_steps = 2.0e7; /* reported, too, for few particles */

/* A particle that falls freely under damping is to come farther than this, in spacings. */
static const double least_displacement = 1.0e-3;

enum { DURATION_BYTES = 32 };

const char *mor_simulation_duration(double seconds, char *text, size_t n_bytes)
{
    static const struct {
        double size;
        const char *name;
    } units[] = {{31557600.0, "years"}, {86400.0, "days"}, {3600.0, "h"}, {60.0, "min"}, {1.0, "s"}};
    int k = 0;
    while (k < 4 && seconds < 1.5 * units[k].size) {
        ++k;
    }
    snprintf(text, n_bytes, "%.3g %s", seconds / units[k].size, units[k].name);
    return text;
}

static double estimate_seconds(const mor_context *context, const mor_simulation *s, double n_steps)
{
    const double each = step_overhead + (double)mor_simulation_particles(s) / (usual_speed * context->n_threads);
    return n_steps * each;
}

/* The length of the first step is known; later ones are rarely longer. what: "end" or "settle_time", with its place. */
static mor_status check_steps(mor_context *context, const mor_simulation *s, const char *place, const char *what,
                              double time)
{
    char duration[DURATION_BYTES];
    const double n_steps = ceil(time / s->first_step);
    const double seconds = estimate_seconds(context, s, n_steps);
    mor_simulation_duration(seconds, duration, sizeof duration);
    MOR_CHECK(
        context, n_steps <= STEPS_MOST, MOR_ERROR_CONFIG,
        "%s: found %s = %g s, which takes about %.3g steps of %.3g s, limited by %s: some %s of computing; allowed "
        "are %.3g steps; shorten %s, or change what limits the steps",
        place, what, time, n_steps, s->first_step, s->schedule.limit, duration, STEPS_MOST, what);
    if (seconds > long_time || n_steps > many_steps) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s = %g s takes %sabout %.3g steps of %.3g s, limited by %s: some %s of computing at a million "
            "particle-steps a second on each thread",
            what, time, strcmp(what, "end") == 0 ? "" : "up to ", n_steps, s->first_step, s->schedule.limit, duration);
    }
    return MOR_OK;
}

/* The first step of soil, or of bodies without soil. A step shorter than the time line resolves is reported with its
 * cause first. */
static mor_status find_first_step(mor_context *context, mor_simulation *s)
{
    const mor_schedule *schedule = &s->schedule;
    const mor_status status = mor_schedule_preview(context, &s->schedule, &s->first_step);
    if (status != MOR_ERROR_NUMERIC) {
        return status;
    }
    s->first_step = s->the_case->end;
    for (int k = 0; k < schedule->n_steppers; ++k) {
        if (!(schedule->proposals[k] >= s->first_step)) {
            s->first_step = schedule->proposals[k];
            s->schedule.limit = schedule->limits[k];
        }
    }
    MOR_CHECK(context, s->first_step > 0.0, MOR_ERROR_CONFIG,
              "%s: found a first time step of %g s, limited by %s; allowed is more than 0; change what limits it",
              s->the_case->path, s->first_step, schedule->limit);
    mor_context_clear_error(context);
    return MOR_OK;
}

/* Under damping a fall reaches the speed g / damping and goes no faster. */
static mor_status check_damping(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    const double damping = c->numerics.damping;
    const double weight = mor_vector_length(c->gravity);
    const double way = weight * c->end / fmax(damping, 1.0 / c->end); /* at most */
    const bool ends = c->numerics.damping_time > 0.0 && c->numerics.damping_time < c->end;
    MOR_CHECK(context, ends || damping * c->end <= 1.0 || weight == 0.0 || way > least_displacement * c->spacing,
              MOR_ERROR_CONFIG,
              "%s: found numerics.damping = %g 1/s, under which nothing can move: a free fall covers %.3g "
              "m until the end, %.3g spacings; it must cover at least a thousandth of a spacing (%.3g m); lower "
              "the damping to %.3g 1/s or less",
              c->path, damping, way, way / c->spacing, least_displacement * c->spacing,
              weight * c->end / (least_displacement * c->spacing));
    return MOR_OK;
}

static mor_status check_speed(mor_context *context, const mor_simulation *s, const mor_case_place *place,
                              const char *what, const char *name, double speed)
{
    MOR_CHECK(
        context, speed < s->soil.sound_speed, MOR_ERROR_CONFIG,
        "%s:%d: found %s '%s' with a velocity of %g m/s, beyond the speed of sound in the soil, %.4g m/s; allowed "
        "is less, advisable is less than a tenth of it; lower the velocity or raise the stiffness of the soil",
        place->file, place->line, what, name, speed, s->soil.sound_speed);
    return MOR_OK;
}

static mor_status check_speeds(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        MOR_TRY(context, check_speed(context, s, &it->place, "soil", it->name, mor_vector_length(it->velocity)));
    }
    for (int k = 0; k < c->n_walls && s->has_soil; ++k) {
        const mor_case_wall *it = &c->walls[k];
        MOR_TRY(context, check_speed(context, s, &it->place, "wall", it->name,
                                     mor_simulation_wall_speed(c, k, &s->wall_motions[k])));
    }
    return MOR_OK;
}

/* Walls in contact with soil have particles, and none is an error there; bodies touch the shape itself. */
static mor_status check_walls(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    for (int w = 0; w < c->n_walls && !s->has_soil; ++w) {
        const mor_case_wall *it = &c->walls[w];
        double middle[3];
        double squared_radius = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double half = 0.5 * (c->domain_maximum[a] - c->domain_minimum[a]);
            middle[a] = c->domain_minimum[a] + half;
            squared_radius += a < c->dimension ? half * half : 0.0;
        }
        const double distance = mor_shape_distance(it->shape, middle);
        MOR_CHECK(context, distance <= MOR_SHAPE_SLOPE_MOST * sqrt(squared_radius), MOR_ERROR_CONFIG,
                  "%s:%d: found wall '%s' outside the domain, %g m from its center, so that nothing "
                  "can touch it; allowed are walls that reach into the domain; move the wall or enlarge 'domain'",
                  it->place.file, it->place.line, it->name, distance);
    }
    return MOR_OK;
}

mor_status mor_simulation_check(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    char place[MOR_CASE_TEXT_BYTES + 16];
    MOR_TRY(context, check_walls(context, simulation));
    MOR_TRY(context, mor_soil_check_images(context, &simulation->soil, true, 0.0));
    MOR_TRY(context, check_speeds(context, simulation));
    MOR_TRY(context, check_damping(context, simulation));
    MOR_TRY(context, find_first_step(context, simulation));
    MOR_TRY(context, check_steps(context, simulation, c->path, "end", c->end));
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        if (it->initial_stress == MOR_CASE_STRESS_SETTLED) {
            snprintf(place, sizeof place, "%s:%d", it->place.file, it->place.line);
            MOR_TRY(context, check_steps(context, simulation, place, "settle_time", it->settle_time));
        }
    }
    return MOR_OK;
}
