/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/reduce.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

int64_t mor_blocks_count(const mor_blocks *blocks)
{
    const int64_t size = blocks->block_items;
    return size > 0 ? (blocks->n_items + size - 1) / size : blocks->n_blocks;
}

int64_t mor_blocks_first(const mor_blocks *blocks, int64_t block)
{
    if (blocks->block_items == 0) {
        return block * blocks->n_items / blocks->n_blocks;
    }
    const int64_t first = block * blocks->block_items;
    return first < blocks->n_items ? first : blocks->n_items;
}

mor_status mor_reduce_room_init(mor_context *context, mor_reduce_room *room, int64_t n_blocks, int n_values)
{
    *room = (mor_reduce_room){NULL, NULL, NULL};
    MOR_TRY(context, MOR_NEW(context, &room->values, n_blocks * n_values, "values of blocks"));
    MOR_TRY(context, MOR_NEW(context, &room->indices, n_blocks, "indices of blocks"));
    return MOR_NEW(context, &room->statuses, n_blocks, "statuses of blocks");
}

void mor_reduce_room_clear(mor_context *context, mor_reduce_room *room)
{
    MOR_FREE(context, &room->values);
    MOR_FREE(context, &room->indices);
    MOR_FREE(context, &room->statuses);
}

static double start_of(mor_reduce_kind kind)
{
    return kind == MOR_REDUCE_LARGEST ? -INFINITY : kind == MOR_REDUCE_SMALLEST ? INFINITY : 0.0;
}

static void combine(mor_reduce_kind kind, int n_values, const double *partial, double *results)
{
    for (int k = 0; k < n_values; ++k) {
        if (kind == MOR_REDUCE_SUM) {
            results[k] += partial[k];
        } else if (kind == MOR_REDUCE_LARGEST) {
            results[k] = mor_larger(results[k], partial[k]);
        } else if (kind == MOR_REDUCE_SMALLEST) {
            results[k] = -mor_larger(-results[k], -partial[k]);
        } else if (k % 2 == 0) {
            mor_sum sum = {results[k], results[k + 1]};
            mor_sum_add(&sum, partial[k]);
            mor_sum_add(&sum, partial[k + 1]);
            results[k] = sum.high;
            results[k + 1] = sum.low;
        }
    }
}

/* Stands in for the context in MOR_PARALLEL_FOR. */
typedef struct team {
    int n_threads;
} team;

void mor_reduce(const mor_blocks *blocks, int n_threads, mor_reduce_kind kind, int n_values, mor_reduce_block run,
                void *job, double *partial, double *results)
{
    const team t = {n_threads};
    const int64_t n_blocks = mor_blocks_count(blocks);
    MOR_PARALLEL_FOR (&t, block, n_blocks, blocks->grain) {
        double *values = partial + block * n_values;
        for (int k = 0; k < n_values; ++k) {
            values[k] = start_of(kind);
        }
        run(job, mor_blocks_first(blocks, block), mor_blocks_first(blocks, block + 1), values);
    }
    for (int64_t block = 0; block < n_blocks; ++block) {
        combine(kind, n_values, partial + block * n_values, results);
    }
}

int64_t mor_reduce_first(const mor_blocks *blocks, int n_threads, mor_reduce_find find, const void *job,
                         int64_t *partial)
{
    const team t = {n_threads};
    const int64_t n_blocks = mor_blocks_count(blocks);
    MOR_PARALLEL_FOR (&t, block, n_blocks, blocks->grain) {
        partial[block] = find(job, mor_blocks_first(blocks, block), mor_blocks_first(blocks, block + 1));
    }
    for (int64_t block = 0; block < n_blocks; ++block) {
        if (partial[block] >= 0) {
            return partial[block];
        }
    }
    return -1;
}

int64_t mor_reduce_status(const mor_blocks *blocks, int n_threads, mor_reduce_work run, void *job, mor_status *partial)
{
    const team t = {n_threads};
    const int64_t n_blocks = mor_blocks_count(blocks);
    MOR_PARALLEL_FOR (&t, block, n_blocks, blocks->grain) {
        partial[block] = run(job, mor_blocks_first(blocks, block), mor_blocks_first(blocks, block + 1));
    }
    for (int64_t block = 0; block < n_blocks; ++block) {
        if (partial[block] != MOR_OK) {
            return block;
        }
    }
    return -1;
}
