/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/rigid/rigid.h"

#include "bodies/body_internal.h"
#include "bodies/rigid/rigid_internal.h"
#include "core/base/memory.h"

#include <string.h>

#define BIT(name) MOR_BIT(MOR_FIELD_##name)
#define BODIES MOR_BIT(MOR_RESOURCE_BODIES)

/* Default share of a spring's period that a step may take, and how far a point of a body may move in a step, in
 * spacings. */
#define COURANT 0.1
#define LONGEST_WAY 0.2

enum { ALL_LOCKED = 0x3f };

static const mor_stage rigid_stages[] = {
    {"first drift", mor_rigid_drift_first, 0, 0, BODIES, "bodies to the middle of the step", NULL},
    {"kick", mor_rigid_kick, 0, 0, BODIES, "momentum and angular momentum to the end of the step", NULL},
    {"second drift", mor_rigid_drift_second, 0, 0, BODIES | BIT(POSITION) | BIT(VELOCITY),
     "bodies to the end of the step; their particles at the end of a common one", NULL},
};

/* Motion at the start. Angular momenta about locked axes mean nothing and are zero. */
static void start_body(mor_rigid *rigid, int b)
{
    const mor_rigid_motion *motion = &rigid->motions[b];
    const mor_rigid_constants *constants = &rigid->work->constants[b];
    mor_body *body = &rigid->group.bodies[b];
    mor_rigid_state *state = &rigid->states[b];
    double spin[3];
    body->is_held = motion->is_prescribed || constants->locked == ALL_LOCKED;
    state->quaternion[0] = 1.0;
    for (int a = 0; a < 3; ++a) {
        const bool is_free = motion->is_prescribed || (constants->locked >> a & 1u) == 0;
        const bool is_turning = motion->is_prescribed || (constants->locked >> (3 + a) & 1u) == 0;
        const double *velocity = motion->is_prescribed ? motion->velocity : body->velocity;
        const double *angular_velocity = motion->is_prescribed ? motion->angular_velocity : body->angular_velocity;
        state->center[a] = body->geometry.center[a];
        state->velocity[a] = is_free ? velocity[a] : 0.0;
        spin[a] = is_turning ? angular_velocity[a] : 0.0;
    }
    mor_rigid_angular_momentum(constants, state->quaternion, spin, state->angular_momentum);
    for (int a = 0; a < 3; ++a) {
        const bool is_turning = motion->is_prescribed || (constants->locked >> (3 + a) & 1u) == 0;
        state->angular_momentum[a] = is_turning ? state->angular_momentum[a] : 0.0;
    }
}

static mor_status check_motion(mor_context *context, const mor_rigid *rigid, int b)
{
    const mor_rigid_motion *motion = &rigid->motions[b];
    const mor_body *body = &rigid->group.bodies[b];
    MOR_CHECK(context, motion->locked < 1u << 6, MOR_ERROR_ARGUMENT,
              "rigid body '%s' locks axes 0x%x; only the six lowest bits are defined", body->name, motion->locked);
    MOR_CHECK(context,
              !motion->has_spring ||
                  (motion->spring_stiffness >= 0.0 && motion->spring_damping >= 0.0 && motion->spring_length >= 0.0),
              MOR_ERROR_ARGUMENT,
              "the spring of rigid body '%s' has stiffness %g N/m, damping %g N s/m and length %g m; none may be "
              "negative",
              body->name, motion->spring_stiffness, motion->spring_damping, motion->spring_length);
    MOR_CHECK(
        context,
        rigid->group.dimension == 3 || !motion->is_prescribed ||
            (motion->velocity[2] == 0.0 && motion->angular_velocity[0] == 0.0 && motion->angular_velocity[1] == 0.0),
        MOR_ERROR_ARGUMENT,
        "rigid body '%s' moves out of the plane: velocity along z %g m/s, angular velocity about x %g and about y %g "
        "rad/s; in plane strain all three must be zero",
        body->name, motion->velocity[2], motion->angular_velocity[0], motion->angular_velocity[1]);
    return MOR_OK;
}

