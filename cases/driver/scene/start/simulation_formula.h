/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_START_SIMULATION_FORMULA_H
#define MOR_CASES_DRIVER_SCENE_START_SIMULATION_FORMULA_H

#include "cases/driver/scene/simulation.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  Initial velocity and stress of soil by formulas of the place. */

/** Sets the initial velocity and stress of regions that have formulas for them.
 *  @param simulation [in,out]  particles in the order of the regions
 *  @param regions    [in]      shape [regions of the case]; their points
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a value that is not finite or beyond the speed of sound; MOR_ERROR_MEMORY. */
mor_status mor_simulation_set_by_formulas(mor_context *context, mor_simulation *simulation,
                                          const mor_lattice_points *regions);

#endif
