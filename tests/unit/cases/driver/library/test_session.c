/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/probe/probe_track.h"
#include "core/base/hash.h"
#include "tests/common/laws.h"
#include "tests/common/program.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

/* The library: what goes wrong is a value with a message, what is right has the bits of a run, nothing is printed. */

enum { N_VALUES = 100000 };

/* ---- Errors ------------------------------------------------------------------------------------------------------ */

static void a_bad_file_is_told_by_name(void **state)
{
    mor_session *session = session_load(*state);
    session_expect(session, mor_session_load_file(session, "/nowhere/case.cfg"), MOR_ERROR_CONFIG, "/nowhere/case.cfg");
    session_expect(session, mor_session_build(session), MOR_ERROR_ARGUMENT, "no case is loaded");
    session_expect(session, mor_session_load_text(session, "mine.cfg", "title = ;"), MOR_ERROR_CONFIG, "mine.cfg:1");
    session_expect(session, mor_session_add_plugin(session, "/nowhere/law.so"), MOR_ERROR_IO, "/nowhere/law.so");
    mor_session_free(&session);
    assert_null(session);
    mor_session_free(&session);
}

static void a_bad_override_is_found_by_loading(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_override(session, "numerics.corant=0.2"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, run_folder_file(folder, path, "case.cfg")), MOR_ERROR_CONFIG,
                   "did you mean 'courant'");
    mor_session_free(&session);
}

static void what_comes_too_early_or_too_late_is_refused(void **state)
{
    mor_session *session = session_load(*state);
    double value = 0.0;
    session_expect(session, mor_session_step(session), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_build(session), MOR_ERROR_ARGUMENT, "built already");
    session_expect(session, mor_session_step(session), MOR_ERROR_ARGUMENT, "call mor_session_settle");
    session_expect(session, mor_session_read_probe(session, "height", &value, NULL), MOR_ERROR_ARGUMENT,
                   "mor_session_settle");
    session_expect(session, mor_session_settle(session), MOR_OK, "");
    session_expect(session, mor_session_settle(session), MOR_ERROR_ARGUMENT, "under way");
    session_expect(session, mor_session_set_threads(session, -1), MOR_ERROR_ARGUMENT, "found -1 threads");
    mor_session_free(&session);
}

static void an_unknown_name_is_told_with_those_there_are(void **state)
{
    mor_session *session = session_load(*state);
    double values[3];
    const char *text = NULL;
    int n = 0;
    session_make_ready(session);
    session_expect(session, mor_session_read_probe(session, "hight", values, NULL), MOR_ERROR_ARGUMENT, "'height'");
    session_expect(session, mor_session_read_field(session, "sand", "velocity", values, 3), MOR_ERROR_ARGUMENT,
                   "it has 'soil'");
    session_expect(session, mor_session_read_field(session, "soil", "speed", values, 3), MOR_ERROR_ARGUMENT,
                   "'velocity'");
    session_expect(session, mor_session_describe_field(session, "soil", 99, &text, &n, &text), MOR_ERROR_ARGUMENT,
                   "allowed: 0");
    session_expect(session, mor_session_print_list(session, "ghosts"), MOR_ERROR_ARGUMENT, "materials");
    assert_int_equal(mor_session_n_particles(session, "sand"), -1);
    assert_int_equal(mor_session_n_fields(session, "sand"), -1);
    assert_null(mor_session_probe_name(session, 99));
    assert_null(mor_session_name_of_set(session, -1));
    mor_session_free(&session);
}

static void an_array_too_small_is_left_alone(void **state)
{
    mor_session *session = session_load(*state);
    double values[3] = {1.0, 2.0, 3.0};
    int64_t number = 7;
    session_make_ready(session);
    session_expect(session, mor_session_read_field(session, "soil", "velocity", values, 3), MOR_ERROR_ARGUMENT,
                   "found room for 3 numbers");
    session_expect(session, mor_session_read_numbers(session, "soil", &number, 1), MOR_ERROR_ARGUMENT, "are needed");
    assert_true(values[0] == 1.0 && values[2] == 3.0 && number == 7);
    mor_session_free(&session);
}

static void no_step_goes_past_the_end(void **state)
{
    mor_session *session = session_load(*state);
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.061), MOR_ERROR_ARGUMENT, "the end of the case at 0.06 s");
    session_expect(session, mor_session_step_to(session, NAN), MOR_ERROR_ARGUMENT, "found t = ");
    session_expect(session, mor_session_step_to(session, mor_session_end(session)), MOR_OK, "");
    assert_true(mor_session_time(session) == 0.06); /* exact: the end is a whole number of ticks */
    session_expect(session, mor_session_step(session), MOR_ERROR_ARGUMENT, "t = 0.06 s, is reached");
    session_expect(session, mor_session_step_to(session, 0.01), MOR_ERROR_ARGUMENT, "from the present 0.06 s");
    mor_session_free(&session);
}

