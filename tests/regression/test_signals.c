/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/io/checkpoint.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"
#include "tests/common/sanitized.h"

#include <time.h>
#include <unistd.h>

/* Whatever the program is at, a signal is answered, and nothing is lost that was there. */

/* Rocks are drawn, filled, relaxed and packed before the first step, and soil settles around them. */
static const char rocks[] =
    "dimension = 3; spacing = 0.05; end = 0.1; gravity = (0, 0, -10);"
    "domain = { min = (-1, -1, -1); max = (3, 3, 3); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0, 0); max = (0.8, 0.8, 0.6); };"
    "  initial_stress = { type = 'settled'; settle_time = 2; settle_method = 'relaxation'; };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = 5e6; poissons_ratio = 0.3;"
    "               friction_angle = 0.5; cohesion = 5e4; }; } );"
    "rocks = ( { name = 'rock'; region = { type = 'box'; min = (0, 0, 0); max = (0.8, 0.8, 0.6); }; content = 0.2;"
    "  sizes = ( { diameter = 0.33; passing = 0.0; }, { diameter = 0.45; passing = 1.0; } );"
    "  forms = ( { type = 'rock'; elongation = 0.8; angularity = 0.5; } );"
    "  material = { model = 'rigid'; density = 2500; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'box'; min = (-1, -1, -1); max = (3, 3, 0); }; } );"
    "probes = ( { type = 'total_energy'; } );"
    "output = { snapshots = 3; checkpoint_seconds = 0.05; };";

enum { N_SIGNALS = TEST_IS_SANITIZED ? 2 : 5 };

/* Seconds after which a signal counts as not answered. By itself the program answers within one; but neither processor
 * nor disk, on which a checkpoint is synced, is only ours. */
#define ANSWER (TEST_IS_SANITIZED ? 30.0 : 5.0)
#define ANSWER_WITH_CHECKPOINT (TEST_IS_SANITIZED ? 60.0 : 10.0)

static double read_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static bool has_checkpoint(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    return access(finished_run_file(folder, path, run, MOR_CHECKPOINT_FILE), R_OK) == 0;
}

/* How the program answered. */
typedef enum answer { ENDED_BEFORE, NOT_YET_STARTED, STOPPED } answer;

/* Starts the program, sends a signal after some seconds, and checks that it ends in time with the code for it. */
static answer stop_after(run_folder *folder, const char *const *arguments, double seconds, int number, double longest)
{
    const pid_t child = program_start(folder, arguments);
    usleep((useconds_t)(1e6 * seconds));
    const double before = read_clock();
    assert_int_equal(kill(child, number), 0);
    program_outcome outcome = program_finish(folder, child);
    const double duration = read_clock() - before;
    const answer it = outcome.exit_code == 130 ? STOPPED : outcome.signal == number ? NOT_YET_STARTED : ENDED_BEFORE;
    if (it == ENDED_BEFORE && outcome.exit_code != 0) {
        fail_msg("signal %d after %g s: ended with code %d (signal %d): %s", number, seconds, outcome.exit_code,
                 outcome.signal, outcome.errors);
    }
    print_message("signal %d after %.3g s was answered in %.2g s\n", number, seconds, duration);
    if (duration > longest) {
        fail_msg("signal %d after %g s was answered in %g s", number, seconds, duration);
    }
    program_clear(&outcome);
    return it;
}

static void signals_at_random_moments_are_answered_and_nothing_is_lost(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, rocks, case_path);
    const char *const whole[] = {"run", case_path, "-t", "1", "-o", "whole", NULL};
    const char *const stopped[] = {"run", case_path, "-t", "1", "-o", "stopped", "--resume", NULL};
    const double before = read_clock();
    program_outcome outcome = program_run(folder, whole, 0);
    program_clear(&outcome);
    const double duration = read_clock() - before;
    int n_stopped = 0;
    for (int k = 0; k < N_SIGNALS; ++k) {
        const double part = mor_random_uniform(folder->context.seed, (uint64_t)k, 1);
        const double longest = has_checkpoint(folder, "stopped") ? ANSWER_WITH_CHECKPOINT : ANSWER;
        const int number = k % 2 == 0 ? SIGTERM : SIGHUP;
        n_stopped += stop_after(folder, stopped, 0.5 * duration * part, number, longest) == STOPPED;
    }
    assert_true(n_stopped >= N_SIGNALS / 2);
    outcome = program_run(folder, stopped, 0);
    program_clear(&outcome);
    finished_run_compare_bytes(folder, "whole", "stopped", MOR_TABLE_SERIES_FILE);
}

/* Commands that have nothing to keep. */
static void other_commands_stop_at_once(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, rocks, case_path);
    static const char *const commands[] = {"preview", "explain", "check"};
    for (int k = 0; k < 3; ++k) {
        const char *const arguments[] = {commands[k], "case.cfg", "-t", "1", "--set", "spacing=0.02", NULL};
        answer it = NOT_YET_STARTED;
        /* It takes seconds; before main begins, on a busy machine, the system ends it. */
        for (double seconds = 0.3; it == NOT_YET_STARTED && seconds < 20.0; seconds *= 1.5) {
            it = stop_after(folder, arguments, seconds, SIGTERM, ANSWER);
        }
        assert_int_equal(it, STOPPED);
    }
}

/* Under nohup a closing terminal is none of the program's business. */
static void hang_up_stays_ignored_under_nohup(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    const char *const arguments[] = {"run", case_path, "-t", "1", "-o", "run", NULL};
    assert_true(signal(SIGHUP, SIG_IGN) != SIG_ERR);
    const pid_t child = program_start(folder, arguments);
    assert_true(signal(SIGHUP, SIG_DFL) != SIG_ERR);
    usleep(500000);
    assert_int_equal(kill(child, SIGHUP), 0);
    program_outcome outcome = program_finish(folder, child);
    assert_int_equal(outcome.exit_code, 0);
    program_clear(&outcome);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(signals_at_random_moments_are_answered_and_nothing_is_lost),
        TEST(other_commands_stop_at_once),
        TEST(hang_up_stays_ignored_under_nohup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
