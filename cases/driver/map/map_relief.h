/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_RELIEF_H
#define MOR_CASES_DRIVER_MAP_MAP_RELIEF_H

#include "cases/driver/picture/draw/axes.h"
#include "relaxation/terrain/terrain_raster.h"

/** @file
 *  The ground under a map: its light under a sun in the north-west, 45 degrees high, and its contours with heights. */

/** Finds the light of each cell, by Lambert's law: 1 where the sun stands across the surface, 0 in its shadow.
 *  @param ground  [in]      heights in m
 *  @param light   [out]     the address of one array [n[1], n[0]], 1; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_map_relief_light(mor_context *context, const mor_terrain_raster *ground, double **light);

/** Light at a place between the centers of cells, interpolated; beyond them that of the nearest one.
 *  @param light  [in]  shape [n[1], n[0]], 1
 *  @param column [in]  place in cells from the left edge, 1
 *  @param row    [in]  place in cells from the upper edge, 1 */
double mor_map_relief_light_at(const mor_terrain_raster *ground, const double *light, double column, double row);

/** Draws contours at round heights, each with its height written once where there is room.
 *  @param ground  [in]      heights in m
 *  @param base    [in]      shape [2]; subtracted from the raster's coordinates, unit m
 *  @param axes    [in]      that the map is drawn in
 *  Returns: the interval of the heights, unit m; 0: the ground is level. */
double mor_map_relief_contours(mor_canvas *canvas, const mor_terrain_raster *ground, const double *base,
                               const mor_axes *axes);

#endif
