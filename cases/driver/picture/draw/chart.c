/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/chart.h"

#include "cases/driver/picture/draw/axes.h"
#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/draw/ticks.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

enum { AXIS_TICKS = 8, POINTS_PER_STROKE = 4096 };

static const double text_gray = 0.13;
static const double note_gray = 0.35;
static const double margin = 0.03;        /* part of the range */
static const double smallest_move = 0.35; /* px; nearer points of a curve are merged */

/* One chart while it is drawn. */
typedef struct sheet {
    const mor_chart *chart;
    mor_canvas *canvas;
    int width, height; /* pixels */
    double unit;       /* px; 1 at 1600 x 1000 */
    double factor[2];  /* shown unit per SI unit, x and y */
    char label[2][MOR_TICKS_LABEL_BYTES];
    mor_axes axes;
} sheet;

static mor_status check_series(mor_context *context, const mor_chart_series *series, int index, bool has_log_x)
{
    const char *name = series->name != NULL ? series->name : "without name";
    MOR_CHECK(context, series->color_of >= 0 && series->color_of <= index, MOR_ERROR_ARGUMENT,
              "series %d (%s) has the color of series %d; allowed are those before it", index, name,
              series->color_of - 1);
    MOR_CHECK(context, (series->low == NULL) == (series->high == NULL), MOR_ERROR_ARGUMENT,
              "series %d (%s) has one end of its bars; it needs both, or none", index, name);
    MOR_CHECK(context, series->n_points >= 1 && series->x != NULL && series->y != NULL, MOR_ERROR_ARGUMENT,
              "series %d (%s) has %lld points; a series needs arrays of at least one point", index, name,
              (long long)series->n_points);
    for (int64_t k = 0; k < series->n_points; ++k) {
        MOR_CHECK(context, fabs(series->x[k]) < MOR_TICKS_LARGEST && fabs(series->y[k]) < MOR_TICKS_LARGEST,
                  MOR_ERROR_ARGUMENT,
                  "series %d (%s): point %lld is (%g, %g); only finite numbers below %g can be drawn", index, name,
                  (long long)k, series->x[k], series->y[k], MOR_TICKS_LARGEST);
        MOR_CHECK(context,
                  series->low == NULL ||
                      (fabs(series->low[k]) < MOR_TICKS_LARGEST && fabs(series->high[k]) < MOR_TICKS_LARGEST),
                  MOR_ERROR_ARGUMENT,
                  "series %d (%s): the bar of point %lld is from %g to %g; only finite numbers below "
                  "%g can be drawn",
                  index, name, (long long)k, series->low[k], series->high[k], MOR_TICKS_LARGEST);
        MOR_CHECK(context, !has_log_x || series->x[k] > 0.0, MOR_ERROR_ARGUMENT,
                  "series %d (%s): point %lld is (%g, %g); on a logarithmic axis x must be > 0", index, name,
                  (long long)k, series->x[k], series->y[k]);
    }
    return MOR_OK;
}

static mor_status check_chart(mor_context *context, const mor_chart *chart)
{
    MOR_CHECK(context, chart->n_series >= 1 && chart->n_series <= MOR_CHART_SERIES_MAX && chart->series != NULL,
              MOR_ERROR_ARGUMENT, "the chart has %d series; it needs 1 to %d", chart->n_series, MOR_CHART_SERIES_MAX);
    MOR_CHECK(context, chart->n_notes >= 0 && chart->n_notes <= MOR_CHART_NOTES_MAX, MOR_ERROR_ARGUMENT,
              "the chart has %d notes; at most %d are allowed", chart->n_notes, MOR_CHART_NOTES_MAX);
    MOR_TRY(context, mor_canvas_check_size(context, chart->width, chart->height));
    for (int index = 0; index < chart->n_series; ++index) {
        MOR_TRY(context, check_series(context, chart->series + index, index, chart->has_log_x));
    }
    return MOR_OK;
}

