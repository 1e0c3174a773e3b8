/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SOIL_NEIGHBORS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SOIL_NEIGHBORS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Soils that are meant to bear each other: whether they touch, and whether each of them starts with its stress. */

/** Logs a warning for each soil above another that does not touch it although its initial stress says that it rests
 *  there, or that is too near to be meant to fall; and for each soil without an initial stress that touches one with.
 *  @param simulation [in]      as it begins
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: some searches per particle at the gap; nothing where there is one soil. */
mor_status mor_soil_neighbors_warn(mor_context *context, const mor_simulation *simulation);

#endif
