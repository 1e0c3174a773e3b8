/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair_pack.h"

#include "core/base/parallel.h"

void mor_pair_pack_extra(mor_context *context, const mor_pair_extra_job *job, double *extra)
{
    const double none[3] = {0.0, 0.0, 0.0};
    const int64_t n = job->n_particles;
    MOR_PARALLEL_FOR (context, cluster, (n + MOR_CLUSTER - 1) / MOR_CLUSTER, MOR_BLOCK / MOR_CLUSTER) {
        const bool changes = job->changing == NULL || job->changing[cluster] != 0;
        for (int64_t i = cluster * MOR_CLUSTER; changes && i < (cluster + 1) * MOR_CLUSTER && i < n; ++i) {
            double *own = extra + i * MOR_EXTRA_SIZE;
            mor_pair_pack_shears(job->stress + 6 * i, job->spin != NULL ? job->spin + 3 * i : none, own);
            memcpy(own + MOR_EXTRA_HOURGLASS, job->hourglass != NULL ? job->hourglass + 3 * i : none, sizeof none);
            if (job->is_whole) {
                memset(own + MOR_EXTRA_FLOW, 0, (MOR_EXTRA_SIZE - MOR_EXTRA_FLOW) * sizeof *own);
            }
            if (job->mean != NULL) {
                own[MOR_EXTRA_FLOW] = job->flow[i];
                memcpy(own + MOR_EXTRA_MEAN, job->mean + 6 * i, 6 * sizeof *own);
            }
        }
    }
}
