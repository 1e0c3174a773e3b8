/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/tree.h"

#include "core/base/memory.h"

#include <math.h>
#include <string.h>

/* Enough for the pending halves of 2^31 points. */
enum { STACK = 64 };

void mor_tree_resize(mor_tree *tree, int64_t n_points)
{
    tree->n_points = n_points;
    tree->n_clusters = (n_points + MOR_CLUSTER - 1) / MOR_CLUSTER;
}

mor_status mor_tree_init(mor_context *context, mor_tree *tree, int64_t n_points)
{
    memset(tree, 0, sizeof *tree);
    mor_tree_resize(tree, n_points);
    const int64_t n_nodes = tree->n_clusters > 0 ? 2 * tree->n_clusters - 1 : 0;
    return MOR_NEW(context, &tree->boxes, 6 * n_nodes, "bounding boxes of particle clusters");
}

void mor_tree_clear(mor_context *context, mor_tree *tree)
{
    MOR_FREE(context, &tree->boxes);
    memset(tree, 0, sizeof *tree);
}

/* Where a coordinate of the point named at a place of the order is found. */
typedef struct view {
    const double *points;
    const int64_t *numbers; /* by which equal coordinates are told apart; NULL: by place */
    int stride;
    int axis;
} view;

static int is_before(const view *v, int32_t a, int32_t b)
{
    const double x = v->points[(int64_t)a * v->stride + v->axis];
    const double y = v->points[(int64_t)b * v->stride + v->axis];
    return x < y || (x == y && (v->numbers != NULL ? v->numbers[a] < v->numbers[b] : a < b));
}

static void swap_places(int32_t *order, int64_t a, int64_t b)
{
    const int32_t kept = order[a];
    order[a] = order[b];
    order[b] = kept;
}

/* Moves the median of three to the middle, where the partition expects its pivot. */
static void order_three(const view *v, int32_t *order, int64_t low, int64_t middle, int64_t high)
{
    if (is_before(v, order[middle], order[low])) {
        swap_places(order, middle, low);
    }
    if (is_before(v, order[high], order[low])) {
        swap_places(order, high, low);
    }
    if (is_before(v, order[high], order[middle])) {
        swap_places(order, high, middle);
    }
}

/* Quickselect: places [low, nth) then hold what comes before, [nth, high] the rest. */
static void select_nth(const view *v, int32_t *order, int64_t low, int64_t high, int64_t nth)
{
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        order_three(v, order, low, middle, high);
        const int32_t pivot = order[middle];
        int64_t i = low;
        int64_t j = high;
        while (i <= j) {
            while (is_before(v, order[i], pivot)) {
                ++i;
            }
            while (is_before(v, pivot, order[j])) {
                --j;
            }
            if (i <= j) {
                swap_places(order, i, j);
                ++i;
                --j;
            }
        }
        if (nth <= j) {
            high = j;
        } else if (nth >= i) {
            low = i;
        } else {
            return;
        }
    }
}

static int longest_axis(const double *points, int stride, const int32_t *order, int64_t begin, int64_t end)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t place = begin; place < end; ++place) {
        const double *point = points + (int64_t)order[place] * stride;
        for (int a = 0; a < 3; ++a) {
            low[a] = point[a] < low[a] ? point[a] : low[a];
            high[a] = point[a] > high[a] ? point[a] : high[a];
        }
    }
    int axis = 0;
    for (int a = 1; a < 3; ++a) {
        axis = high[a] - low[a] > high[axis] - low[axis] ? a : axis;
    }
    return axis;
}

/* Orders the points of a part so that those from middle on come after the others along its longest axis. */
static void divide(const mor_tree_points *it, int32_t *order, int64_t begin, int64_t middle, int64_t end)
{
    const view v = {it->points, it->numbers, it->stride, longest_axis(it->points, it->stride, order, begin, end)};
    select_nth(&v, order, begin, end - 1, middle);
}

/* Splits what has more clusters than a block, beginning with the order that is given, and each cluster that stands
 * alone into halves: narrow registers hold one half, and leave out what only the other one sees. */
