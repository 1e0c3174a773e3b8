/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_H
#define MOR_CASES_DRIVER_PROBE_H

#include "cases/driver/simulation.h"

/** @file
 *  Named results: what the probes of a case read off a simulation. The measurements themselves are in
 *  core/sph/measure.h; here they get their names, frames and units. */

/** Evaluates one probe of the case.
 *  @param context    [in,out]  one object
 *  @param simulation [in]      one object
 *  @param probe      [in]      index of the probe in the case
 *  @param value      [out]     one number, in the unit of mor_probe_unit; NaN where there is nothing to measure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a wall that does not exist; what the measurement returns. */
mor_status mor_probe_evaluate(mor_context *context, const mor_simulation *simulation, int probe, double *value);

/** Keeps track of probes that are the largest value so far. To be called after each step.
 *  @param context    [in,out]  one object
 *  @param simulation [in,out]  one object
 *  Returns: MOR_OK; what a measurement returns. */
mor_status mor_probe_follow(mor_context *context, mor_simulation *simulation);

/** Returns the SI unit of a probe of the case, a static string.
 *  @param the_case [in]  one object
 *  @param probe    [in]  index of the probe */
const char *mor_probe_unit(const mor_case *the_case, int probe);

#endif
