/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_relief.h"

#include "cases/driver/picture/draw/ticks.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

enum { LEVELS = 14, LABELS_MAX = 64 };

static double height_at(const mor_terrain_raster *ground, int column, int row)
{
    const int x = column < 0 ? 0 : column >= ground->n[0] ? ground->n[0] - 1 : column;
    const int y = row < 0 ? 0 : row >= ground->n[1] ? ground->n[1] - 1 : row;
    return ground->values[(int64_t)y * ground->n[0] + x];
}

/* ---- Light ------------------------------------------------------------------------------------------------------- */

mor_status mor_map_relief_light(mor_context *context, const mor_terrain_raster *ground, double **light)
{
    static const double sun[3] = {-0.5, 0.5, 0.70710678118654752};
    MOR_TRY(context, MOR_NEW(context, light, (int64_t)ground->n[0] * ground->n[1], "the light of a map"));
    for (int row = 0; row < ground->n[1]; ++row) {
        for (int column = 0; column < ground->n[0]; ++column) {
            const int nx = (column > 0 ? 1 : 0) + (column + 1 < ground->n[0] ? 1 : 0);
            const int ny = (row > 0 ? 1 : 0) + (row + 1 < ground->n[1] ? 1 : 0);
            const double x = height_at(ground, column + 1, row) - height_at(ground, column - 1, row);
            const double y = height_at(ground, column, row - 1) - height_at(ground, column, row + 1);
            const double normal[3] = {nx > 0 ? -x / (nx * ground->cell[0]) : 0.0,
                                      ny > 0 ? -y / (ny * ground->cell[1]) : 0.0, 1.0};
            (*light)[(int64_t)row * ground->n[0] + column] =
                fmax(0.0, mor_vector_dot(normal, sun) / mor_vector_length(normal));
        }
    }
    return MOR_OK;
}

double mor_map_relief_light_at(const mor_terrain_raster *ground, const double *light, double column, double row)
{
    const double x = fmin(fmax(column - 0.5, 0.0), ground->n[0] - 1.0);
    const double y = fmin(fmax(row - 0.5, 0.0), ground->n[1] - 1.0);
    const int i = (int)fmin(floor(x), fmax(ground->n[0] - 2.0, 0.0));
    const int j = (int)fmin(floor(y), fmax(ground->n[1] - 2.0, 0.0));
    const int right = i + 1 < ground->n[0] ? 1 : 0;
    const int below = j + 1 < ground->n[1] ? ground->n[0] : 0;
    const double *at = light + (int64_t)j * ground->n[0] + i;
    const double upper = at[0] + (x - i) * (at[right] - at[0]);
    const double lower = at[below] + (x - i) * (at[below + right] - at[below]);
    return upper + (y - j) * (lower - upper);
}

/* ---- Contours ---------------------------------------------------------------------------------------------------- */

/* Where the heights go: one for each level, on the piece of contour that lies nearest to a line across the map. */
typedef struct label {
    double height;   /* m */
    double place[2]; /* px */
    double distance; /* from that line, 1 */
} label;

typedef struct contours {
    mor_canvas *canvas;
    const mor_terrain_raster *ground;
    const double *base; /* shape [2]; subtracted from coordinates, m */
    const mor_axes *axes;
    mor_ticks ticks;
    label labels[LABELS_MAX]; /* shape [ticks.n_ticks]; heights NaN: no contour was met */
} contours;

/* Where a level crosses the side between two corners; false when it does not. */
static bool cross_side(const contours *c, const double *one, const double *other, double level, double *place)
{
    if ((one[2] > level) == (other[2] > level)) {
        return false;
    }
    const double share = (level - one[2]) / (other[2] - one[2]);
    const double at[2] = {one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1])};
    mor_axes_place(c->axes, at, place);
    return true;
}

/* The farther from the frame, the better a height can be read. */
static void offer_place(contours *c, int k, const double *place)
{
    const double *r = c->axes->rectangle;
    const double x = (place[0] - r[0]) / r[2];
    const double y = (place[1] - r[1]) / r[3];
    const double margin = 0.04;
    const double distance = fabs(x - y);
    label *it = &c->labels[k];
    if (fmin(fmin(x, 1.0 - x), fmin(y, 1.0 - y)) > margin && !(distance >= it->distance)) {
        *it = (label){mor_ticks_value(&c->ticks, k), {place[0], place[1]}, distance};
    }
}

