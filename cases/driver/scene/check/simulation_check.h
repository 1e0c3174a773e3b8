/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_CHECK_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_CHECK_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Whether a scene that could be built can be computed: what depends on the particles, the speed of sound and the first
 *  time step. */

/** Refuses a scene whose settings make it meaningless or endless: damping under which nothing moves, more steps than
 *  can be taken, speeds beyond that of sound, walls outside the domain.
 *  @param context    [in,out]  warns of runs that take days
 *  @param simulation [in,out]  built; first_step is set
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; what a stepper returns. */
mor_status mor_simulation_check(mor_context *context, mor_simulation *simulation);

/** Prints a duration in the unit that suits it.
 *  @param seconds [in]   unit s
 *  @param text    [out]  shape [n_bytes]; zero-terminated
 *  @param n_bytes [in]   room
 *  Returns: text. */
const char *mor_simulation_duration(double seconds, char *text, size_t n_bytes);

#endif
