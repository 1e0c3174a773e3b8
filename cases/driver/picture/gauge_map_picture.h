/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_GAUGE_MAP_PICTURE_H
#define MOR_CASES_DRIVER_PICTURE_GAUGE_MAP_PICTURE_H

#include "cases/driver/case/case.h"

#include <stdbool.h>

/** @file
 *  A picture of the map of pressure of a gauge. */

/** Draws the peak pressure of the soil in each cell, seen against the direction of the gauge.
 *  @param table    [in]   zero-terminated path of gauge_<name>_map.csv
 *  @param path     [in]   zero-terminated path of the picture
 *  @param is_drawn [out]  whether there was a force to show
 *  Returns: MOR_OK, also where there is nothing to show; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_gauge_map_picture_draw(mor_context *context, const mor_case_gauge *gauge, const char *table,
                                      const char *path, bool *is_drawn);

#endif
