/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_NARROW_GAPS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_NARROW_GAPS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Gaps between walls and prescribed bodies that are too narrow for the particles of soil, and walls too thin to keep
 *  the soil on their two sides apart. Theory: docs/theory/walls.md, Narrow gaps. */

/** Finds narrow gaps and thin walls at the start; terrain is compared with what stands on it, not with itself.
 *  @param context    [in,out]  gaps below four spacings and walls below three are logged as warnings
 *  @param simulation [in,out]  built; receives the narrowest gap; without soil nothing is checked
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for a gap below two spacings, unless the case allows it, and
 *  for a wall below one; MOR_ERROR_MEMORY. Threads: parallel inside. */
mor_status mor_narrow_gaps_check(mor_context *context, mor_simulation *simulation);

#endif
