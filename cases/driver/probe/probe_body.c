/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of bodies, their contact, and their coupling with the soil. */
#include "cases/driver/probe/probe_row_internal.h"

#include "bodies/body_surface.h"
#include "core/base/math.h"

#include <string.h>

typedef mor_probe_view view;

static mor_status find_body(mor_context *context, const view *v, const mor_simulation_body **found)
{
    *found = v->body;
    return v->body != NULL ? MOR_OK
                           : MOR_FAIL(context, MOR_ERROR_CONFIG,
                                      "found body '%s'; allowed are the names of the case's bodies; correct the name",
                                      v->probe->body);
}

static const mor_body *body_of(const mor_simulation_body *it)
{
    return &it->group->bodies[it->index];
}

/* Component of a vector of the body along the probe's direction. */
static mor_status along(mor_context *context, const view *v, const double *(*pick)(const mor_simulation_body *),
                        double *value)
{
    const mor_simulation_body *it = NULL;
    MOR_TRY(context, find_body(context, v, &it));
    *value = mor_vector_dot(pick(it), v->frame.direction);
    return MOR_OK;
}

/* What a body that was removed has no more is NaN. */
static mor_status present(const view *v, mor_status status, double *value)
{
    if (status == MOR_OK && v->body->group->boundary.patches[v->body->index].is_removed) {
        *value = NAN;
    }
    return status;
}

static const double *pick_center(const mor_simulation_body *it)
{
    return body_of(it)->center;
}

static const double *pick_velocity(const mor_simulation_body *it)
{
    return body_of(it)->velocity;
}

static const double *pick_rotation(const mor_simulation_body *it)
{
    return body_of(it)->rotation_angle;
}

static const double *pick_spin(const mor_simulation_body *it)
{
    return body_of(it)->angular_velocity;
}

static const double *pick_soil_force(const mor_simulation_body *it)
{
    return it->group->boundary.patches[it->index].force;
}

static const double *pick_impulse_given(const mor_simulation_body *it)
{
    return it->group->boundary.patches[it->index].impulse;
}

static const double *pick_impulse_received(const mor_simulation_body *it)
{
    return body_of(it)->soil_impulse;
}

static mor_status position(mor_context *context, const view *v, double *value)
{
    MOR_TRY(context, along(context, v, pick_center, value));
    *value -= mor_vector_dot(v->frame.origin, v->frame.direction);
    return present(v, MOR_OK, value);
}

static mor_status velocity(mor_context *context, const view *v, double *value)
{
    return present(v, along(context, v, pick_velocity, value), value);
}

static mor_status rotation_angle(mor_context *context, const view *v, double *value)
{
    return present(v, along(context, v, pick_rotation, value), value);
}

static mor_status angular_velocity(mor_context *context, const view *v, double *value)
{
    return present(v, along(context, v, pick_spin, value), value);
}

static mor_status force_soil(mor_context *context, const view *v, double *value)
{
    return along(context, v, pick_soil_force, value);
}

static mor_status impulse_given(mor_context *context, const view *v, double *value)
{
    return along(context, v, pick_impulse_given, value);
}

static mor_status impulse_received(mor_context *context, const view *v, double *value)
{
    return along(context, v, pick_impulse_received, value);
}

/* About the body's center; the patch has it about the origin of coordinates. */
static mor_status moment_soil(mor_context *context, const view *v, double *value)
{
    const mor_simulation_body *it = NULL;
    MOR_TRY(context, find_body(context, v, &it));
    const mor_boundary_patch *patch = &it->group->boundary.patches[it->index];
    double moved[3] = {patch->moment[0], patch->moment[1], patch->moment[2]};
    mor_vector_cross_add(-1.0, body_of(it)->center, patch->force, moved);
    *value = mor_vector_dot(moved, v->frame.direction);
    return MOR_OK;
}

static double find_contact_force(const view *v)
{
    return mor_body_contact_force(v->body->group, v->body->index, v->frame.direction);
}

static mor_status force_contact(mor_context *context, const view *v, double *value)
{
    const mor_simulation_body *it = NULL;
    MOR_TRY(context, find_body(context, v, &it));
    *value = find_contact_force(v);
    return MOR_OK;
}

/* The steppers that move a body. */
static uint64_t find_bit(const view *v)
{
    const mor_contact *contact = &v->simulation->bodies.contact;
    uint64_t bit = 0;
    for (int g = 0; g < contact->n_groups; ++g) {
        bit |= contact->groups[g] == v->body->group ? contact->stepper_bits[g] : 0;
    }
    return bit;
}

static mor_probe_contact look_at_body(const view *v, uint64_t members, double *whole, double *part)
{
    if (v->body == NULL || (find_bit(v) & members) == 0) {
        return MOR_PROBE_CONTACT_NONE;
    }
    *whole = find_contact_force(v);
    *part = *whole;
    return MOR_PROBE_CONTACT_NEW;
}

