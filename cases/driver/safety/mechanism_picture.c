/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/mechanism_picture.h"

#include "cases/driver/picture/draw/axes.h"
#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/draw/ticks.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 1600, HEIGHT_LEAST = 500, HEIGHT_MOST = 1400, STEPS = 128, LABEL_TICKS = 6 };

static const double text_size = 22.0;       /* px */
static const double title_room = 120.0;     /* px, above the plot: title and legend */
static const double bar_room = 190.0;       /* px, right of the plot: color bar */
static const double right_margin = 40.0;    /* px, of the color bar's numbers */
static const double highest_percent = 0.99; /* of the particles lie within the colors */
static const double overlap = 1.04;         /* of neighboring squares, which would show a hairline between them */
static const double loose_overlap = 1.4;    /* likewise of particles that stand on no lattice */
static const double cell_reach = 0.75;      /* of a particle to centers of cells, spacings: no cell between is empty */
static const double rock_color[3] = {0.62, 0.62, 0.60};
static const double outline_color[3] = {0.85, 0.05, 0.10};

/* The picture while it is made. Positions in the frame of the case. */
typedef struct sheet {
    const mor_safety *it;
    mor_canvas *canvas;
    mor_axes axes;
    double low[2], high[2]; /* of soil and rocks, m */
    double *values;         /* shape [n at creation], by number; what colors show; owned */
    double top;             /* of the colors, unit of the values */
    mor_colormap map;
} sheet;

static void place_of(const sheet *s, int64_t id, double *x)
{
    double place[3];
    mor_simulation_take_point_back(s->it->setup.reduced->original, s->it->setup.reference.position + 3 * id, place);
    x[0] = place[0];
    x[1] = place[1];
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static int compare_numbers(const void *a, const void *b)
{
    const double left = *(const double *)a;
    const double right = *(const double *)b;
    return left < right ? -1 : left > right;
}

static mor_status find_values(mor_context *context, sheet *s, mor_mechanism_color color)
{
    const mor_safety_reference *r = &s->it->setup.reference;
    const mor_set *set = &s->it->mechanism->soil.set;
    const int field = color == MOR_MECHANISM_STRAIN ? mor_set_find_field(set, "plastic_strain") : -1;
    MOR_TRY(context, MOR_NEW(context, &s->values, r->n, "colors of a mechanism"));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const int64_t id = set->id[i];
        s->values[id] = field >= 0 ? set->data[field][i] - r->plastic_strain[id] : mor_safety_displacement(r, set, i);
        r->values[i] = s->values[id];
    }
    qsort(r->values, (size_t)set->n_particles, sizeof *r->values, compare_numbers);
    s->top = r->values[(int64_t)(highest_percent * (double)(set->n_particles - 1))];
    s->top = s->top > 0.0 ? s->top : 1.0;
    return MOR_OK;
}

/* ---- Parts of the picture ---------------------------------------------------------------------------------------- */

typedef void (*visit_place)(sheet *s, const double *x);

/* Particles of rocks where they are at the end: they belong to no reference. */
static void visit_rocks(sheet *s, visit_place visit)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(s->it->mechanism, false, sets);
    for (int k = s->it->mechanism->has_soil ? 1 : 0; k < n_sets; ++k) {
        for (int64_t i = 0; i < sets[k]->n_particles; ++i) {
            double place[3];
            mor_simulation_take_point_back(s->it->setup.reduced->original, sets[k]->data[MOR_FIELD_POSITION] + 3 * i,
                                           place);
            visit(s, place);
        }
    }
}

static void include_place(sheet *s, const double *x)
{
    for (int a = 0; a < 2; ++a) {
        s->low[a] = fmin(s->low[a], x[a]);
        s->high[a] = fmax(s->high[a], x[a]);
    }
}

static void find_bounds(sheet *s)
{
    const mor_set *set = &s->it->mechanism->soil.set;
    for (int a = 0; a < 2; ++a) {
        s->low[a] = INFINITY;
        s->high[a] = -INFINITY;
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double x[2];
        place_of(s, set->id[i], x);
        include_place(s, x);
    }
    visit_rocks(s, include_place);
    for (int a = 0; a < 2; ++a) {
        const double margin = 0.02 * (s->high[a] - s->low[a]) + s->it->setup.reduced->original->spacing;
        s->low[a] -= margin;
        s->high[a] += margin;
    }
}

/* Axes of equal scale in both directions. */
static mor_status lay_out(mor_context *context, sheet *s)
{
    const double left = mor_axes_left_room(text_size);
    const double lower = mor_axes_lower_room(text_size);
    const double width = WIDTH - left - bar_room - right_margin;
    const double wanted = width * (s->high[1] - s->low[1]) / (s->high[0] - s->low[0]);
    const double most = HEIGHT_MOST - title_room - lower;
    const double scale = wanted > most ? most / wanted : 1.0;
    const double height = fmax(scale * wanted, 1.0);
    const int rows = (int)fmax(height + title_room + lower, (double)HEIGHT_LEAST);
    MOR_TRY(context, mor_canvas_new(context, &s->canvas, WIDTH, rows));
    s->axes = (mor_axes){.rectangle = {left, title_room, scale * width, height},
                         .low = {s->low[0], s->low[1]},
                         .high = {s->high[0], s->high[1]},
                         .label = {"x [m]", "y [m]"},
                         .text = text_size};
    mor_axes_draw(s->canvas, &s->axes);
    return MOR_OK;
}

