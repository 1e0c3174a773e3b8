/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_TERRAIN_TERRAIN_H
#define MOR_RELAXATION_TERRAIN_TERRAIN_H

#include "core/geometry/shape.h"

#include <stdbool.h>

/** @file
 *  Terrain from elevation rasters. It is the solid under a surface of triangles: each square of four raster nodes is
 *  cut along the diagonal that leaves the smaller fold. Heights are along z. Only terrain_read.c calls GDAL. */

/** Elevations on a grid of nodes (the centers of raster cells). Owner: the caller, who ends it with
 *  mor_terrain_clear. */
typedef struct mor_terrain {
    double *heights;         /* shape [n_y, n_x], unit m; row 0 is the one with the least y; NaN: no data */
    int n_x, n_y;            /* nodes along x and y; >= 2 */
    double origin[2];        /* x and y of the first node, m, in the frame of the case (after `offset`) */
    double cell[2];          /* distance of nodes along x and y, m; > 0 */
    double offset[3];        /* what was subtracted from the raster's coordinates and heights, m */
    double raster_corner[2]; /* x of the left and y of the upper edge of the whole raster, in its coordinates, m */
    double raster_cell[2];   /* size of its cells along x and y, m; 0: not read from a raster */
    char *system;            /* its reference system as well-known text; NULL: not given; owned */
    int added[2][2]; /* nodes along x and y that mor_terrain_extend put before the first and behind the last one */
    char datum[128]; /* horizontal and vertical reference system as text; empty: not given */
    signed char
        *cuts;     /* shape [n_y - 1, n_x - 1]: whether squares are cut upward, 1; NULL: found anew each time; owned */
    uint64_t hash; /* of all files it was read from: mor_hash_file of a single one */
} mor_terrain;

/** How to read a raster. Made ready by mor_terrain_request_init. */
typedef struct mor_terrain_request {
    const char *path;       /* zero-terminated; any raster GDAL reads: GeoTIFF, ESRI ASCII, ... */
    double crop_minimum[2]; /* kept: nodes inside, in the raster's coordinates, m; -INFINITY: all */
    double crop_maximum[2]; /* likewise; INFINITY: all */
    double cell;            /* resampled (bilinear) to square cells of this size, m; NaN: as it is */
    double offset[3];       /* subtracted from coordinates and heights, m; NaN: the lower left node and the lowest
                                * height that are kept */
    bool fills_no_data;     /* whether holes without data are filled from their boundaries; else they are refused */
} mor_terrain_request;

/** Sets what is not written to. */
void mor_terrain_request_init(mor_terrain_request *request);

/** Reads a raster.
 *  @param context [in,out]  what was assumed or filled is logged
 *  @param terrain [out]     empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_IO for a file that is no raster; MOR_ERROR_ARGUMENT for a raster that is rotated, in
 *  degrees or feet, has fewer than 2 x 2 nodes in the crop, lacks data, or has a .prj beside it that cannot be
 *  understood, with what to do; MOR_ERROR_MEMORY. */
mor_status mor_terrain_read(mor_context *context, const mor_terrain_request *request, mor_terrain *terrain);

/** Frees what the terrain owns; accepts a zeroed one. */
void mor_terrain_clear(mor_context *context, mor_terrain *terrain);

/** Continues the ground to cover a rectangle: whole cells are added beyond its edges, at the height of the nearest
 *  point of the edge. Heights over the raster keep their values.
 *  @param terrain [in,out]  unchanged after a failure
 *  @param minimum [in]      shape [2], unit m; of the rectangle
 *  @param maximum [in]      shape [2], unit m
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when that makes too many nodes; MOR_ERROR_MEMORY. */
mor_status mor_terrain_extend(mor_context *context, mor_terrain *terrain, const double *minimum, const double *maximum);

/** Finds how far the raster reaches, without what was added.
 *  @param minimum [out]  shape [2], unit m
 *  @param maximum [out]  shape [2], unit m */
void mor_terrain_reach(const mor_terrain *terrain, double *minimum, double *maximum);

/** Refuses a point beside the raster.
 *  @param name    [in]      zero-terminated; what such points are, for the message
 *  @param index   [in]      of the point in its list; the message counts from 1
 *  @param point   [in]      shape [2], unit m; seen from above
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT with the reach of the raster. */
mor_status mor_terrain_check_point(mor_context *context, const mor_terrain *terrain, const char *name, int index,
                                   const double *point);

/** Height of the surface, unit m. Beyond the edge the height of the nearest point of the edge.
 *  @param x       [in]  unit m
 *  @param y       [in]  unit m
 *  Threads: safe to call concurrently. */
double mor_terrain_height(const mor_terrain *terrain, double x, double y);

/** Finds the range of the heights, unit m. Nodes without data do not count; without any the range is empty.
 *  @param lowest  [out]  one number, unit m
 *  @param highest [out]  one number, unit m */
