/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_charts.h"

#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/view/picture.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <math.h>
#include <string.h>

/* A family: groups that differ in the variable of the chart alone. As many as there are colors to tell them apart. */
enum { FAMILIES_MAX = MOR_COLORMAP_CATEGORIES, TEXT_BYTES = 256, ARRAYS = 4 };

/* One chart while it is made. */
typedef struct sheet {
    mor_sweep_table *table;
    int column, variable;
    int families[FAMILIES_MAX]; /* shape [n_families]; first group of each */
    int n_families;
    int n_left_out; /* families */
    mor_chart_series series[2 * FAMILIES_MAX];
    int n_series;
    char names[FAMILIES_MAX][TEXT_BYTES];
    double *dots;       /* shape [families, 2, n_members]: x, y of members */
    double *means;      /* shape [families, ARRAYS, n_groups]: x, mean, low, high of groups */
    double *parts;      /* shape [n_groups]; 1: another group has all that this one has, and more; else 0 */
    int64_t n_dots;     /* in all */
    double first, last; /* smallest and largest x */
} sheet;

/* ---- Families ---------------------------------------------------------------------------------------------------- */

/* Whether a group belongs to the family of another. Where a variable has no meaning for one of them, it tells them not
 * apart. */
static bool is_family(const mor_sweep_design *design, int group, int other, int variable, bool is_strict)
{
    const int n = design->sweep->n_variables;
    for (int v = 0; v < n; ++v) {
        const int a = design->choices[(int64_t)design->firsts[group] * n + v];
        const int b = design->choices[(int64_t)design->firsts[other] * n + v];
        const bool has_both = a >= 0 && b >= 0;
        if (v != variable && mor_sweep_design_is_factor(design->sweep, v) && (is_strict || has_both) && a != b) {
            return false;
        }
    }
    return true;
}

/* Whether another group has all that this one has, and more. */
static bool is_part(const mor_sweep_design *design, int group, int variable)
{
    const int n = design->sweep->n_variables;
    for (int other = 0; other < design->n_groups; ++other) {
        bool has_more = false;
        for (int v = 0; v < n; ++v) {
            has_more = has_more || (v != variable && mor_sweep_design_is_factor(design->sweep, v) &&
                                    design->choices[(int64_t)design->firsts[group] * n + v] < 0 &&
                                    design->choices[(int64_t)design->firsts[other] * n + v] >= 0);
        }
        if (has_more && is_family(design, group, other, variable, false)) {
            return true;
        }
    }
    return false;
}

