/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/memory.h"

#include <math.h>

/* Holes are solved until no height changes by more than this share of the relief, or for so many sweeps. */
#define HOLE_CHANGE 1e-7
enum { HOLE_SWEEPS_MAX = 20000 };

/* Over-relaxation of the sweeps; any value in (1, 2) converges. */
#define HOLE_RELAXATION 1.8

/* A share of a cell by which the raster may end short of the last node of a new grid. */
#define ON_NODE 1e-9

/* Mean over the up to four neighbors that have a height; NaN when none has. */
static double average_neighbors(const mor_terrain *terrain, int column, int row)
{
    static const int step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    double sum = 0.0;
    int n = 0;
    for (int k = 0; k < 4; ++k) {
        const int x = column + step[k][0];
        const int y = row + step[k][1];
        if (x < 0 || y < 0 || x >= terrain->n_x || y >= terrain->n_y) {
            continue;
        }
        const double height = terrain->heights[(int64_t)y * terrain->n_x + x];
        if (!isnan(height)) {
            sum += height;
            ++n;
        }
    }
    return n > 0 ? sum / n : NAN;
}

/* An initial guess: rings of the mean of their known neighbors, from the boundary inwards. Each ring is found before
 * any of it is written. */
static void guess_holes(mor_terrain *terrain, const int64_t *holes, int64_t n_holes, double *next)
{
    for (int64_t n_left = n_holes; n_left > 0;) {
        for (int64_t k = 0; k < n_holes; ++k) {
            const double height = terrain->heights[holes[k]];
            next[k] = !isnan(height)
                          ? height
                          : average_neighbors(terrain, (int)(holes[k] % terrain->n_x), (int)(holes[k] / terrain->n_x));
        }
        n_left = 0;
        for (int64_t k = 0; k < n_holes; ++k) {
            terrain->heights[holes[k]] = next[k];
            n_left += isnan(next[k]);
        }
    }
}

static void solve_holes(mor_terrain *terrain, const int64_t *holes, int64_t n_holes, double relief)
{
    for (int sweep = 0; sweep < HOLE_SWEEPS_MAX; ++sweep) {
        double largest = 0.0;
        for (int64_t k = 0; k < n_holes; ++k) {
            const int column = (int)(holes[k] % terrain->n_x);
            const int row = (int)(holes[k] / terrain->n_x);
            double *height = &terrain->heights[holes[k]];
            const double change = HOLE_RELAXATION * (average_neighbors(terrain, column, row) - *height);
            *height += change;
            largest = fmax(largest, fabs(change));
        }
        if (!(largest > HOLE_CHANGE * relief)) {
            return;
        }
    }
}

mor_status mor_terrain_fill_holes(mor_context *context, mor_terrain *terrain)
{
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    int64_t n_holes = 0;
    double lowest;
    double highest;
    for (int64_t n = 0; n < n_nodes; ++n) {
        n_holes += isnan(terrain->heights[n]);
    }
    if (n_holes == 0) {
        return MOR_OK;
    }
    int64_t *holes = NULL;
    double *next = NULL;
    mor_status status = MOR_NEW(context, &holes, n_holes, "holes of a raster");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &next, n_holes, "heights of holes");
    }
    if (status == MOR_OK) {
        int64_t at = 0;
        for (int64_t n = 0; n < n_nodes; ++n) {
            if (isnan(terrain->heights[n])) {
                holes[at++] = n;
            }
        }
        mor_terrain_range(terrain, &lowest, &highest);
        guess_holes(terrain, holes, n_holes, next);
        solve_holes(terrain, holes, n_holes, highest - lowest);
        mor_context_log(context, MOR_LOG_INFO, "terrain: %lld of %lld nodes without data filled from their boundaries",
                        (long long)n_holes, (long long)n_nodes);
    }
    MOR_FREE(context, &next);
    MOR_FREE(context, &holes);
    return status;
}

/* Height between nodes, linear along both axes. */
static double interpolate(const mor_terrain *terrain, double column, double row)
{
    const int x = (int)fmin(column, terrain->n_x - 2.0);
    const int y = (int)fmin(row, terrain->n_y - 2.0);
    const double s = fmin(column - x, 1.0);
    const double t = fmin(row - y, 1.0);
    const double *at = terrain->heights + (int64_t)y * terrain->n_x + x;
    const double lower = (1.0 - s) * at[0] + s * at[1];
    const double upper = (1.0 - s) * at[terrain->n_x] + s * at[terrain->n_x + 1];
    return (1.0 - t) * lower + t * upper;
}

