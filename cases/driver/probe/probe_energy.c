/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of where energy goes, and of the sum of it all. */
#include "cases/driver/probe/probe_row_internal.h"

#include "core/base/math.h"

#include <math.h>
#include <string.h>

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
             taken(v, MOR_SOIL_ENERGY_HOURGLASS) + taken(v, MOR_SOIL_ENERGY_DIFFUSION) +
             taken(v, MOR_SOIL_ENERGY_DAMPING) + taken(v, MOR_SOIL_ENERGY_REGULARIZATION) +
             taken(v, MOR_SOIL_ENERGY_CORRECTION) + v->simulation->soil.sleep.kinetic;
    return MOR_OK;
}

static mor_status sleep_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->soil.sleep.kinetic;
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

static mor_status soil_hourglass_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = taken(v, MOR_SOIL_ENERGY_HOURGLASS);
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

/* What bodies and walls that move as prescribed took out, beside what the soil gave them: contact with others, and
 * height that bodies gained or lost without anyone's energy. */
static double find_driven_bodies(const mor_simulation *s)
{
    const double time = mor_schedule_time(&s->schedule);
    double sum = s->bodies.contact.wall_energy;
    for (int b = 0; b < s->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &s->bodies.of[b];
        const mor_body_operations *operations = it->group->operations;
        if (s->the_case->bodies[b].is_prescribed && operations->driven_energy != NULL) {
            sum += operations->driven_energy(it->group, it->index, time);
        }
    }
    return sum;
}

static mor_status external_work(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = -taken(v, MOR_SOIL_ENERGY_DRIVEN) - taken(v, MOR_SOIL_ENERGY_RAMP) - find_driven_bodies(v->simulation);
    return MOR_OK;
}

