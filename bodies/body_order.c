/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Which particles share a cluster. On a lattice: those of a block of 2 x 2 x 2 (4 x 2) places, always in the same
 * order, so that clusters see as few neighbors as can be and all see the same ones. Incomplete blocks at the surface,
 * and particles that form no lattice, are ordered by a tree. */
#include "bodies/body_internal.h"

#include "core/base/memory.h"
#include "core/particle/tree.h"

#include <stdlib.h>

enum { AXIS_BITS = 21, AXIS_PLACES = 1 << AXIS_BITS };

/* An item and its key in the order. */
typedef struct ranked {
    uint64_t key;
    int32_t lane; /* in its block */
    int32_t item; /* particle, or first place of a cluster */
} ranked;

static int compare_ranked(const void *a, const void *b)
{
    const ranked *x = a;
    const ranked *y = b;
    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    if (x->lane != y->lane) {
        return x->lane < y->lane ? -1 : 1;
    }
    return x->item < y->item ? -1 : 1;
}

/* Key of a block along the Z-order curve (Morton 1966): interleaved bits of the coordinates. */
static uint64_t key_of(const int64_t *block)
{
    uint64_t key = 0;
    for (int bit = 0; bit < AXIS_BITS; ++bit) {
        for (int a = 0; a < 3; ++a) {
            key |= ((uint64_t)block[a] >> bit & 1U) << (3 * bit + a);
        }
    }
    return key;
}

static void find_local(const mor_body_request *request, int64_t i, double *local)
{
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = request->positions[3 * i + a] - request->shape_translation[a];
    }
    mor_matrix_apply_transposed(request->shape_rotation, offset, local);
}

/* Block and lane of each particle, in the frame of the shape. */
static void rank_particles(const mor_body_request *request, int dimension, double spacing, ranked *particles)
{
    static const int64_t sides[2][3] = {{4, 2, 1}, {2, 2, 2}};
    const int64_t *side = sides[dimension - 2];
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double local[3];
    for (int64_t i = 0; i < request->n_particles; ++i) {
        find_local(request, i, local);
        for (int a = 0; a < 3; ++a) {
            low[a] = local[a] < low[a] ? local[a] : low[a];
        }
    }
    for (int64_t i = 0; i < request->n_particles; ++i) {
        int64_t block[3] = {0, 0, 0};
        int64_t lane = 0;
        find_local(request, i, local);
        for (int a = dimension - 1; a >= 0; --a) {
            const double steps = floor((local[a] - low[a]) / spacing + 0.5);
            const int64_t place = steps < AXIS_PLACES ? (int64_t)steps : AXIS_PLACES - 1;
            block[a] = place / side[a];
            lane = lane * side[a] + place % side[a];
        }
        particles[i] = (ranked){key_of(block), (int32_t)lane, (int32_t)i};
    }
    qsort(particles, (size_t)request->n_particles, sizeof *particles, compare_ranked);
}

static bool is_full_block(const ranked *particles, int64_t n_left)
{
    for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
        if (lane >= n_left || particles[lane].key != particles->key || particles[lane].lane != lane) {
            return false;
        }
    }
    return n_left == MOR_CLUSTER || particles[MOR_CLUSTER].key != particles->key;
}

/* Full blocks to the front of the list, the others behind them; returns how many particles are in full blocks. */
static int64_t part_blocks(const ranked *particles, int64_t n, ranked *list)
{
    int64_t n_full = 0;
    int64_t n_rest = 0;
    for (int64_t i = 0; i < n;) {
        if (is_full_block(particles + i, n - i)) {
            for (int lane = 0; lane < MOR_CLUSTER; ++lane) {
                list[n_full++] = particles[i++];
            }
        } else {
            list[n - 1 - n_rest++] = particles[i++];
        }
    }
    return n_full;
}

/* Orders the rest of the list by a tree. */
static mor_status order_rest(mor_context *context, const double *positions, ranked *rest, int64_t n)
{
    double *points = NULL;
    int32_t *order = NULL;
    ranked *copy = NULL;
    mor_status status = MOR_NEW(context, &points, 3 * n, "order of body particles");
    status = status == MOR_OK ? MOR_NEW(context, &order, n, "order of body particles") : status;
    status = status == MOR_OK ? MOR_NEW(context, &copy, n, "order of body particles") : status;
    if (status == MOR_OK) {
        for (int64_t k = 0; k < n; ++k) {
            copy[k] = rest[k];
            for (int a = 0; a < 3; ++a) {
                points[3 * k + a] = positions[3 * (int64_t)rest[k].item + a];
            }
        }
        mor_tree_order(points, 3, n, order);
        for (int64_t k = 0; k < n; ++k) {
            rest[k] = copy[order[k]];
        }
    }
    MOR_FREE(context, &copy);
    MOR_FREE(context, &order);
    MOR_FREE(context, &points);
    return status;
}

/* Clusters of the list along the curve of their blocks; one that is not full stays last. */
static void order_clusters(const ranked *list, int64_t n, ranked *clusters, int32_t *order)
{
    const int64_t n_clusters = (n + MOR_CLUSTER - 1) / MOR_CLUSTER;
    for (int64_t c = 0; c < n_clusters; ++c) {
        const bool is_full = (c + 1) * MOR_CLUSTER <= n;
        clusters[c] = (ranked){is_full ? list[c * MOR_CLUSTER].key : UINT64_MAX, 0, (int32_t)(c * MOR_CLUSTER)};
    }
    qsort(clusters, (size_t)n_clusters, sizeof *clusters, compare_ranked);
    for (int64_t c = 0; c < n_clusters; ++c) {
        for (int64_t k = clusters[c].item; k < clusters[c].item + MOR_CLUSTER && k < n; ++k) {
            *order++ = list[k].item;
        }
    }
}

mor_status mor_body_order(mor_context *context, const mor_body_request *request, int dimension, double spacing,
                          int32_t *order)
{
    const int64_t n = request->n_particles;
    ranked *particles = NULL;
    ranked *list = NULL;
    mor_status status = MOR_NEW(context, &particles, n, "order of body particles");
    status = status == MOR_OK ? MOR_NEW(context, &list, n, "order of body particles") : status;
    if (status == MOR_OK) {
        rank_particles(request, dimension, spacing, particles);
        const int64_t n_full = part_blocks(particles, n, list);
        if (2 * n_full < n) {
            mor_tree_order(request->positions, 3, n, order);
        } else {
            status = order_rest(context, request->positions, list + n_full, n - n_full);
            order_clusters(list, n, particles, order);
        }
    }
    MOR_FREE(context, &list);
    MOR_FREE(context, &particles);
    return status;
}
