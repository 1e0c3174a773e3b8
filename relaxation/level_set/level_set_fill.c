/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/level_set/level_set_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

enum { BLOCK_SIDE = 8 }; /* nodes each way */

/* Distances are correct to rounding; comparisons allow for this relative error. */
static const double rounding = 1e-9;

/* Nodes of a block: first <= index < last each way. */
typedef struct node_block {
    int64_t first[3];
    int64_t last[3];
} node_block;

/* Connected parts of the grid on one side of the surface, found one after another. */
typedef struct sign_search {
    mor_level_set_grid *grid;
    const mor_level_set_source *source;
    bool *is_seen;  /* shape [n_nodes] */
    int32_t *queue; /* shape [n_nodes]; nodes of the present part */
    int64_t n_queue;
} sign_search;

static void place_node(const mor_level_set_grid *grid, const double *index, double *point)
{
    for (int a = 0; a < 3; ++a) {
        point[a] = a < grid->dimension ? grid->origin[a] + index[a] * grid->cell : 0.0;
    }
}

static void find_index(const mor_level_set_grid *grid, int64_t node, int64_t *index)
{
    index[0] = node % grid->counts[0];
    index[1] = node / grid->counts[0] % grid->counts[1];
    index[2] = node / (grid->counts[0] * grid->counts[1]);
}

static int64_t count_blocks(const mor_level_set_grid *grid, int axis)
{
    return (grid->counts[axis] + BLOCK_SIDE - 1) / BLOCK_SIDE;
}

static node_block find_block(const mor_level_set_grid *grid, int64_t number)
{
    node_block block;
    for (int a = 0; a < 3; ++a) {
        const int64_t n_blocks = count_blocks(grid, a);
        block.first[a] = number % n_blocks * BLOCK_SIDE;
        block.last[a] = block.first[a] + BLOCK_SIDE < grid->counts[a] ? block.first[a] + BLOCK_SIDE : grid->counts[a];
        number /= n_blocks;
    }
    return block;
}

/* Whether all of a block is beyond the band; value receives what its nodes are then. */
static bool is_block_far(const mor_level_set_grid *grid, const mor_level_set_source *source, const node_block *block,
                         double *value)
{
    double middle[3];
    double point[3];
    double reach2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double half = 0.5 * (double)(block->last[a] - 1 - block->first[a]);
        middle[a] = (double)block->first[a] + half;
        reach2 += half * half;
    }
    place_node(grid, middle, point);
    const double limit = (grid->band + MOR_SHAPE_SLOPE_MOST * sqrt(reach2) * grid->cell) * (1.0 + rounding);
    const double distance = source->measure(source->object, point, limit);
    *value = copysign(grid->band, distance);
    return fabs(distance) >= limit;
}

/* A node cannot be farther from the surface than its neighbor by more than a cell: that shortens the search. */
static void measure_row(const mor_level_set_grid *grid, const mor_level_set_source *source, const double *start,
                        int64_t count, double *row)
{
    double limit = grid->band;
    for (int64_t i = 0; i < count; ++i) {
        const double index[3] = {start[0] + (double)i, start[1], start[2]};
        double point[3];
        place_node(grid, index, point);
        const double distance = source->measure(source->object, point, limit);
        row[i] = fmax(-grid->band, fmin(distance, grid->band));
        limit = fmin(grid->band, (fabs(row[i]) + grid->cell) * (1.0 + rounding));
    }
}

static void measure_block(const mor_level_set_grid *grid, const mor_level_set_source *source, int64_t number)
{
    const node_block block = find_block(grid, number);
    double value;
    const bool is_far = is_block_far(grid, source, &block, &value);
    for (int64_t z = block.first[2]; z < block.last[2]; ++z) {
        for (int64_t y = block.first[1]; y < block.last[1]; ++y) {
            const int64_t count = block.last[0] - block.first[0];
            double *row = grid->values + (z * grid->counts[1] + y) * grid->counts[0] + block.first[0];
            const double start[3] = {(double)block.first[0], (double)y, (double)z};
            for (int64_t i = 0; i < count && is_far; ++i) {
                row[i] = value;
            }
            if (!is_far) {
                measure_row(grid, source, start, count, row);
            }
        }
    }
}

/* Takes in the neighbors of a node that are farther apart from the surface, together, than from one another. */
static void join_neighbors(sign_search *search, int32_t node)
{
    const mor_level_set_grid *grid = search->grid;
    const int64_t steps[3] = {1, grid->counts[0], grid->counts[0] * grid->counts[1]};
    const double needed = grid->cell * (1.0 + rounding) - fabs(grid->values[node]);
    int64_t index[3];
    find_index(grid, node, index);
    for (int a = 0; a < grid->dimension; ++a) {
        for (int side = -1; side <= 1; side += 2) {
            const int64_t other = node + side * steps[a];
            if (index[a] + side < 0 || index[a] + side >= grid->counts[a] || search->is_seen[other] ||
                fabs(grid->values[other]) <= needed) {
                continue;
            }
            search->is_seen[other] = true;
            search->queue[search->n_queue++] = (int32_t)other;
        }
    }
}

/* One inside test decides for a whole part, at its node farthest from the surface, where it is most reliable. */
static void sign_part(sign_search *search, int64_t seed)
{
    const mor_level_set_grid *grid = search->grid;
    int32_t farthest = (int32_t)seed;
    search->is_seen[seed] = true;
    search->queue[0] = (int32_t)seed;
    search->n_queue = 1;
    for (int64_t k = 0; k < search->n_queue; ++k) {
        const int32_t node = search->queue[k];
        const double excess = grid->values[node] - grid->values[farthest];
        if (excess > 0.0 || (excess == 0.0 && node < farthest)) {
            farthest = node;
        }
        join_neighbors(search, node);
    }
    int64_t index[3];
    double point[3];
    find_index(grid, farthest, index);
    place_node(grid, (const double[3]){(double)index[0], (double)index[1], (double)index[2]}, point);
    if (search->source->is_inside(search->source->object, point)) {
        for (int64_t k = 0; k < search->n_queue; ++k) {
            grid->values[search->queue[k]] = -grid->values[search->queue[k]];
        }
    }
}

static mor_status find_signs(mor_context *context, mor_level_set_grid *grid, const mor_level_set_source *source,
                             int64_t n_nodes)
{
    sign_search search = {.grid = grid, .source = source};
    mor_status status = MOR_NEW(context, &search.is_seen, n_nodes, "marks of a level set");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &search.queue, n_nodes, "nodes of a level set");
    }
    for (int64_t node = 0; node < n_nodes && status == MOR_OK; ++node) {
        if (!search.is_seen[node]) {
            sign_part(&search, node);
        }
    }
    MOR_FREE(context, &search.queue);
    MOR_FREE(context, &search.is_seen);
    return status;
}

mor_status mor_level_set_fill(mor_context *context, mor_level_set_grid *grid, const mor_level_set_source *source)
{
    const int64_t n_nodes = grid->counts[0] * grid->counts[1] * grid->counts[2];
    const int64_t n_blocks = count_blocks(grid, 0) * count_blocks(grid, 1) * count_blocks(grid, 2);
    MOR_TRY(context, MOR_NEW(context, &grid->values, n_nodes, "level set"));
    MOR_PARALLEL_FOR (context, number, n_blocks, 1) {
        measure_block(grid, source, number);
    }
    if (source->is_inside != NULL) {
        MOR_TRY(context, find_signs(context, grid, source, n_nodes));
    }
    return MOR_OK;
}
