/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/relation.h"

#include "core/base/isa.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/particle/relation_list.h"

#include <math.h>
#include <string.h>

/* SLACK: spare room against regrowth, 1/n. */
enum { SLACK = 16, FIRST_CAPACITY = 4096 };

mor_status mor_relation_init(mor_context *context, mor_relation *relation, mor_configuration configuration,
                             int64_t n_clusters)
{
    memset(relation, 0, sizeof *relation);
    relation->configuration = configuration;
    relation->n_clusters = n_clusters;
    relation->n_buffers = context->n_threads;
    mor_status status = MOR_NEW(context, &relation->lists, n_clusters, "neighbor list starts");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &relation->counts, n_clusters, "neighbor list lengths");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &relation->occupied, n_clusters, "clusters with neighbors");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &relation->buffers, relation->n_buffers, "neighbor buffers");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &relation->capacities, relation->n_buffers, "neighbor buffer sizes");
    }
    relation->sizes = relation->counts;
    if (status != MOR_OK) {
        mor_relation_clear(context, relation);
    }
    return status;
}

mor_status mor_relation_use_runs(mor_context *context, mor_relation *relation)
{
    MOR_CHECK(context, relation->n_builds == 0 && relation->sizes == relation->counts, MOR_ERROR_INTERNAL,
              "found a relation that was built; runs are chosen before that");
    int32_t *sizes = NULL;
    MOR_TRY(context, MOR_NEW(context, &sizes, relation->n_clusters, "neighbor list sizes"));
    relation->sizes = sizes;
    return MOR_OK;
}

void mor_relation_clear(mor_context *context, mor_relation *relation)
{
    for (int buffer = 0; relation->buffers != NULL && buffer < relation->n_buffers; ++buffer) {
        MOR_FREE(context, &relation->buffers[buffer]);
    }
    MOR_FREE(context, &relation->buffers);
    MOR_FREE(context, &relation->capacities);
    MOR_FREE(context, &relation->occupied);
    if (relation->sizes != relation->counts) {
        MOR_FREE(context, &relation->sizes);
    }
    MOR_FREE(context, &relation->counts);
    MOR_FREE(context, &relation->lists);
    memset(relation, 0, sizeof *relation);
}

void mor_relation_restore_near(const mor_relation *relation, int64_t first, int64_t last)
{
    for (int64_t cluster = first; cluster < last; ++cluster) {
        mor_relation_set_near(mor_relation_near(relation, cluster), relation->counts[cluster]);
    }
}

/* Its variants, see core/base/isa.h. */
MOR_ISA_DECLARE(int64_t, mor_relation_list,
                (mor_relation * relation, const mor_relation_points *source, const mor_relation_points *target,
                 int buffer, int64_t first, int64_t last));

/* One attempt; used[b] becomes the entries buffer b needs, whether or not they fit. */
static void list_all(mor_context *context, mor_relation *relation, const mor_relation_points *source,
                     const mor_relation_points *target, int64_t *used)
{
    static const mor_relation_list_loop variants[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(mor_relation_list);
    const int isa = mor_isa_select(NULL);
    const int64_t share = (relation->n_clusters + relation->n_buffers - 1) / relation->n_buffers;
    MOR_PARALLEL_FOR (context, buffer, relation->n_buffers, 1) {
        const int64_t first = buffer * share;
        const int64_t last = first + share < relation->n_clusters ? first + share : relation->n_clusters;
        used[buffer] = first < last ? variants[isa](relation, source, target, (int)buffer, first, last) : 0;
    }
}

static void find_occupied(mor_relation *relation)
{
    relation->n_entries = 0;
    relation->n_occupied = 0;
    for (int64_t cluster = 0; cluster < relation->n_clusters; ++cluster) {
        relation->n_entries += relation->counts[cluster];
        if (relation->counts[cluster] > 0) {
            relation->occupied[relation->n_occupied++] = (int32_t)cluster;
        }
    }
}

/* Gives every buffer that was too small the room it needed and some more; says whether one was. */
static mor_status grow_buffers(mor_context *context, mor_relation *relation, const int64_t *used, bool *has_grown)
{
    *has_grown = false;
    for (int buffer = 0; buffer < relation->n_buffers; ++buffer) {
        if (used[buffer] <= relation->capacities[buffer]) {
            continue;
        }
        *has_grown = true;
        MOR_FREE(context, &relation->buffers[buffer]);
        relation->capacities[buffer] = 0;
        const int64_t capacity = used[buffer] + used[buffer] / SLACK + FIRST_CAPACITY;
        MOR_TRY(context, MOR_NEW(context, &relation->buffers[buffer], capacity, "neighbor lists"));
        relation->capacities[buffer] = capacity;
    }
    return MOR_OK;
}

mor_status mor_relation_build(mor_context *context, mor_relation *relation, const mor_relation_points *source,
                              const mor_relation_points *target, double reach)
{
    if (relation->configuration == MOR_CONFIGURATION_REFERENCE && relation->n_builds > 0) {
        return MOR_OK;
    }
    enum { BUFFERS_MAX = 1024 };
    int64_t used[BUFFERS_MAX];
    MOR_CHECK(context, relation->n_buffers <= BUFFERS_MAX, MOR_ERROR_ARGUMENT, "%d threads; at most %d are allowed",
              relation->n_buffers, BUFFERS_MAX);
    MOR_CHECK(context, relation->n_clusters == source->tree->n_clusters, MOR_ERROR_INTERNAL,
              "a relation of %lld clusters was built over %lld", (long long)relation->n_clusters,
              (long long)source->tree->n_clusters);
    relation->reach = reach;
    relation->n_builds += 1;
    relation->has_runs = relation->sizes != relation->counts && target->tree->n_clusters <= MOR_RUN_CLUSTERS;
    if (target->tree->n_clusters == 0) {
        memset(relation->counts, 0, (size_t)relation->n_clusters * sizeof *relation->counts);
        memset(relation->sizes, 0, (size_t)relation->n_clusters * sizeof *relation->sizes);
    } else if (relation->n_clusters > 0) {
        bool has_grown = true;
        while (has_grown) {
            list_all(context, relation, source, target, used);
            MOR_TRY(context, grow_buffers(context, relation, used, &has_grown));
        }
    }
    find_occupied(relation);
    return MOR_OK;
}
