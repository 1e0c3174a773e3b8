/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The stress divergence by soil neighbors, along and across boundaries apart. Compiled once per instruction set;
 * MOR_ISA is its name. */
#include "core/sph/pair/pair_lanes.h"

#include <stdbool.h>

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

/* Whether any particle of a cluster reaches any of its slots. */
INLINE bool reaches_any(const mor_pair_tangent_job *job, int64_t first, int64_t last)
{
    bool any = false;
    for (int64_t lane = first * MOR_CLUSTER; lane < last * MOR_CLUSTER; ++lane) {
        const double *n = job->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
        any |= n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
    }
    return any;
}

/* The parts of the divergence of all slots of one cluster. */
INLINE void tangent_cluster(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first, int64_t last)
{
    const int64_t cluster = job->slots[first].cluster;
    double sums[MOR_PAIR_DIFFERENCES][MOR_CLUSTER];
    if (!reaches_any(job, first, last)) {
        memset(job->out + first * MOR_CLUSTER * 6, 0, (size_t)((last - first) * MOR_CLUSTER * 6) * sizeof *job->out);
        return;
    }
    if (job->singles != NULL && job->is_wide[cluster] == 0) {
        MOR_ISA_NAME(mor_pair_mixed_differences)(c, job, cluster, sums);
    } else {
        MOR_ISA_NAME(mor_pair_differences)(c, job, cluster, sums);
    }
    for (int64_t lane = 0; lane < MOR_CLUSTER; lane += LANES) {
        vec sum[MOR_PAIR_DIFFERENCES];
        for (int k = 0; k < MOR_PAIR_DIFFERENCES; ++k) {
            sum[k] = load(sums[k] + lane, 1, 0);
        }
        for (int64_t place = first; place < last; ++place) {
            const int64_t slot = place * MOR_CLUSTER + lane;
            const double *gradients = job->sums + slot * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
            vec n[3];
            for (int a = 0; a < 3; ++a) {
                n[a] = load(gradients, MOR_KERNEL_SUMS, a);
            }
            const vec length2 = multiply_add(n[2], n[2], multiply_add(n[1], n[1], n[0] * n[0]));
            split_divergence(c, sum, n, length2, job->out + slot * 6);
        }
    }
}

void MOR_ISA_NAME(mor_pair_tangent)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first,
                                    int64_t last)
{
    for (int64_t end = first; first < last; first = end) {
        while (end < last && job->slots[end].cluster == job->slots[first].cluster) {
            ++end;
        }
        tangent_cluster(c, job, first, end);
    }
}
