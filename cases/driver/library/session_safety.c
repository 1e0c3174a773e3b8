/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The factor of safety of a case, at one spacing or several. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/picture/draw/chart.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/run/wall_time.h"
#include "cases/driver/safety/safety_files.h"
#include "cases/driver/safety/safety_pictures.h"
#include "core/base/memory.h"
#include "core/base/units.h"

#include <ctype.h>
#include <dirent.h>
#include <math.h>
#include <string.h>

#define MECHANISM_FOLDER "mechanism"
#define SPACING_FOLDER "spacing-" /* then the spacing in m */

enum { SPACINGS_MAX = 8, WORD_BYTES = 64, BAND_BYTES = 64 };

/* Factors beyond this one are not tried: such soil does not depend on its strength. */
static const double largest_factor = 64.0;

/* What is found at one spacing. */
typedef struct level {
    char word[WORD_BYTES]; /* the spacing as it was given; "": that of the case */
    double spacing;        /* m */
    mor_safety_band band;
} level;

void mor_session_safety_init(mor_session_safety *options)
{
    *options = (mor_session_safety){.lower = 0.5, .upper = NAN, .tolerance = 0.01, .height = NAN, .spacings = NULL};
}

/* ---- Options ----------------------------------------------------------------------------------------------------- */

static mor_status check_options(mor_context *context, const mor_session_safety *options)
{
    MOR_CHECK(context, options->lower > 0.0 && options->lower <= largest_factor, MOR_ERROR_CONFIG,
              "found a lower factor of %g; allowed: above 0, at most %g", options->lower, largest_factor);
    MOR_CHECK(context, isnan(options->upper) || (options->upper > options->lower && options->upper <= largest_factor),
              MOR_ERROR_CONFIG, "found an upper factor of %g; allowed: above the lower one, %g, at most %g",
              options->upper, options->lower, largest_factor);
    MOR_CHECK(context, options->tolerance >= 1.0e-4 && options->tolerance <= 1.0, MOR_ERROR_CONFIG,
              "found a tolerance of %g for the factor; allowed: 0.0001 to 1", options->tolerance);
    MOR_CHECK(context, isnan(options->height) || (isfinite(options->height) && options->height > 0.0), MOR_ERROR_CONFIG,
              "found a height of the slope of %g m; allowed: above 0", options->height);
    return MOR_OK;
}

/* Takes a list as "1 m, 0.5 m" apart. */
static mor_status split_spacings(mor_context *context, const char *text, level *levels, int *n)
{
    *n = 1;
    for (int k = 0; k < SPACINGS_MAX; ++k) {
        levels[k] = (level){.band = {.stable = NAN, .fails = NAN}}; /* not computed yet */
    }
    if (text == NULL) {
        return MOR_OK;
    }
    for (*n = 0; *text != '\0'; ++*n) {
        text += strspn(text, " \t");
        size_t length = strcspn(text, ",");
        const char *next = text + length + (text[length] == ',');
        while (length > 0 && isspace((unsigned char)text[length - 1])) {
            length -= 1;
        }
        MOR_CHECK(
            context, *n < SPACINGS_MAX && length > 0 && length < WORD_BYTES, MOR_ERROR_CONFIG,
            "found spacings '%s' that are empty, too long or too many; allowed: up to %d lengths, as '1 m, 0.5 m'",
            text, SPACINGS_MAX);
        memcpy(levels[*n].word, text, length);
        text = next;
    }
    MOR_CHECK(context, *n > 0, MOR_ERROR_CONFIG,
              "found an empty list of spacings; allowed: lengths, as '1 m, 0.5 m, 0.25 m'");
    return MOR_OK;
}

