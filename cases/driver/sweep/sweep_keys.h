/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_KEYS_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_KEYS_H

#include "cases/driver/sweep/sweep.h"

/** @file
 *  Keys of the case that a sweep sets more than once: of two settings the later one counts, so that the other would be
 *  without effect, unseen. */

/** Refuses a key that two variables set, and one of a variable that is set for all members as well. A choice may set
 *  what the sweep file sets for all: its value for the other choices. What is given by hand may not be set by any.
 *  @param sweep [in]  whole, with overrides
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_sweep_keys_check(mor_context *context, const mor_sweep *sweep);

#endif
