/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SESSION_RUN_H
#define MOR_TESTS_COMMON_SESSION_RUN_H

#include "cases/moraine.h"
#include "tests/common/finished_run.h"

#include <math.h>

/** @file
 *  A run of a case through the library. */

/** How a case is to be run. Strings are zero-terminated. */
typedef struct session_run {
    const char *case_path;
    const char *name;            /* of the folder of results in the scratch folder */
    const char *const *settings; /* shape [n_settings] of "key=value" */
    int n_settings;
    double stop_at; /* s; NaN: at the end */
    bool is_resume;
    int n_threads;
    FILE *output; /* NULL: nothing is printed */
} session_run;

/** Runs it and fails, saying which, unless that succeeds; returns how it went. */
static inline mor_session_outcome session_run_do(run_folder *folder, const session_run *it, const char *which)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    mor_status status = mor_session_new(&session);
    assert_int_equal(status, MOR_OK);
    mor_session_set_output(session, it->output);
    assert_int_equal(mor_session_set_threads(session, it->n_threads), MOR_OK);
    for (int k = 0; k < it->n_settings; ++k) {
        assert_int_equal(mor_session_override(session, it->settings[k]), MOR_OK);
    }
    status = mor_session_load_file(session, it->case_path);
    if (status == MOR_OK) {
        status =
            mor_session_run(session, run_folder_file(folder, path, it->name), it->is_resume, it->stop_at, &outcome);
    }
    if (status != MOR_OK) {
        fail_msg("'%s': %s", which, mor_session_message(session));
    }
    mor_session_free(&session);
    return outcome;
}

/** Runs a case given as text to its end, in a folder of that name. */
static inline void session_run_text(run_folder *folder, const char *text, const char *name)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run it = {.case_path = path, .name = name, .stop_at = NAN, .n_threads = 2};
    assert_int_equal(session_run_do(folder, &it, name), MOR_SESSION_FINISHED);
}

/** Checks that a run which is stopped, and resumed with another number of threads, gives the bits and the bytes of its
 *  table that one gives which goes through. Returns the last entry of the last row of the table, for the caller to see
 *  that something has happened. */
static inline double session_run_expect_resumable(run_folder *folder, const char *text, double stop_at)
{
    char path[MOR_PATH_BYTES];
    char hashes[2][32];
    finished_run_store_text(folder, text, path);
    const session_run whole = {.case_path = path, .name = "whole", .stop_at = NAN, .n_threads = 1};
    const session_run part = {.case_path = path, .name = "part", .stop_at = stop_at, .n_threads = 2};
    const session_run rest = {.case_path = path, .name = "part", .stop_at = NAN, .is_resume = true, .n_threads = 3};
    session_run_do(folder, &whole, "whole");
    assert_int_equal(session_run_do(folder, &part, "part"), MOR_SESSION_STOPPED);
    session_run_do(folder, &rest, "rest");
    finished_run_read_hash(folder, "whole", hashes[0]);
    finished_run_read_hash(folder, "part", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    finished_run_compare_bytes(folder, "whole", "part", MOR_TABLE_SERIES_FILE);
    mor_table_data rows;
    assert_int_equal(
        mor_table_data_read(&folder->context, &rows, finished_run_file(folder, path, "whole", MOR_TABLE_SERIES_FILE)),
        MOR_OK);
    const double last = rows.values[rows.n_rows * rows.n_columns - 1];
    mor_table_data_clear(&folder->context, &rows);
    return last;
}

#endif