static mor_status kinetic_energy(mor_context *context, const view *v, double *value)
{
    const mor_simulation_body *it = NULL;
    double momentum[3];
    double angular[3];
    MOR_TRY(context, find_body(context, v, &it));
    *value = it->group->operations->momentum(it->group, it->index, momentum, angular);
    return present(v, MOR_OK, value);
}

static mor_status elastic_energy(mor_context *context, const view *v, double *value)
{
    const mor_simulation_body *it = NULL;
    MOR_TRY(context, find_body(context, v, &it));
    const mor_body_operations *operations = it->group->operations;
    *value = operations->strain_energy != NULL ? operations->strain_energy(it->group, it->index) : 0.0;
    return MOR_OK;
}

static mor_status depth(mor_context *context, const view *v, double *value)
{
    const mor_simulation_body *it = NULL;
    MOR_TRY(context, find_body(context, v, &it));
    *value = mor_simulation_body_depth(it, v->frame.up, mor_vector_dot(v->frame.origin, v->frame.up));
    return present(v, MOR_OK, value);
}

static mor_status largest_depth(mor_context *context, const view *v, double *value)
{
    MOR_TRY(context, depth(context, v, value));
    *value = fmax(*value, v->past[MOR_PROBE_RECORD_MAXIMUM]);
    return MOR_OK;
}

/* Kinetic [0], potential [1] and elastic [2] energy of all bodies; springs of contact are elastic. */
static void all_energies(const view *v, double *energies)
{
    mor_simulation_bodies_energy(&v->simulation->bodies, v->frame.origin, &energies[0], &energies[1], &energies[2]);
}

static mor_status bodies_kinetic_energy(mor_context *context, const view *v, double *value)
{
    double energies[3];
    (void)context;
    all_energies(v, energies);
    *value = energies[0];
    return MOR_OK;
}

static mor_status bodies_elastic_energy(mor_context *context, const view *v, double *value)
{
    double energies[3];
    (void)context;
    all_energies(v, energies);
    *value = energies[2];
    return MOR_OK;
}

static mor_status bodies_damped_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_simulation_bodies_damped(&v->simulation->bodies);
    return MOR_OK;
}

static mor_status bodies_energy_balance(mor_context *context, const view *v, double *value)
{
    *value = mor_simulation_bodies_lost(&v->simulation->bodies) + mor_probe_total_energy(context, v) +
             mor_probe_energy_gone(v->simulation);
    const double initial = mor_simulation_initial_energy(v->simulation);
    *value = initial != 0.0 ? *value / initial : NAN; /* nothing to measure by */
    return MOR_OK;
}

static mor_status contact_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->bodies.contact.spring_energy;
    return MOR_OK;
}

static mor_status contact_friction_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->bodies.contact.friction_energy;
    return MOR_OK;
}

static mor_status contact_damping_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->bodies.contact.damping_energy;
    return MOR_OK;
}

static mor_status contact_depth(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->bodies.contact.deepest;
    return MOR_OK;
}

static mor_probe_contact look_at_depth(const view *v, uint64_t members, double *whole, double *part)
{
    (void)members;
    *whole = v->simulation->bodies.contact.deepest;
    *part = *whole;
    return MOR_PROBE_CONTACT_NEW;
}

static mor_status wall_contact_force(mor_context *context, const view *v, double *value)
{
    const mor_contact *contact = &v->simulation->bodies.contact;
    if (v->wall < 0 || v->wall >= contact->n_walls) {
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "found wall '%s'; allowed are the names of the case's walls; correct the name", v->probe->wall);
    }
    *value = mor_vector_dot(contact->walls[v->wall].force, v->frame.direction);
    return MOR_OK;
}

static mor_probe_contact look_at_wall(const view *v, uint64_t members, double *whole, double *part)
{
    const mor_contact *contact = &v->simulation->bodies.contact;
    double force[3];
    if (v->wall < 0 || v->wall >= contact->n_walls) {
        return MOR_PROBE_CONTACT_NONE;
    }
    const double *all = contact->walls[v->wall].force;
    mor_contact_wall_force(contact, v->wall, members, force);
    *whole = mor_vector_dot(all, v->frame.direction);
    *part = mor_vector_dot(force, v->frame.direction);
    return memcmp(all, force, sizeof force) == 0 ? MOR_PROBE_CONTACT_NEW : MOR_PROBE_CONTACT_LATE;
}

static mor_status rate_ratio(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = (double)mor_schedule_rate_ratio(&v->simulation->schedule);
    return MOR_OK;
}

/* Of soil and bodies about the probe's origin. */
static mor_status angular_momentum(mor_context *context, const view *v, double *value)
{
    double momentum[3];
    double sum[3];
    const double *x = v->points.position;
    const double *u = v->simulation->soil.set.data[MOR_FIELD_VELOCITY];
    (void)context;
    mor_simulation_bodies_momentum(&v->simulation->bodies, v->frame.origin, momentum, sum);
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        double arm[3];
        for (int a = 0; a < 3; ++a) {
            arm[a] = x[3 * i + a] - v->frame.origin[a];
        }
        mor_vector_cross_add(v->points.mass[i], arm, u + 3 * i, sum);
    }
    *value = mor_vector_dot(sum, v->frame.direction);
    return MOR_OK;
}