/* ---- Results ----------------------------------------------------------------------------------------------------- */

/* Fails unless a field has the bits of the last snapshot of a run, in which particles stand in any order. */
static void compare_field(run_folder *folder, mor_session *session, const mor_snapshot *snapshot, const char *name)
{
    static double values[N_VALUES];
    static double saved[N_VALUES];
    static int64_t ids[N_VALUES];
    const mor_snapshot_set *set = &snapshot->sets[0];
    const mor_snapshot_field *field = mor_snapshot_find_field(set, name);
    assert_non_null(field);
    const int n = field->n_components;
    assert_int_equal(mor_session_n_particles(session, "soil"), set->n_particles);
    session_expect(session, mor_session_read_field(session, "soil", name, values, N_VALUES), MOR_OK, "");
    assert_int_equal(mor_snapshot_read_field(&folder->context, snapshot, set, field, saved), MOR_OK);
    assert_int_equal(mor_snapshot_read_ids(&folder->context, snapshot, set, ids), MOR_OK);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        assert_memory_equal(saved + n * i, values + n * ids[i], (size_t)n * sizeof(double));
    }
}

static void stepping_gives_the_bits_of_a_run(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char hash[32];
    char own_hash[MOR_HASH_TEXT_BYTES];
    mor_snapshot_list list;
    mor_snapshot last;
    double value = 0.0;
    const char *unit = NULL;
    mor_session *session = session_load(folder);
    const session_run run = {
        .case_path = run_folder_file(folder, path, "case.cfg"), .name = "run", .stop_at = NAN, .n_threads = 2};
    assert_int_equal(session_run_do(folder, &run, "whole"), MOR_SESSION_FINISHED);
    session_make_ready(session);
    while (mor_session_time(session) < mor_session_end(session)) {
        session_expect(session, mor_session_step(session), MOR_OK, "");
    }
    finished_run_read_hash(folder, "run", hash);
    mor_hash_format(mor_session_state_hash(session), own_hash);
    assert_string_equal(own_hash, hash);
    run_folder_file(folder, path, "run");
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, path), MOR_OK);
    assert_int_equal(mor_session_n_steps(session), list.items[list.n - 1].step);
    assert_int_equal(mor_snapshot_open(&folder->context, &last, path, list.items[list.n - 1].step), MOR_OK);
    compare_field(folder, session, &last, "velocity");
    compare_field(folder, session, &last, "stress");
    compare_field(folder, session, &last, "plastic_strain");
    mor_snapshot_close(&folder->context, &last);
    mor_snapshot_list_clear(&folder->context, &list);
    for (int k = 0; k < mor_session_n_probes(session); ++k) {
        mor_table_data rows;
        const char *name = mor_session_probe_name(session, k);
        session_expect(session, mor_session_read_probe(session, name, &value, &unit), MOR_OK, "");
        assert_int_equal(
            mor_table_data_read(&folder->context, &rows, finished_run_file(folder, path, "run", MOR_TABLE_SERIES_FILE)),
            MOR_OK);
        assert_memory_equal(&value, &rows.values[rows.n_rows * rows.n_columns - mor_session_n_probes(session) + k],
                            sizeof value);
        assert_true(strlen(unit) > 0);
        mor_table_data_clear(&folder->context, &rows);
    }
    mor_session_free(&session);
}

static void fields_are_described_and_particles_numbered(void **state)
{
    mor_session *session = session_load(*state);
    static int64_t numbers[N_VALUES];
    const char *name = NULL;
    const char *unit = NULL;
    int n = 0;
    int n_found = 0;
    session_make_ready(session);
    assert_int_equal(mor_session_n_sets(session), 1);
    assert_string_equal(mor_session_name_of_set(session, 0), "soil");
    assert_int_equal(mor_session_n_particles(session, NULL), mor_session_n_particles(session, "soil"));
    for (int k = 0; k < mor_session_n_fields(session, "soil"); ++k) {
        session_expect(session, mor_session_describe_field(session, "soil", k, &name, &n, &unit), MOR_OK, "");
        n_found += strcmp(name, "stress") == 0 && n == 6 && strcmp(unit, "Pa") == 0;
        assert_string_not_equal(name, "acceleration"); /* scratch means nothing between steps */
    }
    assert_int_equal(n_found, 1);
    session_expect(session, mor_session_read_numbers(session, "soil", numbers, N_VALUES), MOR_OK, "");
    for (int64_t i = 0; i < mor_session_n_particles(session, "soil"); ++i) {
        assert_int_equal(numbers[i], i);
    }
    mor_session_free(&session);
}

