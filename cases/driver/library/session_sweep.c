/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A sweep: checked as a whole, run by threads, evaluated. */
#include "cases/driver/library/session_sweep_internal.h"

#include "cases/driver/run/wall_time.h"
#include "cases/driver/sweep/result/sweep_charts.h"
#include "cases/driver/sweep/sweep_keys.h"
#include "cases/driver/sweep/sweep_pool.h"
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/io/hdf5_file.h"
#include "moraine_build.h"

#include <math.h>
#include <string.h>

/* Seconds between two tables of members while they run. */
#define TABLE_INTERVAL 10.0

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static mor_status read_sweep(mor_session_sweeper *it, const char *path)
{
    mor_session *session = it->session;
    mor_context *context = &session->context;
    MOR_TRY(context, mor_units_new(context, &it->units));
    MOR_TRY(context, mor_sweep_read(context, path, it->units, &it->sweep));
    it->sweep.overrides = (const char *const *)session->overrides;
    it->sweep.n_overrides = session->n_overrides;
    MOR_TRY(context, mor_sweep_design_make(context, &it->sweep, &it->design));
    MOR_TRY(context, mor_sweep_table_make(context, &it->design, &it->table));
    MOR_TRY(context, MOR_NEW(context, &it->is_done, it->design.n_members, "members of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &it->case_hashes, it->design.n_members, "members of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &it->running, it->design.n_members, "members of a sweep"));
    it->provenance = (mor_sweep_provenance){.run_word = mor_element_names_find(&session->names, "run"),
                                            .set_word = mor_element_names_find(&session->names, "set"),
                                            .units = it->units,
                                            .version = MOR_VERSION,
                                            .commit = MOR_COMMIT,
                                            .command = session->command,
                                            .n_threads = context->n_threads};
    return mor_hash_file(context, path, &it->provenance.sweep_hash);
}

/* ---- Checking ---------------------------------------------------------------------------------------------------- */

/* Nothing is lost when a check is given up. Placing rocks can take minutes for all members. */
static void watch_checks(void *user)
{
    mor_session_sweeper *it = user;
    char line[MOR_RUN_PROGRESS_BYTES];
    (void)pthread_mutex_lock(&it->lock);
    if (mor_run_progress_is_due(&it->progress, mor_wall_time())) {
        snprintf(line, sizeof line, "checked the cases of %d of %d members", it->n_checked, it->design.n_members);
        mor_run_progress_show(&it->progress, line);
    }
    (void)pthread_mutex_unlock(&it->lock);
}

static void begin_progress(mor_session_sweeper *it)
{
    it->progress = (mor_run_progress){
        .stream = it->session->progress, .is_terminal = it->session->is_terminal, .last = mor_wall_time()};
}

/* What is wrong, without the value that a member has: a wrong key is wrong with each of them. */
static const char *skip_override(const char *reason)
{
    static const char start[] = "override '";
    const char *end = strncmp(reason, start, sizeof start - 1) == 0 ? strstr(reason, "': ") : NULL;
    return end != NULL ? end + 3 : reason;
}

static bool is_alike(const mor_sweep_outcome *one, const mor_sweep_outcome *other)
{
    return other->state == MOR_SWEEP_STATE_FAILED &&
           strcmp(skip_override(one->reason), skip_override(other->reason)) == 0;
}

/* A reason with the place in the sweep file that it comes from. */
static void log_reason(mor_session_sweeper *it, const char *who, const char *reason)
{
    const bool has_override = skip_override(reason) != reason;
    const mor_sweep_variable *variable =
        has_override ? mor_sweep_keys_find(&it->sweep, strchr(reason, '\'') + 1) : NULL;
    if (variable != NULL) {
        mor_context_log(&it->session->context, MOR_LOG_ERROR, "%s: %s:%d: variable '%s': %s", who, variable->place.file,
                        variable->place.line, variable->name, reason);
    } else {
        mor_context_log(&it->session->context, MOR_LOG_ERROR, "%s: %s", who, reason);
    }
}

/* Tells each reason once, with the members that it holds for. */
static void log_refused(mor_session_sweeper *it)
{
    enum { REASONS_MAX = 50, WHO_BYTES = 64 };
    const mor_sweep_outcome *outcomes = it->table.outcomes;
    int n_told = 0;
    for (int m = 0; m < it->design.n_members && n_told < REASONS_MAX; ++m) {
        char who[WHO_BYTES];
        int n_alike = 0;
        bool is_new = outcomes[m].state == MOR_SWEEP_STATE_FAILED;
        for (int other = 0; other < m && is_new; ++other) {
            is_new = !is_alike(&outcomes[m], &outcomes[other]);
        }
        for (int other = m + 1; other < it->design.n_members && is_new; ++other) {
            n_alike += is_alike(&outcomes[m], &outcomes[other]);
        }
        snprintf(who, sizeof who, n_alike > 0 ? "member %d and %d more" : "member %d", m + 1, n_alike);
        if (is_new) {
            log_reason(it, who, outcomes[m].reason);
        }
        n_told += is_new;
    }
}

