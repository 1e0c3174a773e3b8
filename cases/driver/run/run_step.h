/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_STEP_H
#define MOR_CASES_DRIVER_RUN_RUN_STEP_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  One step of a run without its files, so that the library takes the same steps as a run. */

/** Returns the tick of a snapshot; the end for those behind the last one.
 *  @param number [in]  of the snapshot; 0: at the start */
int64_t mor_run_snapshot_tick(const mor_simulation *simulation, int64_t number);

/** Returns the first snapshot that is still to come; the number of snapshots of the case behind the last one.
 *  @param number [in]  of a snapshot that is not behind it */
int64_t mor_run_find_snapshot(const mor_simulation *simulation, int64_t number);

/** Warns of soil that was too fast in the steps so far: the method takes it to be hardly compressible, which needs
 *  speeds far below that of sound. To be called where a run ends or fails.
 *  @param context [in,out]  logs the warning */
void mor_run_warn_of_speed(mor_context *context, const mor_simulation *simulation);

/** Takes a step, notes the largest speed and measures the probes that are due; warns after the first step of bodies
 *  that overlap.
 *  @param context [in,out]  logs the warning
 *  @param until   [in]      tick not to be passed, > now
 *  @param seconds [in,out]  the time that the step took without the probes is added, unit s
 *  Returns: MOR_OK; what mor_schedule_step and mor_probe_follow return. */
mor_status mor_run_step(mor_context *context, mor_simulation *simulation, int64_t until, double *seconds);

#endif
