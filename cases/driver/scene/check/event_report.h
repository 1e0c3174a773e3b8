/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_EVENT_REPORT_H
#define MOR_CASES_DRIVER_SCENE_CHECK_EVENT_REPORT_H

#include "cases/driver/scene/simulation.h"

#include <stdio.h>

/** @file
 *  What happens on the way of a run, in words. */

/** Prints when walls and bodies are removed or move on a path, until when soil stands, and what a stage begins with.
 *  @param out [in,out]  open for writing */
void mor_event_report_print(FILE *out, const mor_simulation *s);

#endif
