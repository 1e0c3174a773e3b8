/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/axes.h"

#include "cases/driver/picture/draw/ticks.h"

#include <math.h>

static const double text_gray = 0.15;
static const double frame_gray = 0.35;
static const double grid_gray = 0.88;

double mor_axes_left_room(double text)
{
    return 6.4 * text;
}

double mor_axes_lower_room(double text)
{
    return 3.9 * text;
}

void mor_axes_place(const mor_axes *axes, const double *value, double *place)
{
    const double across = (value[0] - axes->low[0]) / (axes->high[0] - axes->low[0]);
    const double upward = (value[1] - axes->low[1]) / (axes->high[1] - axes->low[1]);
    place[0] = axes->rectangle[0] + across * axes->rectangle[2];
    place[1] = axes->rectangle[1] + (1.0 - upward) * axes->rectangle[3];
}

static mor_canvas_pen make_pen(double width, double gray)
{
    return (mor_canvas_pen){.width = width, .color = {gray, gray, gray}, .opacity = 1.0};
}

static void draw_tick(mor_canvas *canvas, const mor_axes *axes, int side, const double *place)
{
    const double *r = axes->rectangle;
    const double length = 0.35 * axes->text;
    const double inner[2] = {side == 0 ? place[0] : r[0], side == 0 ? r[1] + r[3] : place[1]};
    const double tick[4] = {inner[0], inner[1], inner[0] - (side == 1 ? length : 0.0),
                            inner[1] + (side == 0 ? length : 0.0)};
    const double line[4] = {inner[0], inner[1], side == 0 ? inner[0] : r[0] + r[2], side == 0 ? r[1] : inner[1]};
    if (axes->has_grid) {
        const mor_canvas_pen thin = make_pen(0.06 * axes->text, grid_gray);
        mor_canvas_line(canvas, line, 2, &thin);
    }
    const mor_canvas_pen pen = make_pen(0.075 * axes->text, frame_gray);
    mor_canvas_line(canvas, tick, 2, &pen);
}

/* Writes a number at its tick; returns its width in px. */
static double draw_number(mor_canvas *canvas, const mor_axes *axes, int side, double value, const char *text,
                          const mor_canvas_font *font)
{
    const double *r = axes->rectangle;
    double at[2] = {axes->low[0], axes->low[1]};
    double place[2];
    at[side] = value;
    mor_axes_place(axes, at, place);
    draw_tick(canvas, axes, side, place);
    const double number[2] = {side == 0 ? place[0] : r[0] - 0.65 * axes->text,
                              side == 0 ? r[1] + r[3] + 1.25 * axes->text : place[1]};
    mor_canvas_text(canvas, number, text, font);
    return fmin(mor_canvas_text_width(canvas, text, font), font->limit);
}

/* Numbers 1 to 9 of each decade, 1, 2 and 5 or 1 alone, as there is room. */
static void draw_log_numbers(mor_canvas *canvas, const mor_axes *axes, int limit, const mor_canvas_font *font)
{
    static const int steps[10] = {0, 1, 3, 0, 0, 5, 0, 0, 0, 0}; /* from 1, 2 and 5 to the next one */
    const double width = axes->high[0] - axes->low[0];
    const bool has_all = 20.0 * width <= limit; /* 9 and 10 are a twentieth of a decade apart */
    const bool has_three = 3.0 * width <= limit;
    const int decades = width > limit ? (int)ceil(width / limit) : 1;
    for (int decade = (int)floor(axes->low[0]); decade <= (int)ceil(axes->high[0]); ++decade) {
        const int last = decade % decades == 0 ? 9 : 0;
        for (int k = 1; k <= last; k += has_all ? 1 : has_three ? steps[k] : 10) {
            const double value = k * pow(10.0, decade);
            if (log10(value) >= axes->low[0] && log10(value) <= axes->high[0]) {
                char text[MOR_TICKS_TEXT_BYTES];
                mor_ticks_format(value, pow(10.0, decade), text);
                draw_number(canvas, axes, 0, log10(value), text, font);
            }
        }
    }
}

/* Ticks and numbers at round values; returns the width of the widest number, in px. */
static double draw_numbers(mor_canvas *canvas, const mor_axes *axes, int side, int limit, const mor_canvas_font *font)
{
    double widest = 1.5 * axes->text;
    if (side == 0 && axes->has_log_x) {
        draw_log_numbers(canvas, axes, limit, font);
        return widest;
    }
    const mor_ticks ticks = mor_ticks_choose(axes->low[side], axes->high[side], limit);
    for (int k = 0; k < ticks.n_ticks; ++k) {
        const double value = mor_ticks_value(&ticks, k);
        char text[MOR_TICKS_TEXT_BYTES];
        mor_ticks_format(value, ticks.step, text);
        widest = fmax(widest, draw_number(canvas, axes, side, value, text, font));
    }
    return widest;
}

static void draw_side(mor_canvas *canvas, const mor_axes *axes, int side)
{
    const double *r = axes->rectangle;
    const double per_number = side == 0 ? 5.5 * axes->text : 2.6 * axes->text;
    const int limit = (int)fmin(fmax(r[2 + side] / per_number, 2.0), 11.0);
    mor_canvas_font font = {.size = axes->text,
                            .anchor = side == 0 ? MOR_CANVAS_CENTER : MOR_CANVAS_RIGHT,
                            .limit = side == 0 ? 5.2 * axes->text : 4.0 * axes->text,
                            .color = {text_gray, text_gray, text_gray}};
    const double widest = draw_numbers(canvas, axes, side, limit, &font);
    font.size = 1.1 * axes->text;
    font.anchor = MOR_CANVAS_CENTER;
    font.is_upward = side == 1;
    font.limit = fmax(r[2 + side], 12.0 * axes->text);
    const double label[2] = {side == 0 ? r[0] + 0.5 * r[2] : r[0] - widest - 1.6 * axes->text,
                             side == 0 ? r[1] + r[3] + 2.95 * axes->text : r[1] + 0.5 * r[3]};
    mor_canvas_text(canvas, label, axes->label[side], &font);
}

void mor_axes_draw(mor_canvas *canvas, const mor_axes *axes)
{
    draw_side(canvas, axes, 0);
    draw_side(canvas, axes, 1);
    const mor_canvas_pen pen = make_pen(0.075 * axes->text, frame_gray);
    mor_canvas_rectangle(canvas, axes->rectangle, &pen);
}
