/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SESSION_CASE_H
#define MOR_TESTS_COMMON_SESSION_CASE_H

#include "cases/moraine.h"
#include "tests/common/finished_run.h"

/** @file
 *  A session with the small case of finished_run.h, and what its functions are expected to return. */

/** What the leak sanitizer is to ignore, as in pile.h: Fontconfig keeps what it knows of fonts until the process ends.
 *  Returns: zero-terminated rules of the sanitizer's run-time library, which asks for them by this name. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

/** A session with the case loaded, to be freed by the caller. */
static inline mor_session *session_load(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    finished_run_store_case(folder, path);
    if (mor_session_load_file(session, path) != MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    return session;
}

/** Fails unless a function returned what was wanted, with a message that holds a part, zero-terminated. */
static inline void session_expect(const mor_session *session, mor_status found, mor_status wanted, const char *part)
{
    if (found != wanted) {
        fail_msg("found status %d, not %d: %s", found, wanted, mor_session_message(session));
    }
    const char *message = mor_session_message(session);
    if (message == NULL || strstr(message, part) == NULL) {
        fail_msg("the message is '%s'; it does not hold '%s'", message != NULL ? message : "", part);
    }
}

/** Builds and settles the case. */
static inline void session_make_ready(mor_session *session)
{
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_settle(session), MOR_OK, "");
}

#endif
