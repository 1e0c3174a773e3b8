/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_RELATION_H
#define MOR_CORE_PARTICLE_RELATION_H

#include "core/particle/tree.h"

#include <stdbool.h>

/** @file
 *  Who sees whom: for each cluster of eight source particles one ascending list of target particles, the union of what
 *  the eight see within the reach. Sums must vanish beyond the support of the kernel, for the list also holds targets
 *  that only some of the eight see. Because lists ascend and strangers add exactly zero, a particle's sum does not
 *  depend on the reach, on when the list was built, or on threads. */

/** When a relation is rebuilt. */
typedef enum mor_configuration {
    MOR_CONFIGURATION_CURRENT,  /* rebuilt when it may lack a neighbor, see skin.h */
    MOR_CONFIGURATION_REFERENCE /* built once */
} mor_configuration;

/** One edge of the graph source set -> target set. Owner: the stepper that uses it. */
typedef struct mor_relation {
    mor_configuration configuration;
    double reach;        /* targets nearer than this to one of the eight are listed, m */
    int64_t n_clusters;  /* source clusters */
    bool has_runs;       /* lists are runs, see mor_relation_use_runs, and not entries */
    int32_t **lists;     /* shape [n_clusters]; start of each cluster's list in one of the buffers */
    int32_t *counts;     /* shape [n_clusters]; entries in each list */
    int32_t *sizes;      /* shape [n_clusters]; numbers in each list: its runs, or the same array as counts */
    int n_buffers;       /* one per thread */
    int32_t **buffers;   /* shape [n_buffers] of [capacities]; each list with its bits, see mor_relation_near */
    int64_t *capacities; /* shape [n_buffers]; numbers */
    int64_t n_entries;   /* entries in all lists */
    int64_t n_occupied;  /* clusters with a list that is not empty */
    int32_t *occupied;   /* shape [n_clusters]; those clusters, ascending */
    uint64_t n_builds;   /* how often it was built */
    uint64_t generation; /* of the source set when it was built; whoever builds it sets this */
} mor_relation;

/* Bits in one word. */
enum { MOR_RELATION_WORD = 32 };

/** Returns the words that hold one bit for each entry of a list. */
static inline int32_t mor_relation_words(int32_t count)
{
    return (count + MOR_RELATION_WORD - 1) / MOR_RELATION_WORD;
}

/** Returns the bits of a list, shape [mor_relation_words(count)], which follow it: entry k has bit k % 32 of word
 *  k / 32, and what is beyond the list is not set. The build sets them. Who finds entries out of reach of all eight may
 *  clear theirs, for those who come later and see the particles at the same places; relation_near.h reads the others.
 *  @param relation [in]  built
 *  @param cluster  [in]  0 .. n_clusters - 1 */
static inline uint32_t *mor_relation_near(const mor_relation *relation, int64_t cluster)
{
    return (uint32_t *)(relation->lists[cluster] + relation->sizes[cluster]);
}

/** Sets the bits of a list, shape [mor_relation_words(count)]. */
static inline void mor_relation_set_near(uint32_t *words, int32_t count)
{
    for (int32_t k = 0; k < mor_relation_words(count); ++k) {
        const int32_t left = count - k * MOR_RELATION_WORD;
        words[k] = left < MOR_RELATION_WORD ? (UINT32_C(1) << left) - 1 : UINT32_MAX;
    }
}

/** Sets the bits of clusters for which no loop finds them in this step, for those who read them.
 *  @param relation [in]  built
 *  @param first    [in]  first cluster
 *  @param last     [in]  one past the last cluster */
void mor_relation_restore_near(const mor_relation *relation, int64_t first, int64_t last);

/** Makes an empty relation for a number of source clusters.
 *  @param context       [in,out]  the number of threads is taken now
 *  @param configuration [in]      current or reference
 *  @param n_clusters    [in]      clusters of the source set
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_relation_init(mor_context *context, mor_relation *relation, mor_configuration configuration,
                             int64_t n_clusters);

/* A run: number of a target cluster in the upper bits, and below a bit for each of its points that is listed, of at
 * least one. */
enum { MOR_RUN_BITS = MOR_CLUSTER, MOR_RUN_CLUSTERS = 1 << (32 - MOR_RUN_BITS) };

/** Returns the points of a run, bit by bit. */
static inline uint32_t mor_run_points(int32_t run)
{
    return (uint32_t)run & ((1U << MOR_RUN_BITS) - 1);
}

/** Returns the first point of the cluster of a run. */
static inline int64_t mor_run_first(int32_t run)
{
    return (int64_t)((uint32_t)run >> MOR_RUN_BITS) * MOR_CLUSTER;
}

/** Returns the list of a cluster, shape [counts[cluster]], of a relation that is not to have runs, or NULL of one that
 *  has.
 *  @param cluster [in]  0 .. n_clusters - 1 */
static inline int32_t *mor_relation_entries(const mor_relation *relation, int64_t cluster)
{
    return relation->has_runs ? NULL : relation->lists[cluster];
}

/** Has lists kept as runs, one number for a target cluster in place of one for each of its points. They are read by a
 *  cursor, or block by block, see relation_near.h. Images, whose lists are not ascending, are not sorted into runs.
 *  Targets of more than MOR_RUN_CLUSTERS are kept as entries all the same.
 *  @param relation [in,out]  not yet built
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL for one that was built; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_relation_use_runs(mor_context *context, mor_relation *relation);

/** A way through the entries of a list, one by one. */
typedef struct mor_relation_cursor {
    const int32_t *list; /* shape [left]; numbers that are ahead */
    int32_t left;
    bool has_runs;
    uint32_t run;  /* points of the present run that are ahead, a bit for each */
    int64_t first; /* first point of the cluster of that run */
} mor_relation_cursor;

/** Returns a cursor before the first entry.
 *  @param relation [in]  built; outlives it
 *  @param cluster  [in]  0 .. n_clusters - 1 */
static inline mor_relation_cursor mor_relation_begin(const mor_relation *relation, int64_t cluster)
{
    return (mor_relation_cursor){relation->lists[cluster], relation->sizes[cluster], relation->has_runs, 0, 0};
}

/** Returns the next entry, an index of a target, or -1 at the end.
 *  @param cursor [in,out]  goes on */
static inline int64_t mor_relation_next(mor_relation_cursor *cursor)
{
    if (cursor->run == 0) {
        if (cursor->left == 0) {
            return -1;
        }
        cursor->left -= 1;
        const int32_t number = *cursor->list++;
        if (!cursor->has_runs) {
            return number;
        }
        cursor->run = mor_run_points(number);
        cursor->first = mor_run_first(number);
    }
    const int lane = __builtin_ctz(cursor->run);
    cursor->run &= cursor->run - 1;
    return cursor->first + lane;
}

/** Frees what the relation owns; accepts a zeroed one. */
void mor_relation_clear(mor_context *context, mor_relation *relation);

/** Points in cluster order, as the build reads them. */
typedef struct mor_relation_points {
    const mor_tree *tree;  /* fitted to the points */
    const double *records; /* shape [n_points padded to 8, stride]; x, y, z first, unit m */
    int stride;            /* doubles per record */
} mor_relation_points;

/** Builds the lists; a reference relation that has been built is left as it is.
 *  @param source   [in]      who looks
 *  @param target   [in]      who is seen; may be the same as source (a particle then lists itself too)
 *  @param reach    [in]      kernel support plus skin, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: O(n log n); allocates only when the buffers are too small. */
mor_status mor_relation_build(mor_context *context, mor_relation *relation, const mor_relation_points *source,
                              const mor_relation_points *target, double reach);

#endif
