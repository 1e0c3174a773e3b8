/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Barrier between soil particles and points of a boundary, Jiang et al. (2022) section 3.2. Few pairs are so close. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/reduce.h"

#include <float.h>
#include <string.h>

/* Part of the period of a particle on the barrier, over 2 pi, that a step may take; an explicit step is stable up to
 * 2. Part of a distance that may be closed in a step. */
#define PART_OF_PERIOD 0.5
#define PART_OF_DISTANCE 0.2

mor_status mor_soil_contact_set_barrier(mor_context *context, mor_soil_contact *contact,
                                        const mor_soil_barrier *barrier, double support)
{
    MOR_CHECK(context, !barrier->is_on || (barrier->stiffness > 0.0 && isfinite(barrier->stiffness)),
              MOR_ERROR_ARGUMENT, "the barrier of '%s' has a stiffness of %g N/m; it must be positive and finite",
              contact->name, barrier->stiffness);
    MOR_CHECK(context, !barrier->is_on || (barrier->radius > 0.0 && barrier->radius <= support), MOR_ERROR_ARGUMENT,
              "the barrier of '%s' has a radius of %g m; it must be positive and at most the support of the kernel, "
              "%g m. The particle spacing is a good value",
              contact->name, barrier->radius, support);
    contact->barrier = *barrier;
    contact->longest_step = INFINITY;
    return MOR_OK;
}

double mor_soil_barrier_force(const mor_soil_barrier *barrier, double distance)
{
    const double ratio = distance / barrier->radius;
    if (!(ratio < 1.0)) {
        return 0.0;
    }
    return barrier->stiffness * barrier->radius * (ratio - 1.0) * (2.0 * log(ratio) - 1.0 / ratio + 1.0);
}

/* Minus the derivative of the force by the distance, per stiffness. */
static double slope_at(double ratio)
{
    return ratio < 1.0 ? -2.0 * log(ratio) - (ratio - 1.0) * (3.0 * ratio + 1.0) / (ratio * ratio) : 0.0;
}

double mor_soil_barrier_slope(const mor_soil_barrier *barrier, double distance)
{
    return barrier->stiffness * slope_at(distance / barrier->radius);
}

/* Vector from a point to a particle, and whether the barrier acts between them. */
static bool is_near(const mor_soil_contact *contact, const double *record, int32_t point, double *arm, double *distance)
{
    const double *place = contact->boundary->records + (int64_t)point * MOR_BOUNDARY_RECORD;
    for (int a = 0; a < 3; ++a) {
        arm[a] = record[a] - place[a];
    }
    const double radius = contact->barrier.radius;
    const double distance2 = mor_vector_dot(arm, arm);
    if (!(distance2 < radius * radius)) {
        return false;
    }
    *distance = sqrt(distance2);
    return true;
}

/* The barrier on one particle; returns the longest step. For two at one place the direction is undefined: the step is
 * then zero, and the run stops. */
static double repel_particle(const mor_soil_contact *contact, const mor_pair_slot *slot, const double *record,
                             double *force)
{
    const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
    double slope = 0.0;
    double longest = INFINITY;
    force[0] = force[1] = force[2] = 0.0;
    for (int32_t entry = 0; entry < slot->count; ++entry) {
        double arm[3];
        double distance = 0.0;
        if (!is_near(contact, record, slot->list[entry], arm, &distance)) {
            continue;
        }
        const double *point = contact->boundary->records + (int64_t)slot->list[entry] * MOR_BOUNDARY_RECORD;
        const double strength = mor_soil_barrier_force(&contact->barrier, distance);
        double closing = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double direction = distance > 0.0 ? arm[a] / distance : 0.0;
            force[a] += distance > 0.0 ? strength * direction : 0.0;
            closing -= (record[MOR_RECORD_VELOCITY + a] - point[MOR_BOUNDARY_VELOCITY + a]) * direction;
        }
        slope += mor_soil_barrier_slope(&contact->barrier, distance);
        const double by_distance = closing > 0.0 ? PART_OF_DISTANCE * distance / closing : INFINITY;
        longest = by_distance < longest ? by_distance : longest;
    }
    const double by_slope = slope > 0.0 ? PART_OF_PERIOD * sqrt(mass / slope) : INFINITY;
    return by_slope < longest ? by_slope : longest;
}

/* What the barrier reads and writes. */
typedef struct repulsion {
    const mor_soil_contact *contact;
    const double *records;
    int64_t n_particles;
} repulsion;

/* The barrier on the particles of some slots, and the longest step that they allow. */
static void repel_slots(void *job, int64_t first_slot, int64_t last_slot, double *longest)
{
    const repulsion *it = job;
    for (int64_t place = first_slot; place < last_slot; ++place) {
        const mor_pair_slot *slot = &it->contact->slots[place];
        const double *first = it->records + (int64_t)slot->cluster * MOR_CLUSTER * MOR_RECORD_SIZE;
        for (int64_t k = 0; k < mor_soil_contact_lanes(slot, it->n_particles); ++k) {
            const double step = repel_particle(it->contact, slot, first + k * MOR_RECORD_SIZE,
                                               it->contact->repulsion + (place * MOR_CLUSTER + k) * 3);
            longest[0] = step < longest[0] ? step : longest[0];
        }
    }
}

void mor_soil_contact_repel(mor_context *context, mor_soil_contact *contact, const double *records, int64_t n_particles)
{
    const mor_blocks blocks = {.n_items = contact->n_slots, .block_items = MOR_CONTACT_GRAIN, .grain = 1};
    repulsion job = {contact, records, n_particles};
    contact->longest_step = INFINITY;
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SMALLEST, 1, repel_slots, &job, contact->barrier_steps,
               &contact->longest_step);
}

void mor_soil_contact_repel_points(const mor_soil_contact *contact, const mor_pair_slot *slot, const double *records,
                                   int64_t n_particles, double *force)
{
    const double *first = records + (int64_t)slot->cluster * MOR_CLUSTER * MOR_RECORD_SIZE;
    for (int64_t k = 0; k < mor_soil_contact_lanes(slot, n_particles); ++k) {
        for (int32_t entry = 0; entry < slot->count; ++entry) {
            double arm[3];
            double distance = 0.0;
            if (!is_near(contact, first + k * MOR_RECORD_SIZE, slot->list[entry], arm, &distance) ||
                !(distance > 0.0)) {
                continue;
            }
            const double strength = mor_soil_barrier_force(&contact->barrier, distance);
            for (int a = 0; a < 3; ++a) {
                force[3 * (int64_t)slot->list[entry] + a] -= strength * (arm[a] / distance);
            }
        }
    }
}
