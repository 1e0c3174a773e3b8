/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_WALL_WALL_SOURCE_H
#define MOR_CASES_DRIVER_SCENE_WALL_WALL_SOURCE_H

#include "cases/driver/scene/simulation.h"
#include "core/sph/boundary/soil_contact.h"
#include "relaxation/relax/lattice.h"
#include "relaxation/terrain/terrain.h"

/** @file
 *  Where the particles of a wall come from: what finds each again by its number, so that a wall need hold those alone
 *  that soil is near. */

/** How a wall was filled. */
typedef struct mor_wall_filling {
    const mor_case *the_case; /* borrowed */
    int wall;
    mor_lattice_request request; /* of walls with a shape; excludes the shapes below */
    const mor_shape *excluded[MOR_CASE_WALLS_MAX];
    mor_terrain_columns columns; /* of ground */
} mor_wall_filling;

/** Finds the normals of the faces of a wall, seen from its particles, and how deep these lie.
 *  @param wall      [in]   index of the wall
 *  @param n         [in]   number of particles
 *  @param positions [in]   shape [n, 3]; in the placed frame before any motion, unit m
 *  @param normals   [out]  shape [n, 3], unit 1
 *  @param depths    [out]  shape [n], unit m */
void mor_wall_source_find_normals(mor_context *context, const mor_case *the_case, int wall, int64_t n,
                                  const double *positions, double *normals, double *depths);

/** Makes a source of the particles of a wall and numbers them, where that is of use: for a wall that is large enough,
 *  finds all its particles again to the last bit, and does not rotate beside soil that may sleep.
 *  @param filling [in]   outlives the source
 *  @param rotates [in]   whether the wall rotates
 *  @param points  [in]   its particles in the placed frame
 *  @param shares  [in]   shape [points->n_points], 1; NULL: all whole
 *  @param source  [out]  one source
 *  @param numbers [out]  the address of one array [points->n_points]; owned by the caller; NULL: the wall is to be
 *                        filled at once
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_wall_source_make(mor_context *context, const mor_wall_filling *filling, bool rotates,
                                const mor_lattice_points *points, const double *shares, mor_wall_source *source,
                                int64_t **numbers);

#endif
