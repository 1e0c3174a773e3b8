/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A sub-step of rigid bodies: half a drift, the exchange with what they touch, the kick, half a drift. */
#include "bodies/body_internal.h"
#include "bodies/rigid/rigid_internal.h"

#include "core/base/parallel.h"

#include <string.h>

static bool is_in_domain(const mor_body_group *group, const double *x)
{
    double local[3];
    mor_domain_localize(group->placement, x, local);
    return mor_domain_holds(group->domain_minimum, group->domain_maximum, group->dimension, local);
}

/* Whether the ball around a body lies in the domain, so that no particle has to be checked. */
static bool is_well_inside(const mor_body_group *group, const mor_body *body, double radius)
{
    double local[3];
    bool is_inside = isfinite(body->rotation[0]); /* a rotation that is no number has no entry that is one */
    mor_domain_localize(group->placement, body->center, local);
    for (int a = 0; a < group->dimension; ++a) {
        is_inside =
            is_inside && local[a] - radius > group->domain_minimum[a] && local[a] + radius < group->domain_maximum[a];
    }
    return is_inside;
}

/* First particle of a piece outside the domain, or -1. */
static int64_t find_stray(const mor_body_group *group, const mor_body_piece *piece, const double *position)
{
    for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
        if (!is_in_domain(group, position + 3 * i)) {
            return i;
        }
    }
    return -1;
}

/* Particles of a piece follow their body. */
static void place_piece(const mor_body_group *group, const mor_body_piece *piece, double *restrict position,
                        double *restrict velocity)
{
    const mor_body *body = &group->bodies[piece->body];
    for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
        double *x = position + 3 * i;
        double *v = velocity + 3 * i;
        double arm[3];
        double rotated[3];
        for (int a = 0; a < 3; ++a) {
            arm[a] = group->reference[3 * i + a] - body->geometry.center[a];
        }
        mor_matrix_apply(body->rotation, arm, rotated);
        for (int a = 0; a < 3; ++a) {
            x[a] = body->center[a] + rotated[a];
            v[a] = body->velocity[a];
        }
        mor_vector_cross_add(1.0, body->angular_velocity, rotated, v);
    }
}

/* Sets center, velocity and rotation of the bodies from their states. */
static void place_bodies(mor_rigid *rigid)
{
    mor_body_group *group = &rigid->group;
    for (int b = 0; b < group->n_bodies; ++b) {
        const mor_rigid_state *state = &rigid->states[b];
        const mor_rigid_motion *motion = &rigid->motions[b];
        mor_body *body = &group->bodies[b];
        memcpy(body->center, state->center, sizeof body->center);
        memcpy(body->velocity, state->velocity, sizeof body->velocity);
        memcpy(body->rotation_angle, state->rotation_angle, sizeof body->rotation_angle);
        memcpy(body->soil_impulse, state->soil_impulse, sizeof body->soil_impulse);
        memcpy(body->contact_impulse, state->contact_impulse, sizeof body->contact_impulse);
        mor_rigid_matrix(state->quaternion, body->rotation);
        if (motion->is_prescribed && motion->path == NULL) {
            memcpy(body->angular_velocity, motion->angular_velocity, sizeof body->angular_velocity);
        } else {
            mor_rigid_angular_velocity(&rigid->work->constants[b], state->quaternion, state->angular_momentum,
                                       body->angular_velocity);
        }
    }
}

void mor_rigid_place(mor_context *context, mor_rigid *rigid, mor_view *view)
{
    const mor_body_group *group = &rigid->group;
    double *position = mor_view_write(view, MOR_FIELD_POSITION);
    double *velocity = mor_view_write(view, MOR_FIELD_VELOCITY);
    place_bodies(rigid);
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        const mor_body_piece *piece = &group->pieces[p];
        const double radius = rigid->work->constants[piece->body].outermost;
        const bool is_removed = rigid->states[piece->body].removed > 0.0;
        place_piece(group, piece, position, velocity);
        group->piece_stray[p] = is_removed || is_well_inside(group, &group->bodies[piece->body], radius)
                                    ? -1
                                    : find_stray(group, piece, position);
    }
}

void mor_rigid_follow_path(mor_rigid *rigid, int body, double time)
{
    const mor_motion *path = rigid->motions[body].path;
    mor_rigid_state *state = &rigid->states[body];
    mor_pose pose;
    mor_motion_find(path, time, &pose);
    mor_pose_place(&pose, rigid->group.bodies[body].geometry.center, state->center);
    mor_pose_velocity(&pose, state->center, state->velocity);
    for (int a = 0; a < 3; ++a) {
        state->rotation_angle[a] = pose.angle * path->axis[a];
    }
    mor_rigid_quaternion(state->rotation_angle, state->quaternion);
    mor_rigid_angular_momentum(&rigid->work->constants[body], state->quaternion, pose.angular_velocity,
                               state->angular_momentum);
}

