/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/skin.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* GRAIN: clusters a thread takes at once. TASKS: pairs of nodes that are shared by the threads. STACK: pairs of nodes a
 * task keeps; each split leaves two behind, and the trees are at most 31 deep. LEAVES: comparisons of clusters in a
 * task, at least, and all tasks' share of the clusters: about what lists cost. */
enum { GRAIN = 128, TASKS = 256, STACK = 256, LEAVES = 64 };

/* ---- Displacements ----------------------------------------------------------------------------------------------- */

static int64_t points_end(const mor_skin_side *side, int64_t cluster)
{
    const int64_t end = (cluster + 1) * MOR_CLUSTER;
    return end < side->tree->n_points ? end : side->tree->n_points;
}

static void measure_cluster(const mor_skin_side *side, int64_t cluster, double *range)
{
    for (int a = 0; a < 3; ++a) {
        range[a] = INFINITY;
        range[3 + a] = -INFINITY;
    }
    for (int64_t i = cluster * MOR_CLUSTER; i < points_end(side, cluster); ++i) {
        for (int a = 0; a < 3; ++a) {
            const double moved = side->records[i * side->stride + a] - side->built[3 * i + a];
            range[a] = mor_min(range[a], moved);
            range[3 + a] = mor_max(range[3 + a], moved);
        }
    }
}

/* The node of a cluster. */
static int64_t find_leaf(const mor_tree *tree, int64_t cluster)
{
    int64_t node = 0;
    int64_t begin = 0;
    int64_t end = tree->n_clusters;
    while (end - begin > 1) {
        const int64_t left = mor_tree_left(end - begin);
        const bool is_left = cluster < begin + left;
        node += is_left ? 1 : 2 * left;
        end = is_left ? begin + left : end;
        begin = is_left ? begin : begin + left;
    }
    return node;
}

/* Joins the ranges of children. Depth is at most 31, so recursion is safe. */
static void join_ranges(double *ranges, int64_t node, int64_t n_clusters)
{
    if (n_clusters == 1) {
        return;
    }
    const int64_t left = mor_tree_left(n_clusters);
    const double *first = ranges + 6 * (node + 1);
    const double *second = ranges + 6 * (node + 2 * left);
    join_ranges(ranges, node + 1, left);
    join_ranges(ranges, node + 2 * left, n_clusters - left);
    for (int a = 0; a < 3; ++a) {
        ranges[6 * node + a] = mor_min(first[a], second[a]);
        ranges[6 * node + 3 + a] = mor_max(first[3 + a], second[3 + a]);
    }
}

void mor_skin_measure(mor_context *context, const mor_skin_side *side)
{
    if (side->ranges == NULL || side->tree->n_clusters == 0) {
        return;
    }
    MOR_PARALLEL_FOR (context, cluster, side->tree->n_clusters, GRAIN) {
        measure_cluster(side, cluster, side->ranges + 6 * find_leaf(side->tree, cluster));
    }
    join_ranges(side->ranges, 0, side->tree->n_clusters);
}

mor_status mor_skin_places_init(mor_context *context, mor_skin_places *places, const mor_tree *tree, double *ranges)
{
    *places = (mor_skin_places){.tree = tree, .ranges = ranges};
    return MOR_NEW(context, &places->built, 3 * tree->n_points, "places of the lists");
}

void mor_skin_places_clear(mor_context *context, mor_skin_places *places)
{
    MOR_FREE(context, &places->built);
    memset(places, 0, sizeof *places);
}

void mor_skin_places_keep(mor_context *context, mor_skin_places *places, const double *position)
{
    const int64_t n = places->tree->n_points;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        const int64_t first = 3 * block * MOR_BLOCK;
        memcpy(places->built + first, position + first,
               (size_t)(3 * mor_block_end(block, n) - first) * sizeof *position);
    }
    places->drift = 0.0;
}

mor_skin_side mor_skin_places_measure(mor_context *context, const mor_skin_places *places, const double *position)
{
    const mor_skin_side side = {
        .tree = places->tree, .records = position, .stride = 3, .built = places->built, .ranges = places->ranges};
    mor_skin_measure(context, &side);
    return side;
}

/* ---- Pairs of nodes ---------------------------------------------------------------------------------------------- */

typedef struct node {
    int64_t index;
    int64_t begin, end; /* clusters */
} node;

typedef struct node_pair {
    node source, target;
} node_pair;

typedef struct check {
    const mor_skin_side *source, *target;
    double support, reach;
    int64_t most_leaves; /* comparisons of clusters in a task */
} check;

static const double *range_of(const mor_skin_side *side, int64_t index, double *alike)
{
    for (int a = 0; a < 3; ++a) {
        alike[a] = -side->displacement;
        alike[3 + a] = side->displacement;
    }
    return side->ranges != NULL ? side->ranges + 6 * index : alike;
}

/* Whether displacements cannot have brought points that were not listed within the support. */
static bool is_sure(const check *it, const node_pair *pair)
{
    double alike[2][6];
    const double *box = it->source->tree->boxes + 6 * pair->source.index;
    const double *other = it->target->tree->boxes + 6 * pair->target.index;
    const double *range = range_of(it->source, pair->source.index, alike[0]);
    const double *against = range_of(it->target, pair->target.index, alike[1]);
    double relative2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double relative = mor_max(range[3 + a] - against[a], against[3 + a] - range[a]);
        relative2 += relative * relative;
    }
    const double room = mor_max(sqrt(mor_tree_box_gap2(box, other)), it->reach) - it->support;
    return relative2 <= room * room;
}

