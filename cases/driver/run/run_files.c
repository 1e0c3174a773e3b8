/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_files.h"

#include "cases/driver/case/schema/case_compare.h"
#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/map/map_track.h"
#include "cases/driver/probe/probe.h"
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/io/summary/summary.h"

#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define IMAGES_FOLDER "images"

_Static_assert((int)MOR_MATERIAL_STATE_KEY_BYTES == (int)MOR_FIELD_NAME_BYTES &&
                   (int)MOR_MATERIAL_STATE_UNIT_BYTES == (int)MOR_SNAPSHOT_UNIT_BYTES &&
                   (int)MOR_MATERIAL_STATE_TEXT_BYTES == (int)MOR_SNAPSHOT_TEXT_BYTES,
               "snapshots take each state variable that a law may have");

/* Everything goes into log.txt, and to the sink that was there before. */
static void log_line(void *user, mor_log_level level, const char *text)
{
    static const char *const names[] = {[MOR_LOG_DEBUG] = "debug",
                                        [MOR_LOG_INFO] = "info",
                                        [MOR_LOG_PROGRESS] = "progress",
                                        [MOR_LOG_WARNING] = "warning",
                                        [MOR_LOG_ERROR] = "error"};
    mor_run_files *files = user;
    fprintf(files->log, "%s: %s\n", names[level], text);
    fflush(files->log);
    if (level == MOR_LOG_WARNING) {
        mor_run_warnings_add(files->context, &files->warnings, text);
    }
    if (files->previous_sink != NULL) {
        files->previous_sink(files->previous_user, level, text);
        mor_run_warnings_show(&files->warnings, text);
    }
}

mor_status mor_run_files_listen(mor_context *context, mor_run_files *files)
{
    memset(files, 0, sizeof *files);
    files->log = open_memstream(&files->early_text, &files->n_early_bytes);
    MOR_CHECK(context, files->log != NULL, MOR_ERROR_MEMORY, "no memory for the log of a run");
    files->context = context;
    files->previous_sink = context->log_sink;
    files->previous_user = context->log_user;
    context->log_sink = log_line;
    context->log_user = files;
    return MOR_OK;
}

/* Makes a file the log: its first line says what was started, then follows what was logged before. */
static void begin_log(mor_context *context, mor_run_files *files, FILE *log)
{
    const mor_run_options *options = files->options;
    fclose(files->log);
    files->log = log;
    mor_context_log(context, MOR_LOG_INFO, "moraine %s, commit %s: %s", options->version, options->commit,
                    options->command);
    fwrite(files->early_text, 1, files->n_early_bytes, log);
    fflush(log);
}

static mor_status refuse_run(mor_context *context, const mor_run_options *options)
{
    return options->is_resume
               ? MOR_OK
               : mor_run_folder_refuse_run(context, options->folder, "resume it, or choose another folder");
}

mor_status mor_run_files_open(mor_context *context, mor_run_files *files)
{
    char path[MOR_PATH_BYTES];
    const mor_run_options *options = files->options;
    MOR_TRY(context, refuse_run(context, options)); /* before anything is made in the folder of another run */
    files->is_folder_new = access(options->folder, F_OK) != 0;
    MOR_TRY(context, mor_run_folder_make(context, options->folder));
    MOR_TRY(context, mor_durable_file_join(context, path, options->folder, IMAGES_FOLDER));
    MOR_TRY(context, mor_run_folder_make(context, path));
    MOR_TRY(context, mor_durable_file_join(context, path, options->folder, MOR_RUN_LOG_FILE));
    FILE *log = NULL;
    MOR_TRY(context, mor_run_folder_lock(context, options->folder, &log));
    const mor_status status = refuse_run(context, options); /* again: another run may have been there until now */
    if (status != MOR_OK) {
        mor_run_folder_unlock(&log);
        return status;
    }
    if (options->is_resume) {
        mor_run_warnings_load(context, &files->warnings, path);
    }
    begin_log(context, files, log);
    return MOR_OK;
}

