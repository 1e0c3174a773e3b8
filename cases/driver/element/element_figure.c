/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_figure.h"

#include "cases/driver/picture/draw/canvas.h"
#include "cases/driver/picture/draw/chart.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { PANELS = 4, WIDTH = 1200, HEIGHT = 800, SERIES_MAX = MOR_ELEMENT_SPECIMENS_MAX + 1 };

/* What is smaller counts as zero, so that rounding does not fill a chart. */
static const double smallest_strain = 1e-9;
static const double smallest_stress = 1e-3; /* Pa */

/* And a number that changes by less than this part of its size counts as constant. */
static const double smallest_change = 1e-7;

/* One chart of the figure. */
typedef struct panel {
    int x, y; /* columns */
    const char *x_name, *y_name;
    bool is_log; /* x on a logarithmic axis */
} panel;

static const panel axial_panels[PANELS] = {
    {MOR_ELEMENT_EPS_Q, MOR_ELEMENT_Q, "deviatoric strain", "deviatoric stress q", false},
    {MOR_ELEMENT_P, MOR_ELEMENT_Q, "mean stress p", "deviatoric stress q", false},
    {MOR_ELEMENT_EPS_Q, MOR_ELEMENT_EPS_V, "deviatoric strain", "volumetric strain (compression > 0)", false},
    {MOR_ELEMENT_P, MOR_ELEMENT_VOID_RATIO, "mean stress p", "void ratio e", true}};

static const panel shear_panels[PANELS] = {
    {MOR_ELEMENT_SHEAR_STRAIN, MOR_ELEMENT_SHEAR_STRESS, "shear strain", "shear stress", false},
    {MOR_ELEMENT_NORMAL_STRESS, MOR_ELEMENT_SHEAR_STRESS, "normal stress (compression > 0)", "shear stress", false},
    {MOR_ELEMENT_SHEAR_STRAIN, MOR_ELEMENT_EPS_V, "shear strain", "volumetric strain (compression > 0)", false},
    {MOR_ELEMENT_P, MOR_ELEMENT_VOID_RATIO, "mean stress p", "void ratio e", true}};

/* The second one is the circle of Mohr. */
static const panel spin_panels[PANELS] = {
    {MOR_ELEMENT_TIME, MOR_ELEMENT_SHEAR_STRESS, "time", "shear stress", false},
    {MOR_ELEMENT_NORMAL_STRESS, MOR_ELEMENT_SHEAR_STRESS, "normal stress (compression > 0)", "shear stress", false},
    {MOR_ELEMENT_TIME, MOR_ELEMENT_Q, "time", "deviatoric stress q", false},
    {MOR_ELEMENT_TIME, MOR_ELEMENT_P, "time", "mean stress p", false}};

static const panel *const panels_of[] = {
    [MOR_ELEMENT_AXIAL] = axial_panels, [MOR_ELEMENT_SHEAR] = shear_panels, [MOR_ELEMENT_ROTATION] = spin_panels};

/* The figure while it is put together. */
typedef struct sheet {
    mor_context *context;
    const mor_element_settings *settings;
    const mor_element_record *tables[SERIES_MAX]; /* shape [n_tables] */
    int n_tables;
    bool has_data;                        /* the last table is drawn as points */
    int n_without;                        /* charts without a point of it */
    bool is_missing[MOR_ELEMENT_COLUMNS]; /* columns that it would need there */
    double *room;                         /* shape [n_tables, 2, most rows] */
    int64_t most_rows;
    uint8_t *pixels; /* shape [HEIGHT, WIDTH, 3] */
    mor_canvas *canvas;
} sheet;

static double find_largest(const sheet *s, int column)
{
    double largest = 0.0;
    for (int t = 0; t < s->n_tables; ++t) {
        const mor_element_record *table = s->tables[t];
        for (int64_t i = 0; i < table->n_rows; ++i) {
            const double value = fabs(table->values[i * table->n_columns + column]);
            largest = value > largest ? value : largest;
        }
    }
    return largest;
}

/* A value as it is drawn: a multiple of what counts as a change. */
static double round_value(double value, double largest, int column)
{
    const char *unit = NULL;
    mor_element_column_name(column, &unit);
    const double smallest = strcmp(unit, "Pa") == 0 ? smallest_stress : smallest_strain;
    const double step = fmax(smallest, smallest_change * largest);
    return step * nearbyint(value / step);
}

