/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Who may work in a folder, and when that is decided. */
#include "cases/driver/library/session_internal.h"

#include "tests/common/session_case.h"

#include <math.h>
#include <signal.h>
#include <sys/wait.h>

/* What happens in a folder just before it is locked; NULL: nothing. Paths in the scratch folder. */
static run_folder *meddled;
static const char *came_from;
static const char *goes_to;

mor_status __real_mor_run_folder_lock(mor_context *context, const char *folder, FILE **log);
mor_status __wrap_mor_run_folder_lock(mor_context *context, const char *folder, FILE **log);

/* Stands in for mor_run_folder_lock: another session has worked there until now. */
mor_status __wrap_mor_run_folder_lock(mor_context *context, const char *folder, FILE **log)
{
    if (came_from != NULL) {
        char from[MOR_PATH_BYTES];
        char to[MOR_PATH_BYTES];
        assert_int_equal(rename(run_folder_file(meddled, from, came_from), run_folder_file(meddled, to, goes_to)), 0);
        came_from = NULL;
    }
    return __real_mor_run_folder_lock(context, folder, log);
}

static void meddle(run_folder *folder, const char *from, const char *to)
{
    meddled = folder;
    came_from = from;
    goes_to = to;
}

/* Saves a state of a coarser case into the folder `other`. */
static void save_other_case(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_override(session, "spacing=20 mm"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, run_folder_file(folder, path, "case.cfg")), MOR_OK, "");
    session_make_ready(session);
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "other")), MOR_OK, "");
    mor_session_free(&session);
}

static void a_state_that_came_meanwhile_is_not_written_over(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    save_other_case(folder);
    mor_session *session = session_load(folder);
    session_make_ready(session);
    meddle(folder, "other/" MOR_CHECKPOINT_FILE, "state/" MOR_CHECKPOINT_FILE);
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "state")), MOR_ERROR_CONFIG,
                   "spacing");
    assert_null(came_from);
    mor_session_free(&session);
}

static void a_run_that_came_meanwhile_is_not_written_over(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_session *session = session_load(folder);
    run_folder_store(run_folder_file(folder, path, "summary"), "{}", 2);
    meddle(folder, "summary", "run/" MOR_SUMMARY_FILE);
    run_folder_file(folder, path, "run");
    session_expect(session, mor_session_run(session, path, false, 0.01, &outcome), MOR_ERROR_CONFIG,
                   "already holds a run");
    assert_null(came_from);
    /* The lock is free again: what is there, a run or not, decides. */
    session_expect(session, mor_session_run(session, path, false, 0.01, &outcome), MOR_ERROR_CONFIG,
                   "already holds a run");
    assert_int_equal(remove(finished_run_file(folder, path, "run", MOR_SUMMARY_FILE)), 0);
    session_expect(session, mor_session_run(session, run_folder_file(folder, path, "run"), false, 0.01, &outcome),
                   MOR_OK, "");
    mor_session_free(&session);
}

/* As a reader of meshes in another thread does, a child process starts while the folder is locked. */
static void a_child_process_does_not_hold_the_lock(void **state)
{
    run_folder *folder = *state;
    FILE *log = NULL;
    assert_int_equal(mor_run_folder_lock(&folder->context, folder->path, &log), MOR_OK);
    const pid_t child = fork();
    if (child == 0) {
        pause();
        _exit(0);
    }
    assert_true(child > 0);
    fputs("whole\n", log);
    mor_run_folder_unlock(&log);
    const bool is_closed = log == NULL;
    const mor_status again = mor_run_folder_lock(&folder->context, folder->path, &log);
    FILE *third = NULL;
    const mor_status held = mor_run_folder_lock(&folder->context, folder->path, &third);
    mor_run_folder_unlock(&log);
    kill(child, SIGKILL);
    assert_int_equal(waitpid(child, NULL, 0), child);
    assert_true(is_closed);
    assert_int_equal(again, MOR_OK);
    assert_int_equal(held, MOR_ERROR_CONFIG);
    assert_null(third);
    mor_run_folder_unlock(&log);
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(run_folder_file(folder, path, MOR_RUN_LOG_FILE), &n_bytes);
    assert_string_equal(text, "whole\n");
    free(text);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(a_state_that_came_meanwhile_is_not_written_over),
                                       TEST(a_run_that_came_meanwhile_is_not_written_over),
                                       TEST(a_child_process_does_not_hold_the_lock)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