/* A logarithmic axis ends with the data, and holds a factor of three at least, so that there are numbers on it. */
static void find_log_ends(double first, double last, sheet *s)
{
    const double room = fmax(0.5 * (log10(3.0) - (last - first)), 0.02 * (last - first));
    s->axes.has_log_x = true;
    s->axes.low[0] = first - room;
    s->axes.high[0] = last + room;
}

/* Range of x (side 0) or y (side 1) over all series; y gets round ends, x ends with the data; with a margin both end
 * beyond the data. */
static void find_side(sheet *s, int side)
{
    const mor_chart *chart = s->chart;
    double low = INFINITY;
    double high = -INFINITY;
    for (int index = 0; index < chart->n_series; ++index) {
        const mor_chart_series *series = chart->series + index;
        const double *values = side == 0 ? series->x : series->y;
        for (int64_t k = 0; k < series->n_points; ++k) {
            low = fmin(low, side == 1 && series->low != NULL ? fmin(series->low[k], values[k]) : values[k]);
            high = fmax(high, side == 1 && series->low != NULL ? fmax(series->high[k], values[k]) : values[k]);
        }
    }
    const char *unit = side == 0 ? chart->x_unit : chart->y_unit;
    char shown[MOR_TICKS_TEXT_BYTES];
    s->factor[side] = mor_ticks_prefix(unit != NULL ? unit : "1", fmax(fabs(low), fabs(high)), shown);
    low *= s->factor[side];
    high *= s->factor[side];
    mor_ticks_label(side == 0 ? chart->x_name : chart->y_name, shown, s->label[side]);
    s->axes.label[side] = s->label[side];
    if (side == 0 && chart->has_log_x) {
        find_log_ends(log10(low), log10(high), s);
        return;
    }
    const double first = low;
    const double last = high;
    mor_ticks_round_out(&low, &high, AXIS_TICKS);
    if (chart->has_margin) {
        const double range = last > first ? last - first : high - low;
        low = (last > first ? first : low) - margin * range;
        high = (last > first ? last : high) + margin * range;
    } else if (side == 0 && last > first) {
        low = fmax(low, first - 0.02 * (last - first));
        low = first >= 0.0 && low < 0.0 ? 0.0 : low;
        high = fmin(high, last + 0.02 * (last - first));
    }
    s->axes.low[side] = low;
    s->axes.high[side] = high;
}

static void place_value(const sheet *s, double x, double y, double *place)
{
    const double value[2] = {s->chart->has_log_x ? log10(s->factor[0] * x) : s->factor[0] * x, s->factor[1] * y};
    mor_axes_place(&s->axes, value, place);
}

static void place_point(const sheet *s, const mor_chart_series *series, int64_t k, double *place)
{
    place_value(s, series->x[k], series->y[k], place);
}

/* Colors are counted over the series that have one of their own. */
static int find_color(const sheet *s, int index)
{
    const mor_chart_series *series = s->chart->series;
    int color = 0;
    index = series[index].color_of > 0 ? series[index].color_of - 1 : index;
    for (int k = 0; k < index; ++k) {
        color += series[k].color_of == 0;
    }
    return color;
}

static mor_canvas_pen choose_pen(const sheet *s, int index, mor_chart_style style)
{
    double linear[3];
    mor_colormap_category(find_color(s, index), linear);
    mor_canvas_pen pen = {.opacity = style == MOR_CHART_PALE ? 0.4 : 1.0};
    for (int c = 0; c < 3; ++c) {
        pen.color[c] = mor_colormap_encode(linear[c]);
    }
    pen.width = style == MOR_CHART_POINTS ? 0.0 : (style == MOR_CHART_PALE ? 2.0 : 3.2) * s->unit;
    pen.dash = style == MOR_CHART_DASHED ? 11.0 * s->unit : 0.0;
    return pen;
}