/* The points of a table that can be drawn; returns how many there are. What stays in its place is one point. */
static int64_t list_points(const sheet *s, const panel *p, const mor_element_record *table, double *x, double *y)
{
    const double y_factor = p->y == MOR_ELEMENT_FRICTION_ANGLE ? 180.0 / MOR_PI : 1.0; /* drawn in degrees */
    const double largest[2] = {find_largest(s, p->x), find_largest(s, p->y)};
    int64_t n = 0;
    for (int64_t i = 0; i < table->n_rows; ++i) {
        const double *row = table->values + i * table->n_columns;
        const double found[2] = {round_value(row[p->x], largest[0], p->x), round_value(row[p->y], largest[1], p->y)};
        const bool is_repeated = n > 0 && found[0] == x[n - 1] && y_factor * found[1] == y[n - 1];
        if (isfinite(found[0]) && isfinite(found[1]) && (!p->is_log || found[0] > 0.0) && !is_repeated) {
            x[n] = found[0];
            y[n++] = y_factor * found[1];
        }
    }
    return n;
}

static bool has_column(const sheet *s, int column)
{
    bool is_known = true;
    for (int t = 0; t < s->n_tables - (s->has_data ? 1 : 0); ++t) {
        const mor_element_record *table = s->tables[t];
        is_known = is_known && table->n_rows > 0 && isfinite(table->values[column]);
    }
    return is_known;
}

/* Whether the measured values have a number in a column. */
static bool is_measured(const sheet *s, int column)
{
    const mor_element_record *data = s->tables[s->n_tables - 1];
    bool is_found = false;
    for (int64_t i = 0; i < data->n_rows && !is_found; ++i) {
        is_found = isfinite(data->values[i * data->n_columns + column]);
    }
    return is_found;
}

/* The columns that a chart has for these tables. Where the volume stays, what happens with it is seen in the stress. */
static void choose_columns(const sheet *s, panel *p)
{
    if (s->settings->path != NULL && mor_element_path_keeps_volume(s->settings->path)) {
        const bool is_axial = s->settings->path->measure == MOR_ELEMENT_AXIAL;
        if (p->y == MOR_ELEMENT_EPS_V) {
            p->y = MOR_ELEMENT_P;
            p->y_name = "mean stress p";
        } else if (p->y == MOR_ELEMENT_VOID_RATIO) {
            *p = (panel){is_axial ? MOR_ELEMENT_EPS_Q : MOR_ELEMENT_SHEAR_STRAIN, MOR_ELEMENT_FRICTION_ANGLE,
                         is_axial ? "deviatoric strain" : "shear strain", "mobilized friction", false};
        }
    }
    if (p->y == MOR_ELEMENT_VOID_RATIO && !has_column(s, p->y)) {
        p->y = MOR_ELEMENT_EPS_V;
        p->y_name = "volumetric strain (compression > 0)";
    }
    /* Without the change of volume the axial strain alone is known of a drained specimen. */
    if (p->x == MOR_ELEMENT_EPS_Q && s->has_data && !is_measured(s, p->x) && is_measured(s, MOR_ELEMENT_AXIAL_STRAIN)) {
        p->x = MOR_ELEMENT_AXIAL_STRAIN;
        p->x_name = "axial strain";
    }
}

static void note_without(sheet *s, const panel *p)
{
    const int columns[2] = {p->x, p->y};
    s->n_without += 1;
    for (int k = 0; k < 2; ++k) {
        s->is_missing[columns[k]] = s->is_missing[columns[k]] || !is_measured(s, columns[k]);
    }
}

/* Points that are nowhere to be seen would be taken for points under a curve. */
static void warn_without(const sheet *s)
{
    char all[512] = "";
    for (int k = 0; k < MOR_ELEMENT_COLUMNS && s->n_without > 0; ++k) {
        const char *unit = NULL;
        const char *name = mor_element_column_name(k, &unit);
        const size_t used = strlen(all);
        if (s->is_missing[k]) {
            snprintf(all + used, sizeof all - used, "%s'%s%s'", used > 0 ? ", " : "", name,
                     strcmp(unit, "Pa") == 0       ? " [kPa]"
                     : k == MOR_ELEMENT_VOID_RATIO ? ""
                     : strcmp(unit, "s") == 0      ? " [s]"
                                                   : " [%]");
        }
    }
    if (all[0] != '\0') {
        mor_context_log(s->context, MOR_LOG_WARNING,
                        "%s: its points are missing in %d of the %d charts, which need %s; give these columns to see "
                        "the points there",
                        s->tables[s->n_tables - 1]->name, s->n_without, PANELS, all);
    }
}