static mor_status start_group(mor_context *context, mor_rigid *rigid, const mor_rigid_motion *motions)
{
    const int n = rigid->group.n_bodies;
    MOR_TRY(context, MOR_NEW(context, &rigid->motions, n, "motions of rigid bodies"));
    MOR_TRY(context, MOR_NEW(context, &rigid->states, n, "states of rigid bodies"));
    MOR_TRY(context, MOR_NEW(context, &rigid->work, 1, "constants of rigid bodies"));
    MOR_TRY(context, MOR_NEW(context, &rigid->work->constants, n, "constants of rigid bodies"));
    memcpy(rigid->motions, motions, (size_t)n * sizeof *motions);
    for (int b = 0; b < n; ++b) {
        mor_status status = check_motion(context, rigid, b);
        if (status == MOR_OK) {
            status = mor_rigid_find_constants(context, rigid, b, &rigid->work->constants[b]);
        }
        if (status != MOR_OK) {
            return mor_context_name_item(context, status, b);
        }
        start_body(rigid, b);
    }
    mor_rigid_prepare(context, rigid);
    return MOR_OK;
}

mor_status mor_rigid_init(mor_context *context, mor_rigid *rigid, const char *name, int dimension, double spacing,
                          const mor_body_request *requests, const mor_rigid_motion *motions, int n_bodies)
{
    static const mor_field_info removed = {"removed", 1, "1", MOR_FIELD_OUTPUT,
                                           "1: its body was removed and is not there any more; else 0"};
    memset(rigid, 0, sizeof *rigid);
    rigid->courant = COURANT;
    mor_status status = mor_body_group_init(context, &rigid->group, name, &mor_rigid_operations, rigid, dimension,
                                            spacing, requests, n_bodies, 0);
    if (status == MOR_OK) {
        status = mor_set_add_field(context, &rigid->group.set, &removed, &rigid->field_removed);
    }
    if (status == MOR_OK) {
        status = start_group(context, rigid, motions);
    }
    if (status != MOR_OK) {
        mor_rigid_clear(context, rigid);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_rigid_clear(mor_context *context, mor_rigid *rigid)
{
    if (rigid->work != NULL) {
        MOR_FREE(context, &rigid->work->constants);
    }
    MOR_FREE(context, &rigid->work);
    MOR_FREE(context, &rigid->motions);
    MOR_FREE(context, &rigid->states);
    mor_body_group_clear(context, &rigid->group);
}

/* Bound of the speed of any point. */
static double find_speed(const mor_rigid *rigid, int b)
{
    const mor_body *body = &rigid->group.bodies[b];
    return mor_vector_length(body->velocity) +
           mor_vector_length(body->angular_velocity) * rigid->work->constants[b].outermost;
}

/* Sets bodies and particles from the states; the velocities that the soil sees are state themselves. */
static void follow_states(mor_context *context, mor_rigid *rigid)
{
    mor_body_group *group = &rigid->group;
    mor_view view = mor_view_open(&group->set, NULL);
    mor_rigid_place(context, rigid, &view);
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        double *record = group->boundary.records + i * MOR_BOUNDARY_RECORD;
        memcpy(record + MOR_BOUNDARY_POSITION, group->set.data[MOR_FIELD_POSITION] + 3 * i, 3 * sizeof *record);
    }
}

/* Soil and contact see by the patches which bodies are there, pictures by the particles. */
static void show_removals(mor_rigid *rigid)
{
    double *shown = rigid->group.set.data[rigid->field_removed];
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        const mor_body *body = &rigid->group.bodies[b];
        bool *is_removed = &rigid->group.boundary.patches[b].is_removed;
        const bool changes = *is_removed != (rigid->states[b].removed > 0.0);
        *is_removed = rigid->states[b].removed > 0.0;
        for (int64_t i = body->first; i < body->first + body->n_particles && changes; ++i) {
            shown[i] = rigid->states[b].removed;
        }
    }
}

void mor_rigid_prepare(mor_context *context, mor_rigid *rigid)
{
    mor_body_group *group = &rigid->group;
    mor_boundary *boundary = &group->boundary;
    follow_states(context, rigid);
    boundary->largest_speed = 0.0;
    for (int b = 0; b < group->n_bodies; ++b) {
        boundary->largest_speed = fmax(boundary->largest_speed, find_speed(rigid, b));
    }
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        double *record = boundary->records + i * MOR_BOUNDARY_RECORD;
        memcpy(record + MOR_BOUNDARY_VELOCITY, group->set.data[MOR_FIELD_VELOCITY] + 3 * i, 3 * sizeof *record);
    }
}

