/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_WALL_PERIOD_H
#define MOR_CASES_DRIVER_SCENE_WALL_PERIOD_H

#include "cases/driver/case/case.h"

/** @file
 *  Walls of a domain that repeats itself. */

/** Leaves of a wall what lies between the faces of such a domain, and checks that it goes on beyond them; nothing for
 *  another domain.
 *  @param wall     [in]      index of the wall
 *  @param n_points [in,out]  one number; of its points
 *  @param points   [in,out]  shape [n_points, 3], unit m; in the frame of the case
 *  @param shares   [in,out]  shape [n_points], unit 1; thinned out with them; NULL: none
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a wall that ends at a face. */
mor_status mor_wall_period_keep(mor_context *context, const mor_case *the_case, int wall, int64_t *n_points,
                                double *points, double *shares);

#endif
