/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/elastic/elastic_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"

#include <stdio.h>
#include <string.h>

#define BIT(name) MOR_BIT(MOR_FIELD_##name)
#define RECORDS MOR_BIT(MOR_RESOURCE_RECORDS)
#define STATE MOR_BIT(MOR_RESOURCE_STATE)
#define ENERGY_SUMS MOR_BIT(MOR_RESOURCE_ENERGY_SUMS)
#define BODIES MOR_BIT(MOR_RESOURCE_BODIES)
#define BOUNDS MOR_BIT(MOR_RESOURCE_BOUNDS)

/* Fields beside the built-in ones, in the order in which they are added to the set. */
enum { FIELD_GRADIENT = MOR_FIELD_CORE_COUNT, FIELD_RATE };
#define GRADIENT MOR_BIT(FIELD_GRADIENT)
#define RATE MOR_BIT(FIELD_RATE)

/* One sub-step. Contact acts between the first and the second stage. */
static const mor_stage elastic_stages[] = {
    {"first drift", mor_elastic_drift_first, BIT(VELOCITY), 0, BIT(POSITION), "positions to the middle of the sub-step",
     NULL},
    {"stress", mor_elastic_find_stress, BIT(POSITION) | RATE, 0, RECORDS | GRADIENT | BIT(STRESS) | STATE | ENERGY_SUMS,
     "deformation gradients to the middle of the sub-step; the material's stress and the Kelvin-Voigt damper", NULL},
    {"forces", mor_elastic_sum_forces, RECORDS, BIT(ACCELERATION), 0,
     "acceleration by the neighbors, hourglass control included", NULL},
    {"kick", mor_elastic_kick, BIT(MASS), 0, BIT(VELOCITY) | BIT(ACCELERATION) | RECORDS | BODIES | BOUNDS,
     "soil, contact, gravity; velocities to the end of the sub-step", NULL},
    {"deformation rate", mor_elastic_find_rate, RECORDS, BIT(DENSITY), GRADIENT | RATE,
     "rate of the deformation gradient; deformation gradients and densities to the end of the sub-step", NULL},
    {"second drift", mor_elastic_drift_second, BIT(VELOCITY), 0, BIT(POSITION), "positions to the end of the sub-step",
     NULL},
};

static const uint64_t evolving_fields =
    MOR_BODY_EVOLVING | BIT(STRESS) | GRADIENT | RATE | STATE | ENERGY_SUMS | BOUNDS | RECORDS;

enum { BATCH = 64 };

static mor_status check_scheme(mor_context *context, const char *name, const mor_scheme *scheme,
                               const mor_material_instance *material)
{
    MOR_CHECK(context, material->material->form == MOR_MATERIAL_TOTAL, MOR_ERROR_ARGUMENT,
              "material '%s' of group '%s' is of the rate form; an elastic body needs one of the total form",
              material->material->name, name);
    MOR_CHECK(context, scheme->body_smoothing_ratio > 0.5 && scheme->body_courant > 0.0, MOR_ERROR_ARGUMENT,
              "group '%s' has smoothing ratio %g and Courant number %g; more than 0.5 and 0 are needed", name,
              scheme->body_smoothing_ratio, scheme->body_courant);
    MOR_CHECK(context, scheme->body_damping >= 0.0 && scheme->hourglass >= 0.0, MOR_ERROR_ARGUMENT,
              "group '%s' has damping factor %g and hourglass control %g; neither may be negative", name,
              scheme->body_damping, scheme->hourglass);
    return MOR_OK;
}

static mor_status add_fields(mor_context *context, mor_elastic *elastic)
{
    static const mor_field_info gradient = {"deformation_gradient", 9, "1", MOR_FIELD_EVOLVES,
                                            "deformation gradient, row a column b = dx_a/dX_b"};
    static const mor_field_info rate = {"deformation_rate", 9, "1/s", MOR_FIELD_EVOLVES,
                                        "rate of the deformation gradient"};
    mor_set *set = &elastic->group.set;
    MOR_TRY(context, mor_set_add_field(context, set, &gradient, &elastic->field_gradient));
    elastic->group.field_gradient = elastic->field_gradient;
    MOR_TRY(context, mor_set_add_field(context, set, &rate, &elastic->field_rate));
    return mor_set_add_state(context, set, elastic->material->material->state, elastic->material->n_state,
                             elastic->work->state_fields);
}

