/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_MEMORY_H
#define MOR_CORE_BASE_MEMORY_H

#include "core/base/context.h"

/** @file
 *  Aligned, zeroed, labelled and counted memory. The count in the context lets a test assert that the time loop
 *  allocates nothing. Not thread-safe: allocate outside parallel loops. */

enum { MOR_MEMORY_ALIGNMENT_BYTES = 64 };

/** Allocates n_items * item_bytes zeroed bytes aligned to 64.
 *  @param context    [in,out]  its counters are updated
 *  @param block      [out]     the address of one pointer (cast to void **); receives the memory, NULL when n_items is
 *                              0
 *  @param n_items    [in]      number of items, >= 0
 *  @param item_bytes [in]      size of one item in bytes, > 0
 *  @param label      [in]      static zero-terminated string naming the use, for error messages
 *  Returns: MOR_OK; MOR_ERROR_MEMORY with the label and size when the request cannot be met.
 *  Cost: allocates. */
mor_status mor_memory_new(mor_context *context, void **block, int64_t n_items, size_t item_bytes, const char *label);

/** Frees memory from mor_memory_new and sets the pointer to NULL. NULL is accepted.
 *  @param context [in,out]  its counters are updated
 *  @param block   [in,out]  the address of one pointer */
void mor_memory_free(mor_context *context, void **block);

/** Allocates an array of the pointed-to type: MOR_NEW(context, &array, n, "label"). */
#define MOR_NEW(context, pointer, n_items, label)                                                                      \
    mor_memory_new((context), (void **)(pointer), (n_items), sizeof **(pointer), (label))

/** Frees an array made by MOR_NEW: MOR_FREE(context, &array). */
#define MOR_FREE(context, pointer) mor_memory_free((context), (void **)(pointer))

#endif
