/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_pictures.h"

#include "cases/driver/picture/draw/chart.h"
#include "cases/driver/safety/mechanism_picture.h"
#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <math.h>
#include <string.h>

/* Trials on either side of the answer whose speeds are drawn. */
enum { NEAR_MAX = 3, NAME_BYTES = 64 };

static mor_status write_chart(mor_context *context, const mor_chart *chart, const char *folder, const char *name,
                              FILE *output)
{
    char path[MOR_PATH_BYTES];
    mor_canvas *canvas = NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    MOR_TRY(context, mor_chart_draw(context, chart, &canvas));
    const mor_status status = mor_canvas_write(context, canvas, path);
    mor_canvas_free(context, &canvas);
    if (status == MOR_OK) {
        fprintf(output, "picture: %s\n", path);
    }
    return status;
}

/* ---- Displacement against factor --------------------------------------------------------------------------------- */

static double final_displacement(const mor_safety *it, int trial)
{
    return mor_safety_trial_last(&it->trials[trial]).displacement * it->setup.reference.height;
}

enum { VERDICTS = 4 };

/* Trials of one verdict as points; those that went so far that the others would lie on a line are counted alone. */
typedef struct verdict_points {
    char name[NAME_BYTES];
    double x[MOR_SAFETY_TRIALS_MAX]; /* factor, 1 */
    double y[MOR_SAFETY_TRIALS_MAX]; /* displacement, m */
    int n, n_beyond;
} verdict_points;

static void find_points(const mor_safety *it, mor_safety_verdict verdict, verdict_points *points)
{
    const double frame = 5.0; /* of the displacement of failure */
    const double most = frame * it->setup.rules.far * it->setup.reference.height;
    points->n = points->n_beyond = 0;
    for (int k = 0; k < it->n_trials; ++k) {
        if (it->trials[k].finding.verdict == verdict && it->trials[k].n_samples > 0) {
            const double y = final_displacement(it, k);
            points->x[points->n] = it->trials[k].factor;
            points->y[points->n] = y;
            points->n += y <= most;
            points->n_beyond += !(y <= most);
        }
    }
    snprintf(points->name, NAME_BYTES, points->n_beyond > 0 ? "%s (%d more above)" : "%s",
             mor_safety_verdict_word(verdict), points->n_beyond);
}

static mor_status draw_displacement(mor_context *context, const mor_safety *it, const char *folder, FILE *output)
{
    static const mor_safety_verdict verdicts[VERDICTS] = {MOR_SAFETY_STABLE, MOR_SAFETY_UNDECIDED, MOR_SAFETY_FAILS,
                                                          MOR_SAFETY_BROKE_DOWN};
    verdict_points points[VERDICTS];
    mor_chart_series series[VERDICTS + 1];
    int n = 0;
    double ends[2] = {INFINITY, -INFINITY};
    for (int v = 0; v < VERDICTS; ++v) {
        find_points(it, verdicts[v], &points[v]);
        for (int k = 0; k < points[v].n; ++k) {
            ends[0] = fmin(ends[0], points[v].x[k]);
            ends[1] = fmax(ends[1], points[v].x[k]);
        }
        if (points[v].n > 0) {
            series[n++] = (mor_chart_series){.name = points[v].name,
                                             .x = points[v].x,
                                             .y = points[v].y,
                                             .n_points = points[v].n,
                                             .style = MOR_CHART_POINTS};
        }
    }
    if (n == 0) {
        return MOR_OK;
    }
    const double far = it->setup.rules.far * it->setup.reference.height;
    const double level[2] = {far, far};
    series[n++] =
        (mor_chart_series){.name = "criterion", .x = ends, .y = level, .n_points = 2, .style = MOR_CHART_DASHED};
    const mor_chart chart = {.title = it->setup.reduced->original->title,
                             .x_name = "factor that strength is divided by",
                             .x_unit = "1",
                             .y_name = "displacement at the end of the trial",
                             .y_unit = "m",
                             .series = series,
                             .n_series = n,
                             .has_margin = true};
    return write_chart(context, &chart, folder, "images/displacement.png", output);
}

/* ---- Speed over time --------------------------------------------------------------------------------------------- */