/* Calls an operation for [first, first + n) with everything a material may ask for. */
static mor_batch batch_of(const mor_elastic *elastic, int64_t first, int64_t n, const double **state_in,
                          double **state_out)
{
    const mor_set *set = &elastic->group.set;
    for (int k = 0; k < elastic->material->n_state; ++k) {
        const int field = elastic->work->state_fields[k];
        state_out[k] = set->data[field] + first * set->fields[field].n_components;
        state_in[k] = state_out[k];
    }
    return (mor_batch){.n = n,
                       .density = set->data[MOR_FIELD_DENSITY] + first,
                       .deformation_gradient = set->data[elastic->field_gradient] + 9 * first,
                       .stress_in = set->data[MOR_FIELD_STRESS] + 6 * first,
                       .state_in = state_in,
                       .state_out = state_out};
}

/* State without deformation, and the speed of waves in it. */
static mor_status init_state(mor_context *context, mor_elastic *elastic)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    const mor_material_instance *material = elastic->material;
    const int64_t n = elastic->group.set.n_particles;
    double *gradient = elastic->group.set.data[elastic->field_gradient];
    for (int64_t k = 0; k < 9 * n; ++k) {
        gradient[k] = k % 9 % 4 == 0 ? 1.0 : 0.0;
    }
    mor_batch batch = batch_of(elastic, 0, n, state_in, state_out);
    mor_status status = material->operations.init_state(material, &batch);
    MOR_CHECK(context, status == MOR_OK, status < 0 ? status : MOR_ERROR_NUMERIC,
              "material '%s' refused the initial state of group '%s'", material->material->name,
              elastic->group.set.name);
    batch.n = 1;
    status = material->operations.wave_speed(material, &batch, &elastic->sound_speed);
    MOR_CHECK(context, status == MOR_OK && elastic->sound_speed > 0.0 && isfinite(elastic->sound_speed),
              status < 0 ? status : MOR_ERROR_NUMERIC, "material '%s' has wave speed %g m/s; it must be positive",
              material->material->name, elastic->sound_speed);
    return MOR_OK;
}

static mor_status set_constants(mor_context *context, mor_elastic *elastic)
{
    const mor_body_group *group = &elastic->group;
    const double factor = mor_kernel_gradient_factor(elastic->smoothing_length, group->dimension);
    const double c0 = elastic->sound_speed;
    MOR_TRY(context, MOR_NEW(context, &elastic->work->constants, group->n_bodies, "constants of bodies"));
    for (int b = 0; b < group->n_bodies; ++b) {
        const double volume = group->volume[group->bodies[b].first];
        const double density = group->bodies[b].density;
        elastic->work->constants[b] = (mor_elastic_constants){
            .inverse_density = 1.0 / density,
            .density = density,
            .particle_volume = volume,
            /* Hourglass force of a pair: hourglass rho0 c0^2 V_i V_j |W'| / r0 times the part of r_ij that the mean
             * linear map does not give, after Silling (2017). */
            .hourglass = elastic->scheme.hourglass * (c0 * c0) * volume * factor,
        };
    }
    return MOR_OK;
}

static mor_status init_parts(mor_context *context, mor_elastic *elastic)
{
    MOR_TRY(context, MOR_NEW(context, &elastic->held, elastic->group.set.n_particles, "held particles of bodies"));
    MOR_TRY(context, MOR_NEW(context, &elastic->work, 1, "elastic bodies"));
    elastic->work->table = mor_elastic_select(NULL);
    MOR_TRY(context, add_fields(context, elastic));
    MOR_TRY(context, init_state(context, elastic));
    MOR_TRY(context, set_constants(context, elastic));
    MOR_TRY(context, mor_elastic_find_neighbors(context, elastic));
    return mor_elastic_prepare(context, elastic);
}

