/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_MODEL_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_MODEL_H

#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/view/camera.h"
#include "cases/driver/picture/view/picture.h"
#include "cases/driver/picture/view/shade.h"

/** @file
 *  From a picture's groups to what is rendered: checks of the input, range of the colors, orientation and extent of the
 *  scene, then the spheres in view space with their colors, and the ground. It draws nothing. */

enum { MOR_MODEL_COLOR_TICKS = 7 }; /* most ticks along the color bar */

/** Range of the color bar. */
typedef struct mor_model_range {
    double low, high;          /* ends, in the picture's value_unit, [1] */
    bool has_below, has_above; /* some values lie outside */
    bool is_shown;             /* some group has values, and they are not all zero */
} mor_model_range;

/** Spheres of one layer; owned by the model. */
typedef struct mor_model_layer {
    float *spheres;   /* shape [n_spheres,4], px, view space */
    float *color;     /* shape [n_spheres,3], 1, linear sRGB */
    float *rim;       /* shape [n_spheres], 1; darkening at the rim of a disc */
    mor_scene *scene; /* NULL when n_spheres is 0 */
    int64_t n_spheres;
} mor_model_layer;

/** The scene of one picture. */
typedef struct mor_model {
    mor_camera camera;
    mor_camera_extent extent; /* m; what is framed */
    double up[3];             /* shape [3], 1; against gravity, in the scene */
    mor_model_range range;
    mor_model_layer solid;
    mor_model_layer ghost;
    mor_shade_ground ground;
    double grid;            /* m; spacing of the ground's grid */
    double level_step;      /* px; between the levels of parts, view space; set by the build */
    double outline;         /* px; width of the line around parts in the plane; set between survey and build */
    double low[3], high[3]; /* shape [3], px; box around all spheres, view space */
    double least_radius;    /* px; of the smallest sphere */
} mor_model;

/** Radius a particle is drawn with, in m: its own times the picture's radius factor.
 *  @param group   [in]  of the picture
 *  @param i       [in]  0 <= i < n_particles */
double mor_model_radius(const mor_picture *picture, const mor_picture_group *group, int64_t i);

/** Checks a picture.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT as mor_picture_draw. */
mor_status mor_model_check(mor_context *context, const mor_picture *picture);

/** Orients the camera and finds range and extent; allocates only for a moment.
 *  @param picture [in]      checked
 *  @param model   [out]     everything but layers, ground and box is set, the camera is not yet fitted
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when the scene is tiny beside its distance from the origin; MOR_ERROR_MEMORY. */
mor_status mor_model_survey(mor_context *context, const mor_picture *picture, mor_model *model);

/** Makes the spheres, their colors, the ray-tracing scenes and the ground.
 *  @param picture [in]      checked
 *  @param model   [in,out]  surveyed, its camera fitted; clear it afterwards even on failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; what mor_scene_new returns. */
mor_status mor_model_build(mor_context *context, const mor_picture *picture, const mor_colormap *map, mor_model *model);

/** Color that stands for a group in picture and legend.
 *  @param screen [out]  shape [3]; screen values, 1 */
void mor_model_group_color(const mor_picture_group *group, double *screen);

/** Frees what the model owns. */
void mor_model_clear(mor_context *context, mor_model *model);

/** Finds the plane along the upper side of a flat group.
 *  @param group  [in]   of at least one particle
 *  @param up     [in]   shape [3], 1, unit vector
 *  @param normal [out]  shape [3], 1, unit vector with normal . up >= 0; up itself when the particles lie on a line
 *  Returns: the largest value of normal . x + radius, in m. */
double mor_model_plane(const mor_picture_group *group, const double *up, double *normal);

#endif
