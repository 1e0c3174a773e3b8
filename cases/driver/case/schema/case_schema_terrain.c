/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"

#include <math.h>

/* Keys of the shapes of the ground: terrain, release and posts. */

#define PAIR MOR_SCHEMA_VECTOR, 2

const mor_case_key mor_case_terrain_keys[] = {
    {{"file", WORDS, "1", REQUIRED, ANY, NULL,
      "elevation raster in meters (GeoTIFF, ESRI ASCII, ...); path from the folder of the case file"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_shape, ground.file)},
    {{"crop_min", PAIR, "m", DEFAULT(-INFINITY), ANY, NULL,
      "lower left corner of the window that is used, in coordinates of the raster"},
     SHAPE(ground.crop_minimum),
     .computed = "all",
     .keeps_scale = true},
    {{"crop_max", PAIR, "m", DEFAULT(INFINITY), ANY, NULL,
      "upper right corner of the window that is used, in coordinates of the raster"},
     SHAPE(ground.crop_maximum),
     .computed = "all",
     .keeps_scale = true},
    {{"cell", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "the raster is interpolated to square cells of this size"},
     SHAPE(ground.cell),
     .computed = "as in the raster",
     .keeps_scale = true},
    {{"offset", VECTOR, "m", DEFAULT(NAN), ANY, NULL, "subtracted from the raster's coordinates and heights"},
     SHAPE(ground.offset),
     .computed = "lower left node and lowest height of the window",
     .keeps_scale = true},
    {{"fill_no_data", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "whether cells without data are interpolated from their neighbors; otherwise they are refused"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_shape, ground.fills_no_data)},
    {{"extend_edge", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "whether the ground continues at the height of its edge where the domain reaches beyond the raster; otherwise "
      "such "
      "a domain is refused"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_shape, ground.extends_edge)},
    {{"thickness", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "thickness of the solid below its lowest point"},
     SHAPE(ground.thickness),
     .computed = "8 * spacing"},
    END};

/* What lies on the ground names the wall. */
#define GROUND                                                                                                         \
    {                                                                                                                  \
        {"ground", WORDS, "1", REQUIRED, ANY, NULL, "name of the wall whose shape is the terrain"},                    \
            MOR_CASE_STORE_NAME, AT(mor_case_shape, ground.wall)                                                       \
    }

const mor_case_key mor_case_release_keys[] = {
    GROUND,
    {{"thickness", SCALAR, "m", REQUIRED, POSITIVE, NULL, "vertical thickness of the layer"}, SHAPE(ground.thickness)},
    {{"rim", SCALAR, "m", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "horizontal distance from the edge over which the thickness grows from zero; 0: vertical sides"},
     SHAPE(ground.rim)},
    END};

const mor_case_key mor_case_posts_keys[] = {
    GROUND,
    {{"size", PAIR, "m", REQUIRED, POSITIVE, NULL, "side lengths of each post along x and y"}, SHAPE(ground.size)},
    {{"height", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL,
      "height above the ground at the center of each post; give height or top"},
     SHAPE(ground.height),
     .computed = "follows from top"},
    {{"top", SCALAR, "m", DEFAULT(NAN), ANY, NULL, "elevation of the tops of all posts; give height or top"},
     SHAPE(ground.top),
     .computed = "follows from height"},
    END};

const mor_case_part mor_case_release_parts[] = {
    {"points", true, "list of pairs [m]", "corners in plan view, in order, the first not repeated"},
    {NULL, false, NULL, NULL}};
const mor_case_part mor_case_posts_parts[] = {{"at", true, "list of pairs [m]", "centers in plan view"},
                                              {NULL, false, NULL, NULL}};
