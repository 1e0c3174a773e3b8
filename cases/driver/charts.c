/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/charts.h"

#include "cases/driver/render/colormap.h"
#include "cases/driver/render/picture.h"
#include "core/base/memory.h"
#include "core/io/table.h"

#include <math.h>
#include <string.h>

/* Columns of the series before the first probe: time, step, step length, rate ratio. */
enum { FIRST_PROBE = 4, COLUMNS_MAX = 256, NAME_BYTES = 96, CURVES_MAX = MOR_COLORMAP_CATEGORIES };

/* One column's heading, taken apart: "name [unit]". */
typedef struct heading {
    char name[NAME_BYTES];
    char unit[NAME_BYTES];
} heading;

/* Takes the header line apart; returns the number of columns. */
static int split_header(const char *header, heading *headings)
{
    int n = 0;
    while (*header != '\0' && n < COLUMNS_MAX) {
        const size_t length = strcspn(header, ",\r\n");
        const char *bracket = memchr(header, '[', length);
        memset(&headings[n], 0, sizeof headings[n]);
        if (bracket != NULL) {
            snprintf(headings[n].name, NAME_BYTES, "%.*s", (int)(bracket - header - (bracket > header)), header);
            snprintf(headings[n].unit, NAME_BYTES, "%.*s", (int)(header + length - bracket - 2), bracket + 1);
        }
        ++n;
        header += length;
        header += *header != '\0';
    }
    return n;
}

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

/* The series and what has been drawn of it. */
typedef struct sheet {
    const mor_table_data *data;
    const char *folder;
    heading headings[COLUMNS_MAX];
    bool is_drawn[COLUMNS_MAX];
    double *room; /* shape [CURVES_MAX, 2, n_rows] */
} sheet;

/* One chart of the columns not yet drawn that have the unit of a first one, as many as colors tell apart. */
static mor_status draw_unit(mor_context *context, sheet *s, int first, FILE *output)
{
    const mor_table_data *data = s->data;
    mor_chart_series series[CURVES_MAX];
    char path[MOR_PATH_BYTES];
    int n = 0;
    for (int column = first; column < data->n_columns && n < CURVES_MAX; ++column) {
        if (!s->is_drawn[column] && strcmp(s->headings[column].unit, s->headings[first].unit) == 0) {
            double *x = s->room + 2 * (int64_t)n * data->n_rows;
            double *y = x + data->n_rows;
            const int64_t n_points = copy_column(data, column, x, y);
            s->is_drawn[column] = true;
            if (n_points > 0) {
                series[n++] = (mor_chart_series){s->headings[column].name, x, y, n_points, MOR_CHART_LINE};
            }
        }
    }
    if (n == 0) {
        return MOR_OK;
    }
    const char *name = series[0].name;
    series[0].name = n == 1 ? NULL : name; /* the title says it */
    const mor_chart chart = {.title = n == 1 ? name : NULL,
                             .x_name = "time",
                             .x_unit = "s",
                             .y_name = n == 1 ? name : NULL,
                             .y_unit = s->headings[first].unit,
                             .series = series,
                             .n_series = n};
    const int n_bytes = snprintf(path, sizeof path, "%s/images/chart_%s.png", s->folder, name);
    MOR_CHECK(context, n_bytes > 0 && n_bytes < (int)sizeof path, MOR_ERROR_IO, "the path of a chart is too long");
    MOR_TRY(context, mor_picture_chart(context, &chart, path));
    fprintf(output, "chart: %s\n", path);
    return MOR_OK;
}

static mor_status draw_all(mor_context *context, const mor_table_data *data, const char *folder, FILE *output)
{
    sheet s = {.data = data, .folder = folder};
    const int n_columns = split_header(data->header, s.headings);
    MOR_CHECK(context, n_columns == data->n_columns, MOR_ERROR_IO, "the series in '%s' has too many columns", folder);
    MOR_TRY(context, MOR_NEW(context, &s.room, 2 * CURVES_MAX * data->n_rows, "charts"));
    mor_status status = MOR_OK;
    for (int column = FIRST_PROBE; column < n_columns && status == MOR_OK; ++column) {
        if (!s.is_drawn[column]) {
            status = draw_unit(context, &s, column, output);
        }
    }
    MOR_FREE(context, &s.room);
    return status;
}

mor_status mor_charts_render(mor_context *context, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_TABLE_SERIES_FILE));
    MOR_TRY(context, mor_table_data_read(context, &data, path));
    const mor_status status = data.n_rows > 0 ? draw_all(context, &data, folder, output) : MOR_OK;
    mor_table_data_clear(context, &data);
    return status;
}
