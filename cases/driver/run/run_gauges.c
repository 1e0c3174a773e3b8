/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_gauges.h"

#include "cases/driver/run/run_warnings.h"
#include "cases/driver/scene/simulation.h"

#include <math.h>
#include <string.h>

/* ---- Over time --------------------------------------------------------------------------------------------------- */

/* What a row says of a gauge, in the order of its columns. */
static const struct {
    const char *suffix, *unit, *unit_plane;
} columns[MOR_GAUGE_COLUMNS] = {{"normal", "N", "N/m"},          {"normal_soil", "N", "N/m"},
                                {"normal_bodies", "N", "N/m"},   {"shear", "N", "N/m"},
                                {"moment", "N m", "N"},          {"height", "m", "m"},
                                {"normal_filtered", "N", "N/m"}, {"normal_largest", "N", "N/m"}};

mor_status mor_run_gauges_open(mor_context *context, mor_run_gauges *it, const mor_case *the_case, const char *folder,
                               bool is_resume, double time)
{
    enum { MOST = 1 + MOR_CASE_GAUGES_MAX * MOR_GAUGE_COLUMNS };
    mor_table_column table[MOST];
    char path[MOR_PATH_BYTES];
    int n = 0;
    if (the_case->n_gauges == 0) {
        return MOR_OK;
    }
    table[n++] = (mor_table_column){"time", "s"};
    for (int k = 0; k < the_case->n_gauges; ++k) {
        for (int j = 0; j < MOR_GAUGE_COLUMNS; ++j) {
            char *name = it->names[n - 1];
            snprintf(name, MOR_RUN_GAUGE_NAME_BYTES, "%s_%s", the_case->gauges[k].name, columns[j].suffix);
            table[n++] = (mor_table_column){name, the_case->dimension == 2 ? columns[j].unit_plane : columns[j].unit};
        }
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_GAUGE_TABLE_FILE));
    return is_resume ? mor_table_resume(context, &it->table, path, table, n, time)
                     : mor_table_create(context, &it->table, path, table, n);
}

mor_status mor_run_gauges_add_row(mor_context *context, mor_run_gauges *it, mor_gauges *gauges, double time)
{
    double row[1 + MOR_CASE_GAUGES_MAX * MOR_GAUGE_COLUMNS];
    if (it->table.stream == NULL) {
        return MOR_OK;
    }
    row[0] = time;
    for (int k = 0; k < gauges->n; ++k) {
        double *cells = row + 1 + k * MOR_GAUGE_COLUMNS;
        mor_gauge *gauge = &gauges->of[k];
        mor_gauge_reading mean;
        mor_gauge_reading filtered = {.normal = NAN};
        mor_gauge_take_row(gauge, time, &mean, &cells[MOR_GAUGE_COLUMN_LARGEST]);
        if (gauge->numbers[MOR_GAUGE_STEPS] > 0.0) {
            mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_FILTERED, &filtered);
        }
        cells[MOR_GAUGE_COLUMN_NORMAL] = mean.normal;
        cells[MOR_GAUGE_COLUMN_NORMAL_SOIL] = mean.of_source[MOR_GAUGE_SOIL];
        cells[MOR_GAUGE_COLUMN_NORMAL_BODIES] = mean.of_source[MOR_GAUGE_BODIES];
        cells[MOR_GAUGE_COLUMN_SHEAR] = mean.shear;
        cells[MOR_GAUGE_COLUMN_MOMENT] = mean.moment;
        cells[MOR_GAUGE_COLUMN_HEIGHT] = mean.height;
        cells[MOR_GAUGE_COLUMN_FILTERED] = filtered.normal;
    }
    return mor_table_append(context, &it->table, row);
}

mor_status mor_run_gauges_sync(mor_context *context, mor_run_gauges *it)
{
    return it->table.stream != NULL ? mor_table_sync(context, &it->table) : MOR_OK;
}

void mor_run_gauges_close(mor_context *context, mor_run_gauges *it)
{
    if (it->table.stream != NULL) {
        mor_table_close(context, &it->table);
    }
}

/* ---- At the end -------------------------------------------------------------------------------------------------- */

static void print_cell(FILE *stream, double value)
{
    if (isfinite(value)) {
        fprintf(stream, ",%.9g", value);
    } else {
        fputc(',', stream); /* nothing was measured */
    }
}

