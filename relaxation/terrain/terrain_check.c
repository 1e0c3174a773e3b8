/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What is asked of a raster, and what its heights must be like to be ground. */
#include "relaxation/terrain/terrain_internal.h"

#include <math.h>

/* Relief over extent beyond which a raster without a reference system is likely in degrees; step of height over cell
 * beyond which a missing-data value was likely not declared, and beyond which slopes lose all digits. */
#define LIKELY_DEGREES 20.0
#define LIKELY_MARK 20.0
#define SURELY_MARK 1e4

void mor_terrain_request_init(mor_terrain_request *request)
{
    *request = (mor_terrain_request){.crop_minimum = {-INFINITY, -INFINITY},
                                     .crop_maximum = {INFINITY, INFINITY},
                                     .cell = NAN,
                                     .offset = {NAN, NAN, NAN}};
}

mor_status mor_terrain_check_request(mor_context *context, const mor_terrain_request *request)
{
    MOR_CHECK(context, request->path != NULL && request->path[0] != '\0', MOR_ERROR_ARGUMENT,
              "no raster file is given: name one");
    MOR_CHECK(context, isnan(request->cell) || (request->cell > 0.0 && isfinite(request->cell)), MOR_ERROR_ARGUMENT,
              "%s: cells of %g m are asked for: give a length above zero", request->path, request->cell);
    for (int a = 0; a < 2; ++a) {
        MOR_CHECK(context, request->crop_minimum[a] < request->crop_maximum[a], MOR_ERROR_ARGUMENT,
                  "%s: the crop is empty along %c: from %g m to %g m; give a minimum below the maximum", request->path,
                  "xy"[a], request -> crop_minimum[a], request -> crop_maximum[a]);
    }
    for (int a = 0; a < 3; ++a) {
        MOR_CHECK(context, !isinf(request->offset[a]), MOR_ERROR_ARGUMENT,
                  "%s: the offset along %c is infinite: give a length, or none", request->path, "xyz"[a]);
    }
    return MOR_OK;
}

/* Heights in meters over an extent in degrees. */
static bool may_be_degrees(const mor_terrain *terrain)
{
    double lowest;
    double highest;
    mor_terrain_range(terrain, &lowest, &highest);
    const double extent =
        fmax(mor_terrain_end(terrain, 0) - terrain->origin[0], mor_terrain_end(terrain, 1) - terrain->origin[1]);
    return terrain->datum[0] == '\0' && highest - lowest > LIKELY_DEGREES * extent;
}

/* Cliffs no ground has. */
mor_status mor_terrain_check_steps(mor_context *context, const mor_terrain_request *request, const mor_terrain *terrain)
{
    double steepest = 0.0;
    for (int row = 0; row < terrain->n_y; ++row) {
        for (int column = 0; column < terrain->n_x; ++column) {
            const double *at = terrain->heights + (int64_t)row * terrain->n_x + column;
            const double x = column > 0 ? fabs(at[0] - at[-1]) / terrain->cell[0] : 0.0;
            const double y = row > 0 ? fabs(at[0] - at[-terrain->n_x]) / terrain->cell[1] : 0.0;
            steepest = fmax(steepest, fmax(x, y));
        }
    }
    const bool is_degrees = may_be_degrees(terrain);
    MOR_CHECK(
        context, steepest <= SURELY_MARK, MOR_ERROR_ARGUMENT,
        "%s: heights of neighboring nodes differ by %g cells; allowed are %g: %sif the raster marks missing data with "
        "a number, declare it with gdal_edit.py -a_nodata",
        request->path, steepest, SURELY_MARK,
        is_degrees
            ? "it names no reference system, and if its coordinates are degrees, project it with gdalwarp -s_srs "
              "EPSG:4326 -t_srs EPSG:<code of the local map grid>; "
            : "");
    if (is_degrees || steepest > LIKELY_MARK) {
        mor_context_log(context, MOR_LOG_WARNING, "%s: heights of neighboring nodes differ by %g cells: %s",
                        request->path, steepest,
                        is_degrees ? "are its coordinates degrees, or does a number mark missing data without being "
                                     "declared?"
                                   : "does a number mark missing data without being declared?");
    }
    return MOR_OK;
}
