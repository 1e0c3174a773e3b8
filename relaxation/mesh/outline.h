/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_OUTLINE_H
#define MOR_RELAXATION_MESH_OUTLINE_H

#include "core/geometry/shape.h"

/** @file
 *  Outlines in the plane, such as profiles of photographed rocks: text files with one corner "x y" per line; blanks,
 *  tabs, commas and semicolons separate; '#' starts a comment. The last corner may repeat the first. The inside is a
 *  shape by mor_shape_new_polygon. */

/** Maximum number of corners of an outline: each distance visits them all. */
enum { MOR_OUTLINE_CORNERS_MAX = 10000 };

/** A closed line. Owner: the caller, who ends it with mor_outline_clear. */
typedef struct mor_outline {
    double *points; /* shape [n_points, 2], unit m; counterclockwise; the first is not repeated */
    int n_points;
} mor_outline;

/** Reads an outline. Corners nearer together than 1e-9 of its size are merged.
 *  @param path    [in]      zero-terminated
 *  @param outline [out]     empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_IO for a file that cannot be read or a line that is no corner, with file and line;
 *  MOR_ERROR_ARGUMENT for fewer than 3 corners, more than MOR_OUTLINE_CORNERS_MAX, edges that cross (with their lines),
 *  no area; MOR_ERROR_MEMORY. */
mor_status mor_outline_read(mor_context *context, const char *path, mor_outline *outline);

/** Makes an outline from corners in either orientation; checked as by mor_outline_read.
 *  @param points   [in]      shape [n_points, 2]; unit m; copied
 *  @param n_points [in]      number of corners
 *  @param outline  [out]     empty after a failure
 *  Returns: as mor_outline_read. */
mor_status mor_outline_init(mor_context *context, const double *points, int n_points, mor_outline *outline);

/** Frees what the outline owns; accepts a zeroed one. */
void mor_outline_clear(mor_context *context, mor_outline *outline);

/** Moves the center of the area to the origin and scales the outline to an equivalent diameter D = 2 sqrt(A / pi).
 *  @param diameter [in]      unit m; NaN: as it is */
void mor_outline_normalize(mor_outline *outline, double diameter);

#endif
