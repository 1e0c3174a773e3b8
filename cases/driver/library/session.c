/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/case/sections/case_read.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "materials/builtin.h"
#include "materials/interfaces/interfaces.h"
#include "moraine_build.h"

#include <math.h>
#include <string.h>

enum { THREADS_MAX = 1024 };

const char *mor_version(void)
{
    return MOR_VERSION;
}

const char *mor_commit(void)
{
    return MOR_COMMIT;
}

/* ---- Making and ending ------------------------------------------------------------------------------------------- */

static ssize_t swallow(void *nothing, const char *text, size_t n_bytes)
{
    (void)nothing;
    (void)text;
    return (ssize_t)n_bytes;
}

static mor_status fill_session(mor_session *session)
{
    mor_context *context = &session->context;
    session->silence = fopencookie(NULL, "w", (cookie_io_functions_t){.write = swallow});
    session->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    MOR_CHECK(context, session->silence != NULL && session->locale != (locale_t)0, MOR_ERROR_MEMORY,
              "no memory for a session");
    session->output = session->silence;
    snprintf(session->command, sizeof session->command, "libmoraine");
    MOR_TRY(context, mor_registry_new(context, &session->registry));
    MOR_TRY(context, mor_interfaces_add(context, session->registry));
    return mor_registry_add_list(context, session->registry, mor_materials_builtin(NULL));
}

mor_status mor_session_new(mor_session **session)
{
    mor_context context;
    mor_context_init(&context);
    MOR_TRY(&context, MOR_NEW(&context, session, 1, "a session"));
    (*session)->context = context;
    const mor_status status = fill_session(*session);
    if (status != MOR_OK) {
        mor_session_free(session);
    }
    return status;
}

void mor_session_free(mor_session **session)
{
    mor_session *it = *session;
    if (it == NULL) {
        return;
    }
    mor_session_clear_case(it);
    mor_registry_free(&it->context, &it->registry);
    for (int k = 0; k < it->n_plugins; ++k) {
        mor_plugin_unload(&it->context, &it->plugins[k]);
    }
    mor_session_clear_overrides(it);
    if (it->silence != NULL) {
        fclose(it->silence);
    }
    if (it->locale != (locale_t)0) {
        freelocale(it->locale);
    }
    mor_context context = it->context; /* the session lies in memory that it counts */
    MOR_FREE(&context, session);
}

void mor_session_clear_simulation(mor_session *session)
{
    mor_simulation_clear(&session->context, &session->simulation);
    session->is_failed = false;
    session->next_snapshot = 0;
    session->stage = session->stage > MOR_SESSION_LOADED ? MOR_SESSION_LOADED : session->stage;
}

void mor_session_clear_case(mor_session *session)
{
    mor_session_clear_simulation(session);
    mor_run_files_close(&session->context, &session->files);
    memset(&session->files, 0, sizeof session->files);
    mor_case_clear(&session->context, &session->the_case);
    session->stage = MOR_SESSION_EMPTY;
}

/* ---- Work -------------------------------------------------------------------------------------------------------- */

locale_t mor_session_begin_work(mor_session *session)
{
    mor_context_clear_error(&session->context);
    return uselocale(session->locale);
}

void mor_session_end_work(const locale_t *previous)
{
    uselocale(*previous);
}

/* ---- Errors ------------------------------------------------------------------------------------------------------ */

const char *mor_session_message(const mor_session *session)
{
    return session == NULL ? "no memory for a session" : session->context.message;
}

mor_status mor_session_enter(mor_session *session, mor_session_stage first, mor_session_stage last)
{
    static const char *const found[] = {
        [MOR_SESSION_EMPTY] = "no case is loaded; call mor_session_load_file or mor_session_load_text first",
        [MOR_SESSION_LOADED] = "the case is loaded, but not built; call mor_session_build first",
        [MOR_SESSION_BUILT] = "the case is built, but not at rest; call mor_session_settle or mor_session_resume first",
        [MOR_SESSION_READY] = "the case is under way; load it again to begin anew",
        [MOR_SESSION_ENDED] = "the case has come to an end; load it again to begin anew"};
    if (session->stage > last && session->stage == MOR_SESSION_BUILT) {
        return MOR_FAIL(&session->context, MOR_ERROR_ARGUMENT,
                        "the case is built already; load it again to begin anew");
    }
    MOR_CHECK(&session->context, session->stage >= first && session->stage <= last, MOR_ERROR_ARGUMENT, "%s",
              found[session->stage]);
    return MOR_OK;
}

/* ---- Settings ---------------------------------------------------------------------------------------------------- */

void mor_session_set_log(mor_session *session, mor_log_sink sink, void *user)
{
    const bool is_listening = session->files.log != NULL;
    *(is_listening ? &session->files.previous_sink : &session->context.log_sink) = sink;
    *(is_listening ? &session->files.previous_user : &session->context.log_user) = user;
}

void mor_session_set_guard(mor_session *session, mor_session_guard guard)
{
    session->context.guard = guard;
}

