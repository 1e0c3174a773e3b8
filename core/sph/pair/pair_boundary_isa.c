/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The sums that see a boundary. Compiled once per instruction set; MOR_ISA is its name. */
#include "core/particle/boundary.h"
#include "core/sph/pair/pair_lanes.h"

/* Calls a function of a dimension, the last argument, with one that is constant in each copy. */
#define CALL_BY_DIMENSION(call, c, ...) ((c)->dimension == 2 ? call(c, __VA_ARGS__, 2) : call(c, __VA_ARGS__, 3))

/* Adds the kernel of the targets of a list, shape [count], to sums, shape [MOR_KERNEL_SUMS]. */
INLINE void add_kernels(vec *sums, const frame *f, const mor_pair_kernel_job *job, const int32_t *list, int32_t count,
                        const int dimension)
{
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = job->target + (int64_t)list[entry] * job->target_stride;
        const pair p = pair_of(f, target, dimension);
        const vec cube = p.reach * p.reach * p.reach * target[MOR_RECORD_VOLUME];
        sums[MOR_KERNEL_SUM_VALUE] += cube * p.reach * (5.0 - 4.0 * p.reach);
        vec kr[3];
        for (int a = 0; a < dimension; ++a) {
            kr[a] = cube * p.r[a];
            sums[MOR_KERNEL_SUM_GRADIENT + a] -= kr[a];
            sums[MOR_KERNEL_SUM_MOMENT + a] += kr[a] * p.r[a];
        }
        for (int a = 0; a < 2 * dimension - 3; ++a) {
            sums[MOR_KERNEL_SUM_MOMENT + 3 + a] += kr[a] * p.r[(a + 1) % 3];
        }
    }
}

/* The sums of a part of a cluster over the short list of a slot, or all that the cluster lists. */
INLINE void kernel_part(const mor_pair_constants *c, const mor_pair_kernel_job *job, const mor_pair_slot *slot,
                        int64_t first, double *out, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    vec sums[MOR_KERNEL_SUMS];
    memset(sums, 0, sizeof sums);
    mor_list_reader reader;
    if (slot != NULL) {
        mor_list_open_entries(&reader, slot->near, slot->n_near);
    } else {
        mor_list_open(&reader, job->relation, first / MOR_CLUSTER);
    }
    while (mor_list_next(&reader)) {
        add_kernels(sums, &f, job, reader.block, reader.n, dimension);
    }
    store(out, MOR_KERNEL_SUMS, 0, LANES, sums[0] * c->kernel_normalization);
    for (int a = 1; a < MOR_KERNEL_SUMS; ++a) {
        store(out, MOR_KERNEL_SUMS, a, LANES, sums[a] * c->gradient_factor);
    }
}

/* Squared distance from which on a point is out of reach, over that of the support: rounding never leaves one out. */
#define OUT_OF_REACH (1.0 + 0x1p-40)

