/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_CHARTS_H
#define MOR_CASES_DRIVER_PICTURE_CHARTS_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  Charts of a run's series over time: one per unit, so that quantities that can be compared share an axis. */

/** Draws images/chart_<first column>.png for every unit and size among the columns of series.csv that change:
 *  quantities of one unit share an axis unless one is more than twenty times as large as another.
 *  @param folder  [in]      zero-terminated; the run's folder
 *  @param output  [in,out]  one open stream; the path of each chart is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_charts_render(mor_context *context, const char *folder, FILE *output);

#endif
