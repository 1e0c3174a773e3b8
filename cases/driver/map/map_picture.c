/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_picture.h"

#include "cases/driver/map/map_classes.h"
#include "cases/driver/map/map_relief.h"
#include "cases/driver/map/map_structures.h"
#include "cases/driver/picture/draw/ticks.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* Sizes in px: the largest map, what is left around it, text. */
static const double map_size[2] = {1060.0, 860.0};
static const double least_height = 560.0;
static const double least_width = 260.0;
static const double head = 100.0;
static const double side = 400.0;
static const double text_size = 20.0;
static const double text_gray = 0.15;
static const double note_gray = 0.35;

/* Of structures, over all else. */
static const double structure_color[3] = {0.75, 0.16, 0.13};

/* How much of a color is seen over the ground, and how dark the ground is in shadow. */
static const double opacity = 0.8;
static const double shadow = 0.35;

/* One picture while it is drawn. */
typedef struct sheet {
    const mor_map_picture *picture;
    double *light;    /* of the ground; owned; NULL: there is none */
    uint8_t *covered; /* pixels where structures stand; owned; NULL: there are none */
    double interval;  /* of the contours, m; 0: there are none */
    mor_map_classes classes;
    double largest; /* value of the map; NaN: none */
    mor_canvas *canvas;
    mor_axes axes;
    double base[2]; /* subtracted from coordinates on the axes, m */
    char labels[2][MOR_TICKS_TEXT_BYTES];
    double legend; /* left edge of what stands beside the map, px */
    double next;   /* height of the next line there, px */
} sheet;

/* ---- The map ----------------------------------------------------------------------------------------------------- */

/* Track that was left is no deposit, and a rock that only began in a cell did not pass it: 0 has no color, but where a
 * small value counts most, as of an arrival at the start. */
static bool is_colored(const sheet *s, double value)
{
    return !isnan(value) && (value != 0.0 || s->picture->kind->is_early_dark);
}

static void find_color(const sheet *s, double column, double row, double *color)
{
    const mor_terrain_raster *map = s->picture->map;
    const double value = map->values[(int64_t)row * map->n[0] + (int64_t)column];
    double gray = 1.0;
    if (s->light != NULL) {
        gray = shadow + (1.0 - shadow) * mor_map_relief_light_at(s->picture->ground, s->light, column, row);
    }
    for (int a = 0; a < 3; ++a) {
        color[a] = gray;
    }
    if (is_colored(s, value)) {
        const double *of = s->classes.colors[mor_map_classes_find(&s->classes, value)];
        for (int a = 0; a < 3; ++a) {
            color[a] = opacity * of[a] * (0.5 + 0.5 * gray) + (1.0 - opacity) * gray;
        }
    }
}

static mor_status draw_cells(mor_context *context, const sheet *s)
{
    const int size[2] = {(int)s->axes.rectangle[2], (int)s->axes.rectangle[3]};
    const mor_terrain_raster *map = s->picture->map;
    uint8_t *rgb = NULL;
    MOR_TRY(context, MOR_NEW(context, &rgb, 3 * (int64_t)size[0] * size[1], "the pixels of a map"));
    for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) {
            double color[3];
            const int64_t pixel = (int64_t)y * size[0] + x;
            find_color(s, (x + 0.5) / size[0] * map->n[0], (y + 0.5) / size[1] * map->n[1], color);
            const double *seen = s->covered != NULL && s->covered[pixel] != 0 ? structure_color : color;
            for (int a = 0; a < 3; ++a) {
                rgb[3 * pixel + a] = (uint8_t)lround(255.0 * fmin(fmax(seen[a], 0.0), 1.0));
            }
        }
    }
    mor_canvas_paste(s->canvas, (int)s->axes.rectangle[0], (int)s->axes.rectangle[1], size, rgb);
    MOR_FREE(context, &rgb);
    return MOR_OK;
}

/* ---- Beside the map ---------------------------------------------------------------------------------------------- */

static void write_line(sheet *s, double left, const char *text, double gray, bool is_bold)
{
    const mor_canvas_font font = {.size = text_size,
                                  .is_bold = is_bold,
                                  .anchor = MOR_CANVAS_LEFT,
                                  .limit = side - 40.0 - (left - s->legend),
                                  .color = {gray, gray, gray}};
    const double place[2] = {left, s->next};
    mor_canvas_text(s->canvas, place, text, &font);
    s->next += 1.6 * text_size;
}

