/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/gauge_charts.h"

#include "cases/driver/gauge/gauge.h"
#include "cases/driver/gauge/gauge_table.h"
#include "cases/driver/picture/draw/ticks.h"
#include "cases/driver/picture/gauge_map_picture.h"
#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/summary/summary.h"
#include "core/io/table.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { TEXT_BYTES = 160, NAME_BYTES = MOR_CASE_NAME_BYTES + 32 };

/* What a chart of forces shows of the columns of a gauge. */
static const struct {
    int column;
    const char *name;
    mor_chart_style style;
} curves[] = {
    {MOR_GAUGE_COLUMN_FILTERED, "normal force, filtered", MOR_CHART_LINE},
    {MOR_GAUGE_COLUMN_NORMAL_SOIL, "share of the soil, mean of each interval", MOR_CHART_LINE},
    {MOR_GAUGE_COLUMN_NORMAL_BODIES, "share of bodies, mean of each interval", MOR_CHART_LINE},
    {MOR_GAUGE_COLUMN_NORMAL, "normal force, mean of each interval", MOR_CHART_DASHED}, /* over equal shares */
    {MOR_GAUGE_COLUMN_SHEAR, "shear force, mean of each interval", MOR_CHART_DASHED}};

enum { CURVES = sizeof curves / sizeof *curves };

/* Copies the finite points of a column; returns how many there are. */
static int64_t copy_column(const mor_table_data *data, int column, double *x, double *y)
{
    int64_t n = 0;
    for (int64_t row = 0; row < data->n_rows; ++row) {
        const double value = data->values[row * data->n_columns + column];
        if (isfinite(value)) {
            x[n] = data->values[row * data->n_columns];
            y[n++] = value;
        }
    }
    return n;
}

/* The largest filtered normal force and its time; by the rows it is known to have been since the row before only, the
 * summary of the run knows its time. Returns whether it is the latter. */
static bool find_peak(const mor_table_data *data, int column, const char *folder, const char *gauge, double *peak)
{
    mor_context context; /* of its own: a summary without gauges, of an earlier version, is no error */
    char path[MOR_PATH_BYTES];
    char name[NAME_BYTES];
    char unit[MOR_TICKS_TEXT_BYTES];
    double exact[2] = {NAN, NAN};
    for (int64_t row = 0; row < data->n_rows; ++row) {
        const double value = data->values[row * data->n_columns + column];
        if (value > peak[1]) {
            peak[0] = data->values[row * data->n_columns];
            peak[1] = value;
        }
    }
    mor_context_init(&context);
    if (mor_durable_file_join(&context, path, folder, MOR_SUMMARY_FILE) != MOR_OK) {
        return false;
    }
    snprintf(name, sizeof name, "gauge.%s.time_of_peak", gauge);
    mor_status status = mor_summary_read_result(&context, path, name, &exact[0], unit, sizeof unit);
    snprintf(name, sizeof name, "gauge.%s.peak_normal", gauge);
    if (status == MOR_OK) {
        status = mor_summary_read_result(&context, path, name, &exact[1], unit, sizeof unit);
    }
    if (status != MOR_OK || !isfinite(exact[0]) || !(exact[1] >= peak[1])) {
        return false; /* rows of a run that goes on may hold more */
    }
    memcpy(peak, exact, sizeof exact);
    return true;
}

/* Says what the mark on the largest filtered normal force is. */
static void name_peak(const char *unit, const double *peak, bool is_exact, char *text)
{
    char shown[MOR_TICKS_TEXT_BYTES];
    const double factor = mor_ticks_prefix(unit, fabs(peak[1]), shown);
    snprintf(text, TEXT_BYTES, "largest filtered normal force %.4g %s, %s %.4g s", factor * peak[1], shown,
             is_exact ? "at" : "by", peak[0]);
}

static mor_status find_chart(mor_context *context, const mor_case *the_case, int gauge, const char *folder, char *path)
{
    char name[NAME_BYTES];
    snprintf(name, sizeof name, "images/gauge_%s.png", the_case->gauges[gauge].name);
    return mor_durable_file_join(context, path, folder, name);
}

