/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Energy of the rocks of a simulation, and their motion at the start. */
#include "cases/driver/scene/simulation_bodies.h"

#include "bodies/body_surface.h"
#include "cases/driver/scene/simulation.h"
#include "core/base/math.h"

#include <string.h>

/* kL of the first bending mode of a cantilever: cos kL cosh kL = -1. */
#define CANTILEVER_MODE 1.8751040687119611

/* ---- Energy and momentum ----------------------------------------------------------------------------------------- */

double mor_simulation_bodies_lift(const mor_simulation_bodies *bodies)
{
    double lift = 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            lift += group->bodies[b].mass * mor_vector_length(group->gravity) * group->spacing;
        }
    }
    return lift;
}

static double find_damped(const mor_body_group *group)
{
    return group->operations->damped_energy != NULL ? group->operations->damped_energy(group) : 0.0;
}

double mor_simulation_bodies_damped(const mor_simulation_bodies *bodies)
{
    double damped = 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        damped += find_damped(bodies->groups[g]);
    }
    return damped;
}

double mor_simulation_bodies_lost(const mor_simulation_bodies *bodies)
{
    double lost = bodies->contact.friction_energy + bodies->contact.damping_energy;
    for (int g = 0; g < bodies->n_groups; ++g) {
        lost += find_damped(bodies->groups[g]);
    }
    return lost;
}

bool mor_simulation_body_is_there(const mor_simulation_bodies *bodies, int body)
{
    const mor_simulation_body *it = &bodies->of[body];
    return !it->group->boundary.patches[it->index].is_removed;
}

double mor_simulation_bodies_mass(const mor_simulation_bodies *bodies, bool with_removed)
{
    double mass = 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            const bool is_removed = group->boundary.patches[b].is_removed;
            const bool counts = !is_removed || (with_removed && !group->bodies[b].is_absent);
            mass += counts ? group->bodies[b].mass : 0.0;
        }
    }
    return mass;
}

void mor_simulation_bodies_energy(const mor_simulation_bodies *bodies, const double *datum, double *kinetic,
                                  double *potential, double *elastic)
{
    *kinetic = 0.0;
    *potential = 0.0;
    *elastic = bodies->has_contact ? bodies->contact.spring_energy : 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        const mor_body_operations *operations = group->operations;
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            double momentum[3];
            double angular[3];
            if (group->boundary.patches[b].is_removed) {
                continue;
            }
            *kinetic += operations->momentum(group, b, momentum, angular);
            for (int a = 0; a < 3; ++a) {
                *potential -= body->mass * group->gravity[a] * (body->center[a] - datum[a]);
            }
            *potential += operations->spring_energy != NULL ? operations->spring_energy(group, b) : 0.0;
        }
        *elastic += operations->strain_energy != NULL ? operations->strain_energy(group, -1) : 0.0;
    }
}

double mor_simulation_bodies_removed(const mor_simulation_bodies *bodies, const double *datum)
{
    double energy = 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        const mor_body_operations *operations = group->operations;
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            double momentum[3];
            double angular[3];
            if (!group->boundary.patches[b].is_removed || body->is_absent) {
                continue;
            }
            energy += operations->momentum(group, b, momentum, angular);
            energy += operations->spring_energy != NULL ? operations->spring_energy(group, b) : 0.0;
            for (int a = 0; a < 3; ++a) {
                energy -= body->mass * group->gravity[a] * (body->center[a] - datum[a]);
            }
        }
    }
    return energy;
}

void mor_simulation_bodies_momentum(const mor_simulation_bodies *bodies, const double *point, double *momentum,
                                    double *angular_momentum)
{
    memset(momentum, 0, 3 * sizeof *momentum);
    memset(angular_momentum, 0, 3 * sizeof *angular_momentum);
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            double p[3];
            double l[3];
            if (group->boundary.patches[b].is_removed) {
                continue;
            }
            group->operations->momentum(group, b, p, l);
            mor_vector_cross_add(-1.0, point, p, l);
            for (int a = 0; a < 3; ++a) {
                momentum[a] += p[a];
                angular_momentum[a] += l[a];
            }
        }
    }
}

double mor_simulation_body_depth(const mor_simulation_body *body, const double *up, double level)
{
    const mor_body *it = &body->group->bodies[body->index];
    double lowest = INFINITY;
    for (int64_t s = it->first_node; s < it->first_node + it->n_nodes; ++s) {
        double position[3];
        mor_body_node_place(body->group, body->index, s, position);
        lowest = fmin(lowest, mor_vector_dot(position, up));
    }
    return level - lowest;
}

/* ---- Motion at the start ----------------------------------------------------------------------------------------- */

/* Displacement of the first bending mode at s = x / length, 1 at the free end. */
static double cantilever_shape(double s)
{
    const double k = CANTILEVER_MODE;
    const double m = sin(k) + sinh(k);
    const double n = cos(k) + cosh(k);
    const double q = 2.0 * (cos(k) * sinh(k) - sin(k) * cosh(k));
    return s > 0.0 ? (m * (cos(k * s) - cosh(k * s)) - n * (sin(k * s) - sinh(k * s))) / q : 0.0;
}

/* A body of the case, for functions of the reference position. */
typedef struct start_of_body {
    const mor_case *the_case;
    const mor_case_body *body;
} start_of_body;

