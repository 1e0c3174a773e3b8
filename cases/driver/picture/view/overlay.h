/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_OVERLAY_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_OVERLAY_H

#include "cases/driver/picture/view/model.h"

/** @file
 *  Annotation around the particles: heading, color bar, scale bar, coordinate triad, legend. All sizes follow one
 *  length, `unit`, which is 1 px in a picture of 1600 x 1000 pixels. It does not draw particles. */

/** Draws title and time text along the upper edge.
 *  @param title  [in]      zero-terminated UTF-8, or NULL
 *  @param time   [in]      zero-terminated UTF-8, or NULL
 *  @param width  [in]      width of the picture, px
 *  @param unit   [in]      px */
void mor_overlay_heading(mor_canvas *canvas, const char *title, const char *time, double width, double unit);

/** Draws the color bar with round ticks, its label turned along it, and arrows where values lie outside the range.
 *  @param picture   [in]      gives name and unit of the values
 *  @param rectangle [in]      shape [4]; left, top, width, height of the bar, unit px */
void mor_overlay_color_bar(mor_canvas *canvas, const mor_colormap *map, const mor_picture *picture,
                           const mor_model_range *range, const double *rectangle);

/** Draws a scale bar of round length, exact for lengths parallel to the picture plane, and names the grid's spacing.
 *  @param camera [in]      fitted
 *  @param place  [in]      shape [2], unit px; left end of the bar
 *  @param grid   [in]      spacing of the ground's grid, m; 0: no grid
 *  @param unit   [in]      px */
void mor_overlay_scale_bar(mor_canvas *canvas, const mor_camera *camera, const double *place, double grid, double unit);

/** Draws the directions of x, y and z.
 *  @param camera [in]      oriented
 *  @param place  [in]      shape [2], unit px; foot of the arrows
 *  @param unit   [in]      px */
void mor_overlay_triad(mor_canvas *canvas, const mor_camera *camera, const double *place, double unit);

/** Draws the direction of gravity.
 *  @param camera [in]      oriented
 *  @param up     [in]      shape [3], 1, unit vector against gravity, in the scene
 *  @param place  [in]      shape [2], unit px; middle of the arrow
 *  @param unit   [in]      px */
void mor_overlay_gravity(mor_canvas *canvas, const mor_camera *camera, const double *up, const double *place,
                         double unit);

/** Draws a row of the groups that have a name, ending at the right: colored ones as a strip of the color map, when
 *  others have one color.
 *  @param place   [in]      shape [2], unit px; right end of the row
 *  @param limit   [in]      longest row, px; groups that do not fit are left out
 *  @param unit    [in]      px */
void mor_overlay_legend(mor_canvas *canvas, const mor_colormap *map, const mor_picture *picture, const double *place,
                        double limit, double unit);

#endif
