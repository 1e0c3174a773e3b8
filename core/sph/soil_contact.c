/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/soil_contact.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <string.h>

/* POINT: doubles per wall point. GRAIN: clusters a thread takes at once. */
enum { POINT = 4, GRAIN = 16 };

/* Tractions below this part of the bulk modulus are rounding: whether such a particle slides is not theirs to say. */
#define NOISE 1.0e-9

/* Largest share of the kernel that a wall is taken to fill: a particle pressed into a wall sees a little over half. */
#define LARGEST_SHARE 0.6

static mor_status copy_points(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request)
{
    const int64_t n = request->n_points;
    int32_t *order = NULL;
    mor_status status = MOR_NEW(context, &order, n, "order of wall points");
    if (status == MOR_OK) {
        mor_tree_order(request->points, 3, n, order);
        for (int64_t i = 0; i < n; ++i) {
            memcpy(contact->points + POINT * i, request->points + 3 * (int64_t)order[i], 3 * sizeof(double));
            contact->points[POINT * i + 3] = request->point_volume;
        }
        mor_tree_fit(context, &contact->tree, contact->points, POINT);
    }
    if (status == MOR_OK && mor_vector_length(request->velocity) > 0.0) {
        status = MOR_NEW(context, &contact->base, n * POINT, "wall points at the start");
    }
    if (contact->base != NULL) {
        memcpy(contact->base, contact->points, (size_t)(n * POINT) * sizeof *contact->base);
    }
    MOR_FREE(context, &order);
    return status;
}

mor_status mor_soil_contact_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request,
                                 int64_t n_soil_clusters)
{
    memset(contact, 0, sizeof *contact);
    strncpy(contact->name, request->name, sizeof contact->name - 1);
    contact->n_points = request->n_points;
    contact->stress = request->stress;
    contact->dimension = request->dimension;
    contact->friction = request->friction;
    contact->friction_coefficient = request->friction_coefficient;
    memcpy(contact->velocity, request->velocity, sizeof contact->velocity);
    mor_status status = MOR_NEW(context, &contact->points, (request->n_points + MOR_CLUSTER) * POINT, "wall points");
    if (status == MOR_OK) {
        status = mor_tree_init(context, &contact->tree, request->n_points);
    }
    if (status == MOR_OK) {
        status = mor_relation_init(context, &contact->relation, MOR_CONFIGURATION_CURRENT, n_soil_clusters);
    }
    if (status == MOR_OK) {
        status = copy_points(context, contact, request);
    }
    if (status != MOR_OK) {
        mor_soil_contact_clear(context, contact);
    }
    return status;
}

void mor_soil_contact_clear(mor_context *context, mor_soil_contact *contact)
{
    MOR_FREE(context, &contact->points);
    MOR_FREE(context, &contact->base);
    MOR_FREE(context, &contact->sums);
    MOR_FREE(context, &contact->stick);
    MOR_FREE(context, &contact->push);
    MOR_FREE(context, &contact->divergence);
    mor_tree_clear(context, &contact->tree);
    mor_relation_clear(context, &contact->relation);
    memset(contact, 0, sizeof *contact);
}

void mor_soil_contact_place(mor_soil_contact *contact, const double *displacement)
{
    for (int64_t i = 0; i < contact->n_points; ++i) {
        for (int a = 0; a < 3; ++a) {
            contact->points[POINT * i + a] = contact->base[POINT * i + a] + displacement[a];
        }
    }
}

mor_status mor_soil_contact_build(mor_context *context, mor_soil_contact *contact, const mor_relation_points *soil,
                                  double reach)
{
    if (mor_vector_dot(contact->velocity, contact->velocity) > 0.0) {
        mor_tree_fit(context, &contact->tree, contact->points, POINT);
    }
    const mor_relation_points wall = {&contact->tree, contact->points, POINT};
    MOR_TRY(context, mor_relation_build(context, &contact->relation, soil, &wall, reach));
    const int64_t needed = contact->relation.n_occupied;
    if (needed > contact->capacity) {
        const int64_t capacity = needed + needed / 4;
        contact->capacity = 0;
        MOR_FREE(context, &contact->sums);
        MOR_FREE(context, &contact->stick);
        MOR_FREE(context, &contact->push);
        MOR_FREE(context, &contact->divergence);
        MOR_TRY(context, MOR_NEW(context, &contact->sums, capacity * MOR_CLUSTER * MOR_KERNEL_SUMS, "wall sums"));
        MOR_TRY(context, MOR_NEW(context, &contact->stick, capacity * MOR_CLUSTER, "wall stick"));
        MOR_TRY(context, MOR_NEW(context, &contact->push, capacity * MOR_CLUSTER * 3, "wall push"));
        const int64_t n_values = contact->stress != MOR_WALL_STRESS_UNIFORM ? capacity * MOR_CLUSTER * 6 : 0;
        MOR_TRY(context, MOR_NEW(context, &contact->divergence, n_values, "stress divergence at walls"));
        contact->capacity = capacity;
    }
    return MOR_OK;
}

