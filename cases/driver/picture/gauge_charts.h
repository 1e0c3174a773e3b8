/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_GAUGE_CHARTS_H
#define MOR_CASES_DRIVER_PICTURE_GAUGE_CHARTS_H

#include "cases/driver/case/case.h"

#include <stdio.h>

/** @file
 *  Pictures of gauges from their files in the folder of a run: forces over time, and maps of peak pressure. */

/** Draws images/gauge_<name>.png for every gauge of a case, and images/gauge_<name>_map.png for those with a map.
 *  @param folder   [in]      zero-terminated; the run's folder; without gauges.csv nothing is drawn
 *  @param output   [in,out]  one open stream; the path of each picture is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_gauge_charts_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output);

#endif
