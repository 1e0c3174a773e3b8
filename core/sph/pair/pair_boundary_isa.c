/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The sums that see a boundary. Compiled once per instruction set; MOR_ISA is its name. */
#include "core/particle/boundary.h"
#include "core/sph/pair/pair_lanes.h"

/* Calls a function of a dimension, the last argument, with one that is constant in each copy. */
#define CALL_BY_DIMENSION(call, c, ...) ((c)->dimension == 2 ? call(c, __VA_ARGS__, 2) : call(c, __VA_ARGS__, 3))

INLINE void kernel_part(const mor_pair_constants *c, const mor_pair_kernel_job *job, const int32_t *list, int32_t count,
                        int64_t first, double *out, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    vec sums[MOR_KERNEL_SUMS];
    memset(sums, 0, sizeof sums);
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = job->target + (int64_t)list[entry] * job->target_stride;
        const pair p = pair_of(&f, target, dimension);
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
    store(out, MOR_KERNEL_SUMS, 0, LANES, sums[0] * c->kernel_normalization);
    for (int a = 1; a < MOR_KERNEL_SUMS; ++a) {
        store(out, MOR_KERNEL_SUMS, a, LANES, sums[a] * c->gradient_factor);
    }
}

INLINE void kernel_range(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first, int64_t last,
                         const int dimension)
{
    for (int64_t place = first; place < last; ++place) {
        const mor_pair_slot *slot = job->slots != NULL ? job->slots + place : NULL;
        const int64_t cluster = slot != NULL ? slot->cluster : place;
        const int32_t *list = slot != NULL ? slot->list : job->relation->lists[cluster];
        const int32_t count = slot != NULL ? slot->count : job->relation->counts[cluster];
        for (int64_t part = 0; part < PARTS; ++part) {
            double *out = job->sums + ((place - first) * MOR_CLUSTER + part * LANES) * MOR_KERNEL_SUMS;
            kernel_part(c, job, list, count, cluster * MOR_CLUSTER + part * LANES, out, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_kernel)(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first,
                                   int64_t last)
{
    CALL_BY_DIMENSION(kernel_range, c, job, first, last);
}

/* Stress components that a pass over a chunk sums, by three of the separation: as many sums as stay in registers. */
enum { DIFFERENCES = 3, SUMMED = 6 * 3 };

/* Adds V_j k (stress_i - stress_j)_s (r_i - r_j)_c of the pairs of a chunk, for three of the components s. */
INLINE void add_differences(vec *sum, const geometries *chunk, const double *records, const int32_t *near, int size,
                            const frame *f, const vec *stress, const int *components, const int dimension)
{
    vec part[DIFFERENCES][3];
    for (int s = 0; s < DIFFERENCES; ++s) {
        memcpy(part[s], sum + 3 * components[s], sizeof part[s]);
    }
    for (int q = 0; q < size; ++q) {
        const double *target = records + (int64_t)near[q] * MOR_RECORD_SIZE;
        const geometry g = geometry_at(chunk, q, 0);
        pair p;
        separate(p.r, f, target, dimension);
        for (int a = 0; a < dimension; ++a) {
            p.r[a] *= g.k;
        }
        for (int s = 0; s < DIFFERENCES; ++s) {
            const vec difference = stress[components[s]] - target[MOR_RECORD_STRESS + components[s]];
            for (int a = 0; a < dimension; ++a) {
                part[s][a] = multiply_add(difference, p.r[a], part[s][a]);
            }
        }
    }
    for (int s = 0; s < DIFFERENCES; ++s) {
        memcpy(sum + 3 * components[s], part[s], sizeof part[s]);
    }
}

/* Sums over soil neighbors of V_j k (stress_i - stress_j) (x) (r_i - r_j), the same for all that a cluster sees. */
INLINE void sum_differences(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first, vec *sum,
                            const int dimension)
{
    static const int plane[DIFFERENCES] = {MOR_XX, MOR_YY, MOR_XY}; /* no others act along a plane */
    static const int rest[DIFFERENCES] = {MOR_ZZ, MOR_YZ, MOR_ZX};
    const double *own = job->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    vec stress[6];
    for (int a = 0; a < 6; ++a) {
        stress[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_STRESS + a);
    }
    memset(sum, 0, SUMMED * sizeof *sum);
    const int32_t *near = mor_relation_near(job->inner, first / MOR_CLUSTER);
    const int32_t count = job->inner->near_counts[first / MOR_CLUSTER];
    geometries chunk;
    for (int32_t entry = 0; entry < count; entry += CHUNK) {
        const int size = count - entry < CHUNK ? count - entry : CHUNK;
        for (int q = 0; q < size; ++q) {
            const int32_t later = entry + q + AHEAD < count ? entry + q + AHEAD : entry + q;
            __builtin_prefetch(job->records + (int64_t)near[later] * MOR_RECORD_SIZE);
            __builtin_prefetch(job->records + (int64_t)near[entry + q] * MOR_RECORD_SIZE + MOR_RECORD_STRESS);
            find_geometry(&chunk, q, job->records + (int64_t)near[entry + q] * MOR_RECORD_SIZE, &f, dimension, 0);
        }
        add_differences(sum, &chunk, job->records, near + entry, size, &f, stress, plane, dimension);
        if (dimension == 3) {
            add_differences(sum, &chunk, job->records, near + entry, size, &f, stress, rest, dimension);
        }
    }
}

/* Component a of the sums' contraction with a vector in place of r_i - r_j, and another in place of the stress's. */
INLINE vec contract_row(const vec *sum, int a, const vec *normal)
{
    static const int rows[3][3] = {{MOR_XX, MOR_XY, MOR_ZX}, {MOR_XY, MOR_YY, MOR_YZ}, {MOR_ZX, MOR_YZ, MOR_ZZ}};
    vec total = broadcast(0.0);
    for (int b = 0; b < 3; ++b) {
        const vec *r = sum + 3 * rows[a][b];
        const vec along = multiply_add(r[2], normal[2], multiply_add(r[1], normal[1], r[0] * normal[0]));
        total = multiply_add(along, normal[b], total);
    }
    return total;
}

/* The stress divergence, the parts of grad_i W along and across the boundary of a slot apart: with the sums S,
 * S_abc n_b n_c across it and the rest of S_abb along it. */
INLINE void split_divergence(const mor_pair_constants *c, const vec *sum, const vec *normal, vec length2, double *out)
{
    /* No normal where the boundary is out of reach. */
    const mask sees = length2 > 0.0;
    const vec inverse = select_lanes(sees, 1.0 / length2, broadcast(0.0));
    const vec all[3] = {sum[3 * MOR_XX + 0] + sum[3 * MOR_XY + 1] + sum[3 * MOR_ZX + 2],
                        sum[3 * MOR_XY + 0] + sum[3 * MOR_YY + 1] + sum[3 * MOR_YZ + 2],
                        sum[3 * MOR_ZX + 0] + sum[3 * MOR_YZ + 1] + sum[3 * MOR_ZZ + 2]};
    for (int a = 0; a < 3; ++a) {
        const vec across = contract_row(sum, a, normal) * inverse;
        const vec along = all[a] - across;
        store(out, 6, a, LANES, select_lanes(sees, c->gradient_factor * along, broadcast(0.0)));
        store(out, 6, 3 + a, LANES, select_lanes(sees, c->gradient_factor * across, broadcast(0.0)));
    }
}

/* The parts of the divergence of all slots of one cluster. */
INLINE void tangent_part(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first, int64_t last,
                         int64_t lane, const int dimension)
{
    vec sum[SUMMED];
    bool is_summed = false;
    memset(sum, 0, sizeof sum);
    for (int64_t place = first; place < last; ++place) {
        const int64_t slot = place * MOR_CLUSTER + lane;
        const double *gradients = job->sums + slot * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
        vec n[3];
        for (int a = 0; a < 3; ++a) {
            n[a] = load(gradients, MOR_KERNEL_SUMS, a);
        }
        const vec length2 = multiply_add(n[2], n[2], multiply_add(n[1], n[1], n[0] * n[0]));
        if (!is_summed && any_less(-length2, 0.0)) {
            sum_differences(c, job, (int64_t)job->slots[first].cluster * MOR_CLUSTER + lane, sum, dimension);
            is_summed = true;
        }
        split_divergence(c, sum, n, length2, job->out + slot * 6);
    }
}

INLINE void tangent_range(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first, int64_t last,
                          const int dimension)
{
    for (int64_t end = first; first < last; first = end) {
        while (end < last && job->slots[end].cluster == job->slots[first].cluster) {
            ++end;
        }
        for (int64_t part = 0; part < PARTS; ++part) {
            tangent_part(c, job, first, end, part * LANES, dimension);
        }
    }
}

void MOR_ISA_NAME(mor_pair_tangent)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first,
                                    int64_t last)
{
    CALL_BY_DIMENSION(tangent_range, c, job, first, last);
}

/* Sum V W v / sum V W over the points of a slot. */
INLINE void mean_part(const mor_pair_constants *c, const mor_pair_mean_job *job, const mor_pair_slot *slot,
                      int64_t first, double *out, const int dimension)
{
    const frame f = frame_of(c, job->source + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    vec sum[3];
    vec total = broadcast(0.0);
    memset(sum, 0, sizeof sum);
    for (int32_t entry = 0; entry < slot->count; ++entry) {
        const double *target = job->target + (int64_t)slot->list[entry] * MOR_BOUNDARY_RECORD;
        const double *value = job->values + slot->list[entry] * job->value_stride;
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
    for (int32_t entry = 0; entry < slot->count; ++entry) {
        const double *target = job->target + (int64_t)slot->list[entry] * MOR_BOUNDARY_RECORD;
        const double *n = job->normals + 3 * (int64_t)slot->list[entry];
        const pair p = pair_of(&f, target, dimension);
        const vec plane = dot_r(&p, broadcast(n[0]), broadcast(n[1]), broadcast(n[2]), dimension) -
                          job->depths[slot->list[entry]] -
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
    for (int32_t entry = 0; entry < slot->count; ++entry) {
        const double *target = job->target + (int64_t)slot->list[entry] * MOR_BOUNDARY_RECORD;
        double *force = job->force + (int64_t)slot->list[entry] * 3;
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
