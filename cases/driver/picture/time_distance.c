/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/time_distance.h"

#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/table.h"

#include <math.h>
#include <string.h>

/* Columns of series.csv before the first probe, and most curves that colors distinguish. */
enum { FIRST_PROBE = 4, CURVES_MAX = 8, LABEL_BYTES = MOR_CASE_NAME_BYTES + 48 };

static bool is_shown(const mor_case_probe *probe)
{
    return strcmp(probe->type, "run_out") == 0 && probe->n_path > 0;
}

/* What a curve is, in words. */
static void name_curve(const mor_case_probe *probe, char *text)
{
    if (strcmp(probe->measure, "thickness") == 0) {
        snprintf(text, LABEL_BYTES, "%s: edge of the deposit", probe->name);
    } else {
        snprintf(text, LABEL_BYTES, "%s: %g %% of the mass", probe->name, probe->percentile);
    }
}

static mor_status draw(mor_context *context, const mor_table_data *data, const mor_case *the_case, double *room,
                       const char *path)
{
    mor_chart_series series[CURVES_MAX];
    char names[CURVES_MAX][LABEL_BYTES];
    int n = 0;
    for (int k = 0; k < the_case->n_probes && n < CURVES_MAX; ++k) {
        double *x = room + 2 * (int64_t)n * data->n_rows;
        double *y = x + data->n_rows;
        int64_t n_points = 0;
        for (int64_t row = 0; row < data->n_rows && is_shown(&the_case->probes[k]); ++row) {
            const double *cells = data->values + row * data->n_columns;
            if (isfinite(cells[FIRST_PROBE + k])) {
                x[n_points] = cells[FIRST_PROBE + k];
                y[n_points++] = cells[0];
            }
        }
        if (n_points > 0) {
            name_curve(&the_case->probes[k], names[n]);
            series[n] =
                (mor_chart_series){.name = names[n], .x = x, .y = y, .n_points = n_points, .style = MOR_CHART_LINE};
            n += 1;
        }
    }
    const mor_chart chart = {.title = "time and distance along the path",
                             .x_name = "level distance along the path",
                             .x_unit = "m",
                             .y_name = "time",
                             .y_unit = "s",
                             .series = series,
                             .n_series = n,
                             .has_margin = true};
    return n > 0 ? mor_picture_chart(context, &chart, path) : MOR_OK;
}

mor_status mor_time_distance_render(mor_context *context, const mor_case *the_case, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    double *room = NULL;
    bool is_any = false;
    for (int k = 0; k < the_case->n_probes; ++k) {
        is_any = is_any || is_shown(&the_case->probes[k]);
    }
    if (!is_any) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_TABLE_SERIES_FILE));
    MOR_TRY(context, mor_table_data_read(context, &data, path));
    mor_status status = MOR_OK;
    if (data.n_columns == FIRST_PROBE + the_case->n_probes && data.n_rows > 0) {
        status = MOR_NEW(context, &room, 2 * CURVES_MAX * data.n_rows, "a chart");
        if (status == MOR_OK) {
            status = mor_durable_file_join(context, path, folder, "images/time_distance.png");
        }
        if (status == MOR_OK) {
            status = draw(context, &data, the_case, room, path);
        }
        if (status == MOR_OK) {
            fprintf(output, "chart: %s\n", path);
        }
        MOR_FREE(context, &room);
    }
    mor_table_data_clear(context, &data);
    return status;
}