/* A curve is drawn in long strokes; each starts where the last one ended. */
static mor_status draw_curve(mor_context *context, sheet *s, const mor_chart_series *series, const mor_canvas_pen *pen)
{
    double *path = NULL;
    MOR_TRY(context, MOR_NEW(context, &path, 2 * POINTS_PER_STROKE, "curve of a chart"));
    int64_t n = 0;
    for (int64_t k = 0; k < series->n_points; ++k) {
        double place[2];
        place_point(s, series, k, place);
        const bool is_last = k + 1 == series->n_points;
        if (n > 0 && !is_last && hypot(place[0] - path[2 * n - 2], place[1] - path[2 * n - 1]) < smallest_move) {
            continue;
        }
        path[2 * n] = place[0];
        path[2 * n + 1] = place[1];
        n += 1;
        if (n == POINTS_PER_STROKE) {
            mor_canvas_line(s->canvas, path, n, pen);
            memmove(path, path + 2 * n - 2, 2 * sizeof *path);
            n = 1;
        }
    }
    if (n > 1) {
        mor_canvas_line(s->canvas, path, n, pen);
    }
    MOR_FREE(context, &path);
    return MOR_OK;
}

/* From one end to the other, with a short line across each. */
static void draw_bars(sheet *s, int index)
{
    const mor_chart_series *series = s->chart->series + index;
    const mor_canvas_pen pen = choose_pen(s, index, MOR_CHART_LINE);
    for (int64_t k = 0; k < series->n_points && series->low != NULL; ++k) {
        double ends[2][2];
        place_value(s, series->x[k], series->low[k], ends[0]);
        place_value(s, series->x[k], series->high[k], ends[1]);
        mor_canvas_line(s->canvas, ends[0], 2, &pen);
        for (int end = 0; end < 2; ++end) {
            const double cap[4] = {ends[end][0] - 9.0 * s->unit, ends[end][1], ends[end][0] + 9.0 * s->unit,
                                   ends[end][1]};
            mor_canvas_line(s->canvas, cap, 2, &pen);
        }
    }
}

static mor_status draw_series(mor_context *context, sheet *s, int index)
{
    const mor_chart_series *series = s->chart->series + index;
    const bool is_single = series->n_points == 1;
    draw_bars(s, index);
    const mor_chart_style style = is_single ? MOR_CHART_POINTS : series->style;
    const mor_canvas_pen pen = choose_pen(s, index, style);
    if (style != MOR_CHART_POINTS) {
        return draw_curve(context, s, series, &pen);
    }
    for (int64_t k = 0; k < series->n_points; ++k) {
        double place[2];
        place_point(s, series, k, place);
        mor_canvas_circle(s->canvas, place, 6.0 * s->unit, &pen);
    }
    return MOR_OK;
}

static void draw_sample(sheet *s, int index, const double *place, double length)
{
    const mor_chart_series *series = s->chart->series + index;
    const mor_chart_style style = series->n_points == 1 ? MOR_CHART_POINTS : series->style;
    const mor_canvas_pen pen = choose_pen(s, index, style);
    if (style == MOR_CHART_POINTS) {
        const double center[2] = {place[0] + 0.5 * length, place[1]};
        mor_canvas_circle(s->canvas, center, 6.0 * s->unit, &pen);
        return;
    }
    const double line[4] = {place[0], place[1], place[0] + length, place[1]};
    mor_canvas_line(s->canvas, line, 2, &pen);
}

/* Lays out the legend from left to right and on further rows; draws only on request. Returns the height used. */
static double walk_legend(sheet *s, double left, double top, bool is_drawn)
{
    const double unit = s->unit;
    const double limit = s->width - 44.0 * unit;
    const mor_canvas_font font = {.size = 21.0 * unit,
                                  .anchor = MOR_CANVAS_LEFT,
                                  .limit = 0.6 * (limit - left),
                                  .color = {text_gray, text_gray, text_gray}};
    const double sample = 46.0 * unit;
    const double row = 34.0 * unit;
    double place[2] = {left, top + 0.5 * row};
    bool is_empty = true;
    for (int index = 0; index < s->chart->n_series; ++index) {
        const char *name = s->chart->series[index].name;
        if (name == NULL || name[0] == '\0') {
            continue;
        }
        const double text = fmin(mor_canvas_text_width(s->canvas, name, &font), font.limit);
        const double width = sample + 10.0 * unit + text;
        if (!is_empty && place[0] + width > limit) {
            place[0] = left;
            place[1] += row;
        }
        if (is_drawn) {
            draw_sample(s, index, place, sample);
            const double start[2] = {place[0] + sample + 10.0 * unit, place[1]};
            mor_canvas_text(s->canvas, start, name, &font);
        }
        place[0] += width + 36.0 * unit;
        is_empty = false;
    }
    return is_empty ? 0.0 : place[1] + 0.5 * row - top;
}

