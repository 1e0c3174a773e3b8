/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/overlay.h"

#include "cases/driver/picture/draw/ticks.h"
#include "core/base/math.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLE_STRIPS = 24 };

static const double text_gray = 0.13;
static const double quiet_gray = 0.35;

static mor_canvas_font make_font(double size, mor_canvas_anchor anchor, double limit)
{
    return (mor_canvas_font){
        .size = size, .anchor = anchor, .limit = limit, .color = {text_gray, text_gray, text_gray}};
}

static mor_canvas_pen make_pen(double width, double gray)
{
    return (mor_canvas_pen){.width = width, .color = {gray, gray, gray}, .opacity = 1.0};
}

void mor_overlay_heading(mor_canvas *canvas, const char *title, const char *time, double width, double unit)
{
    const double margin = 44.0 * unit;
    mor_canvas_font quiet = make_font(25.0 * unit, MOR_CANVAS_RIGHT, 0.35 * width);
    const double time_width = time != NULL ? fmin(mor_canvas_text_width(canvas, time, &quiet), quiet.limit) : 0.0;
    const double right[2] = {width - margin, 46.0 * unit};
    mor_canvas_text(canvas, right, time, &quiet);
    mor_canvas_font heavy = make_font(28.0 * unit, MOR_CANVAS_LEFT, width - 3.0 * margin - time_width);
    heavy.is_bold = true;
    const double left[2] = {margin, 46.0 * unit};
    mor_canvas_text(canvas, left, title, &heavy);
}

/* A strip one canvas pixel high per color step; each slightly overlaps the next one so that no seam shows. */
static void fill_bar(mor_canvas *canvas, const mor_colormap *map, const double *r)
{
    const int n_strips = (int)ceil(r[3]);
    for (int strip = 0; strip < n_strips; ++strip) {
        double linear[3];
        mor_colormap_at(map, 1.0 - (strip + 0.5) / n_strips, linear);
        mor_canvas_pen pen = {.opacity = 1.0};
        for (int c = 0; c < 3; ++c) {
            pen.color[c] = mor_colormap_encode(linear[c]);
        }
        const double top = r[1] + strip * r[3] / n_strips;
        const double height = strip + 1 < n_strips ? r[3] / n_strips + 0.5 : r[1] + r[3] - top;
        const double box[4] = {r[0], top, r[2], height};
        mor_canvas_rectangle(canvas, box, &pen);
    }
}

/* The arrow at an end of the bar: "there are values beyond". */
static void draw_beyond(mor_canvas *canvas, const mor_colormap *map, const double *r, bool is_upper)
{
    const double base = is_upper ? r[1] : r[1] + r[3];
    const double tip = base + (is_upper ? -1.0 : 1.0) * 0.75 * r[2];
    const double points[8] = {r[0], base, r[0] + 0.5 * r[2], tip, r[0] + r[2], base, r[0], base};
    double linear[3];
    mor_colormap_at(map, is_upper ? 1.0 : 0.0, linear);
    mor_canvas_pen pen = {.opacity = 1.0};
    for (int c = 0; c < 3; ++c) {
        pen.color[c] = mor_colormap_encode(linear[c]);
    }
    mor_canvas_line(canvas, points, 4, &pen);
    const mor_canvas_pen edge = make_pen(r[2] / 18.0, quiet_gray);
    mor_canvas_line(canvas, points, 4, &edge);
}

void mor_overlay_color_bar(mor_canvas *canvas, const mor_colormap *map, const mor_picture *picture,
                           const mor_model_range *range, const double *rectangle)
{
    const double *r = rectangle;
    const double unit = r[2] / 26.0;
    char unit_text[MOR_TICKS_TEXT_BYTES];
    const double factor = mor_ticks_prefix(picture->value_unit != NULL ? picture->value_unit : "1",
                                           fmax(fabs(range->low), fabs(range->high)), unit_text);
    const double low = factor * range->low;
    const double high = factor * range->high;
    fill_bar(canvas, map, r);
    const mor_canvas_pen edge = make_pen(1.4 * unit, quiet_gray);
    mor_canvas_rectangle(canvas, r, &edge);
    if (range->has_below) {
        draw_beyond(canvas, map, r, false);
    }
    if (range->has_above) {
        draw_beyond(canvas, map, r, true);
    }
    const mor_ticks ticks = mor_ticks_choose(low, high, MOR_MODEL_COLOR_TICKS);
    const mor_canvas_font font = make_font(21.0 * unit, MOR_CANVAS_LEFT, 84.0 * unit);
    double widest = 0.0;
    for (int k = 0; k < ticks.n_ticks; ++k) {
        const double value = mor_ticks_value(&ticks, k);
        const double y = r[1] + r[3] * (high - value) / (high - low);
        const double tick[4] = {r[0] + r[2], y, r[0] + r[2] + 7.0 * unit, y};
        mor_canvas_line(canvas, tick, 2, &edge);
        char text[MOR_TICKS_TEXT_BYTES];
        mor_ticks_format(value, ticks.step, text);
        const double place[2] = {r[0] + r[2] + 13.0 * unit, y};
        mor_canvas_text(canvas, place, text, &font);
        widest = fmax(widest, fmin(mor_canvas_text_width(canvas, text, &font), font.limit));
    }
    char label[MOR_TICKS_LABEL_BYTES];
    mor_ticks_label(picture->value_name, unit_text, label);
    mor_canvas_font turned = make_font(23.0 * unit, MOR_CANVAS_CENTER, r[3] + 100.0 * unit);
    turned.is_upward = true;
    const double place[2] = {r[0] + r[2] + widest + 38.0 * unit, r[1] + 0.5 * r[3]};
    mor_canvas_text(canvas, place, label, &turned);
}

