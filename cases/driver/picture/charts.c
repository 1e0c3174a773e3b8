/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/charts.h"

#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/draw/ticks.h"
#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/summary/summary.h"
#include "core/io/table.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* Columns of the series before the first probe: time, step, step length, rate ratio. */
enum { FIRST_PROBE = 4, COLUMNS_MAX = 256, NAME_BYTES = 96, TEXT_BYTES = 416, CURVES_MAX = MOR_COLORMAP_CATEGORIES };

/* Of a title that names several curves. */
enum { TITLE_LETTERS = 60 };

/* Largest ratio of the sizes of two quantities on one axis: a twentieth of it still shows its course. */
#define SIZES_MOST 20.0

/* One column's heading, parsed: "name [unit]". */
typedef struct heading {
    char name[NAME_BYTES];
    char unit[NAME_BYTES];
} heading;

/* Parses the header line; returns the number of columns. */
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
    double *room;              /* shape [CURVES_MAX, 2, n_rows] */
    char path[MOR_PATH_BYTES]; /* of the summary; "": there is none */
} sheet;

/* One chart while it is put together: curves first, then the marks on them. */
typedef struct plate {
    mor_chart_series series[MOR_CHART_SERIES_MAX];
    int columns[CURVES_MAX]; /* of the curves */
    mor_summary_statistics statistics[CURVES_MAX];
    bool has_statistics[CURVES_MAX];
    int n_curves, n_series;
    char names[MOR_CHART_SERIES_MAX][TEXT_BYTES];
    double places[MOR_CHART_SERIES_MAX][2]; /* of marks: s, unit of the column */
    char texts[MOR_CHART_NOTES_MAX][TEXT_BYTES];
    const char *notes[MOR_CHART_NOTES_MAX];
    int n_notes;
} plate;

static void add_note(plate *p, const char *text)
{
    for (int k = 0; k < p->n_notes; ++k) {
        if (strcmp(p->texts[k], text) == 0) {
            return;
        }
    }
    if (p->n_notes < MOR_CHART_NOTES_MAX) {
        snprintf(p->texts[p->n_notes], TEXT_BYTES, "%s", text);
        p->notes[p->n_notes] = p->texts[p->n_notes];
        p->n_notes += 1;
    }
}

/* A summary of an earlier part of the run does not include later rows. The first row is of the start, before any force
 * has acted; statistics begin with the first step. */
static bool is_of_series(const mor_chart_series *curve, const mor_summary_statistics *it)
{
    bool is_known = true;
    for (int64_t k = curve->n_points > 1 ? 1 : 0; k < curve->n_points; ++k) {
        const bool is_inside = curve->x[k] >= it->window[0] && curve->x[k] <= it->window[1];
        const double rounding = 1.0e-9 * fmax(fabs(it->maximum), fabs(it->minimum));
        is_known = is_known &&
                   (!is_inside || (curve->y[k] <= it->maximum + rounding && curve->y[k] >= it->minimum - rounding));
    }
    return is_known;
}

/* The time of a row may differ from the end of a window by rounding. */
static const double time_rounding = 1.0e-9;

/* Whether statistics are of a part of a curve. */
static bool is_windowed(const mor_chart_series *curve, const mor_summary_statistics *it)
{
    const double last = curve->n_points > 0 ? curve->x[curve->n_points - 1] : 0.0;
    return curve->n_points > 0 && (it->window[0] > curve->x[0] || it->window[1] < last * (1.0 - time_rounding));
}