void mor_soil_contact_sum(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                          const mor_pair_constants *constants, const double *records, int64_t n_particles)
{
    const int64_t n = contact->relation.n_occupied;
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 1) {
        const int64_t first = chunk * GRAIN;
        double *sums = contact->sums + first * MOR_CLUSTER * MOR_KERNEL_SUMS;
        const mor_pair_kernel_job job = {records, n_particles, contact->points, POINT, &contact->relation, sums, true};
        table->kernel(constants, &job, first, first + GRAIN < n ? first + GRAIN : n);
    }
}

void mor_soil_contact_continue(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                               const mor_pair_constants *constants, const double *records, const mor_relation *inner)
{
    const int64_t n = contact->relation.n_occupied;
    if (contact->stress == MOR_WALL_STRESS_UNIFORM) {
        return;
    }
    const mor_pair_tangent_job job = {records, inner, contact->relation.occupied, contact->sums, contact->divergence};
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 1) {
        const int64_t first = chunk * GRAIN;
        table->tangent(constants, &job, first, first + GRAIN < n ? first + GRAIN : n);
    }
}

/* What the wall adds to a divergence when it carries a share of the kernel's moment and the soil the rest. */
static double continuation(double share)
{
    const double limited = share < LARGEST_SHARE ? share : LARGEST_SHARE;
    return limited / (1.0 - limited);
}

/* Continues the soil's stress into the wall. At a smooth wall the mirror image's shear has the other sign. */
static void add_continuation(const mor_soil_contact *contact, int64_t slot, const double *record, double *acceleration)
{
    const double *sums = contact->sums + slot * MOR_KERNEL_SUMS;
    const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
    const double *moment = sums + MOR_KERNEL_SUM_MOMENT;
    const double *divergence = contact->divergence + 6 * slot;
    const double length2 = mor_vector_dot(gradient, gradient);
    if (!(length2 > 0.0)) {
        return;
    }
    double turned[3];
    mor_symmetric_apply(moment, gradient, turned);
    const double across = mor_vector_dot(turned, gradient) / length2;
    const double along = (mor_symmetric_trace(moment) - across) / (contact->dimension - 1);
    const double factor_along = continuation(along) / record[MOR_RECORD_DENSITY];
    const double factor_across =
        contact->stress == MOR_WALL_STRESS_LINEAR ? continuation(across) / record[MOR_RECORD_DENSITY] : 0.0;
    const double flip =
        contact->friction == MOR_WALL_SMOOTH ? 2.0 * mor_vector_dot(divergence, gradient) / length2 : 0.0;
    for (int a = 0; a < 3; ++a) {
        acceleration[a] += factor_along * (divergence[a] - flip * gradient[a]) + factor_across * divergence[3 + a];
    }
}

/* Closing speed as the limiter counts it, eq. 23 with the one-sided states of eqs. 32-34. */
static double limited_speed(double closing, mor_dissipation dissipation)
{
    if (dissipation == MOR_DISSIPATION_SEPARATION) {
        return closing < 0.0 ? -closing : 0.0;
    }
    return dissipation == MOR_DISSIPATION_APPROACH && closing < 0.0 ? 0.0 : fabs(closing);
}

/* Acceleration of one particle by the wall, in which is what a continued stress adds; returns the part of the
 * tangential motion that is mirrored. At a Coulomb wall the cap holds for all of the tangential part. */
