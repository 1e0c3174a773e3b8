/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Numbers, sets and energies of a simulation as a whole. */
#include "cases/driver/scene/simulation.h"

#include "core/base/math.h"
#include "core/material/params.h"
#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_sum.h"

#include <math.h>
#include <string.h>

int64_t mor_simulation_particles(const mor_simulation *simulation)
{
    int64_t n = simulation->soil.set.n_particles;
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        n += simulation->bodies.groups[g]->set.n_particles;
    }
    return n;
}

int mor_simulation_sets(mor_simulation *simulation, bool has_history, mor_set **sets)
{
    int n = 0;
    if (simulation->has_soil) {
        sets[n++] = &simulation->soil.set;
    }
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        sets[n++] = &simulation->bodies.groups[g]->set;
    }
    if (has_history && simulation->bodies.has_contact) {
        sets[n++] = &simulation->bodies.contact.history;
    }
    return n;
}

/* Jaky's ratio for frictional models, hydrostatic for others. */
double mor_simulation_lateral_ratio(const mor_simulation *simulation, int region)
{
    const mor_material *material = simulation->laws[region];
    const mor_case_soil *soil = &simulation->the_case->soils[region];
    return soil->lateral_ratio >= 0.0
               ? soil->lateral_ratio
               : 1.0 - sin(mor_params_role_value(material->parameters, soil->parameters, MOR_ROLE_FRICTION_ANGLE, 0.0));
}

mor_measure_points mor_simulation_points(const mor_simulation *simulation, int n_threads)
{
    double *const *data = simulation->soil.set.data;
    return (mor_measure_points){.n_points = simulation->soil.set.n_particles,
                                .dimension = simulation->the_case->dimension,
                                .spacing = simulation->the_case->spacing,
                                .position = data[MOR_FIELD_POSITION],
                                .mass = data[MOR_FIELD_MASS],
                                .density = data[MOR_FIELD_DENSITY],
                                .n_threads = n_threads};
}

/* Stored energies of particles by the material's own operation; NaN when the model has no energy operation. */
static void fill_elastic(const void *argument, int64_t start, int64_t n, double *terms)
{
    const mor_soil *soil = argument;
    double *const *data = soil->set.data;
    const double *state[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        const int field = soil->state_fields[k];
        state[k] = data[field] + start * soil->set.fields[field].n_components;
    }
    const mor_batch batch = {.n = n,
                             .density = data[MOR_FIELD_DENSITY] + start,
                             .stress_in = data[MOR_FIELD_STRESS] + 6 * start,
                             .state_in = state};
    const bool is_known = soil->material->operations.energy(soil->material, &batch, terms) == MOR_OK;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] *= is_known ? data[MOR_FIELD_MASS][start + i] / data[MOR_FIELD_DENSITY][start + i] : NAN;
    }
}

/* Potential energy that particles have because periodic faces put them back, J (J/m). */
static void fill_crossings(const void *argument, int64_t start, int64_t n, double *terms)
{
    const mor_soil *soil = argument;
    for (int64_t i = start; i < start + n; ++i) {
        const double *crossings = soil->set.data[MOR_FIELD_CROSSINGS] + 3 * i;
        double gained = 0.0;
        for (int a = 0; a < 3; ++a) {
            gained += soil->settings.gravity[a] * soil->period.length[a] * crossings[a];
        }
        terms[i - start] = -soil->set.data[MOR_FIELD_MASS][i] * gained;
    }
}

void mor_simulation_energies(const mor_simulation *simulation, int n_threads, double *energies)
{
    double datum[3];
    mor_simulation_place_point(simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, datum);
    mor_simulation_bodies_energy(&simulation->bodies, datum, &energies[0], &energies[1], &energies[2]);
    if (simulation->has_soil) {
        mor_measure_points points = mor_simulation_points(simulation, 0);
        points.n_threads = n_threads;
        energies[0] += mor_measure_kinetic_energy(&points, simulation->soil.set.data[MOR_FIELD_VELOCITY]);
        energies[1] += mor_measure_potential_energy(&points, simulation->soil.settings.gravity, datum);
        if (simulation->soil.period.is_any) {
            energies[1] += mor_sum_over(points.n_points, n_threads, fill_crossings, &simulation->soil);
        }
        energies[2] += mor_sum_over(points.n_points, n_threads, fill_elastic, &simulation->soil);
    }
}