/* A square about a place, m. */
static void draw_square(const sheet *s, const double *x, double side, const double *color)
{
    const double corners[2][2] = {{x[0] - 0.5 * side, x[1] + 0.5 * side}, {x[0] + 0.5 * side, x[1] - 0.5 * side}};
    double from[2];
    double to[2];
    const mor_canvas_pen pen = {.color = {color[0], color[1], color[2]}, .opacity = 1.0};
    mor_axes_place(&s->axes, corners[0], from);
    mor_axes_place(&s->axes, corners[1], to);
    mor_canvas_rectangle(s->canvas, (const double[4]){from[0], from[1], to[0] - from[0], to[1] - from[1]}, &pen);
}

static void find_color(const sheet *s, double fraction, double *color)
{
    double linear[3];
    mor_colormap_at(&s->map, fraction, linear);
    for (int a = 0; a < 3; ++a) {
        color[a] = mor_colormap_encode(linear[a]);
    }
}

static void draw_soil(const sheet *s)
{
    const mor_set *set = &s->it->mechanism->soil.set;
    const mor_case *c = s->it->setup.reduced->original;
    double side = overlap * c->spacing;
    for (int k = 0; k < c->n_soils; ++k) {
        side = c->soils[k].is_relaxed ? loose_overlap * c->spacing : side;
    }
    for (int64_t id = 0; id < set->n_created; ++id) {
        double x[2];
        double color[3];
        place_of(s, id, x);
        find_color(s, s->values[id] / s->top, color);
        draw_square(s, x, side, color);
    }
}

static void draw_rock(sheet *s, const double *x)
{
    draw_square(s, x, loose_overlap * s->it->setup.reduced->original->spacing, rock_color);
}

/* ---- The outline ------------------------------------------------------------------------------------------------- */

/* Cells of the lattice that hold a particle of the body, or are reached by one. */
typedef struct cells {
    bool *is_part; /* shape [n[1], n[0]]; owned */
    int64_t n[2];
    double low[2], spacing; /* m */
} cells;

static bool is_part(const cells *grid, int64_t column, int64_t row)
{
    return column >= 0 && column < grid->n[0] && row >= 0 && row < grid->n[1] &&
           grid->is_part[row * grid->n[0] + column];
}

/* The cells about a particle whose centers it reaches: on a lattice its own. */
static void mark(cells *grid, const double *x)
{
    const int64_t own[2] = {(int64_t)floor((x[0] - grid->low[0]) / grid->spacing),
                            (int64_t)floor((x[1] - grid->low[1]) / grid->spacing)};
    for (int k = 0; k < 9; ++k) {
        const int64_t cell[2] = {own[0] + k % 3 - 1, own[1] + k / 3 - 1};
        double distance2 = 0.0;
        for (int a = 0; a < 2; ++a) {
            const double d = (x[a] - grid->low[a]) / grid->spacing - ((double)cell[a] + 0.5);
            distance2 += d * d;
        }
        if (distance2 < cell_reach * cell_reach && cell[0] >= 0 && cell[0] < grid->n[0] && cell[1] >= 0 &&
            cell[1] < grid->n[1]) {
            grid->is_part[cell[1] * grid->n[0] + cell[0]] = true;
        }
    }
}

static mor_status fill_cells(mor_context *context, const sheet *s, cells *grid)
{
    const mor_set *set = &s->it->mechanism->soil.set;
    grid->spacing = s->it->setup.reduced->original->spacing;
    double first[2]; /* a particle's center: cells lie about it, so that rounding decides nothing on the lattice */
    place_of(s, set->id[0], first);
    for (int a = 0; a < 2; ++a) {
        const double below = ceil((first[a] - s->low[a]) / grid->spacing);
        grid->low[a] = first[a] - (below + 0.5) * grid->spacing;
        grid->n[a] = (int64_t)ceil((s->high[a] - grid->low[a]) / grid->spacing) + 1;
    }
    MOR_TRY(context, MOR_NEW(context, &grid->is_part, grid->n[0] * grid->n[1], "outline of a body"));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double x[2];
        if (s->it->body.is_part[set->id[i]]) {
            place_of(s, set->id[i], x);
            mark(grid, x);
        }
    }
    return MOR_OK;
}

static void draw_edge(const sheet *s, const cells *grid, const int64_t *from, const int64_t *to)
{
    const mor_canvas_pen pen = {
        .width = 4.0, .color = {outline_color[0], outline_color[1], outline_color[2]}, .opacity = 1.0};
    double points[4];
    for (int k = 0; k < 2; ++k) {
        const int64_t *corner = k == 0 ? from : to;
        const double x[2] = {grid->low[0] + (double)corner[0] * grid->spacing,
                             grid->low[1] + (double)corner[1] * grid->spacing};
        mor_axes_place(&s->axes, x, points + 2 * k);
    }
    mor_canvas_line(s->canvas, points, 2, &pen);
}