static void write_peaks(const mor_gauges *gauges, FILE *stream)
{
    const bool is_plane = gauges->simulation->the_case->dimension == 2;
    const char *force = is_plane ? "N/m" : "N";
    const char *moment = is_plane ? "N" : "N m";
    const char *impulse = is_plane ? "N s/m" : "N s";
    fprintf(stream,
            "gauge,structure,filter,peak_normal [%s],time [s],soil_at_peak [%s],bodies_at_peak [%s],"
            "height_at_peak [m],peak_shear [%s],time_of_shear [s],peak_moment [%s],time_of_moment [s],"
            "peak_of_single_steps [%s],time_of_it [s],last_normal [%s],impulse_soil [%s],impulse_bodies [%s]\n",
            force, force, force, force, moment, force, force, impulse, impulse);
    for (int k = 0; k < gauges->n; ++k) {
        const mor_gauge *gauge = &gauges->of[k];
        char filter[MOR_GAUGE_FILTER_BYTES];
        mor_gauge_reading last;
        mor_gauge_reading sums;
        mor_gauge_describe_filter(gauge->asked, filter);
        mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_FILTERED, &last);
        mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_SUM, &sums);
        fprintf(stream, "%s,%s,%s", gauge->asked->name, gauge->wall >= 0 ? gauge->asked->wall : gauge->asked->body,
                filter);
        for (int i = 0; i < MOR_GAUGE_PEAKS; ++i) {
            print_cell(stream, gauge->numbers[MOR_GAUGE_PEAK + i]);
        }
        print_cell(stream, gauge->numbers[MOR_GAUGE_STEPS] > 0.0 ? last.normal : NAN);
        print_cell(stream, sums.of_source[MOR_GAUGE_SOIL]);
        print_cell(stream, sums.of_source[MOR_GAUGE_BODIES]);
        fputc('\n', stream);
    }
}

/* What summary.json tells of a gauge; where: in its numbers, and whether that is filtered. */
typedef struct gauge_result {
    const char *suffix, *unit, *unit_plane;
    int at;
    bool is_filtered;
} gauge_result;

enum { LAST = -1, IMPULSE_SOIL = -2, IMPULSE_BODIES = -3 };

static const gauge_result gauge_results[MOR_RUN_GAUGE_RESULTS] = {
    {"peak_normal", "N", "N/m", MOR_GAUGE_PEAK_NORMAL, true},
    {"time_of_peak", "s", "s", MOR_GAUGE_PEAK_TIME, true},
    {"soil_at_peak", "N", "N/m", MOR_GAUGE_PEAK_SOIL, true},
    {"bodies_at_peak", "N", "N/m", MOR_GAUGE_PEAK_BODIES, true},
    {"height_at_peak", "m", "m", MOR_GAUGE_PEAK_HEIGHT, true},
    {"peak_shear", "N", "N/m", MOR_GAUGE_PEAK_SHEAR, true},
    {"time_of_shear", "s", "s", MOR_GAUGE_PEAK_SHEAR_TIME, true},
    {"peak_moment", "N m", "N", MOR_GAUGE_PEAK_MOMENT, true},
    {"time_of_moment", "s", "s", MOR_GAUGE_PEAK_MOMENT_TIME, true},
    {"peak_of_single_steps", "N", "N/m", MOR_GAUGE_PEAK_SINGLE, false},
    {"time_of_single_steps", "s", "s", MOR_GAUGE_PEAK_SINGLE_TIME, false},
    {"last_normal", "N", "N/m", LAST, true},
    {"impulse_soil", "N s", "N s/m", IMPULSE_SOIL, false},
    {"impulse_bodies", "N s", "N s/m", IMPULSE_BODIES, false}};

static double read_result(const mor_gauge *gauge, int at)
{
    mor_gauge_reading it;
    if (at >= 0) {
        return gauge->numbers[MOR_GAUGE_PEAK + at];
    }
    mor_gauge_read(gauge, gauge->numbers + (at == LAST ? MOR_GAUGE_FILTERED : MOR_GAUGE_SUM), &it);
    const double last = gauge->numbers[MOR_GAUGE_STEPS] > 0.0 ? it.normal : NAN;
    return at == LAST ? last : it.of_source[at == IMPULSE_SOIL ? MOR_GAUGE_SOIL : MOR_GAUGE_BODIES];
}

