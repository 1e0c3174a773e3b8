/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Neighbor search: a grid of cells of half the radius, sorted by counting, and rows of neighbors in its order. */
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

/* Cells per radius, and those to look at on each side. */
enum { PER_RADIUS = 2, REACH = 2, CELLS_PER_PARTICLE = 16, CELLS_LEAST = 4096 };

mor_status mor_relax_neighbors_init(mor_context *context, int64_t n, int64_t n_rows, double radius,
                                    mor_relax_neighbors *neighbors)
{
    memset(neighbors, 0, sizeof *neighbors);
    neighbors->n = n;
    neighbors->n_rows = n_rows;
    neighbors->radius = radius;
    neighbors->n_cells_max = CELLS_PER_PARTICLE * n + CELLS_LEAST;
    MOR_TRY(context, MOR_NEW(context, &neighbors->firsts, neighbors->n_cells_max + 1, "cells of particles"));
    MOR_TRY(context, MOR_NEW(context, &neighbors->cell_of, n, "cells of particles"));
    MOR_TRY(context, MOR_NEW(context, &neighbors->sorted, n, "cells of particles"));
    MOR_TRY(context, MOR_NEW(context, &neighbors->places, 3 * n, "cells of particles"));
    MOR_TRY(context, MOR_NEW(context, &neighbors->counts, n_rows, "counts of neighbors"));
    neighbors->capacity = MOR_RELAX_LANES;
    MOR_TRY(context, MOR_NEW(context, &neighbors->rows, n_rows * neighbors->capacity, "rows of neighbors"));
    return MOR_OK;
}

void mor_relax_neighbors_clear(mor_context *context, mor_relax_neighbors *neighbors)
{
    MOR_FREE(context, &neighbors->firsts);
    MOR_FREE(context, &neighbors->cell_of);
    MOR_FREE(context, &neighbors->sorted);
    MOR_FREE(context, &neighbors->places);
    MOR_FREE(context, &neighbors->counts);
    MOR_FREE(context, &neighbors->rows);
    memset(neighbors, 0, sizeof *neighbors);
}

/* Cells of half the radius, or larger ones when the particles are so scattered that there would be too many. */
static void size_grid(mor_relax_neighbors *neighbors, const double *x)
{
    const int64_t n = neighbors->n;
    double extent[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < 3; ++a) {
        double low = x[a * n];
        double high = x[a * n];
        for (int64_t i = 1; i < n; ++i) {
            low = fmin(low, x[a * n + i]);
            high = fmax(high, x[a * n + i]);
        }
        neighbors->low[a] = low;
        extent[a] = high - low;
    }
    for (neighbors->cell = neighbors->radius / PER_RADIUS;; neighbors->cell *= 2.0) {
        double total = 1.0;
        for (int a = 0; a < 3; ++a) {
            const double count = floor(extent[a] / neighbors->cell) + 1.0;
            total *= count;
            neighbors->n_cells[a] = count < 1e9 ? (int64_t)count : 1000000000;
        }
        if (total <= (double)neighbors->n_cells_max) {
            return;
        }
    }
}

static void sort_particles(mor_relax_neighbors *neighbors, const double *x)
{
    const int64_t n = neighbors->n;
    const int64_t n_cells = neighbors->n_cells[0] * neighbors->n_cells[1] * neighbors->n_cells[2];
    memset(neighbors->firsts, 0, (size_t)(n_cells + 1) * sizeof *neighbors->firsts);
    for (int64_t i = 0; i < n; ++i) {
        int64_t cell = 0;
        for (int a = 2; a >= 0; --a) {
            const int64_t index = (int64_t)((x[a * n + i] - neighbors->low[a]) / neighbors->cell);
            cell = cell * neighbors->n_cells[a] + index;
        }
        neighbors->cell_of[i] = cell;
        neighbors->firsts[cell + 1] += 1;
    }
    for (int64_t cell = 0; cell < n_cells; ++cell) {
        neighbors->firsts[cell + 1] += neighbors->firsts[cell];
    }
    /* From the end, so that each cell's first becomes right again. */
    for (int64_t i = n - 1; i >= 0; --i) {
        neighbors->sorted[--neighbors->firsts[neighbors->cell_of[i] + 1]] = (int32_t)i;
    }
    memmove(neighbors->firsts, neighbors->firsts + 1, (size_t)n_cells * sizeof *neighbors->firsts);
    neighbors->firsts[n_cells] = (int32_t)n;
    for (int64_t s = 0; s < n; ++s) {
        for (int a = 0; a < 3; ++a) {
            neighbors->places[3 * s + a] = x[a * n + neighbors->sorted[s]];
        }
    }
}

