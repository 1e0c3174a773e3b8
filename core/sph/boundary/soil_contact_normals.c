/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Kernel gradients over boundaries whose faces have normals: along the normal at a face, whole where faces with
 * different normals are seen. */
#include "core/sph/boundary/soil_contact_internal.h"

#include "core/base/eigen.h"
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/lanes/soil_lanes.h"

#include <math.h>
#include <string.h>

enum { GRAIN = MOR_CONTACT_GRAIN };

/* Principal values of the faces seen, their sum being 1, that tell a direction in which several bear: below
 * MOR_FACES_ALIKE they are taken for one, from MEET (33 degrees) on for two. Down to a quarter of these, edges and
 * corners close to the ripple of the lattice; at twice an edge misses 7 %. */
#define MEET 0.08

/* How far a direction is one of the faces seen; share: principal value of a sum of 1. */
static double fade(double share)
{
    return mor_min(mor_max((share - MOR_FACES_ALIKE) / (MEET - MOR_FACES_ALIKE), 0.0), 1.0);
}

/* Principal directions of the faces seen: values, axes in columns, and how far faces bear in each, 0 to 1. */
typedef struct bearing {
    double values[3];
    double axes[9];
    double shares[3];
} bearing;

static void find_bearing(const double *faces, const mor_face_normals *found, int64_t lane, bearing *b)
{
    const double trace = mor_symmetric_trace(faces);
    if (found->has_axes[lane] == 0) {
        mor_symmetric_eigen(faces, b->values, b->axes);
    } else {
        for (int k = 0; k < 9; ++k) {
            b->values[k / 3] = found->values[k / 3][lane];
            b->axes[k] = found->axes[k][lane];
        }
    }
    const double largest = mor_max(mor_max(b->values[0], b->values[1]), b->values[2]);
    for (int k = 0; k < 3; ++k) {
        b->shares[k] = b->values[k] == largest ? 1.0 : fade(b->values[k] / trace);
    }
}

/* What is left of the faces seen: one direction, or several. */
typedef struct directions {
    bool is_one;      /* faces count as one */
    bool is_plane;    /* they are one, but for rounding */
    double normal[3]; /* of that one */
    double value;     /* its principal value; not of a plane */
    bearing several;  /* otherwise */
} directions;

/* Takes those of a lane from what was found of eight. */
static void take_directions(const double *faces, const mor_face_normals *found, int64_t lane, directions *d)
{
    d->is_one = found->is_one[lane] != 0;
    d->is_plane = found->is_plane[lane] != 0;
    d->value = found->value[lane];
    for (int a = 0; a < 3; ++a) {
        d->normal[a] = found->normal[a][lane];
    }
    if (!d->is_one) {
        find_bearing(faces, found, lane, &d->several);
    }
}

/* Part of a vector in the directions in which faces bear, its components divided by the principal values if asked. */
static void filter(const bearing *b, bool is_divided, double *vector)
{
    double kept[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3; ++k) {
        const double axis[3] = {b->axes[k], b->axes[3 + k], b->axes[6 + k]};
        const double scale = b->shares[k] > 0.0 && is_divided ? b->shares[k] / b->values[k] : b->shares[k];
        const double part = scale * mor_vector_dot(vector, axis);
        for (int a = 0; a < 3; ++a) {
            kept[a] += part * axis[a];
        }
    }
    memcpy(vector, kept, sizeof kept);
}

/* What the rest of several faces weighs along each: the least that sums up to it, y with F y = P(F) rest. */
static void solve_corner(const directions *d, mor_contact_corner *corner)
{
    corner->is_solved = true;
    if (d->is_plane) {
        memset(corner->rest, 0, sizeof corner->rest);
        memset(corner->faces, 0, sizeof corner->faces);
    } else if (d->is_one) {
        /* F and P(F) have one direction. */
        const double part = mor_vector_dot(corner->rest, d->normal) / d->value;
        for (int a = 0; a < 3; ++a) {
            corner->rest[a] = part * d->normal[a];
            corner->faces[a] = d->normal[a] * d->normal[a];
            corner->faces[3 + a] = d->normal[a] * d->normal[(a + 1) % 3];
        }
    } else {
        const bearing *b = &d->several;
        filter(b, true, corner->rest);
        for (int a = 0; a < 6; ++a) {
            const double *row = b->axes + 3 * (a % 3);
            const double *column = b->axes + 3 * (a < 3 ? a : (a - 2) % 3);
            corner->faces[a] = b->shares[0] * row[0] * column[0] + b->shares[1] * row[1] * column[1] +
                               b->shares[2] * row[2] * column[2];
        }
    }
}

/* Keeps of the kernel gradient of a lane what its own faces bear, and notes the rest for corners. What is listed, but
 * out of reach, leaves no trace. Where no other faces are seen, the directions serve the corner, too. */
