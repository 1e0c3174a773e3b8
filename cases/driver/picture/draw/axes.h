/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_AXES_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_AXES_H

#include "cases/driver/picture/draw/canvas.h"

/** @file
 *  A framed plot area with ticks, numbers and labels on the left and lower side. It does not draw what is plotted. */

/** One pair of axes. */
typedef struct mor_axes {
    double rectangle[4];  /* shape [4]; left, top, width, height of the plot area, unit px */
    double low[2];        /* shape [2]; x and y at the lower left corner, in the units shown, [1] */
    double high[2];       /* shape [2]; x and y at the upper right corner, > low, same units, [1] */
    const char *label[2]; /* with units, zero-terminated UTF-8 */
    double text;          /* size of the numbers, unit px */
    bool has_grid;        /* thin lines across the plot area at the ticks */
    bool has_log_x;       /* x and its ends are decimal logarithms of the values that the ticks name */
} mor_axes;

/** Draws frame, ticks, numbers and labels; of the grid only the lines, so that curves can be drawn over them. */
void mor_axes_draw(mor_canvas *canvas, const mor_axes *axes);

/** Transforms a pair of values to a position on the canvas.
 *  @param value [in]   shape [2]; x and y, in the units shown, [1]
 *  @param place [out]  shape [2], unit px */
void mor_axes_place(const mor_axes *axes, const double *value, double *place);

/** Room to the left of the plot area that numbers and label need, in px, for a text size in px. */
double mor_axes_left_room(double text);

/** Room under the plot area that numbers and label need, in px, for a text size in px. */
double mor_axes_lower_room(double text);

#endif