/* A triangle has a straight piece of each contour, so that contours never fork. */
static void draw_triangle(contours *c, double corners[3][3])
{
    static const mor_canvas_pen pen = {.width = 1.2, .color = {0.25, 0.22, 0.18}, .opacity = 0.55};
    const double low = fmin(corners[0][2], fmin(corners[1][2], corners[2][2]));
    const double high = fmax(corners[0][2], fmax(corners[1][2], corners[2][2]));
    for (int k = 0; k < c->ticks.n_ticks; ++k) {
        const double level = mor_ticks_value(&c->ticks, k);
        double places[6];
        int n = 0;
        if (!(level >= low && level <= high)) {
            continue;
        }
        for (int side = 0; side < 3; ++side) {
            n += cross_side(c, corners[side], corners[(side + 1) % 3], level, places + 2 * n) ? 1 : 0;
        }
        if (n == 2) {
            mor_canvas_line(c->canvas, places, 2, &pen);
            offer_place(c, k, places);
        }
    }
}

/* The corner of the square of four cells that lies right (bit 0) and below (bit 1). */
static void find_corner(const contours *c, int column, int row, double *corner)
{
    corner[0] = c->ground->corner[0] - c->base[0] + (column + 0.5) * c->ground->cell[0];
    corner[1] = c->ground->corner[1] - c->base[1] - (row + 0.5) * c->ground->cell[1];
    corner[2] = height_at(c->ground, column, row);
}

static void draw_square(contours *c, int column, int row)
{
    static const int corner_of[2][3] = {{0, 1, 2}, {1, 3, 2}};
    for (int t = 0; t < 2; ++t) {
        double corners[3][3];
        for (int k = 0; k < 3; ++k) {
            const int bits = corner_of[t][k];
            find_corner(c, column + (bits & 1), row + (bits >> 1), corners[k]);
        }
        draw_triangle(c, corners);
    }
}

static bool is_near_other(const contours *c, int k)
{
    const double room[2] = {3.2 * c->axes->text, 1.3 * c->axes->text};
    bool is_near = false;
    for (int other = 0; other < k; ++other) {
        const label *it = &c->labels[other];
        is_near = is_near || (isfinite(it->height) && fabs(it->place[0] - c->labels[k].place[0]) < room[0] &&
                              fabs(it->place[1] - c->labels[k].place[1]) < room[1]);
    }
    return is_near;
}

static void draw_labels(contours *c)
{
    static const mor_canvas_pen back = {.width = 0.0, .color = {1.0, 1.0, 1.0}, .opacity = 0.7};
    const double size = 0.72 * c->axes->text;
    const mor_canvas_font font = {
        .size = size, .anchor = MOR_CANVAS_CENTER, .limit = 6.0 * size, .color = {0.25, 0.22, 0.18}};
    for (int k = 0; k < c->ticks.n_ticks; ++k) {
        label *it = &c->labels[k];
        char text[MOR_TICKS_TEXT_BYTES];
        if (isnan(it->height) || is_near_other(c, k)) {
            it->height = NAN;
            continue;
        }
        mor_ticks_format(it->height, c->ticks.step, text);
        const double width = mor_canvas_text_width(c->canvas, text, &font) + 0.5 * size;
        const double box[4] = {it->place[0] - 0.5 * width, it->place[1] - 0.65 * size, width, 1.3 * size};
        mor_canvas_rectangle(c->canvas, box, &back);
        mor_canvas_text(c->canvas, it->place, text, &font);
    }
}

double mor_map_relief_contours(mor_canvas *canvas, const mor_terrain_raster *ground, const double *base,
                               const mor_axes *axes)
{
    contours c = {.canvas = canvas, .ground = ground, .base = base, .axes = axes};
    double low = INFINITY;
    double high = -INFINITY;
    for (int64_t k = 0; k < (int64_t)ground->n[0] * ground->n[1]; ++k) {
        low = fmin(low, ground->values[k]);
        high = fmax(high, ground->values[k]);
    }
    if (!(high - low > 1.0e-9 * fmax(fabs(low), fabs(high)))) {
        return 0.0;
    }
    c.ticks = mor_ticks_choose(low, high, LEVELS);
    for (int k = 0; k < LABELS_MAX; ++k) {
        c.labels[k] = (label){NAN, {0.0, 0.0}, INFINITY};
    }
    for (int row = 0; row + 1 < ground->n[1]; ++row) {
        for (int column = 0; column + 1 < ground->n[0]; ++column) {
            draw_square(&c, column, row);
        }
    }
    draw_labels(&c);
    return c.ticks.step;
}
