/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_KEYS_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_KEYS_H

#include "cases/driver/sweep/sweep.h"

/** @file
 *  Keys of the case that a sweep sets more than once: of two settings the later one counts, so that the other would be
 *  without effect, unseen. A key holds those below it and its entries: soil[0].material holds
 *  soil[0].material.density. */

/** Refuses a key that is, holds or is held by one that another variable sets, the same choice, or what is given by
 *  hand; two variables that choose the case; and two settings of all members likewise. What the sweep file sets for all
 *  may be varied in part, and a choice may set it anew: it is the value for the other choices.
 *  @param sweep [in]  whole, with overrides
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_sweep_keys_check(mor_context *context, const mor_sweep *sweep);

/** Finds the variable that makes a setting.
 *  @param setting [in]  begins with it, "key=value"; what follows is not looked at
 *  Returns: borrowed; NULL when no variable does, as of what is set for all members. */
const mor_sweep_variable *mor_sweep_keys_find(const mor_sweep *sweep, const char *setting);

#endif
