/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_POINT_CACHE_H
#define MOR_CASES_DRIVER_SCENE_BUILD_POINT_CACHE_H

#include "core/io/durable_file.h"
#include "relaxation/relax/relax.h"

/** @file
 *  Relaxed particles that were found before: in this run, or in an earlier one and kept in a folder. One file for each
 *  request, named by its hash, sealed; a damaged one is found anew and replaced. What is read is bit for bit what was
 *  found. Without a folder that can be written, particles are kept for the run only. */

/** Particles kept for the run. */
typedef struct mor_point_cache_entry {
    uint64_t hash; /* of the request */
    mor_relax_points points;
    struct mor_point_cache_entry *next;
} mor_point_cache_entry;

/** Owner: the caller, who ends it with mor_point_cache_clear. */
typedef struct mor_point_cache {
    char folder[MOR_PATH_BYTES]; /* zero-terminated; "": none */
    bool is_folder_made;
    mor_point_cache_entry *first; /* owned list */
    int n_found;                  /* relaxations done */
    int n_read;                   /* taken from files */
    int n_shared;                 /* taken from this run */
} mor_point_cache;

/** Makes the cache ready. Touches no file.
 *  @param folder [in]   zero-terminated; NULL or "": none */
void mor_point_cache_init(mor_point_cache *cache, const char *folder);

/** Frees what is kept for the run; accepts a zeroed cache. */
void mor_point_cache_clear(mor_context *context, mor_point_cache *cache);

/** Takes the particles from the run or from a file, else relaxes and keeps them. What happened is logged.
 *  @param points  [out]     borrowed from the cache, valid until it is cleared; not to be cleared
 *  Returns: MOR_OK, also when no file could be read or written; what mor_relax returns; MOR_ERROR_MEMORY. */
mor_status mor_point_cache_relax(mor_context *context, mor_point_cache *cache, const mor_relax_request *request,
                                 mor_relax_points *points);

#endif