static void format_length(double length, char *text)
{
    char unit_text[MOR_TICKS_TEXT_BYTES];
    char number[MOR_TICKS_TEXT_BYTES];
    const double factor = mor_ticks_prefix("m", length, unit_text);
    mor_ticks_format(factor * length, factor * length, number);
    snprintf(text, MOR_TICKS_LABEL_BYTES, "%s %s", number, unit_text);
}

void mor_overlay_scale_bar(mor_canvas *canvas, const mor_camera *camera, const double *place, double grid, double unit)
{
    double n_pixels = 0.0;
    const double length = mor_camera_scale_bar(camera, 260.0 * unit, &n_pixels);
    const double height = 7.0 * unit;
    const double bar[4] = {place[0], place[1] - 0.5 * height, n_pixels, height};
    const mor_canvas_pen fill = make_pen(0.0, text_gray);
    mor_canvas_rectangle(canvas, bar, &fill);
    char text[MOR_TICKS_LABEL_BYTES];
    format_length(length, text);
    const mor_canvas_font font = make_font(21.0 * unit, MOR_CANVAS_CENTER, 0.0);
    const double above[2] = {place[0] + 0.5 * n_pixels, place[1] - 21.0 * unit};
    mor_canvas_text(canvas, above, text, &font);
    if (grid > 0.0) {
        char size[MOR_TICKS_LABEL_BYTES];
        format_length(grid, size);
        snprintf(text, sizeof text, "grid %.60s", size);
        mor_canvas_font quiet = make_font(21.0 * unit, MOR_CANVAS_LEFT, 0.0);
        quiet.color[0] = quiet.color[1] = quiet.color[2] = quiet_gray;
        const double beside[2] = {place[0] + n_pixels + 32.0 * unit, place[1]};
        mor_canvas_text(canvas, beside, text, &quiet);
    }
}

static void draw_arrow(mor_canvas *canvas, const double *foot, const double *step, const double *color, double unit)
{
    const double length = hypot(step[0], step[1]);
    const double along[2] = {step[0] / length, step[1] / length};
    const double head = fmin(11.0 * unit, 0.6 * length);
    const double tip[2] = {foot[0] + step[0], foot[1] + step[1]};
    const double neck[2] = {tip[0] - head * along[0], tip[1] - head * along[1]};
    const double half = 0.42 * head;
    const double shaft[4] = {foot[0], foot[1], neck[0], neck[1]};
    const double wedge[8] = {tip[0],
                             tip[1],
                             neck[0] - half * along[1],
                             neck[1] + half * along[0],
                             neck[0] + half * along[1],
                             neck[1] - half * along[0],
                             tip[0],
                             tip[1]};
    mor_canvas_pen pen = {.width = 2.6 * unit, .color = {color[0], color[1], color[2]}, .opacity = 1.0};
    mor_canvas_line(canvas, shaft, 2, &pen);
    pen.width = 0.0;
    mor_canvas_line(canvas, wedge, 4, &pen);
}

void mor_overlay_triad(mor_canvas *canvas, const mor_camera *camera, const double *place, double unit)
{
    static const char *const names[3] = {"x", "y", "z"};
    static const double colors[3][3] = {{0.72, 0.25, 0.22}, {0.25, 0.52, 0.25}, {0.22, 0.38, 0.70}};
    const double length = 50.0 * unit;
    for (int axis = 0; axis < 3; ++axis) {
        const double step[2] = {length * camera->right[axis], -length * camera->up[axis]};
        const double seen = hypot(step[0], step[1]);
        if (seen < 0.15 * length) {
            continue;
        }
        draw_arrow(canvas, place, step, colors[axis], unit);
        mor_canvas_font font = make_font(20.0 * unit, MOR_CANVAS_CENTER, 0.0);
        memcpy(font.color, colors[axis], sizeof font.color);
        const double reach = 1.0 + 13.0 * unit / seen;
        const double name[2] = {place[0] + reach * step[0], place[1] + reach * step[1]};
        mor_canvas_text(canvas, name, names[axis], &font);
    }
}

