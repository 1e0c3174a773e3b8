/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Folders of a session: a state is saved and resumed, a run fills one, pictures are drawn. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/picture/rocks_report.h"
#include "cases/driver/run/run.h"
#include "cases/driver/run/run_step.h"

#include <string.h>
#include <unistd.h>

mor_status mor_session_save(mor_session *session, const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_READY, MOR_SESSION_READY));
    mor_session_set_folder(session, folder, false);
    return mor_run_files_save_state(context, &session->files, session->the_case.registry);
}

mor_status mor_session_resume(mor_session *session, const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    bool is_restored = false;
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_BUILT));
    mor_session_set_folder(session, folder, true);
    MOR_CHECK(context, mor_run_folder_has_checkpoint(context, folder), MOR_ERROR_IO,
              "found no checkpoint in '%s'; give a folder that mor_session_save or a run wrote", folder);
    MOR_TRY(context, mor_run_files_keep_case(context, &session->files, session->the_case.registry, true));
    const mor_status status = mor_run_files_restore(context, &session->files, &is_restored);
    if (status != MOR_OK) {
        mor_session_clear_simulation(session);
        return status;
    }
    session->stage = MOR_SESSION_READY;
    session->next_snapshot = mor_run_find_snapshot(&session->simulation, 1);
    return MOR_OK;
}

/* The case stays loaded: another folder, or another try, may do. */
static void withdraw_run(mor_session *session)
{
    mor_session_clear_simulation(session);
    if (mor_run_files_withdraw(&session->context, &session->files) != MOR_OK) {
        mor_session_clear_case(session);
    }
}

mor_status mor_session_run(mor_session *session, const char *folder, bool is_resume, double stop_time,
                           mor_session_outcome *outcome)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    mor_run_outcome found;
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_LOADED, MOR_SESSION_LOADED));
    mor_session_set_folder(session, folder, is_resume);
    session->options.stop_at = stop_time;
    const mor_status status = mor_run(context, &session->files, session->the_case.registry, &found);
    if (session->files.series.stream == NULL) { /* refused, or ended while it settled */
        withdraw_run(session);
    } else {
        mor_run_files_close(context, &session->files);
        memset(&session->files, 0, sizeof session->files);
        session->is_failed = status != MOR_OK;
        session->stage = MOR_SESSION_ENDED;
    }
    *outcome = found.is_interrupted ? MOR_SESSION_INTERRUPTED
               : found.n_missed > 0 ? MOR_SESSION_MISSED
               : !found.is_finished ? MOR_SESSION_STOPPED
                                    : MOR_SESSION_FINISHED;
    return status;
}

/* Writes the state a run would start from as a snapshot into a folder, and draws it. */
mor_status mor_session_preview(mor_session *session, const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    char images[MOR_PATH_BYTES];
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_BUILT));
    const int n_sets = mor_simulation_sets(&session->simulation, false, sets);
    MOR_TRY(context, mor_run_folder_refuse_run(context, folder, "choose another folder"));
    MOR_TRY(context, mor_durable_file_join(context, images, folder, "images"));
    MOR_TRY(context, mor_run_folder_make(context, images));
    MOR_TRY(context, mor_session_write_snapshot(session, folder, sets, n_sets, 0.0));
    mor_rocks_report_print(&session->the_case, session->output);
    return mor_pictures_render(context, &session->the_case, folder, MOR_PICTURES_FIRST, session->output);
}

mor_status mor_session_write_snapshot(mor_session *session, const char *folder, mor_set *const *sets, int n_sets,
                                      double time)
{
    mor_context *context = &session->context;
    mor_snapshot_writer writer;
    const mor_snapshot_fact facts[] = {
        {"version", mor_version()}, {"commit", mor_commit()}, {"command", session->command}};
    const mor_snapshot_options options = {.facts = facts, .n_facts = 3};
    MOR_TRY(context, mor_snapshot_writer_init(context, &writer, folder, &options, -1));
    const mor_status status = mor_snapshot_writer_add(context, &writer, sets, n_sets, 0, time);
    mor_snapshot_writer_clear(context, &writer);
    return status;
}

mor_status mor_session_render(mor_session *session, const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_CASE_FILE));
    MOR_CHECK(context, access(path, R_OK) == 0, MOR_ERROR_CONFIG,
              "'%s' is not the folder of a run: it holds no case.resolved.cfg; give a folder that a run wrote", folder);
    MOR_TRY(context, mor_session_load_file(session, path));
    return mor_pictures_render(context, &session->the_case, folder, MOR_PICTURES_ALL, session->output);
}
