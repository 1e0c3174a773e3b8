/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_failure.h"

#include "cases/driver/element/element_point.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/run/run_step.h"
#include "core/material/composite.h"
#include "core/material/varied.h"

#include <math.h>
#include <string.h>

typedef mor_status (*retake_step)(mor_context *context, mor_run_files *files, mor_run_due *due);

/* Brings back the last finished step; the state kept in memory when a step fails that once did not. */
static mor_status go_back(mor_context *context, mor_run_files *files, retake_step retake)
{
    const mor_schedule *schedule = &files->simulation->schedule;
    const uint64_t n_steps = schedule->n_steps;
    mor_run_due due = files->kept.due;
    MOR_TRY(context, mor_run_files_recall(context, files));
    while (schedule->n_steps < n_steps) {
        if (retake(context, files, &due) != MOR_OK) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "the last finished step cannot be computed again; results are of "
                            "an earlier one");
            return mor_run_files_recall(context, files);
        }
    }
    return MOR_OK;
}

static bool is_in_series(const mor_run_files *files)
{
    return files->series.has_rows && files->series.last_time >= mor_schedule_time(&files->simulation->schedule);
}

static bool is_in_snapshots(const mor_run_files *files)
{
    const mor_snapshot_list *list = &files->snapshots.list;
    return list->n > 0 && list->items[list->n - 1].step >= (int64_t)files->simulation->schedule.n_steps;
}

static mor_status write_results(mor_context *context, mor_run_files *files, const mor_summary_failure *failure)
{
    int n_missed = 0;
    if (!is_in_series(files)) {
        MOR_TRY(context, mor_run_files_add_row(context, files));
    }
    if (!is_in_snapshots(files)) {
        files->snapshots.note = "run stopped";
        MOR_TRY(context, mor_run_files_add_snapshot(context, files));
    }
    MOR_TRY(context, mor_run_files_conclude(context, files, NAN, failure, &n_missed));
    fflush(files->options->output); /* a signal may end the program while it draws */
    const bool is_drawn = files->the_case->output.has_pictures && !mor_stop_is_requested(files->options->stop);
    return is_drawn ? mor_pictures_render(context, files->the_case, files->options->folder, MOR_PICTURES_KEY,
                                          files->options->output)
                    : MOR_OK;
}

/* The stress update that the step failed at, when that is why it failed, to be repeated alone. */
static mor_status write_point(mor_context *context, const mor_run_files *files)
{
    const mor_soil *soil = &files->simulation->soil;
    const mor_soil_failure *failure = &soil->failure;
    if (!files->simulation->has_soil || !failure->is_known) {
        return MOR_OK;
    }
    char path[MOR_PATH_BYTES];
    mor_element_point point = {.particle = failure->particle,
                               .time = failure->time,
                               .step = (int64_t)failure->step,
                               .time_step = failure->time_step,
                               .density = failure->density};
    const mor_material_instance *part = mor_composite_find_part(soil->material, failure->state, point.state);
    const mor_material_instance *law = mor_varied_find_law(part, point.state, point.parameters);
    point.reference_density = law->density;
    snprintf(point.model, sizeof point.model, "%.63s", law->material->name);
    snprintf(point.set, sizeof point.set, "%.63s", soil->set.name);
    memcpy(point.stress, failure->stress, sizeof point.stress);
    memcpy(point.velocity_gradient, failure->velocity_gradient, sizeof point.velocity_gradient);
    memcpy(point.extra_stress_rate, failure->extra_stress_rate, sizeof point.extra_stress_rate);
    MOR_TRY(context, mor_durable_file_join(context, path, files->options->folder, MOR_ELEMENT_POINT_FILE));
    return mor_element_point_write(context, law->material, &point, path);
}

mor_status mor_run_conclude_failure(mor_context *context, mor_run_files *files, retake_step retake)
{
    const mor_context reason = *context;
    const mor_schedule *schedule = &files->simulation->schedule;
    if (write_point(context, files) != MOR_OK) { /* the reason why the run stopped matters more */
        mor_context_log(context, MOR_LOG_WARNING, "the failed stress update could not be written: %s",
                        context->message);
    } else if (files->simulation->has_soil && files->simulation->soil.failure.is_known) {
        mor_context_log(context, MOR_LOG_WARNING, "the stress update that failed is in %s/%s, to be repeated alone",
                        files->options->folder, MOR_ELEMENT_POINT_FILE);
    }
    mor_status status = go_back(context, files, retake);
    const mor_summary_failure failure = {.reason = reason.message,
                                         .time = mor_schedule_time(schedule),
                                         .end = files->the_case->end,
                                         .step = (int64_t)schedule->n_steps,
                                         .set = reason.particle_set,
                                         .particle = reason.particle};
    mor_run_warn_of_speed(context, files->simulation);
    if (status == MOR_OK) {
        status = write_results(context, files, &failure);
    }
    if (status != MOR_OK) { /* the reason why the run stopped matters more */
        mor_context_log(context, MOR_LOG_WARNING, "not all results of the stopped run could be written: %s",
                        context->message);
    }
    mor_context_restore_error(context, &reason);
    return reason.status;
}