/* What is known of the acceleration of a body's points before the step: gravity and the spring. */
static double find_acceleration(const mor_rigid *rigid, int b, double *spring_rate)
{
    const mor_rigid_motion *motion = &rigid->motions[b];
    const mor_rigid_constants *constants = &rigid->work->constants[b];
    double acceleration = mor_vector_length(rigid->group.gravity);
    *spring_rate = 0.0;
    if (motion->has_spring) {
        double arm[3];
        double direction[3];
        double spin[3];
        double moment[3] = {0.0};
        double flexion = 0.0;
        const double force = motion->spring_stiffness * fabs(mor_rigid_spring(rigid, b, arm, direction, &flexion));
        mor_vector_cross_add(force, arm, direction, moment);
        mor_rigid_angular_velocity(constants, rigid->states[b].quaternion, moment, spin);
        acceleration += force / rigid->group.bodies[b].mass + mor_vector_length(spin) * constants->outermost;
        *spring_rate = sqrt(motion->spring_stiffness * flexion);
    }
    return acceleration;
}

static mor_status propose_step(mor_context *context, void *owner, double *step_length, const char **limit)
{
    const mor_rigid *rigid = owner;
    const mor_body_group *group = &rigid->group;
    const double way = LONGEST_WAY * group->spacing;
    *step_length = INFINITY;
    *limit = "nothing";
    for (int b = 0; b < group->n_bodies; ++b) {
        if (rigid->states[b].removed > 0.0) {
            continue;
        }
        const bool is_held = group->bodies[b].is_held;
        double spring_rate = 0.0;
        const double acceleration = is_held ? 0.0 : find_acceleration(rigid, b, &spring_rate);
        const double speed = find_speed(rigid, b);
        /* speed t + acceleration t2 / 2 = way */
        const double by_way = 2.0 * way / (speed + sqrt(speed * speed + 2.0 * acceleration * way));
        const double by_spring = rigid->courant * 2.0 * MOR_PI / spring_rate;
        if (by_way < *step_length) {
            *step_length = by_way;
            *limit = "displacement per step of a rigid body";
        }
        if (by_spring < *step_length) {
            *step_length = by_spring;
            *limit = "the spring of a rigid body";
        }
    }
    if (group->longest_contact_step != NULL) {
        const double by_contact = group->longest_contact_step(context, group->contact, group);
        /* Written so that a length that is not a number is taken, and reported by the schedule. */
        if (!(by_contact >= *step_length)) {
            *step_length = by_contact;
            *limit = "the contact of a rigid body";
        }
    }
    return MOR_OK;
}

static mor_status begin_step(mor_context *context, void *owner, const mor_step *step)
{
    mor_body_group_begin(context, &((mor_rigid *)owner)->group, step->length);
    return MOR_OK;
}

static mor_status finish_step(mor_context *context, void *owner, const mor_step *step)
{
    mor_rigid *rigid = owner;
    const double end = step->time + step->length;
    mor_body_group_finish(context, &rigid->group, step->length);
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        const double removed_at = rigid->motions[b].removed_at;
        if (removed_at > 0.0 && end >= removed_at) {
            rigid->states[b].removed = 1.0; /* for good, also in a run that starts from this one */
        }
    }
    show_removals(rigid);
    return MOR_OK;
}

static mor_status list_state(mor_context *context, void *owner, mor_state_list *list)
{
    mor_rigid *rigid = owner;
    mor_rigid_state *first = rigid->states;
    const struct {
        const char *member;
        double *numbers;
        int n;
    } members[] = {{"center", first->center, 3},
                   {"velocity", first->velocity, 3},
                   {"quaternion", first->quaternion, 4},
                   {"angular_momentum", first->angular_momentum, 3},
                   {"rotation_angle", first->rotation_angle, 3},
                   {"soil_impulse", first->soil_impulse, 3},
                   {"contact_impulse", first->contact_impulse, 3},
                   {"contact_angular_impulse", first->contact_angular_impulse, 3},
                   {"contact_work", &first->contact_work, 1},
                   {"removed", &first->removed, 1}};
    MOR_TRY(context, mor_body_group_list_state(context, &rigid->group, list));
    for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
        MOR_TRY(context, mor_state_add_member(context, list, rigid->group.set.name, members[k].member,
                                              rigid->group.n_bodies, members[k].n, sizeof *first, members[k].numbers));
    }
    return MOR_OK;
}