static void paste_chart(sheet *s, const mor_canvas *chart, int place)
{
    const int size[2] = {WIDTH, HEIGHT};
    for (int row = 0; row < HEIGHT; ++row) {
        for (int column = 0; column < WIDTH; ++column) {
            mor_canvas_pixel(chart, column, row, s->pixels + 3 * ((size_t)row * WIDTH + (size_t)column));
        }
    }
    mor_canvas_paste(s->canvas, place % 2 * WIDTH, place / 2 * HEIGHT, size, s->pixels);
}

static mor_status draw_panel(sheet *s, panel p, int place)
{
    mor_chart_series series[SERIES_MAX];
    mor_canvas *drawn = NULL;
    const char *x_unit = NULL;
    const char *y_unit = NULL;
    char title[2 * MOR_ELEMENT_NAME_BYTES];
    int n = 0;
    choose_columns(s, &p);
    for (int t = 0; t < s->n_tables; ++t) {
        double *x = s->room + 2 * t * s->most_rows;
        double *y = x + s->most_rows;
        const int64_t n_points = list_points(s, &p, s->tables[t], x, y);
        const bool is_data = s->has_data && t == s->n_tables - 1;
        if (n_points > 0) {
            series[n++] = (mor_chart_series){.name = s->tables[t]->name,
                                             .x = x,
                                             .y = y,
                                             .n_points = n_points,
                                             .style = is_data ? MOR_CHART_POINTS : MOR_CHART_LINE};
        } else if (is_data) {
            note_without(s, &p);
        }
    }
    if (n == 0) { /* a mean stress that is a tension throughout */
        return MOR_OK;
    }
    mor_element_column_name(p.x, &x_unit);
    mor_element_column_name(p.y, &y_unit);
    snprintf(title, sizeof title, "%s: %s", s->tables[0]->material->name, s->settings->name);
    const mor_chart chart = {.title = title,
                             .x_name = p.x_name,
                             .x_unit = x_unit,
                             .y_name = p.y_name,
                             .y_unit = p.y == MOR_ELEMENT_FRICTION_ANGLE ? "deg" : y_unit,
                             .has_log_x = p.is_log,
                             .has_margin = true,
                             .series = series,
                             .n_series = n,
                             .width = WIDTH,
                             .height = HEIGHT};
    MOR_TRY(s->context, mor_chart_draw(s->context, &chart, &drawn));
    paste_chart(s, drawn, place);
    mor_canvas_free(s->context, &drawn);
    return MOR_OK;
}

static mor_status draw_figure(sheet *s, const char *path)
{
    const mor_element_measure measure = s->settings->path != NULL ? s->settings->path->measure : MOR_ELEMENT_AXIAL;
    MOR_TRY(s->context, mor_canvas_new(s->context, &s->canvas, 2 * WIDTH, 2 * HEIGHT));
    MOR_TRY(s->context, MOR_NEW(s->context, &s->room, 2 * s->n_tables * s->most_rows, "curves of a figure"));
    MOR_TRY(s->context, MOR_NEW(s->context, &s->pixels, (int64_t)3 * WIDTH * HEIGHT, "pixels of a figure"));
    for (int k = 0; k < PANELS; ++k) {
        MOR_TRY(s->context, draw_panel(s, panels_of[measure][k], k));
    }
    warn_without(s);
    return mor_canvas_write(s->context, s->canvas, path);
}

mor_status mor_element_figure_write(mor_context *context, const mor_element_settings *settings,
                                    const mor_element_record *records, int n_records, const mor_element_record *data,
                                    const char *path)
{
    sheet s = {.context = context, .settings = settings, .most_rows = 1};
    for (int k = 0; k < n_records; ++k) {
        s.tables[s.n_tables++] = &records[k];
    }
    if (data != NULL) {
        s.tables[s.n_tables++] = data;
        s.has_data = true;
    }
    for (int k = 0; k < s.n_tables; ++k) {
        s.most_rows = s.tables[k]->n_rows > s.most_rows ? s.tables[k]->n_rows : s.most_rows;
    }
    const mor_status status = draw_figure(&s, path);
    MOR_FREE(context, &s.room);
    MOR_FREE(context, &s.pixels);
    mor_canvas_free(context, &s.canvas);
    return status;
}
