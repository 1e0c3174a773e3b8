/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_CAMERA_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_CAMERA_H

/** @file
 *  An orthographic camera: every length parallel to the picture plane has the same number of pixels per meter, so that
 *  a scale bar is exact everywhere. View space is the scene rotated, centered and in pixels: x to the right, y up, z
 *  towards the viewer. It is independent of the scene. */

/** A rectangle of the picture, y downwards from the top edge. */
typedef struct mor_camera_rectangle {
    double x, y;          /* left and top edge, unit px */
    double width, height; /* unit px */
} mor_camera_rectangle;

/** One camera. The three axes are orthonormal after mor_camera_orient; the rest is set by mor_camera_fit. */
typedef struct mor_camera {
    double right[3];  /* shape [3], 1; scene direction of view x */
    double up[3];     /* shape [3], 1; scene direction of view y */
    double toward[3]; /* shape [3], 1; scene direction of view z, from the scene to the viewer */
    double center[3]; /* shape [3], m; scene point at the view origin */
    double pixel[2];  /* shape [2], px; picture point of the view origin */
    double scale;     /* px/m */
} mor_camera;

/** How wide the scene is along the camera's axes. */
typedef struct mor_camera_extent {
    double minimum[3]; /* shape [3], m; along right, up, toward */
    double maximum[3]; /* shape [3], m */
} mor_camera_extent;

/** Orients the camera.
 *  @param camera [out]  the axes are written
 *  @param view   [in]   shape [3], 1, any length; from the scene to the viewer; zero: azimuth -60 degrees from the
 *                       first axis of mor_camera_horizon and 25 degrees above the horizon
 *  @param up     [in]   shape [3], 1, any length > 0; what is up in the picture; another axis is taken when parallel to
 *                       view */
void mor_camera_orient(mor_camera *camera, const double *view, const double *up);

/** Finds two horizontal directions that form a right-handed triad with up; the first is as near to x as can be.
 *  @param up     [in]   shape [3], 1, unit vector
 *  @param first  [out]  shape [3], 1
 *  @param second [out]  shape [3], 1 */
void mor_camera_horizon(const double *up, double *first, double *second);

/** Makes an extent that holds nothing. */
void mor_camera_extent_init(mor_camera_extent *extent);

/** Grows an extent until it holds a sphere.
 *  @param camera [in]      oriented
 *  @param point  [in]      shape [3], m; center of the sphere
 *  @param radius [in]      unit m, >= 0 */
void mor_camera_extent_add(const mor_camera *camera, mor_camera_extent *extent, const double *point, double radius);

/** Sets center, pixel and scale so that the extent fills the rectangle as far as its proportions allow.
 *  @param camera    [in,out]  oriented
 *  @param extent    [in]      not empty, of positive size along right or up
 *  @param rectangle [in]      of positive size */
void mor_camera_fit(mor_camera *camera, const mor_camera_extent *extent, const mor_camera_rectangle *rectangle);

/** Transforms a scene point to view space.
 *  @param camera [in]   fitted
 *  @param point  [in]   shape [3], m
 *  @param view   [out]  shape [3], px; not aliased with point */
void mor_camera_to_view(const mor_camera *camera, const double *point, double *view);

/** Transforms a scene direction to view space; length is kept.
 *  @param camera    [in]   oriented
 *  @param direction [in]   shape [3], any unit
 *  @param view      [out]  shape [3], same unit; not aliased with direction */
void mor_camera_rotate(const mor_camera *camera, const double *direction, double *view);

/** Chooses the longest scale bar of 1, 2 or 5 times a power of ten that fits.
 *  @param camera   [in]   fitted
 *  @param limit    [in]   longest allowed bar, unit px, > 0
 *  @param n_pixels [out]  one number, px; n_pixels = length * camera->scale exactly
 *  Returns: the length in m. */
double mor_camera_scale_bar(const mor_camera *camera, double limit, double *n_pixels);

#endif
