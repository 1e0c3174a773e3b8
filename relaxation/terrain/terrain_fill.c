/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>

/* A point closer to an edge than this fraction of the spacing counts as lying on it, and one on an edge is outside. */
#define ON_EDGE 1e-9

/* LAYERS_MOST: layers that numbers of particles have room for. */
enum { COLUMNS_AT_ONCE = 64, LAYERS_MOST = 65536 };

/* The columns of particles of one fill. */
typedef struct columns {
    const mor_terrain *terrain;
    double spacing;
    double origin[2]; /* of the lattice, m */
    double first[2];  /* index of the first column */
    int64_t n[2];     /* columns along x and y */
    double depth;     /* of wall layers, m */
    int layers;
    const mor_shape *release; /* NULL: wall particles */
} columns;

static mor_status find_columns(mor_context *context, const double *origin, const double *minimum, const double *maximum,
                               columns *all)
{
    for (int a = 0; a < 2; ++a) {
        const double from = fmax(minimum[a], all->terrain->origin[a]);
        const double to = fmin(maximum[a], mor_terrain_end(all->terrain, a));
        all->origin[a] = origin[a];
        all->first[a] = floor((from - origin[a]) / all->spacing - 0.5 + ON_EDGE) + 1.0;
        const double last = ceil((to - origin[a]) / all->spacing - 0.5 - ON_EDGE) - 1.0;
        const double n = last - all->first[a] + 1.0;
        MOR_CHECK(context, isfinite(origin[a]) && !(n >= 1073741824.0), MOR_ERROR_ARGUMENT,
                  "%g columns of particles %g m apart along %c: use a larger spacing", n, all->spacing, "xy"[a]);
        all->n[a] = n > 0.0 ? (int64_t)n : 0;
    }
    MOR_CHECK(context, all->n[0] == 0 || all->n[1] <= INT32_MAX / all->n[0], MOR_ERROR_ARGUMENT,
              "%lld x %lld columns of particles: use a larger spacing", (long long)all->n[0], (long long)all->n[1]);
    return MOR_OK;
}

static void place_column(const columns *all, int64_t column, double *point)
{
    point[0] = all->origin[0] + (all->first[0] + (double)(column % all->n[0]) + 0.5) * all->spacing;
    point[1] = all->origin[1] + (all->first[1] + (double)(column / all->n[0]) + 0.5) * all->spacing;
    point[2] = mor_terrain_height(all->terrain, point[0], point[1]);
}

/* Layers of a column. The distance from the surface never decreases downwards, so the first layer that is too deep ends
 * it. */
static int32_t count_layers(const columns *all, int64_t column)
{
    double point[3];
    place_column(all, column, point);
    if (all->release != NULL) {
        const double thickness = mor_terrain_release_thickness(all->release, point[0], point[1]);
        return (int32_t)fmax(0.0, ceil(thickness / all->spacing - 0.5 - ON_EDGE));
    }
    const double surface = point[2];
    int32_t n_layers = all->layers; /* their distance is at most their vertical one */
    for (;;) {
        point[2] = surface - (n_layers + 0.5) * all->spacing;
        if (mor_terrain_distance(all->terrain, point, all->depth) > all->depth) {
            return n_layers;
        }
        ++n_layers;
    }
}

static mor_status fill(mor_context *context, const columns *all, double **points, int64_t *n_points)
{
    const int64_t n_columns = all->n[0] * all->n[1];
    const double step = all->release != NULL ? all->spacing : -all->spacing;
    int64_t *ends = NULL; /* shape [n_columns]; of the points of each column */
    MOR_TRY(context, MOR_NEW(context, &ends, n_columns, "columns of particles"));
    MOR_PARALLEL_FOR (context, column, n_columns, COLUMNS_AT_ONCE) {
        ends[column] = count_layers(all, column);
    }
    int64_t n = 0;
    for (int64_t column = 0; column < n_columns; ++column) {
        n += ends[column];
        ends[column] = n;
    }
    mor_status status =
        n <= INT32_MAX - 63
            ? MOR_NEW(context, points, 3 * n, "particles of a terrain")
            : MOR_FAIL(context, MOR_ERROR_ARGUMENT, "%lld particles of a terrain: use a larger spacing", (long long)n);
    if (status == MOR_OK) {
        MOR_PARALLEL_FOR (context, column, n_columns, COLUMNS_AT_ONCE) {
            double place[3];
            place_column(all, column, place);
            const int64_t start = column > 0 ? ends[column - 1] : 0;
            for (int64_t i = start; i < ends[column]; ++i) {
                (*points)[3 * i] = place[0];
                (*points)[3 * i + 1] = place[1];
                (*points)[3 * i + 2] = place[2] + ((double)(i - start) + 0.5) * step;
            }
        }
        *n_points = n;
    }
    MOR_FREE(context, &ends);
    return status;
}

