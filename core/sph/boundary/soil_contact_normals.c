/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Kernel gradients over boundaries whose faces have normals: along the normal at a face, along those of all faces where
 * several meet. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/eigen.h"
#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = MOR_CONTACT_GRAIN };

/* Principal values of the sum of the normals' squares that tell a direction which several faces share: from MEET on
 * they meet at an angle there, below ALIKE they are taken for one. 1 - cos(angle) of two faces. */
#define ALIKE 0.1
#define MEET 0.3

/* Keeps of the kernel gradient of a lane what lies along its normal, and notes the rest for corners. */
static void project_lane(double *normal, double *gradient, mor_contact_corner *corner)
{
    const double length = mor_vector_length(normal);
    if (!(length > 0.0)) {
        return;
    }
    for (int a = 0; a < 3; ++a) {
        normal[a] /= length;
    }
    if (corner->n_faces == 0) {
        memset(corner, 0, sizeof *corner);
    }
    const double along = mor_vector_dot(gradient, normal);
    corner->n_faces += 1;
    for (int a = 0; a < 3; ++a) {
        corner->rest[a] += gradient[a] - along * normal[a];
        corner->normals[a] += normal[a] * normal[a];
        corner->normals[3 + a] += normal[a] * normal[(a + 1) % 3];
        gradient[a] = along * normal[a];
    }
}

/* What the rest of several faces weighs along each: the least that sums up to it, y with G y = rest. */
static void solve_corner(mor_contact_corner *corner)
{
    double values[3];
    double axes[9];
    double solved[3] = {0.0, 0.0, 0.0};
    mor_symmetric_eigen(corner->normals, values, axes);
    for (int k = 0; k < 3; ++k) {
        const double axis[3] = {axes[k], axes[3 + k], axes[6 + k]};
        const double share = fmin(fmax((values[k] - ALIKE) / (MEET - ALIKE), 0.0), 1.0);
        const double part = share > 0.0 ? share * mor_vector_dot(corner->rest, axis) / values[k] : 0.0;
        for (int a = 0; a < 3; ++a) {
            solved[a] += part * axis[a];
        }
    }
    memcpy(corner->rest, solved, sizeof solved);
}

void mor_soil_contact_project(mor_context *context, mor_soil_contact *contact, int64_t n_particles,
                              mor_contact_corner *corners)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
                const int64_t lane = slot * MOR_CLUSTER + k;
                project_lane(contact->seen_normals + 3 * lane,
                             contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT, corners + first + k);
            }
        }
    }
}

void mor_soil_contact_solve_corners(mor_context *context, int64_t n_particles, mor_contact_corner *corners)
{
    MOR_PARALLEL_FOR (context, i, n_particles, MOR_BLOCK) {
        if (corners[i].n_faces > 1) {
            solve_corner(corners + i);
        }
    }
}

void mor_soil_contact_close_corners(mor_context *context, mor_soil_contact *contact, int64_t n_particles,
                                    const mor_contact_corner *corners)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const mor_contact_corner *own = corners + (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
                const int64_t lane = slot * MOR_CLUSTER + k;
                const double *normal = contact->seen_normals + 3 * lane;
                double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
                const double more = own[k].n_faces > 1 ? mor_vector_dot(own[k].rest, normal) : 0.0;
                for (int a = 0; a < 3; ++a) {
                    gradient[a] += more * normal[a];
                }
            }
        }
    }
}
