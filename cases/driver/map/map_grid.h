/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_GRID_H
#define MOR_CASES_DRIVER_MAP_MAP_GRID_H

#include "cases/driver/case/case.h"
#include "relaxation/terrain/terrain.h"

/** @file
 *  The grid of the maps, in the frame of the case before its placement, seen along z. On terrain its lines are those of
 *  the cells of the raster, or every m-th of them, or m times as many; without terrain it begins at the lower left
 *  corner of the domain. It covers the domain. */

/** The grid. Plain data; row 0 has the least y. */
typedef struct mor_map_grid {
    double origin[2]; /* lower left corner, m, in the frame of the case */
    double cell[2];   /* size of the cells along x and y, m */
    int n[2];         /* columns and rows, >= 1 */
    /* For files, without the scale of the case: */
    double file_corner[2];      /* x of the left and y of the upper edge, in coordinates of the raster, m */
    double file_cell[2];        /* m */
    const mor_terrain *terrain; /* borrowed from the case; NULL: there is none */
} mor_map_grid;

/** Makes the grid of a case.
 *  @param the_case [in]      maps are wanted
 *  @param grid     [out]     borrows from the case
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for cells that do not fit the raster, or too many. */
mor_status mor_map_grid_init(mor_context *context, const mor_case *the_case, mor_map_grid *grid);

/** Number of cells, 1. */
static inline int64_t mor_map_grid_cells(const mor_map_grid *grid)
{
    return (int64_t)grid->n[0] * grid->n[1];
}

/** Column or row of a coordinate; beyond the edge the nearest one.
 *  @param axis       [in]  0: a column; 1: a row
 *  @param coordinate [in]  unit m, in the frame of the case */
int mor_map_grid_find(const mor_map_grid *grid, int axis, double coordinate);

#endif
