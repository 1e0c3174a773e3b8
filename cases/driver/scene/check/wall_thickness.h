/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_WALL_THICKNESS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_WALL_THICKNESS_H

#include "cases/driver/case/case.h"
#include "core/base/context.h"

/** @file
 *  Walls too thin for bodies. A body touches a wall with nodes a spacing apart: posts, rails and ribs narrower than the
 *  diagonal between nodes may lie between them without contact. */

/** Warns of each wall that is found thinner than one and a half spacings in the domain, where there are bodies to touch
 *  it. Casts rays through the wall at random points of its faces, parts and cuts included; walls behind it count. A
 *  part that is small beside the whole wall may be missed.
 *  Cost: some hundred thousand distances per wall. */
void mor_wall_thickness_warn(mor_context *context, const mor_case *the_case);

#endif