static void write_swatch(sheet *s, const double *color, const char *text)
{
    const double swatch[4] = {s->legend, s->next - 0.75 * text_size, 2.2 * text_size, 1.5 * text_size};
    const mor_canvas_pen fill = {.color = {color[0], color[1], color[2]}, .opacity = 1.0};
    mor_canvas_rectangle(s->canvas, swatch, &fill);
    write_line(s, s->legend + 2.8 * text_size, text, text_gray, false);
}

static void draw_legend(sheet *s)
{
    char unit[MOR_TICKS_TEXT_BYTES];
    char line[2 * MOR_TICKS_LABEL_BYTES];
    const mor_map_classes *it = &s->classes;
    const bool is_count = strcmp(s->picture->kind->unit, "1") == 0;
    const double factor = mor_ticks_prefix(s->picture->kind->unit, it->limits[it->n], unit);
    snprintf(line, sizeof line, is_count ? "%s" : "%s [%s]", s->picture->kind->title, unit);
    write_line(s, s->legend, line, text_gray, true);
    for (int k = it->n - 1; k >= 0; --k) {
        mor_map_classes_label(s->picture->kind, it, k, factor, line);
        write_swatch(s, it->colors[k], line);
    }
    s->next += 0.4 * text_size;
    if (isfinite(s->largest)) {
        snprintf(line, sizeof line, "largest: %.4g%s%s", factor * s->largest, is_count ? "" : " ",
                 is_count ? "" : unit);
        write_line(s, s->legend, line, text_gray, false);
    } else {
        write_line(s, s->legend, "no cell has data", text_gray, false);
    }
    if (!s->picture->kind->is_early_dark) {
        write_line(s, s->legend, "0: without color", text_gray, false);
    }
    if (s->covered != NULL) {
        write_swatch(s, structure_color, "structures");
    }
}

/* A bar of a round length, about a quarter of the map. */
static void draw_scale(sheet *s)
{
    char unit[MOR_TICKS_TEXT_BYTES];
    char number[MOR_TICKS_TEXT_BYTES];
    char line[MOR_TICKS_LABEL_BYTES];
    const double extent = s->axes.high[0] - s->axes.low[0];
    const double per_meter = s->axes.rectangle[2] / extent;
    double length = mor_ticks_choose(0.0, extent, 6).step;
    while (length * per_meter > side - 60.0) {
        length *= 0.5;
    }
    const double factor = mor_ticks_prefix("m", length, unit);
    const mor_canvas_pen pen = {.width = 3.0, .color = {text_gray, text_gray, text_gray}, .opacity = 1.0};
    const double right = s->legend + length * per_meter;
    const double bar[8] = {s->legend, s->next - 8.0, s->legend, s->next, right, s->next, right, s->next - 8.0};
    mor_canvas_line(s->canvas, bar, 4, &pen);
    s->next += 1.1 * text_size;
    mor_ticks_format(factor * length, factor * length, number);
    snprintf(line, sizeof line, "%s %s", number, unit);
    write_line(s, s->legend, line, text_gray, false);
}

/* Up is the north of the grid of the raster. */
static void draw_north(sheet *s)
{
    const mor_canvas_pen fill = {.color = {text_gray, text_gray, text_gray}, .opacity = 1.0};
    const double x = s->legend + 0.6 * text_size;
    const double y = s->next;
    const double arrow[8] = {x, y - 12.0, x + 11.0, y + 20.0, x, y + 13.0, x - 11.0, y + 20.0};
    mor_canvas_line(s->canvas, arrow, 4, &fill);
    s->next += 4.0;
    write_line(s, s->legend + 1.8 * text_size, "north of the grid", text_gray, false);
    s->next += 0.6 * text_size;
}

static void draw_side(sheet *s)
{
    char line[MOR_TICKS_LABEL_BYTES];
    s->next = head + 0.5 * text_size;
    draw_legend(s);
    if (s->picture->note[0] != '\0') {
        write_line(s, s->legend, s->picture->note, note_gray, false);
    }
    s->next += text_size;
    draw_scale(s);
    s->next += 0.6 * text_size;
    if (s->light != NULL) {
        draw_north(s);
        write_line(s, s->legend, "light from the north-west", note_gray, false);
    }
    if (s->interval > 0.0) {
        snprintf(line, sizeof line, "contours every %g m", s->interval);
        write_line(s, s->legend, line, note_gray, false);
    }
}