/* Motion as prescribed is a function of time alone. */
static void prescribe(mor_rigid *rigid, int body, double time)
{
    const mor_rigid_motion *motion = &rigid->motions[body];
    const double *start = rigid->group.bodies[body].geometry.center;
    mor_rigid_state *state = &rigid->states[body];
    if (motion->path != NULL) {
        mor_rigid_follow_path(rigid, body, time);
        return;
    }
    for (int a = 0; a < 3; ++a) {
        state->center[a] = start[a] + time * motion->velocity[a];
        state->velocity[a] = motion->velocity[a];
        state->rotation_angle[a] = time * motion->angular_velocity[a];
    }
    mor_rigid_quaternion(state->rotation_angle, state->quaternion);
    mor_rigid_angular_momentum(&rigid->work->constants[body], state->quaternion, motion->angular_velocity,
                               state->angular_momentum);
}

/* Half a drift of a sub-step that ends at a time. */
static void drift_half(mor_rigid *rigid, double half_step, double time)
{
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        mor_rigid_state *state = &rigid->states[b];
        if (state->removed > 0.0) {
            continue;
        }
        if (rigid->motions[b].is_prescribed) {
            prescribe(rigid, b, time);
            continue;
        }
        for (int a = 0; a < 3; ++a) {
            state->center[a] += half_step * state->velocity[a];
        }
        mor_rigid_rotate(&rigid->work->constants[b], half_step, state);
    }
}

mor_status mor_rigid_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_rigid *rigid = mor_view_write_shared(view, MOR_RESOURCE_BODIES, owner);
    (void)context;
    drift_half(rigid, 0.5 * step->length, step->time + 0.5 * step->length);
    place_bodies(rigid);
    return MOR_OK;
}

static mor_status report_stray(mor_context *context, const mor_rigid *rigid, const mor_view *view, int64_t particle,
                               const mor_step *step)
{
    const mor_body_group *group = &rigid->group;
    const double *x = mor_view_quote(view, MOR_FIELD_POSITION, particle);
    const mor_body *body = &group->bodies[group->body_of[particle]];
    const double time = step->time + step->length;
    MOR_CHECK(context, isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), MOR_ERROR_NUMERIC,
              "rigid body '%s' of group '%s' has a motion that is not a number: center (%.6g, %.6g, %.6g) m, velocity "
              "(%.4g, %.4g, %.4g) m/s, angular velocity (%.4g, %.4g, %.4g) rad/s at t = %.6g s, step %llu. Look at "
              "the forces on it in the last snapshot; in soil a smaller 'courant' may help, else a smaller "
              "'contact_modulus'",
              body->name, group->set.name, body->center[0], body->center[1], body->center[2], body->velocity[0],
              body->velocity[1], body->velocity[2], body->angular_velocity[0], body->angular_velocity[1],
              body->angular_velocity[2], time, (unsigned long long)step->number);
    /* Steps are so short that no body moves by more than a part of the spacing, unless its velocity jumps in one. */
    const double way = mor_vector_length(body->velocity) * step->length;
    MOR_CHECK(
        context, way <= group->spacing, MOR_ERROR_NUMERIC,
        "rigid body '%s' of group '%s' was thrown out of the domain, to (%.6g, %.6g, %.6g) m, by %.3g m in one step "
        "of %.3g s at t = %.6g s, step %llu: the forces on it and its mass of %.3g kg (per meter of thickness in "
        "plane strain) do not go together at steps of this length. A larger domain does not help; give it the "
        "density it has in nature, in soil a smaller 'courant', else a smaller 'contact_modulus'",
        body->name, group->set.name, x[0], x[1], x[2], way, step->length, time, (unsigned long long)step->number,
        body->mass);
    double local[3];
    mor_domain_localize(group->placement, x, local);
    const mor_status status =
        MOR_FAIL(context, MOR_ERROR_NUMERIC,
                 "particle %lld of rigid body '%s' of group '%s' left the domain: position (%.6g, %.6g, %.6g) m%s at "
                 "t = %.6g s, step %llu; the domain is (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m. Enlarge "
                 "'domain' or close the walls; only soil can be removed there",
                 (long long)group->set.id[particle], body->name, group->set.name, local[0], local[1], local[2],
                 group->placement != NULL ? " before 'placement'" : "", time, (unsigned long long)step->number,
                 group->domain_minimum[0], group->domain_minimum[1], group->domain_minimum[2], group->domain_maximum[0],
                 group->domain_maximum[1], group->domain_maximum[2]);
    return mor_context_name_particle(context, status, group->set.name, group->set.id[particle]);
}

