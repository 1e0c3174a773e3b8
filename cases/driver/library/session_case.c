/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A case is loaded, built, settled and stepped. */
#include "cases/driver/library/session_internal.h"
#include "cases/driver/probe/probe.h"

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/run/run_step.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/base/hash.h"

#include <math.h>
#include <string.h>

/* ---- Loading ----------------------------------------------------------------------------------------------------- */

/* What is logged from here on belongs to the case: a run of it begins its log with it. */
static mor_status begin_case(mor_session *session)
{
    mor_session_clear_case(session);
    return mor_run_files_listen(&session->context, &session->files);
}

static mor_status end_loading(mor_session *session, mor_status status)
{
    if (status != MOR_OK) {
        mor_session_clear_case(session);
        return status;
    }
    session->stage = MOR_SESSION_LOADED;
    session->files.the_case = &session->the_case;
    session->files.simulation = &session->simulation;
    return MOR_OK;
}

mor_status mor_session_load_file(mor_session *session, const char *path)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    MOR_TRY(context, begin_case(session));
    mor_status status = mor_case_read(context, path, (const char *const *)session->overrides, session->n_overrides,
                                      session->registry, mor_probe_type_at, &session->the_case);
    if (status == MOR_OK) {
        status = mor_hash_file(context, path, &session->files.case_hash);
    }
    return end_loading(session, status);
}

mor_status mor_session_load_text(mor_session *session, const char *name, const char *text)
{
    MOR_SESSION_WORK(session);
    const mor_case_text given = {.name = name,
                                 .text = text,
                                 .n_bytes = (int64_t)strlen(text),
                                 .settings = (const char *const *)session->overrides,
                                 .n_settings = session->n_overrides,
                                 .registry = session->registry,
                                 .probe_types = mor_probe_type_at};
    MOR_TRY(&session->context, begin_case(session));
    session->files.case_hash = mor_hash_bytes(text, strlen(text));
    return end_loading(session, mor_case_read_text(&session->context, &given, &session->the_case));
}

/* ---- Building and settling --------------------------------------------------------------------------------------- */

mor_status mor_session_build(mor_session *session)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_LOADED, MOR_SESSION_LOADED));
    const mor_registry *registry = session->the_case.registry;
    MOR_TRY(context, mor_simulation_init(context, &session->simulation, &session->the_case, registry));
    const int n_sets = mor_simulation_sets(&session->simulation, false, sets);
    const mor_status status = mor_pictures_check(context, &session->the_case, sets, n_sets);
    if (status != MOR_OK) {
        mor_session_clear_simulation(session);
        return status;
    }
    session->stage = MOR_SESSION_BUILT;
    return MOR_OK;
}

static mor_status settle(mor_session *session)
{
    mor_context *context = &session->context;
    const mor_settle_observer observer = {.stop = &session->stop.is_requested};
    MOR_TRY(context, mor_simulation_warn(context, &session->simulation));
    MOR_TRY(context, mor_simulation_settle(context, &session->simulation, &observer));
    MOR_CHECK(context, !mor_session_is_stopping(session), MOR_NOT_CONVERGED,
              "a stop was requested while the initial stress settled; build the case again");
    return MOR_OK;
}

mor_status mor_session_settle(mor_session *session)
{
    MOR_SESSION_WORK(session);
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_BUILT));
    const mor_status status = settle(session);
    if (status != MOR_OK) {
        mor_session_clear_simulation(session);
        return status;
    }
    session->stage = MOR_SESSION_READY;
    session->next_snapshot = mor_run_find_snapshot(&session->simulation, 1);
    return MOR_OK;
}

/* ---- Stepping ---------------------------------------------------------------------------------------------------- */

static mor_status take_step(mor_session *session, int64_t until)
{
    mor_simulation *simulation = &session->simulation;
    const int64_t snapshot = mor_run_snapshot_tick(simulation, session->next_snapshot);
    mor_stop_enter(&session->stop, MOR_STOP_AFTER_STEP);
    double seconds = 0.0;
    const mor_status status =
        mor_run_step(&session->context, simulation, until < snapshot ? until : snapshot, &seconds);
    mor_stop_enter(&session->stop, MOR_STOP_AT_ONCE);
    if (status != MOR_OK) { /* arrays are half changed */
        session->is_failed = true;
        session->stage = MOR_SESSION_ENDED;
        return status;
    }
    session->next_snapshot = mor_run_find_snapshot(simulation, session->next_snapshot);
    return MOR_OK;
}

mor_status mor_session_step(mor_session *session)
{
    MOR_SESSION_WORK(session);
    const mor_schedule *schedule = &session->simulation.schedule;
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_READY, MOR_SESSION_READY));
    MOR_CHECK(&session->context, schedule->now < schedule->end, MOR_ERROR_ARGUMENT,
              "the end of the case, t = %g s, is reached; give the case a later 'end'", session->the_case.end);
    return take_step(session, schedule->end);
}

mor_status mor_session_step_to(mor_session *session, double time)
{
    MOR_SESSION_WORK(session);
    const mor_schedule *schedule = &session->simulation.schedule;
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_READY, MOR_SESSION_READY));
    /* In seconds first: the ticks of a far time have no room. A time that was reached may be asked for again. */
    const bool is_inside = time >= 0.0 && time <= fmax(session->the_case.end, (double)schedule->end * schedule->tick);
    const int64_t ticks = is_inside ? mor_schedule_ticks(schedule, time) : -1;
    MOR_CHECK(&session->context, ticks >= schedule->now, MOR_ERROR_ARGUMENT,
              "found t = %g s to step to; allowed: from the present %g s to the end of the case at %g s; give the case "
              "a later 'end'",
              time, mor_schedule_time(schedule), session->the_case.end);
    const int64_t until = ticks < schedule->end ? ticks : schedule->end;
    while (schedule->now < until && !mor_session_is_stopping(session)) {
        MOR_TRY(&session->context, take_step(session, until));
    }
    return MOR_OK;
}

double mor_session_time(const mor_session *session)
{
    return session->stage >= MOR_SESSION_BUILT ? mor_schedule_time(&session->simulation.schedule) : 0.0;
}

double mor_session_end(const mor_session *session)
{
    return session->stage >= MOR_SESSION_LOADED ? session->the_case.end : 0.0;
}

int64_t mor_session_n_steps(const mor_session *session)
{
    return session->stage >= MOR_SESSION_BUILT ? (int64_t)session->simulation.schedule.n_steps : 0;
}

uint64_t mor_session_state_hash(mor_session *session)
{
    return session->stage >= MOR_SESSION_BUILT ? mor_run_state_hash(&session->simulation) : 0;
}
