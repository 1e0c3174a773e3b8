/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SIMULATION_MOTION_H
#define MOR_CASES_DRIVER_SCENE_SIMULATION_MOTION_H

#include "cases/driver/case/case.h"
#include "core/geometry/motion.h"

#include <stdint.h>

/** @file
 *  Prescribed motions of a case in the frame of the run, and which of its walls are there at a time. */

struct mor_simulation; /* cases/driver/scene/simulation.h */

/** Makes the motion of a path in the frame of the run.
 *  @param path   [in]   of the case
 *  @param center [in]   shape [3]; in the frame of the run: where its axis passes when the path gives no point; NULL:
 *                       the origin of the case, unit m
 *  @param motion [out]  owned by the caller; zeroed without rows
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_simulation_make_motion(mor_context *context, const mor_case *the_case, const mor_case_path *path,
                                      const double *center, mor_motion *motion);

/** Makes the motions of all walls.
 *  @param motions [out]  shape [MOR_CASE_WALLS_MAX], zeroed before; owned by the caller, also after a failure
 *  Returns: as mor_simulation_make_motion. */
mor_status mor_simulation_make_wall_motions(mor_context *context, const mor_case *the_case, mor_motion *motions);

/** Frees the motions of all walls; accepts zeroed ones.
 *  @param motions [in,out]  shape [MOR_CASE_WALLS_MAX] */
void mor_simulation_clear_wall_motions(mor_context *context, mor_motion *motions);

/** Where a wall is at a time.
 *  @param motion [in]   of the wall; without rows: it has its velocity at all times
 *  @param time   [in]   unit s
 *  @param pose   [out]  one pose */
void mor_simulation_pose_wall(const mor_case *the_case, int wall, const mor_motion *motion, double time,
                              mor_pose *pose);

/** Least distance of points from a wall where it is at a time, unit m; infinite without points.
 *  @param positions [in]  shape [n, 3], unit m
 *  @param n         [in]  number of points
 *  Threads: safe to call concurrently. */
double mor_simulation_wall_gap(const struct mor_simulation *simulation, int wall, double time, const double *positions,
                               int64_t n);

/** Bound of the speed that a wall has within the domain, unit m/s.
 *  @param motion [in]  of the wall */
double mor_simulation_wall_speed(const mor_case *the_case, int wall, const mor_motion *motion);

/** Whether a time of removal, unit s, has come; a time that is not a number never does. */
bool mor_simulation_is_removed(double removed_at, double time);

/** Whether a wall moves at any time. */
bool mor_simulation_wall_moves(const mor_case_wall *wall);

#endif