mor_status mor_rigid_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_rigid *rigid = mor_view_write_shared(view, MOR_RESOURCE_BODIES, owner);
    const mor_body_group *group = &rigid->group;
    drift_half(rigid, 0.5 * step->length, step->time + step->length);
    if (step->part + 1 < step->n_parts) {
        place_bodies(rigid); /* particles are not read before the end of the common step */
        return MOR_OK;
    }
    mor_rigid_place(context, rigid, view);
    for (int64_t p = 0; p < group->n_pieces; ++p) {
        if (group->piece_stray[p] >= 0) {
            return report_stray(context, rigid, view, group->piece_stray[p], step);
        }
    }
    return MOR_OK;
}

/* Force and moment of the soil on all bodies. Arms end where the soil saw the points, so that the angular momentum it
 * lost is what the body gets, however many sub-steps the force is held over. */
static void hold_soil_forces(mor_rigid *rigid)
{
    const mor_boundary *boundary = &rigid->group.boundary;
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        const mor_body *body = &rigid->group.bodies[b];
        mor_rigid_constants *held = &rigid->work->constants[b];
        memset(held->held_force, 0, sizeof held->held_force);
        memset(held->held_moment, 0, sizeof held->held_moment);
        for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
            const double *force = boundary->force + 3 * i;
            const double *place = boundary->records + i * MOR_BOUNDARY_RECORD + MOR_BOUNDARY_POSITION;
            for (int a = 0; a < 3; ++a) {
                held->held_force[a] += force[a];
            }
            mor_vector_cross_add(1.0, place, force, held->held_moment);
        }
    }
}

double mor_rigid_spring(const mor_rigid *rigid, int body, double *arm, double *direction, double *flexion)
{
    const mor_rigid_motion *motion = &rigid->motions[body];
    const mor_rigid_constants *constants = &rigid->work->constants[body];
    const mor_body *b = &rigid->group.bodies[body];
    double reference[3];
    double moment[3] = {0.0};
    double spin[3];
    double swing[3] = {0.0};
    for (int a = 0; a < 3; ++a) {
        reference[a] = motion->spring_point[a] - b->geometry.center[a];
    }
    mor_matrix_apply(b->rotation, reference, arm);
    for (int a = 0; a < 3; ++a) {
        direction[a] = b->center[a] + arm[a] - motion->spring_anchor[a];
    }
    const double length = mor_vector_length(direction);
    for (int a = 0; a < 3 && length > 0.0; ++a) {
        direction[a] /= length;
    }
    mor_vector_cross_add(1.0, arm, direction, moment);
    mor_rigid_angular_velocity(constants, rigid->states[body].quaternion, moment, spin);
    mor_vector_cross_add(1.0, spin, arm, swing);
    *flexion = mor_vector_dot(swing, direction);
    for (int a = 0; a < 3; ++a) {
        *flexion += (constants->locked >> a & 1u) != 0 ? 0.0 : direction[a] * direction[a] / b->mass;
    }
    return length - motion->spring_length;
}

/* Takes out what locked axes do not let through. */
static void apply_locks(const mor_rigid_constants *constants, mor_rigid_state *state)
{
    for (int a = 0; a < 3; ++a) {
        state->velocity[a] = (constants->locked >> a & 1u) != 0 ? 0.0 : state->velocity[a];
        state->angular_momentum[a] = (constants->locked >> (3 + a) & 1u) != 0 ? 0.0 : state->angular_momentum[a];
    }
}

static double find_point_speed(const mor_rigid_constants *constants, const mor_rigid_state *state, const double *arm,
                               const double *direction)
{
    double velocity[3] = {state->velocity[0], state->velocity[1], state->velocity[2]};
    double spin[3];
    mor_rigid_angular_velocity(constants, state->quaternion, state->angular_momentum, spin);
    mor_vector_cross_add(1.0, spin, arm, velocity);
    return mor_vector_dot(velocity, direction);
}