double mor_probe_energy_gone(const mor_simulation *s)
{
    double origin[3];
    double energies[3];
    mor_simulation_place_point(s->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    mor_soil_outflow_energies(&s->soil, origin, energies);
    return energies[0] + energies[1] + energies[2] + mor_simulation_bodies_removed(&s->bodies, origin);
}

enum { KINETIC, POTENTIAL, ELASTIC, PLASTIC, NUMERICAL, BOUNDARY, BODIES, EXTERNAL, OUTFLOW, ENTRIES };

/* What has changed since the start, entry by entry, shape [ENTRIES], J (J/m). */
static mor_status list_changes(mor_context *context, const view *v, double *changes)
{
    double passed_on = 0.0;
    const mor_simulation *s = v->simulation;
    memcpy(changes, mor_probe_energies(context, v), 3 * sizeof *changes);
    for (int k = KINETIC; k <= ELASTIC; ++k) {
        changes[k] -= s->initial_energies[k];
    }
    MOR_TRY(context, plastic_energy(context, v, &changes[PLASTIC]));
    MOR_TRY(context, numerical_dissipation(context, v, &changes[NUMERICAL]));
    MOR_TRY(context, boundary_dissipation(context, v, &changes[BOUNDARY]));
    MOR_TRY(context, external_work(context, v, &changes[EXTERNAL]));
    MOR_TRY(context, friction_strain_energy(context, v, &passed_on));
    changes[BOUNDARY] -= passed_on;
    changes[BODIES] = mor_simulation_bodies_lost(&s->bodies);
    changes[EXTERNAL] = -changes[EXTERNAL];
    changes[OUTFLOW] = mor_probe_energy_gone(s);
    return MOR_OK;
}

/* The sum of the changes is the error, half the sum of their sizes the energy that changed hands. */
static mor_status find_changes(mor_context *context, const view *v, double *changes, double *error, double *turned)
{
    MOR_TRY(context, list_changes(context, v, changes));
    *error = 0.0;
    *turned = 0.0;
    for (int k = 0; k < ENTRIES; ++k) {
        *error += changes[k];
        *turned += 0.5 * fabs(changes[k]);
    }
    return MOR_OK;
}

/* How much energy has changed hands between now and the start. */
static mor_status turned_energy(mor_context *context, const view *v, double *value)
{
    double changes[ENTRIES] = {0.0};
    double error = 0.0;
    return find_changes(context, v, changes, &error, value);
}

static mor_status energy_balance(mor_context *context, const view *v, double *value)
{
    double changes[ENTRIES] = {0.0};
    double error = 0.0;
    double turned = 0.0;
    MOR_TRY(context, find_changes(context, v, changes, &error, &turned));
    turned = fmax(turned, v->past[MOR_PROBE_RECORD_MAXIMUM]);
    *value = turned == 0.0 ? 1.0 : 1.0 + error / turned;
    return MOR_OK;
}

double mor_probe_energy_moved(const mor_simulation *s, int probe)
{
    return s->probes->past[probe][MOR_PROBE_RECORD_MAXIMUM];
}

mor_status mor_probe_energy_find_given(mor_context *context, const view *v, double *share, const char **by)
{
    static const char *const names[] = {
        [PLASTIC] = "plastic strain (probe plastic_energy)",
        [NUMERICAL] = "the method (probe numerical_dissipation)",
        [BOUNDARY] = "walls and rocks (probe boundary_dissipation, less friction_strain_energy)"};
    double changes[ENTRIES] = {0.0};
    double error = 0.0;
    double turned = 0.0;
    MOR_TRY(context, find_changes(context, v, changes, &error, &turned));
    turned = fmax(turned, v->past[MOR_PROBE_RECORD_MAXIMUM]);
    *share = 0.0;
    *by = names[PLASTIC];
    for (int k = PLASTIC; k <= BOUNDARY; ++k) {
        if (-changes[k] > *share * turned) {
            *share = -changes[k] / turned;
            *by = names[k];
        }
    }
    return MOR_OK;
}

double mor_probe_lift_energy(const mor_simulation *s)
{
    const double weight = mor_vector_length(s->the_case->gravity);
    double mass = 0.0;
    for (int64_t i = 0; s->has_soil && i < s->soil.set.n_particles; ++i) {
        mass += s->soil.set.data[MOR_FIELD_MASS][i];
    }
    return mass * weight * s->the_case->spacing + mor_simulation_bodies_lift(&s->bodies);
}

/* Whether nothing but the bodies and what the audit knows of them gives or takes energy. */
static bool is_closed(const mor_case *c)
{
    bool is_closed = c->n_soils == 0 && !(c->numerics.gravity_ramp > 0.0) && !(c->numerics.damping > 0.0) &&
                     !(c->numerics.local_damping > 0.0);
    for (int b = 0; b < c->n_bodies; ++b) {
        is_closed = is_closed && !(c->bodies[b].spring_damping > 0.0);
    }
    return is_closed;
}

double mor_probe_bodies_error(const mor_simulation *s, double *share)
{
    double origin[3];
    double energies[3];
    *share = 0.0;
    if (!is_closed(s->the_case)) {
        return 0.0;
    }
    mor_simulation_place_point(s->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    mor_simulation_bodies_energy(&s->bodies, origin, &energies[0], &energies[1], &energies[2]);
    const double lost = mor_simulation_bodies_lost(&s->bodies);
    const double driven = find_driven_bodies(s);
    const double removed = mor_simulation_bodies_removed(&s->bodies, origin);
    double error = lost + driven + removed;
    double turned = 0.5 * (fabs(lost) + fabs(driven) + fabs(removed));
    for (int k = 0; k < 3; ++k) {
        const double change = energies[k] - s->initial_energies[k];
        error += change;
        turned += 0.5 * fabs(change);
    }
    const double scale = fmax(turned, fmax(mor_simulation_bodies_lift(&s->bodies), s->initial_energies[0]));
    *share = scale > 0.0 ? error / scale : 0.0;
    return error;
}

const mor_probe_measure mor_probe_energy_measures[] =
    {{.type = {"plastic_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "energy lost to plastic strain since the start"},
      .run = plastic_energy},
     {.type =
          {"numerical_dissipation", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
           "energy lost to the numerical scheme of the soil since the start: Riemann dissipation, artificial "
           "stress, hourglass control, stress diffusion, damping, XSPH, shifting, gradient correction or fit, angular "
           "momentum"},
      .run = numerical_dissipation},
     {.type = {"riemann_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "part of numerical_dissipation: Riemann dissipation"},
      .run = riemann_energy},
     {.type = {"artificial_stress_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "part of numerical_dissipation: artificial stress"},
      .run = artificial_stress_energy},
     {.type = {"soil_hourglass_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "part of numerical_dissipation: hourglass control of the soil; in part stored, and given back"},
      .run = soil_hourglass_energy},
     {.type = {"stress_diffusion_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "part of numerical_dissipation: stress diffusion"},
      .run = stress_diffusion_energy},
     {.type = {"sleep_energy", "J", "J/m", 0, 0, OF_SOIL, 100.0,
               "part of numerical_dissipation: kinetic energy of soil when it fell asleep"},
      .run = sleep_energy},
     {.type = {"boundary_dissipation", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "energy the soil lost to friction and impact at walls and rocks since the start"},
      .run = boundary_dissipation},
     {.type = {"friction_strain_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
               "part of boundary_dissipation: work on the stress of soil that a Coulomb boundary strains while it "
               "slips; next to nothing where strong soil slides"},
      .run = friction_strain_energy},
     {.type = {"soil_work_on_bodies", "J", "J/m", 0, 0, OF_BOTH | AUDIT, 100.0,
               "work of the soil on bodies that move freely since the start"},
      .run = soil_work_on_bodies},
     {.type = {"external_work", "J", "J/m", 0, 0, AUDIT, 100.0,
               "work of moving walls, driven bodies and the gravity ramp since the start"},
      .run = external_work},
     {.type =
          {"energy_balance", "1", "1", 0, 0, AUDIT | PAST, 100.0,
           "1 + (change of the sum of all energies and losses - external work) / energy converted so far; 1: balanced"},
      .run = energy_balance,
      .past = turned_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.run = NULL}};