static mor_status resume(mor_context *context, void *owner)
{
    follow_states(context, owner);
    show_removals(owner);
    return MOR_OK;
}

static void visit_shared(void *owner, mor_shared_visit visit, void *job)
{
    mor_rigid *rigid = owner;
    mor_body_group_visit_shared(&rigid->group, visit, job);
    for (int b = 0; b < rigid->group.n_bodies; ++b) {
        mor_rigid_state *state = &rigid->states[b];
        mor_rigid_constants *constants = &rigid->work->constants[b];
        const struct {
            int resource;
            double *numbers;
            int n;
        } members[] = {
            {MOR_RESOURCE_BODIES, state->center, 3},          {MOR_RESOURCE_BODIES, state->velocity, 3},
            {MOR_RESOURCE_BODIES, state->quaternion, 4},      {MOR_RESOURCE_BODIES, state->angular_momentum, 3},
            {MOR_RESOURCE_BODIES, state->rotation_angle, 3},  {MOR_RESOURCE_BODIES, state->soil_impulse, 3},
            {MOR_RESOURCE_BODIES, state->contact_impulse, 3}, {MOR_RESOURCE_BODIES, state->contact_angular_impulse, 3},
            {MOR_RESOURCE_BODIES, &state->contact_work, 1},   {MOR_RESOURCE_BODIES, &state->removed, 1},
            {MOR_RESOURCE_BODIES, constants->held_force, 3},  {MOR_RESOURCE_BODIES, constants->held_moment, 3},
            {MOR_RESOURCE_REFERENCE, constants->inertia, 6},  {MOR_RESOURCE_REFERENCE, &constants->common, 1},
            {MOR_RESOURCE_REFERENCE, constants->rates, 2}};
        for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
            visit(job, members[k].resource, members[k].numbers, members[k].n);
        }
    }
}

void mor_rigid_stepper(mor_rigid *rigid, mor_stepper *stepper, uint64_t *evolving)
{
    static const mor_stepper_operations operations = {"rigid bodies", propose_step, begin_step,
                                                      finish_step,    list_state,   resume};
    *stepper = (mor_stepper){.name = rigid->group.set.name,
                             .operations = &operations,
                             .owner = rigid,
                             .stages = rigid_stages,
                             .n_stages = sizeof rigid_stages / sizeof *rigid_stages,
                             .n_before = 1,
                             .n_particles = rigid->group.set.n_particles,
                             .is_leader = false,
                             .set = &rigid->group.set,
                             .visit_shared = visit_shared};
    *evolving = MOR_BODY_EVOLVING;
}

double mor_rigid_energy(const mor_rigid *rigid, int body, double *momentum, double *angular_momentum)
{
    const mor_rigid_state *state = &rigid->states[body];
    const mor_body *b = &rigid->group.bodies[body];
    const mor_rigid_constants *constants = &rigid->work->constants[body];
    if (constants->n_rotation_axes == 3) {
        memcpy(angular_momentum, state->angular_momentum, 3 * sizeof *angular_momentum);
    } else {
        mor_rigid_angular_momentum(constants, state->quaternion, b->angular_velocity, angular_momentum);
    }
    const double rotational = 0.5 * mor_vector_dot(b->angular_velocity, angular_momentum);
    for (int a = 0; a < 3; ++a) {
        momentum[a] = b->mass * state->velocity[a];
    }
    mor_vector_cross_add(1.0, state->center, momentum, angular_momentum);
    return 0.5 * mor_vector_dot(momentum, state->velocity) + rotational;
}

/* ---- A kind of body ---------------------------------------------------------------------------------------------- */

static void rigid_destroy(mor_context *context, mor_body_group *group)
{
    mor_rigid *rigid = group->owner;
    mor_rigid_clear(context, rigid);
    MOR_FREE(context, &rigid);
}

static void rigid_make_stepper(mor_body_group *group, mor_stepper *stepper, uint64_t *evolving)
{
    mor_rigid_stepper(group->owner, stepper, evolving);
}

/* A body on a path has the velocity of its beginning. */
static void start_path(mor_rigid *rigid, int body)
{
    double momentum[3];
    double angular_momentum[3];
    mor_rigid_follow_path(rigid, body, 0.0);
    mor_body *own = &rigid->group.bodies[body];
    mor_rigid_angular_velocity(&rigid->work->constants[body], rigid->states[body].quaternion,
                               rigid->states[body].angular_momentum, own->angular_velocity);
    rigid->work->constants[body].start_energy = mor_rigid_energy(rigid, body, momentum, angular_momentum);
}

