/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/canvas.h"

#include "cases/driver/picture/draw/png_file.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <cairo.h>

#include <stdio.h>
#include <string.h>

enum { CUT_TEXT_BYTES = 256 };

static const double smallest_shrink = 0.75; /* text is set smaller down to this before it is cut */

struct mor_canvas {
    cairo_surface_t *surface; /* owned */
    cairo_t *cairo;           /* owned */
    int width;                /* pixels */
    int height;               /* pixels */
};

mor_status mor_canvas_check(mor_context *context, const mor_canvas *canvas)
{
    const cairo_status_t drawing = cairo_status(canvas->cairo);
    const cairo_status_t found = drawing != CAIRO_STATUS_SUCCESS ? drawing : cairo_surface_status(canvas->surface);
    if (found == CAIRO_STATUS_SUCCESS) {
        return MOR_OK;
    }
    if (found == CAIRO_STATUS_INVALID_STRING) {
        return MOR_FAIL(context, MOR_ERROR_ARGUMENT, "a text of the picture is not UTF-8; save the case file as UTF-8");
    }
    return MOR_FAIL(context, found == CAIRO_STATUS_NO_MEMORY ? MOR_ERROR_MEMORY : MOR_ERROR_INTERNAL,
                    "Cairo could not draw a picture of %d x %d pixels: %s", canvas->width, canvas->height,
                    cairo_status_to_string(found));
}

static bool is_allowed_size(int pixels)
{
    return pixels == 0 || (pixels >= MOR_CANVAS_SIZE_MIN && pixels <= MOR_CANVAS_SIZE_MAX);
}

mor_status mor_canvas_check_size(mor_context *context, int width, int height)
{
    MOR_CHECK(context, is_allowed_size(width) && is_allowed_size(height), MOR_ERROR_ARGUMENT,
              "a picture of %d x %d pixels was requested; from %d to %d each way are possible, or 0 for the usual size",
              width, height, MOR_CANVAS_SIZE_MIN, MOR_CANVAS_SIZE_MAX);
    return MOR_OK;
}

static int clamp_size(double pixels)
{
    const double size = pixels < MOR_CANVAS_SIZE_MIN ? MOR_CANVAS_SIZE_MIN : pixels;
    return size > MOR_CANVAS_SIZE_MAX ? MOR_CANVAS_SIZE_MAX : (int)size;
}

void mor_canvas_complete_size(int width, int height, int *n_columns, int *n_rows)
{
    const double proportion = (double)MOR_CANVAS_WIDTH / MOR_CANVAS_HEIGHT;
    *n_columns = width > 0 ? width : (height > 0 ? clamp_size(proportion * height) : MOR_CANVAS_WIDTH);
    *n_rows = height > 0 ? height : clamp_size(*n_columns / proportion);
}

