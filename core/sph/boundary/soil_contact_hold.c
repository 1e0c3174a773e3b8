/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What holds soil at a face: under it the kernel gradient goes on to grow, (W8) of docs/theory/walls.md. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/reduce.h"
#include "core/particle/kernel.h"

#include <math.h>

/* Growth of the kernel gradient under a face per smoothing length, over its value there: that of twice the share of
 * the kernel in the boundary, 2 x 3/4. */
#define GROWTH 1.5

double mor_soil_contact_hold_factor(double depth)
{
    const double counted = fmin(depth, MOR_SOIL_CONTACT_DEEPEST);
    return depth > 0.0 ? (1.0 + GROWTH * counted) / mor_kernel_plane_share(counted) : 1.0;
}

typedef struct holding {
    mor_soil_contact *contact;
    double smoothing_length; /* m */
    int64_t n_particles;
} holding;

/* Largest depth in some slots, m. */
static void hold_slots(void *job, int64_t first, int64_t last, double *deepest)
{
    const holding *it = job;
    mor_soil_contact *contact = it->contact;
    for (int64_t slot = first; slot < last; ++slot) {
        const bool is_held = mor_soil_contact_is_held(contact, slot); /* its sums are those of the step before */
        for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], it->n_particles); ++k) {
            const int64_t lane = slot * MOR_CLUSTER + k;
            const double distance = contact->seen_faces[MOR_FACE_SUMS * lane + MOR_FACE_DISTANCE];
            if (distance >= 0.0) {
                continue;
            }
            double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
            const double factor = is_held ? 1.0 : mor_soil_contact_hold_factor(-distance / it->smoothing_length);
            for (int a = 0; a < 3; ++a) {
                gradient[a] *= factor;
            }
            deepest[0] = fmax(deepest[0], -distance);
        }
    }
}

void mor_soil_contact_hold(mor_context *context, mor_soil_contact *contact, double smoothing_length,
                           int64_t n_particles)
{
    const mor_blocks blocks = {.n_items = contact->n_slots, .block_items = MOR_CONTACT_GRAIN, .grain = 1};
    holding job = {contact, smoothing_length, n_particles};
    double deepest = -INFINITY;
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_LARGEST, 1, hold_slots, &job, contact->hold, &deepest);
    contact->deepest = fmax(deepest, 0.0);
}

mor_status mor_soil_contact_check_hold(mor_context *context, const mor_soil_contact *contact, const double *records,
                                       double smoothing_length, int64_t n_particles, double time)
{
    const double limit = MOR_SOIL_CONTACT_DEEPEST * smoothing_length;
    if (contact->deepest <= limit) {
        return MOR_OK;
    }
    for (int64_t slot = 0; slot < contact->n_slots; ++slot) {
        const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
        for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
            const double *faces = contact->seen_faces + MOR_FACE_SUMS * (slot * MOR_CLUSTER + k);
            const double *place = records + (first + k) * MOR_RECORD_SIZE;
            MOR_CHECK(
                context, -faces[MOR_FACE_DISTANCE] <= limit, MOR_ERROR_NUMERIC,
                "soil lies %.3g m deep in '%s' at (%.6g, %.6g, %.6g) m, t = %.6g s; a face holds soil up to "
                "%.3g m, 1.2 smoothing lengths, and what lies deeper would pass through it. What presses it there "
                "is too strong for the soil: try a finer spacing, a stiffer soil, or stiffer contacts of rocks",
                -faces[MOR_FACE_DISTANCE], contact->name, place[0], place[1], place[2], time, limit);
        }
    }
    return MOR_OK;
}