static int64_t rigid_start(mor_body_group *group, int body, const mor_body_start *start)
{
    mor_rigid *rigid = group->owner;
    mor_rigid_state *state = &rigid->states[body];
    mor_rigid_motion *motion = &rigid->motions[body];
    const mor_body *own = &group->bodies[body];
    double relative[3];
    double momentum[3];
    double rotated[3];
    motion->is_prescribed = start->is_prescribed || start->is_held;
    motion->path = start->is_resting ? NULL : start->path;
    motion->removed_at = start->is_resting ? 0.0 : start->removed_at;
    state->contact_work = 0.0;
    state->removed = 0.0;
    for (int a = 0; a < 3; ++a) {
        state->velocity[a] = start->is_resting ? 0.0 : start->velocity[a];
        motion->velocity[a] = state->velocity[a];
        motion->angular_velocity[a] = start->is_resting ? 0.0 : start->angular_velocity[a];
    }
    mor_matrix_apply_transposed(own->rotation, motion->angular_velocity, relative);
    mor_symmetric_apply(own->geometry.inertia, relative, momentum);
    mor_matrix_apply(own->rotation, momentum, rotated);
    for (int a = 0; a < 3; ++a) {
        state->angular_momentum[a] = own->density * rotated[a];
        state->rotation_angle[a] = 0.0;
        state->soil_impulse[a] = 0.0;
        state->contact_impulse[a] = 0.0;
        state->contact_angular_impulse[a] = 0.0;
    }
    if (motion->path != NULL) {
        start_path(rigid, body);
    }
    return 0;
}

static mor_status rigid_prepare(mor_context *context, mor_body_group *group)
{
    mor_rigid_prepare(context, group->owner);
    return MOR_OK;
}

static double rigid_momentum(const mor_body_group *group, int body, double *momentum, double *angular_momentum)
{
    return mor_rigid_energy(group->owner, body, momentum, angular_momentum);
}

static double rigid_spring_energy(const mor_body_group *group, int body)
{
    const mor_rigid *rigid = group->owner;
    const mor_rigid_motion *motion = &rigid->motions[body];
    const mor_body *it = &group->bodies[body];
    double arm[3];
    double rotated[3];
    double offset[3];
    if (!motion->has_spring) {
        return 0.0;
    }
    for (int a = 0; a < 3; ++a) {
        arm[a] = motion->spring_point[a] - it->geometry.center[a];
    }
    mor_matrix_apply(it->rotation, arm, rotated);
    for (int a = 0; a < 3; ++a) {
        offset[a] = it->center[a] + rotated[a] - motion->spring_anchor[a];
    }
    const double stretch = mor_vector_length(offset) - motion->spring_length;
    return 0.5 * motion->spring_stiffness * stretch * stretch;
}

static double rigid_driven_energy(const mor_body_group *group, int body, double time)
{
    const mor_rigid *rigid = group->owner;
    const mor_rigid_state *state = &rigid->states[body];
    const mor_body *own = &group->bodies[body];
    if (own->is_absent) {
        return 0.0;
    }
    if (rigid->motions[body].path != NULL || state->removed > 0.0) {
        double momentum[3];
        double angular_momentum[3];
        const bool has_path = rigid->motions[body].path != NULL;
        double energy = state->contact_work;
        for (int a = 0; a < 3; ++a) {
            energy += own->mass * group->gravity[a] * (state->center[a] - own->geometry.center[a]);
        }
        return energy - (has_path ? mor_rigid_energy(rigid, body, momentum, angular_momentum) -
                                        rigid->work->constants[body].start_energy
                                  : 0.0);
    }
    return mor_vector_dot(state->velocity, state->contact_impulse) +
           mor_vector_dot(own->angular_velocity, state->contact_angular_impulse) +
           own->mass * time * mor_vector_dot(group->gravity, state->velocity);
}

const mor_body_operations mor_rigid_operations = {.kind = "rigid bodies",
                                                  .destroy = rigid_destroy,
                                                  .make_stepper = rigid_make_stepper,
                                                  .start = rigid_start,
                                                  .prepare = rigid_prepare,
                                                  .momentum = rigid_momentum,
                                                  .spring_energy = rigid_spring_energy,
                                                  .driven_energy = rigid_driven_energy};