void mor_terrain_range(const mor_terrain *terrain, double *lowest, double *highest);

/** Makes the ground as a shape: solid below the surface, down to `thickness` under its lowest point, with vertical
 *  sides at the raster's edge. Distances are exact within `reach` of the surface, beyond it a lower bound.
 *  @param terrain   [in]      copied
 *  @param thickness [in]      unit m; > 0
 *  @param reach     [in]      unit m; > 0; a few spacings
 *  @param shape     [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_shape_new_terrain(mor_context *context, const mor_terrain *terrain, double thickness, double reach,
                                 mor_shape **shape);

/** Makes a layer on the ground as a shape: between the surface and `thickness` (measured vertically) above it, inside a
 *  polygon seen from above. The rim may be sloped: within `rim` of the polygon's edge the thickness falls to zero.
 *  Distances are those of the parts the layer is cut from: exact near its two faces, a lower bound near rims and edges.
 *  @param terrain   [in]      copied
 *  @param points    [in]      shape [n_points, 2]; unit m; corners seen from above, either orientation, over the raster
 *  @param n_points  [in]      >= 3
 *  @param thickness [in]      unit m; > 0
 *  @param rim       [in]      unit m; >= 0
 *  @param reach     [in]      unit m; as for mor_shape_new_terrain
 *  @param shape     [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: as mor_shape_new_terrain. */
mor_status mor_shape_new_release(mor_context *context, const mor_terrain *terrain, const double *points, int n_points,
                                 double thickness, double rim, double reach, mor_shape **shape);

/** Wall particles that follow the surface: a column under each point of a square lattice in x and y, in layers of one
 *  spacing, the first half a spacing under the surface, as deep as `layers` spacings measured across the surface. Each
 *  particle represents spacing^3, so the volume of the ground, and with it the position of the surface, is preserved on
 *  any slope.
 *  @param spacing  [in]      unit m; > 0
 *  @param origin   [in]      shape [2]; a corner of a lattice cell, unit m
 *  @param layers   [in]      spacings; >= 1
 *  @param bounds   [in]      columns outside its x and y, or beside the raster, are left out, unit m
 *  @param points   [out]     the address of one array [n_points, 3], unit m; from MOR_NEW; owned by the caller
 *  @param n_points [out]     one number
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_terrain_fill(mor_context *context, const mor_terrain *terrain, double spacing, const double *origin,
                            int layers, const mor_bounds *bounds, double **points, int64_t *n_points);

/** What mor_terrain_fill is asked for. */
typedef struct mor_terrain_columns {
    double spacing;    /* m */
    double origin[2];  /* a corner of a lattice cell, m */
    int layers;        /* spacings, 1 */
    mor_bounds bounds; /* m */
} mor_terrain_columns;

/** Numbers wall particles, so that mor_terrain_place finds them again.
 *  @param points   [in]   shape [n_points, 3]; of mor_terrain_fill, or some of them in their order, unit m
 *  @param n_points [in]   number of points
 *  @param numbers  [out]  shape [n_points]; rising; -1: it is none of these points
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_terrain_number(mor_context *context, const mor_terrain *terrain, const mor_terrain_columns *wanted,
                              const double *points, int64_t n_points, int64_t *numbers);

/** Finds wall particles again by their numbers, as mor_terrain_fill has placed them.
 *  @param numbers [in]   shape [n]
 *  @param n       [in]   number of particles
 *  @param points  [out]  shape [n, 3], unit m
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_terrain_place(mor_context *context, const mor_terrain *terrain, const mor_terrain_columns *wanted,
                             const int64_t *numbers, int64_t n, double *points);

/** Soil particles of a release that follow the surface: columns over the same square lattice, the first layer half a
 *  spacing above the surface, as many layers as the thickness holds at that place. With mor_terrain_fill below, the two
 *  mirror each other at the surface on any slope.
 *  @param release  [in]      from mor_shape_new_release
 *  @param spacing  [in]      unit m; > 0
 *  @param origin   [in]      shape [2]; a corner of a lattice cell, unit m
 *  @param points   [out]     the address of one array [n_points, 3], unit m; from MOR_NEW; owned by the caller
 *  @param n_points [out]     one number
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_terrain_fill_release(mor_context *context, const mor_shape *release, double spacing,
                                    const double *origin, double **points, int64_t *n_points);

/** Finds the volume of a release from its thickness over a grid of columns.
 *  @param volume [out]  one number, unit m3; 0 for any other shape
 *  Returns: whether the shape is a release. Accuracy: 1e-3 relative or better. Cost: milliseconds. */
bool mor_terrain_release_volume(const mor_shape *shape, double *volume);

/** The terrain that a ground or a release follows; NULL for any other shape.
 *  Returns: borrowed, for the life of the shape. Threads: safe to call concurrently. */
const mor_terrain *mor_terrain_view(const mor_shape *shape);

#endif
