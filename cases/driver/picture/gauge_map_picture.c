/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/gauge_map_picture.h"

#include "cases/driver/picture/draw/axes.h"
#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/draw/ticks.h"
#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/table.h"

#include <math.h>
#include <string.h>

/* Columns of the table, and the layout of the picture in px. */
enum {
    ACROSS = 0,
    UP = 1,
    PEAK = 5,
    LAST = 7,
    BODIES = 8,
    WIDTH = 1600,
    HEIGHT = 1000,
    TEXT = 26,
    TOP = 110,
    BAR = 36,
    BAR_ROOM = 260,
    LABEL_BYTES = 96
};

/* The map while it is drawn. */
typedef struct sheet {
    const mor_table_data *data;
    double cell[2]; /* across and up, m */
    double low[2];  /* edges, m */
    double high[2];
    double largest; /* peak pressure of all cells, Pa */
    mor_colormap colors;
} sheet;

static double at(const sheet *s, int64_t row, int column)
{
    return s->data->values[row * s->data->n_columns + column];
}

static void measure(sheet *s)
{
    for (int a = 0; a < 2; ++a) {
        s->low[a] = INFINITY;
        s->high[a] = -INFINITY;
    }
    s->largest = 0.0;
    for (int64_t row = 1; row < s->data->n_rows; ++row) {
        for (int a = 0; a < 2; ++a) { /* of a single cell along an axis: the side asked for */
            const double step = at(s, row, a) - at(s, row - 1, a);
            s->cell[a] = step > 0.0 ? step : s->cell[a];
        }
    }
    for (int64_t row = 0; row < s->data->n_rows; ++row) {
        for (int a = 0; a < 2; ++a) {
            s->low[a] = fmin(s->low[a], at(s, row, a) - 0.5 * s->cell[a]);
            s->high[a] = fmax(s->high[a], at(s, row, a) + 0.5 * s->cell[a]);
        }
        s->largest = fmax(s->largest, at(s, row, PEAK));
    }
}

static void find_color(const sheet *s, double value, double *color)
{
    double linear[3];
    mor_colormap_at(&s->colors, fmin(fmax(value / s->largest, 0.0), 1.0), linear);
    for (int a = 0; a < 3; ++a) {
        color[a] = mor_colormap_encode(linear[a]);
    }
}

/* A filled rectangle, a little larger than its place so that no seams show. */
static void fill(mor_canvas *canvas, const sheet *s, double value, double left, double top, double width, double height)
{
    mor_canvas_pen pen = {.width = 0.0, .opacity = 1.0};
    const double rectangle[4] = {floor(left), floor(top), ceil(left + width) - floor(left),
                                 ceil(top + height) - floor(top)};
    find_color(s, value, pen.color);
    mor_canvas_rectangle(canvas, rectangle, &pen);
}

static void draw_cells(mor_canvas *canvas, const sheet *s, const mor_axes *axes)
{
    for (int64_t row = 0; row < s->data->n_rows; ++row) {
        const double corner[2] = {at(s, row, ACROSS) - 0.5 * s->cell[0], at(s, row, UP) + 0.5 * s->cell[1]};
        const double other[2] = {corner[0] + s->cell[0], corner[1] - s->cell[1]};
        double from[2];
        double to[2];
        mor_axes_place(axes, corner, from);
        mor_axes_place(axes, other, to);
        if (isfinite(at(s, row, PEAK))) { /* the structure is there */
            fill(canvas, s, at(s, row, PEAK), from[0], from[1], to[0] - from[0], to[1] - from[1]);
        }
    }
}

static void draw_bar(mor_canvas *canvas, const sheet *s, const mor_axes *axes)
{
    enum { STEPS = 128 };
    const double left = WIDTH - BAR_ROOM + 40.0;
    const double top = axes->rectangle[1];
    const double height = axes->rectangle[3];
    char unit[MOR_TICKS_TEXT_BYTES];
    const double factor = mor_ticks_prefix("Pa", s->largest, unit);
    const mor_ticks ticks = mor_ticks_choose(0.0, factor * s->largest, 6);
    for (int k = 0; k < STEPS; ++k) {
        fill(canvas, s, s->largest * (k + 0.5) / STEPS, left, top + height * (STEPS - 1 - k) / STEPS, BAR,
             height / STEPS);
    }
    for (int k = 0; k < ticks.n_ticks; ++k) {
        const double value = mor_ticks_value(&ticks, k);
        const double place[2] = {left + BAR + 12.0, top + height * (1.0 - value / (factor * s->largest))};
        char text[MOR_TICKS_TEXT_BYTES];
        mor_ticks_format(value, ticks.step, text);
        mor_canvas_text(canvas, place, text, &(mor_canvas_font){.size = TEXT, .anchor = MOR_CANVAS_LEFT});
    }
    const double place[2] = {left, top - 30.0};
    mor_canvas_text(canvas, place, unit, &(mor_canvas_font){.size = TEXT, .anchor = MOR_CANVAS_LEFT});
}

