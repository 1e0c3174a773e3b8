/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_WALL_SIMULATION_TERRAIN_H
#define MOR_CASES_DRIVER_SCENE_WALL_SIMULATION_TERRAIN_H

#include "cases/driver/case/case.h"
#include "relaxation/relax/lattice.h"
#include "relaxation/terrain/terrain.h"

/** @file
 *  Particles that follow the ground: walls of terrain and soil of releases. Everything else is filled from the lattice
 *  (simulation_build.c). */

/** What a wall of ground is filled with.
 *  @param layers   [in]      layers of particles, >= 1
 *  @param columns  [out]     all of it */
void mor_simulation_find_columns(const mor_case *the_case, int layers, mor_terrain_columns *columns);

/** Fills a wall whose shape is a terrain, in the placed frame. Places inside earlier walls are left out.
 *  @param wall     [in]      index of the wall
 *  @param layers   [in]      layers of particles, >= 1
 *  @param points   [out]     owned by the caller; may come out empty
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_simulation_fill_terrain(mor_context *context, const mor_case *the_case, int wall, int layers,
                                       mor_lattice_points *points);

/** Fills a soil region whose shape is a release, in the placed frame, with the jitter of the case.
 *  @param soil     [in]      index of the region
 *  @param points   [out]     owned by the caller; may come out empty
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_simulation_fill_release(mor_context *context, const mor_case *the_case, int soil,
                                       mor_lattice_points *points);

/** Light of wall particles of a terrain: that of the surface at their place under a sun in the north-west, dimmed along
 *  contour lines, 1 for a level place between them.
 *  @param wall     [in]      index of a wall whose shape is a terrain
 *  @param points   [in]      in the placed frame
 *  @param light    [out]     the address of one array [n_points], 1; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_simulation_light_terrain(mor_context *context, const mor_case *the_case, int wall,
                                        const mor_lattice_points *points, double **light);

#endif