static void find_families(sheet *s)
{
    const mor_sweep_design *design = s->table->design;
    for (int g = 0; g < design->n_groups; ++g) {
        s->parts[g] = is_part(design, g, s->variable) ? 1.0 : 0.0;
        bool is_new = s->parts[g] == 0.0;
        for (int other = 0; other < g && is_new; ++other) {
            is_new = s->parts[other] == 1.0 || !is_family(design, g, other, s->variable, true);
        }
        if (is_new && s->n_families < FAMILIES_MAX) {
            s->families[s->n_families++] = g;
        } else {
            s->n_left_out += is_new;
        }
    }
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

static void add_dots(sheet *s, int family)
{
    const mor_sweep_table *table = s->table;
    const mor_sweep_design *design = table->design;
    double *x = s->dots + 2 * (int64_t)family * design->n_members;
    double *y = x + design->n_members;
    int64_t n = 0;
    for (int m = 0; m < design->n_members; ++m) {
        x[n] = mor_sweep_design_value(design, m, s->variable);
        y[n] = table->values[(int64_t)m * table->n_columns + s->column];
        if (isfinite(x[n]) && isfinite(y[n]) && mor_sweep_table_is_used(table, m) &&
            is_family(design, design->groups[m], s->families[family], s->variable, false)) {
            s->first = fmin(s->first, x[n]);
            s->last = fmax(s->last, x[n]);
            ++n;
        }
    }
    s->n_dots += n;
    if (n > 0) {
        s->series[s->n_series++] = (mor_chart_series){.x = x, .y = y, .n_points = n, .style = MOR_CHART_POINTS};
    }
}

/* Groups in the order of the variable; those of a random variable have no place on its axis. */
static void add_means(sheet *s, int family)
{
    const mor_sweep_design *design = s->table->design;
    const int64_t room = design->n_groups;
    double *x = s->means + ARRAYS * family * room;
    int64_t n = 0;
    for (int g = 0; g < design->n_groups; ++g) {
        mor_sweep_statistics it;
        const double place = mor_sweep_design_value(design, design->firsts[g], s->variable);
        mor_sweep_table_evaluate(s->table, g, s->column, &it);
        if (!isfinite(place) || it.n == 0 || !is_family(design, g, s->families[family], s->variable, false)) {
            continue;
        }
        int64_t k = n++;
        for (; k > 0 && x[k - 1] > place; --k) {
            for (int a = 0; a < ARRAYS; ++a) {
                x[a * room + k] = x[a * room + k - 1];
            }
        }
        x[k] = place;
        x[room + k] = it.mean;
        x[2 * room + k] = it.n >= 2 ? it.mean_low : it.mean;
        x[3 * room + k] = it.n >= 2 ? it.mean_high : it.mean;
    }
    if (n > 0) {
        s->series[s->n_series] = (mor_chart_series){.x = x,
                                                    .y = x + room,
                                                    .low = x + 2 * room,
                                                    .high = x + 3 * room,
                                                    .n_points = n,
                                                    .style = MOR_CHART_LINE,
                                                    .color_of = s->n_series};
        s->n_series += 1;
    }
}

/* All series. */
static void add_families(sheet *s)
{
    const mor_sweep_design *design = s->table->design;
    const bool is_random = !mor_sweep_design_is_factor(design->sweep, s->variable);
    for (int f = 0; f < s->n_families; ++f) {
        const int before = s->n_series;
        mor_sweep_design_describe(design, s->families[f], 1u << s->variable, s->names[f], TEXT_BYTES);
        add_dots(s, f);
        if (s->n_series > before && !is_random) {
            add_means(s, f);
        }
        if (s->n_series > before && s->n_families > 1) {
            s->series[s->n_series - 1].name = s->names[f];
        }
    }
}

/* ---- Charts ------------------------------------------------------------------------------------------------------ */

static mor_status draw_sheet(mor_context *context, const sheet *s, const char *folder, FILE *output)
{
    const mor_sweep *sweep = s->table->design->sweep;
    const mor_sweep_variable *variable = &sweep->variables[s->variable];
    const bool has_means = mor_sweep_design_is_factor(sweep, s->variable);
    char name[MOR_SWEEP_NAME_BYTES];
    char path[MOR_PATH_BYTES];
    char title[TEXT_BYTES];
    char failed[TEXT_BYTES];
    char left_out[TEXT_BYTES];
    const char *notes[3] = {has_means
                                ? "Dots: members. Lines: means of groups; bars: intervals of confidence of 95 % of "
                                  "the mean, where a group has two members or more."
                                : "Dots: members, each with the value that it was given."};
    int n_notes = 1;
    mor_sweep_counts counts;
    mor_sweep_table_count(s->table, -1, &counts);
    const int n_failed = counts.by_state[MOR_SWEEP_STATE_FAILED];
    mor_sweep_table_name(s->table, s->column, name);
    snprintf(title, sizeof title, "%s over %s", name, variable->name);
    if (n_failed > 0) {
        snprintf(failed, sizeof failed, "%d of %d members failed and are not shown.", n_failed, counts.n_members);
        notes[n_notes++] = failed;
    }
    if (s->n_left_out > 0) {
        snprintf(left_out, sizeof left_out,
                 "%d more combinations of the other variables are not drawn; sweep.csv has them.", s->n_left_out);
        notes[n_notes++] = left_out;
    }
    const mor_chart chart = {.title = title,
                             .x_name = variable->name,
                             .x_unit = variable->unit[0] != '\0' ? variable->unit : "1",
                             .y_name = name,
                             .y_unit = s->table->columns[s->column].unit,
                             .series = s->series,
                             .n_series = s->n_series,
                             .has_margin = true,
                             .notes = notes,
                             .n_notes = n_notes};
    for (char *c = name; *c != '\0'; ++c) {
        *c = *c == ' ' ? '_' : *c;
    }
    const int n = snprintf(path, sizeof path, "%s/images/%s-over-%s.png", folder, name, variable->name);
    MOR_CHECK(context, n > 0 && n < (int)sizeof path, MOR_ERROR_IO, "the path of a chart is too long");
    MOR_TRY(context, mor_picture_chart(context, &chart, path));
    fprintf(output, "chart: %s\n", path);
    return MOR_OK;
}

static mor_status draw_pair(mor_context *context, mor_sweep_table *table, int column, int variable, double *room,
                            const char *folder, FILE *output)
{
    sheet s = {.table = table,
               .column = column,
               .variable = variable,
               .dots = room,
               .means = room + 2 * FAMILIES_MAX * (int64_t)table->design->n_members,
               .parts = room + 2 * FAMILIES_MAX * (int64_t)table->design->n_members +
                        ARRAYS * FAMILIES_MAX * (int64_t)table->design->n_groups,
               .first = INFINITY,
               .last = -INFINITY};
    find_families(&s);
    add_families(&s);
    return s.n_dots > 0 && s.first < s.last ? draw_sheet(context, &s, folder, output) : MOR_OK;
}

mor_status mor_sweep_charts_draw(mor_context *context, mor_sweep_table *table, const char *folder, FILE *output)
{
    const mor_sweep_design *design = table->design;
    double *room = NULL;
    MOR_TRY(context, MOR_NEW(context, &room,
                             FAMILIES_MAX * (2 * (int64_t)design->n_members + ARRAYS * (int64_t)design->n_groups) +
                                 design->n_groups,
                             "charts of a sweep"));
    mor_status status = MOR_OK;
    for (int v = 0; v < design->sweep->n_variables; ++v) {
        const mor_sweep_variable *it = &design->sweep->variables[v];
        const bool is_shown = it->is_number && (it->n_choices == 0 || !it->is_replicate);
        for (int c = 0; c < table->n_results && is_shown && status == MOR_OK; ++c) {
            status = draw_pair(context, table, c, v, room, folder, output);
        }
    }
    MOR_FREE(context, &room);
    return status;
}