/* The plot area with the proportions of the map. */
static void set_axes(const sheet *s, mor_axes *axes)
{
    const double left = mor_axes_left_room(TEXT);
    const double wide = WIDTH - BAR_ROOM - left;
    const double high = HEIGHT - TOP - mor_axes_lower_room(TEXT);
    const double scale = fmin(wide / (s->high[0] - s->low[0]), high / (s->high[1] - s->low[1]));
    *axes = (mor_axes){.rectangle = {left, TOP, scale * (s->high[0] - s->low[0]), scale * (s->high[1] - s->low[1])},
                       .low = {s->low[0], s->low[1]},
                       .high = {s->high[0], s->high[1]},
                       .label = {"across [m]", "up [m]"},
                       .text = TEXT};
}

static mor_status draw(mor_context *context, const sheet *s, const char *title, const char *path)
{
    mor_canvas *canvas = NULL;
    mor_axes axes;
    set_axes(s, &axes);
    const double lower = axes.rectangle[1] + axes.rectangle[3] + mor_axes_lower_room(TEXT);
    MOR_TRY(context, mor_canvas_new(context, &canvas, WIDTH, (int)ceil(lower))); /* no higher than the map asks for */
    draw_cells(canvas, s, &axes);
    mor_axes_draw(canvas, &axes);
    draw_bar(canvas, s, &axes);
    mor_canvas_text(canvas, (const double[2]){axes.rectangle[0], 40.0}, title,
                    &(mor_canvas_font){.size = TEXT + 4, .is_bold = true, .anchor = MOR_CANVAS_LEFT, .limit = 1500.0});
    const mor_status status = mor_canvas_write(context, canvas, path);
    mor_canvas_free(context, &canvas);
    return status;
}

/* A single column of cells, as in plane strain, is a profile. */
static mor_status draw_profile(mor_context *context, const sheet *s, const char *title, const char *path)
{
    double *room = NULL;
    const int64_t n = s->data->n_rows;
    bool has_bodies = false;
    MOR_TRY(context, MOR_NEW(context, &room, 4 * n, "a profile of pressure"));
    for (int64_t row = 0; row < n; ++row) {
        room[row] = at(s, row, PEAK);
        room[n + row] = at(s, row, LAST);
        room[2 * n + row] = at(s, row, UP);
        room[3 * n + row] = at(s, row, BODIES);
        has_bodies = has_bodies || at(s, row, BODIES) > 0.0;
    }
    const mor_chart_series series[] = {
        {.name = "soil, peak", .x = room, .y = room + 2 * n, .n_points = n, .style = MOR_CHART_LINE},
        {.name = "soil, last", .x = room + n, .y = room + 2 * n, .n_points = n, .style = MOR_CHART_DASHED},
        {.name = "bodies, peak", .x = room + 3 * n, .y = room + 2 * n, .n_points = n, .style = MOR_CHART_LINE}};
    const mor_chart chart = {.title = title,
                             .x_name = "pressure",
                             .x_unit = "Pa",
                             .y_name = "height",
                             .y_unit = "m",
                             .series = series,
                             .n_series = has_bodies ? 3 : 2};
    const mor_status status = mor_picture_chart(context, &chart, path);
    MOR_FREE(context, &room);
    return status;
}

mor_status mor_gauge_map_picture_draw(mor_context *context, const mor_case_gauge *gauge, const char *table,
                                      const char *path, bool *is_drawn)
{
    mor_table_data data;
    char title[LABEL_BYTES + MOR_CASE_NAME_BYTES];
    MOR_TRY(context, mor_table_data_read(context, &data, table));
    sheet s = {.data = &data, .cell = {gauge->cell, gauge->cell}};
    measure(&s);
    mor_colormap_init(&s.colors);
    const bool is_profile = s.high[0] - s.low[0] < 1.5 * s.cell[0];
    snprintf(title, sizeof title, "gauge %s: %s", gauge->name,
             is_profile ? "pressure over height" : "peak pressure of the soil, seen along its direction");
    *is_drawn = s.largest > 0.0;
    const mor_status status = !*is_drawn   ? MOR_OK
                              : is_profile ? draw_profile(context, &s, title, path)
                                           : draw(context, &s, title, path);
    mor_table_data_clear(context, &data);
    return status;
}
