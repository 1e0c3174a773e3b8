/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_ROCKS_REPORT_H
#define MOR_CASES_DRIVER_PICTURE_ROCKS_REPORT_H

#include "cases/driver/case/case.h"

#include <stdio.h>

/** @file
 *  Requested and reached content of packed rocks: as a table, in the log, as a chart. */

/** Prints a table of all rocks of a case; nothing when it has none.
 *  @param output   [in,out]  one open stream */
void mor_rocks_report_print(const mor_case *the_case, FILE *output);

/** Sends the same lines to the log. */
void mor_rocks_report_log(mor_context *context, const mor_case *the_case);

/** Draws images/rocks_<name>.png in a run's folder for every item that has several sizes: the requested size
 *  distribution and the rocks placed, each at the middle of its share.
 *  @param folder   [in]      zero-terminated; the run's folder
 *  @param output   [in,out]  one open stream; the path of each chart is printed to it; NULL: not printed
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_rocks_report_draw(mor_context *context, const mor_case *the_case, const char *folder, FILE *output);

#endif
