/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_WALL_SEAMS_H
#define MOR_CASES_DRIVER_SCENE_WALL_SEAMS_H

#include "bodies/contact/contact.h"
#include "cases/driver/case/case.h"
#include "core/base/context.h"

/** @file
 *  Walls that meet flush. A rock on the seam would touch each as if the other were absent, with errors of the forces up
 *  to a third; so bodies touch the union of both, if the walls are alike. */

/** Joins walls that make up one face together, form no inner corner, move alike, yield alike and have no contact law of
 *  their own.
 *  @param walls    [in,out]  shape [n_walls] as of the case: joined_to and whole are set
 *  @param wholes   [out]     shape [n_walls]; unions, the caller's to free; NULL where a wall is joined to no other
 *  Returns: MOR_OK; MOR_ERROR_MEMORY.  Cost: some hundred thousand distances per pair of walls that come near. */
mor_status mor_wall_seams_join(mor_context *context, const mor_case *the_case, mor_contact_wall *walls,
                               mor_shape **wholes);

/** Warns of each pair of walls that make up one face together but are not joined, where there are bodies to touch it.
 *  Cost: some hundred thousand distances per pair of walls that come near. */
void mor_wall_seams_warn(mor_context *context, const mor_case *the_case);

#endif
