/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_settle.h"

#include "cases/driver/picture/pictures.h"
#include "cases/driver/run/wall_time.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/io/durable_file.h"

#include <stdio.h>
#include <string.h>

#define SETTLING_FOLDER "settling"

static const struct {
    const char *color;
    const char *image;
    bool is_of_soil; /* a field that some materials do not have */
} views[] = {{"speed", "images/settling-velocity.png", false},
             {"plastic_strain", "images/settling-plastic-strain.png", true}};

static mor_status keep_state(mor_context *context, mor_run_files *files, const char *folder)
{
    const mor_snapshot_fact facts[] = {
        {"version", files->options->version}, {"commit", files->options->commit}, {"command", files->options->command}};
    const mor_snapshot_options options = {.facts = facts, .n_facts = 3};
    const mor_schedule *schedule = &files->simulation->schedule;
    mor_snapshot_writer writer;
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(files->simulation, false, sets);
    MOR_TRY(context, mor_run_folder_make(context, folder));
    MOR_TRY(context, mor_snapshot_writer_init(context, &writer, folder, &options, -1));
    const mor_status status = mor_snapshot_writer_add(context, &writer, sets, n_sets, (int64_t)schedule->n_steps,
                                                      mor_schedule_time(schedule));
    mor_snapshot_writer_clear(context, &writer);
    return status;
}

static mor_status draw_state(mor_context *context, mor_run_files *files)
{
    char folder[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, folder, files->options->folder, SETTLING_FOLDER));
    MOR_TRY(context, keep_state(context, files, folder));
    for (size_t k = 0; k < sizeof views / sizeof *views; ++k) {
        if (views[k].is_of_soil && mor_set_find_field(&files->simulation->soil.set, views[k].color) < 0) {
            continue;
        }
        MOR_TRY(context, mor_durable_file_join(context, path, files->options->folder, views[k].image));
        MOR_TRY(context, mor_pictures_draw_last(context, files->the_case, folder, views[k].color, "after settling for",
                                                path, files->options->output));
    }
    return MOR_OK;
}

static void show_progress(void *user, const mor_settle_course *course)
{
    mor_run_files *files = user;
    char line[MOR_RUN_PROGRESS_BYTES];
    if (mor_run_progress_is_due(&files->progress, mor_wall_time())) {
        const int n = snprintf(line, sizeof line, "settling  t = %.4g s of at most %.4g s  step %llu  ", course->time,
                               course->longest, (unsigned long long)course->n_steps);
        snprintf(line + n, sizeof line - (size_t)n,
                 course->is_relaxed ? "unbalanced force / weight %.3g, at rest below %.3g"
                                    : "99 %% of the soil slower than %.3g m/s, at rest below %.3g m/s",
                 course->is_relaxed ? course->force : course->speed,
                 course->is_relaxed ? course->ratio : course->limit);
        mor_run_progress_show(&files->progress, line);
    }
}

mor_status mor_run_settle(mor_context *context, mor_run_files *files)
{
    const mor_settle_observer observer = {.stop =
                                              files->options->stop != NULL ? &files->options->stop->is_requested : NULL,
                                          .report = show_progress,
                                          .user = files};
    const mor_status status = mor_simulation_settle(context, files->simulation, &observer);
    mor_run_progress_end(&files->progress);
    if (status == MOR_OK && mor_simulation_settles(files->simulation) && !mor_stop_is_requested(files->options->stop)) {
        mor_simulation_warn_of_stiffening(context, files->simulation, "after settling ");
    }
    if (status != MOR_NOT_CONVERGED) {
        return status;
    }
    const mor_context reason = *context;
    if (draw_state(context, files) != MOR_OK) { /* the reason why there is a picture matters more than the picture */
        mor_context_log(context, MOR_LOG_WARNING, "the soil at the end of settling could not be drawn: %s",
                        context->message);
    }
    mor_context_restore_error(context, &reason);
    return status;
}