/* All spacings are checked before the first is computed, by the words of the user. */
static mor_status check_spacings(mor_context *context, level *levels, int n)
{
    mor_units *units = NULL;
    mor_status status = mor_units_new(context, &units);
    for (level *it = levels; it < levels + n && status == MOR_OK; ++it) {
        bool is_new = true; /* in the six digits by which its folder is named */
        const bool is_length =
            it->word[0] == '\0' ||
            (mor_units_convert(context, units, it->word, "m", &it->spacing) == MOR_OK && it->spacing > 0.0);
        for (const level *other = levels; other < it; ++other) {
            is_new = is_new && fabs(it->spacing - other->spacing) > 1.0e-5 * it->spacing;
        }
        if (!is_length || !is_new) {
            status = MOR_FAIL(context, MOR_ERROR_CONFIG,
                              "found '%s' in the spacings, which %s; allowed: lengths, as '1 m, 0.5 m', each once",
                              it->word, is_length ? "is there twice" : "is no length above 0");
        }
    }
    mor_units_free(context, &units);
    return status;
}

/* Loads the case at one spacing; the override that says so is taken back. */
static mor_status load(mor_session *session, const char *path, const level *it)
{
    char setting[WORD_BYTES + 16];
    if (it->word[0] == '\0') {
        return mor_session_load_file(session, path);
    }
    snprintf(setting, sizeof setting, "spacing=%s", it->word);
    MOR_TRY(&session->context, mor_session_override(session, setting));
    const mor_status status = mor_session_load_file(session, path);
    MOR_FREE(&session->context, &session->overrides[--session->n_overrides]);
    return status;
}

/* ---- One spacing ------------------------------------------------------------------------------------------------- */

static void show_progress(void *user, double factor, const mor_safety_sample *last)
{
    mor_run_progress *progress = user;
    char line[MOR_RUN_PROGRESS_BYTES];
    if (mor_run_progress_is_due(progress, mor_wall_time())) {
        snprintf(line, sizeof line, "F = %.5g  t = %.3g sqrt(H / g)  speed %.2g sqrt(g H)  displacement %.2g H", factor,
                 last->time, last->speed, last->displacement);
        mor_run_progress_show(progress, line);
    }
}

/* The state at the end of the first trial that failed, for ParaView; in space also its picture. */
static mor_status write_mechanism(mor_session *session, const mor_safety *it, const char *folder)
{
    mor_context *context = &session->context;
    char inner[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    if (it->mechanism == NULL) {
        return MOR_OK;
    }
    const int n_sets = mor_simulation_sets(it->mechanism, false, sets);
    MOR_TRY(context, mor_durable_file_join(context, inner, folder, MECHANISM_FOLDER));
    MOR_TRY(context, mor_run_folder_make(context, inner));
    MOR_TRY(context, mor_session_write_snapshot(session, inner, sets, n_sets, it->trials[it->mechanism_trial].seconds));
    if (session->the_case.dimension == 2) {
        return MOR_OK;
    }
    const bool has_strain = it->setup.reference.plastic_strain != NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "images/mechanism.png"));
    return mor_pictures_draw_last(context, &session->the_case, inner, has_strain ? "plastic_strain" : "speed",
                                  "failing for", path, session->output);
}

static mor_status write_results(mor_session *session, const mor_safety *it, const mor_safety_request *request,
                                const char *folder)
{
    mor_context *context = &session->context;
    char images[MOR_PATH_BYTES];
    const mor_safety_provenance provenance = {mor_version(), mor_commit(), session->command};
    MOR_TRY(context, mor_durable_file_join(context, images, folder, "images"));
    MOR_TRY(context, mor_run_folder_make(context, images));
    MOR_TRY(context, mor_safety_write_tables(context, it, folder));
    MOR_TRY(context, mor_safety_write_summary(context, it, request, &provenance, folder));
    mor_safety_print(it, session->output);
    MOR_TRY(context, mor_safety_draw(context, it, folder, session->output));
    return write_mechanism(session, it, folder);
}