/* ---- One picture ------------------------------------------------------------------------------------------------- */

/* Map grids have coordinates of millions of meters, of which the first digits are told once, in the label. */
static double find_base(double low, double extent)
{
    const double longest = 1.0e5;
    const double round_length = pow(10.0, ceil(log10(10.0 * extent)));
    return fabs(low) + extent < longest ? 0.0 : floor(low / round_length) * round_length;
}

static void lay_out(sheet *s, int *size)
{
    const mor_terrain_raster *map = s->picture->map;
    const double extent[2] = {map->n[0] * map->cell[0], map->n[1] * map->cell[1]};
    const double lowest[2] = {map->corner[0], map->corner[1] - extent[1]};
    for (int a = 0; a < 2; ++a) {
        s->base[a] = find_base(lowest[a], extent[a]);
        snprintf(s->labels[a], sizeof s->labels[a], "%c [m]", "xy"[a]);
        if (s->base[a] != 0.0) {
            snprintf(s->labels[a], sizeof s->labels[a], "%c %c %.0f [m]", "xy"[a], s -> base[a] > 0.0 ? '-' : '+',
                     fabs(s->base[a]));
        }
    }
    const double scale = fmin(map_size[0] / extent[0], map_size[1] / extent[1]);
    const double left = ceil(mor_axes_left_room(text_size)) + 8.0;
    const double width = fmax(floor(scale * extent[0]), 2.0);
    const double height = fmax(floor(scale * extent[1]), 2.0);
    s->axes = (mor_axes){.rectangle = {left, head, width, height},
                         .low = {lowest[0] - s->base[0], lowest[1] - s->base[1]},
                         .high = {lowest[0] - s->base[0] + extent[0], lowest[1] - s->base[1] + extent[1]},
                         .label = {s->labels[0], s->labels[1]},
                         .text = text_size};
    s->legend = left + fmax(width, least_width) + 36.0;
    size[0] = (int)(s->legend + side);
    size[1] = (int)fmax(head + height + mor_axes_lower_room(text_size) + 12.0, least_height);
}