static void set_font_options(cairo_t *cairo)
{
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

mor_status mor_canvas_new(mor_context *context, mor_canvas **canvas, int width, int height)
{
    *canvas = NULL;
    MOR_CHECK(context, width >= 1 && height >= 1 && width <= MOR_CANVAS_SIZE_MAX && height <= MOR_CANVAS_SIZE_MAX,
              MOR_ERROR_ARGUMENT, "a picture of %d x %d pixels was requested; from 1 to %d each way are possible",
              width, height, MOR_CANVAS_SIZE_MAX);
    MOR_TRY(context, MOR_NEW(context, canvas, 1, "canvas"));
    mor_canvas *made = *canvas;
    made->width = width;
    made->height = height;
    made->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    made->cairo = cairo_create(made->surface);
    set_font_options(made->cairo);
    cairo_set_line_join(made->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_source_rgb(made->cairo, 1.0, 1.0, 1.0);
    cairo_paint(made->cairo);
    const mor_status status = mor_canvas_check(context, made);
    if (status != MOR_OK) {
        mor_canvas_free(context, canvas);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_canvas_free(mor_context *context, mor_canvas **canvas)
{
    if (*canvas == NULL) {
        return;
    }
    cairo_destroy((*canvas)->cairo);
    cairo_surface_destroy((*canvas)->surface);
    MOR_FREE(context, canvas);
}

void mor_canvas_paste(mor_canvas *canvas, int left, int top, const int *size, const uint8_t *rgb)
{
    if (cairo_status(canvas->cairo) != CAIRO_STATUS_SUCCESS) {
        return;
    }
    cairo_surface_flush(canvas->surface);
    unsigned char *data = cairo_image_surface_get_data(canvas->surface);
    const int stride_bytes = cairo_image_surface_get_stride(canvas->surface);
    for (int row = 0; row < size[1]; ++row) {
        for (int column = 0; column < size[0]; ++column) {
            const int x = left + column;
            const int y = top + row;
            if (x < 0 || y < 0 || x >= canvas->width || y >= canvas->height) {
                continue;
            }
            const uint8_t *from = rgb + 3 * ((int64_t)row * size[0] + column);
            const uint32_t packed = (uint32_t)from[0] << 16 | (uint32_t)from[1] << 8 | (uint32_t)from[2];
            memcpy(data + (int64_t)y * stride_bytes + 4 * (int64_t)x, &packed, sizeof packed);
        }
    }
    cairo_surface_mark_dirty(canvas->surface);
}

static void finish_path(mor_canvas *canvas, const mor_canvas_pen *pen)
{
    cairo_set_source_rgba(canvas->cairo, pen->color[0], pen->color[1], pen->color[2], pen->opacity);
    if (pen->width <= 0.0) {
        cairo_fill(canvas->cairo);
        return;
    }
    cairo_set_line_width(canvas->cairo, pen->width);
    cairo_set_dash(canvas->cairo, &pen->dash, pen->dash > 0.0 ? 1 : 0, 0.0);
    cairo_stroke(canvas->cairo);
}

void mor_canvas_line(mor_canvas *canvas, const double *points, int64_t n_points, const mor_canvas_pen *pen)
{
    cairo_new_path(canvas->cairo);
    for (int64_t k = 0; k < n_points; ++k) {
        cairo_line_to(canvas->cairo, points[2 * k], points[2 * k + 1]);
    }
    finish_path(canvas, pen);
}

void mor_canvas_rectangle(mor_canvas *canvas, const double *rectangle, const mor_canvas_pen *pen)
{
    cairo_new_path(canvas->cairo);
    cairo_rectangle(canvas->cairo, rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
    finish_path(canvas, pen);
}

void mor_canvas_circle(mor_canvas *canvas, const double *center, double radius, const mor_canvas_pen *pen)
{
    cairo_new_path(canvas->cairo);
    cairo_arc(canvas->cairo, center[0], center[1], radius, 0.0, 2.0 * MOR_PI);
    finish_path(canvas, pen);
}

static void select_font(mor_canvas *canvas, const mor_canvas_font *font, double size)
{
    cairo_select_font_face(canvas->cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           font->is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(canvas->cairo, size);
}

static double measure_advance(mor_canvas *canvas, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(canvas->cairo, text, &extents);
    return extents.x_advance;
}

double mor_canvas_text_width(mor_canvas *canvas, const char *text, const mor_canvas_font *font)
{
    select_font(canvas, font, font->size);
    return measure_advance(canvas, text);
}

/* Drops characters, never parts of one, until the rest and "…" fit. */
static void cut_text(mor_canvas *canvas, const char *text, double limit, char *cut)
{
    size_t n_bytes = strlen(text);
    n_bytes = n_bytes > CUT_TEXT_BYTES - 4 ? CUT_TEXT_BYTES - 4 : n_bytes;
    do {
        while (n_bytes > 0 && ((unsigned char)text[n_bytes] & 0xC0u) == 0x80u) {
            n_bytes -= 1;
        }
        snprintf(cut, CUT_TEXT_BYTES, "%.*s…", (int)n_bytes, text);
        n_bytes -= n_bytes > 0;
    } while (n_bytes > 0 && measure_advance(canvas, cut) > limit);
}

void mor_canvas_text(mor_canvas *canvas, const double *place, const char *text, const mor_canvas_font *font)
{
    if (text == NULL || text[0] == '\0') {
        return;
    }
    char cut[CUT_TEXT_BYTES];
    const char *shown = text;
    double size = font->size;
    double width = mor_canvas_text_width(canvas, text, font);
    if (font->limit > 0.0 && width > font->limit) {
        const double shrink = font->limit / width;
        size *= shrink > smallest_shrink ? shrink : smallest_shrink;
        select_font(canvas, font, size);
        if (shrink < smallest_shrink) {
            cut_text(canvas, text, font->limit, cut);
            shown = cut;
        }
        width = measure_advance(canvas, shown);
    }
    /* Capitals of DejaVu are 0.729 of the size high. */
    const double along = font->anchor == MOR_CANVAS_LEFT ? 0.0 : (font->anchor == MOR_CANVAS_CENTER ? 0.5 : 1.0);
    cairo_save(canvas->cairo);
    cairo_translate(canvas->cairo, place[0], place[1]);
    if (font->is_upward) {
        cairo_rotate(canvas->cairo, -0.5 * MOR_PI);
    }
    cairo_move_to(canvas->cairo, -along * width, 0.5 * 0.729 * size);
    cairo_set_source_rgb(canvas->cairo, font->color[0], font->color[1], font->color[2]);
    cairo_show_text(canvas->cairo, shown);
    cairo_new_path(canvas->cairo);
    cairo_restore(canvas->cairo);
}

void mor_canvas_pixel(const mor_canvas *canvas, int column, int row, uint8_t *rgb)
{
    cairo_surface_flush(canvas->surface);
    const unsigned char *data = cairo_image_surface_get_data(canvas->surface);
    const int stride_bytes = cairo_image_surface_get_stride(canvas->surface);
    uint32_t packed = 0;
    memcpy(&packed, data + (int64_t)row * stride_bytes + 4 * (int64_t)column, sizeof packed);
    for (int channel = 0; channel < 3; ++channel) {
        rgb[channel] = (uint8_t)(packed >> (16 - 8 * channel));
    }
}

mor_status mor_canvas_write(mor_context *context, const mor_canvas *canvas, const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_canvas_check(context, canvas));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    cairo_surface_flush(canvas->surface);
    const int size[2] = {canvas->width, canvas->height};
    const mor_status written =
        mor_png_file_write(context, file.stream, path, size, cairo_image_surface_get_data(canvas->surface),
                           cairo_image_surface_get_stride(canvas->surface));
    if (written != MOR_OK) {
        mor_durable_file_discard(&file);
        return mor_context_pass(context, written, MOR_HERE);
    }
    MOR_TRY(context, mor_durable_file_commit(context, &file));
    return MOR_OK;
}
