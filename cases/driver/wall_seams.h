/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_WALL_SEAMS_H
#define MOR_CASES_DRIVER_WALL_SEAMS_H

#include "cases/driver/case.h"
#include "core/base/context.h"

/** @file
 *  Walls that meet flush: a rock on the seam touches both, each as if the other were not there. */

/** Warns of each pair of walls that make up one face together, where there are bodies to touch it. Parts of one wall (a
 *  union) are seen as one body and need no warning.
 *  @param context  [in,out]  one object
 *  @param the_case [in]      one object
 *  Cost: some thousand distances per pair of walls. */
void mor_wall_seams_warn(mor_context *context, const mor_case *the_case);

#endif