/* Probes of one quantity with several windows have one curve: each is drawn over it in its own window alone. */
static void add_windows(plate *p)
{
    for (int curve = 0; curve < p->n_curves; ++curve) {
        mor_chart_series *whole = &p->series[curve];
        const double *window = p->statistics[curve].window;
        int64_t first = 0;
        if (!p->has_statistics[curve] || !is_windowed(whole, &p->statistics[curve])) {
            continue;
        }
        while (first < whole->n_points && whole->x[first] < window[0] * (1.0 - time_rounding)) {
            ++first;
        }
        int64_t end = first;
        while (end < whole->n_points && whole->x[end] <= window[1] * (1.0 + time_rounding)) {
            ++end;
        }
        whole->style = MOR_CHART_PALE;
        add_note(p, "Pale: outside of a probe's window.");
        if (end > first) {
            mor_chart_series *part = &p->series[p->n_series++];
            *part = (mor_chart_series){.name = whole->name,
                                       .x = whole->x + first,
                                       .y = whole->y + first,
                                       .n_points = end - first,
                                       .style = MOR_CHART_LINE,
                                       .color_of = 1 + curve};
            whole->name = NULL;
        }
    }
}

/* Marks the largest value, or the smallest where that is the larger one in size, with its number and time. */
static void add_mark(plate *p, int curve, const char *name, const char *unit)
{
    const mor_summary_statistics *it = &p->statistics[curve];
    const bool is_least = fabs(it->minimum) > fabs(it->maximum);
    const double value = is_least ? it->minimum : it->maximum;
    const double time = is_least ? it->time_of_minimum : it->time_of_maximum;
    char shown[MOR_TICKS_TEXT_BYTES];
    char clock[MOR_TICKS_TEXT_BYTES];
    const double factor = mor_ticks_prefix(unit, fabs(value), shown);
    const double time_factor = mor_ticks_prefix("s", fabs(time), clock);
    const int k = p->n_series;
    const bool is_part = is_windowed(&p->series[curve], it);
    if (!isfinite(value) || !isfinite(time) || it->maximum == it->minimum || k >= MOR_CHART_SERIES_MAX) {
        return;
    }
    p->places[k][0] = time;
    p->places[k][1] = value;
    snprintf(p->names[k], TEXT_BYTES, "%s%s%s%s %.4g%s%s at %.4g %s", p->n_curves > 1 ? name : "",
             p->n_curves > 1 ? ": " : "", is_least ? "minimum" : "maximum", is_part ? " of its window" : "",
             factor * value, strcmp(unit, "1") == 0 ? "" : " ", strcmp(unit, "1") == 0 ? "" : shown, time_factor * time,
             clock);
    p->series[k] = (mor_chart_series){.name = p->names[k],
                                      .x = &p->places[k][0],
                                      .y = &p->places[k][1],
                                      .n_points = 1,
                                      .style = MOR_CHART_POINTS,
                                      .color_of = 1 + curve};
    p->n_series += 1;
}

/* How often probes were measured, once where it is the same for all. */
static void add_interval(plate *p, int curve, const char *name)
{
    const int interval = p->statistics[curve].interval;
    char text[TEXT_BYTES];
    bool is_same = true;
    for (int k = 0; k < p->n_curves; ++k) {
        is_same = is_same && (!p->has_statistics[k] || p->statistics[k].interval == interval);
    }
    if (interval > 1) {
        snprintf(text, sizeof text, "%s%seasured every %d steps.", is_same ? "" : name, is_same ? "M" : ": m",
                 interval);
        add_note(p, text);
    }
}

/* Statistics of the curves from summary.json; without one there are no marks. */
static void add_marks(const sheet *s, plate *p)
{
    mor_context quiet; /* of its own: a summary that is missing or of another time is no error */
    char remarks[CURVES_MAX][TEXT_BYTES - NAME_BYTES];
    char text[TEXT_BYTES];
    int n_marks = 0;
    for (int curve = 0; curve < p->n_curves && s->path[0] != '\0'; ++curve) {
        const char *name = s->headings[p->columns[curve]].name;
        mor_context_init(&quiet);
        p->has_statistics[curve] = mor_summary_read_statistics(&quiet, s->path, name, &p->statistics[curve],
                                                               remarks[curve], sizeof remarks[curve]) == MOR_OK &&
                                   is_of_series(&p->series[curve], &p->statistics[curve]);
    }
    add_windows(p);
    for (int curve = 0; curve < p->n_curves; ++curve) {
        const heading *it = &s->headings[p->columns[curve]];
        if (p->has_statistics[curve]) {
            const int n_before = p->n_series;
            add_mark(p, curve, it->name, it->unit);
            n_marks += p->n_series - n_before;
            add_interval(p, curve, it->name);
            if (remarks[curve][0] != '\0') {
                snprintf(text, sizeof text, "%s: %s", it->name, remarks[curve]);
                add_note(p, text);
            }
        }
    }
    if (n_marks > 0) {
        add_note(p, "Dots: of every step unless said otherwise. Lines: from row to row of series.csv, which "
                    "may miss a peak.");
    }
}