static void add_column(mor_run_files *files, const char *name, const char *unit)
{
    files->columns[files->n_columns++] = (mor_table_column){name, unit};
}

static void add_fact(mor_run_files *files, const char *key, const char *value)
{
    files->facts[files->n_facts++] = (mor_snapshot_fact){key, value};
}

/* One line for each: path, models and hash. */
static void list_plugins(mor_run_files *files)
{
    size_t used = 0;
    files->plugin_text[0] = '\0';
    for (int k = 0; k < files->the_case->n_plugins; ++k) {
        const mor_case_plugin *it = &files->the_case->plugins[k];
        char hash[MOR_HASH_TEXT_BYTES];
        mor_hash_format(it->file_hash, hash);
        snprintf(files->plugin_text + used, sizeof files->plugin_text - used, "%s%s: %s; xxh64 %s", k > 0 ? "\n" : "",
                 it->file, it->models, hash);
        used += strlen(files->plugin_text + used);
    }
}

static void set_facts(mor_run_files *files)
{
    snprintf(files->seed_text, sizeof files->seed_text, "%" PRIu64, files->the_case->seed);
    mor_hash_format(files->case_hash, files->hash_text);
    add_fact(files, "version", files->options->version);
    add_fact(files, "commit", files->options->commit);
    add_fact(files, "command", files->options->command);
    add_fact(files, "seed", files->seed_text);
    add_fact(files, "case", files->the_case->path);
    add_fact(files, "case_xxh64", files->hash_text);
    add_fact(files, "instruction_set", mor_pair_select(NULL)->instruction_set);
    if (files->the_case->n_plugins > 0) {
        list_plugins(files);
        add_fact(files, "plugins", files->plugin_text);
    }
}

mor_status mor_run_files_start(mor_context *context, mor_run_files *files, bool is_resume)
{
    char path[MOR_PATH_BYTES];
    const char *folder = files->options->folder;
    const mor_schedule *schedule = &files->simulation->schedule;
    set_facts(files);
    const mor_snapshot_options options = {.facts = files->facts, .n_facts = files->n_facts};
    MOR_TRY(context, mor_snapshot_writer_init(context, &files->snapshots, folder, &options,
                                              is_resume ? (int64_t)schedule->n_steps : -1));
    for (const mor_case_own_column *own = mor_case_own_columns; own->name != NULL; ++own) {
        add_column(files, own->name, own->unit);
    }
    files->first_probe = files->n_columns;
    for (int k = 0; k < files->the_case->n_probes; ++k) {
        add_column(files, files->the_case->probes[k].name, mor_probe_unit(files->the_case, k));
    }
    MOR_TRY(context, mor_run_gauges_open(context, &files->gauges, files->the_case, folder, is_resume,
                                         mor_schedule_time(schedule)));
    MOR_TRY(context, mor_run_boulders_open(context, &files->boulders, files->simulation, folder, is_resume));
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_TABLE_SERIES_FILE));
    return is_resume ? mor_table_resume(context, &files->series, path, files->columns, files->n_columns,
                                        mor_schedule_time(schedule))
                     : mor_table_create(context, &files->series, path, files->columns, files->n_columns);
}

void mor_run_files_discard(mor_context *context, mor_run_files *files)
{
    static const char *const names[] = {MOR_RUN_LOG_FILE, MOR_RUN_CASE_FILE, IMAGES_FOLDER};
    char path[MOR_PATH_BYTES];
    for (size_t k = 0; k < sizeof names / sizeof *names && files->is_folder_new; ++k) {
        if (mor_durable_file_join(context, path, files->options->folder, names[k]) == MOR_OK) {
            remove(path);
        }
    }
    if (files->is_folder_new) {
        remove(files->options->folder); /* fails, as it should, when anything is left in it */
    }
}

/* Gives the sink back. What was logged before there was a folder stays in early_text. */
static void end_log(mor_context *context, mor_run_files *files)
{
    if (files->log != NULL) {
        context->log_sink = files->previous_sink;
        context->log_user = files->previous_user;
        mor_run_folder_unlock(&files->log);
    }
}

