/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_STYLE_H
#define MOR_CASES_DRIVER_MAP_MAP_STYLE_H

#include "cases/driver/map/map_list.h"

/** @file
 *  The style of a map as QGIS reads it (.qml): classes with colors and labels; of the ground a hillshade. QGIS takes
 *  the file that has the name of the map by itself. */

/** Writes a style.
 *  @param kind    [in]      of the list
 *  @param largest [in]      value of the map, in its unit, [1]; NaN: it has none
 *  @param path    [in]      zero-terminated; replaced when it exists
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_map_style_write(mor_context *context, const mor_map_kind *kind, double largest, const char *path);

#endif
