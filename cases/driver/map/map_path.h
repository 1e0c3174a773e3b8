/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_PATH_H
#define MOR_CASES_DRIVER_MAP_MAP_PATH_H

#include "cases/driver/map/map_grid.h"

/** @file
 *  The cells of a grid on a straight path, so that what moves fast enters each cell on its way. */

/** Is told each cell in turn.
 *  @param cell       [in]  row times columns plus column
 *  @param is_entered [in]  false: the cell that the path begins in */
typedef void (*mor_map_path_visit)(void *job, int64_t cell, bool is_entered);

/** Walks from cell to neighboring cell along a path; beyond the grid along its edge.
 *  @param from  [in]      shape [2], m
 *  @param to    [in]      shape [2], m
 *  @param visit [in]      called for each cell
 *  @param job   [in,out]  handed to visit
 *  Theory: traversal of a grid, Amanatides and Woo (1987). */
void mor_map_path_walk(const mor_map_grid *grid, const double *from, const double *to, mor_map_path_visit visit,
                       void *job);

#endif
