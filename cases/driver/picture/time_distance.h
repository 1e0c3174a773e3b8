/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_TIME_DISTANCE_H
#define MOR_CASES_DRIVER_PICTURE_TIME_DISTANCE_H

#include "cases/driver/case/case.h"

#include <stdio.h>

/** @file
 *  The time-distance chart of a slide: where its front, or any other percentile of its mass, was along a path. */

/** Draws images/time_distance.png from series.csv where probes of type run_out follow a path; else nothing.
 *  @param folder   [in]      zero-terminated; the run's folder
 *  @param output   [in,out]  one open stream; the path of the chart is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_time_distance_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output);

#endif
