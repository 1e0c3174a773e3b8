/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation_balance.h"

#include "core/base/math.h"
#include "core/sph/measure/measure_sum.h"

/* Blocks of the search for the largest one. */
enum { BLOCKS = 64 };

/* The soil in the last step. */
typedef struct soil_job {
    const double *mass, *velocity, *acceleration;
    double length;  /* of the step, s */
    double damping; /* rate, 1/s */
    double local;   /* damped share, 1 */
    double gravity; /* m/s2 */
} soil_job;

static soil_job job_of(const mor_simulation *s)
{
    double *const *data = s->soil.set.data;
    const mor_scheme *scheme = &s->soil.settings.scheme;
    const double length = s->schedule.step_length;
    const bool is_damped = mor_is_damped(mor_schedule_time(&s->schedule) - length, scheme->damping_time);
    return (soil_job){.mass = data[MOR_FIELD_MASS],
                      .velocity = data[MOR_FIELD_VELOCITY],
                      .acceleration = data[MOR_FIELD_ACCELERATION],
                      .length = length,
                      .damping = is_damped ? scheme->damping : 0.0,
                      .local = is_damped ? scheme->local_damping : 0.0,
                      .gravity = mor_vector_length(s->soil.settings.gravity)};
}

/* Net force per mass without damping, which acted on the velocity before the kick, m/s2. */
static double find_net(const soil_job *it, int64_t i)
{
    double net[3];
    double before[3];
    for (int a = 0; a < 3; ++a) {
        net[a] = it->acceleration[3 * i + a];
        before[a] = it->velocity[3 * i + a] - it->length * net[a];
    }
    mor_undamp_locally(it->local, before, net);
    for (int a = 0; a < 3; ++a) {
        net[a] += it->damping * before[a];
    }
    return mor_vector_length(net);
}

static void fill_forces(const void *job, int64_t first, int64_t n, double *terms)
{
    const soil_job *it = job;
    for (int64_t k = 0; k < n; ++k) {
        terms[k] = it->mass[first + k] * find_net(it, first + k);
    }
}

static void fill_momenta(const void *job, int64_t first, int64_t n, double *terms)
{
    const soil_job *it = job;
    for (int64_t k = 0; k < n; ++k) {
        terms[k] = it->mass[first + k] * mor_vector_length(it->velocity + 3 * (first + k));
    }
}

static void fill_masses(const void *job, int64_t first, int64_t n, double *terms)
{
    const soil_job *it = job;
    for (int64_t k = 0; k < n; ++k) {
        terms[k] = it->mass[first + k];
    }
}

static void find_largest(void *job, int64_t first, int64_t last, double *values)
{
    const soil_job *it = job;
    for (int64_t i = first; i < last; ++i) {
        values[0] = mor_larger(values[0], find_net(it, i));
    }
}

static double find_gyration_radius(const mor_body *body)
{
    return sqrt(0.5 * mor_symmetric_trace(body->geometry.inertia) / body->geometry.volume);
}

/* Force and moment of a body per mass, from the change of its motion over the step, m/s2; -1: it takes no part. */
static double find_body_net(const mor_simulation *s, int b)
{
    const mor_simulation_body *it = &s->bodies.of[b];
    const mor_body *body = &it->group->bodies[it->index];
    const double length = s->schedule.step_length;
    const bool is_damped = mor_is_damped(mor_schedule_time(&s->schedule) - length, it->group->damping_time);
    const double damping = is_damped ? it->group->damping : 0.0;
    const double local = is_damped ? it->group->local_damping : 0.0;
    double force[3];
    double moment[3];
    if (body->is_held || !mor_simulation_body_is_there(&s->bodies, b)) {
        return -1.0;
    }
    for (int a = 0; a < 3; ++a) {
        force[a] = (body->velocity[a] - body->begin_velocity[a]) / length;
        moment[a] = (body->angular_velocity[a] - body->begin_angular_velocity[a]) / length;
    }
    mor_undamp_locally(local, body->begin_velocity, force);
    mor_undamp_locally(local, body->begin_angular_velocity, moment);
    for (int a = 0; a < 3; ++a) {
        force[a] += 0.5 * damping * (body->velocity[a] + body->begin_velocity[a]);
        moment[a] += 0.5 * damping * (body->angular_velocity[a] + body->begin_angular_velocity[a]);
    }
    return mor_vector_length(force) + find_gyration_radius(body) * mor_vector_length(moment);
}

