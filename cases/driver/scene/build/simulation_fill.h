/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_FILL_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_FILL_H

#include "cases/driver/case/case.h"
#include "cases/driver/scene/build/point_cache.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  The particles of a body: a lattice or relaxed ones, found in the frame of its shape and then placed. */

/** Returns whether a body's particles are relaxed: as the case says, else when a part of its shape is a mesh, an
 *  outline or a procedural rock. */
bool mor_simulation_fill_is_relaxed(const mor_case_body *body);

/** Finds the particles of a body.
 *  @param body     [in]      of the case
 *  @param points   [out]     in the frame of the run; owned by the caller; empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for a body without end, too thin, or without particles;
 *  MOR_ERROR_MEMORY. */
mor_status mor_simulation_fill_body(mor_context *context, const mor_case *the_case, const mor_case_body *body,
                                    mor_point_cache *cache, mor_lattice_points *points);

#endif