mor_status mor_run_files_withdraw(mor_context *context, mor_run_files *files)
{
    end_log(context, files);
    char *text = files->early_text;
    const mor_run_files before = *files;
    files->early_text = NULL;
    mor_run_files_close(context, files);
    const mor_status status = mor_run_files_listen(context, files);
    if (status == MOR_OK) {
        fwrite(text, 1, before.n_early_bytes, files->log);
        mor_run_warnings_read(context, &files->warnings, text, before.n_early_bytes);
        files->the_case = before.the_case;
        files->simulation = before.simulation;
        files->case_hash = before.case_hash;
    }
    free(text);
    return status;
}

void mor_run_files_close(mor_context *context, mor_run_files *files)
{
    if (files->series.stream != NULL) {
        mor_table_close(context, &files->series);
    }
    mor_run_gauges_close(context, &files->gauges);
    mor_run_boulders_close(context, &files->boulders);
    mor_snapshot_writer_clear(context, &files->snapshots);
    end_log(context, files);
    free(files->early_text);
    files->early_text = NULL;
    mor_run_warnings_clear(context, &files->warnings);
    free(files->case_text);
    files->case_text = NULL;
    MOR_FREE(context, &files->saved_text);
    MOR_FREE(context, &files->kept.bytes);
}

mor_status mor_run_files_add_row(mor_context *context, mor_run_files *files)
{
    double row[MOR_RUN_COLUMNS_MAX];
    const mor_schedule *schedule = &files->simulation->schedule;
    row[0] = mor_schedule_time(schedule);
    row[1] = (double)schedule->n_steps;
    row[2] = schedule->step_length;
    row[3] = (double)mor_schedule_rate_ratio(schedule);
    for (int k = 0; k < files->the_case->n_probes; ++k) {
        MOR_TRY(context, mor_probe_value(context, files->simulation, k, &row[files->first_probe + k]));
    }
    MOR_TRY(context, mor_run_gauges_add_row(context, &files->gauges, &files->simulation->probes->gauges, row[0]));
    MOR_TRY(context, mor_run_boulders_add_row(context, &files->boulders, files->simulation));
    return mor_table_append(context, &files->series, row);
}

mor_status mor_run_files_take_row(mor_context *context, mor_run_files *files)
{
    mor_gauges *gauges = &files->simulation->probes->gauges;
    for (int k = 0; k < files->the_case->n_probes; ++k) {
        double value = NAN;
        MOR_TRY(context, mor_probe_value(context, files->simulation, k, &value));
    }
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge_reading mean;
        double largest = NAN;
        mor_gauge_take_row(&gauges->of[k], mor_schedule_time(&files->simulation->schedule), &mean, &largest);
    }
    return MOR_OK;
}

mor_status mor_run_files_add_snapshot(mor_context *context, mor_run_files *files)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(files->simulation, false, sets);
    const mor_schedule *schedule = &files->simulation->schedule;
    return mor_snapshot_writer_add(context, &files->snapshots, sets, n_sets, (int64_t)schedule->n_steps,
                                   mor_schedule_time(schedule));
}

mor_status mor_run_files_save(mor_context *context, mor_run_files *files)
{
    const mor_checkpoint checkpoint = {&files->simulation->state, files->case_text};
    if (files->series.stream != NULL) { /* a state may be saved without a series */
        MOR_TRY(context, mor_run_gauges_sync(context, &files->gauges));
        MOR_TRY(context, mor_run_boulders_sync(context, &files->boulders));
        MOR_TRY(context, mor_table_sync(context, &files->series));
    }
    return mor_checkpoint_write(context, files->options->folder, &checkpoint);
}