/* Writes the targets of a list that any particle of a cluster reaches, in their order; returns how many. */
INLINE int32_t find_near(const mor_pair_constants *c, const mor_pair_kernel_job *job, const mor_pair_slot *slot,
                         const int dimension)
{
    const double *own = job->source + (int64_t)slot->cluster * MOR_CLUSTER * MOR_RECORD_SIZE;
    const double support2 = 4.0 * c->smoothing_length * c->smoothing_length * OUT_OF_REACH;
    frame f[PARTS];
    int32_t n = 0;
    for (int part = 0; part < PARTS; ++part) {
        f[part] = frame_of(c, own + (int64_t)part * LANES * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    }
    for (int32_t entry = 0; entry < slot->count; ++entry) {
        const double *target = job->target + (int64_t)slot->list[entry] * job->target_stride;
        const int32_t later = slot->list[entry + AHEAD < slot->count ? entry + AHEAD : entry];
        vec nearest = broadcast(INFINITY);
        __builtin_prefetch(job->target + (int64_t)later * job->target_stride);
        for (int part = 0; part < PARTS; ++part) {
            vec r[3];
            separate(r, &f[part], target, dimension);
            nearest = smaller(squared(r, &f[part], dimension), nearest);
        }
        slot->near[n] = slot->list[entry];
        n += any_less(nearest, support2) != 0;
    }
    return n;
}

INLINE void kernel_range(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first, int64_t last,
                         const int dimension)
{
    for (int64_t place = first; place < last; ++place) {
        mor_pair_slot *slot = job->slots != NULL ? job->slots + place : NULL;
        if (slot != NULL) {
            slot->n_near = find_near(c, job, slot, dimension);
        }
        const int64_t cluster = slot != NULL ? slot->cluster : place;
        for (int64_t part = 0; part < PARTS; ++part) {
            double *out = job->sums + ((place - first) * MOR_CLUSTER + part * LANES) * MOR_KERNEL_SUMS;
            kernel_part(c, job, slot, cluster * MOR_CLUSTER + part * LANES, out, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_kernel)(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first,
                                   int64_t last)
{
    CALL_BY_DIMENSION(kernel_range, c, job, first, last);
}

/* Sum V W v / sum V W over the points of a slot. */
INLINE void mean_part(const mor_pair_constants *c, const mor_pair_mean_job *job, const mor_pair_slot *slot,
                      int64_t first, double *out, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    vec sum[3];
    vec total = broadcast(0.0);
    memset(sum, 0, sizeof sum);
    for (int32_t entry = 0; entry < slot->n_near; ++entry) {
        const double *target = job->target + (int64_t)slot->near[entry] * MOR_BOUNDARY_RECORD;
        const double *value = job->values + slot->near[entry] * job->value_stride;
        const pair p = pair_of(&f, target, dimension);
        const vec square = p.reach * p.reach;
        const vec weight = square * square * (5.0 - 4.0 * p.reach) * target[MOR_BOUNDARY_VOLUME];
        total += weight;
        for (int a = 0; a < dimension; ++a) {
            sum[a] += weight * value[a];
        }
    }
    const vec inverse = select_lanes(total > 0.0, 1.0 / total, broadcast(0.0));
    for (int a = 0; a < 3; ++a) {
        store(out, 3, a, LANES, sum[a] * inverse);
    }
}

INLINE void mean_range(const mor_pair_constants *c, const mor_pair_mean_job *job, int64_t first, int64_t last,
                       const int dimension)
{
    for (int64_t place = first; place < last; ++place) {
        const mor_pair_slot *slot = job->slots + place;
        for (int64_t part = 0; part < PARTS; ++part) {
            const int64_t lane = part * LANES;
            mean_part(c, job, slot, (int64_t)slot->cluster * MOR_CLUSTER + lane,
                      job->out + (place * MOR_CLUSTER + lane) * 3, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_mean)(const mor_pair_constants *c, const mor_pair_mean_job *job, int64_t first, int64_t last)
{
    CALL_BY_DIMENSION(mean_range, c, job, first, last);
}

/* A point within a spacing counts in full for the distance from a boundary: any particle in it has such points, and one
 * that has none is outside. Farther ones count the less, by twice the way beyond. */
#define FAR_FACE 2.0

/* Sum V (1 - (q/2)^4) n (x) n over the points of a slot, and the distance from the planes of their faces. */
INLINE void faces_part(const mor_pair_constants *c, const mor_pair_faces_job *job, const mor_pair_slot *slot,
                       int64_t first, double *out, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    const double h = c->smoothing_length;
    vec sum[6];
    vec distance = broadcast(-INFINITY);
    vec nearest = broadcast(0.0);
    memset(sum, 0, sizeof sum);
    for (int32_t entry = 0; entry < slot->n_near; ++entry) {
        const double *target = job->target + (int64_t)slot->near[entry] * MOR_BOUNDARY_RECORD;
        const double *n = job->normals + 3 * (int64_t)slot->near[entry];
        const pair p = pair_of(&f, target, dimension);
        const vec plane = dot_r(&p, broadcast(n[0]), broadcast(n[1]), broadcast(n[2]), dimension) -
                          job->depths[slot->near[entry]] -
                          FAR_FACE * positive_part(2.0 * h * (1.0 - p.reach) - c->spacing);
        const bool has_face = n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
        nearest = has_face ? larger(nearest, p.reach) : nearest;
        distance = has_face ? select_lanes(p.reach > 0.0, larger(distance, plane), distance) : distance;
        const vec far = (1.0 - p.reach) * (1.0 - p.reach);
        const vec weight = (1.0 - far * far) * target[MOR_BOUNDARY_VOLUME];
        for (int a = 0; a < dimension; ++a) {
            sum[a] += weight * (n[a] * n[a]);
        }
        for (int a = 0; a < 2 * dimension - 3; ++a) {
            sum[3 + a] += weight * (n[a] * n[(a + 1) % 3]);
        }
    }
    for (int a = 0; a < 6; ++a) {
        store(out, MOR_FACE_SUMS, MOR_FACE_TENSOR + a, LANES, sum[a]);
    }
    const vec found = select_lanes(nearest >= 1.0 - 0.5 * c->spacing / h, distance, broadcast(INFINITY));
    store(out, MOR_FACE_SUMS, MOR_FACE_DISTANCE, LANES, found);
}

INLINE void faces_range(const mor_pair_constants *c, const mor_pair_faces_job *job, int64_t first, int64_t last,
                        const int dimension)
{
    for (int64_t place = first; place < last; ++place) {
        const mor_pair_slot *slot = job->slots + place;
        for (int64_t part = 0; part < PARTS; ++part) {
            const int64_t lane = part * LANES;
            faces_part(c, job, slot, (int64_t)slot->cluster * MOR_CLUSTER + lane,
                       job->out + (place * MOR_CLUSTER + lane) * MOR_FACE_SUMS, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_faces)(const mor_pair_constants *c, const mor_pair_faces_job *job, int64_t first,
                                  int64_t last)
{
    CALL_BY_DIMENSION(faces_range, c, job, first, last);
}

/* Lanes are added one by one, so that a point's force does not depend on their number. */
INLINE void share_part(const mor_pair_constants *c, const mor_pair_share_job *job, const mor_pair_slot *slot,
                       int64_t first, const double *given, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    vec g[MOR_SHARES];
    for (int a = 0; a < MOR_SHARES; ++a) {
        g[a] = load(given, MOR_SHARES, a);
    }
    const vec *d = g + MOR_SHARE_DIRECTION;
    const vec by_value = g[MOR_SHARE_VALUE] * c->kernel_normalization;
    for (int32_t entry = 0; entry < slot->n_near; ++entry) {
        const double *target = job->target + (int64_t)slot->near[entry] * MOR_BOUNDARY_RECORD;
        double *force = job->force + (int64_t)slot->near[entry] * 3;
        const pair p = pair_of(&f, target, dimension);
        const vec cube = p.reach * p.reach * p.reach * target[MOR_BOUNDARY_VOLUME];
        const vec along = dot_r(&p, d[0], d[1], d[2], dimension);
        const vec by_gradient = c->gradient_factor * along;
        const vec weight = cube * multiply_add(by_value * p.reach, 5.0 - 4.0 * p.reach, -by_gradient);
        for (int a = 0; a < dimension; ++a) {
            const vec part = weight * g[MOR_SHARE_FORCE + a];
            for (int lane = 0; lane < LANES; ++lane) {
                force[a] += part[lane];
            }
        }
    }
}

INLINE void share_range(const mor_pair_constants *c, const mor_pair_share_job *job, int64_t first, int64_t last,
                        const int dimension)
{
    for (int64_t k = first; k < last; ++k) {
        const int64_t place = job->chosen[k];
        const mor_pair_slot *slot = job->slots + place;
        for (int64_t part = 0; part < PARTS; ++part) {
            const int64_t lane = part * LANES;
            share_part(c, job, slot, (int64_t)slot->cluster * MOR_CLUSTER + lane,
                       job->given + (place * MOR_CLUSTER + lane) * MOR_SHARES, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_share)(const mor_pair_constants *c, const mor_pair_share_job *job, int64_t first,
                                  int64_t last)
{
    CALL_BY_DIMENSION(share_range, c, job, first, last);
}
