/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_REDUCE_H
#define MOR_CORE_BASE_REDUCE_H

#include "core/base/context.h"

#include <math.h>

/** @file
 *  The one door for sums, largest and smallest values and first faults over many items. Items are cut into blocks that
 *  do not depend on the number of threads; a block is worked on by one thread, and the partial results are combined in
 *  the order of the blocks, so that no result depends on threads. */

/** How items are cut into blocks. */
typedef struct mor_blocks {
    int64_t n_items;     /* number of items, >= 0 */
    int64_t block_items; /* items of a block, > 0; 0: as n_blocks says */
    int64_t n_blocks;    /* so many blocks of about the same size, when block_items is 0 */
    int64_t grain;       /* blocks a thread takes at once, > 0 */
} mor_blocks;

/** Number of blocks, 1. */
int64_t mor_blocks_count(const mor_blocks *blocks);

/** First item of a block, 1; that of the block behind the last is n_items.
 *  @param block [in]  0 .. number of blocks */
int64_t mor_blocks_first(const mor_blocks *blocks, int64_t block);

/** Room for the partial results of reductions. Owner: whoever reduces. */
typedef struct mor_reduce_room {
    double *values;       /* shape [n_blocks, n_values]; any unit */
    int64_t *indices;     /* shape [n_blocks] */
    mor_status *statuses; /* shape [n_blocks] */
} mor_reduce_room;

/** Makes room.
 *  @param room     [out]  cleared with mor_reduce_room_clear, also after a failure
 *  @param n_blocks [in]   most blocks of a reduction
 *  @param n_values [in]   most values of a block
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_reduce_room_init(mor_context *context, mor_reduce_room *room, int64_t n_blocks, int n_values);

/** Frees what a room owns; accepts a zeroed one. */
void mor_reduce_room_clear(mor_context *context, mor_reduce_room *room);

/** How two numbers become one. */
typedef enum mor_reduce_kind {
    MOR_REDUCE_SUM,         /* added */
    MOR_REDUCE_COMPENSATED, /* values come in pairs, a rounded sum and what is missing from it (mor_sum) */
    MOR_REDUCE_LARGEST,     /* the larger one; not a number wins */
    MOR_REDUCE_SMALLEST     /* the smaller one; not a number wins */
} mor_reduce_kind;

/** Combines the values of the items [first, last) into values, shape [n_values] and any unit, which hold the
 *  start values of the kind: zero, -INFINITY or INFINITY. */
typedef void (*mor_reduce_block)(void *job, int64_t first, int64_t last, double *values);

/** Reduces numbers.
 *  @param n_threads [in]      threads there are, >= 1
 *  @param kind      [in]      how values are combined
 *  @param n_values  [in]      values side by side, >= 1
 *  @param run       [in]      finds those of a block
 *  @param job       [in,out]  first argument of run
 *  @param partial   [out]     shape [blocks, n_values]; the values of each block, any unit
 *  @param results   [in,out]  shape [n_values]; combined with those of all blocks, same unit */
void mor_reduce(const mor_blocks *blocks, int n_threads, mor_reduce_kind kind, int n_values, mor_reduce_block run,
                void *job, double *partial, double *results);

/** Returns the first item of a kind among [first, last), 1, or -1. */
typedef int64_t (*mor_reduce_find)(const void *job, int64_t first, int64_t last);

/** Finds the first item of a kind.
 *  @param n_threads [in]   threads there are, >= 1
 *  @param find      [in]   finds the first of a block
 *  @param job       [in]   first argument of find
 *  @param partial   [out]  shape [blocks]
 *  Returns: its index; -1 when there is none. */
int64_t mor_reduce_first(const mor_blocks *blocks, int n_threads, mor_reduce_find find, const void *job,
                         int64_t *partial);

/** Works on the items [first, last). Returns: MOR_OK, or why it failed. */
typedef mor_status (*mor_reduce_work)(void *job, int64_t first, int64_t last);

/** Does something to all items and finds the first block in which it failed.
 *  @param n_threads [in]      threads there are, >= 1
 *  @param run       [in]      works on a block
 *  @param job       [in,out]  first argument of run
 *  @param partial   [out]     shape [blocks]; what run returned for each block
 *  Returns: index of the block; -1 when all went well. */
int64_t mor_reduce_status(const mor_blocks *blocks, int n_threads, mor_reduce_work run, void *job, mor_status *partial);

/** Returns the larger of two numbers, or the one that is not a number; any unit. */
static inline double mor_larger(double a, double b)
{
    return a >= b || isnan(a) ? a : b;
}

/** A sum that remembers what rounding took away (Knuth's two-sum). Start from zero. Not to be compiled with
 *  -ffast-math. */
typedef struct mor_sum {
    double high; /* the rounded sum; unit: that of the terms, 1 for numbers */
    double low;  /* what is missing from it; same unit, 1 for numbers */
} mor_sum;

/** Adds a term; term in the unit of the sum, 1 for numbers.
 *  @param term [in]      unit 1 or that of the sum */
static inline void mor_sum_add(mor_sum *sum, double term)
{
    const double total = sum->high + term;
    const double taken = total - sum->high;
    sum->low += (sum->high - (total - taken)) + (term - taken);
    sum->high = total;
}

/** Returns the value of a sum, in the unit of its terms, 1 for numbers. */
static inline double mor_sum_value(mor_sum sum)
{
    return sum.high + sum.low;
}

#endif
