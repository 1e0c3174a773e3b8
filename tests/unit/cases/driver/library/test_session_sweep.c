/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Sweeps through the library. */
#include "materials/builtin.h"
#include "tests/common/session_case.h"

#include <math.h>
#include <sys/stat.h>

#define TWO                                                                                                            \
    "case = \"case.cfg\"; set = ( \"spacing=20 mm\", \"end=40 ms\" ); results = ( { probe = \"run_out\"; } );"         \
    "vary = ( { key = \"soil[0].material.cohesion\"; values = (100, 200); } );"

static void store_sweep(run_folder *folder, const char *text, char *path)
{
    run_folder_store(run_folder_file(folder, path, "sweep.cfg"), text, strlen(text));
}

/* The case of the session that runs the sweep is none of the sweep's business. */
static void sweep_leaves_the_case_of_its_session(void **state)
{
    run_folder *folder = *state;
    mor_session *session = session_load(folder);
    mor_session_sweep_counts counts;
    char path[MOR_PATH_BYTES];
    char into[MOR_PATH_BYTES];
    double value = NAN;
    store_sweep(folder, TWO, path);
    session_make_ready(session);
    session_expect(session, mor_session_step(session), MOR_OK, "");
    const uint64_t hash = mor_session_state_hash(session);
    session_expect(session, mor_session_sweep(session, path, run_folder_file(folder, into, "out"), false, &counts),
                   MOR_OK, "");
    assert_true(counts.is_ended && counts.n_members == 2 && counts.n_used == 2 && counts.n_failed == 0);
    assert_true(mor_session_state_hash(session) == hash);
    session_expect(session, mor_session_read_probe(session, "run_out", &value, NULL), MOR_OK, "");
    session_expect(session, mor_session_step(session), MOR_OK, "");
    mor_session_free(&session);
}

/* A law that the program added is known to all members. */
static void members_know_the_laws_of_the_session(void **state)
{
    run_folder *folder = *state;
    mor_session *session = NULL;
    mor_session_sweep_counts counts;
    char path[MOR_PATH_BYTES];
    char into[MOR_PATH_BYTES];
    const mor_plugin_list *laws = mor_materials_builtin(NULL);
    int k = 0;
    while (strcmp(laws->materials[k]->name, "drucker_prager") != 0) {
        ++k;
    }
    mor_material mine = *laws->materials[k];
    mine.name = "law_of_mine";
    assert_int_equal(mor_session_new(&session), MOR_OK);
    finished_run_store_case(folder, path);
    store_sweep(folder, TWO, path);
    session_expect(session, mor_session_override(session, "soil[0].material.model=law_of_mine"), MOR_OK, "");
    session_expect(session, mor_session_sweep(session, path, run_folder_file(folder, into, "none"), false, &counts),
                   MOR_ERROR_CONFIG, "the cases of 2 of 2 members are refused");
    session_expect(session, mor_session_add_material(session, &mine), MOR_OK, "");
    session_expect(session, mor_session_sweep(session, path, run_folder_file(folder, into, "out"), false, &counts),
                   MOR_OK, "");
    assert_int_equal(counts.n_used, 2);
    mor_session_free(&session);
}

/* A stop that was requested before keeps members from starting; without it the sweep goes on. */
static void stopped_sweep_goes_on_once_the_stop_is_taken_back(void **state)
{
    run_folder *folder = *state;
    mor_session *session = NULL;
    mor_session_sweep_counts counts;
    char path[MOR_PATH_BYTES];
    char into[MOR_PATH_BYTES];
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, 2), MOR_OK);
    finished_run_store_case(folder, path);
    store_sweep(folder, TWO, path);
    run_folder_file(folder, into, "out");
    mor_session_request_stop(session);
    session_expect(session, mor_session_sweep(session, path, into, false, &counts), MOR_OK, "");
    assert_true(!counts.is_ended && counts.n_members == 2 && counts.n_used == 0 && counts.n_failed == 0);
    assert_int_equal(mor_session_find_phase(session), MOR_SESSION_IDLE);
    mor_session_clear_stop(session);
    session_expect(session, mor_session_sweep(session, path, into, false, &counts), MOR_ERROR_CONFIG,
                   "already holds a sweep");
    session_expect(session, mor_session_sweep(session, path, into, true, &counts), MOR_OK, "");
    assert_true(counts.is_ended && counts.n_used == 2);
    mor_session_free(&session);
}

/* Folders that hold something else, and files that are none. */
static void wrong_files_and_folders_are_refused(void **state)
{
    run_folder *folder = *state;
    mor_session *session = NULL;
    mor_session_sweep_counts counts;
    char path[MOR_PATH_BYTES];
    char into[MOR_PATH_BYTES];
    assert_int_equal(mor_session_new(&session), MOR_OK);
    session_expect(session, mor_session_sweep(session, run_folder_file(folder, path, "no.cfg"), NULL, false, &counts),
                   MOR_ERROR_CONFIG, "found no file that can be opened");
    finished_run_store_case(folder, path);
    store_sweep(folder, TWO, path);
    session_expect(session, mor_session_sweep(session, path, NULL, false, &counts), MOR_OK, "");
    assert_true(counts.n_members == 2 && counts.n_used == 0 && !counts.is_ended);
    assert_int_equal(mkdir(run_folder_file(folder, into, "run"), 0700), 0);
    run_folder_store(run_folder_file(folder, into, "run/" MOR_SUMMARY_FILE), "{}", 2);
    session_expect(session, mor_session_sweep(session, path, run_folder_file(folder, into, "run"), true, &counts),
                   MOR_ERROR_CONFIG, "already holds a run; choose another folder for the sweep");
    run_folder_store(run_folder_file(folder, into, "file"), "x", 1);
    session_expect(session, mor_session_sweep(session, path, into, false, &counts), MOR_ERROR_CONFIG,
                   "choose another folder");
    mor_session_free(&session);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(sweep_leaves_the_case_of_its_session),
        WITH_FOLDER(members_know_the_laws_of_the_session),
        WITH_FOLDER(stopped_sweep_goes_on_once_the_stop_is_taken_back),
        WITH_FOLDER(wrong_files_and_folders_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
