/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_PICTURE_SOILS_H
#define MOR_CASES_DRIVER_PICTURE_PICTURE_SOILS_H

#include "cases/driver/case/case.h"
#include "cases/driver/picture/view/picture.h"
#include "core/base/context.h"

/** @file
 *  Pictures of which soil is where: a color and a name for each instead of a color bar. */

/** Particles of one set by soil. */
typedef struct mor_picture_soils {
    int64_t first[MOR_CASE_SOILS_MAX + 1]; /* shape [n_soils + 1]; where each soil begins, and the end */
    int n_soils;
} mor_picture_soils;

/** Sorts particles by soil; those of one soil keep their order.
 *  @param region   [in]      shape [n]; number of the soil of each, >= 0, 1
 *  @param n        [in]      number of particles
 *  @param position [in,out]  shape [n, 3]; any unit
 *  @param soils    [in,out]  n_soils is read
 *  Returns: MOR_OK; MOR_ERROR_IO for a number that is no soil's; MOR_ERROR_MEMORY. */
mor_status mor_picture_soils_sort(mor_context *context, const double *region, int64_t n, double *position,
                                  mor_picture_soils *soils);

/** Lists one group for each soil that has particles.
 *  @param all    [in]   the group of all soils, in their order
 *  @param groups [out]  shape [n_soils]
 *  Returns: the number of groups. */
int mor_picture_soils_list(const mor_picture_soils *soils, const mor_case *the_case, const mor_picture_group *all,
                           mor_picture_group *groups);

#endif