/* The trials nearest to the middle of the band, at most 2 * NEAR_MAX, by rising factor; near: shape [2 * NEAR_MAX]. */
static int find_near(const mor_safety *it, int *near)
{
    const double middle = isnan(it->band.stable)  ? it->band.fails
                          : isnan(it->band.fails) ? it->band.stable
                                                  : 0.5 * (it->band.stable + it->band.fails);
    int n = 0;
    bool is_taken[MOR_SAFETY_TRIALS_MAX] = {false};
    while (n < 2 * NEAR_MAX) {
        int best = -1;
        for (int k = 0; k < it->n_trials; ++k) {
            const bool is_nearer =
                best < 0 || fabs(it->trials[k].factor - middle) < fabs(it->trials[best].factor - middle);
            best = !is_taken[k] && it->trials[k].n_samples > 0 && is_nearer ? k : best;
        }
        if (best < 0) {
            break;
        }
        is_taken[best] = true;
        int place = n++;
        for (; place > 0 && it->trials[near[place - 1]].factor > it->trials[best].factor; --place) {
            near[place] = near[place - 1];
        }
        near[place] = best;
    }
    return n;
}

/* A limit of the criterion of speed over the time of the trials. */
static mor_chart_series draw_limit(const char *name, double speed, const double *times, double *room)
{
    room[0] = room[1] = log10(speed);
    return (mor_chart_series){.name = name, .x = times, .y = room, .n_points = 2, .style = MOR_CHART_DASHED};
}

static mor_status draw_speed(mor_context *context, const mor_safety *it, const char *folder, FILE *output)
{
    mor_chart_series series[2 * NEAR_MAX + 2];
    double times[2] = {0.0, 0.0};
    double limits[2][2];
    char names[2 * NEAR_MAX][NAME_BYTES];
    int near[2 * NEAR_MAX];
    double *room = NULL;
    const int n = find_near(it, near);
    const double time = mor_safety_reference_time(&it->setup.reference);
    const double speed = mor_safety_reference_speed(&it->setup.reference);
    MOR_TRY(context, MOR_NEW(context, &room, (int64_t)4 * NEAR_MAX * MOR_SAFETY_SAMPLES_MAX, "speeds of trials"));
    for (int k = 0; k < n; ++k) {
        const mor_safety_trial *trial = &it->trials[near[k]];
        double *x = room + (ptrdiff_t)2 * k * MOR_SAFETY_SAMPLES_MAX;
        double *y = x + MOR_SAFETY_SAMPLES_MAX;
        for (int s = 0; s < trial->n_samples; ++s) {
            x[s] = trial->samples[s].time * time;
            times[1] = fmax(times[1], x[s]);
            y[s] = log10(fmax(trial->samples[s].speed * speed, 1.0e-12));
        }
        snprintf(names[k], NAME_BYTES, "F = %.5g %s", trial->factor, mor_safety_verdict_word(trial->finding.verdict));
        series[k] = (mor_chart_series){.name = names[k], .x = x, .y = y, .n_points = trial->n_samples};
    }
    series[n] = draw_limit("moves above", it->setup.rules.motion * speed, times, limits[0]);
    series[n + 1] = draw_limit("rests below", it->setup.rules.rest * speed, times, limits[1]);
    const mor_chart chart = {.title = it->setup.reduced->original->title,
                             .x_name = "time since the strength was reduced",
                             .x_unit = "s",
                             .y_name = "decimal logarithm of the speed in m/s",
                             .y_unit = "1",
                             .series = series,
                             .n_series = n + 2,
                             .has_margin = true};
    const mor_status status = write_chart(context, &chart, folder, "images/speed.png", output);
    MOR_FREE(context, &room);
    return status;
}

mor_status mor_safety_draw(mor_context *context, const mor_safety *it, const char *folder, FILE *output)
{
    char path[MOR_PATH_BYTES];
    if (it->n_trials == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, draw_displacement(context, it, folder, output));
    MOR_TRY(context, draw_speed(context, it, folder, output));
    if (it->mechanism == NULL || it->setup.reduced->original->dimension != 2) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "images/mechanism-displacement.png"));
    MOR_TRY(context, mor_mechanism_draw(context, it, MOR_MECHANISM_DISPLACEMENT, path));
    fprintf(output, "picture: %s\n", path);
    if (it->setup.reference.plastic_strain != NULL) {
        MOR_TRY(context, mor_durable_file_join(context, path, folder, "images/mechanism-strain.png"));
        MOR_TRY(context, mor_mechanism_draw(context, it, MOR_MECHANISM_STRAIN, path));
        fprintf(output, "picture: %s\n", path);
    }
    return MOR_OK;
}
