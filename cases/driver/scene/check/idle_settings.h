/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_IDLE_SETTINGS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_IDLE_SETTINGS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Settings that are valid but can have no effect in this scene, most often because of a wrong place or unit. */

/** Logs a warning for each: removal, release, motion, sleep and maps after the end of the run, filters of gauges that
 *  filter all or nothing, regions of gauges away from their structure, velocities of soil that is taken over.
 *  @param simulation [in]  as it begins */
void mor_idle_settings_warn(mor_context *context, const mor_simulation *simulation);

#endif
