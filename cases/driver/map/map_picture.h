/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_PICTURE_H
#define MOR_CASES_DRIVER_MAP_MAP_PICTURE_H

#include "cases/driver/case/case.h"

#include <stdio.h>

/** @file
 *  Pictures of the maps in the folder of a run: values in classes of color over the light and the contours of the
 *  ground, with coordinates, a legend and a scale. */

/** Draws images/map-<name>.png from maps/<name>.tif, for the maps that have a picture; nothing where the case wants no
 *  maps, or the run has not written them yet.
 *  @param the_case [in]      of the run
 *  @param folder   [in]      zero-terminated; of the run
 *  @param output   [in,out]  one open stream; the path of each picture is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_ARGUMENT for a file that is no map; MOR_ERROR_MEMORY. */
mor_status mor_map_pictures_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output);

#endif