/* Impulse along a direction at the end of an arm. */
static void apply_impulse(const mor_rigid_constants *constants, const mor_body *body, const double *arm,
                          const double *direction, double impulse, mor_rigid_state *state)
{
    for (int a = 0; a < 3; ++a) {
        state->velocity[a] += impulse * direction[a] / body->mass;
    }
    mor_vector_cross_add(impulse, arm, direction, state->angular_momentum);
    apply_locks(constants, state);
}

/* The damper acts on the mean of the velocities before and after the kick: it never overshoots. */
static void apply_spring(mor_rigid *rigid, int b, double length, const mor_rigid_state *before)
{
    const mor_rigid_motion *motion = &rigid->motions[b];
    const mor_rigid_constants *constants = &rigid->work->constants[b];
    const mor_body *body = &rigid->group.bodies[b];
    mor_rigid_state *state = &rigid->states[b];
    double arm[3];
    double direction[3];
    double flexion = 0.0;
    const double stretch = mor_rigid_spring(rigid, b, arm, direction, &flexion);
    apply_impulse(constants, body, arm, direction, -length * motion->spring_stiffness * stretch, state);
    const double part = 0.5 * length * motion->spring_damping;
    const double speed =
        find_point_speed(constants, before, arm, direction) + find_point_speed(constants, state, arm, direction);
    apply_impulse(constants, body, arm, direction, -part * speed / (1.0 + part * flexion), state);
}

/* Local damping acts on what all forces together, springs and locks included, change in the motion of a body. */
static void damp_change(const mor_rigid_constants *constants, double share, const mor_rigid_state *before,
                        mor_rigid_state *state)
{
    double velocity[3];
    double momentum[3];
    for (int a = 0; a < 3; ++a) {
        velocity[a] = state->velocity[a] - before->velocity[a];
        momentum[a] = state->angular_momentum[a] - before->angular_momentum[a];
    }
    mor_damp_locally(share, before->velocity, velocity);
    mor_damp_locally(share, before->angular_momentum, momentum);
    for (int a = 0; a < 3; ++a) {
        state->velocity[a] = before->velocity[a] + velocity[a];
        state->angular_momentum[a] = before->angular_momentum[a] + momentum[a];
    }
    apply_locks(constants, state);
}

static void kick_body(mor_rigid *rigid, int b, const mor_step *step)
{
    const mor_body_group *group = &rigid->group;
    const mor_rigid_constants *constants = &rigid->work->constants[b];
    mor_body *body = &rigid->group.bodies[b];
    mor_rigid_state *state = &rigid->states[b];
    const double h = step->length;
    const double middle = step->time + 0.5 * h;
    const double ramp = mor_ramp(middle, group->gravity_ramp, group->has_smooth_ramp);
    double moment[3];
    if (state->removed > 0.0) {
        return;
    }
    state->contact_work += h * (mor_vector_dot(body->contact_force, body->velocity) +
                                mor_vector_dot(body->contact_moment, body->angular_velocity));
    for (int a = 0; a < 3; ++a) {
        state->soil_impulse[a] += h * constants->held_force[a];
        state->contact_impulse[a] += h * body->contact_force[a];
        state->contact_angular_impulse[a] += h * body->contact_moment[a];
        moment[a] = constants->held_moment[a] + body->contact_moment[a];
    }
    if (body->is_held) {
        return;
    }
    mor_vector_cross_add(-1.0, body->center, constants->held_force, moment);
    const mor_rigid_state before = *state;
    const bool is_damped = mor_is_damped(step->time, group->damping_time);
    const double damping = is_damped ? 0.5 * h * group->damping : 0.0;
    for (int a = 0; a < 3; ++a) {
        const double acceleration =
            (constants->held_force[a] + body->contact_force[a]) / body->mass + ramp * group->gravity[a];
        state->velocity[a] = ((1.0 - damping) * state->velocity[a] + h * acceleration) / (1.0 + damping);
        state->angular_momentum[a] = ((1.0 - damping) * state->angular_momentum[a] + h * moment[a]) / (1.0 + damping);
    }
    apply_locks(constants, state);
    if (rigid->motions[b].has_spring) {
        apply_spring(rigid, b, h, &before);
    }
    if (is_damped && group->local_damping > 0.0) {
        damp_change(constants, group->local_damping, &before, state);
    }
}

mor_status mor_rigid_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_rigid *rigid = mor_view_write_shared(view, MOR_RESOURCE_BODIES, owner);
    (void)context;
    if (step->part == 0 && !rigid->group.is_unseen) {
        hold_soil_forces(rigid);
    }
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        kick_body(rigid, b, step);
    }
    return MOR_OK;
}
