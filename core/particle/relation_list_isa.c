/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Neighbor lists of a range of clusters. Compiled once per instruction set; MOR_ISA is its name. */
#include "core/particle/lanes.h"
#include "core/particle/relation_list.h"

#include <math.h>
#include <string.h>

/* STACK: pending nodes of a descent. GROUP: source clusters that share a descent. CANDIDATES: target clusters that are
 * looked at together. */
enum { STACK = 64, GROUP = 8, CANDIDATES = 512 };

/* Twice the distance between two intervals, zero where they meet, without a branch. */
static inline double twice_gap(double low, double high, double other_low, double other_high)
{
    const double above = low - other_high;
    const double below = other_low - high;
    const double larger = above > below ? above : below;
    return larger + fabs(larger);
}

/* Squared distance between two boxes. */
static double box_gap(const double *p, const double *q)
{
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double gap = twice_gap(p[a], p[3 + a], q[a], q[3 + a]);
        sum += gap * gap;
    }
    return 0.25 * sum;
}

/* The eight source positions by component, and their box. */
typedef struct lanes {
    vec x[3][PARTS];
    double box[6];
} lanes;

static void load_lanes(const mor_relation_points *source, int64_t cluster, lanes *out)
{
    for (int64_t lane = 0; lane < MOR_CLUSTER; ++lane) {
        /* The last cluster repeats its last particle. */
        int64_t i = cluster * MOR_CLUSTER + lane;
        i = i < source->tree->n_points ? i : source->tree->n_points - 1;
        const double *record = source->records + i * source->stride;
        for (int a = 0; a < 3; ++a) {
            out->x[a][lane / LANES][lane % LANES] = record[a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        out->box[a] = out->box[3 + a] = out->x[a][0][0];
        for (int lane = 1; lane < MOR_CLUSTER; ++lane) {
            const double x = out->x[a][lane / LANES][lane % LANES];
            out->box[a] = x < out->box[a] ? x : out->box[a];
            out->box[3 + a] = x > out->box[3 + a] ? x : out->box[3 + a];
        }
    }
}

/* One when one of the eight is nearer to a point than the square root of reach2, else zero. */
static inline int64_t is_seen(const lanes *eight, const double *point, double reach2)
{
    int any = 0;
    for (int part = 0; part < PARTS; ++part) {
        const vec dx = eight->x[0][part] - point[0];
        const vec dy = eight->x[1][part] - point[1];
        const vec dz = eight->x[2][part] - point[2];
        any |= any_less(dx * dx + dy * dy + dz * dz, reach2);
    }
    return any != 0;
}

/* A list that is written as far as there is room, and counted to its end. */
typedef struct list_writer {
    int32_t *out; /* shape [room] */
    int64_t room;
    int64_t size;  /* numbers */
    int64_t count; /* entries */
} list_writer;

/* Appends the points of one target cluster that one of the eight sees. Entries are written before it is known whether
 * they count, which spares a branch that nobody could predict. */
static inline void append_points(list_writer *list, const lanes *eight, const mor_relation_points *target,
                                 int64_t begin, int64_t end, double reach2)
{
    int32_t spare[MOR_CLUSTER];
    const int64_t room = list->room - list->size;
    int32_t *place = room >= MOR_CLUSTER ? list->out + list->size : spare;
    int64_t count = 0;
    for (int64_t j = begin; j < end; ++j) {
        place[count] = (int32_t)j;
        count += is_seen(eight, target->records + j * target->stride, reach2);
    }
    if (place == spare && room > 0) {
        memcpy(list->out + list->size, spare, (size_t)(count < room ? count : room) * sizeof *spare);
    }
    list->size += count;
    list->count += count;
}

/* Appends the same as one run. */
static inline void append_run(list_writer *list, const lanes *eight, const mor_relation_points *target, int64_t begin,
                              int64_t end, double reach2)
{
    uint32_t seen = 0;
    for (int64_t j = begin; j < end; ++j) {
        seen |= (uint32_t)is_seen(eight, target->records + j * target->stride, reach2) << (j - begin);
    }
    if (list->size < list->room) {
        list->out[list->size] = (int32_t)((uint32_t)(begin / MOR_CLUSTER) << MOR_RUN_BITS | seen);
    }
    list->size += seen != 0;
    list->count += __builtin_popcount(seen);
}

/* Target clusters near a group of source clusters. */
typedef struct candidates {
    double box[6][CANDIDATES]; /* by component, so that one source cluster asks many at once */
    double gap[CANDIDATES];
    int32_t cluster[CANDIDATES];
    int n;
} candidates;

/* A descent of the target's tree that can be interrupted. */
typedef struct descent {
    struct {
        int64_t node, begin, end;
    } stack[STACK];
    int depth; /* 0: done */
} descent;

static inline void push_node(descent *it, int64_t node, int64_t begin, int64_t end)
{
    it->stack[it->depth].node = node;
    it->stack[it->depth].begin = begin;
    it->stack[it->depth++].end = end;
}

static inline void start_descent(descent *it, const mor_tree *tree)
{
    it->depth = 0;
    push_node(it, 0, 0, tree->n_clusters);
}

/* Goes on to the next clusters in reach of a box, in ascending order, as many as there is room for. */
static inline void find_candidates(descent *it, const double *box, const mor_tree *tree, double reach2,
                                   candidates *found)
{
    found->n = 0;
    while (it->depth > 0 && found->n < CANDIDATES) {
        --it->depth;
        const int64_t node = it->stack[it->depth].node;
        const int64_t begin = it->stack[it->depth].begin;
        const int64_t end = it->stack[it->depth].end;
        const double *node_box = tree->boxes + 6 * node;
        if (!(box_gap(box, node_box) < reach2)) {
            continue;
        }
        if (end - begin == 1) {
            for (int a = 0; a < 6; ++a) {
                found->box[a][found->n] = node_box[a];
            }
            found->cluster[found->n++] = (int32_t)begin;
            continue;
        }
        /* The left half is pushed last and so visited first: lists ascend. */
        const int64_t left = mor_tree_left(end - begin);
        push_node(it, node + 2 * left, begin + left, end);
        push_node(it, node + 1, begin, begin + left);
    }
}

/* Squared distances of the candidates' boxes from one. */
static inline void find_gaps(const double *box, candidates *found)
{
    for (int k = 0; k < found->n; ++k) {
        found->gap[k] = 0.0;
    }
    for (int a = 0; a < 3; ++a) {
        const double low = box[a];
        const double high = box[3 + a];
        for (int k = 0; k < found->n; ++k) {
            const double gap = twice_gap(low, high, found->box[a][k], found->box[3 + a][k]);
            found->gap[k] += gap * gap;
        }
    }
}

/* Appends what a cluster sees of the candidates. */
static inline void append_candidates(list_writer *list, const lanes *eight, const mor_relation_points *target,
                                     candidates *found, double reach2, bool has_runs)
{
    find_gaps(eight->box, found);
    for (int k = 0; k < found->n; ++k) {
        if (0.25 * found->gap[k] < reach2) {
            const int64_t begin = (int64_t)found->cluster[k] * MOR_CLUSTER;
            const int64_t last = begin + MOR_CLUSTER;
            const int64_t end = last < target->tree->n_points ? last : target->tree->n_points;
            if (has_runs) {
                append_run(list, eight, target, begin, end, reach2);
            } else {
                append_points(list, eight, target, begin, end, reach2);
            }
        }
    }
}

/* The box of a group of source clusters, at least one. */
static inline void bound_group(const mor_relation_points *source, int64_t first, int64_t last, double *box)
{
    lanes eight;
    load_lanes(source, first, &eight);
    memcpy(box, eight.box, sizeof eight.box);
    for (int64_t cluster = first + 1; cluster < last; ++cluster) {
        load_lanes(source, cluster, &eight);
        for (int a = 0; a < 3; ++a) {
            box[a] = eight.box[a] < box[a] ? eight.box[a] : box[a];
            box[3 + a] = eight.box[3 + a] > box[3 + a] ? eight.box[3 + a] : box[3 + a];
        }
    }
}

/* Lists the clusters [first, last) into one buffer; returns the numbers it needs, whether or not they fit. Neighboring
 * clusters see much the same, so the tree is descended once for a group of them. A group that sees more than there is
 * room for is spread far; its clusters then descend for themselves. */
int64_t MOR_ISA_NAME(mor_relation_list)(mor_relation *relation, const mor_relation_points *source,
                                        const mor_relation_points *target, int buffer, int64_t first, int64_t last)
{
    const double reach2 = relation->reach * relation->reach;
    candidates found;
    descent it = {.depth = 0};
    int64_t total = 0;
    int64_t group_end = first;
    bool is_alone = false;
    for (int64_t cluster = first; cluster < last; ++cluster) {
        if (cluster == group_end) {
            double box[6];
            group_end = cluster + GROUP < last ? cluster + GROUP : last;
            bound_group(source, cluster, group_end, box);
            start_descent(&it, target->tree);
            find_candidates(&it, box, target->tree, reach2, &found);
            is_alone = it.depth > 0;
        }
        lanes eight;
        load_lanes(source, cluster, &eight);
        const int64_t left = relation->capacities[buffer] - total;
        const int64_t room = left > 0 ? left : 0;
        /* Without room nothing is written, and there may be no buffer yet. */
        int32_t *out = room > 0 ? relation->buffers[buffer] + total : relation->buffers[buffer];
        list_writer list = {out, room, 0, 0};
        if (is_alone) {
            start_descent(&it, target->tree);
        }
        do {
            if (is_alone) {
                find_candidates(&it, eight.box, target->tree, reach2, &found);
            }
            append_candidates(&list, &eight, target, &found, reach2, relation->has_runs);
        } while (it.depth > 0);
        relation->lists[cluster] = out;
        relation->counts[cluster] = (int32_t)list.count;
        relation->sizes[cluster] = (int32_t)list.size;
        const int64_t needed = list.size + mor_relation_words((int32_t)list.count);
        if (list.count > 0 && needed <= room) {
            mor_relation_set_near(mor_relation_near(relation, cluster), (int32_t)list.count);
        }
        total += needed;
    }
    return total;
}
