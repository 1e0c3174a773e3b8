/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_TERRAIN_TERRAIN_INTERNAL_H
#define MOR_RELAXATION_TERRAIN_TERRAIN_INTERNAL_H

#include "relaxation/terrain/terrain.h"

/** @file
 *  What the files of the terrain share. Not for other folders. */

/** The surface of a terrain with what distances to it need. */
typedef struct mor_terrain_surface {
    mor_terrain terrain;    /* owned copy */
    double reach;           /* distances up to this are exact, m */
    double stretch;         /* vertical gap / least possible distance: sqrt(1 + steepest slope squared), 1 */
    double lowest, highest; /* heights, m */
} mor_terrain_surface;

/** Checks that a terrain has nodes, cells and finite heights.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_terrain_check(mor_context *context, const mor_terrain *terrain);

/** Highest coordinate of the nodes along an axis, unit m.
 *  @param axis    [in]  0 or 1 */
double mor_terrain_end(const mor_terrain *terrain, int axis);

/** Writes the two triangles of a square of nodes.
 *  @param column    [in]   of the lower left node
 *  @param row       [in]   of the lower left node
 *  @param triangles [out]  shape [2, 3, 3]; unit m; corners, counterclockwise seen from above */
void mor_terrain_triangles(const mor_terrain *terrain, int column, int row, double triangles[2][3][3]);

/** Distance of a point from the triangles of the surface, unit m: exact up to `reach`, some larger number beyond.
 *  @param point   [in]  shape [3]; unit m
 *  @param reach   [in]  unit m
 *  Threads: safe to call concurrently. */
double mor_terrain_distance(const mor_terrain *terrain, const double *point, double reach);

/** Copies a terrain and finds its range and steepest slope.
 *  @param reach   [in]      unit m; > 0
 *  @param surface [out]     owned by the caller, who ends it with mor_terrain_clear on its terrain
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_terrain_surface_init(mor_context *context, const mor_terrain *terrain, double reach,
                                    mor_terrain_surface *surface);

/** Distance from the surface, unit m, positive above it: exact within reach, beyond it a lower bound of the magnitude.
 *  @param point   [in]  shape [3]; unit m
 *  Threads: safe to call concurrently. */
double mor_terrain_surface_signed(const mor_terrain_surface *surface, const double *point);

/** The surface and the layer of a release shape, or NULL for another shape.
 *  Returns: borrowed, for the life of the shape. */
const mor_terrain_surface *mor_terrain_release_surface(const mor_shape *shape);

/** Thickness of a release layer at a place, unit m; zero outside its polygon.
 *  @param shape [in]  a release shape
 *  @param x     [in]  unit m
 *  @param y     [in]  unit m */
double mor_terrain_release_thickness(const mor_shape *shape, double x, double y);

/** Fills nodes without data: heights inside a hole solve Laplace's equation between its rims.
 *  @param context [in,out]  what was filled is logged
 *  @param terrain [in,out]  at least one node has data
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_terrain_fill_holes(mor_context *context, mor_terrain *terrain);

/** Replaces the nodes by those of a square grid from the first node on, by bilinear interpolation.
 *  @param terrain [in,out]  unchanged after a failure
 *  @param cell    [in]      unit m; > 0
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when fewer than 2 x 2 nodes are left, or too many; MOR_ERROR_MEMORY. */
mor_status mor_terrain_resample(mor_context *context, mor_terrain *terrain, double cell);

/** Copies a text.
 *  @param text    [in]      zero-terminated; NULL: there is none
 *  @param copy    [out]     one pointer; NULL without a text; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_terrain_copy_text(mor_context *context, const char *text, char **copy);

/** Checks what is asked of a raster.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for no path, cells without size, an empty crop, an infinite offset. */
mor_status mor_terrain_check_request(mor_context *context, const mor_terrain_request *request);

/** Refuses cliffs that no ground has, and warns of unlikely ones.
 *  @param request [in]      its path is named
 *  @param terrain [in]      without holes
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_terrain_check_steps(mor_context *context, const mor_terrain_request *request,
                                   const mor_terrain *terrain);

/** Rasters that are text. */
typedef enum mor_terrain_format {
    MOR_TERRAIN_BINARY, /* no text */
    MOR_TERRAIN_ESRI,
    MOR_TERRAIN_GRASS,
    MOR_TERRAIN_SURFER
} mor_terrain_format;

/** Checks a raster of text word by word: each key of the header is known and given once, each value is a number of its
 *  range, and as many numbers follow as the header declares.
 *  @param path    [in]      zero-terminated
 *  @param format  [in]      not binary
 *  @param n       [in]      shape [2]; columns and rows as they were read otherwise
 *  Returns: MOR_OK; MOR_ERROR_IO with line and column. */
mor_status mor_terrain_check_text(mor_context *context, const char *path, mor_terrain_format format, const int *n);

/** The reference system stated by a file beside a raster (.prj). Zeroed: there is none. */
typedef struct mor_terrain_prj {
    char path[4096];  /* zero-terminated; empty: there is none */
    char *memory;     /* owned; of both texts */
    char *first;      /* zero-terminated; the first statement, as PROJCS[...], or all keywords; borrowed */
    char *rest;       /* zero-terminated; what follows, as VERTCS[...]; borrowed */
    bool is_keywords; /* the old form, lines of a keyword and a value */
} mor_terrain_prj;

/** Finds the .prj beside a raster and parses it; a byte order mark is skipped.
 *  @param raster  [in]      zero-terminated; path
 *  @param prj     [out]     ended with mor_terrain_prj_clear, also after a failure
 *  Returns: MOR_OK, also without one; MOR_ERROR_ARGUMENT for one that is too long, or whose Zunits are not meters;
 *  MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_terrain_prj_load(mor_context *context, const char *raster, mor_terrain_prj *prj);

/** Frees what was loaded.
 *  @param prj     [in,out]  becomes zeroed */
void mor_terrain_prj_clear(mor_context *context, mor_terrain_prj *prj);

/** Whether a file beside a raster may change what is read. Copies of lower resolution do not, nor does an .aux.xml of
 *  statistics alone, which raster viewers write.
 *  @param path [in]  zero-terminated */
bool mor_terrain_side_is_relevant(const char *path);

/** Maximum number of nodes of a terrain, so that it fits into memory beside the particles on it. */
#define MOR_TERRAIN_NODES_MAX 67108864.0

#endif