/* Velocity beyond that of a rigid motion, at a reference position. */
static void add_motion(const void *user, const double *reference, double *velocity)
{
    const start_of_body *start = user;
    const mor_case *c = start->the_case;
    const mor_case_body *it = start->body;
    double axis[3];
    double direction[3];
    double origin[3];
    double arm[3];
    mor_matrix_apply(c->rotation, it->motion_axis, axis);
    mor_matrix_apply(c->rotation, it->motion_direction, direction);
    mor_matrix_apply(c->rotation, it->motion_origin, origin);
    const double length = mor_vector_length(axis);
    const double across = mor_vector_length(direction);
    for (int a = 0; a < 3; ++a) {
        axis[a] /= length;
        arm[a] = reference[a] - origin[a] - c->translation[a];
    }
    const double along = mor_vector_dot(arm, axis) / it->motion_length;
    if (it->motion != MOR_CASE_MOTION_CANTILEVER) {
        mor_vector_cross_add(it->motion_speed * sin(0.5 * MOR_PI * along), axis, arm, velocity);
        return;
    }
    for (int a = 0; a < 3; ++a) {
        velocity[a] += it->motion_speed * cantilever_shape(along) * direction[a] / across;
    }
}

static bool is_clamped(const void *user, const double *reference)
{
    const start_of_body *start = user;
    double scene[3];
    mor_simulation_take_point_back(start->the_case, reference, scene);
    return start->body->clamp->operations->distance(start->body->clamp, scene) < 0.0;
}

/* At the start the soil sees the velocity itself. */
static void show_velocities(mor_body_group *group)
{
    double fastest = 0.0;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        const double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        memcpy(group->boundary.records + i * MOR_BOUNDARY_RECORD + MOR_BOUNDARY_VELOCITY, v, 3 * sizeof *v);
        fastest = fmax(fastest, mor_vector_length(v));
    }
    group->boundary.largest_speed = fastest;
}

static bool is_locked_wholly(const mor_case *c, const mor_case_body *it)
{
    bool is_locked = true;
    for (int k = 0; k < 6; ++k) {
        const bool is_free_to_move = c->dimension == 3 || k < 2 || k == 5;
        is_locked = is_locked && (it->is_locked[k] || !is_free_to_move);
    }
    return is_locked;
}

/* Starts one body, or holds it while the soil settles. */
static mor_status start_body(mor_context *context, const mor_simulation_bodies *bodies, const mor_case *c, int number,
                             bool is_resting)
{
    const mor_simulation_body *body = &bodies->of[number];
    const mor_case_body *it = &c->bodies[number];
    const mor_motion *path = it->path.n_rows > 0 ? &bodies->motions[number] : NULL;
    const start_of_body user = {c, it};
    mor_body_group *group = body->group;
    mor_body *own = &group->bodies[body->index];
    mor_body_start start = {.is_resting = is_resting,
                            .is_prescribed = it->is_prescribed,
                            .path = path,
                            .removed_at = it->removed_at > 0.0 ? it->removed_at : 0.0,
                            .add_velocity = it->motion != MOR_CASE_MOTION_UNIFORM ? add_motion : NULL,
                            .is_clamped = it->clamp != NULL ? is_clamped : NULL,
                            .user = &user};
    /* Bodies with a velocity are held until the soil has settled. */
    start.is_held = is_resting && (mor_vector_length(it->velocity) > 0.0 || it->motion_speed > 0.0 ||
                                   mor_vector_length(it->angular_velocity) > 0.0 || path != NULL);
    mor_matrix_apply(c->rotation, it->velocity, start.velocity);
    mor_matrix_apply(c->rotation, it->angular_velocity, start.angular_velocity);
    const int64_t n_clamped = group->operations->start(group, body->index, &start);
    MOR_CHECK(context, it->clamp == NULL || n_clamped > 0, MOR_ERROR_CONFIG,
              "%s:%d: found a clamp of body '%s' that holds none of its %lld particles; allowed are clamps "
              "around at least one; move the clamp, which is placed in the case and not in the frame of the "
              "body, or remove it",
              it->place.file, it->place.line, it->name, (long long)own->n_particles);
    /* A rock that is held counts as infinitely heavy in contact, as one that moves as prescribed. */
    own->is_held = start.is_held || it->is_prescribed || is_locked_wholly(c, it);
    group->boundary.patches[body->index].is_driven = it->is_prescribed;
    memset(own->rotation_angle, 0, sizeof own->rotation_angle);
    memset(own->soil_impulse, 0, sizeof own->soil_impulse);
    memset(own->contact_impulse, 0, sizeof own->contact_impulse);
    memset(group->boundary.patches[body->index].impulse, 0, 3 * sizeof(double));
    return MOR_OK;
}

mor_status mor_simulation_bodies_settle(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                        const mor_simulation_settling *settling)
{
    const bool is_resting = settling != NULL;
    const mor_scheme *own = &the_case->numerics;
    for (int b = 0; b < the_case->n_bodies; ++b) {
        MOR_TRY(context, start_body(context, bodies, the_case, b, is_resting));
    }
    for (int g = 0; g < bodies->n_groups; ++g) {
        mor_body_group *group = bodies->groups[g];
        group->damping = is_resting ? settling->damping : own->damping;
        group->local_damping = is_resting ? settling->local_damping : own->local_damping;
        group->damping_time = is_resting ? 0.0 : own->damping_time;
        group->gravity_ramp = is_resting ? settling->gravity_ramp : own->gravity_ramp; /* as the soil's */
        group->has_smooth_ramp = is_resting || own->gravity_ramp_form == 1;
        MOR_TRY(context, group->operations->prepare(context, group));
        show_velocities(group);
    }
    if (bodies->has_contact) {
        mor_contact_restart(&bodies->contact); /* springs of rocks at rest stay */
    }
    return MOR_OK;
}
