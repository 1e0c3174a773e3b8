/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_TREE_H
#define MOR_CORE_PARTICLE_TREE_H

#include "core/base/context.h"
#include "core/base/math.h"

#include <stdint.h>

/** @file
 *  Clusters of eight particles and the tree of their bounding boxes. Splitting the longest side of the box at a
 *  multiple of eight again and again gives compact clusters, which share one neighbor list (core/particle/relation.h).
 *  The tree's shape depends only on the number of clusters, so refitting it to moved particles is one sweep. */

enum {
    MOR_CLUSTER = 8 /* particles per cluster: one 512-bit register of doubles */
};

/** Boxes of a tree in depth-first order: the left child of node k is k + 1, the right child is
 *  k + 2 * (clusters of the left child). Owner: whoever called mor_tree_init. */
typedef struct mor_tree {
    int64_t n_points;   /* points covered */
    int64_t n_clusters; /* ceil(n_points / 8) */
    double *boxes;      /* shape [2 * n_clusters - 1, 6]; minimum and maximum corner, unit m */
} mor_tree;

/** Makes a tree for a number of points.
 *  @param n_points [in]      number of points, >= 0
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_tree_init(mor_context *context, mor_tree *tree, int64_t n_points);

/** Makes a tree smaller, or as large again as it was made.
 *  @param n_points [in]      number of points, >= 0; at most those it was made for
 *  Gives: boxes are to be fitted anew. */
void mor_tree_resize(mor_tree *tree, int64_t n_points);

/** Frees what the tree owns; accepts a zeroed tree. */
void mor_tree_clear(mor_context *context, mor_tree *tree);

/** Finds an order in which every eight consecutive points form a compact cluster, whose first four come before the
 *  others along its longest axis. Equal coordinates are told apart by place, so the order is a pure function of the
 *  points in their present order.
 *  @param points   [in]   shape [n_points, stride]; the first three numbers of a record are x, y, z; unit m
 *  @param stride   [in]   doubles per record, >= 3
 *  @param n_points [in]   number of points
 *  @param order    [out]  shape [n_points]; the point that belongs at each place
 *  Cost: O(n log n), allocates nothing. */
void mor_tree_order(const double *points, int stride, int64_t n_points, int32_t *order);

/** Points to be ordered. Everything is borrowed. */
typedef struct mor_tree_points {
    const double *points;   /* shape [n_points, stride]; the first three numbers of a record are x, y, z; unit m */
    const int64_t *numbers; /* shape [n_points]; by which equal coordinates are told apart; NULL: by place */
    int stride;             /* doubles per record, >= 3 */
    int64_t n_points;
} mor_tree_points;

/** Finds the order of mor_tree_order as far as blocks: which points belong to each block of clusters that follow one
 *  another. Within a block they are left in the order that mor_tree_order has there before it divides the block.
 *  @param block_clusters [in]   clusters of the largest block, >= 1
 *  @param order          [out]  shape [n_points]; the point that belongs at each place
 *  Cost: O(n log(n / block)), allocates nothing. */
void mor_tree_order_blocks(const mor_tree_points *points, int64_t block_clusters, int32_t *order);

/** Orders one block as mor_tree_order orders all points.
 *  @param points [in]   those of the block as mor_tree_order_blocks left them, with numbers that ascend with the place
 *                       each had there
 *  @param order  [out]  shape [n_points]; the point that belongs at each place */
void mor_tree_order_block(const mor_tree_points *points, int32_t *order);

/** Returns where a block ends, one past its last cluster.
 *  @param n_clusters     [in]  of all points
 *  @param block_clusters [in]  as given to mor_tree_order_blocks
 *  @param begin          [in]  first cluster of the block: 0, or where another block ends */
int64_t mor_tree_block_end(int64_t n_clusters, int64_t block_clusters, int64_t begin);

/** Fits the boxes to the points, which must lie in tree order.
 *  @param points [in]      shape [n_points, stride]; unit m
 *  @param stride [in]      doubles per record, >= 3 */
void mor_tree_fit(mor_tree *tree, const double *points, int stride);

/** Finds the box of the points of a cluster.
 *  @param points  [in]   shape [n_points, stride]; unit m
 *  @param stride  [in]   doubles per record, >= 3
 *  @param cluster [in]   0 to n_clusters - 1
 *  @param box     [out]  shape [6]; minimum and maximum corner, unit m */
void mor_tree_bound_cluster(const mor_tree *tree, const double *points, int stride, int64_t cluster, double *box);

/** Squared distance of two boxes, zero where they meet, m2.
 *  @param box   [in]  shape [6]; minimum and maximum corner, unit m
 *  @param other [in]  shape [6]; likewise, unit m */
static inline double mor_tree_box_gap2(const double *box, const double *other)
{
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double gap = mor_max(0.0, mor_max(other[a] - box[3 + a], box[a] - other[3 + a]));
        sum += gap * gap;
    }
    return sum;
}

/** Number of clusters in the left child of a node with n_clusters >= 2 clusters, 1. */
static inline int64_t mor_tree_left(int64_t n_clusters)
{
    return n_clusters / 2;
}

#endif
