/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Sessions in threads of their own, and stops that come from elsewhere. */
#include "cases/driver/run/stop.h"
#include "tests/common/session_case.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>

enum { SESSIONS = 2, ROUNDS = 3 };

/* What one thread does: everything that goes through a library with a state of its process. A thread cannot fail a
 * test, so it keeps what went wrong. */
typedef struct worker {
    char case_path[MOR_PATH_BYTES];
    char folder[MOR_PATH_BYTES];
    const char *spacing; /* the cases differ, so that nothing of the one may get into the other unseen */
    int n_threads;
    uint64_t hashes[ROUNDS];
    double run_out;
    char message[256]; /* "": nothing went wrong */
} worker;

static mor_status compute(worker *it, mor_session *session, int round)
{
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    const char *unit = NULL;
    mor_status status = mor_session_set_threads(session, it->n_threads);
    status = status == MOR_OK ? mor_session_override(session, it->spacing) : status;
    status = status == MOR_OK ? mor_session_override(session, "output.pictures=true") : status;
    status = status == MOR_OK ? mor_session_override(session, "output.snapshots=1") : status;
    status = status == MOR_OK ? mor_session_load_file(session, it->case_path) : status;
    if (status == MOR_OK && round == ROUNDS - 1) { /* with files and pictures */
        status = mor_session_run(session, it->folder, false, NAN, &outcome);
    } else if (status == MOR_OK) {
        status = mor_session_build(session);
        status = status == MOR_OK ? mor_session_settle(session) : status;
        status = status == MOR_OK ? mor_session_step_to(session, mor_session_end(session)) : status;
        status = status == MOR_OK ? mor_session_save(session, it->folder) : status;
    }
    status = status == MOR_OK ? mor_session_read_probe(session, "run_out", &it->run_out, &unit) : status;
    it->hashes[round] = mor_session_state_hash(session);
    return status;
}

static void *work(void *argument)
{
    worker *it = argument;
    for (int round = 0; round < ROUNDS && it->message[0] == '\0'; ++round) {
        mor_session *session = NULL;
        mor_status status = mor_session_new(&session);
        const size_t length = strlen(it->folder);
        snprintf(it->folder + length, sizeof it->folder - length, "-%d", round);
        status = status == MOR_OK ? compute(it, session, round) : status;
        it->folder[length] = '\0';
        if (status != MOR_OK) {
            snprintf(it->message, sizeof it->message, "round %d: %s", round, mor_session_message(session));
        }
        mor_session_free(&session);
    }
    return NULL;
}

static void prepare(run_folder *folder, worker *workers, const char *name)
{
    static const char *const spacings[SESSIONS] = {"spacing=20 mm", "spacing=24 mm"};
    memset(workers, 0, SESSIONS * sizeof *workers);
    for (int k = 0; k < SESSIONS; ++k) {
        char own_name[32];
        finished_run_store_case(folder, workers[k].case_path);
        snprintf(own_name, sizeof own_name, "%s-%d", name, k);
        run_folder_file(folder, workers[k].folder, own_name);
        workers[k].spacing = spacings[k];
        workers[k].n_threads = 1 + k;
    }
}

static void sessions_in_threads_give_the_bits_of_single_ones(void **state)
{
    worker alone[SESSIONS];
    worker together[SESSIONS];
    pthread_t threads[SESSIONS];
    prepare(*state, alone, "alone");
    prepare(*state, together, "together");
    for (int k = 0; k < SESSIONS; ++k) {
        work(&alone[k]);
    }
    for (int k = 0; k < SESSIONS; ++k) {
        assert_int_equal(pthread_create(&threads[k], NULL, work, &together[k]), 0);
    }
    for (int k = 0; k < SESSIONS; ++k) {
        assert_int_equal(pthread_join(threads[k], NULL), 0);
    }
    for (int k = 0; k < SESSIONS; ++k) {
        assert_string_equal(alone[k].message, "");
        assert_string_equal(together[k].message, "");
        assert_memory_equal(alone[k].hashes, together[k].hashes, sizeof alone[k].hashes);
        assert_memory_equal(&alone[k].run_out, &together[k].run_out, sizeof alone[k].run_out);
    }
    assert_true(alone[0].hashes[0] != alone[1].hashes[0]);
}

/* ---- Stops ------------------------------------------------------------------------------------------------------- */

static void stop_flags_may_be_touched_by_threads_and_signal_handlers(void **state)
{
    (void)state;
    mor_stop stop = {0, 0};
    assert_true(_Generic(&stop.is_requested, atomic_int * : true, default : false));
    assert_true(_Generic(&stop.phase, atomic_int * : true, default : false));
    assert_true(atomic_is_lock_free(&stop.is_requested));
}

/* Asks for a stop once the session steps. */
static void *stop_while_it_steps(void *argument)
{
    mor_session *session = argument;
    while (mor_session_find_phase(session) != MOR_SESSION_STEPPING) {
    }
    mor_session_request_stop(session);
    return NULL;
}

/* A minute would take minutes. */
static void another_thread_stops_a_session(void **state)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(*state);
    pthread_t thread;
    session_expect(session, mor_session_override(session, "end=60 s"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, run_folder_file(*state, path, "case.cfg")), MOR_OK, "");
    session_make_ready(session);
    assert_int_equal(pthread_create(&thread, NULL, stop_while_it_steps, session), 0);
    session_expect(session, mor_session_step_to(session, 60.0), MOR_OK, "");
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_true(mor_session_is_stopping(session));
    assert_true(mor_session_time(session) > 0.0 && mor_session_time(session) < 60.0);
    mor_session_free(&session);
}

static mor_session *volatile handled; /* what the handler knows of */

static void request_stop(int number)
{
    (void)number;
    mor_session_request_stop(handled);
}

/* The handler runs between the instructions of a step. */
static void log_and_raise(void *user, mor_log_level level, const char *text)
{
    (void)user;
    (void)level;
    (void)text;
    assert_int_equal(raise(SIGUSR1), 0);
}

static void a_signal_handler_stops_a_run(void **state)
{
    char path[MOR_PATH_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_session *session = session_load(*state);
    handled = session;
    mor_session_set_log(session, log_and_raise, NULL);
    assert_true(signal(SIGUSR1, request_stop) != SIG_ERR);
    session_expect(session, mor_session_run(session, run_folder_file(*state, path, "run"), false, NAN, &outcome),
                   MOR_OK, "");
    assert_true(signal(SIGUSR1, SIG_DFL) != SIG_ERR);
    assert_int_equal(outcome, MOR_SESSION_INTERRUPTED);
    assert_true(mor_session_is_stopping(session));
    mor_session_free(&session);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(sessions_in_threads_give_the_bits_of_single_ones),
                                       TEST(stop_flags_may_be_touched_by_threads_and_signal_handlers),
                                       TEST(another_thread_stops_a_session), TEST(a_signal_handler_stops_a_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
