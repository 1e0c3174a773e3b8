/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_PICTURE_H
#define MOR_CASES_DRIVER_MAP_MAP_PICTURE_H

#include "cases/driver/case/case.h"
#include "cases/driver/map/map_list.h"
#include "relaxation/terrain/terrain_raster.h"

#include <stdio.h>

/** @file
 *  Pictures of the maps in the folder of a run: values in classes of color over the light and the contours of the
 *  ground, with structures that stand on it, coordinates, a legend and a scale. */

/** What a picture shows. Strings are zero-terminated. */
typedef struct mor_map_picture {
    const char *title;    /* one line, before the name of the map; "": none */
    const char *subtitle; /* one line below */
    const char *note;     /* below the legend; "": none */
    const mor_map_kind *kind;
    const mor_terrain_raster *map;    /* of that kind */
    const mor_terrain_raster *ground; /* heights of the ground in the same cells; NULL: none */
    const mor_case *the_case;         /* whose structures are drawn; NULL: none are */
} mor_map_picture;

/** Draws one map.
 *  @param path    [in]      zero-terminated; an existing file is replaced
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_map_picture_write(mor_context *context, const mor_map_picture *picture, const char *path);

/** Reads a map of a run.
 *  @param folder   [in]      zero-terminated; of the run
 *  @param name     [in]      zero-terminated; of the map
 *  @param map      [out]     ended with mor_terrain_raster_clear, also after a failure
 *  @param is_there [out]     one flag; false: the run has not written it
 *  Returns: MOR_OK; as mor_terrain_raster_read. */
mor_status mor_map_read(mor_context *context, const char *folder, const char *name, mor_terrain_raster *map,
                        bool *is_there);

/** Draws images/map-<name>.png from maps/<name>.tif, for the maps that have a picture; nothing where the case wants no
 *  maps, or the run has not written them yet.
 *  @param the_case [in]      of the run
 *  @param folder   [in]      zero-terminated; of the run
 *  @param output   [in,out]  one open stream; the path of each picture is printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_ARGUMENT for a file that is no map; MOR_ERROR_MEMORY. */
mor_status mor_map_pictures_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output);

#endif
