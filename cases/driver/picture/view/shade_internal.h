/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_SHADE_INTERNAL_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_SHADE_INTERNAL_H

#include "cases/driver/picture/view/shade.h"

/** @file
 *  What a ray hits and how much light falls there; shade.c decides where rays are sent. */

enum { MOR_SHADE_SAMPLES_MAX = 8, MOR_SHADE_AMBIENT_MAX = 64, MOR_SHADE_TURNS = 64 };
/* Corners of pixels take light from directions that repeat along both axes: each block of MOR_SHADE_BLOCK by
 * MOR_SHADE_BLOCK corners, wherever it lies, covers the sky once. Their mean therefore has no noise. */
enum { MOR_SHADE_BLOCK = 4 };
enum {
    MOR_SHADE_GROUPS_MAX = MOR_SHADE_SAMPLES_MAX * MOR_SHADE_SAMPLES_MAX,
    MOR_SHADE_CORNERS = MOR_SHADE_BLOCK * MOR_SHADE_BLOCK
};

/** Directions of the rays of one sample, before the rotation about z. */
typedef struct mor_shade_rays {
    double sky[MOR_SHADE_AMBIENT_MAX][3]; /* 1; cosine-weighted directions about z; only n_ambient are used */
    double lamp[2];                       /* 1; place on the disc the key light covers */
} mor_shade_rays;

/** What stays the same for all pixels. */
typedef struct mor_shade_frame {
    const mor_shade *shade;
    double key[3];                                /* 1; towards the key light */
    mor_shade_rays samples[MOR_SHADE_GROUPS_MAX]; /* of the samples of a pixel */
    mor_shade_rays corners[MOR_SHADE_CORNERS];    /* of corners, by row and column within a block */
    double rotation[MOR_SHADE_TURNS][2];          /* 1; cosine and sine of rotations about z */
    double center[3];                             /* px; of a ball around all that is solid */
    double reach;                                 /* px; its radius */
    double open_light;                            /* 1; on unobstructed ground */
} mor_shade_frame;

/** One sample of one pixel or corner. */
typedef struct mor_shade_probe {
    double xy[2]; /* px */
    const mor_shade_rays *rays;
    int rotation; /* of the rays; the same for all samples of a pixel, so that together they are even */
} mor_shade_probe;

/** A place on a sphere or on the ground. */
typedef struct mor_shade_surface {
    double point[3];    /* px */
    double normal[3];   /* 1 */
    const float *color; /* shape [3], 1; of a sphere */
    double rim;         /* 1; of a disc in plane pictures */
} mor_shade_surface;

/** Prepares directions. */
void mor_shade_frame_init(const mor_shade *shade, mor_shade_frame *frame);

/** Finds the first sphere of a layer under a picture point.
 *  @param xy    [in]   shape [2], px
 *  @param found [out]  untouched when there is none
 *  Returns: the index of the sphere, or -1. */
int64_t mor_shade_find_sphere(const mor_shade_frame *frame, const mor_shade_layer *layer, const double *xy,
                              mor_shade_surface *found);

/** The place of a known sphere under a picture point, or at its rim beside it.
 *  @param i     [in]   index of the sphere
 *  @param xy    [in]   shape [2], px */
void mor_shade_touch_sphere(const mor_shade_layer *layer, int64_t i, const double *xy, mor_shade_surface *found);

/** Finds the ground under a picture point.
 *  @param xy     [in]   shape [2], px
 *  @param found  [out]  untouched outside the patch
 *  Returns: its opacity, 1; 0 outside the patch. */
double mor_shade_find_ground(const mor_shade_ground *ground, const double *xy, mor_shade_surface *found);

/** Light on a sphere, 1; not of plane pictures. Sends the rays of one sample. */
double mor_shade_light_sphere(const mor_shade_frame *frame, const mor_shade_surface *surface,
                              const mor_shade_probe *probe);

/** Returns whether the light on the ground is unobstructed; may miss some points.
 *  Returns: true where the light is frame->open_light. */
bool mor_shade_is_open(const mor_shade_frame *frame, const mor_shade_surface *surface);

/** Light on the ground, 1, likewise. */
double mor_shade_light_ground(const mor_shade_frame *frame, const mor_shade_surface *surface,
                              const mor_shade_probe *probe);

/** Color of a sphere in a light.
 *  @param light   [in]   1; not read in plane pictures
 *  @param color   [out]  shape [3], 1; linear sRGB */
void mor_shade_color_sphere(const mor_shade *shade, const mor_shade_surface *surface, double light, double *color);

/** Color of the ground in a light, with its grid.
 *  @param light   [in]   1
 *  @param color   [out]  shape [3], 1; linear sRGB */
void mor_shade_color_ground(const mor_shade_ground *ground, const mor_shade_surface *surface, double light,
                            double *color);

#endif
