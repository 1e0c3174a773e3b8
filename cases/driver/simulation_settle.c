/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Energy of a simulation, and the settling of its initial stress. */
#include "cases/driver/simulation.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/measure.h"

#include <string.h>

/* Damping rate of a settling run as a share of sound speed over smoothing length, and steps between checks. */
#define SETTLE_DAMPING 0.02
enum { SETTLE_CHECK = 50, ENERGY_BATCH = 512 };

static mor_measure_points points_of(const mor_simulation *simulation)
{
    double *const *data = simulation->soil.set.data;
    return (mor_measure_points){simulation->soil.set.n_particles,
                                simulation->the_case->dimension,
                                simulation->the_case->spacing,
                                data[MOR_FIELD_POSITION],
                                data[MOR_FIELD_MASS],
                                data[MOR_FIELD_DENSITY]};
}

/* Stored energy by the material's own operation; NaN when the model cannot tell. */
static double sum_elastic(const mor_simulation *simulation)
{
    const mor_soil *soil = &simulation->soil;
    double *const *data = soil->set.data;
    double sum = 0.0;
    for (int64_t first = 0; first < soil->set.n_particles; first += ENERGY_BATCH) {
        const int64_t left = soil->set.n_particles - first;
        const double *state[MOR_MATERIAL_STATES_MAX];
        for (int k = 0; k < soil->material->n_state; ++k) {
            const int field = soil->state_fields[k];
            state[k] = data[field] + first * soil->set.fields[field].n_components;
        }
        double stored[ENERGY_BATCH];
        const mor_batch batch = {.n = left < ENERGY_BATCH ? left : ENERGY_BATCH,
                                 .density = data[MOR_FIELD_DENSITY] + first,
                                 .stress_in = data[MOR_FIELD_STRESS] + 6 * first,
                                 .state_in = state};
        if (soil->material->operations.energy(soil->material, &batch, stored) != MOR_OK) {
            return NAN;
        }
        for (int64_t i = 0; i < batch.n; ++i) {
            sum += stored[i] * data[MOR_FIELD_MASS][first + i] / data[MOR_FIELD_DENSITY][first + i];
        }
    }
    return sum;
}

void mor_simulation_energies(const mor_simulation *simulation, double *energies)
{
    double datum[3];
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, datum);
    mor_simulation_bodies_energy(&simulation->bodies, datum, &energies[0], &energies[1], &energies[2]);
    if (simulation->has_soil) {
        const mor_measure_points points = points_of(simulation);
        energies[0] += mor_measure_kinetic_energy(&points, simulation->soil.set.data[MOR_FIELD_VELOCITY]);
        energies[1] += mor_measure_potential_energy(&points, simulation->soil.settings.gravity, datum);
        energies[2] += sum_elastic(simulation);
    }
}

double mor_simulation_energy(const mor_simulation *simulation, double *elastic)
{
    double energies[3];
    mor_simulation_energies(simulation, energies);
    if (elastic != NULL) {
        *elastic = energies[2];
    }
    return energies[0] + energies[1] + energies[2];
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

static mor_status run_settling(mor_context *context, mor_simulation *simulation, double longest, double ratio,
                               const volatile sig_atomic_t *stop)
{
    mor_schedule *schedule = &simulation->schedule;
    const mor_measure_points points = points_of(simulation);
    double origin[3];
    double height = 0.0;
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    MOR_TRY(context, mor_measure_height(context, &points, origin, simulation->up, 0.0, &height));
    height = simulation->surface_height - mor_vector_dot(origin, simulation->up) - height;
    const double limit = ratio * sqrt(mor_vector_length(simulation->soil.settings.gravity) * height);
    double speed = INFINITY;
    int64_t until = mor_schedule_ticks(schedule, longest);
    until = until > 0 ? until : 1;
    /* At least one check's worth of steps: at the start everything is at rest because nothing has moved yet. */
    while (schedule->now < until && !(speed < limit) && (stop == NULL || *stop == 0)) {
        for (int k = 0; k < SETTLE_CHECK && schedule->now < until; ++k) {
            MOR_TRY(context, mor_schedule_step(context, schedule, until));
        }
        MOR_TRY(context,
                mor_measure_speed(context, &points, simulation->soil.set.data[MOR_FIELD_VELOCITY], 99.0, &speed));
    }
    const bool is_stopped = stop != NULL && *stop != 0;
    MOR_CHECK(
        context, speed < limit || is_stopped, MOR_NOT_CONVERGED,
        "initial stress timed out: after %.4g s and %llu steps 99 %% of the particles are slower than %.3g m/s, the "
        "limit is %.3g m/s. Give a longer 'settle_time' or a larger 'settle_speed_ratio', or the soil does not stand",
        mor_schedule_time(schedule), (unsigned long long)schedule->n_steps, speed, limit);
    mor_context_log(context, MOR_LOG_INFO,
                    "initial stress %s after %.4g s and %llu steps: 99 %% of the particles are slower than %.3g m/s, "
                    "the limit is %.3g m/s",
                    is_stopped ? "stopped" : "converged", mor_schedule_time(schedule),
                    (unsigned long long)schedule->n_steps, speed, limit);
    return MOR_OK;
}

mor_status mor_simulation_settle(mor_context *context, mor_simulation *simulation, const volatile sig_atomic_t *stop)
{
    double longest = 0.0;
    double ratio = 0.0;
    mor_soil *soil = &simulation->soil;
    if (find_settling(simulation->the_case, &longest, &ratio)) {
        const double damping = soil->settings.damping;
        const double ramp = soil->settings.gravity_ramp;
        soil->settings.damping = SETTLE_DAMPING * soil->sound_speed / soil->smoothing_length;
        soil->settings.gravity_ramp = 0.0;
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
                                                      soil->settings.damping));
        MOR_TRY(context, run_settling(context, simulation, longest, ratio, stop));
        MOR_TRY(context, mor_simulation_bodies_settle(context, &simulation->bodies, simulation->the_case, 0.0));
        for (int w = 0; w < soil->n_walls; ++w) {
            memcpy(soil->walls[w].velocity, velocities[w], sizeof velocities[w]);
        }
        for (int w = 0; w < contact->n_walls; ++w) {
            memcpy(contact->walls[w].velocity, velocities[w], sizeof velocities[w]);
        }
        contact->time = 0.0;
        soil->settings.damping = damping;
        soil->settings.gravity_ramp = ramp;
        const int64_t n = soil->set.n_particles;
        memset(soil->set.data[MOR_FIELD_VELOCITY], 0, (size_t)(3 * n) * sizeof(double));
        memset(soil->set.data[MOR_FIELD_DENSITY_RATE], 0, (size_t)n * sizeof(double));
        if (soil->set.data[MOR_FIELD_STRAIN_RATE] != NULL) {
            memset(soil->set.data[MOR_FIELD_STRAIN_RATE], 0, (size_t)n * 6 * sizeof(double));
        }
        memset(soil->wall_impulse, 0, sizeof soil->wall_impulse);
        memset(soil->wall_force, 0, sizeof soil->wall_force);
        soil->largest_speed = 0.0;
        MOR_TRY(context, mor_soil_init_state(context, soil));
        simulation->schedule.now = 0;
        simulation->schedule.n_steps = 0;
        simulation->schedule.step_length = 0.0;
        simulation->schedule.n_particle_steps = 0;
    }
    mor_soil_restart_energy(soil);
    mor_simulation_energies(simulation, simulation->initial_energies);
    return MOR_OK;
}
