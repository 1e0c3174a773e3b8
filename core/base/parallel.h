/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_PARALLEL_H
#define MOR_CORE_BASE_PARALLEL_H

#include <omp.h>
#include <stdint.h>

/** @file
 *  The only file with OpenMP pragmas. Loops are split into contiguous chunks; reductions run over blocks of fixed
 *  size whose partial results are combined in block order, so that no result depends on the number of threads. */

#define MOR_PRAGMA_(text) _Pragma(#text)

/** for-loop over [0, n) shared by the threads in chunks of `chunk`: MOR_PARALLEL_FOR(context, i, n, chunk) { ... } */
#define MOR_PARALLEL_FOR(context, index, count, chunk)                                                                 \
    MOR_PRAGMA_(omp parallel for schedule(dynamic, chunk) num_threads((context)->n_threads))                           \
    for (int64_t index = 0; index < (count); ++index)

/** Number of processors this process may use, 1. */
static inline int mor_parallel_cores(void)
{
    return omp_get_num_procs();
}

/** Number of the thread that asks among those that share its loop, 0 to one less than they are; 0 outside of loops. */
static inline int mor_parallel_thread(void)
{
    int number = 0;
    for (int level = 1; level <= omp_get_level(); ++level) { /* a loop within a loop may have one thread only */
        number = number * omp_get_team_size(level) + omp_get_ancestor_thread_num(level);
    }
    return number;
}

/** Particles per block of a reduction; fixed so that sums do not depend on the number of threads. */
enum { MOR_BLOCK = 1024 };

/** Number of reduction blocks for n items, 1. */
static inline int64_t mor_block_count(int64_t n)
{
    return (n + MOR_BLOCK - 1) / MOR_BLOCK;
}

/** One past the last item of a block, 1. */
static inline int64_t mor_block_end(int64_t block, int64_t n)
{
    const int64_t end = (block + 1) * MOR_BLOCK;
    return end < n ? end : n;
}

#endif