static double push_particle(const mor_soil_contact *contact, mor_dissipation dissipation, double limiter_rate,
                            const double *record, const double *gradient, double *acceleration)
{
    const double length = mor_vector_length(gradient);
    if (!(length > 0.0)) {
        return 1.0;
    }
    /* Wall normal, eq. 33: the kernel gradient over the wall points into it. */
    const double normal[3] = {-gradient[0] / length, -gradient[1] / length, -gradient[2] / length};
    double relative[3];
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - contact->velocity[a];
    }
    const double closing = -mor_vector_dot(relative, normal);
    const double slope = 2.0 * limiter_rate * limited_speed(closing, dissipation);
    const double pressure = (slope < 1.0 ? slope : 1.0) * record[MOR_RECORD_IMPEDANCE] * closing;
    double traction[3];
    mor_symmetric_apply(record + MOR_RECORD_STRESS, normal, traction);
    const double factor = -2.0 * length / record[MOR_RECORD_DENSITY];
    const double own = factor * (mor_vector_dot(traction, normal) - pressure);
    const double continued = mor_vector_dot(acceleration, normal);
    const double along = own + continued;
    const double own_part = contact->friction == MOR_WALL_SMOOTH ? 0.0 : 1.0;
    double tangential[3];
    for (int a = 0; a < 3; ++a) {
        tangential[a] = own_part * (factor * (traction[a] - pressure * normal[a]) - own * normal[a]) + acceleration[a] -
                        continued * normal[a];
    }
    double hold = 1.0;
    double stick = own_part;
    if (contact->friction == MOR_WALL_COULOMB) {
        const double limit = contact->friction_coefficient * (along > 0.0 ? along : 0.0);
        const double trial = mor_vector_length(tangential);
        const double noise =
            -factor * NOISE * record[MOR_RECORD_IMPEDANCE] * record[MOR_RECORD_IMPEDANCE] / record[MOR_RECORD_DENSITY];
        hold = trial > limit ? limit / trial : 1.0;
        stick = trial > limit ? (limit + noise) / (trial + noise) : 1.0;
    }
    for (int a = 0; a < 3; ++a) {
        acceleration[a] = along * normal[a] + hold * tangential[a];
    }
    return stick;
}

/* Serial on purpose: the sum then does not depend on the number of threads. */
static void sum_force(mor_soil_contact *contact, const double *records, int64_t n_particles)
{
    double force[3] = {0.0, 0.0, 0.0};
    for (int64_t place = 0; place < contact->relation.n_occupied; ++place) {
        const int64_t first = (int64_t)contact->relation.occupied[place] * MOR_CLUSTER;
        for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n_particles; ++lane) {
            const double *record = records + (first + lane) * MOR_RECORD_SIZE;
            const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
            for (int a = 0; a < 3; ++a) {
                force[a] -= mass * contact->push[(place * MOR_CLUSTER + lane) * 3 + a];
            }
        }
    }
    memcpy(contact->force, force, sizeof force);
}

void mor_soil_contact_push(mor_context *context, mor_soil_contact *contact, mor_dissipation dissipation,
                           double limiter_rate, const double *records, int64_t n_particles, double *acceleration)
{
    const int64_t n = contact->relation.n_occupied;
    MOR_PARALLEL_FOR (context, place, n, GRAIN) {
        const int64_t first = (int64_t)contact->relation.occupied[place] * MOR_CLUSTER;
        for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n_particles; ++lane) {
            const int64_t slot = place * MOR_CLUSTER + lane;
            const double *gradient = contact->sums + slot * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
            double *push = contact->push + 3 * slot;
            push[0] = push[1] = push[2] = 0.0;
            if (contact->stress != MOR_WALL_STRESS_UNIFORM) {
                add_continuation(contact, slot, records + (first + lane) * MOR_RECORD_SIZE, push);
            }
            contact->stick[slot] = push_particle(contact, dissipation, limiter_rate,
                                                 records + (first + lane) * MOR_RECORD_SIZE, gradient, push);
            for (int a = 0; a < 3; ++a) {
                acceleration[(first + lane) * 3 + a] += push[a];
            }
        }
    }
    sum_force(contact, records, n_particles);
}

/* Velocity that the wall's mirror image has beyond the particle's own, 2 (u - v) where it sticks. */
static void mirrored_difference(const mor_soil_contact *contact, const double *record, const double *gradient,
                                double stick, double *difference)
{
    const double length2 = mor_vector_dot(gradient, gradient);
    double relative[3];
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - contact->velocity[a];
    }
    const double across = length2 > 0.0 ? mor_vector_dot(relative, gradient) / length2 : 0.0;
    for (int a = 0; a < 3; ++a) {
        const double normal = across * gradient[a];
        difference[a] = -2.0 * (normal + stick * (relative[a] - normal));
    }
}

void mor_soil_contact_drag(mor_context *context, mor_soil_contact *contact, const double *records, int64_t n_particles,
                           double *velocity_gradient, double *density_rate)
{
    const int64_t n = contact->relation.n_occupied;
    MOR_PARALLEL_FOR (context, place, n, GRAIN) {
        const int64_t first = (int64_t)contact->relation.occupied[place] * MOR_CLUSTER;
        for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n_particles; ++lane) {
            const int64_t slot = place * MOR_CLUSTER + lane;
            const double *gradient = contact->sums + slot * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
            const double *record = records + (first + lane) * MOR_RECORD_SIZE;
            double difference[3];
            mirrored_difference(contact, record, gradient, contact->stick[slot], difference);
            for (int k = 0; k < 9; ++k) {
                velocity_gradient[(first + lane) * 9 + k] += difference[k / 3] * gradient[k % 3];
            }
            density_rate[first + lane] -= record[MOR_RECORD_DENSITY] * mor_vector_dot(difference, gradient);
        }
    }
}
