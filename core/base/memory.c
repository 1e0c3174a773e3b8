/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"

#include "core/base/parallel.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* One alignment unit in front of each block remembers its size. */
enum { HEADER_BYTES = MOR_MEMORY_ALIGNMENT_BYTES, LARGE_PAGE_BYTES = 1 << 21 };

/* Neighbors of a cluster lie scattered over a large array, on more small pages than the processor can look up quickly.
 * So what fills several large pages gets them, where the system has them. */
static void *allocate(size_t bytes)
{
#if defined(MADV_HUGEPAGE)
    void *raw = NULL;
    if (bytes >= 2 * (size_t)LARGE_PAGE_BYTES && posix_memalign(&raw, LARGE_PAGE_BYTES, bytes) == 0) {
        (void)madvise(raw, bytes / LARGE_PAGE_BYTES * LARGE_PAGE_BYTES,
                      MADV_HUGEPAGE); /* refused, it costs time only */
        return raw;
    }
#endif
    return aligned_alloc(MOR_MEMORY_ALIGNMENT_BYTES, bytes);
}

/* A page lies beside the processor that writes it first. Loops hand out work as threads get free, so what is large is
 * spread over the memory of all of them. */
static void clear(mor_context *context, char *raw, size_t bytes)
{
    if (bytes < 2 * (size_t)LARGE_PAGE_BYTES) {
        memset(raw, 0, bytes);
        return;
    }
    const int64_t n_pages = (int64_t)(bytes / LARGE_PAGE_BYTES);
    MOR_PARALLEL_FOR (context, page, n_pages, 1) {
        const size_t first = (size_t)page * LARGE_PAGE_BYTES;
        memset(raw + first, 0, page == n_pages - 1 ? bytes - first : LARGE_PAGE_BYTES);
    }
}

mor_status mor_memory_new(mor_context *context, void **block, int64_t n_items, size_t item_bytes, const char *label)
{
    *block = NULL;
    if (n_items == 0) {
        return MOR_OK;
    }
    const size_t limit_bytes = SIZE_MAX / 4;
    MOR_CHECK(context, n_items > 0 && item_bytes > 0 && (size_t)n_items <= limit_bytes / item_bytes, MOR_ERROR_MEMORY,
              "cannot allocate %lld items of %zu bytes for %s: the size is out of range", (long long)n_items,
              item_bytes, label);
    size_t bytes = (size_t)n_items * item_bytes;
    bytes = (bytes + HEADER_BYTES - 1) / HEADER_BYTES * HEADER_BYTES;
    char *raw = allocate(bytes + HEADER_BYTES);
    MOR_CHECK(context, raw != NULL, MOR_ERROR_MEMORY,
              "cannot allocate %.1f MiB for %s: not enough memory; use a larger spacing or a smaller domain",
              (double)bytes / 1048576.0, label);
    clear(context, raw, bytes + HEADER_BYTES);
    memcpy(raw, &bytes, sizeof bytes);
    context->memory_bytes += bytes;
    context->n_allocations += 1;
    if (context->memory_bytes > context->memory_peak_bytes) {
        context->memory_peak_bytes = context->memory_bytes;
    }
    *block = raw + HEADER_BYTES;
    return MOR_OK;
}

void mor_memory_free(mor_context *context, void **block)
{
    if (*block == NULL) {
        return;
    }
    char *raw = (char *)*block - HEADER_BYTES;
    size_t bytes = 0;
    memcpy(&bytes, raw, sizeof bytes);
    context->memory_bytes -= bytes;
    free(raw);
    *block = NULL;
}
