/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_spread.h"

#include "cases/driver/scene/simulation.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

mor_status mor_map_sums_init(mor_context *context, const mor_map_grid *grid, int64_t n_points, mor_map_sums *sums)
{
    *sums = (mor_map_sums){.n_points = n_points};
    MOR_TRY(context, MOR_NEW(context, &sums->rows, n_points, "rows of particles on maps"));
    MOR_TRY(context, MOR_NEW(context, &sums->values, MOR_MAP_SUMS * mor_map_grid_cells(grid), "sums of maps"));
    return MOR_NEW(context, &sums->ranges, 2 * (int64_t)grid->n[1], "rows of maps");
}

void mor_map_sums_clear(mor_context *context, mor_map_sums *sums)
{
    MOR_FREE(context, &sums->values);
    MOR_FREE(context, &sums->ranges);
    MOR_FREE(context, &sums->rows);
}

void mor_map_sums_empty(const mor_map_grid *grid, mor_map_sums *sums)
{
    for (int row = 0; row < grid->n[1]; ++row) {
        int32_t *range = sums->ranges + 2 * row;
        const int64_t first = (int64_t)row * grid->n[0] + range[0];
        memset(sums->values + MOR_MAP_SUMS * first, 0,
               (size_t)(range[1] - range[0]) * MOR_MAP_SUMS * sizeof *sums->values);
        range[0] = 0;
        range[1] = 0;
    }
}

/* Cells that a square touches along an axis, and its ends, in cells from the origin of the grid. */
typedef struct stretch {
    double low, high;
    int first, last; /* not yet brought inside the grid */
} stretch;

static stretch find_stretch(const mor_map_grid *grid, int axis, double middle, double width)
{
    stretch it;
    it.low = (middle - 0.5 * width - grid->origin[axis]) / grid->cell[axis];
    it.high = it.low + width / grid->cell[axis];
    const double first = floor(it.low);
    const double last = ceil(it.high) - 1.0;
    /* Far outside, as a rock that leaves: all of it goes to the edge. */
    it.first = (int)fmin(fmax(first, -1.0), grid->n[axis]);
    it.last = (int)fmin(fmax(last, -1.0), grid->n[axis]);
    return it;
}

/* The share of a square that lies in a cell along an axis; beyond the edges of the grid the cells go on without end. */
static double find_share(const mor_map_grid *grid, int axis, const stretch *it, int cell)
{
    const double from = cell < 0 ? it->low : fmax(it->low, (double)cell);
    const double to = cell >= grid->n[axis] ? it->high : fmin(it->high, cell + 1.0);
    return (to - from) / (it->high - it->low);
}

static int bring_inside(const mor_map_grid *grid, int axis, int cell)
{
    return cell < 0 ? 0 : cell >= grid->n[axis] ? grid->n[axis] - 1 : cell;
}

static void add_row(const mor_map_grid *grid, const stretch *x, double share, const double *sums, int row,
                    mor_map_sums *out)
{
    int32_t *range = out->ranges + 2 * row;
    const int begin = bring_inside(grid, 0, x->first);
    const int end = bring_inside(grid, 0, x->last) + 1;
    const bool is_new = range[0] == range[1];
    range[0] = is_new || begin < range[0] ? begin : range[0];
    range[1] = is_new || end > range[1] ? end : range[1];
    for (int column = x->first; column <= x->last; ++column) {
        const double part = share * find_share(grid, 0, x, column);
        double *cell = out->values + MOR_MAP_SUMS * ((int64_t)row * grid->n[0] + bring_inside(grid, 0, column));
        for (int k = 0; k < MOR_MAP_SUMS; ++k) {
            cell[k] += part * sums[k];
        }
    }
}

/* The place of a particle before the placement of the case; room: shape [3]. */
static const double *find_place(const mor_map_points *points, int64_t i, double *room)
{
    if (!points->is_placed) {
        return points->position + 3 * i;
    }
    mor_simulation_take_point_back(points->the_case, points->position + 3 * i, room);
    return room;
}

/* One particle into those of its rows that a stripe has. */
static void add_point(const mor_map_grid *grid, const mor_map_points *points, int64_t i, int stripe, int n_stripes,
                      mor_map_sums *out)
{
    double room[3];
    double sums[MOR_MAP_SUMS];
    const double *place = find_place(points, i, room);
    const double mass = points->mass[i];
    const stretch x = find_stretch(grid, 0, place[0], points->width);
    const stretch y = find_stretch(grid, 1, place[1], points->width);
    sums[MOR_MAP_SUM_VOLUME] = points->volume != NULL ? points->volume[i] : mass / points->density[i];
    sums[MOR_MAP_SUM_MASS] = mass;
    for (int a = 0; a < 3; ++a) {
        sums[MOR_MAP_SUM_MOMENTUM_X + a] = mass * points->velocity[3 * i + a];
    }
    for (int cell = y.first; cell <= y.last; ++cell) {
        const int row = bring_inside(grid, 1, cell);
        if (row % n_stripes == stripe) {
            add_row(grid, &x, find_share(grid, 1, &y, cell), sums, row, out);
        }
    }
}

static void find_rows(mor_context *context, const mor_map_grid *grid, const mor_map_points *points, mor_map_sums *sums)
{
    MOR_PARALLEL_FOR (context, block, mor_block_count(points->n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, points->n); ++i) {
            double room[3];
            const stretch y = find_stretch(grid, 1, find_place(points, i, room)[1], points->width);
            sums->rows[i] = bring_inside(grid, 1, y.first);
        }
    }
}

/* Each thread has rows of its own and looks at all particles in their order; most are not in its rows. */
void mor_map_spread(mor_context *context, const mor_map_grid *grid, const mor_map_points *points, mor_map_sums *sums)
{
    const int n_stripes = context->n_threads;
    const double most_rows = floor(points->width / grid->cell[1]) + 2.0;
    find_rows(context, grid, points, sums);
    MOR_PARALLEL_FOR (context, stripe, n_stripes, 1) {
        for (int64_t i = 0; i < points->n; ++i) {
            const int gap = (int)stripe - sums->rows[i] % n_stripes;
            if ((gap < 0 ? gap + n_stripes : gap) < most_rows) {
                add_point(grid, points, i, (int)stripe, n_stripes, sums);
            }
        }
    }
}