static void split(const mor_tree_points *it, int64_t block_clusters, bool has_halves, int32_t *order)
{
    struct {
        int64_t begin, end;
    } stack[STACK];
    int depth = 0;
    stack[depth].begin = 0;
    stack[depth++].end = (it->n_points + MOR_CLUSTER - 1) / MOR_CLUSTER;
    while (depth > 0) {
        --depth;
        const int64_t begin = stack[depth].begin;
        const int64_t end = stack[depth].end;
        const int64_t last = end * MOR_CLUSTER < it->n_points ? end * MOR_CLUSTER : it->n_points;
        if (end - begin <= block_clusters) {
            const int64_t half = begin * MOR_CLUSTER + MOR_CLUSTER / 2;
            if (has_halves && half < last) {
                divide(it, order, begin * MOR_CLUSTER, half, last);
            }
            continue;
        }
        const int64_t middle = begin + mor_tree_left(end - begin);
        divide(it, order, begin * MOR_CLUSTER, middle * MOR_CLUSTER, last);
        stack[depth].begin = begin;
        stack[depth++].end = middle;
        stack[depth].begin = middle;
        stack[depth++].end = end;
    }
}

static void start_order(int64_t n_points, int32_t *order)
{
    for (int64_t place = 0; place < n_points; ++place) {
        order[place] = (int32_t)place;
    }
}

void mor_tree_order(const double *points, int stride, int64_t n_points, int32_t *order)
{
    const mor_tree_points all = {points, NULL, stride, n_points};
    start_order(n_points, order);
    split(&all, 1, true, order);
}

void mor_tree_order_blocks(const mor_tree_points *points, int64_t block_clusters, int32_t *order)
{
    start_order(points->n_points, order);
    split(points, block_clusters, false, order);
}

void mor_tree_order_block(const mor_tree_points *points, int32_t *order)
{
    start_order(points->n_points, order);
    split(points, 1, true, order);
}

int64_t mor_tree_block_end(int64_t n_clusters, int64_t block_clusters, int64_t begin)
{
    int64_t first = 0;
    int64_t end = n_clusters;
    while (end - first > block_clusters) {
        const int64_t middle = first + mor_tree_left(end - first);
        first = begin < middle ? first : middle;
        end = begin < middle ? middle : end;
    }
    return end;
}

void mor_tree_bound_cluster(const mor_tree *tree, const double *points, int stride, int64_t cluster, double *box)
{
    const int64_t begin = cluster * MOR_CLUSTER;
    const int64_t end = begin + MOR_CLUSTER < tree->n_points ? begin + MOR_CLUSTER : tree->n_points;
    for (int a = 0; a < 3; ++a) {
        box[a] = INFINITY;
        box[3 + a] = -INFINITY;
    }
    for (int64_t i = begin; i < end; ++i) {
        for (int a = 0; a < 3; ++a) {
            const double x = points[i * stride + a];
            box[a] = x < box[a] ? x : box[a];
            box[3 + a] = x > box[3 + a] ? x : box[3 + a];
        }
    }
}

static void join_boxes(const double *left, const double *right, double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = left[a] < right[a] ? left[a] : right[a];
        box[3 + a] = left[3 + a] > right[3 + a] ? left[3 + a] : right[3 + a];
    }
}

/* Depth is at most 31, so recursion is safe. */
static void fit_node(mor_tree *tree, const double *points, int stride, int64_t node, int64_t begin, int64_t end)
{
    double *box = tree->boxes + 6 * node;
    if (end - begin == 1) {
        mor_tree_bound_cluster(tree, points, stride, begin, box);
        return;
    }
    const int64_t left = mor_tree_left(end - begin);
    fit_node(tree, points, stride, node + 1, begin, begin + left);
    fit_node(tree, points, stride, node + 2 * left, begin + left, end);
    join_boxes(tree->boxes + 6 * (node + 1), tree->boxes + 6 * (node + 2 * left), box);
}

void mor_tree_fit(mor_tree *tree, const double *points, int stride)
{
    if (tree->n_clusters > 0) {
        fit_node(tree, points, stride, 0, 0, tree->n_clusters);
    }
}