/* Lines of text under the legend; draws only on request. Returns the height used. */
static double walk_notes(sheet *s, double left, double top, bool is_drawn)
{
    const double unit = s->unit;
    const double row = 28.0 * unit;
    const mor_canvas_font font = {.size = 18.0 * unit,
                                  .anchor = MOR_CANVAS_LEFT,
                                  .limit = s->width - 44.0 * unit - left,
                                  .color = {note_gray, note_gray, note_gray}};
    for (int k = 0; k < s->chart->n_notes && is_drawn; ++k) {
        const double place[2] = {left, top + (0.5 + k) * row};
        mor_canvas_text(s->canvas, place, s->chart->notes[k], &font);
    }
    return s->chart->n_notes * row;
}

static mor_status draw_sheet(mor_context *context, sheet *s)
{
    const double unit = s->unit;
    find_side(s, 0);
    find_side(s, 1);
    MOR_TRY(context, mor_canvas_new(context, &s->canvas, s->width, s->height));
    const double text = 22.0 * unit;
    const double left = mor_axes_left_room(text) + 12.0 * unit;
    const bool has_title = s->chart->title != NULL && s->chart->title[0] != '\0';
    const double legend_top = (has_title ? 76.0 : 24.0) * unit;
    const double notes_top = legend_top + walk_legend(s, left, legend_top, false);
    const double top = notes_top + walk_notes(s, left, notes_top, false) + 20.0 * unit;
    s->axes.rectangle[0] = left;
    s->axes.rectangle[1] = top;
    s->axes.rectangle[2] = s->width - left - 44.0 * unit;
    s->axes.rectangle[3] = s->height - top - mor_axes_lower_room(text) - 12.0 * unit;
    s->axes.text = text;
    s->axes.has_grid = true;
    MOR_CHECK(context, s->axes.rectangle[2] > 2.0 * text && s->axes.rectangle[3] > 2.0 * text, MOR_ERROR_ARGUMENT,
              "a chart of %d x %d pixels has no room beside the legend of %d series; use a larger size or fewer names",
              s->width, s->height, s->chart->n_series);
    const mor_canvas_font heavy = {.size = 28.0 * unit,
                                   .is_bold = true,
                                   .limit = s->width - left - 44.0 * unit,
                                   .color = {text_gray, text_gray, text_gray}};
    const double title[2] = {left, 46.0 * unit};
    mor_canvas_text(s->canvas, title, s->chart->title, &heavy);
    walk_legend(s, left, legend_top, true);
    walk_notes(s, left, notes_top, true);
    mor_axes_draw(s->canvas, &s->axes);
    for (int index = 0; index < s->chart->n_series; ++index) {
        MOR_TRY(context, draw_series(context, s, index));
    }
    MOR_TRY(context, mor_canvas_check(context, s->canvas));
    return MOR_OK;
}

mor_status mor_chart_draw(mor_context *context, const mor_chart *chart, mor_canvas **canvas)
{
    *canvas = NULL;
    MOR_TRY(context, check_chart(context, chart));
    sheet s = {.chart = chart};
    mor_canvas_complete_size(chart->width, chart->height, &s.width, &s.height);
    s.unit = fmin(s.width / (double)MOR_CANVAS_WIDTH, s.height / (double)MOR_CANVAS_HEIGHT);
    const mor_status status = draw_sheet(context, &s);
    if (status != MOR_OK) {
        mor_canvas_free(context, &s.canvas);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *canvas = s.canvas;
    return MOR_OK;
}