static mor_status save_state(mor_context *context, mor_run_files *files, const mor_registry *registry)
{
    const char *folder = files->options->folder;
    MOR_CHECK(context,
              !mor_run_folder_has(context, folder, MOR_TABLE_SERIES_FILE) &&
                  !mor_run_folder_has(context, folder, MOR_SUMMARY_FILE),
              MOR_ERROR_CONFIG, "the folder '%s' holds a run, whose state and results belong together; choose another",
              folder);
    MOR_TRY(context, mor_run_files_keep_case(context, files, registry, mor_run_folder_has_checkpoint(context, folder)));
    return mor_run_files_save(context, files);
}

mor_status mor_run_files_save_state(mor_context *context, mor_run_files *files, const mor_registry *registry)
{
    FILE *log = NULL;
    MOR_TRY(context, mor_run_folder_make(context, files->options->folder));
    MOR_TRY(context, mor_run_folder_lock(context, files->options->folder, &log));
    const mor_status status = save_state(context, files, registry);
    mor_run_folder_unlock(&log);
    return status;
}

mor_status mor_run_files_keep(mor_context *context, mor_run_files *files, const mor_run_due *due)
{
    mor_run_kept *kept = &files->kept;
    const mor_state_list *state = &files->simulation->state;
    if (kept->bytes == NULL) {
        MOR_TRY(context, MOR_NEW(context, &kept->bytes, mor_state_bytes(state), "a state to go back to"));
    }
    mor_state_store(state, kept->bytes);
    kept->due = *due;
    kept->is_valid = true;
    return MOR_OK;
}

mor_status mor_run_files_recall(mor_context *context, mor_run_files *files)
{
    mor_state_load(&files->simulation->state, files->kept.bytes);
    return mor_simulation_resume(context, files->simulation);
}

/* Why a state cannot be taken up though the case may go on: what the domain cuts off became more. */
static mor_status explain_refusal(mor_context *context, const mor_run_files *files, mor_status status)
{
    if (status != MOR_ERROR_CONFIG || !mor_case_compare_domains(files->case_text, files->saved_text)) {
        return status;
    }
    return MOR_FAIL(
        context, status,
        "%s; or: the domain was enlarged, and soil without end on a side, and maps, go as far as the domain, so "
        "that it cannot be enlarged there",
        context->message);
}

/* The state stands at its time, counted in the ticks of the run that it comes from; the end may be another. */
static mor_status set_clock(mor_context *context, mor_simulation *s)
{
    mor_schedule *schedule = &s->schedule;
    MOR_TRY(context, mor_schedule_set_end(context, schedule, s->the_case->end));
    MOR_CHECK(context, schedule->end >= schedule->now, MOR_ERROR_CONFIG,
              "found end = %.9g s, but the run stands at t = %.9g s; allowed: an end at that time or later; give a "
              "later 'end'",
              s->the_case->end, mor_schedule_time(schedule));
    return MOR_OK;
}

mor_status mor_run_files_restore(mor_context *context, mor_run_files *files, bool *is_restored)
{
    const char *folder = files->options->folder;
    mor_simulation *s = files->simulation;
    const mor_checkpoint checkpoint = {&s->state, NULL};
    *is_restored = mor_run_folder_has_checkpoint(context, folder);
    if (!*is_restored) {
        mor_context_log(context, MOR_LOG_WARNING, "'%s' holds no checkpoint yet; the run starts from the beginning",
                        folder);
        return MOR_OK;
    }
    const mor_status status = mor_checkpoint_read_latest(context, folder, &checkpoint);
    MOR_TRY(context, status == MOR_OK ? status : explain_refusal(context, files, status));
    MOR_TRY(context, set_clock(context, s));
    MOR_TRY(context, mor_probe_track_resume(context, s->probes));
    MOR_TRY(context, mor_map_track_resume(context, s->maps));
    MOR_TRY(context, mor_simulation_resume(context, s));
    mor_context_log(context, MOR_LOG_INFO, "resumed at t = %.9g s, step %llu", mor_schedule_time(&s->schedule),
                    (unsigned long long)s->schedule.n_steps);
    return MOR_OK;
}