void mor_overlay_gravity(mor_canvas *canvas, const mor_camera *camera, const double *up, const double *place,
                         double unit)
{
    const double length = 58.0 * unit;
    const double step[2] = {-length * mor_vector_dot(camera->right, up), length * mor_vector_dot(camera->up, up)};
    const double seen = hypot(step[0], step[1]);
    if (seen < 0.15 * length) {
        return;
    }
    const double color[3] = {text_gray, text_gray, text_gray};
    const double foot[2] = {place[0] - 0.5 * step[0], place[1] - 0.5 * step[1]};
    draw_arrow(canvas, foot, step, color, unit);
    const mor_canvas_font font = make_font(21.0 * unit, MOR_CANVAS_CENTER, 0.0);
    const double beside[2] = {place[0] - 17.0 * unit * step[1] / seen, place[1] + 17.0 * unit * step[0] / seen};
    mor_canvas_text(canvas, beside, "g", &font);
}

static bool is_listed(const mor_picture *picture, const mor_picture_group *group)
{
    const bool is_plane = picture->dimension == 3 && group->style == MOR_PICTURE_GROUND;
    return group->name != NULL && group->name[0] != '\0' && group->n_particles > 0 && !is_plane;
}

/* Where everything is colored by value the color bar is sufficient. */
static bool needs_legend(const mor_picture *picture)
{
    bool has_plain = false;
    for (int g = 0; g < picture->n_groups; ++g) {
        has_plain = has_plain || (is_listed(picture, picture->groups + g) && picture->groups[g].value == NULL);
    }
    return has_plain;
}

/* A strip of the color map, or a disc; box: left, top, width, height. */
static void draw_sample(mor_canvas *canvas, const mor_colormap *map, const mor_picture_group *group, const double *box,
                        double unit)
{
    mor_canvas_pen pen = {.opacity = group->style == MOR_PICTURE_GHOST ? 0.45 : 1.0};
    const mor_canvas_pen edge = make_pen((group->is_piece ? 2.4 : 1.2) * unit, group->is_piece ? 0.2 : quiet_gray);
    if (group->value == NULL) {
        const double center[2] = {box[0] + 0.5 * box[2], box[1] + 0.5 * box[3]};
        mor_model_group_color(group, pen.color);
        mor_canvas_circle(canvas, center, 0.5 * box[3], &pen);
        mor_canvas_circle(canvas, center, 0.5 * box[3], &edge);
        return;
    }
    for (int strip = 0; strip < SAMPLE_STRIPS; ++strip) {
        double linear[3];
        mor_colormap_at(map, (strip + 0.5) / SAMPLE_STRIPS, linear);
        for (int c = 0; c < 3; ++c) {
            pen.color[c] = mor_colormap_encode(linear[c]);
        }
        /* Each slice slightly overlaps the next one so that no seam shows. */
        const double hair = strip + 1 < SAMPLE_STRIPS ? 0.5 : 0.0;
        const double slice[4] = {box[0] + strip * box[2] / SAMPLE_STRIPS, box[1], box[2] / SAMPLE_STRIPS + hair,
                                 box[3]};
        mor_canvas_rectangle(canvas, slice, &pen);
    }
    mor_canvas_rectangle(canvas, box, &edge);
}

void mor_overlay_legend(mor_canvas *canvas, const mor_colormap *map, const mor_picture *picture, const double *place,
                        double limit, double unit)
{
    const mor_canvas_font font = make_font(21.0 * unit, MOR_CANVAS_LEFT, 0.5 * limit);
    const double height = 18.0 * unit;
    const double gap = 9.0 * unit;
    double right = place[0];
    for (int g = picture->n_groups - 1; g >= 0 && needs_legend(picture); --g) {
        const mor_picture_group *group = picture->groups + g;
        if (!is_listed(picture, group)) {
            continue;
        }
        const double width = group->value != NULL ? 2.6 * height : height;
        const double left = right - width - gap - fmin(mor_canvas_text_width(canvas, group->name, &font), font.limit);
        if (left < place[0] - limit) {
            break;
        }
        const double box[4] = {left, place[1] - 0.5 * height, width, height};
        const double text[2] = {left + width + gap, place[1]};
        draw_sample(canvas, map, group, box, unit);
        mor_canvas_text(canvas, text, group->name, &font);
        right = left - 30.0 * unit;
    }
}