void mor_simulation_find_imbalance(const mor_simulation *simulation, int n_threads, mor_simulation_imbalance *imbalance)
{
    const double gravity = mor_vector_length(simulation->frame.gravity);
    double force = 0.0;
    double mass = 0.0;
    double largest = 0.0;
    double bodies = 0.0;
    *imbalance = (mor_simulation_imbalance){NAN, NAN, NAN};
    if (simulation->schedule.n_steps == simulation->resumed_step || !(gravity > 0.0)) {
        return;
    }
    if (simulation->has_soil && simulation->soil.set.n_particles > 0) {
        soil_job job = job_of(simulation);
        const int64_t n = simulation->soil.set.n_particles;
        const mor_blocks blocks = {.n_items = n, .n_blocks = BLOCKS, .grain = 1};
        double partial[BLOCKS];
        force = mor_sum_over(n, n_threads, fill_forces, &job);
        mass = mor_sum_over(n, n_threads, fill_masses, &job);
        mor_reduce(&blocks, mor_measure_team_for(n, n_threads).n_threads, MOR_REDUCE_LARGEST, 1, find_largest, &job,
                   partial, &largest);
    }
    for (int b = 0; b < simulation->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &simulation->bodies.of[b];
        const double net = find_body_net(simulation, b);
        if (net >= 0.0) {
            force += it->group->bodies[it->index].mass * net;
            mass += it->group->bodies[it->index].mass;
            bodies = mor_larger(bodies, net);
        }
    }
    if (mass > 0.0) {
        *imbalance = (mor_simulation_imbalance){.mean = force / (mass * gravity),
                                                .largest = mor_larger(largest, bodies) / gravity,
                                                .bodies = bodies / gravity};
    }
}

void mor_simulation_find_motion(const mor_simulation *simulation, int n_threads, mor_simulation_motion *motion)
{
    double momentum = 0.0;
    double mass = 0.0;
    *motion = (mor_simulation_motion){0.0, 0.0};
    if (simulation->has_soil) {
        const soil_job job = job_of(simulation);
        const int64_t n = simulation->soil.set.n_particles;
        momentum = mor_sum_over(n, n_threads, fill_momenta, &job);
        mass = mor_sum_over(n, n_threads, fill_masses, &job);
    }
    for (int b = 0; b < simulation->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &simulation->bodies.of[b];
        const mor_body *body = &it->group->bodies[it->index];
        const double speed =
            mor_vector_length(body->velocity) + find_gyration_radius(body) * mor_vector_length(body->angular_velocity);
        if (!body->is_held && mor_simulation_body_is_there(&simulation->bodies, b)) {
            momentum += body->mass * speed;
            mass += body->mass;
            motion->bodies = mor_larger(motion->bodies, speed);
        }
    }
    motion->mean = mass > 0.0 ? momentum / mass : 0.0;
}

int64_t mor_simulation_find_unbalanced(const mor_simulation *simulation, int *body)
{
    const soil_job job = job_of(simulation);
    int64_t found = -1;
    double largest = -1.0;
    *body = -1;
    for (int64_t i = 0; simulation->has_soil && i < simulation->soil.set.n_particles; ++i) {
        const double net = find_net(&job, i);
        found = net > largest ? i : found;
        largest = net > largest ? net : largest;
    }
    for (int b = 0; b < simulation->the_case->n_bodies; ++b) {
        const double net = find_body_net(simulation, b);
        if (net > largest) {
            largest = net;
            found = -1;
            *body = b;
        }
    }
    return found;
}
