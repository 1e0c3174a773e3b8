/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A program may have any locale: what the library reads and writes has a decimal point, and its locale stays. */
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <locale.h>
#include <math.h>

static const char square[] = "0 0\n0.505 0\n0.505 0.505\n0 0.505\n";

static bool has_comma(void)
{
    char text[8];
    snprintf(text, sizeof text, "%.1f", 0.5);
    return strcmp(text, "0,5") == 0;
}

/* Gives the whole process a locale of decimal commas, installed or made in the scratch folder; false when neither can
 * be had. */
static bool set_comma(run_folder *folder)
{
    static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        if (setlocale(LC_ALL, names[k]) != NULL && has_comma()) {
            return true;
        }
    }
    char command[2 * MOR_PATH_BYTES];
    snprintf(command, sizeof command, "localedef -c -i de_DE -f UTF-8 '%s/de_DE.UTF-8' >'%s/localedef.txt' 2>&1",
             folder->path, folder->path);
    const int ending = system(command);
    assert_int_equal(setenv("LOCPATH", folder->path, 1), 0);
    const bool is_set = ending == 0 && setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
    assert_int_equal(unsetenv("LOCPATH"), 0);
    if (!is_set) {
        print_message("no locale of decimal commas is installed, and localedef makes none\n");
    }
    return is_set && has_comma();
}

static int reset_locale(void **state)
{
    assert_non_null(setlocale(LC_ALL, "C"));
    return run_folder_teardown(state);
}

/* What a program does with the library: a run in two parts, another one step by step, particles for a shape. */
static void use_library(run_folder *folder, const char *name, double *values)
{
    char path[MOR_PATH_BYTES];
    char particles[MOR_PATH_BYTES];
    char shape[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_run run = {
        .case_path = run_folder_file(folder, path, "case.cfg"), .name = name, .stop_at = 0.03, .n_threads = 2};
    assert_int_equal(session_run_do(folder, &run, name), MOR_SESSION_STOPPED);
    run.stop_at = NAN;
    run.is_resume = true;
    assert_int_equal(session_run_do(folder, &run, name), MOR_SESSION_FINISHED);
    session_expect(session, mor_session_set_threads(session, 2), MOR_OK, "");
    session_expect(session, mor_session_override(session, "numerics.courant=0.25"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.0125), MOR_OK, "");
    for (int k = 0; k < mor_session_n_probes(session); ++k) {
        const char *probe = mor_session_probe_name(session, k);
        session_expect(session, mor_session_read_probe(session, probe, &values[k], NULL), MOR_OK, "");
    }
    session_expect(session, mor_session_step_to(session, 0.5), MOR_ERROR_ARGUMENT, "found t = 0.5 s");
    snprintf(particles, sizeof particles, "%s/%s-relaxed", folder->path, name);
    run_folder_store(run_folder_file(folder, shape, "square.txt"), square, sizeof square - 1);
    session_expect(session, mor_session_relax(session, shape, 0.0505, MOR_SESSION_SIZE_OF_FILE, 0.0, particles), MOR_OK,
                   "");
    mor_session_free(&session);
}

static void a_decimal_comma_of_the_program_changes_no_result(void **state)
{
    enum { PROBES = 32 };
    run_folder *folder = *state;
    double with_point[PROBES] = {0.0};
    double with_comma[PROBES] = {0.0};
    use_library(folder, "point", with_point);
    if (!set_comma(folder)) {
        skip();
    }
    use_library(folder, "comma", with_comma);
    assert_true(has_comma());
    assert_ptr_equal(uselocale((locale_t)0), LC_GLOBAL_LOCALE);
    assert_memory_equal(with_point, with_comma, sizeof with_point);
    finished_run_compare(folder, "point", "comma");
    finished_run_compare_bytes(folder, "point", "comma", "case.resolved.cfg");
    finished_run_compare_bytes(folder, "point", "comma", MOR_SNAPSHOT_XDMF_FILE);
    finished_run_compare_bytes(folder, "point-relaxed", "comma-relaxed", "particles.csv");
}

/* After a success and after a refusal, early or late, a thread has the locale that it had. */
static void a_thread_keeps_its_locale(void **state)
{
    mor_session *session = session_load(*state);
    locale_t own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    assert_true(own != (locale_t)0);
    const locale_t previous = uselocale(own);
    const mor_status statuses[] = {mor_session_set_threads(session, 0), mor_session_set_threads(session, -1),
                                   mor_session_step(session),           mor_session_build(session),
                                   mor_session_settle(session),         mor_session_render(session, "/nowhere")};
    const locale_t after = uselocale(previous);
    freelocale(own);
    assert_ptr_equal(after, own);
    static const mor_status wanted[] = {MOR_OK, MOR_ERROR_ARGUMENT, MOR_ERROR_ARGUMENT, MOR_OK,
                                        MOR_OK, MOR_ERROR_CONFIG};
    assert_memory_equal(statuses, wanted, sizeof wanted);
    mor_session_free(&session);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, reset_locale)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(a_decimal_comma_of_the_program_changes_no_result),
                                       TEST(a_thread_keeps_its_locale)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
