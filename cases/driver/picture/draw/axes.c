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

static void draw_side(mor_canvas *canvas, const mor_axes *axes, int side)
{
    const double *r = axes->rectangle;
    const double per_number = side == 0 ? 5.5 * axes->text : 2.6 * axes->text;
    const int limit = (int)fmin(fmax(r[2 + side] / per_number, 2.0), 11.0);
    const mor_ticks ticks = mor_ticks_choose(axes->low[side], axes->high[side], limit);
    mor_canvas_font font = {.size = axes->text,
                            .anchor = side == 0 ? MOR_CANVAS_CENTER : MOR_CANVAS_RIGHT,
                            .limit = side == 0 ? 5.2 * axes->text : 4.0 * axes->text,
                            .color = {text_gray, text_gray, text_gray}};
    double widest = 1.5 * axes->text;
    for (int k = 0; k < ticks.n_ticks; ++k) {
        double value[2] = {axes->low[0], axes->low[1]};
        value[side] = mor_ticks_value(&ticks, k);
        double place[2];
        mor_axes_place(axes, value, place);
        draw_tick(canvas, axes, side, place);
        char text[MOR_TICKS_TEXT_BYTES];
        mor_ticks_format(value[side], ticks.step, text);
        const double number[2] = {side == 0 ? place[0] : r[0] - 0.65 * axes->text,
                                  side == 0 ? r[1] + r[3] + 1.25 * axes->text : place[1]};
        mor_canvas_text(canvas, number, text, &font);
        widest = fmax(widest, fmin(mor_canvas_text_width(canvas, text, &font), font.limit));
    }
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
