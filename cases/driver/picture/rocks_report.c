/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/rocks_report.h"

#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <math.h>

enum { LINE_BYTES = 256 };

/* Line of the report by number: the head, then one per size; returns false when there are no more. */
static bool write_line(const mor_case_rocks *rocks, int dimension, int line, char *text)
{
    if (rocks->list[0] != '\0') {
        snprintf(text, LINE_BYTES, "rocks '%s': %d of %.180s", rocks->body.name, rocks->n_rocks, rocks->list);
        return line == 0;
    }
    if (line == 0) {
        int used = snprintf(text, LINE_BYTES, "rocks '%s': %d placed, content %.2f %%", rocks->body.name,
                            rocks->n_rocks, 100.0 * rocks->content_reached);
        used += rocks->count > 0 ? snprintf(text + used, (size_t)(LINE_BYTES - used), " (%d requested)", rocks->count)
                                 : snprintf(text + used, (size_t)(LINE_BYTES - used), " (requested: %.2f %%)",
                                            100.0 * rocks->content);
        if (isfinite(rocks->smallest_gap)) {
            used += snprintf(text + used, (size_t)(LINE_BYTES - used), ", smallest gap %.4g m", rocks->smallest_gap);
        }
        if (rocks->n_given_up > 0) {
            snprintf(text + used, (size_t)(LINE_BYTES - used), ", %d without a position", rocks->n_given_up);
        }
        return true;
    }
    if (line <= rocks->n_sizes) {
        const mor_case_size *size = &rocks->sizes[line - 1];
        snprintf(text, LINE_BYTES, "  up to %10.4g m %6.2f %% of their %s (requested: %.2f %%)", size->diameter,
                 100.0 * rocks->passing_reached[line - 1], dimension == 2 ? "area" : "volume", 100.0 * size->passing);
        return true;
    }
    return false;
}

void mor_rocks_report_print(const mor_case *the_case, FILE *output)
{
    for (int k = 0; k < the_case->n_rocks; ++k) {
        char text[LINE_BYTES];
        for (int line = 0; write_line(&the_case->rocks[k], the_case->dimension, line, text); ++line) {
            fprintf(output, "  %s\n", text);
        }
    }
}

void mor_rocks_report_log(mor_context *context, const mor_case *the_case)
{
    for (int k = 0; k < the_case->n_rocks; ++k) {
        char text[LINE_BYTES];
        for (int line = 0; write_line(&the_case->rocks[k], the_case->dimension, line, text); ++line) {
            mor_context_log(context, MOR_LOG_INFO, "%s", text);
        }
    }
}

/* The diameters of the rocks of an item from the smallest to the largest, and the shares up to each, half of its own
 * included: the points of a sample drawn from a curve lie on it, not above. */
static int64_t list_rocks(const mor_case *the_case, int item, double *diameter, double *passing)
{
    const mor_case_rocks *rocks = &the_case->rocks[item];
    int last = the_case->n_listed_bodies;
    double sum = 0.0;
    for (int k = 0; k <= item; ++k) {
        last += the_case->rocks[k].n_rocks;
    }
    for (int k = 0; k < rocks->n_rocks; ++k) {
        diameter[k] = the_case->bodies[last - 1 - k].packed_diameter;
        const double own = pow(diameter[k], the_case->dimension);
        passing[k] = sum + 0.5 * own;
        sum += own;
    }
    for (int k = 0; k < rocks->n_rocks; ++k) {
        passing[k] /= sum;
    }
    return rocks->n_rocks;
}

static mor_status draw_curve(mor_context *context, const mor_case *the_case, int item, const char *path)
{
    const mor_case_rocks *rocks = &the_case->rocks[item];
    double asked[2][MOR_CASE_ROCK_SIZES_MAX];
    double *room = NULL;
    MOR_TRY(context, MOR_NEW(context, &room, 2 * (int64_t)rocks->n_rocks, "chart of sizes"));
    const int64_t n_rocks = list_rocks(the_case, item, room, room + rocks->n_rocks);
    for (int k = 0; k < rocks->n_sizes; ++k) {
        asked[0][k] = rocks->sizes[k].diameter;
        asked[1][k] = rocks->sizes[k].passing;
    }
    const mor_chart_series series[2] = {
        {.name = "requested", .x = asked[0], .y = asked[1], .n_points = rocks->n_sizes, .style = MOR_CHART_LINE},
        {.name = "placed", .x = room, .y = room + rocks->n_rocks, .n_points = n_rocks, .style = MOR_CHART_POINTS},
    };
    const mor_chart chart = {.title = rocks->body.name,
                             .x_name = "diameter",
                             .x_unit = "m",
                             .y_name = "passing",
                             .series = series,
                             .n_series = 2};
    const mor_status status = mor_picture_chart(context, &chart, path);
    MOR_FREE(context, &room);
    return status;
}

mor_status mor_rocks_report_draw(mor_context *context, const mor_case *the_case, const char *folder, FILE *output)
{
    for (int k = 0; k < the_case->n_rocks; ++k) {
        const mor_case_rocks *rocks = &the_case->rocks[k];
        char name[MOR_CASE_NAME_BYTES + LINE_BYTES];
        char path[MOR_PATH_BYTES];
        if (rocks->n_sizes < 2 || rocks->n_rocks == 0) { /* a table has no curve */
            continue;
        }
        snprintf(name, sizeof name, "images/rocks_%s.png", rocks->body.name);
        MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
        MOR_TRY(context, draw_curve(context, the_case, k, path));
        if (output != NULL) {
            fprintf(output, "chart: %s\n", path);
        }
    }
    return MOR_OK;
}
