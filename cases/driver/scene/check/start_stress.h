/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_START_STRESS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_START_STRESS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Whether each soil can bear the weight that it starts under: stiff enough, and with a lateral stress that its law
 *  admits. The laws themselves are asked, so that it holds for those of others as well. */

/** Logs a warning for each soil that its own weight compresses by more than 2 % (10 % where its
 *  stiffness grows with the pressure and its law has no modulus), and for each whose lateral stress lies
 *  well outside of its strength.
 *  @param simulation [in]      as it begins
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_start_stress_warn(mor_context *context, const mor_simulation *simulation);

#endif
