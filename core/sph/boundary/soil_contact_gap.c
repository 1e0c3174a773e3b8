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

void mor_soil_contact_take_gaps(mor_context *context, const int8_t *sleep, int64_t n_particles, double *gap,
                                double *before)
{
    const int64_t n_clusters = (n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
    MOR_PARALLEL_FOR (context, cluster, gap != NULL ? n_clusters : 0, MOR_CONTACT_GRAIN) {
        const int64_t first = cluster * MOR_CLUSTER;
        const int64_t n = n_particles - first < MOR_CLUSTER ? n_particles - first : MOR_CLUSTER;
        memcpy(before + 3 * first, gap + 3 * first, (size_t)(3 * n) * sizeof *gap);
        if (!mor_sleep_is(sleep, cluster, MOR_SLEEP_ASLEEP)) {
            memset(gap + 3 * first, 0, (size_t)(3 * n) * sizeof *gap);
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
        follows = open > 0.0 ? 0.0 : mor_min(it->leaves, it->unloads);
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
