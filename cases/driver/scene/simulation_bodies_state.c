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

static double spring_energy(const mor_rigid *rigid, int body)
{
    const mor_rigid_motion *motion = &rigid->motions[body];
    const mor_body *it = &rigid->group.bodies[body];
    double arm[3];
    double turned[3];
    double offset[3];
    if (!motion->has_spring) {
        return 0.0;
    }
    for (int a = 0; a < 3; ++a) {
        arm[a] = motion->spring_point[a] - it->geometry.center[a];
    }
    mor_matrix_apply(it->rotation, arm, turned);
    for (int a = 0; a < 3; ++a) {
        offset[a] = it->center[a] + turned[a] - motion->spring_anchor[a];
    }
    const double stretch = mor_vector_length(offset) - motion->spring_length;
    return 0.5 * motion->spring_stiffness * stretch * stretch;
}

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

double mor_simulation_bodies_lost(const mor_simulation_bodies *bodies)
{
    double lost = bodies->contact.friction_energy + bodies->contact.damping_energy;
    for (int g = 0; g < bodies->n_elastics; ++g) {
        lost += bodies->elastics[g].damped_energy;
    }
    return lost;
}

void mor_simulation_bodies_energy(const mor_simulation_bodies *bodies, const double *datum, double *kinetic,
                                  double *potential, double *elastic)
{
    *kinetic = 0.0;
    *potential = 0.0;
    *elastic = bodies->has_contact ? bodies->contact.spring_energy : 0.0;
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        const bool is_elastic = g < bodies->n_elastics;
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            double momentum[3];
            double angular[3];
            *kinetic += is_elastic ? mor_body_group_momentum(group, b, momentum, angular)
                                   : mor_rigid_energy(&bodies->rigid, b, momentum, angular);
            for (int a = 0; a < 3; ++a) {
                *potential -= body->mass * group->gravity[a] * (body->center[a] - datum[a]);
            }
            *potential += is_elastic ? 0.0 : spring_energy(&bodies->rigid, b);
        }
        *elastic += is_elastic ? mor_elastic_energy(&bodies->elastics[g], -1) : 0.0;
    }
}