static double distance2(const double *a, const double *b)
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return mor_vector_dot(d, d);
}

static const double *built_of(const mor_skin_side *side, int64_t i)
{
    return side->built != NULL ? side->built + 3 * i : side->records + i * side->stride;
}

/* Compares the points of two clusters. */
static bool clusters_hold(const check *it, const node_pair *pair)
{
    const int64_t source = pair->source.begin;
    const int64_t target = pair->target.begin;
    const double support2 = it->support * it->support;
    const double reach2 = it->reach * it->reach;
    if (it->source->records == NULL || it->target->records == NULL) {
        return false;
    }
    for (int64_t i = source * MOR_CLUSTER; i < points_end(it->source, source); ++i) {
        const double *x = it->source->records + i * it->source->stride;
        for (int64_t j = target * MOR_CLUSTER; j < points_end(it->target, target); ++j) {
            if (!(distance2(x, it->target->records + j * it->target->stride) >= support2) &&
                !(distance2(built_of(it->source, i), built_of(it->target, j)) < reach2)) {
                return false;
            }
        }
    }
    return true;
}

static node child_of(const node *parent, bool is_left)
{
    const int64_t left = mor_tree_left(parent->end - parent->begin);
    return is_left ? (node){parent->index + 1, parent->begin, parent->begin + left}
                   : (node){parent->index + 2 * left, parent->begin + left, parent->end};
}

static bool is_leaf(const node_pair *pair)
{
    return pair->source.end - pair->source.begin == 1 && pair->target.end - pair->target.begin == 1;
}

/* Divides the larger node of a pair, or both where they are the same; returns the number of pairs, up to three. */
static int divide(const check *it, const node_pair *pair, node_pair *parts)
{
    const int64_t n_source = pair->source.end - pair->source.begin;
    const int64_t n_target = pair->target.end - pair->target.begin;
    if (it->source == it->target && pair->source.index == pair->target.index) {
        const node left = child_of(&pair->source, true);
        const node right = child_of(&pair->source, false);
        parts[0] = (node_pair){left, left};
        parts[1] = (node_pair){left, right};
        parts[2] = (node_pair){right, right};
        return 3;
    }
    for (int k = 0; k < 2; ++k) {
        parts[k] = n_source >= n_target ? (node_pair){child_of(&pair->source, k == 0), pair->target}
                                        : (node_pair){pair->source, child_of(&pair->target, k == 0)};
    }
    return 2;
}

static bool pair_holds(const check *it, const node_pair *pair)
{
    node_pair stack[STACK];
    int depth = 0;
    int64_t n_leaves = 0;
    stack[depth++] = *pair;
    while (depth > 0) {
        const node_pair top = stack[--depth];
        if (is_sure(it, &top)) {
            continue;
        }
        if (!is_leaf(&top)) {
            depth += divide(it, &top, stack + depth);
        } else if (++n_leaves > it->most_leaves || !clusters_hold(it, &top)) {
            return false;
        }
    }
    return true;
}

/* Divides the pair of all until there are enough for the threads, the coarsest first; returns their number. */
static int find_tasks(const check *it, node_pair *tasks)
{
    int n = 1;
    tasks[0] = (node_pair){{0, 0, it->source->tree->n_clusters}, {0, 0, it->target->tree->n_clusters}};
    for (bool has_divided = true; has_divided;) {
        const int n_before = n;
        has_divided = false;
        n = 0;
        node_pair next[TASKS];
        for (int k = 0; k < n_before; ++k) {
            if (is_sure(it, &tasks[k])) {
                continue;
            }
            const bool divides = !is_leaf(&tasks[k]) && n + 3 + (n_before - k - 1) <= TASKS;
            n += divides ? divide(it, &tasks[k], next + n) : 1;
            if (!divides) {
                next[n - 1] = tasks[k];
            }
            has_divided = has_divided || divides;
        }
        for (int k = 0; k < n; ++k) {
            tasks[k] = next[k];
        }
    }
    return n;
}

bool mor_skin_holds(mor_context *context, const mor_skin_side *source, const mor_skin_side *target, double support,
                    double reach)
{
    check it = {.source = source, .target = target, .support = support, .reach = reach};
    node_pair tasks[TASKS];
    bool holds[TASKS];
    bool is_true = true;
    if (source->tree->n_clusters == 0 || target->tree->n_clusters == 0) {
        return true;
    }
    if (!(reach > support)) {
        return false;
    }
    const int n = find_tasks(&it, tasks);
    if (n == 0) {
        return true;
    }
    it.most_leaves = LEAVES + source->tree->n_clusters / n;
    MOR_PARALLEL_FOR (context, k, n, 1) {
        holds[k] = pair_holds(&it, &tasks[k]);
    }
    for (int k = 0; k < n; ++k) {
        is_true = is_true && holds[k];
    }
    return is_true;
}