/* Visits the particles near i; writes those within the radius as far as there is room. Returns how many there are. */
static int32_t walk_near(const mor_relax_neighbors *neighbors, const double *x, int64_t i, int32_t *row)
{
    const int64_t n = neighbors->n;
    const double radius2 = neighbors->radius * neighbors->radius;
    int64_t first[3];
    int64_t last[3];
    int32_t count = 0;
    int64_t cell = neighbors->cell_of[i];
    for (int a = 0; a < 3; ++a) {
        const int64_t index = cell % neighbors->n_cells[a];
        cell /= neighbors->n_cells[a];
        first[a] = index > REACH ? index - REACH : 0;
        last[a] = index + REACH < neighbors->n_cells[a] ? index + REACH : neighbors->n_cells[a] - 1;
    }
    for (int64_t c = first[2]; c <= last[2]; ++c) {
        for (int64_t b = first[1]; b <= last[1]; ++b) {
            const int64_t line = neighbors->n_cells[0] * (b + neighbors->n_cells[1] * c);
            for (int32_t s = neighbors->firsts[line + first[0]]; s < neighbors->firsts[line + last[0] + 1]; ++s) {
                const int32_t j = neighbors->sorted[s];
                const double *other = neighbors->places + 3 * (int64_t)s;
                const double way[3] = {x[i] - other[0], x[n + i] - other[1], x[2 * n + i] - other[2]};
                /* Written in any case and counted if near: which it is, nobody can predict. */
                if (count < neighbors->capacity) {
                    row[count] = j;
                }
                count += (mor_vector_dot(way, way) < radius2) & (j != i);
            }
        }
    }
    return count;
}

/* Fills all rows as far as there is room; returns how many entries the longest one needs. */
static int32_t fill_rows(mor_context *context, mor_relax_neighbors *neighbors, const double *x)
{
    int32_t most = 0;
    MOR_PARALLEL_FOR (context, i, neighbors->n_rows, 128) {
        int32_t *row = neighbors->rows + i * neighbors->capacity;
        neighbors->counts[i] = walk_near(neighbors, x, i, row);
        for (int64_t k = neighbors->counts[i]; k < neighbors->capacity; ++k) {
            row[k] = (int32_t)i;
        }
    }
    for (int64_t i = 0; i < neighbors->n_rows; ++i) {
        most = neighbors->counts[i] > most ? neighbors->counts[i] : most;
    }
    return most;
}

mor_status mor_relax_neighbors_find(mor_context *context, mor_relax_neighbors *neighbors, const double *x)
{
    if (neighbors->n == 0) {
        return MOR_OK;
    }
    size_grid(neighbors, x);
    sort_particles(neighbors, x);
    for (;;) {
        const int64_t most = fill_rows(context, neighbors, x);
        if (most <= neighbors->capacity) {
            return MOR_OK;
        }
        /* They may become more before long. */
        neighbors->capacity = (most + most / 8 + MOR_RELAX_LANES) / MOR_RELAX_LANES * MOR_RELAX_LANES;
        MOR_FREE(context, &neighbors->rows);
        MOR_TRY(context,
                MOR_NEW(context, &neighbors->rows, neighbors->n_rows * neighbors->capacity, "rows of neighbors"));
    }
}
