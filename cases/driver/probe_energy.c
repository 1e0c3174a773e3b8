/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of where energy goes, and of the sum of it all. */
#include "cases/driver/probe_measure.h"

#include "core/base/math.h"

typedef mor_probe_view view;

static double taken(const view *v, mor_soil_energy_part part)
{
    return mor_soil_energy_taken(&v->simulation->soil, part);
}

static mor_status plastic_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_PLASTIC);
    return MOR_OK;
}

static mor_status numerical_dissipation(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_RIEMANN) + taken(v, MOR_SOIL_ENERGY_ARTIFICIAL) +
             taken(v, MOR_SOIL_ENERGY_DIFFUSION) + taken(v, MOR_SOIL_ENERGY_DAMPING) +
             taken(v, MOR_SOIL_ENERGY_REGULARIZATION) + taken(v, MOR_SOIL_ENERGY_CORRECTION);
    return MOR_OK;
}

static mor_status riemann_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_RIEMANN);
    return MOR_OK;
}

static mor_status artificial_stress_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_ARTIFICIAL);
    return MOR_OK;
}

static mor_status stress_diffusion_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_DIFFUSION);
    return MOR_OK;
}

static mor_status boundary_dissipation(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_BOUNDARY);
    return MOR_OK;
}

static mor_status friction_strain_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = -taken(v, MOR_SOIL_ENERGY_PASSED_ON);
    return MOR_OK;
}

static mor_status soil_work_on_bodies(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_ROCKS);
    return MOR_OK;
}

/* What bodies that move as prescribed took out, beside what the soil gave them: contact with others, and height that
 * they gained or lost without anyone's energy. */
static double find_driven_bodies(const view *v)
{
    const mor_simulation *s = v->simulation;
    const double time = mor_schedule_time(&s->schedule);
    double sum = 0.0;
    for (int b = 0; b < s->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &s->bodies.of[b];
        if (s->the_case->bodies[b].is_prescribed && it->rigid != NULL) {
            const mor_body *body = &it->group->bodies[it->index];
            const double *velocity = it->rigid->states[it->index].velocity;
            sum += mor_vector_dot(velocity, body->contact_impulse) +
                   body->mass * time * mor_vector_dot(it->group->gravity, velocity);
        }
    }
    return sum;
}

static mor_status external_work(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = -taken(v, MOR_SOIL_ENERGY_DRIVEN) - taken(v, MOR_SOIL_ENERGY_RAMP) - find_driven_bodies(v);
    return MOR_OK;
}

/* Energy of the bodies that contact and viscous damping took. */
static double find_bodies_lost(const mor_simulation_bodies *bodies)
{
    double lost = bodies->contact.friction_energy + bodies->contact.damping_energy;
    for (int g = 0; g < bodies->n_elastics; ++g) {
        lost += bodies->elastics[g].damped_energy;
    }
    return lost;
}

/* Energy of the soil that has left the domain, about the same origin as the simulation's. */
static double find_outflow(const mor_simulation *s)
{
    double origin[3];
    double energies[3];
    mor_simulation_place_point(s->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    mor_soil_outflow_energies(&s->soil, origin, energies);
    return energies[0] + energies[1] + energies[2];
}

/* What has changed since the start, entry by entry, J (J/m): their sum is the error, half the sum of their sizes the
 * energy that changed hands. */
static mor_status find_changes(mor_context *context, const view *v, double *error, double *turned)
{
    enum { KINETIC, POTENTIAL, ELASTIC, PLASTIC, NUMERICAL, BOUNDARY, BODIES, EXTERNAL, OUTFLOW, ENTRIES };
    double passed_on = 0.0;
    double changes[ENTRIES] = {0.0};
    const mor_simulation *s = v->simulation;
    mor_simulation_energies(s, changes);
    for (int k = KINETIC; k <= ELASTIC; ++k) {
        changes[k] -= s->initial_energies[k];
    }
    MOR_TRY(context, plastic_energy(context, v, &changes[PLASTIC]));
    MOR_TRY(context, numerical_dissipation(context, v, &changes[NUMERICAL]));
    MOR_TRY(context, boundary_dissipation(context, v, &changes[BOUNDARY]));
    MOR_TRY(context, external_work(context, v, &changes[EXTERNAL]));
    MOR_TRY(context, friction_strain_energy(context, v, &passed_on));
    changes[BOUNDARY] -= passed_on;
    changes[BODIES] = find_bodies_lost(&s->bodies);
    changes[EXTERNAL] = -changes[EXTERNAL];
    changes[OUTFLOW] = find_outflow(s);
    *error = 0.0;
    *turned = 0.0;
    for (int k = 0; k < ENTRIES; ++k) {
        *error += changes[k];
        *turned += 0.5 * fabs(changes[k]);
    }
    return MOR_OK;
}

mor_status mor_probe_turned_energy(mor_context *context, const view *v, double *value)
{
    double error = 0.0;
    return find_changes(context, v, &error, value);
}

static mor_status energy_balance(mor_context *context, const view *v, double *value)
{
    double error = 0.0;
    double turned = 0.0;
    MOR_TRY(context, find_changes(context, v, &error, &turned));
    turned = fmax(turned, v->simulation->extremes[v->number]);
    *value = turned == 0.0 ? 1.0 : 1.0 + error / turned;
    return MOR_OK;
}

const mor_probe_measure mor_probe_energy_measures[] = {{"plastic_energy", plastic_energy},
                                                       {"numerical_dissipation", numerical_dissipation},
                                                       {"riemann_energy", riemann_energy},
                                                       {"artificial_stress_energy", artificial_stress_energy},
                                                       {"stress_diffusion_energy", stress_diffusion_energy},
                                                       {"boundary_dissipation", boundary_dissipation},
                                                       {"friction_strain_energy", friction_strain_energy},
                                                       {"soil_work_on_bodies", soil_work_on_bodies},
                                                       {"external_work", external_work},
                                                       {MOR_PROBE_ENERGY_BALANCE, energy_balance},
                                                       {NULL, NULL}};
