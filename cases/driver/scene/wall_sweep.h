/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_WALL_SWEEP_H
#define MOR_CASES_DRIVER_SCENE_WALL_SWEEP_H

#include "cases/driver/case/case.h"
#include "core/geometry/motion.h"
#include "core/geometry/shape.h"

#include <stdint.h>

/** @file
 *  Which parts of a wall come into the domain, and out of other walls, in the course of its motion: it needs points
 *  there from the start. */

/** A wall in motion relative to the domain and to earlier walls. Owner: whoever fills the wall, who ends it with
 *  mor_wall_sweep_clear. */
typedef struct mor_wall_sweep {
    const mor_case *the_case; /* borrowed */
    int wall;
    mor_motion motions[MOR_CASE_WALLS_MAX]; /* shape [wall + 1]; of the wall and of earlier ones */
    double *times;                          /* shape [n_times]; at which places are looked at, s */
    int64_t n_times, room;
} mor_wall_sweep;

/** Finds the motions, and the times at which places are looked at: so many that nothing moves by more than a part of
 *  the domain in between. A path counts as a whole, a velocity until `end`, either until the wall is removed.
 *  @param sweep [out]  to be cleared by the caller also after a failure
 *  @param wall  [in]   index in the case
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. Cost: O(times), allocates them. */
mor_status mor_wall_sweep_init(mor_context *context, mor_wall_sweep *sweep, const mor_case *the_case, int wall);

/** Frees what it owns; accepts a zeroed one. */
void mor_wall_sweep_clear(mor_context *context, mor_wall_sweep *sweep);

/** Widens a box by what the wall brings into the domain: by the domain as the wall, at its start, sees it at each time.
 *  @param box [in,out]  in the frame of the case; left alone for a wall that does not move, unit m */
void mor_wall_sweep_widen(const mor_wall_sweep *sweep, mor_bounds *box);

/** Whether an earlier wall may uncover parts of the wall: it moves otherwise, or is removed before.
 *  @param earlier [in]  index in the case */
bool mor_wall_sweep_parts(const mor_wall_sweep *sweep, int earlier);

/** Whether a point of the wall lies in an earlier wall at the start.
 *  @param earlier [in]  index in the case
 *  @param point   [in]  shape [3], at the start, in the frame of the run, unit m */
bool mor_wall_sweep_is_covered(const mor_wall_sweep *sweep, int earlier, const double *point);

/** Whether a point of the wall is at any time within the domain and not in an earlier wall.
 *  @param earlier [in]  index in the case
 *  @param point   [in]  shape [3], at the start, in the frame of the run, unit m
 *  Cost: O(times) distances. */
bool mor_wall_sweep_uncovers(const mor_wall_sweep *sweep, int earlier, const double *point);

/** Finds the earlier walls out of which points come in the course of the motion, and says whether there are any.
 *  @param points [in]      shape [n, 3]; of the wall, those in the walls shown among them, unit m
 *  @param n      [in]      number of points
 *  @param shown  [in,out]  shape [wall]; earlier walls that may uncover points; at the end those that do */
bool mor_wall_sweep_find_shown(const mor_wall_sweep *sweep, const double *points, int64_t n, bool *shown);

#endif