static mor_status find(mor_session *session, const mor_session_safety *options, const char *folder, mor_safety *it)
{
    mor_run_progress progress = {
        .stream = session->progress, .is_terminal = session->is_terminal, .last = mor_wall_time()};
    const mor_safety_request request = {
        .the_case = &session->the_case,
        .registry = session->the_case.registry,
        .lower = options->lower,
        .height = options->height,
        .bracket = {.upper = options->upper, .most = largest_factor, .tolerance = options->tolerance},
        .stop = &session->stop.is_requested,
        .report = session->progress != NULL ? show_progress : NULL,
        .user = &progress,
        .output = session->output};
    mor_stop_enter(&session->stop, MOR_STOP_AFTER_STEP); /* a stop is waited for: the trials so far are written */
    const mor_status status = mor_safety_find(&session->context, &request, it);
    mor_stop_enter(&session->stop, MOR_STOP_AT_ONCE);
    mor_run_progress_end(&progress);
    MOR_TRY(&session->context, status);
    return it->n_trials > 0 ? write_results(session, it, &request, folder) : MOR_OK;
}

static mor_status find_at(mor_session *session, const char *path, const mor_session_safety *options, const char *folder,
                          level *it)
{
    mor_context *context = &session->context;
    mor_safety *safety = NULL;
    MOR_TRY(context, load(session, path, it));
    it->spacing = session->the_case.spacing;
    fprintf(session->output, "%s, spacing %g m\n", session->the_case.title, it->spacing);
    MOR_TRY(context, MOR_NEW(context, &safety, 1, "a factor of safety"));
    const mor_status status = find(session, options, folder, safety);
    it->band = safety->band;
    mor_safety_clear(context, safety);
    MOR_FREE(context, &safety);
    return status;
}

/* ---- Several spacings -------------------------------------------------------------------------------------------- */

static mor_status write_levels(mor_session *session, const level *levels, int n, const char *folder)
{
    mor_context *context = &session->context;
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "spacings.csv"));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    fprintf(file.stream, "spacing [m],largest_stable [1],smallest_failing [1],undecided [1]\n");
    fprintf(session->output, "\n%12s  %-20s  %9s  %s\n", "spacing [m]", "factor of safety", "undecided",
            "change of the smallest failing factor");
    for (int k = 0; k < n; ++k) {
        char band[BAND_BYTES];
        const mor_safety_band *it = &levels[k].band;
        mor_safety_format_band(it, band, sizeof band);
        mor_safety_print_cells((double[]){levels[k].spacing, it->stable, it->fails}, 3, file.stream);
        fprintf(file.stream, "%d\n", it->n_undecided);
        fprintf(session->output, "%12g  %-20s  %9d  ", levels[k].spacing, band, it->n_undecided);
        fprintf(session->output, k > 0 && isfinite(it->fails / levels[k - 1].band.fails) ? "%+.2f %%\n" : "-\n",
                k > 0 ? 100.0 * (it->fails / levels[k - 1].band.fails - 1.0) : 0.0);
    }
    return mor_durable_file_commit(context, &file);
}