static void a_saved_state_goes_on_as_if_never_saved(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *first = session_load(folder);
    mor_session *second = session_load(folder);
    session_make_ready(first);
    session_expect(first, mor_session_step_to(first, 0.03), MOR_OK, "");
    run_folder_file(folder, path, "kept/state");
    session_expect(first, mor_session_save(first, path), MOR_OK, "");
    session_expect(first, mor_session_save(first, path), MOR_OK, "");
    const double saved = mor_session_time(first);
    session_expect(first, mor_session_step_to(first, 0.06), MOR_OK, "");
    session_expect(second, mor_session_build(second), MOR_OK, "");
    session_expect(second, mor_session_resume(second, "/nowhere"), MOR_ERROR_IO, "no checkpoint in '/nowhere'");
    session_expect(second, mor_session_resume(second, path), MOR_OK, "");
    assert_true(mor_session_time(second) == saved); /* exact: restored */
    session_expect(second, mor_session_step_to(second, 0.06), MOR_OK, "");
    assert_true(mor_session_state_hash(first) == mor_session_state_hash(second));
    session_expect(second, mor_session_override(second, "spacing=20 mm"), MOR_OK, "");
    char case_path[MOR_PATH_BYTES];
    session_expect(second, mor_session_load_file(second, run_folder_file(folder, case_path, "case.cfg")), MOR_OK, "");
    session_expect(second, mor_session_build(second), MOR_OK, "");
    session_expect(second, mor_session_resume(second, path), MOR_ERROR_CONFIG, "spacing");
    mor_session_free(&first);
    mor_session_free(&second);
}

static void a_state_is_saved_into_no_run_and_over_no_other_case(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char case_path[MOR_PATH_BYTES];
    unsigned char *before = NULL;
    unsigned char *after = NULL;
    size_t n_bytes[2];
    mor_session *first = session_load(folder);
    mor_session *second = NULL;
    const session_run run = {
        .case_path = run_folder_file(folder, case_path, "case.cfg"), .name = "run", .stop_at = 0.01, .n_threads = 1};
    assert_int_equal(session_run_do(folder, &run, "part"), MOR_SESSION_STOPPED);
    session_make_ready(first);
    before = run_folder_load(finished_run_file(folder, path, "run", MOR_CHECKPOINT_FILE), &n_bytes[0]);
    session_expect(first, mor_session_save(first, run_folder_file(folder, path, "run")), MOR_ERROR_CONFIG,
                   "holds a run");
    after = run_folder_load(finished_run_file(folder, path, "run", MOR_CHECKPOINT_FILE), &n_bytes[1]);
    assert_int_equal(n_bytes[0], n_bytes[1]);
    assert_memory_equal(before, after, n_bytes[0]);
    free(before);
    free(after);
    session_expect(first, mor_session_save(first, run_folder_file(folder, path, "state")), MOR_OK, "");
    assert_int_equal(mor_session_new(&second), MOR_OK);
    session_expect(second, mor_session_override(second, "spacing=20 mm"), MOR_OK, "");
    session_expect(second, mor_session_load_file(second, case_path), MOR_OK, "");
    session_make_ready(second);
    session_expect(second, mor_session_save(second, path), MOR_ERROR_CONFIG, "spacing");
    mor_session_free(&first);
    mor_session_free(&second);
}

static void a_folder_at_work_is_left_alone(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char case_path[MOR_PATH_BYTES];
    FILE *log = NULL;
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_session *session = session_load(folder);
    session_make_ready(session);
    run_folder_file(folder, path, "state");
    run_folder_file(folder, case_path, "case.cfg");
    assert_int_equal(mor_run_folder_make(&folder->context, path), MOR_OK);
    assert_int_equal(mor_run_folder_lock(&folder->context, path, &log), MOR_OK);
    session_expect(session, mor_session_save(session, path), MOR_ERROR_CONFIG, "another run is at work");
    session_expect(session, mor_session_load_file(session, case_path), MOR_OK, "");
    session_expect(session, mor_session_run(session, path, false, 0.01, &outcome), MOR_ERROR_CONFIG,
                   "another run is at work");
    mor_run_folder_unlock(&log);
    session_expect(session, mor_session_load_file(session, case_path), MOR_OK, "");
    session_expect(session, mor_session_run(session, path, false, 0.01, &outcome), MOR_OK, "");
    mor_session_free(&session);
}