int mor_run_gauges_results(const mor_gauges *gauges, mor_run_gauge_texts *texts, mor_summary_result *results)
{
    const bool is_plane = gauges->n > 0 && gauges->simulation->the_case->dimension == 2;
    int n = 0;
    for (int k = 0; k < gauges->n; ++k) {
        const mor_gauge *gauge = &gauges->of[k];
        char filter[MOR_GAUGE_FILTER_BYTES];
        mor_gauge_describe_filter(gauge->asked, filter);
        snprintf(texts->filters[k], sizeof texts->filters[k], "filter: %s", filter);
        for (const gauge_result *row = gauge_results; row < gauge_results + MOR_RUN_GAUGE_RESULTS; ++row) {
            snprintf(texts->names[n], sizeof texts->names[n], "gauge.%s.%s", gauge->asked->name, row->suffix);
            results[n] = (mor_summary_result){.probe = texts->names[n],
                                              .value = read_result(gauge, row->at),
                                              .unit = is_plane ? row->unit_plane : row->unit,
                                              .remark = row->is_filtered ? texts->filters[k] : NULL};
            n += 1;
        }
    }
    return n;
}

static void write_map(const mor_simulation *s, const mor_gauge *gauge, FILE *stream)
{
    const mor_gauge_map *map = &gauge->map;
    const int64_t cells = mor_gauge_map_cells(map);
    fprintf(stream,
            "across [m],up [m],x [m],y [m],z [m],peak_soil [Pa],time_soil [s],last_soil [Pa],peak_bodies [Pa],"
            "time_bodies [s],covered [%s]\n",
            s->the_case->dimension == 2 ? "m" : "m2");
    for (int64_t k = 0; k < cells; ++k) {
        double plane[2];
        double placed[3];
        double point[3];
        mor_gauge_map_place(map, k, plane);
        for (int a = 0; a < 3; ++a) {
            placed[a] = gauge->origin[a] + plane[0] * map->across[a] + plane[1] * map->up[a];
        }
        mor_simulation_take_point_back(s->the_case, placed, point);
        fprintf(stream, "%.9g,%.9g,%.9g,%.9g,%.9g", plane[0], plane[1], point[0], point[1], point[2]);
        print_cell(stream, mor_gauge_map_pressure(map, k, map->peak[k]));
        print_cell(stream, map->time[k]);
        print_cell(stream, mor_gauge_map_pressure(map, k, map->filtered[k]));
        print_cell(stream, map->peak[cells + k] / map->area);
        print_cell(stream, map->time[cells + k]);
        print_cell(stream, map->covered[k]);
        fputc('\n', stream);
    }
}

mor_status mor_run_gauges_conclude(mor_context *context, const mor_gauges *gauges, const char *folder)
{
    char path[MOR_PATH_BYTES];
    char name[MOR_RUN_GAUGE_NAME_BYTES];
    mor_durable_file file;
    if (gauges->n == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_GAUGE_PEAKS_FILE));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    write_peaks(gauges, file.stream);
    MOR_TRY(context, mor_durable_file_commit(context, &file));
    for (int k = 0; k < gauges->n; ++k) {
        if (mor_gauge_map_cells(&gauges->of[k].map) > 0) {
            snprintf(name, sizeof name, "gauge_%s_map.csv", gauges->of[k].asked->name);
            MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
            MOR_TRY(context, mor_durable_file_open(context, &file, path));
            write_map(gauges->simulation, &gauges->of[k], file.stream);
            MOR_TRY(context, mor_durable_file_commit(context, &file));
        }
    }
    return MOR_OK;
}

/* The peak of a gauge before the last tenth of its table, and when that was; NaN where no row is that early. */
static double find_early_peak(const mor_table_data *data, int gauge, double *until)
{
    const double *times = data->values;
    const int column = 1 + gauge * MOR_GAUGE_COLUMNS + MOR_GAUGE_COLUMN_LARGEST;
    const double first = times[0];
    const double last = times[(data->n_rows - 1) * data->n_columns];
    double peak = NAN;
    for (int64_t row = 0; row < data->n_rows; ++row) {
        const double time = times[row * data->n_columns];
        if (time <= last - 0.1 * (last - first)) {
            peak = fmax(peak, times[row * data->n_columns + column]);
            *until = time;
        }
    }
    return peak;
}

