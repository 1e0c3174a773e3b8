/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_CHARTS_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_CHARTS_H

#include "cases/driver/sweep/result/sweep_table.h"

/** @file
 *  Charts of a sweep: each result over each variable that is a number, members as dots, means with their intervals. */

/** Draws <folder>/images/<result>-over-<variable>.png for each pair that has something to show.
 *  @param folder [in]      zero-terminated; its folder images is there
 *  @param output [in,out]  one open stream; the path of each chart is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_sweep_charts_draw(mor_context *context, mor_sweep_table *table, const char *folder, FILE *output);

#endif
