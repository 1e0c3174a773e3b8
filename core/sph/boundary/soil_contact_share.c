/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What the soil does to a boundary: the reaction to the boundary forces is distributed to the points so that force and
 * moment of each patch are kept. One thread works on a patch, slot by slot in fixed order. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = MOR_CONTACT_GRAIN };

/* Shares by kernel gradient cancel where a boundary surrounds a particle; there they go by kernel values. The length of
 * the gradient over the value, times h, below which this is so, 1; it is over 1 at a face. */
#define SMALLEST_GRADIENT 0.1

/* A patch carries a moment about an axis when its moment of inertia there is more than this part of the largest; else
 * its points lie on a line. */
#define SMALLEST_INERTIA 1.0e-9

/* How each particle of a slot gives its force: in proportion to V grad W . n, as in eqs. 48 and 50. Where the kernel
 * gradient was directed by faces, the sum of these is that of the points times it. */
static void prepare_slot(const mor_soil_contact *contact, double smoothing_length, int64_t slot, const double *records,
                         int64_t n_particles)
{
    const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
    const int64_t n_lanes = mor_soil_contact_lanes(&contact->slots[slot], n_particles);
    double *given = contact->given + slot * MOR_CLUSTER * MOR_SHARES;
    memset(given + n_lanes * MOR_SHARES, 0, (size_t)((MOR_CLUSTER - n_lanes) * MOR_SHARES) * sizeof *given);
    for (int64_t k = 0; k < n_lanes; ++k) {
        const int64_t lane = slot * MOR_CLUSTER + k;
        const double *record = records + (first + k) * MOR_RECORD_SIZE;
        const double *sums = contact->sums + lane * MOR_KERNEL_SUMS;
        const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
        const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
        const double value = sums[MOR_KERNEL_SUM_VALUE];
        double *own = given + k * MOR_SHARES;
        const double *whole = contact->normals != NULL ? own + MOR_SHARE_DIRECTION : gradient;
        const double length2 = mor_max(mor_vector_dot(whole, gradient), 0.0);
        const bool has_force = value > 0.0 && mor_vector_dot(gradient, gradient) > 0.0;
        memset(own, 0, MOR_SHARES * sizeof *own);
        if (!has_force) {
            continue; /* out of reach */
        }
        const bool is_facing = sqrt(length2) * smoothing_length > SMALLEST_GRADIENT * value;
        own[MOR_SHARE_VALUE] = is_facing ? 0.0 : 1.0 / value;
        for (int a = 0; a < 3; ++a) {
            own[MOR_SHARE_FORCE + a] = -mass * contact->acceleration[3 * lane + a];
            own[MOR_SHARE_DIRECTION + a] = is_facing ? gradient[a] / length2 : 0.0;
        }
    }
}

/* Center of a patch and its moment of inertia there, with volumes for masses; symmetric tensor. */
static void measure_patch(const double *records, int64_t n, double *center, double *inertia)
{
    double volume = 0.0;
    memset(center, 0, 3 * sizeof *center);
    memset(inertia, 0, 6 * sizeof *inertia);
    for (int64_t j = 0; j < n; ++j) {
        const double *record = records + MOR_BOUNDARY_RECORD * j;
        volume += record[MOR_BOUNDARY_VOLUME];
        for (int a = 0; a < 3; ++a) {
            center[a] += record[MOR_BOUNDARY_VOLUME] * (record[a] - records[a]);
        }
    }
    for (int a = 0; a < 3; ++a) {
        center[a] = records[a] + center[a] / volume;
    }
    for (int64_t j = 0; j < n; ++j) {
        const double *record = records + MOR_BOUNDARY_RECORD * j;
        const double v = record[MOR_BOUNDARY_VOLUME];
        const double s[3] = {record[0] - center[0], record[1] - center[1], record[2] - center[2]};
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const int c = (a + 2) % 3;
            inertia[a] += v * (s[b] * s[b] + s[c] * s[c]);
            inertia[3 + a] -= v * s[a] * s[b];
        }
    }
}

/* Adds the moment of a force at a place about a center. */
static void add_moment(const double *place, const double *center, const double *force, double *moment)
{
    const double s[3] = {place[0] - center[0], place[1] - center[1], place[2] - center[2]};
    mor_vector_cross_add(1.0, s, force, moment);
}

