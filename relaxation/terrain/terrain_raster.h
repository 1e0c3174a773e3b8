/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_TERRAIN_TERRAIN_RASTER_H
#define MOR_RELAXATION_TERRAIN_TERRAIN_RASTER_H

#include "core/base/context.h"

/** @file
 *  Rasters of results as GeoTIFF of one band, with georeference, unit and text. terrain_read.c has the functions, since
 *  it alone calls GDAL. */

enum { MOR_TERRAIN_RASTER_NAME_BYTES = 64, MOR_TERRAIN_RASTER_TEXT_BYTES = 320 };

/** One raster. Owner: the caller; what was read ends with mor_terrain_raster_clear. */
typedef struct mor_terrain_raster {
    double corner[2]; /* x of the left and y of the upper edge, m */
    double cell[2];   /* size of the cells along x and y, m; > 0 */
    int n[2];         /* columns and rows, >= 1 */
    char *system;     /* reference system as well-known text; NULL: none */
    double *values;   /* shape [n[1], n[0]], any unit, [1]; the first row is the uppermost; NaN: no data */
    char name[MOR_TERRAIN_RASTER_NAME_BYTES];     /* what the values are, in a word */
    char unit[MOR_TERRAIN_RASTER_NAME_BYTES];     /* of the values, as "m" */
    char text[MOR_TERRAIN_RASTER_TEXT_BYTES];     /* what they are in a sentence */
    char settings[MOR_TERRAIN_RASTER_TEXT_BYTES]; /* what they depend on in the run that made them; may be empty */
} mor_terrain_raster;

/** Writes a raster as GeoTIFF, compressed without loss, in double precision; -9999 marks cells without data. The same
 *  raster gives the same bytes.
 *  @param path    [in]      zero-terminated; replaced when it exists
 *  @param it      [in]      values are finite or NaN
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_terrain_raster_write(mor_context *context, const char *path, const mor_terrain_raster *it);

/** Reads a raster that mor_terrain_raster_write has written.
 *  @param path    [in]      zero-terminated
 *  @param it      [out]     empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_IO or MOR_ERROR_ARGUMENT for a file that is no such raster; MOR_ERROR_MEMORY. */
mor_status mor_terrain_raster_read(mor_context *context, const char *path, mor_terrain_raster *it);

/** Frees what a raster owns; accepts a zeroed one. */
void mor_terrain_raster_clear(mor_context *context, mor_terrain_raster *it);

#endif
