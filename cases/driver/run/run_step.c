/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_step.h"

#include "cases/driver/map/map_track.h"
#include "cases/driver/probe/probe.h"
#include "cases/driver/run/run_warnings.h"
#include "cases/driver/run/wall_time.h"
#include "core/material/params.h"

#include <math.h>

int64_t mor_run_snapshot_tick(const mor_simulation *simulation, int64_t number)
{
    const int n = simulation->the_case->output.n_snapshots;
    const mor_schedule *schedule = &simulation->schedule;
    /* In floating point: the product of ticks and number does not fit into 64 bits. */
    return number >= n ? schedule->end : (int64_t)llround((double)schedule->end * ((double)number / n));
}

int64_t mor_run_find_snapshot(const mor_simulation *simulation, int64_t number)
{
    while (number < simulation->the_case->output.n_snapshots &&
           mor_run_snapshot_tick(simulation, number) <= simulation->schedule.now) {
        ++number;
    }
    return number;
}

/* Particles of a lattice lie too near to some faces of bodies and walls, and too far from others. The first sum of
 * densities, in the first step, tells: evenly cut lattices have next to no difference, relaxed soil 0.03. */
static void warn_of_placement(mor_context *context, const mor_simulation *s)
{
    const double advisable = 0.1;
    const double share = 0.01; /* of the soil */
    const mor_case *c = s->the_case;
    double n[MOR_CASE_SOILS_MAX] = {0.0};
    double n_off[MOR_CASE_SOILS_MAX] = {0.0};
    if (s->schedule.n_steps != 1 || !s->has_soil || c->stage.run[0] != '\0' ||
        c->numerics.density_reinitialization == 0) {
        return;
    }
    const mor_set *set = &s->soil.set;
    const double *region = s->soil.region_field >= 0 ? set->data[s->soil.region_field] : NULL;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const int k = region != NULL ? (int)region[i] : 0;
        n[k] += 1.0;
        n_off[k] += fabs(set->data[MOR_FIELD_DENSITY][i] / c->soils[k].density - 1.0) > advisable;
    }
    for (int k = 0; k < c->n_soils; ++k) {
        if (!c->soils[k].is_relaxed && n_off[k] > share * n[k]) {
            mor_context_log(
                context, MOR_LOG_WARNING,
                "%s:%d: at the start the density of %.2g %% of soil '%s' is off by more than %g %%; below "
                "%g %% of it is advisable: beside slanted and curved faces of walls and bodies the "
                "particles of a lattice lie too near or too far; particles = \"relaxed\" places them evenly",
                c->soils[k].place.file, c->soils[k].place.line, 100.0 * n_off[k] / n[k], c->soils[k].name,
                100.0 * advisable, 100.0 * share);
        }
    }
}

/* Contact springs that are loaded before anything has moved drive bodies apart. */
static void warn_of_overlap(mor_context *context, const mor_simulation *simulation)
{
    const double advisable = 0.01;
    double kinetic = 0.0;
    double potential = 0.0;
    double elastic = 0.0;
    if (simulation->schedule.n_steps != 1 || !simulation->bodies.has_contact) {
        return;
    }
    mor_simulation_bodies_energy(&simulation->bodies, (const double[3]){0.0, 0.0, 0.0}, &kinetic, &potential, &elastic);
    const double stored = simulation->bodies.contact.spring_energy;
    if (stored > advisable * (kinetic + mor_simulation_bodies_lift(&simulation->bodies))) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "bodies overlap one another or walls by up to %.3g m as the run begins; their contacts store %.3g %s, "
            "which drives them apart: leave a gap (surfaces of meshes bulge beside edges by up to a 25th of a spacing)",
            simulation->bodies.contact.deepest, stored, simulation->the_case->dimension == 2 ? "J/m" : "J");
    }
}

void mor_run_warn_of_speed(mor_context *context, const mor_simulation *simulation)
{
    const double advisable = 0.1;
    const double sound_speed = simulation->soil.sound_speed;
    if (simulation->has_soil && simulation->fastest > advisable * sound_speed) {
        mor_context_log(context, MOR_LOG_WARNING,
                        MOR_RUN_WARNING_AT_END
                        "the largest speed so far was %.2f of the speed of sound (at t = %.4g s); below %g is "
                        "advisable: raise %s",
                        simulation->fastest / sound_speed, simulation->fastest_time, advisable,
                        mor_params_stiffness_key(simulation->laws[0]->parameters));
    }
}

mor_status mor_run_step(mor_context *context, mor_simulation *simulation, int64_t until, double *seconds)
{
    const double before = mor_wall_time();
    MOR_TRY(context, mor_schedule_step(context, &simulation->schedule, until));
    *seconds += mor_wall_time() - before;
    if (simulation->soil.largest_speed > simulation->fastest) {
        simulation->fastest = simulation->soil.largest_speed;
        simulation->fastest_time = mor_schedule_time(&simulation->schedule);
    }
    warn_of_overlap(context, simulation);
    warn_of_placement(context, simulation);
    mor_map_follow(context, simulation->maps);
    return mor_probe_follow(context, simulation);
}