/* Solves inertia * rotation = moment; false for a patch that cannot carry a moment. In plane strain it is about z. */
static bool find_rotation(const double *inertia, const double *moment, int dimension, double *rotation)
{
    const double *m = inertia;
    const double trace = mor_symmetric_trace(m);
    memset(rotation, 0, 3 * sizeof *rotation);
    if (dimension == 2) {
        rotation[2] = m[MOR_ZZ] > 0.0 ? moment[2] / m[MOR_ZZ] : 0.0;
        return m[MOR_ZZ] > 0.0;
    }
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(m, cofactors);
    if (!(determinant > SMALLEST_INERTIA * trace * trace * trace)) {
        return false;
    }
    mor_symmetric_apply(cofactors, moment, rotation);
    for (int a = 0; a < 3; ++a) {
        rotation[a] /= determinant;
    }
    return true;
}

/* Moment that the particles gave a patch about its center. The barrier's forces act along lines between particles and
 * points, and carry their moment along. */
static void sum_given(const mor_soil_contact *contact, int patch, const double *center, const double *records,
                      int64_t n_particles, double *moment)
{
    memset(moment, 0, 3 * sizeof *moment);
    for (int32_t k = contact->first_of_patch[patch]; k < contact->first_of_patch[patch + 1]; ++k) {
        const int64_t slot = contact->patch_slots[k];
        const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
        for (int64_t lane = 0; lane < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++lane) {
            add_moment(records + (first + lane) * MOR_RECORD_SIZE, center,
                       contact->given + (slot * MOR_CLUSTER + lane) * MOR_SHARES + MOR_SHARE_FORCE, moment);
        }
    }
}

/* The forces act at the points and no longer at the particles, which changes their moment. Forces proportional to the
 * accelerations of a rigid rotation restore it: they add up to zero, and stress no body of uniform density. */
static void restore_moment(const mor_soil_contact *contact, int patch, const double *records, int64_t n_particles)
{
    const mor_boundary *boundary = contact->boundary;
    const int64_t n = boundary->patches[patch].n_points;
    const double *points = boundary->records + MOR_BOUNDARY_RECORD * boundary->patches[patch].first;
    double *force = boundary->force + 3 * boundary->patches[patch].first;
    double center[3];
    double inertia[6];
    double moment[3];
    double kept[3] = {0.0, 0.0, 0.0};
    double rotation[3];
    measure_patch(points, n, center, inertia);
    sum_given(contact, patch, center, records, n_particles, moment);
    for (int64_t j = 0; j < n; ++j) {
        add_moment(points + MOR_BOUNDARY_RECORD * j, center, force + 3 * j, kept);
    }
    for (int a = 0; a < 3; ++a) {
        moment[a] -= kept[a];
    }
    if (!find_rotation(inertia, moment, contact->dimension, rotation)) {
        return;
    }
    for (int64_t j = 0; j < n; ++j) {
        const double *record = points + MOR_BOUNDARY_RECORD * j;
        const double s[3] = {record[0] - center[0], record[1] - center[1], record[2] - center[2]};
        mor_vector_cross_add(record[MOR_BOUNDARY_VOLUME], rotation, s, force + 3 * j);
    }
}

void mor_soil_contact_share_forces(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                   const mor_pair_constants *constants, const double *records, int64_t n_particles)
{
    if (contact->is_wall) {
        return;
    }
    mor_boundary *boundary = contact->boundary;
    const mor_pair_share_job job = {records,        boundary->records, contact->slots, contact->patch_slots,
                                    contact->given, boundary->force};
    MOR_PARALLEL_FOR (context, slot, contact->n_slots, GRAIN) {
        prepare_slot(contact, constants->smoothing_length, slot, records, n_particles);
    }
    MOR_PARALLEL_FOR (context, patch, boundary->n_patches, 1) {
        const int32_t first = contact->first_of_patch[patch];
        const int32_t last = contact->first_of_patch[patch + 1];
        if (first == last) {
            continue; /* rocks far from the soil cost nothing */
        }
        double *force = boundary->force + 3 * boundary->patches[patch].first;
        memset(force, 0, (size_t)(3 * boundary->patches[patch].n_points) * sizeof *force);
        table->share(constants, &job, first, last);
        restore_moment(contact, (int)patch, records, n_particles);
        for (int32_t k = first; k < last && contact->barrier.is_on; ++k) {
            mor_soil_contact_repel_points(contact, &contact->slots[contact->patch_slots[k]], records, n_particles,
                                          boundary->force);
        }
    }
}
