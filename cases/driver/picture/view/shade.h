/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_SHADE_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_SHADE_H

#include "cases/driver/picture/view/scene.h"

/** @file
 *  From spheres in view space to pixels: one soft key light with shadows, light from a bright sky with ambient
 *  occlusion, a ground plane that catches both, and a slight fade with depth. Colors stay near the ones given, so that
 *  a color bar can be read against them. Random numbers depend on the pixel alone: the same input gives the same pixels
 *  for any number of threads. Everything is in view space (camera.h), in pixels; no lengths in meters. */

/** Spheres that are seen in the same way. */
typedef struct mor_shade_layer {
    const mor_scene *scene; /* borrowed; NULL: the layer is empty */
    const float *spheres;   /* shape [n,4], px; what the scene was built from */
    const float *color;     /* shape [n,3], 1; linear sRGB */
    const float *rim;       /* shape [n], 1, in [0, 1]; how much darker the rim of a disc is in plane pictures */
} mor_shade_layer;

/** A round patch of a plane that fades towards its edge and carries a square grid of thin lines. */
typedef struct mor_shade_ground {
    bool is_shown;    /* false: none of the rest is read */
    double normal[3]; /* shape [3], 1, unit vector with a positive z: the viewer sees the upper side */
    double first[3];  /* shape [3], 1, unit vector in the plane, along one family of grid lines */
    double second[3]; /* shape [3], 1, unit vector in the plane, normal to first */
    double origin[3]; /* shape [3], px; a crossing of grid lines */
    double center[3]; /* shape [3], px; middle of the patch, in the plane */
    double radius;    /* px; the patch has faded away here */
    double spacing;   /* px; between grid lines; 0: no grid */
    double color[3];  /* shape [3], 1; linear sRGB of the unshaded patch */
} mor_shade_ground;

/** Everything that determines the pixels. */
typedef struct mor_shade {
    mor_shade_layer solid; /* opaque: casts shadows and is lit */
    mor_shade_layer ghost; /* transparent: the nearest surface only, without shadows */
    double ghost_opacity;  /* 1; in [0, 1] */
    bool is_flat;          /* plane pictures: no light, no ground, only the rims of the discs */
    double up[3];          /* shape [3], 1, unit vector; against gravity */
    mor_shade_ground ground;
    double background[3]; /* shape [3], 1; linear sRGB */
    double origin[2];     /* shape [2], px; view-space origin, from the top left corner of the block of pixels */
    int size[2];          /* columns and rows of the block of pixels */
    double low[3];        /* shape [3], px; lower corner of a box around all spheres */
    double high[3];       /* shape [3], px; upper corner */
    double least_radius;  /* px; of the smallest sphere; 0: not known, then every pixel takes all samples */
    double ambient_reach; /* px; things farther away do not darken a crevice */
    int n_samples;        /* samples per pixel along each axis, 1 to 8 */
    int n_ambient;        /* rays to the sky per sample, 1 to 64 */
} mor_shade;

/** Computes the pixels.
 *  @param rgb     [out]     shape [rows, columns, 3]; screen values
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for sample counts out of range.
 *  Cost: about n_samples^2 * (2 + n_ambient) rays for each pixel with an edge in it, 2 + n_ambient for each other one
 *  that shows something.
 *  Threads: parallel inside. */
mor_status mor_shade_render(mor_context *context, const mor_shade *shade, uint8_t *rgb);

#endif
