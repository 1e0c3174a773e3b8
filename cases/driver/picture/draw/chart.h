/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_CHART_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_CHART_H

#include "cases/driver/picture/draw/canvas.h"

/** @file
 *  A chart of curves and points over one variable: time histories, profiles, measured against computed. Axes start and
 *  end at round numbers, units get SI prefixes, the legend is placed above the plot. */

enum { MOR_CHART_SERIES_MAX = 32, MOR_CHART_NOTES_MAX = 8 };

/** How a series is drawn. */
typedef enum mor_chart_style {
    MOR_CHART_LINE,
    MOR_CHART_DASHED,
    MOR_CHART_POINTS,
    MOR_CHART_PALE /* a thin line that others may lie over */
} mor_chart_style;

/** One curve. The arrays are borrowed for the call. */
typedef struct mor_chart_series {
    const char *name; /* for the legend; NULL: not in the legend */
    const double *x;  /* shape [n_points], unit x_unit */
    const double *y;  /* shape [n_points], unit y_unit */
    int64_t n_points; /* >= 1 */
    mor_chart_style style;
    int color_of;             /* 0: a color of its own; else that of series color_of - 1, which comes before it */
    const double *low, *high; /* shape [n_points], unit y_unit: ends of a bar at each point; NULL: no bars */
} mor_chart_series;

/** One chart. A record filled with zeros but for the series is valid. */
typedef struct mor_chart {
    const char *title;              /* one line; NULL: none */
    const char *x_name;             /* such as "time"; NULL: the unit alone */
    const char *x_unit;             /* SI, such as "s"; NULL: "1" */
    const char *y_name;             /* such as "energy"; NULL: the unit alone */
    const char *y_unit;             /* SI, such as "J"; NULL: "1" */
    const mor_chart_series *series; /* shape [n_series] */
    int n_series;                   /* 1 to MOR_CHART_SERIES_MAX */
    bool has_log_x;                 /* x on a logarithmic axis: all x are > 0 */
    bool has_margin;                /* between frame and curves, so that none lies on the frame or is cut by it */
    const char *const *notes;       /* shape [n_notes]; each a line under the legend, cut off where it is too long */
    int n_notes;                    /* 0 to MOR_CHART_NOTES_MAX */
    int width;                      /* pixels; 0: from the height, or MOR_CANVAS_WIDTH */
    int height;                     /* pixels; 0: from the width, or MOR_CANVAS_HEIGHT */
} mor_chart;

/** Draws the chart.
 *  @param canvas  [out]     the address of one pointer; NULL on failure; the caller frees it with mor_canvas_free
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when there is nothing to draw or a number is not finite, or not > 0 on a
 *  logarithmic axis, with series, point and value found; MOR_ERROR_MEMORY; what mor_canvas_new returns.
 *  Cost: O(points). */
mor_status mor_chart_draw(mor_context *context, const mor_chart *chart, mor_canvas **canvas);

#endif
