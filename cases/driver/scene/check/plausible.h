/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_PLAUSIBLE_H
#define MOR_CASES_DRIVER_SCENE_CHECK_PLAUSIBLE_H

#include "cases/driver/case/case.h"

/** @file
 *  Values that no soil, rock or wall has, because a unit was forgotten. */

/** Logs a warning for each implausible density, contact modulus, friction coefficient and cohesion of a case.
 *  @param the_case [in]      as it was read */
void mor_plausible_warn(mor_context *context, const mor_case *the_case);

/** Logs a warning where the density of a soil is that of none.
 *  @param name    [in]      zero-terminated; of the soil
 *  @param density [in]      unit kg/m3 */
void mor_plausible_warn_of_soil_density(mor_context *context, const char *name, double density);

#endif