static mor_status draw_outline(mor_context *context, const sheet *s)
{
    cells grid = {.is_part = NULL};
    MOR_TRY(context, fill_cells(context, s, &grid));
    for (int64_t row = 0; row <= grid.n[1]; ++row) {
        for (int64_t column = 0; column <= grid.n[0]; ++column) {
            const bool here = is_part(&grid, column, row);
            if (here != is_part(&grid, column - 1, row)) {
                draw_edge(s, &grid, (const int64_t[2]){column, row}, (const int64_t[2]){column, row + 1});
            }
            if (here != is_part(&grid, column, row - 1)) {
                draw_edge(s, &grid, (const int64_t[2]){column, row}, (const int64_t[2]){column + 1, row});
            }
        }
    }
    MOR_FREE(context, &grid.is_part);
    return MOR_OK;
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

static void draw_bar(const sheet *s, const char *name, const char *unit)
{
    const double *plot = s->axes.rectangle;
    const double left = plot[0] + plot[2] + 40.0;
    char text[MOR_TICKS_TEXT_BYTES];
    char label[MOR_TICKS_LABEL_BYTES];
    const double prefix = mor_ticks_prefix(unit, s->top, text);
    mor_ticks_label(name, text, label);
    /* From the top, each down to the foot: an edge within a pixel is then blended with the next color. */
    for (int k = STEPS - 1; k >= 0; --k) {
        double color[3];
        find_color(s, (k + 0.5) / STEPS, color);
        const mor_canvas_pen pen = {.color = {color[0], color[1], color[2]}, .opacity = 1.0};
        const double height = (k + 1) * plot[3] / STEPS;
        mor_canvas_rectangle(s->canvas, (const double[4]){left, plot[1] + plot[3] - height, 30.0, height}, &pen);
    }
    const mor_ticks ticks = mor_ticks_choose(0.0, prefix * s->top, LABEL_TICKS);
    const mor_canvas_font font = {.size = text_size};
    for (int k = 0; k < ticks.n_ticks; ++k) {
        const double value = mor_ticks_value(&ticks, k);
        const double place[2] = {left + 40.0, plot[1] + plot[3] * (1.0 - value / (prefix * s->top))};
        mor_ticks_format(value, ticks.step, text);
        mor_canvas_text(s->canvas, place, text, &font);
    }
    const mor_canvas_font upward = {
        .size = text_size, .is_upward = true, .anchor = MOR_CANVAS_CENTER, .limit = plot[3]};
    mor_canvas_text(s->canvas, (const double[2]){WIDTH - 30.0, plot[1] + 0.5 * plot[3]}, label, &upward);
}

static void draw_title(const sheet *s, mor_mechanism_color color)
{
    char text[512];
    const mor_safety *it = s->it;
    const double left = s->axes.rectangle[0];
    const mor_canvas_font bold = {.size = 1.2 * text_size, .is_bold = true, .limit = WIDTH - 2.0 * left};
    const mor_canvas_font font = {.size = text_size};
    mor_canvas_text(s->canvas, (const double[2]){left, 32.0}, it->setup.reduced->original->title, &bold);
    snprintf(text, sizeof text, "%s since the strength was divided by F = %.5g; spacing %.4g m",
             color == MOR_MECHANISM_STRAIN ? "plastic strain" : "displacement", it->trials[it->mechanism_trial].factor,
             it->setup.reduced->original->spacing);
    mor_canvas_text(s->canvas, (const double[2]){left, 66.0}, text, &font);
    const mor_canvas_pen pen = {
        .width = 4.0, .color = {outline_color[0], outline_color[1], outline_color[2]}, .opacity = 1.0};
    mor_canvas_line(s->canvas, (const double[4]){left, 98.0, left + 50.0, 98.0}, 2, &pen);
    snprintf(text, sizeof text, "critical body: soil that moved more than %.3g m; %.4g m²", it->body.limit,
             it->body.volume);
    mor_canvas_text(s->canvas, (const double[2]){left + 60.0, 98.0}, text, &font);
}

static mor_status draw(mor_context *context, sheet *s, mor_mechanism_color color, const char *path)
{
    MOR_TRY(context, find_values(context, s, color));
    find_bounds(s);
    MOR_TRY(context, lay_out(context, s));
    draw_soil(s);
    visit_rocks(s, draw_rock);
    MOR_TRY(context, draw_outline(context, s));
    draw_bar(s, color == MOR_MECHANISM_STRAIN ? "plastic strain" : "displacement",
             color == MOR_MECHANISM_STRAIN ? "1" : "m");
    draw_title(s, color);
    return mor_canvas_write(context, s->canvas, path);
}

mor_status mor_mechanism_draw(mor_context *context, const mor_safety *it, mor_mechanism_color color, const char *path)
{
    sheet s = {.it = it};
    mor_colormap_init(&s.map);
    const mor_status status = draw(context, &s, color, path);
    mor_canvas_free(context, &s.canvas);
    MOR_FREE(context, &s.values);
    return status;
}
