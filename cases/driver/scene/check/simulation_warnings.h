/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_WARNINGS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_WARNINGS_H

#include "cases/driver/scene/simulation.h"

#include <stdio.h>

/** @file
 *  Warnings about scenes that can be computed but may not be intended. `check`, `explain` and `run` print the same. */

/** Logs each warning about a scene with MOR_LOG_WARNING.
 *  @param simulation [in]      as it begins
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: some distances per particle of soil. */
mor_status mor_simulation_warn(mor_context *context, const mor_simulation *simulation);

/** Logs a warning where waves in the soil as it is are faster than the time step assumes, and another where they are so
 *  much faster than those without stress that the stress diffusion is too weak for a fitted gradient.
 *  @param simulation [in]      with its present stress; nothing of it changes
 *  @param when       [in]      zero-terminated; what the warning begins with
 *  Cost: that of mor_soil_stiffness_find. */
void mor_simulation_warn_of_stiffening(mor_context *context, const mor_simulation *simulation, const char *when);

/** Prints each warning about a scene as a line "warning: ..." instead.
 *  @param context    [in,out]  its sink is restored
 *  @param simulation [in]      as it begins
 *  @param stream     [in,out]  one open stream
 *  Returns: as mor_simulation_warn. */
mor_status mor_simulation_print_warnings(mor_context *context, const mor_simulation *simulation, FILE *stream);

#endif