/* Draws what stands beside the map, and the contours, once outside of any picture, to find the height they take. */
static mor_status measure_side(mor_context *context, sheet *s, int *height)
{
    const mor_terrain_raster *ground = s->picture->ground;
    mor_status status = mor_canvas_new(context, &s->canvas, 1, 1);
    if (status == MOR_OK) {
        s->interval = ground != NULL ? mor_map_relief_contours(s->canvas, ground, s->base, &s->axes) : 0.0;
        draw_side(s);
        *height = (int)fmax(*height, ceil(s->next));
    }
    mor_canvas_free(context, &s->canvas);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

static void draw_head(const sheet *s, double width)
{
    const mor_map_picture *picture = s->picture;
    const double left = s->axes.rectangle[0];
    const mor_canvas_font heavy = {.size = 1.3 * text_size,
                                   .is_bold = true,
                                   .limit = width - left - 40.0,
                                   .color = {text_gray, text_gray, text_gray}};
    const mor_canvas_font light = {
        .size = 0.85 * text_size, .limit = width - left - 40.0, .color = {note_gray, note_gray, note_gray}};
    const double title[2] = {left, 36.0};
    const double below[2] = {left, 70.0};
    char line[MOR_CASE_TEXT_BYTES + MOR_TICKS_LABEL_BYTES];
    snprintf(line, sizeof line, "%s%s%s", picture->title, picture->title[0] != '\0' ? ": " : "", picture->kind->title);
    mor_canvas_text(s->canvas, title, line, &heavy);
    mor_canvas_text(s->canvas, below, picture->subtitle, &light);
}

static mor_status draw_sheet(mor_context *context, sheet *s)
{
    int size[2];
    const mor_terrain_raster *map = s->picture->map;
    const mor_terrain_raster *ground = s->picture->ground;
    s->largest = NAN;
    for (int64_t k = 0; k < (int64_t)map->n[0] * map->n[1]; ++k) {
        s->largest = fmax(s->largest, map->values[k]);
    }
    mor_map_classes_init(s->picture->kind, s->largest, &s->classes);
    lay_out(s, size);
    if (ground != NULL) {
        MOR_TRY(context, mor_map_relief_light(context, ground, &s->light));
    }
    if (s->picture->the_case != NULL) {
        const int pixels[2] = {(int)s->axes.rectangle[2], (int)s->axes.rectangle[3]};
        MOR_TRY(context, mor_map_structures_find(context, s->picture->the_case, pixels, &s->covered));
    }
    MOR_TRY(context, measure_side(context, s, &size[1]));
    MOR_TRY(context, mor_canvas_new(context, &s->canvas, size[0], size[1]));
    MOR_TRY(context, draw_cells(context, s));
    if (ground != NULL) {
        mor_map_relief_contours(s->canvas, ground, s->base, &s->axes);
    }
    mor_axes_draw(s->canvas, &s->axes);
    draw_head(s, size[0]);
    draw_side(s);
    return mor_canvas_check(context, s->canvas);
}

mor_status mor_map_picture_write(mor_context *context, const mor_map_picture *picture, const char *path)
{
    sheet s = {.picture = picture};
    mor_status status = draw_sheet(context, &s);
    if (status == MOR_OK) {
        status = mor_canvas_write(context, s.canvas, path);
    }
    mor_canvas_free(context, &s.canvas);
    MOR_FREE(context, &s.light);
    MOR_FREE(context, &s.covered);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

mor_status mor_map_read(mor_context *context, const char *folder, const char *name, mor_terrain_raster *map,
                        bool *is_there)
{
    char path[MOR_PATH_BYTES];
    const int n_bytes = snprintf(path, sizeof path, "%s/" MOR_MAP_FOLDER "/%s.tif", folder, name);
    *map = (mor_terrain_raster){.values = NULL};
    MOR_CHECK(context, n_bytes > 0 && n_bytes < (int)sizeof path, MOR_ERROR_IO, "the path of a map is too long");
    *is_there = access(path, R_OK) == 0;
    return *is_there ? mor_terrain_raster_read(context, path, map) : MOR_OK;
}

/* The depth that a map depends on. */
static void write_note(const mor_case_maps *maps, const mor_map_kind *kind, char *note)
{
    note[0] = '\0';
    if (kind->depth != MOR_MAP_DEPTH_NONE) {
        const bool is_threshold = kind->depth == MOR_MAP_DEPTH_THRESHOLD;
        snprintf(note, MOR_TICKS_LABEL_BYTES, "where depth reached %.4g m",
                 is_threshold ? maps->threshold : maps->duration_depth);
    }
}

static mor_status draw_map(mor_context *context, const mor_case *the_case, const mor_map_kind *kind,
                           const mor_terrain_raster *ground, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    char note[MOR_TICKS_LABEL_BYTES];
    mor_terrain_raster map;
    bool is_there = false;
    mor_status status = mor_map_read(context, folder, kind->name, &map, &is_there);
    if (status == MOR_OK && is_there) {
        write_note(&the_case->maps, kind, note);
        snprintf(path, sizeof path, "%s/images/map-%s.png", folder, kind->name); /* shorter than that of the map */
        const bool is_over_ground = ground->values != NULL && ground->n[0] == map.n[0] && ground->n[1] == map.n[1];
        const mor_map_picture picture = {.title = the_case->title,
                                         .subtitle = kind->text,
                                         .note = note,
                                         .kind = kind,
                                         .map = &map,
                                         .ground = is_over_ground ? ground : NULL,
                                         .the_case = the_case};
        status = mor_map_picture_write(context, &picture, path);
        if (status == MOR_OK) {
            fprintf(output, "map: %s\n", path);
        }
    }
    mor_terrain_raster_clear(context, &map);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_map_pictures_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output)
{
    mor_terrain_raster ground;
    bool has_ground = false;
    if (!the_case->maps.is_wanted) {
        return MOR_OK;
    }
    mor_status status = mor_map_read(context, folder, "ground", &ground, &has_ground);
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL && status == MOR_OK; ++kind) {
        if (kind->is_drawn) {
            status = draw_map(context, the_case, kind, &ground, folder, output);
        }
    }
    mor_terrain_raster_clear(context, &ground);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