/* The largest number of a column in size; 0 where there is none. */
static double find_size(const mor_table_data *data, int column)
{
    double size = 0.0;
    for (int64_t row = 0; row < data->n_rows; ++row) {
        const double value = fabs(data->values[row * data->n_columns + column]);
        size = value > size && isfinite(value) ? value : size;
    }
    return size;
}

/* Takes a size into the range of those of a chart, unless one of them would then be a line along the axis beside
 * another. One that is zero throughout fits any. */
static bool take_size(double size, double *range)
{
    const double least = size > 0.0 && size < range[0] ? size : range[0];
    const double most = size > range[1] ? size : range[1];
    const bool fits = size == 0.0 || most <= SIZES_MOST * least;
    if (fits && size > 0.0) {
        range[0] = least;
        range[1] = most;
    }
    return fits;
}

/* The columns not yet drawn that have the unit of a first one and sizes alike, as many as colors distinguish. */
static void add_curves(sheet *s, int first, plate *p)
{
    const mor_table_data *data = s->data;
    double range[2] = {INFINITY, 0.0};
    for (int column = first; column < data->n_columns && p->n_curves < CURVES_MAX; ++column) {
        if (!s->is_drawn[column] && strcmp(s->headings[column].unit, s->headings[first].unit) == 0 &&
            take_size(find_size(data, column), range)) {
            double *x = s->room + 2 * (int64_t)p->n_curves * data->n_rows;
            double *y = x + data->n_rows;
            const int64_t n_points = copy_column(data, column, x, y);
            s->is_drawn[column] = true;
            if (n_points > 0) {
                p->series[p->n_curves] = (mor_chart_series){
                    .name = s->headings[column].name, .x = x, .y = y, .n_points = n_points, .style = MOR_CHART_LINE};
                p->columns[p->n_curves++] = column;
            }
        }
    }
    p->n_series = p->n_curves;
}

/* The names of all curves, or of as many as have room, and the number of the others. */
static void find_title(const plate *p, const sheet *s, char *title, size_t n_bytes)
{
    size_t used = 0;
    for (int k = 0; k < p->n_curves; ++k) {
        const char *name = s->headings[p->columns[k]].name;
        if (k > 0 && used + strlen(name) + 2 > TITLE_LETTERS) {
            snprintf(title + used, n_bytes - used, " and %d more", p->n_curves - k);
            return;
        }
        used += (size_t)snprintf(title + used, n_bytes - used, "%s%s", k > 0 ? ", " : "", name);
    }
}

static mor_status draw_unit(mor_context *context, sheet *s, int first, FILE *output)
{
    char path[MOR_PATH_BYTES];
    char title[TEXT_BYTES];
    plate p = {.n_curves = 0};
    add_curves(s, first, &p);
    if (p.n_curves == 0) {
        return MOR_OK;
    }
    const char *name = p.series[0].name;
    const bool is_single = p.n_curves == 1;
    p.series[0].name = is_single ? NULL : name; /* it is in the title */
    find_title(&p, s, title, sizeof title);
    add_marks(s, &p);
    const mor_chart chart = {.title = title,
                             .x_name = "time",
                             .x_unit = "s",
                             .y_name = is_single ? name : NULL,
                             .y_unit = s->headings[first].unit,
                             .series = p.series,
                             .n_series = p.n_series,
                             .notes = p.notes,
                             .n_notes = p.n_notes};
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
    MOR_TRY(context, mor_durable_file_join(context, s.path, folder, MOR_SUMMARY_FILE));
    if (access(s.path, R_OK) != 0) {
        s.path[0] = '\0';
    }
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