/* The cases of all members are read before the first one runs. */
static mor_status check_members(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    mor_sweep_counts counts;
    const mor_sweep_jobs jobs = {.n = it->design.n_members,
                                 .n_threads = context->n_threads,
                                 .work = mor_session_sweep_check_member,
                                 .watch = watch_checks,
                                 .user = it};
    begin_progress(it);
    const mor_status status = mor_sweep_pool_run(context, &jobs);
    mor_run_progress_end(&it->progress);
    MOR_TRY(context, status);
    mor_sweep_table_count(&it->table, -1, &counts);
    const int n_refused = counts.by_state[MOR_SWEEP_STATE_FAILED];
    log_refused(it);
    MOR_CHECK(context, n_refused == 0 || (it->sweep.refused == MOR_SWEEP_REFUSED_SKIP && n_refused < counts.n_members),
              MOR_ERROR_CONFIG,
              "%s: the cases of %d of %d members are refused, see above; nothing was run; correct them%s",
              it->sweep.path, n_refused, counts.n_members,
              n_refused < counts.n_members ? ", or let refused_cases = \"skip\" count them as failed" : "");
    MOR_TRY(context, mor_sweep_design_check_distinct(context, &it->design, it->case_hashes));
    MOR_TRY(context, mor_sweep_catalog_columns(context, &it->catalog, it->units, &it->sweep, &it->table));
    return mor_sweep_table_add_values(context, &it->table);
}

/* What would be run. */
static mor_status print_plan(mor_session_sweeper *it)
{
    FILE *out = it->session->output;
    fprintf(out, "%d members in %d group%s, %d column%s of results\n", it->design.n_members, it->design.n_groups,
            it->design.n_groups == 1 ? "" : "s", it->table.n_columns, it->table.n_columns == 1 ? "" : "s");
    for (int m = 0; m < it->design.n_members; ++m) {
        char number[16];
        mor_sweep_write_number(m, number);
        fprintf(out, "%s  ", number);
        MOR_TRY(&it->session->context,
                mor_sweep_write_command(&it->session->context, &it->design, &it->provenance, m, out));
        fprintf(out, "\n");
    }
    return MOR_OK;
}

/* ---- Running ----------------------------------------------------------------------------------------------------- */

static void show_progress(mor_session_sweeper *it)
{
    mor_sweep_counts counts;
    char line[MOR_RUN_PROGRESS_BYTES];
    char left[64] = "";
    mor_sweep_table_count(&it->table, -1, &counts);
    const int n_failed = counts.by_state[MOR_SWEEP_STATE_FAILED];
    const int n_running = counts.by_state[MOR_SWEEP_STATE_RUNNING];
    const int n_ended = counts.n_used + n_failed;
    if (it->n_ended_here > 0) { /* members at work are half done, in the mean */
        const double n_left = counts.n_members - n_ended - 0.5 * n_running;
        const int n_threads = it->session->context.n_threads;
        const double seconds = it->busy_seconds / it->n_ended_here * fmax(n_left, 0.0) / n_threads;
        snprintf(left, sizeof left, ", about %.0f min %02d s left", floor(seconds / 60.0), (int)fmod(seconds, 60.0));
    }
    snprintf(line, sizeof line, "%d of %d members done, %d running, %d failed%s%s", n_ended, counts.n_members,
             n_running, n_failed, left, mor_session_is_stopping(it->session) ? "; stopping" : "");
    mor_run_progress_show(&it->progress, line);
}

static void watch_members(void *user)
{
    mor_session_sweeper *it = user;
    const double now = mor_wall_time();
    (void)pthread_mutex_lock(&it->lock);
    for (int m = 0; m < it->design.n_members && mor_session_is_stopping(it->session); ++m) {
        if (it->running[m] != NULL) {
            mor_session_request_stop(it->running[m]);
        }
    }
    if (now - it->last_table >= TABLE_INTERVAL) { /* whether it can be written is told at the end */
        (void)mor_sweep_write_members(&it->session->context, &it->table, &it->provenance, it->folder);
        it->last_table = now;
    }
    if (mor_run_progress_is_due(&it->progress, now)) {
        show_progress(it);
    }
    (void)pthread_mutex_unlock(&it->lock);
}