/* The extreme over an interval is of the steps that are due, however often it was looked at between. */
static void reading_a_probe_changes_nothing(void **state)
{
    mor_session *watched = session_load(*state);
    mor_session *alone = session_load(*state);
    session_make_ready(watched);
    session_make_ready(alone);
    while (mor_session_time(watched) < 0.02) {
        session_expect(watched, mor_session_step(watched), MOR_OK, "");
        session_expect(alone, mor_session_step(alone), MOR_OK, "");
        for (int k = 0; k < mor_session_n_probes(watched); ++k) {
            double value = 0.0;
            const mor_probe_track *track = watched->simulation.probes;
            const int64_t measured_at = track->measured_at[k];
            session_expect(watched, mor_session_read_probe(watched, mor_session_probe_name(watched, k), &value, NULL),
                           MOR_OK, "");
            assert_int_equal(track->measured_at[k], measured_at);
            assert_memory_equal(&track->values[k], &alone->simulation.probes->values[k], sizeof value);
        }
    }
    mor_session_free(&watched);
    mor_session_free(&alone);
}

static void an_end_while_settling_leaves_no_results(void **state)
{
    char path[MOR_PATH_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_session *session = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    session_expect(session, mor_session_override(session, "spacing=40 mm"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, MOR_SOURCE_DIR "/cases/column-at-rest/case.cfg"), MOR_OK,
                   "");
    mor_session_request_stop(session);
    session_expect(session, mor_session_run(session, run_folder_file(*state, path, "run"), false, NAN, &outcome),
                   MOR_OK, "");
    assert_int_equal(outcome, MOR_SESSION_INTERRUPTED);
    assert_int_equal(mor_session_n_sets(session), 0);
    session_expect(session, mor_session_save(session, path), MOR_ERROR_ARGUMENT, "the case is loaded, but not built");
    mor_session_free(&session);
}

static void two_sessions_do_not_know_of_each_other(void **state)
{
    run_folder *folder = *state;
    mor_session *alone = session_load(folder);
    mor_session *first = session_load(folder);
    mor_session *second = session_load(folder);
    session_make_ready(alone);
    session_make_ready(first);
    session_make_ready(second);
    session_expect(alone, mor_session_step_to(alone, 0.02), MOR_OK, "");
    session_expect(second, mor_session_set_threads(second, 2), MOR_OK, "");
    for (int k = 1; k <= 6; ++k) { /* in turn, by the steps that snapshots cut */
        session_expect(first, mor_session_step_to(first, 0.01 * (k < 2 ? k : 2)), MOR_OK, "");
        session_expect(second, mor_session_step_to(second, 0.01 * k), MOR_OK, "");
    }
    assert_true(mor_session_state_hash(first) == mor_session_state_hash(alone));
    assert_true(mor_session_time(second) == 0.06);
    session_expect(second, mor_session_step(second), MOR_ERROR_ARGUMENT, "is reached");
    assert_string_equal(mor_session_message(first), "");
    mor_session_free(&alone);
    mor_session_free(&first);
    mor_session_free(&second);
}

static void a_case_in_memory_is_as_good_as_a_file(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    mor_session *first = session_load(folder);
    mor_session *second = NULL;
    char *text = (char *)run_folder_load(run_folder_file(folder, path, "case.cfg"), &n_bytes);
    assert_int_equal(mor_session_new(&second), MOR_OK);
    session_expect(second, mor_session_load_text(second, "heap", text), MOR_OK, "");
    free(text);
    session_make_ready(first);
    session_make_ready(second);
    session_expect(first, mor_session_step(first), MOR_OK, "");
    session_expect(second, mor_session_step(second), MOR_OK, "");
    assert_true(mor_session_state_hash(first) == mor_session_state_hash(second));
    mor_session_free(&first);
    mor_session_free(&second);
}

/* ---- Laws, stopping, streams ------------------------------------------------------------------------------------- */

static void a_law_of_ones_own_gives_the_bits_of_the_built_in_one(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_material law = *law_named("drucker_prager");
    mor_session *first = session_load(folder);
    mor_session *second = session_load(folder);
    law.name = "my_law";
    session_expect(second, mor_session_override(second, "soil[0].material.model=my_law"), MOR_OK, "");
    run_folder_file(folder, path, "case.cfg");
    session_expect(second, mor_session_load_file(second, path), MOR_ERROR_CONFIG, "my_law");
    session_expect(second, mor_session_add_material(second, &law), MOR_OK, "");
    session_expect(second, mor_session_load_file(second, path), MOR_OK, "");
    session_make_ready(first);
    session_make_ready(second);
    session_expect(first, mor_session_step_to(first, 0.005), MOR_OK, "");
    session_expect(second, mor_session_step_to(second, 0.005), MOR_OK, "");
    assert_true(mor_session_state_hash(first) == mor_session_state_hash(second));
    mor_session_free(&first);
    mor_session_free(&second);
}

static void a_requested_stop_ends_stepping_early(void **state)
{
    mor_session *session = session_load(*state);
    session_make_ready(session);
    mor_session_request_stop(session);
    assert_true(mor_session_is_stopping(session));
    session_expect(session, mor_session_step_to(session, 0.06), MOR_OK, "");
    assert_true(mor_session_time(session) == 0.0);
    mor_session_clear_stop(session);
    session_expect(session, mor_session_step_to(session, 0.001), MOR_OK, "");
    assert_true(mor_session_n_steps(session) > 0);
    assert_int_equal(mor_session_find_phase(session), MOR_SESSION_IDLE);
    mor_session_free(&session);
}

static void count_line(void *user, mor_log_level level, const char *text)
{
    int *n = user;
    *n += level >= MOR_LOG_INFO && text[0] != '\0';
}

/* Standard output and error go into files while all that prints is called. */
static void nothing_is_printed(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes[2];
    const int kept[2] = {dup(STDOUT_FILENO), dup(STDERR_FILENO)};
    int n_logged = 0;
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_session *session = session_load(folder);
    fflush(stdout);
    program_redirect(run_folder_file(folder, path, "out.txt"), STDOUT_FILENO);
    program_redirect(run_folder_file(folder, path, "err.txt"), STDERR_FILENO);
    mor_session_set_log(session, count_line, &n_logged);
    mor_status worst = mor_session_run(session, run_folder_file(folder, path, "run"), false, 0.01, &outcome);
    for (int k = 0; mor_list_name(k) != NULL && worst == MOR_OK; ++k) {
        worst = mor_session_print_list(session, mor_list_name(k));
    }
    const mor_status refused = mor_session_load_file(session, "/nowhere");
    fflush(stdout);
    dup2(kept[0], STDOUT_FILENO);
    dup2(kept[1], STDERR_FILENO);
    assert_int_equal(worst, MOR_OK);
    assert_int_equal(outcome, MOR_SESSION_STOPPED);
    assert_int_equal(refused, MOR_ERROR_CONFIG);
    free(run_folder_load(run_folder_file(folder, path, "out.txt"), &n_bytes[0]));
    free(run_folder_load(run_folder_file(folder, path, "err.txt"), &n_bytes[1]));
    assert_int_equal(n_bytes[0] + n_bytes[1], 0);
    assert_true(n_logged > 0);
    mor_session_free(&session);
    close(kept[0]);
    close(kept[1]);
}

static void nothing_is_left_in_memory(void **state)
{
    mor_session *session = session_load(*state);
    mor_session_clear_case(session);
    const size_t n_bytes = session->context.memory_bytes;
    char path[MOR_PATH_BYTES];
    session_expect(session, mor_session_load_file(session, run_folder_file(*state, path, "case.cfg")), MOR_OK, "");
    session_make_ready(session);
    session_expect(session, mor_session_step(session), MOR_OK, "");
    session_expect(session, mor_session_save(session, run_folder_file(*state, path, "kept")), MOR_OK, "");
    mor_session_clear_case(session);
    assert_int_equal(session->context.memory_bytes, n_bytes);
    mor_session_free(&session);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(a_bad_file_is_told_by_name),
                                       TEST(a_bad_override_is_found_by_loading),
                                       TEST(what_comes_too_early_or_too_late_is_refused),
                                       TEST(an_unknown_name_is_told_with_those_there_are),
                                       TEST(an_array_too_small_is_left_alone),
                                       TEST(no_step_goes_past_the_end),
                                       TEST(stepping_gives_the_bits_of_a_run),
                                       TEST(fields_are_described_and_particles_numbered),
                                       TEST(a_saved_state_goes_on_as_if_never_saved),
                                       TEST(a_state_is_saved_into_no_run_and_over_no_other_case),
                                       TEST(a_folder_at_work_is_left_alone),
                                       TEST(reading_a_probe_changes_nothing),
                                       TEST(an_end_while_settling_leaves_no_results),
                                       TEST(two_sessions_do_not_know_of_each_other),
                                       TEST(a_case_in_memory_is_as_good_as_a_file),
                                       TEST(a_law_of_ones_own_gives_the_bits_of_the_built_in_one),
                                       TEST(a_requested_stop_ends_stepping_early),
                                       TEST(nothing_is_printed),
                                       TEST(nothing_is_left_in_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
