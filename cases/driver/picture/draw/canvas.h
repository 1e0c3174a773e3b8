/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_CANVAS_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_CANVAS_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  The only interface to Cairo: an image for lines, areas and text, saved as PNG. Positions are in pixels, y downwards,
 *  (0, 0) at the top left corner of the top left pixel. Font hinting is off, so that the same text gives the same
 *  pixels whatever the desktop's settings. Drawing calls never fail by themselves: Cairo keeps the first error and
 *  mor_canvas_check reports it. Particles, axes and units are handled elsewhere. */

typedef struct mor_canvas mor_canvas;

enum { MOR_CANVAS_WIDTH = 1600, MOR_CANVAS_HEIGHT = 1000, MOR_CANVAS_SIZE_MIN = 160, MOR_CANVAS_SIZE_MAX = 16384 };

/** Which point of a text is put at the given place. */
typedef enum mor_canvas_anchor { MOR_CANVAS_LEFT, MOR_CANVAS_CENTER, MOR_CANVAS_RIGHT } mor_canvas_anchor;

/** How text is set. */
typedef struct mor_canvas_font {
    double size;              /* unit px */
    bool is_bold;             /* bold face */
    bool is_upward;           /* rotated by 90 degrees to read from bottom to top */
    mor_canvas_anchor anchor; /* along the reading direction; across it, capitals are centered on the place */
    double limit;             /* longest text, unit px; longer is set smaller, then cut with "…"; 0: no limit */
    double color[3];          /* shape [3]; screen values, 1 */
} mor_canvas_font;

/** How lines and areas are drawn. */
typedef struct mor_canvas_pen {
    double width;    /* unit px; 0: the area is filled instead */
    double color[3]; /* shape [3]; screen values, 1 */
    double opacity;  /* 1; in [0, 1] */
    double dash;     /* length of dashes and gaps, unit px; 0: solid */
} mor_canvas_pen;

/** Checks the requested size of a picture.
 *  @param width   [in]      pixels; 0: default
 *  @param height  [in]      pixels; 0: default
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT outside MOR_CANVAS_SIZE_MIN to MOR_CANVAS_SIZE_MAX. */
mor_status mor_canvas_check_size(mor_context *context, int width, int height);

/** Completes a checked size: a default side follows from the usual proportions.
 *  @param width     [in]   pixels; 0: default
 *  @param height    [in]   pixels; 0: default
 *  @param n_columns [out]  one number; pixels
 *  @param n_rows    [out]  one number; pixels */
void mor_canvas_complete_size(int width, int height, int *n_columns, int *n_rows);

/** Makes a white image.
 *  @param canvas  [out]     the address of one pointer; NULL on failure
 *  @param width   [in]      pixels, 1 to MOR_CANVAS_SIZE_MAX
 *  @param height  [in]      pixels, 1 to MOR_CANVAS_SIZE_MAX
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a bad size; MOR_ERROR_MEMORY.
 *  Cost: allocates four bytes per pixel. */
mor_status mor_canvas_new(mor_context *context, mor_canvas **canvas, int width, int height);

/** Frees the image and sets the pointer to NULL. NULL is accepted.
 *  @param canvas  [in,out]  the address of one pointer */
void mor_canvas_free(mor_context *context, mor_canvas **canvas);

/** Copies finished pixels into the image; what lies outside is clipped.
 *  @param left   [in]      first column
 *  @param top    [in]      first row
 *  @param size   [in]      shape [2]; columns and rows of the block
 *  @param rgb    [in]      shape [rows, columns, 3]; screen values */
void mor_canvas_paste(mor_canvas *canvas, int left, int top, const int *size, const uint8_t *rgb);

/** Draws a chain of straight lines, or fills the area it encloses when the pen has width 0.
 *  @param points   [in]      shape [n_points,2], unit px
 *  @param n_points [in]      >= 2 */
void mor_canvas_line(mor_canvas *canvas, const double *points, int64_t n_points, const mor_canvas_pen *pen);

/** Draws the outline of a rectangle, or fills it when the pen has width 0.
 *  @param rectangle [in]      shape [4]; left, top, width, height, unit px */
void mor_canvas_rectangle(mor_canvas *canvas, const double *rectangle, const mor_canvas_pen *pen);

/** Draws a circle, or fills it when the pen has width 0.
 *  @param center [in]      shape [2], unit px
 *  @param radius [in]      unit px, > 0 */
void mor_canvas_circle(mor_canvas *canvas, const double *center, double radius, const mor_canvas_pen *pen);

/** Sets a line of text.
 *  @param place  [in]      shape [2], unit px; where the anchor goes
 *  @param text   [in]      zero-terminated UTF-8; NULL or empty draws nothing */
void mor_canvas_text(mor_canvas *canvas, const double *place, const char *text, const mor_canvas_font *font);

/** Measures a line of text without its limit.
 *  @param text   [in]  zero-terminated UTF-8
 *  Returns: the width in px. */
double mor_canvas_text_width(mor_canvas *canvas, const char *text, const mor_canvas_font *font);

/** Reads one pixel.
 *  @param column [in]   0 <= column < width
 *  @param row    [in]   0 <= row < height
 *  @param rgb    [out]  shape [3]; screen values, 0 to 255 */
void mor_canvas_pixel(const mor_canvas *canvas, int column, int row, uint8_t *rgb);

/** Reports the first error of Cairo since the canvas was made.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for text that is not UTF-8; MOR_ERROR_MEMORY; MOR_ERROR_INTERNAL. */
mor_status mor_canvas_check(mor_context *context, const mor_canvas *canvas);

/** Writes the image as PNG; no time stamp or other varying data goes into the file.
 *  @param path    [in]      zero-terminated; an existing file is replaced
 *  Returns: MOR_OK; MOR_ERROR_IO with the path and the system's reason; what mor_canvas_check returns. */
mor_status mor_canvas_write(mor_context *context, const mor_canvas *canvas, const char *path);

#endif