mor_status mor_elastic_init(mor_context *context, mor_elastic *elastic, const char *name, const mor_scheme *scheme,
                            const mor_material_instance *material, int dimension, double spacing,
                            const mor_body_request *requests, int n_bodies)
{
    memset(elastic, 0, sizeof *elastic);
    MOR_TRY(context, check_scheme(context, name, scheme, material));
    MOR_TRY(context, mor_body_group_init(context, &elastic->group, name, &mor_elastic_operations, elastic, dimension,
                                         spacing, requests, n_bodies, BIT(STRESS) | BIT(ACCELERATION)));
    elastic->scheme = *scheme;
    elastic->material = material;
    elastic->smoothing_length = scheme->body_smoothing_ratio * spacing;
    const mor_status status = init_parts(context, elastic);
    elastic->group.sound_speed = elastic->sound_speed;
    if (status != MOR_OK) {
        mor_elastic_clear(context, elastic);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_elastic_clear(mor_context *context, mor_elastic *elastic)
{
    mor_elastic_work *work = elastic->work;
    if (work != NULL) {
        MOR_FREE(context, &work->clusters);
        MOR_FREE(context, &work->entries);
        MOR_FREE(context, &work->weights);
        MOR_FREE(context, &work->stressed);
        MOR_FREE(context, &work->moving);
        MOR_FREE(context, &work->inverses);
        MOR_FREE(context, &work->sums);
        MOR_FREE(context, &work->constants);
        MOR_FREE(context, &work->chunk_status);
        MOR_FREE(context, &work->chunk_power);
        MOR_FREE(context, &work->piece_kicks);
        MOR_FREE(context, &work->chunk_failed);
    }
    MOR_FREE(context, &elastic->work);
    MOR_FREE(context, &elastic->held);
    mor_body_group_clear(context, &elastic->group);
    memset(elastic, 0, sizeof *elastic);
}

mor_status mor_elastic_prepare(mor_context *context, mor_elastic *elastic)
{
    mor_body_group *group = &elastic->group;
    double fastest = 0.0;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        if (elastic->held[i]) {
            memset(v, 0, 3 * sizeof *v);
        }
        const double speed2 = mor_vector_dot(v, v);
        fastest = fastest >= speed2 ? fastest : speed2;
    }
    elastic->largest_speed = sqrt(fastest);
    elastic->work->is_energy_known = false;
    mor_view view = mor_view_open(&group->set, NULL);
    mor_elastic_pack_velocities(context, elastic, &view);
    MOR_TRY(context, mor_elastic_find_rate(context, elastic, &view, NULL));
    mor_body_group_observe(context, group, 0.0);
    return MOR_OK;
}

/* Eq. 52, with the stiffness that hourglass control adds, and the limits of damping and contact. */
static mor_status propose_step(mor_context *context, void *owner, double *step_length, const char **limit)
{
    const mor_elastic *elastic = owner;
    const mor_scheme *scheme = &elastic->scheme;
    const mor_body_group *group = &elastic->group;
    const double h = elastic->smoothing_length;
    const double wave = elastic->sound_speed * sqrt(1.0 + scheme->hourglass);
    *step_length = scheme->body_courant * h / (wave + elastic->largest_speed);
    *limit = "the speed of sound in the bodies";
    const double by_acceleration = scheme->body_courant * sqrt(h / elastic->largest_acceleration);
    if (elastic->largest_acceleration > 0.0 && by_acceleration < *step_length) {
        *step_length = by_acceleration;
        *limit = "the acceleration of the bodies";
    }
    /* The damper diffuses velocity by Pi / rho = factor c0 h / 2; an explicit step is stable up to about h2 / 2 over
     * it. */
    if (scheme->body_damping * elastic->sound_speed * *step_length > h) {
        *step_length = h / (scheme->body_damping * elastic->sound_speed);
        *limit = "the viscous damping of the bodies";
    }
    if (group->damping * *step_length > 0.5) {
        *step_length = 0.5 / group->damping;
        *limit = "the damping";
    }
    if (group->longest_contact_step != NULL) {
        const double by_contact = group->longest_contact_step(context, group->contact, group);
        if (by_contact < *step_length) {
            *step_length = by_contact;
            *limit = "the contact of the bodies";
        }
    }
    return MOR_OK;
}

static mor_status begin_step(mor_context *context, void *owner, const mor_step *step)
{
    mor_elastic *elastic = owner;
    mor_body_group_begin(context, &elastic->group, step->length);
    return MOR_OK;
}

static mor_status finish_step(mor_context *context, void *owner, const mor_step *step)
{
    mor_elastic *elastic = owner;
    mor_body_group_observe(context, &elastic->group, step->length);
    mor_body_group_finish(context, &elastic->group, step->length);
    return MOR_OK;
}

/* The motion of each body as a whole is observed anew, but for what adds up over time. */
static mor_status list_state(mor_context *context, void *owner, mor_state_list *list)
{
    mor_elastic *elastic = owner;
    mor_body *bodies = elastic->group.bodies;
    const char *name = elastic->group.set.name;
    const int n = elastic->group.n_bodies;
    const size_t size = sizeof *bodies;
    MOR_TRY(context, mor_body_group_list_state(context, &elastic->group, list));
    MOR_TRY(context, mor_state_add(context, list, name, "largest_acceleration", MOR_STATE_DOUBLE, 1,
                                   &elastic->largest_acceleration));
    MOR_TRY(context, mor_state_add(context, list, name, "damped_energy", MOR_STATE_DOUBLE, 1, &elastic->damped_energy));
    MOR_TRY(context, mor_state_add_member(context, list, name, "rotation_angle", n, 3, size, bodies->rotation_angle));
    MOR_TRY(context, mor_state_add_member(context, list, name, "soil_impulse", n, 3, size, bodies->soil_impulse));
    return mor_state_add_member(context, list, name, "contact_impulse", n, 3, size, bodies->contact_impulse);
}

static mor_status resume(mor_context *context, void *owner)
{
    return mor_elastic_prepare(context, owner);
}

static void visit_shared(void *owner, mor_shared_visit visit, void *job)
{
    mor_elastic *elastic = owner;
    const mor_elastic_work *work = elastic->work;
    const int64_t n_slots = work->n_clusters * MOR_CLUSTER;
    const int d = elastic->group.dimension;
    mor_body_group_visit_shared(&elastic->group, visit, job);
    visit(job, MOR_RESOURCE_RECORDS, work->stressed, n_slots * (2 * d + d * d));
    visit(job, MOR_RESOURCE_RECORDS, work->moving, n_slots * 2 * d);
    visit(job, MOR_RESOURCE_REFERENCE, work->inverses, n_slots * 6);
    visit(job, MOR_RESOURCE_REFERENCE, work->sums, n_slots * 3);
    visit(job, MOR_RESOURCE_ENERGY_SUMS, &elastic->damped_energy, 1);
    visit(job, MOR_RESOURCE_BOUNDS, &elastic->largest_speed, 1);
    visit(job, MOR_RESOURCE_BOUNDS, &elastic->largest_acceleration, 1);
}

void mor_elastic_stepper(mor_elastic *elastic, mor_stepper *stepper, uint64_t *evolving)
{
    static const mor_stepper_operations operations = {"elastic bodies", propose_step, begin_step,
                                                      finish_step,      list_state,   resume};
    *stepper = (mor_stepper){.name = elastic->group.set.name,
                             .operations = &operations,
                             .owner = elastic,
                             .stages = elastic_stages,
                             .n_stages = (int)(sizeof elastic_stages / sizeof *elastic_stages),
                             .n_before = 1,
                             .n_particles = elastic->group.set.n_particles,
                             .is_leader = false,
                             .set = &elastic->group.set,
                             .visit_shared = visit_shared};
    *evolving = evolving_fields;
}

static double hourglass_energy(const mor_elastic *elastic, int body)
{
    const mor_elastic_work *work = elastic->work;
    mor_elastic_job job = mor_elastic_job_of(elastic, 0.0);
    job.position = elastic->group.set.data[MOR_FIELD_POSITION];
    job.gradient = elastic->group.set.data[elastic->field_gradient];
    int64_t first = 0;
    int64_t last = work->n_clusters;
    while (body >= 0 && work->clusters[first].body < body) {
        ++first;
    }
    while (body >= 0 && work->clusters[last - 1].body > body) {
        --last;
    }
    return elastic->scheme.hourglass > 0.0
               ? work->table->hourglass[elastic->group.dimension == 3 ? 1 : 0](&job, first, last)
               : 0.0;
}

static double find_energy(const mor_elastic *elastic, int body)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    const mor_body_group *group = &elastic->group;
    const int64_t first = body >= 0 ? group->bodies[body].first : 0;
    const int64_t last = body >= 0 ? first + group->bodies[body].n_particles : group->set.n_particles;
    double energy = hourglass_energy(elastic, body);
    for (int64_t start = first; start < last; start += BATCH) {
        double stored[BATCH];
        const int64_t n = last - start < BATCH ? last - start : BATCH;
        const mor_batch batch = batch_of(elastic, start, n, state_in, state_out);
        if (elastic->material->operations.energy(elastic->material, &batch, stored) != MOR_OK) {
            return NAN;
        }
        for (int64_t i = 0; i < n; ++i) {
            energy += stored[i] * group->volume[start + i];
        }
    }
    return energy;
}