static mor_status draw_levels(mor_session *session, const level *levels, int n, const char *folder)
{
    mor_context *context = &session->context;
    double x[SPACINGS_MAX], y[2][SPACINGS_MAX];
    char path[MOR_PATH_BYTES];
    mor_canvas *canvas = NULL;
    int n_points = 0;
    for (int k = 0; k < n; ++k) {
        if (isfinite(levels[k].band.stable) && isfinite(levels[k].band.fails)) {
            x[n_points] = levels[k].spacing;
            y[0][n_points] = levels[k].band.stable;
            y[1][n_points++] = levels[k].band.fails;
        }
    }
    if (n_points == 0) {
        return MOR_OK;
    }
    const mor_chart_series series[4] = {
        {.name = "smallest failing", .x = x, .y = y[1], .n_points = n_points},
        {.name = "largest stable", .x = x, .y = y[0], .n_points = n_points},
        {.x = x, .y = y[1], .n_points = n_points, .style = MOR_CHART_POINTS, .color_of = 1},
        {.x = x, .y = y[0], .n_points = n_points, .style = MOR_CHART_POINTS, .color_of = 2}};
    const mor_chart chart = {.title = session->the_case.title,
                             .x_name = "spacing",
                             .x_unit = "m",
                             .y_name = "factor of safety",
                             .y_unit = "1",
                             .series = series,
                             .n_series = 4,
                             .has_margin = true};
    MOR_TRY(context, mor_durable_file_join(context, path, folder, "spacings.png"));
    MOR_TRY(context, mor_chart_draw(context, &chart, &canvas));
    const mor_status status = mor_canvas_write(context, canvas, path);
    mor_canvas_free(context, &canvas);
    if (status == MOR_OK) {
        fprintf(session->output, "picture: %s\n", path);
    }
    return status;
}

static mor_status find_levels(mor_session *session, const char *path, const mor_session_safety *options,
                              const char *folder, level *levels, int n)
{
    mor_context *context = &session->context;
    for (int k = 0; k < n && !mor_session_is_stopping(session); ++k) {
        char name[WORD_BYTES];
        char inner[MOR_PATH_BYTES];
        MOR_TRY(context, load(session, path, &levels[k])); /* its spacing, as a number, names the folder */
        snprintf(name, sizeof name, SPACING_FOLDER "%g", session->the_case.spacing);
        MOR_TRY(context, mor_durable_file_join(context, inner, folder, name));
        MOR_TRY(context, find_at(session, path, options, n > 1 ? inner : folder, &levels[k]));
        fprintf(session->output, "\n");
    }
    return n > 1 && !mor_session_is_stopping(session) ? write_levels(session, levels, n, folder) : MOR_OK;
}

/* A folder that holds results of another search, of one spacing or several, whole or interrupted. */
static mor_status refuse_search(mor_context *context, const char *folder)
{
    static const char *const names[] = {"fos.json", "trials.csv", "spacings.csv"};
    char found[MOR_PATH_BYTES] = "";
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        if (mor_run_folder_has(context, folder, names[k])) {
            snprintf(found, sizeof found, "%s", names[k]);
        }
    }
    DIR *entries = opendir(folder);
    for (const struct dirent *entry = entries != NULL ? readdir(entries) : NULL; entry != NULL;
         entry = readdir(entries)) {
        if (strncmp(entry->d_name, SPACING_FOLDER, strlen(SPACING_FOLDER)) == 0) {
            snprintf(found, sizeof found, "%s", entry->d_name);
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
    MOR_CHECK(
        context, found[0] == '\0', MOR_ERROR_CONFIG,
        "the folder '%s' already holds a search for a factor of safety: found '%s'; results of two searches would "
        "lie side by side; choose another folder",
        folder, found);
    return MOR_OK;
}

mor_status mor_session_find_safety(mor_session *session, const char *path, const mor_session_safety *options,
                                   const char *folder, bool *is_found)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    level levels[SPACINGS_MAX];
    int n = 0;
    *is_found = false;
    MOR_TRY(context, check_options(context, options));
    MOR_TRY(context, split_spacings(context, options->spacings, levels, &n));
    MOR_TRY(context, check_spacings(context, levels, n));
    MOR_TRY(context, mor_run_folder_refuse_run(context, folder, "choose another folder"));
    MOR_TRY(context, refuse_search(context, folder));
    MOR_TRY(context, find_levels(session, path, options, folder, levels, n));
    *is_found = true;
    for (int k = 0; k < n; ++k) {
        *is_found = *is_found && isfinite(levels[k].band.stable) && isfinite(levels[k].band.fails);
    }
    return n > 1 && !mor_session_is_stopping(session) ? draw_levels(session, levels, n, folder) : MOR_OK;
}
