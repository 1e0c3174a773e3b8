/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A member of a sweep: a session of its own, in a thread of its own. */
#include "cases/driver/library/session_sweep_internal.h"

#include "cases/driver/probe/probe.h"
#include "cases/driver/run/wall_time.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- A session like the one of the sweep ------------------------------------------------------------------------- */

/* Laws that the sweep's session knows; those that each session has are there already. */
static mor_status add_materials(const mor_session *of_sweep, mor_session *own)
{
    for (int k = 0; k < mor_registry_count(of_sweep->registry); ++k) {
        MOR_TRY(&own->context, mor_registry_add(&own->context, own->registry, mor_registry_get(of_sweep->registry, k)));
    }
    return MOR_OK;
}

static mor_status add_settings(mor_session_sweeper *it, int member, mor_session *own)
{
    mor_sweep_settings settings;
    char *command = NULL;
    size_t n_bytes = 0;
    mor_sweep_design_settings(&it->design, it->units, member, &settings);
    for (int k = 0; k < settings.n; ++k) {
        MOR_TRY(&own->context, mor_session_override(own, settings.texts[k]));
    }
    FILE *stream = open_memstream(&command, &n_bytes);
    MOR_CHECK(&own->context, stream != NULL, MOR_ERROR_MEMORY, "no memory for a command");
    const mor_status status = mor_sweep_write_command(&own->context, &it->design, &it->provenance, member, stream);
    if (fclose(stream) == 0 && status == MOR_OK) {
        mor_session_set_command(own, command);
    }
    free(command);
    return status;
}

static mor_status load_member(mor_session_sweeper *it, int member, mor_session *own)
{
    char path[MOR_PATH_BYTES];
    MOR_TRY(&own->context, mor_session_set_threads(own, 1));
    MOR_TRY(&own->context, mor_session_set_cache(own, it->session->cache_folder));
    mor_session_set_guard(own, it->session->context.guard);
    MOR_TRY(&own->context, add_materials(it->session, own));
    MOR_TRY(&own->context, add_settings(it, member, own));
    MOR_TRY(&own->context, mor_sweep_write_find_case(&own->context, &it->design, member, path));
    return mor_session_load_file(own, path);
}

static void set_failed(mor_session_sweeper *it, int member, const char *reason)
{
    mor_sweep_outcome *outcome = &it->table.outcomes[member];
    outcome->state = MOR_SWEEP_STATE_FAILED;
    snprintf(outcome->reason, sizeof outcome->reason, "%s", reason);
}

/* ---- Checking ---------------------------------------------------------------------------------------------------- */

static void note_probes(mor_session_sweeper *it, int member, const mor_case *the_case)
{
    for (int k = 0; k < the_case->n_probes; ++k) {
        mor_sweep_probe probe = {.member = member, .place = k};
        const char *impulse = mor_probe_impulse_unit(the_case, k);
        memcpy(probe.name, the_case->probes[k].name, sizeof probe.name);
        snprintf(probe.unit, sizeof probe.unit, "%s", mor_probe_unit(the_case, k));
        snprintf(probe.impulse_unit, sizeof probe.impulse_unit, "%s", impulse != NULL ? impulse : "");
        mor_sweep_catalog_add(&it->catalog, &probe);
    }
}

void mor_session_sweep_check_member(void *sweeper, int member)
{
    mor_session_sweeper *it = sweeper;
    mor_session *own = NULL;
    uint64_t hash = 0;
    mor_status status = mor_session_new(&own);
    if (status == MOR_OK) {
        status = load_member(it, member, own);
    }
    if (status == MOR_OK) {
        status = mor_run_files_hash_case(&own->context, &own->files, own->the_case.registry, &hash);
    }
    (void)pthread_mutex_lock(&it->lock);
    if (status == MOR_OK) {
        it->case_hashes[member] = hash;
        note_probes(it, member, &own->the_case);
    } else {
        set_failed(it, member, mor_session_message(own));
    }
    it->n_checked += 1;
    (void)pthread_mutex_unlock(&it->lock);
    mor_session_free(&own);
}

/* ---- What a folder holds ----------------------------------------------------------------------------------------- */

static mor_status compare_folder(mor_session_sweeper *it, int member, mor_session *own, mor_case_difference *first)
{
    char folder[MOR_PATH_BYTES];
    mor_context *context = &own->context;
    MOR_TRY(context, load_member(it, member, own));
    MOR_TRY(context, mor_sweep_write_find_folder(context, it->folder, member, folder));
    return mor_run_files_compare_folder(context, &own->files, own->the_case.registry, folder, first);
}