double mor_elastic_energy(const mor_elastic *elastic, int body)
{
    mor_elastic_work *work = elastic->work;
    if (body >= 0) {
        return find_energy(elastic, body);
    }
    /* Several probes ask for it at the same time. */
    if (!work->is_energy_known) {
        work->energy = find_energy(elastic, body);
        work->is_energy_known = true;
    }
    return work->energy;
}

/* ---- A kind of body ---------------------------------------------------------------------------------------------- */

static void elastic_destroy(mor_context *context, mor_body_group *group)
{
    mor_elastic *elastic = group->owner;
    mor_elastic_clear(context, elastic);
    MOR_FREE(context, &elastic);
}

static void elastic_make_stepper(mor_body_group *group, mor_stepper *stepper, uint64_t *evolving)
{
    mor_elastic_stepper(group->owner, stepper, evolving);
}

static int64_t elastic_start(mor_body_group *group, int body, const mor_body_start *start)
{
    const mor_elastic *elastic = group->owner;
    const mor_body *own = &group->bodies[body];
    int64_t n_clamped = 0;
    for (int64_t i = own->first; i < own->first + own->n_particles; ++i) {
        const double *reference = group->reference + 3 * i;
        double *v = group->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        double arm[3];
        for (int a = 0; a < 3; ++a) {
            arm[a] = group->set.data[MOR_FIELD_POSITION][3 * i + a] - own->center[a];
        }
        const bool is_clamped = start->is_clamped != NULL && start->is_clamped(start->user, reference);
        n_clamped += is_clamped;
        elastic->held[i] = is_clamped || start->is_held;
        memcpy(v, start->velocity, sizeof start->velocity);
        mor_vector_cross_add(1.0, start->angular_velocity, arm, v);
        if (start->add_velocity != NULL) {
            start->add_velocity(start->user, reference, v);
        }
        if (start->is_resting || is_clamped) {
            memset(v, 0, 3 * sizeof *v);
        }
    }
    return n_clamped;
}

static mor_status elastic_prepare(mor_context *context, mor_body_group *group)
{
    mor_elastic *elastic = group->owner;
    elastic->damped_energy = 0.0;
    return mor_elastic_prepare(context, elastic);
}

static double elastic_strain_energy(const mor_body_group *group, int body)
{
    return mor_elastic_energy(group->owner, body);
}

static double elastic_damped_energy(const mor_body_group *group)
{
    const mor_elastic *elastic = group->owner;
    return elastic->damped_energy;
}

static void elastic_describe(const mor_body_group *group, char *text, size_t room)
{
    const mor_elastic *elastic = group->owner;
    snprintf(text, room, "smoothing length %g m, sound speed %.4g m/s", elastic->smoothing_length,
             elastic->sound_speed);
}

const mor_body_operations mor_elastic_operations = {.kind = "elastic bodies",
                                                    .is_deformable = true,
                                                    .destroy = elastic_destroy,
                                                    .make_stepper = elastic_make_stepper,
                                                    .start = elastic_start,
                                                    .prepare = elastic_prepare,
                                                    .momentum = mor_body_group_momentum,
                                                    .strain_energy = elastic_strain_energy,
                                                    .damped_energy = elastic_damped_energy,
                                                    .describe = elastic_describe};