mor_status mor_session_set_threads(mor_session *session, int n_threads)
{
    MOR_SESSION_WORK(session);
    MOR_CHECK(&session->context, n_threads >= 0 && n_threads <= THREADS_MAX, MOR_ERROR_ARGUMENT,
              "found %d threads; allowed: 1 to %d, or 0 for as many as there are cores", n_threads, THREADS_MAX);
    session->context.n_threads = n_threads > 0 ? n_threads : mor_parallel_cores();
    return MOR_OK;
}

mor_status mor_session_set_cache(mor_session *session, const char *folder)
{
    MOR_SESSION_WORK(session);
    const char *text = folder != NULL ? folder : "";
    MOR_CHECK(&session->context, strlen(text) < sizeof session->cache_folder, MOR_ERROR_ARGUMENT,
              "the path of the folder for relaxed particles has %zu bytes; at most %zu are allowed", strlen(text),
              sizeof session->cache_folder - 1);
    strcpy(session->cache_folder, text);
    session->context.cache_folder = session->cache_folder;
    return MOR_OK;
}

void mor_session_set_output(mor_session *session, FILE *output)
{
    session->output = output != NULL ? output : session->silence;
}

void mor_session_set_progress(mor_session *session, FILE *progress, bool is_terminal)
{
    session->progress = progress;
    session->is_terminal = is_terminal;
}

void mor_session_set_command(mor_session *session, const char *command)
{
    snprintf(session->command, sizeof session->command, "%s", command);
}

void mor_session_set_folder(mor_session *session, const char *folder, bool is_resume)
{
    session->options = (mor_run_options){.folder = folder,
                                         .is_resume = is_resume,
                                         .stop_at = NAN,
                                         .command = session->command,
                                         .version = MOR_VERSION,
                                         .commit = MOR_COMMIT,
                                         .stop = &session->stop,
                                         .output = session->output,
                                         .progress = session->progress,
                                         .is_terminal = session->is_terminal};
    session->files.options = &session->options;
}

mor_status mor_session_override(mor_session *session, const char *setting)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    char *copy = NULL;
    const size_t n_bytes = strlen(setting) + 1;
    MOR_CHECK(context, session->n_overrides < MOR_SESSION_OVERRIDES_MAX, MOR_ERROR_ARGUMENT,
              "found more than %d overrides; put some of them into the case", MOR_SESSION_OVERRIDES_MAX);
    MOR_TRY(context, MOR_NEW(context, &copy, (int64_t)n_bytes, "an override"));
    memcpy(copy, setting, n_bytes);
    session->overrides[session->n_overrides++] = copy;
    return MOR_OK;
}

mor_status mor_session_name_setting(mor_session *session, const char *key, const char *name)
{
    MOR_SESSION_WORK(session);
    const mor_status status = mor_element_names_set(&session->names, key, name);
    MOR_CHECK(&session->context, status == MOR_OK, MOR_ERROR_ARGUMENT,
              "found the name '%.80s' for '%.80s'; allowed: fewer than %d bytes each, and up to %d keys", name, key,
              MOR_ELEMENT_NAMES_BYTES, MOR_ELEMENT_NAMES_MAX);
    return MOR_OK;
}

void mor_session_clear_overrides(mor_session *session)
{
    while (session->n_overrides > 0) {
        MOR_FREE(&session->context, &session->overrides[--session->n_overrides]);
    }
}

mor_status mor_session_add_material(mor_session *session, const struct mor_material *material)
{
    MOR_SESSION_WORK(session);
    return mor_registry_add(&session->context, session->registry, material);
}

mor_status mor_session_add_plugin(mor_session *session, const char *path)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    mor_plugin *plugin = NULL;
    MOR_CHECK(context, session->n_plugins < MOR_SESSION_PLUGINS_MAX, MOR_ERROR_ARGUMENT,
              "found more than %d plug-ins; put some of the laws into one file", MOR_SESSION_PLUGINS_MAX);
    MOR_TRY(context, mor_plugin_load(context, path, &plugin));
    const mor_status status = mor_plugin_register(context, plugin, session->registry);
    if (status != MOR_OK) {
        mor_plugin_unload(context, &plugin);
        return status;
    }
    session->plugins[session->n_plugins++] = plugin;
    return MOR_OK;
}

/* ---- Stopping ---------------------------------------------------------------------------------------------------- */

void mor_session_request_stop(mor_session *session)
{
    session->stop.is_requested = 1;
}

void mor_session_clear_stop(mor_session *session)
{
    session->stop.is_requested = 0;
}

bool mor_session_is_stopping(const mor_session *session)
{
    return session->stop.is_requested != 0;
}

mor_session_phase mor_session_find_phase(const mor_session *session)
{
    const int phase = session->stop.phase; /* once: it may change meanwhile */
    return phase == MOR_STOP_AFTER_STEP      ? MOR_SESSION_STEPPING
           : phase == MOR_STOP_AFTER_WRITING ? MOR_SESSION_WRITING
                                             : MOR_SESSION_IDLE;
}
