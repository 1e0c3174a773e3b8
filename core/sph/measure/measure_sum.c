/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure_sum.h"

#include "core/base/parallel.h"
#include "core/sph/measure/measure_fill.h"

/* Chunks are so many whatever the number of threads, so that no sum depends on that. */
enum { CHUNKS = 64, BATCH = 256, FEW = 4 * MOR_BLOCK };

/* Whose terms are summed. */
typedef struct summation {
    mor_sum_fill fill;
    const void *job;
} summation;

static void sum_chunk(void *job, int64_t first, int64_t last, double *values)
{
    const summation *it = job;
    mor_measure_lanes sums = {{0.0}, {0.0}};
    mor_sum sum = {0.0, 0.0};
    double terms[BATCH];
    const mor_measure_fill_table *fills = mor_measure_fills();
    for (int64_t i = first; i < last; i += BATCH) {
        const int64_t n = last - i < BATCH ? last - i : BATCH;
        it->fill(it->job, i, n, terms);
        fills->add(&sums, terms, n);
    }
    for (int k = 0; k < MOR_MEASURE_LANES; ++k) {
        mor_sum_add(&sum, sums.high[k]);
        mor_sum_add(&sum, sums.low[k]);
    }
    values[0] = sum.high;
    values[1] = sum.low;
}

mor_measure_team mor_measure_team_for(int64_t n, int n_threads)
{
    return (mor_measure_team){n < FEW || n_threads < 1 ? 1 : n_threads};
}

double mor_sum_over(int64_t n, int n_threads, mor_sum_fill fill, const void *job)
{
    const mor_blocks blocks = {.n_items = n, .n_blocks = CHUNKS, .grain = 1};
    summation terms = {fill, job};
    double sums[2 * CHUNKS];
    double sum[2] = {0.0, 0.0};
    mor_reduce(&blocks, mor_measure_team_for(n, n_threads).n_threads, MOR_REDUCE_COMPENSATED, 2, sum_chunk, &terms,
               sums, sum);
    return mor_sum_value((mor_sum){sum[0], sum[1]});
}

void mor_fill_over(int64_t n, int n_threads, mor_sum_fill fill, const void *job, double *values)
{
    const mor_measure_team team = mor_measure_team_for(n, n_threads);
    MOR_PARALLEL_FOR (&team, block, mor_block_count(n), 1) {
        const int64_t first = block * MOR_BLOCK;
        fill(job, first, mor_block_end(block, n) - first, values + first);
    }
}
