/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_grid.h"

#include <math.h>
#include <string.h>

/* So that states and checkpoints stay small beside those of the particles. */
#define CELLS_MAX 4194304.0

/* A share of a cell by which a domain may pass a line of the grid and still end on it, and by which a given size may be
 * off a whole multiple or fraction. */
#define ON_LINE 1e-9

/* Cells of the raster as they are, joined or divided. */
static mor_status find_cell(mor_context *context, const mor_case_maps *maps, double raster, double *cell)
{
    const double larger = maps->cell / raster;
    const double smaller = raster / maps->cell;
    *cell = raster;
    if (isnan(maps->cell)) {
        return MOR_OK;
    }
    if (larger >= 1.0 && fabs(larger - round(larger)) <= ON_LINE * larger) {
        *cell = raster * round(larger);
        return MOR_OK;
    }
    if (smaller >= 1.0 && fabs(smaller - round(smaller)) <= ON_LINE * smaller) {
        *cell = raster / round(smaller);
        return MOR_OK;
    }
    const double near = larger >= 1.0 ? raster * round(larger) : raster / round(smaller);
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: found maps.cell = %.9g m on a raster with cells of %.9g m; allowed: a whole multiple or a "
                    "whole fraction of them, so that the maps lie on the raster; give %.9g m, or leave it out",
                    maps->place.file, maps->place.line, maps->cell, raster, near);
}

/* Cells between two coordinates that cover an interval, counted from the corner in the direction of sign. */
static double cover(double from, double to, double corner, double cell, double sign, double *first)
{
    const double low = sign > 0.0 ? from : to;
    const double high = sign > 0.0 ? to : from;
    *first = floor(sign * (low - corner) / cell + ON_LINE);
    return ceil(sign * (high - corner) / cell - ON_LINE) - *first;
}

mor_status mor_map_grid_init(mor_context *context, const mor_case *the_case, mor_map_grid *grid)
{
    const mor_case_maps *maps = &the_case->maps;
    const double scale = the_case->scale_length;
    double n[2];
    *grid = (mor_map_grid){.terrain = NULL};
    for (int w = 0; w < the_case->n_walls; ++w) {
        if (maps->ground[0] != '\0' && strcmp(the_case->walls[w].name, maps->ground) == 0) {
            grid->terrain = mor_terrain_view(the_case->walls[w].shape);
        }
    }
    const mor_terrain *terrain = grid->terrain;
    for (int a = 0; a < 2; ++a) {
        const double sign = a == 0 || terrain == NULL ? 1.0 : -1.0; /* rasters are counted from their upper edge */
        const double shift = terrain != NULL ? terrain->offset[a] : 0.0;
        const double from = the_case->domain_minimum[a] / scale + shift;
        const double to = the_case->domain_maximum[a] / scale + shift;
        const double corner = terrain != NULL ? terrain->raster_corner[a] : from;
        double first = 0.0;
        grid->file_cell[a] = isnan(maps->cell) ? the_case->spacing / scale : maps->cell;
        if (terrain != NULL) {
            MOR_TRY(context, find_cell(context, maps, terrain->raster_cell[a], &grid->file_cell[a]));
        }
        n[a] = cover(from, to, corner, grid->file_cell[a], sign, &first);
        const double edge = corner + sign * first * grid->file_cell[a]; /* the one counting begins at */
        const double other = corner + sign * (first + n[a]) * grid->file_cell[a];
        grid->file_corner[a] = a == 0 || sign < 0.0 ? edge : other;
        grid->origin[a] = ((sign > 0.0 ? edge : other) - shift) * scale;
        grid->cell[a] = grid->file_cell[a] * scale;
    }
    MOR_CHECK(context, n[0] * n[1] <= CELLS_MAX, MOR_ERROR_CONFIG,
              "%s:%d: found maps of %g x %g cells; allowed: %g in all; give a larger maps.cell, or a smaller domain",
              maps->place.file, maps->place.line, n[0], n[1], CELLS_MAX);
    grid->n[0] = (int)n[0];
    grid->n[1] = (int)n[1];
    return MOR_OK;
}

int mor_map_grid_find(const mor_map_grid *grid, int axis, double coordinate)
{
    const double place = floor((coordinate - grid->origin[axis]) / grid->cell[axis]);
    return (int)fmin(fmax(place, 0.0), grid->n[axis] - 1.0);
}