mor_status mor_session_sweep_explain(mor_session_sweeper *it, int member, char *text, size_t text_bytes)
{
    mor_context *context = &it->session->context;
    mor_session *own = NULL;
    mor_case_difference first = {.is_found = false};
    mor_status status = mor_session_new(&own);
    if (status == MOR_OK) {
        status = compare_folder(it, member, own, &first);
    }
    text[0] = '\0';
    if (status == MOR_OK && first.is_found) {
        snprintf(text, text_bytes, "; first difference: %s, was %s%s", first.found, first.expected, first.reason);
    }
    if (status != MOR_OK) {
        status = MOR_FAIL(context, status, "%s", mor_session_message(own));
    }
    mor_session_free(&own);
    return status;
}

/* ---- Running ----------------------------------------------------------------------------------------------------- */

/* The case is still the one that was checked, and the folder holds no other: results of two cases are not mixed. */
static mor_status check_case(mor_session_sweeper *it, int member, mor_session *own, const char *folder)
{
    mor_context *context = &own->context;
    uint64_t now = 0;
    uint64_t held = 0;
    MOR_TRY(context, mor_run_files_hash_case(context, &own->files, own->the_case.registry, &now));
    MOR_CHECK(
        context, now == it->case_hashes[member], MOR_ERROR_CONFIG,
        "the case has changed since the sweep was started; put it back and resume the sweep, or start a new sweep "
        "in another folder");
    MOR_TRY(context, mor_run_files_hash_folder(context, folder, &held));
    MOR_CHECK(context, held == 0 || held == now, MOR_ERROR_CONFIG,
              "the folder '%s' holds another case than the sweep gives to it; remove the folder and resume the sweep",
              folder);
    return MOR_OK;
}

/* A member that ended before: its folder must hold a summary of a run that reached its end. */
static bool is_kept(mor_session_sweeper *it, int member, mor_session *own, const char *folder, const char *summary,
                    mor_status *status)
{
    mor_context quiet; /* of its own: what is missing is run */
    mor_summary_outcome found;
    mor_context_init(&quiet);
    if (!it->is_done[member] || mor_summary_read_outcome(&quiet, summary, &found) != MOR_OK || found.is_failed) {
        return false;
    }
    mor_session_set_folder(own, folder, true);
    *status = mor_run_files_keep_case(&own->context, &own->files, own->the_case.registry, true);
    return true;
}

static mor_status read_value(mor_context *context, const char *path, const mor_sweep_column *column, double *value)
{
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    mor_summary_statistics it;
    if (column->statistic == MOR_CASE_STATISTIC_VALUE) {
        return mor_summary_read_result(context, path, column->probe, value, text, sizeof text);
    }
    MOR_TRY(context, mor_summary_read_statistics(context, path, column->probe, &it, text, sizeof text));
    const double numbers[] = {[MOR_CASE_STATISTIC_MAXIMUM] = it.maximum,
                              [MOR_CASE_STATISTIC_MINIMUM] = it.minimum,
                              [MOR_CASE_STATISTIC_MEAN] = it.mean,
                              [MOR_CASE_STATISTIC_IMPULSE] = it.impulse};
    *value = numbers[column->statistic];
    return MOR_OK;
}

static bool has_probe(const mor_case *the_case, const char *name)
{
    int k = 0;
    while (k < the_case->n_probes && strcmp(the_case->probes[k].name, name) != 0) {
        ++k;
    }
    return k < the_case->n_probes;
}

/* Results come from the summary alone, so that they are the same when the sweep is resumed. Columns of probes that the
 * case does not have stay empty. */
static mor_status read_results(mor_session_sweeper *it, mor_session *own, const char *summary, double *values,
                               mor_summary_outcome *outcome)
{
    mor_context *context = &own->context;
    MOR_TRY(context, mor_summary_read_outcome(context, summary, outcome));
    for (int c = 0; c < it->table.n_columns; ++c) {
        values[c] = NAN;
        if (has_probe(&own->the_case, it->table.columns[c].probe)) {
            MOR_TRY(context, read_value(context, summary, &it->table.columns[c], &values[c]));
        }
    }
    return MOR_OK;
}

/* Whether a folder holds the beginning of a run. A member without one starts as if the sweep had not been stopped, so
 * that its summary has no warning of that either. */
static bool is_begun(mor_context *context, const char *folder)
{
    return mor_run_folder_has_checkpoint(context, folder) || mor_run_folder_has(context, folder, MOR_SUMMARY_FILE);
}

