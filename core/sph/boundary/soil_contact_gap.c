/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Gaps between soil that bears tension and faces that only press, (W3b) of docs/theory/walls.md. A gap is a vector:
 * along the normal of a face it tells how far the particle has left that one. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <string.h>

/* LEAST: a gap up to this part of the depth of the first layer is rounding. NEAREST: what is nearer to a face than
 * this part of that depth touches it whatever its gap, so that soil does not pass through a face that counts as left.
 * SLANT: a gap counts for faces whose normal has more than this part of its direction, so that what was left along a
 * face opens none while that face turns. */
#define LEAST 1.0e-9
#define NEAREST 0.5
#define SLANT 0.01

void mor_soil_contact_take_gaps(mor_context *context, const mor_contact_soil *soil, const int8_t *sleep,
                                const mor_contact_rates *rates, double *before)
{
    const int64_t n_clusters = (soil->n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    MOR_PARALLEL_FOR (context, cluster, rates->gap != NULL ? n_clusters : 0, MOR_CONTACT_GRAIN) {
        const int64_t first = cluster * MOR_CLUSTER;
        const int64_t n = soil->n_particles - first < MOR_CLUSTER ? soil->n_particles - first : MOR_CLUSTER;
        memcpy(before + 3 * first, rates->gap + 3 * first, (size_t)(3 * n) * sizeof(double));
        if (!mor_sleep_is(sleep, cluster, MOR_SLEEP_ASLEEP)) {
            memset(rates->gap + 3 * first, 0, (size_t)(3 * n) * sizeof(double));
            memset(rates->face_growth + first, 0, (size_t)n * sizeof(double));
        }
        for (int64_t i = first; i < first + n; ++i) {
            soil->growth[2 * i + 1] = 0.0;
        }
    }
}

void mor_soil_contact_find_growth(mor_context *context, const mor_contact_soil *soil, const double *density_rate,
                                  const double *face_growth)
{
    MOR_PARALLEL_FOR (context, i, soil->growth != NULL ? soil->n_particles : 0, MOR_BLOCK) {
        const double density = soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_DENSITY];
        soil->growth[2 * i] = -density_rate[i] / density - face_growth[i];
        soil->growth[2 * i + 1] = 0.0;
    }
}

/* Rate of volume of a particle by a face that mirrors all of its motion, 1/s. */
static double find_face_growth(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane, int64_t i)
{
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    double relative[3];
    for (int a = 0; a < 3; ++a) {
        relative[a] = soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + a] - velocity[a];
    }
    return -2.0 * mor_vector_dot(relative, gradient);
}

void mor_soil_contact_add_growth(mor_context *context, const mor_soil_contact *contact, const mor_contact_soil *soil)
{
    MOR_PARALLEL_FOR (context, place, soil->growth != NULL ? contact->relation.n_occupied : 0, MOR_CONTACT_GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[slot].patch];
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], soil->n_particles); ++k) {
                const int64_t i = first + k;
                const mor_wall_friction friction = mor_soil_contact_friction(patch, soil->region, i).kind;
                if (mor_soil_contact_across(soil, friction, i) > 0.0) {
                    soil->growth[2 * i + 1] += find_face_growth(contact, soil, slot * MOR_CLUSTER + k, i);
                }
            }
        }
    }
}

double mor_soil_contact_gap(const double *gap, double depth, const double *normal, double distance)
{
    const double along = mor_vector_dot(gap, normal);
    const double open = mor_min(along, distance - NEAREST * depth);
    return open > LEAST * depth && along > SLANT * mor_vector_length(gap) ? open : 0.0;
}

double mor_soil_contact_leave_face(const mor_contact_leave *it, double *after)
{
    const double open = mor_soil_contact_gap(it->gap, it->depth, it->normal, it->distance);
    double follows = 0.0; /* of the motion, what goes with the face, m */
    if (it->leaves > 0.0) {
        follows = open > 0.0 ? 0.0 : mor_max(mor_min(it->leaves, it->unloads), 0.0);
    } else {
        follows = mor_min(it->leaves + open, 0.0);
    }
    /* A particle that has left another face on the other side first comes back to that one. */
    const double along = mor_vector_dot(it->gap, it->normal);
    const bool is_behind = along < -SLANT * mor_vector_length(it->gap) && along < -LEAST * it->depth;
    const double left = is_behind ? 0.0 : mor_max(open + it->leaves - follows, 0.0);
    const double sum = mor_vector_dot(after, it->normal);
    for (int a = 0; a < 3 && (left > 0.0 || sum > 0.0); ++a) {
        after[a] += (left - sum) * it->normal[a];
    }
    return it->leaves != 0.0 ? follows / it->leaves : open > 0.0 ? 0.0 : 1.0;
}

/* What the faces bear is taken off by what the strain of the mirrored motion, 2 grad W for each meter, needs for it:
 * what the volume would grow beyond that opens the gap. */
double mor_soil_contact_find_closure(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane,
                                     int64_t particle, double speed, double across, double *gap)
{
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const double *record = soil->records + particle * MOR_RECORD_SIZE;
    const double length = mor_vector_length(gradient);
    const double impedance = record[MOR_RECORD_IMPEDANCE];
    const double modulus = across * impedance * impedance / record[MOR_RECORD_DENSITY];
    double normal[3];
    double traction[3];
    if (!(length > 0.0)) {
        return 1.0;
    }
    mor_soil_contact_normal(gradient, normal);
    mor_symmetric_apply(record + MOR_RECORD_STRESS, normal, traction);
    const double held = mor_soil_contact_held(soil, particle, normal);
    const double bears = mor_max(held - mor_vector_dot(traction, normal), 0.0);
    const double leaves = speed * soil->length;
    const double beyond = mor_max(mor_soil_contact_growth(soil, particle) - bears / modulus, 0.0);
    const mor_contact_leave leave = {.gap = soil->gap + 3 * particle,
                                     .depth = soil->depth,
                                     .normal = normal,
                                     .distance = mor_soil_contact_distance(contact, lane),
                                     .leaves = leaves,
                                     .unloads = leaves - beyond / (2.0 * length)};
    return mor_soil_contact_leave_face(&leave, gap + 3 * particle);
}