static void project_lane(const double *faces, const mor_face_normals *found, int64_t lane, bool limits, bool is_alone,
                         double *gradient, double *rest, mor_contact_corner *corner)
{
    directions own;
    memset(rest, 0, 3 * sizeof *rest);
    if (!(mor_symmetric_trace(faces) > 0.0)) {
        return;
    }
    if (!corner->sees_any) {
        *corner = (mor_contact_corner){.sees_any = true};
    }
    corner->is_limited |= limits;
    double kept[3] = {gradient[0], gradient[1], gradient[2]};
    take_directions(faces, found, lane, &own);
    if (own.is_one) {
        const double along = mor_vector_dot(gradient, own.normal);
        for (int a = 0; a < 3; ++a) {
            kept[a] = along * own.normal[a];
        }
    } else {
        filter(&own.several, false, kept);
    }
    for (int a = 0; a < 3; ++a) {
        rest[a] = gradient[a] - kept[a];
        corner->rest[a] += rest[a];
        gradient[a] = kept[a];
    }
    for (int a = 0; a < 6; ++a) {
        corner->faces[a] += faces[a];
    }
    if (is_alone) {
        solve_corner(&own, corner);
    }
}

static bool may_have_coulomb_friction(const mor_boundary_patch *patch)
{
    return patch->friction == MOR_WALL_COULOMB || patch->friction_of_soil != NULL;
}

void mor_soil_contact_project(mor_context *context, mor_soil_contact *contact, int64_t n_particles, bool coulomb_pulls,
                              const mor_wall_clusters *at)
{
    const mor_soil_lanes *lanes = mor_soil_lanes_select(NULL);
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        const bool is_held = mor_sleep_is(contact->sleep, contact->relation.occupied[place], MOR_SLEEP_HELD);
        for (int64_t slot = contact->first_slot[place]; !is_held && slot < contact->first_slot[place + 1]; ++slot) {
            mor_face_normals found;
            lanes->find_normals(contact->seen_faces + MOR_FACE_SUMS * MOR_CLUSTER * slot, MOR_FACE_SUMS, &found);
            mor_contact_corner *corners =
                at->corners + mor_wall_clusters_first(at->places, contact->slots[slot].cluster);
            const bool is_alone = at->n_patches != NULL && at->n_patches[contact->slots[slot].cluster] == 1;
            const bool limits = mor_soil_contact_limits_all(contact, coulomb_pulls) &&
                                may_have_coulomb_friction(&contact->boundary->patches[contact->slots[slot].patch]);
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
                const int64_t lane = slot * MOR_CLUSTER + k;
                double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
                if (contact->given != NULL) {
                    memcpy(contact->given + lane * MOR_SHARES + MOR_SHARE_DIRECTION, gradient, 3 * sizeof *gradient);
                }
                project_lane(contact->seen_faces + MOR_FACE_SUMS * lane, &found, k, limits, is_alone, gradient,
                             contact->transfer + 3 * lane, corners + k);
            }
        }
    }
}

/* Of n particles that stand together, at most eight. */
static void solve_cluster(const mor_soil_lanes *lanes, mor_contact_corner *corners, int64_t n)
{
    double faces[MOR_CLUSTER][6] = {{0.0}};
    mor_face_normals found;
    bool is_any = false;
    for (int64_t k = 0; k < n; ++k) {
        is_any = is_any || (corners[k].sees_any && !corners[k].is_solved);
        memcpy(faces[k], corners[k].faces, sizeof faces[k]);
    }
    if (!is_any) {
        return;
    }
    lanes->find_normals(faces[0], 6, &found);
    for (int64_t k = 0; k < n; ++k) {
        if (corners[k].sees_any && !corners[k].is_solved) {
            directions d;
            take_directions(faces[k], &found, k, &d);
            solve_corner(&d, corners + k);
        }
    }
}

void mor_soil_contact_solve_corners(mor_context *context, int64_t n_particles, const int8_t *sleep,
                                    const mor_wall_clusters *at)
{
    const mor_soil_lanes *lanes = mor_soil_lanes_select(NULL);
    MOR_PARALLEL_FOR (context, cluster, (n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER, MOR_BLOCK / MOR_CLUSTER) {
        const bool is_held = mor_sleep_is(sleep, cluster, MOR_SLEEP_HELD);
        const int64_t first = mor_wall_clusters_first(at->places, cluster);
        const int64_t left = n_particles - cluster * MOR_CLUSTER;
        if (!is_held && first >= 0) {
            solve_cluster(lanes, at->corners + first, left < MOR_CLUSTER ? left : MOR_CLUSTER);
        }
    }
}

void mor_soil_contact_close_corners(mor_context *context, mor_soil_contact *contact, int64_t n_particles,
                                    const mor_wall_clusters *at)
{
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        const bool is_held = mor_sleep_is(contact->sleep, contact->relation.occupied[place], MOR_SLEEP_HELD);
        for (int64_t slot = contact->first_slot[place]; !is_held && slot < contact->first_slot[place + 1]; ++slot) {
            const mor_contact_corner *own =
                at->corners + mor_wall_clusters_first(at->places, contact->slots[slot].cluster);
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n_particles); ++k) {
                const int64_t lane = slot * MOR_CLUSTER + k;
                double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
                double *transfer = contact->transfer + 3 * lane;
                double more[3];
                double brought[3];
                if (own[k].sees_any) {
                    mor_symmetric_apply(contact->seen_faces + MOR_FACE_SUMS * lane, own[k].rest, more);
                    mor_symmetric_apply(own[k].faces, transfer, brought);
                    for (int a = 0; a < 3; ++a) {
                        gradient[a] += more[a];
                        transfer[a] = own[k].is_limited ? 0.0 : brought[a] - more[a];
                    }
                }
            }
        }
    }
}