static mor_status draw_forces(mor_context *context, const mor_table_data *data, const mor_case *the_case, int gauge,
                              double *room, const char *folder)
{
    char filter[MOR_GAUGE_FILTER_BYTES];
    char note[TEXT_BYTES];
    const char *const notes[] = {note};
    mor_chart_series series[CURVES + 1];
    char peak_name[TEXT_BYTES];
    char title[TEXT_BYTES];
    double peak[2] = {0.0, -INFINITY};
    const int first = 1 + gauge * MOR_GAUGE_COLUMNS;
    const char *unit = the_case->dimension == 2 ? "N/m" : "N";
    int n = 0;
    for (int k = 0; k < CURVES; ++k) {
        double *x = room + 2 * (int64_t)k * data->n_rows;
        double *y = x + data->n_rows;
        const int64_t n_points = copy_column(data, first + curves[k].column, x, y);
        if (n_points > 0) {
            series[n++] = (mor_chart_series){
                .name = curves[k].name, .x = x, .y = y, .n_points = n_points, .style = curves[k].style};
        }
    }
    const bool is_exact = find_peak(data, first + MOR_GAUGE_COLUMN_LARGEST, folder, the_case->gauges[gauge].name, peak);
    if (n == 0 || !isfinite(peak[1])) {
        return MOR_OK; /* no step was taken */
    }
    name_peak(unit, peak, is_exact, peak_name);
    series[n++] = (mor_chart_series){
        .name = peak_name, .x = &peak[0], .y = &peak[1], .n_points = 1, .style = MOR_CHART_POINTS, .color_of = 1};
    mor_gauge_describe_filter(&the_case->gauges[gauge], filter);
    snprintf(note, sizeof note, "Filter: %s. Dot: of every step%s.", filter, is_exact ? "" : ", at the row after it");
    snprintf(title, sizeof title, "%.100s: gauge %s", the_case->title, the_case->gauges[gauge].name);
    const mor_chart chart = {.title = title,
                             .x_name = "time",
                             .x_unit = "s",
                             .y_name = "force",
                             .y_unit = unit,
                             .series = series,
                             .n_series = n,
                             .notes = notes,
                             .n_notes = 1};
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, find_chart(context, the_case, gauge, folder, path));
    return mor_picture_chart(context, &chart, path);
}

static mor_status draw_gauge(mor_context *context, const mor_table_data *data, const mor_case *the_case, int gauge,
                             double *room, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    char map[MOR_PATH_BYTES];
    char name[NAME_BYTES];
    MOR_TRY(context, find_chart(context, the_case, gauge, folder, path));
    MOR_TRY(context, draw_forces(context, data, the_case, gauge, room, folder));
    if (access(path, F_OK) == 0) {
        fprintf(output, "chart: %s\n", path);
    }
    snprintf(name, sizeof name, "gauge_%s_map.csv", the_case->gauges[gauge].name);
    MOR_TRY(context, mor_durable_file_join(context, map, folder, name));
    if (access(map, R_OK) != 0) {
        return MOR_OK;
    }
    snprintf(name, sizeof name, "images/gauge_%s_map.png", the_case->gauges[gauge].name);
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    bool is_drawn = false;
    MOR_TRY(context, mor_gauge_map_picture_draw(context, &the_case->gauges[gauge], map, path, &is_drawn));
    if (is_drawn) {
        fprintf(output, "chart: %s\n", path);
    }
    return MOR_OK;
}

mor_status mor_gauge_charts_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    double *room = NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_GAUGE_TABLE_FILE));
    if (the_case->n_gauges == 0 || access(path, R_OK) != 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_table_data_read(context, &data, path));
    mor_status status = MOR_OK;
    if (data.n_columns == 1 + the_case->n_gauges * MOR_GAUGE_COLUMNS && data.n_rows > 0) {
        status = MOR_NEW(context, &room, 2 * CURVES * data.n_rows, "charts of gauges");
        for (int k = 0; k < the_case->n_gauges && status == MOR_OK; ++k) {
            status = draw_gauge(context, &data, the_case, k, room, folder, output);
        }
        MOR_FREE(context, &room);
    }
    mor_table_data_clear(context, &data);
    return status;
}
