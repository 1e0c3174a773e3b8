/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_PICTURE_WALL_H
#define MOR_CASES_DRIVER_PICTURE_PICTURE_WALL_H

#include "cases/driver/case/case.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  How a wall is shown in a picture: a structure, such as a house, a dam or a row of posts, is shown whole; of ground
 *  and containers only what lies around the particles. It does not draw. */

/** Widens a box until it holds particles.
 *  @param bounds   [in,out]  m
 *  @param position [in]      shape [n,3], m
 *  @param n        [in]      number of particles, >= 0
 *  @param half     [in]      half the particle spacing, m */
void mor_picture_wall_widen(mor_bounds *bounds, const double *position, int64_t n, double half);

/** Moves the particles of a wall from where they are at one time to where they are at another.
 *  @param wall      [in]      index of the wall
 *  @param motion    [in]      its motion; without rows: it has its velocity at all times
 *  @param times     [in]      shape [2]; from and to, unit s
 *  @param points    [in,out]  the wall's particles, in the placed frame */
void mor_picture_wall_move(const mor_case *the_case, int wall, const mor_motion *motion, const double *times,
                           mor_lattice_points *points);

/** Leaves out the particles of bodies that are not there any more.
 *  @param removed  [in]      shape [n], 1; above 0 for these particles
 *  @param n        [in]      number of particles
 *  @param part     [in,out]  shape [n]; number of the body of each in the set
 *  @param position [in,out]  shape [n,3], m
 *  @param value    [in,out]  shape [n]; colors; NULL: none
 *  Returns: number of particles that are left, which come first. */
int64_t mor_picture_leave_out_removed(const double *removed, int64_t n, double *part, double *position, double *value);

/** Returns whether a wall is a structure: it is fixed, bounded in all directions, does not reach beyond the moving
 *  particles on all sides as seen from above, and leaves them at least a quarter of the picture.
 *  @param wall     [in]  index of the wall
 *  @param points   [in]  the wall's particles, in the placed frame
 *  @param moving   [in]  m; box around all that moves, in the placed frame
 *  @param up       [in]  shape [3], 1, unit vector against gravity */
bool mor_picture_wall_is_structure(const mor_case *the_case, int wall, const mor_lattice_points *points,
                                   const mor_bounds *moving, const double *up);

/** Returns whether a wall hides more than a quarter of the points in a box from a distant viewer.
 *  @param wall     [in]  index of a wall bounded in all directions
 *  @param moving   [in]  m; the box, in the placed frame
 *  @param toward   [in]  shape [3], 1, unit vector from the scene to the viewer
 *  Cost: some thousand distances from the shape. */
bool mor_picture_wall_hides(const mor_case *the_case, int wall, const mor_bounds *moving, const double *toward);

#endif