static void place_layer(const columns *all, int64_t column, int64_t layer, double *point)
{
    const double step = all->release != NULL ? all->spacing : -all->spacing;
    place_column(all, column, point);
    point[2] += ((double)layer + 0.5) * step;
}

static mor_status check_spacing(mor_context *context, double spacing)
{
    MOR_CHECK(context, spacing > 0.0 && isfinite(spacing), MOR_ERROR_ARGUMENT,
              "the spacing is %g m: give a length above zero", spacing);
    return MOR_OK;
}

static mor_status find_ground(mor_context *context, const mor_terrain *terrain, const mor_terrain_columns *wanted,
                              columns *all)
{
    *all = (columns){.terrain = terrain,
                     .spacing = wanted->spacing,
                     .depth = wanted->layers * wanted->spacing * (1.0 + ON_EDGE),
                     .layers = wanted->layers};
    return find_columns(context, wanted->origin, wanted->bounds.minimum, wanted->bounds.maximum, all);
}

mor_status mor_terrain_fill(mor_context *context, const mor_terrain *terrain, double spacing, const double *origin,
                            int layers, const mor_bounds *bounds, double **points, int64_t *n_points)
{
    const mor_terrain_columns wanted = {spacing, {origin[0], origin[1]}, layers, *bounds};
    columns all;
    *points = NULL;
    *n_points = 0;
    MOR_TRY(context, check_spacing(context, spacing));
    MOR_TRY(context, mor_terrain_check(context, terrain));
    MOR_CHECK(context, layers >= 1, MOR_ERROR_ARGUMENT, "%d layers of particles: give at least 1", layers);
    MOR_TRY(context, find_ground(context, terrain, &wanted, &all));
    MOR_TRY(context, fill(context, &all, points, n_points));
    return MOR_OK;
}

mor_status mor_terrain_number(mor_context *context, const mor_terrain *terrain, const mor_terrain_columns *wanted,
                              const double *points, int64_t n_points, int64_t *numbers)
{
    columns all;
    MOR_TRY(context, find_ground(context, terrain, wanted, &all));
    for (int64_t i = 0; i < n_points; ++i) {
        const double *point = points + 3 * i;
        int64_t index[2];
        double top[3];
        for (int a = 0; a < 2; ++a) {
            index[a] = (int64_t)(floor((point[a] - all.origin[a]) / all.spacing) - all.first[a]);
        }
        const int64_t column = index[1] * all.n[0] + index[0];
        const bool is_among = index[0] >= 0 && index[0] < all.n[0] && index[1] >= 0 && index[1] < all.n[1];
        place_column(&all, is_among ? column : 0, top);
        const double layer = floor((top[2] - point[2]) / all.spacing);
        numbers[i] = is_among && layer >= 0.0 && layer < LAYERS_MOST ? column * LAYERS_MOST + (int64_t)layer : -1;
    }
    return MOR_OK;
}

mor_status mor_terrain_place(mor_context *context, const mor_terrain *terrain, const mor_terrain_columns *wanted,
                             const int64_t *numbers, int64_t n, double *points)
{
    columns all;
    MOR_TRY(context, find_ground(context, terrain, wanted, &all));
    for (int64_t i = 0; i < n; ++i) {
        place_layer(&all, numbers[i] / LAYERS_MOST, numbers[i] % LAYERS_MOST, points + 3 * i);
    }
    return MOR_OK;
}

mor_status mor_terrain_fill_release(mor_context *context, const mor_shape *release, double spacing,
                                    const double *origin, double **points, int64_t *n_points)
{
    *points = NULL;
    *n_points = 0;
    MOR_TRY(context, check_spacing(context, spacing));
    const mor_terrain_surface *surface = mor_terrain_release_surface(release);
    MOR_CHECK(context, surface != NULL, MOR_ERROR_ARGUMENT, "the shape is a %s: give a release",
              release->operations->kind);
    columns all = {.terrain = &surface->terrain, .spacing = spacing, .release = release};
    mor_bounds bounds;
    release->operations->bounds(release, &bounds);
    MOR_TRY(context, find_columns(context, origin, bounds.minimum, bounds.maximum, &all));
    MOR_TRY(context, fill(context, &all, points, n_points));
    return MOR_OK;
}