const mor_probe_measure mor_probe_body_measures[] = {
    {.type = {"body_position", "m", "m", BODY | ORIGIN | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
              "center of mass of a body from origin along direction"},
     .run = position},
    {.type = {"body_velocity", "m/s", "m/s", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
              "velocity of the center of mass of a body along direction"},
     .run = velocity},
    {.type = {"body_rotation_angle", "rad", "rad", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | OF_ROTATION, 100.0,
              "angle of rotation of a body about direction since the start, full revolutions included"},
     .run = rotation_angle},
    {.type = {"body_angular_velocity", "rad/s", "rad/s", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | OF_ROTATION,
              100.0, "angular velocity of a body about direction"},
     .run = angular_velocity},
    {.type = {"body_force_soil", "N", "N/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH | FORCE, 100.0,
              "force of the soil on a body along direction"},
     .run = force_soil},
    {.type = {"body_moment_soil", "N m", "N", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH | OF_ROTATION | STEP, 100.0,
              "moment of the soil on a body about direction, about its center of mass"},
     .run = moment_soil},
    {.type = {"body_force_contact", "N", "N/m", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | FORCE | CONTACT, 100.0,
              "force of other bodies and walls on a body along direction"},
     .run = force_contact,
     .contact = look_at_body},
    {.type = {"body_impulse_soil_given", "N s", "N s/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH, 100.0,
              "impulse that the soil gave to a body since the start, along direction"},
     .run = impulse_given},
    {.type = {"body_impulse_soil_received", "N s", "N s/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH, 100.0,
              "impulse that a body received from the soil since the start, along direction"},
     .run = impulse_received},
    {.type = {"body_kinetic_energy", "J", "J/m", BODY, BODY, OF_BODIES, 100.0, "kinetic energy of a body"},
     .run = kinetic_energy},
    {.type = {"body_elastic_energy", "J", "J/m", BODY, BODY, OF_BODIES, 100.0,
              "strain energy of a body; zero of a rigid one"},
     .run = elastic_energy},
    {.type = {"penetration_depth", "m", "m", BODY | ORIGIN, BODY, OF_BODIES, 100.0,
              "depth of the lowest point of the surface of a body below origin, along gravity"},
     .run = depth},
    {.type = {"penetration_depth_largest", "m", "m", BODY | ORIGIN, BODY, OF_BODIES | PAST, 100.0,
              "largest penetration_depth since the start"},
     .run = largest_depth,
     .past = depth},
    {.type = {"bodies_kinetic_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "kinetic energy of all bodies"},
     .run = bodies_kinetic_energy,
     .cost = MOR_PROBE_COST_ENERGIES},
    {.type = {"bodies_elastic_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "strain energy of all bodies"},
     .run = bodies_elastic_energy,
     .cost = MOR_PROBE_COST_ENERGIES},
    {.type = {"bodies_damped_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
              "energy lost to the viscous damping of elastic bodies since the start"},
     .run = bodies_damped_energy},
    {.type = {"bodies_energy_balance", "1", "1", 0, 0, OF_BODIES, 100.0,
              "(total energy + energy lost to viscous damping and contact + energy of what left or was removed) / "
              "initial total energy"},
     .run = bodies_energy_balance,
     .cost = MOR_PROBE_COST_ENERGIES},
    {.type = {"contact_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "energy stored in contacts of bodies"},
     .run = contact_energy},
    {.type = {"contact_friction_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
              "energy lost to sliding in contacts of bodies since the start"},
     .run = contact_friction_energy},
    {.type = {"contact_damping_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
              "energy lost to restitution in contacts of bodies since the start"},
     .run = contact_damping_energy},
    {.type = {"contact_depth", "m", "m", 0, 0, OF_BODIES | STEP | CONTACT, 100.0,
              "largest penetration of a body into a body or a wall"},
     .run = contact_depth,
     .contact = look_at_depth},
    {.type = {"wall_contact_force", "N", "N/m", WALL | DIRECTION, WALL | DIRECTION, OF_BODIES | FORCE | CONTACT, 100.0,
              "force of the bodies on a wall along direction"},
     .run = wall_contact_force,
     .contact = look_at_wall},
    {.type = {"rate_ratio", "1", "1", 0, 0, OF_BOTH | STEP, 100.0,
              "number of sub-steps of the bodies in the last step of the soil"},
     .run = rate_ratio},
    {.type = {"angular_momentum", "kg m2/s", "kg m/s", ORIGIN | DIRECTION, DIRECTION, OF_ROTATION, 100.0,
              "angular momentum of soil and bodies about the axis through origin along direction"},
     .run = angular_momentum,
     .cost = MOR_PROBE_COST_SUM},
    {.run = NULL}};