void mor_simulation_bodies_momentum(const mor_simulation_bodies *bodies, const double *point, double *momentum,
                                    double *angular_momentum)
{
    memset(momentum, 0, 3 * sizeof *momentum);
    memset(angular_momentum, 0, 3 * sizeof *angular_momentum);
    for (int g = 0; g < bodies->n_groups; ++g) {
        for (int b = 0; b < bodies->groups[g]->n_bodies; ++b) {
            double p[3];
            double l[3];
            if (g < bodies->n_elastics) {
                mor_body_group_momentum(bodies->groups[g], b, p, l);
            } else {
                mor_rigid_energy(&bodies->rigid, b, p, l);
            }
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

/* Velocity beyond that of a rigid motion, at a reference position. */
static void add_motion(const mor_case *c, const mor_case_body *it, const double *reference, double *velocity)
{
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

/* Velocities of an elastic body: at rest (held or not), or those of its start. Returns the particles in its clamp. */
static int64_t set_elastic(const mor_case *c, const mor_case_body *it, const mor_simulation_body *body, bool is_resting,
                           bool is_held)
{
    int64_t n_clamped = 0;
    mor_body_group *group = body->group;
    const mor_body *own = &group->bodies[body->index];
    double velocity[3];
    double spin[3];
    mor_matrix_apply(c->rotation, it->velocity, velocity);
    mor_matrix_apply(c->rotation, it->angular_velocity, spin);
    for (int64_t i = own->first; i < own->first + own->n_particles; ++i) {
        const double *reference = group->reference + 3 * i;
        double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        double scene[3];
        double arm[3];
        for (int a = 0; a < 3; ++a) {
            arm[a] = group->set.data[MOR_FIELD_POSITION][3 * i + a] - own->center[a];
        }
        mor_simulation_take_point_back(c, reference, scene);
        const bool is_clamped = it->clamp != NULL && it->clamp->operations->distance(it->clamp, scene) < 0.0;
        n_clamped += is_clamped;
        body->elastic->held[i] = is_clamped || is_held;
        memcpy(v, velocity, sizeof velocity);
        mor_vector_cross_add(1.0, spin, arm, v);
        if (it->motion != MOR_CASE_MOTION_UNIFORM) {
            add_motion(c, it, reference, v);
        }
        if (is_resting || is_clamped) {
            memset(v, 0, 3 * sizeof *v);
        }
    }
    return n_clamped;
}

static void set_rigid(const mor_case *c, const mor_case_body *it, const mor_simulation_body *body, bool is_resting,
                      bool is_held)
{
    mor_rigid_state *state = &body->rigid->states[body->index];
    mor_rigid_motion *motion = &body->rigid->motions[body->index];
    const mor_body *own = &body->group->bodies[body->index];
    double spin[3];
    double relative[3];
    double momentum[3];
    double turned[3];
    mor_matrix_apply(c->rotation, it->velocity, state->velocity);
    mor_matrix_apply(c->rotation, it->angular_velocity, spin);
    motion->is_prescribed = it->is_prescribed || is_held;
    body->group->boundary.patches[body->index].is_driven = it->is_prescribed;
    if (is_resting) {
        memset(state->velocity, 0, sizeof state->velocity);
        memset(spin, 0, sizeof spin);
    }
    memcpy(motion->velocity, state->velocity, sizeof state->velocity);
    memcpy(motion->angular_velocity, spin, sizeof spin);
    mor_matrix_apply_transposed(own->rotation, spin, relative);
    mor_symmetric_apply(own->geometry.inertia, relative, momentum);
    mor_matrix_apply(own->rotation, momentum, turned);
    for (int a = 0; a < 3; ++a) {
        state->angular_momentum[a] = own->density * turned[a];
        state->rotation_angle[a] = 0.0;
        state->soil_impulse[a] = 0.0;
        state->contact_impulse[a] = 0.0;
        state->contact_angular_impulse[a] = 0.0;
    }
}

/* At the start the mean velocity over the last step is the velocity itself. */
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

mor_status mor_simulation_bodies_settle(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                        double damping)
{
    const bool is_resting = damping > 0.0;
    for (int b = 0; b < the_case->n_bodies; ++b) {
        const mor_case_body *it = &the_case->bodies[b];
        const mor_simulation_body *body = &bodies->of[b];
        mor_body *own = &body->group->bodies[body->index];
        /* What is thrown at the soil waits until the soil has settled. */
        const bool is_held = is_resting && (mor_vector_length(it->velocity) > 0.0 || it->motion_speed > 0.0 ||
                                            mor_vector_length(it->angular_velocity) > 0.0);
        if (body->elastic != NULL) {
            const int64_t n_clamped = set_elastic(the_case, it, body, is_resting, is_held);
            MOR_CHECK(context, it->clamp == NULL || n_clamped > 0, MOR_ERROR_CONFIG,
                      "%s:%d: found a clamp of body '%s' that holds none of its %lld particles; allowed are clamps "
                      "around at least one; move the clamp, which is placed in the case and not in the frame of the "
                      "body, or remove it",
                      it->place.file, it->place.line, it->name, (long long)own->n_particles);
        } else {
            set_rigid(the_case, it, body, is_resting, is_held);
        }
        /* A rock that waits counts as infinitely heavy in contact, as one that moves as prescribed. */
        own->is_held = is_held || it->is_prescribed || is_locked_wholly(the_case, it);
        memset(own->rotation_angle, 0, sizeof own->rotation_angle);
        memset(own->soil_impulse, 0, sizeof own->soil_impulse);
        memset(own->contact_impulse, 0, sizeof own->contact_impulse);
        memset(body->group->boundary.patches[body->index].impulse, 0, 3 * sizeof(double));
    }
    for (int g = 0; g < bodies->n_groups; ++g) {
        bodies->groups[g]->damping = is_resting ? damping : the_case->numerics.damping;
        bodies->groups[g]->gravity_ramp = is_resting ? 0.0 : the_case->numerics.gravity_ramp; /* as the soil's */
        if (g < bodies->n_elastics) {
            bodies->elastics[g].damped_energy = 0.0;
            MOR_TRY(context, mor_elastic_prepare(context, &bodies->elastics[g]));
        } else {
            mor_rigid_prepare(context, &bodies->rigid);
        }
        show_velocities(bodies->groups[g]);
    }
    if (bodies->has_contact) {
        mor_contact_restart(&bodies->contact); /* springs of rocks at rest stay */
    }
    return MOR_OK;
}
