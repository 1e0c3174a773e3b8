/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/finished_run.h"
#include "tests/common/full_disk.h"
#include "tests/common/program.h"

#include <math.h>

/* What `moraine run` says when a run cannot go on as the user thought. */

/* The speed in the summary of a run. */
static double read_speed(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    double speed = NAN;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_speed(&folder->context, path, &speed), MOR_OK);
    return speed;
}

static void complete_run_resumed_says_so_and_keeps_its_speed(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const first[] = {"run", path, "-t", "1", "-o", "mine", NULL};
    const char *const again[] = {"run", path, "-t", "1", "-o", "mine", "--resume", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, first, 0);
    program_expect_text(outcome.output, "particle-steps/s");
    program_clear(&outcome);
    const double speed = read_speed(folder, "mine");
    assert_true(speed > 0.0);
    outcome = program_run(folder, again, 0);
    program_expect_text(outcome.output,
                        "the run was complete at t = 0.06 s; nothing was computed, results are written anew");
    assert_null(strstr(outcome.output, "steps/s"));
    assert_null(strstr(outcome.output, "nan"));
    program_clear(&outcome);
    assert_true(read_speed(folder, "mine") == speed);
    /* Without a summary there is no speed to keep. */
    assert_int_equal(remove(finished_run_file(folder, path, "mine", MOR_SUMMARY_FILE)), 0);
    finished_run_store_case(folder, path);
    outcome = program_run(folder, again, 0);
    program_clear(&outcome);
    assert_true(isnan(read_speed(folder, "mine")));
}

/* Soil thrown at a third of the speed of sound, c = sqrt((K + 4 G / 3) / rho) or less: 37 m/s here. */
static void run_warns_of_speeds_near_that_of_sound(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const slow[] = {"run", path, "-t", "1", "-o", "slow", NULL};
    const char *const fast[] = {"run",   path,
                                "-t",    "1",
                                "-o",    "fast",
                                "--set", "soil[0].velocity=(\"12 m/s\", \"0 m/s\")",
                                "--set", "domain.max[0]=4",
                                "--set", "soil[0].material.friction_angle=0",
                                NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, slow, 0);
    assert_string_equal(outcome.errors, "");
    program_clear(&outcome);
    outcome = program_run(folder, fast, 0);
    program_expect_text(outcome.errors, "warning: at the end of the run the largest speed so far was 0.");
    program_expect_text(outcome.errors, "below 0.1 is advisable: raise youngs_modulus");
    program_clear(&outcome);
}

/* Room for the case and the log, not for a snapshot. The limit alone would end the program by a signal. */
static void full_disk_is_told_and_the_run_goes_on(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const whole[] = {"run", path, "-t", "1", "-o", "whole", NULL};
    const char *const first[] = {"run", path, "-t", "1", "-o", "mine", NULL};
    const char *const again[] = {"run", path, "-t", "1", "-o", "mine", "--resume", NULL};
    full_disk disk;
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, whole, 0);
    program_clear(&outcome);
    full_disk_begin(&disk, 16384);
    signal(SIGXFSZ, SIG_DFL);
    outcome = program_finish(folder, program_start(folder, first));
    full_disk_end(&disk);
    assert_int_equal(outcome.exit_code, 1);
    program_expect_text(outcome.errors, "check the free space");
    program_expect_text(outcome.errors, "; then resume the run");
    program_clear(&outcome);
    outcome = program_run(folder, again, 0);
    program_clear(&outcome);
    finished_run_compare(folder, "whole", "mine");
}

static void run_stops_at_a_time_with_its_unit(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const in_seconds[] = {"run", path, "-t", "1", "-o", "seconds", "--stop-at", "0.02", NULL};
    const char *const in_milliseconds[] = {"run", path, "-t", "1", "-o", "milliseconds", "--stop-at", "20 ms", NULL};
    finished_run_store_case(folder, path);
    program_outcome one = program_run(folder, in_seconds, 0);
    program_outcome other = program_run(folder, in_milliseconds, 0);
    program_expect_text(one.output, "stopped at t = 0.02");
    assert_string_equal(one.output, other.output);
    program_clear(&one);
    program_clear(&other);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

/* A device that takes nothing stands for a full disk. */
static void output_that_cannot_be_written_is_told(void **state)
{
    run_folder *folder = *state;
    char errors[MOR_PATH_BYTES];
    char line[2 * MOR_PATH_BYTES];
    size_t n_bytes = 0;
    if (access("/dev/full", W_OK) != 0) {
        skip();
    }
    run_folder_file(folder, errors, "errors.txt");
    snprintf(line, sizeof line, "'%s' list probes > /dev/full 2> '%s'", PROGRAM_PATH, errors);
    const int ending = system(line);
    assert_true(WIFEXITED(ending) && WEXITSTATUS(ending) == 1);
    char *text = (char *)run_folder_load(errors, &n_bytes);
    assert_non_null(text);
    program_expect_text(text, "could not be written to standard output");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(complete_run_resumed_says_so_and_keeps_its_speed),
        TEST(full_disk_is_told_and_the_run_goes_on),
        TEST(output_that_cannot_be_written_is_told),
        TEST(run_stops_at_a_time_with_its_unit),
        TEST(run_warns_of_speeds_near_that_of_sound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