static mor_status take_up(mor_session_sweeper *it, int member, mor_session *own, char *folder, char *summary)
{
    mor_context *context = &own->context;
    MOR_TRY(context, mor_sweep_write_find_folder(context, it->folder, member, folder));
    MOR_TRY(context, mor_durable_file_join(context, summary, folder, MOR_SUMMARY_FILE));
    MOR_TRY(context, load_member(it, member, own));
    return check_case(it, member, own, folder);
}

/* Runs the member, or takes what is there. Returns false when it was stopped. */
static bool compute(mor_session_sweeper *it, int member, mor_session *own, double *values, mor_summary_outcome *found,
                    mor_status *status)
{
    char folder[MOR_PATH_BYTES];
    char summary[MOR_PATH_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    *status = take_up(it, member, own, folder, summary);
    if (*status == MOR_OK && !is_kept(it, member, own, folder, summary, status)) {
        const bool is_resume = it->is_resume && is_begun(&own->context, folder);
        *status = mor_session_run(own, folder, is_resume, NAN, &outcome);
    }
    if (*status == MOR_OK && outcome != MOR_SESSION_INTERRUPTED) {
        *status = read_results(it, own, summary, values, found);
    }
    return *status != MOR_OK || outcome != MOR_SESSION_INTERRUPTED;
}

/* Adds the member to those that need not run again. */
static void note_done(mor_session_sweeper *it, int member)
{
    if (!it->is_done[member]) {
        fprintf(it->done, "%d\n", member + 1);
        (void)fflush(it->done);
        (void)fsync(fileno(it->done)); /* a member that is not on the list is looked at again: no harm */
    }
}

static void note_end(mor_session_sweeper *it, int member, const mor_session *own, const double *values,
                     const mor_summary_outcome *found, mor_status status)
{
    mor_sweep_outcome *outcome = &it->table.outcomes[member];
    if (status != MOR_OK) {
        set_failed(it, member, mor_session_message(own));
    } else {
        outcome->state = found->n_missed > 0 ? MOR_SWEEP_STATE_MISSED : MOR_SWEEP_STATE_FINISHED;
        outcome->n_missed = found->n_missed;
        outcome->n_warnings = found->n_warnings;
        const int64_t row = (int64_t)member * it->table.n_columns;
        memcpy(it->table.values + row, values, (size_t)it->table.n_columns * sizeof *values);
        for (int c = 0; c < it->table.n_columns; ++c) {
            it->table.has_probe[row + c] = has_probe(&own->the_case, it->table.columns[c].probe);
        }
        note_done(it, member);
    }
    fprintf(it->log, "member %d %s%s%s\n", member + 1, mor_sweep_state_words[outcome->state],
            outcome->reason[0] != '\0' ? ": " : "", outcome->reason);
    (void)fflush(it->log);
}

/* Puts a session among those that a stop is passed on to; NULL: takes it away. Returns whether one is requested. */
static bool set_running(mor_session_sweeper *it, int member, mor_session *own)
{
    (void)pthread_mutex_lock(&it->lock);
    it->running[member] = own;
    const bool is_stopping = mor_session_is_stopping(it->session);
    if (own != NULL && !is_stopping) {
        it->table.outcomes[member].state = MOR_SWEEP_STATE_RUNNING;
    }
    (void)pthread_mutex_unlock(&it->lock);
    return is_stopping;
}

void mor_session_sweep_run_member(void *sweeper, int member)
{
    mor_session_sweeper *it = sweeper;
    mor_session *own = NULL;
    double values[MOR_SWEEP_COLUMNS_MAX];
    mor_summary_outcome found = {.is_failed = false};
    const double before = mor_wall_time();
    bool is_ended = false;
    if (it->table.outcomes[member].state == MOR_SWEEP_STATE_FAILED || mor_session_is_stopping(it->session)) {
        return;
    }
    mor_status status = mor_session_new(&own);
    if (status != MOR_OK) {
        is_ended = true;
    } else if (!set_running(it, member, own)) {
        is_ended = compute(it, member, own, values, &found, &status);
    }
    set_running(it, member, NULL);
    (void)pthread_mutex_lock(&it->lock);
    if (is_ended) {
        note_end(it, member, own, values, &found, status);
        it->n_ended_here += !it->is_done[member];
        it->busy_seconds += it->is_done[member] ? 0.0 : mor_wall_time() - before;
    } else if (it->table.outcomes[member].state == MOR_SWEEP_STATE_RUNNING) {
        it->table.outcomes[member].state = MOR_SWEEP_STATE_INTERRUPTED;
    }
    (void)pthread_mutex_unlock(&it->lock);
    mor_session_free(&own);
}
