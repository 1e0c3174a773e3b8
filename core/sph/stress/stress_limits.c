/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/stress/stress_limits.h"

#include "core/base/reduce.h"
#include "core/material/piece.h"
#include "core/sph/stress/stress_update.h"

#include <math.h>
#include <stdbool.h>

/* Values of a block: the largest wave speed, and the longest step with the other sign, for both are to be largest. */
enum { SPEED, SHORTEST };

typedef struct limits_job {
    const mor_material_instance *material;
    const mor_batch *batch;
    bool has_speed;
} limits_job;

static void take(mor_status status, const double *numbers, int64_t n, double sign, double *value)
{
    for (int64_t i = 0; i < n; ++i) {
        *value = mor_larger(status == MOR_OK ? sign * numbers[i] : NAN, *value);
    }
}

static void find_block(void *owner, int64_t first, int64_t last, double *values)
{
    const limits_job *job = owner;
    const mor_material_instance *law = job->material;
    double numbers[MOR_STRESS_BATCH];
    mor_piece cut;
    mor_piece_cut(law->material->state, law->n_state, job->batch, first, last - first, &cut);
    take(law->operations.max_step(law, &cut.batch, numbers), numbers, cut.batch.n, -1.0, &values[SHORTEST]);
    if (job->has_speed) {
        take(law->operations.wave_speed(law, &cut.batch, numbers), numbers, cut.batch.n, 1.0, &values[SPEED]);
    }
}

mor_stress_limits mor_stress_find_limits(int n_threads, const mor_material_instance *material, const mor_batch *batch,
                                         double *partial)
{
    const mor_blocks blocks = {.n_items = batch->n, .block_items = MOR_STRESS_BATCH, .grain = 1};
    limits_job job = {.material = material,
                      .batch = batch,
                      .has_speed = (material->material->capabilities & MOR_MATERIAL_STIFFENS) != 0};
    double values[MOR_STRESS_LIMIT_VALUES] = {[SPEED] = -INFINITY, [SHORTEST] = -INFINITY};
    mor_reduce(&blocks, n_threads, MOR_REDUCE_LARGEST, MOR_STRESS_LIMIT_VALUES, find_block, &job, partial, values);
    return (mor_stress_limits){.speed = job.has_speed ? values[SPEED] : 0.0, .step = -values[SHORTEST]};
}