/* Cells to add before the first node and behind the last one. */
static void count_cells(const mor_terrain *terrain, int axis, double minimum, double maximum, double *cells)
{
    cells[0] = ceil((terrain->origin[axis] - minimum) / terrain->cell[axis] - ON_NODE);
    cells[1] = ceil((maximum - mor_terrain_end(terrain, axis)) / terrain->cell[axis] - ON_NODE);
    cells[0] = fmax(cells[0], 0.0);
    cells[1] = fmax(cells[1], 0.0);
}

mor_status mor_terrain_extend(mor_context *context, mor_terrain *terrain, const double *minimum, const double *maximum)
{
    double cells[2][2];
    double n[2];
    for (int a = 0; a < 2; ++a) {
        count_cells(terrain, a, minimum[a], maximum[a], cells[a]);
        n[a] = (a == 0 ? terrain->n_x : terrain->n_y) + cells[a][0] + cells[a][1];
    }
    if (n[0] == terrain->n_x && n[1] == terrain->n_y) {
        return MOR_OK;
    }
    MOR_CHECK(context, n[0] * n[1] <= MOR_TERRAIN_NODES_MAX, MOR_ERROR_ARGUMENT,
              "to cover the domain the raster is continued to %g x %g nodes; allowed are %g in all: use a smaller "
              "domain or larger cells",
              n[0], n[1], MOR_TERRAIN_NODES_MAX);
    double *heights = NULL;
    MOR_TRY(context, MOR_NEW(context, &heights, (int64_t)n[0] * (int64_t)n[1], "terrain heights"));
    for (int row = 0; row < (int)n[1]; ++row) {
        const int from_row = (int)fmin(fmax(row - cells[1][0], 0.0), terrain->n_y - 1.0);
        for (int column = 0; column < (int)n[0]; ++column) {
            const int from = (int)fmin(fmax(column - cells[0][0], 0.0), terrain->n_x - 1.0);
            heights[(int64_t)row * (int)n[0] + column] = terrain->heights[(int64_t)from_row * terrain->n_x + from];
        }
    }
    MOR_FREE(context, &terrain->heights);
    terrain->heights = heights;
    terrain->n_x = (int)n[0];
    terrain->n_y = (int)n[1];
    for (int a = 0; a < 2; ++a) {
        terrain->origin[a] -= cells[a][0] * terrain->cell[a];
        terrain->added[a][0] += (int)cells[a][0];
        terrain->added[a][1] += (int)cells[a][1];
    }
    return MOR_OK;
}

mor_status mor_terrain_resample(mor_context *context, mor_terrain *terrain, double cell)
{
    double n[2];
    for (int a = 0; a < 2; ++a) {
        const double extent = ((a == 0 ? terrain->n_x : terrain->n_y) - 1) * terrain->cell[a];
        n[a] = floor(extent / cell + ON_NODE) + 1.0;
        MOR_CHECK(context, n[a] >= 2.0, MOR_ERROR_ARGUMENT,
                  "the raster is %g m long along %c, less than one cell of %g m: use smaller cells", extent, "xy"[a],
                  cell);
    }
    MOR_CHECK(context, n[0] * n[1] <= MOR_TERRAIN_NODES_MAX, MOR_ERROR_ARGUMENT,
              "cells of %g m give %g x %g nodes; allowed are %g in all: use larger cells or crop the raster", cell,
              n[0], n[1], MOR_TERRAIN_NODES_MAX);
    double *heights = NULL;
    MOR_TRY(context, MOR_NEW(context, &heights, (int64_t)n[0] * (int64_t)n[1], "terrain heights"));
    const double ratio[2] = {cell / terrain->cell[0], cell / terrain->cell[1]};
    for (int row = 0; row < (int)n[1]; ++row) {
        for (int column = 0; column < (int)n[0]; ++column) {
            heights[(int64_t)row * (int)n[0] + column] = interpolate(terrain, column * ratio[0], row * ratio[1]);
        }
    }
    MOR_FREE(context, &terrain->heights);
    terrain->heights = heights;
    terrain->n_x = (int)n[0];
    terrain->n_y = (int)n[1];
    terrain->cell[0] = cell;
    terrain->cell[1] = cell;
    return MOR_OK;
}