mor_status mor_run_gauges_warn(mor_context *context, const mor_gauges *gauges, const char *folder)
{
    const double growth = 0.02;
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    if (gauges->n == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_GAUGE_TABLE_FILE));
    MOR_TRY(context, mor_table_data_read(context, &data, path));
    for (int k = 0; k < gauges->n && data.n_rows > 0; ++k) {
        const double *peaks = gauges->of[k].numbers + MOR_GAUGE_PEAK;
        double until = NAN;
        const double early = find_early_peak(&data, k, &until);
        const double risen = peaks[MOR_GAUGE_PEAK_NORMAL] - early;
        mor_gauge_reading impulse;
        mor_gauge_read(&gauges->of[k], gauges->of[k].numbers + MOR_GAUGE_SUM, &impulse);
        if (impulse.normal < 0.0) {
            mor_context_log(context, MOR_LOG_WARNING,
                            MOR_RUN_WARNING_AT_END
                            "the force on gauge '%s' acts against its direction, with an impulse of %.5g %s: its peak "
                            "is the smallest load, not the largest; reverse 'direction' of the gauge",
                            gauges->of[k].asked->name, impulse.normal,
                            gauges->simulation->the_case->dimension == 2 ? "N s/m" : "N s");
        } else if (risen > growth * peaks[MOR_GAUGE_PEAK_NORMAL]) {
            mor_context_log(context, MOR_LOG_WARNING,
                            MOR_RUN_WARNING_AT_END
                            "the load on gauge '%s' was still growing: its peak of %.5g %s at %.4g s was %.5g until "
                            "%.3g s. The largest load may come later: let the run go on with a later 'end', or take "
                            "the peak for a lower bound",
                            gauges->of[k].asked->name, peaks[MOR_GAUGE_PEAK_NORMAL],
                            gauges->simulation->the_case->dimension == 2 ? "N/m" : "N", peaks[MOR_GAUGE_PEAK_TIME],
                            early, until);
        }
    }
    mor_table_data_clear(context, &data);
    return MOR_OK;
}

static void print_number(FILE *out, double value)
{
    if (isfinite(value)) {
        fprintf(out, " %11.5g", value);
    } else {
        fprintf(out, " %11s", "-");
    }
}

void mor_run_gauges_print(const mor_gauges *gauges, FILE *out)
{
    static const int shown[] = {MOR_GAUGE_PEAK_NORMAL, MOR_GAUGE_PEAK_TIME,   MOR_GAUGE_PEAK_SOIL,
                                MOR_GAUGE_PEAK_BODIES, MOR_GAUGE_PEAK_HEIGHT, MOR_GAUGE_PEAK_SHEAR,
                                MOR_GAUGE_PEAK_MOMENT, MOR_GAUGE_PEAK_SINGLE};
    const bool is_plane = gauges->n > 0 && gauges->simulation->the_case->dimension == 2;
    if (gauges->n == 0) {
        return;
    }
    fprintf(out, "\n%-22s %11s %11s %11s %11s %11s %11s %11s %11s %11s  %s\n", "gauge, peaks", "normal", "at time",
            "by soil", "by bodies", "at height", "shear", "moment", "one step", "last normal", "filter");
    for (int k = 0; k < gauges->n; ++k) {
        const mor_gauge *gauge = &gauges->of[k];
        char filter[MOR_GAUGE_FILTER_BYTES];
        mor_gauge_reading last;
        mor_gauge_describe_filter(gauge->asked, filter);
        mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_FILTERED, &last);
        fprintf(out, "%-22s", gauge->asked->name);
        for (size_t i = 0; i < sizeof shown / sizeof *shown; ++i) {
            print_number(out, gauge->numbers[MOR_GAUGE_PEAK + shown[i]]);
        }
        print_number(out, gauge->numbers[MOR_GAUGE_STEPS] > 0.0 ? last.normal : NAN);
        fprintf(out, "  %s\n", filter);
    }
    fprintf(out,
            "forces in %s, moments in %s, times in s, heights in m; all filtered but for 'one step', the largest "
            "normal force of a single step; over time: " MOR_GAUGE_TABLE_FILE "\n",
            is_plane ? "N/m" : "N", is_plane ? "N" : "N m");
}