static mor_status run_members(mor_session_sweeper *it)
{
    mor_session *session = it->session;
    const bool is_safe = mor_hdf5_file_is_thread_safe();
    const mor_sweep_jobs jobs = {.n = it->design.n_members,
                                 .n_threads = is_safe ? session->context.n_threads : 1,
                                 .work = mor_session_sweep_run_member,
                                 .watch = watch_members,
                                 .user = it};
    if (!is_safe) {
        mor_context_log(&session->context, MOR_LOG_WARNING,
                        "members run one after another: the HDF5 library is not its thread-safe build");
    }
    it->last_table = mor_wall_time();
    begin_progress(it);
    const mor_status status = mor_sweep_pool_run(&session->context, &jobs);
    mor_run_progress_end(&it->progress);
    return status;
}

/* Tables and charts of a sweep that has ended; of one that was stopped, its members. */
static mor_status conclude(mor_session_sweeper *it, bool is_ended)
{
    mor_session *session = it->session;
    mor_context *context = &session->context;
    mor_context_clear_error(context);
    MOR_TRY(context, mor_sweep_write_members(context, &it->table, &it->provenance, it->folder));
    if (!is_ended) {
        fprintf(session->output, "the sweep was stopped; it can be resumed, and has no statistics yet\n");
        return MOR_OK;
    }
    mor_sweep_warnings warnings = {.n = 0};
    mor_status status = mor_sweep_write_statistics(context, &it->table, it->folder);
    if (status == MOR_OK) {
        status = mor_sweep_warnings_collect(context, &it->table, it->folder, &warnings);
    }
    if (status == MOR_OK) {
        status = mor_sweep_write_summary(context, &it->table, &it->provenance, &warnings, it->folder);
    }
    if (status == MOR_OK) {
        status = mor_sweep_write_report(context, &it->table, &it->provenance, &warnings, session->output);
    }
    mor_sweep_warnings_clear(context, &warnings);
    return status == MOR_OK ? mor_sweep_charts_draw(context, &it->table, it->folder, session->output) : status;
}

static mor_status run_sweep(mor_session_sweeper *it, mor_session_sweep_counts *found)
{
    mor_context *context = &it->session->context;
    mor_sweep_counts counts;
    MOR_TRY(context, mor_session_sweep_open(it));
    mor_stop_enter(&it->session->stop, MOR_STOP_AFTER_WRITING);
    mor_status status = run_members(it);
    mor_sweep_table_count(&it->table, -1, &counts);
    *found = (mor_session_sweep_counts){.n_members = counts.n_members,
                                        .n_used = counts.n_used,
                                        .n_failed = counts.by_state[MOR_SWEEP_STATE_FAILED],
                                        .n_missed = counts.by_state[MOR_SWEEP_STATE_MISSED]};
    found->is_ended = found->n_used + found->n_failed == found->n_members;
    if (status == MOR_OK) {
        status = conclude(it, found->is_ended);
    }
    mor_stop_enter(&it->session->stop, MOR_STOP_AT_ONCE);
    return status;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

static mor_status do_sweep(mor_session_sweeper *it, const char *path, mor_session_sweep_counts *counts)
{
    mor_context *context = &it->session->context;
    MOR_TRY(context, read_sweep(it, path));
    MOR_TRY(context, check_members(it));
    counts->n_members = it->design.n_members;
    return it->folder == NULL ? print_plan(it) : run_sweep(it, counts);
}

mor_status mor_session_sweep(mor_session *session, const char *path, const char *folder, bool is_resume,
                             mor_session_sweep_counts *counts)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    mor_session_sweeper *it = NULL;
    *counts = (mor_session_sweep_counts){.n_members = 0};
    MOR_TRY(context, MOR_NEW(context, &it, 1, "a sweep"));
    it->session = session;
    it->folder = folder;
    it->is_resume = is_resume;
    (void)pthread_mutex_init(&it->lock, NULL);
    const mor_status status = do_sweep(it, path, counts);
    mor_session_sweep_close(it);
    (void)pthread_mutex_destroy(&it->lock);
    mor_sweep_table_clear(context, &it->table);
    mor_sweep_design_clear(context, &it->design);
    mor_sweep_clear(context, &it->sweep);
    mor_units_free(context, &it->units);
    MOR_FREE(context, &it->is_done);
    MOR_FREE(context, &it->case_hashes);
    MOR_FREE(context, &it->running);
    MOR_FREE(context, &it);
    return status;
}
