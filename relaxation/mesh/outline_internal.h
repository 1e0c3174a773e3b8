/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_OUTLINE_INTERNAL_H
#define MOR_RELAXATION_MESH_OUTLINE_INTERNAL_H

#include "relaxation/mesh/outline.h"

/** @file
 *  Corners before they become an outline. For outline.c and outline_read.c only. */

/** Corners as they were given. */
typedef struct mor_outline_corners {
    const char *name; /* zero-terminated; for messages */
    double *points;   /* shape [n_points, 2], m */
    int *lines;       /* shape [n_points]; lines of the file, from 1; NULL: from no file */
    int n_points;
} mor_outline_corners;

/** Merges corners that are one, refuses what is no outline, and brings the rest into counterclockwise order.
 *  @param corners [in,out]  n_points may become smaller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_outline_check(mor_context *context, mor_outline_corners *corners);

#endif
