/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/io/checkpoint.h"
#include "tests/common/body_variant.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

#include <time.h>

#define CASE_FILE "case.resolved.cfg"

/* The program is killed at random moments and its checkpoints are damaged. What a run leaves behind must be enough to
 * end where an undisturbed run ends, bit by bit, or be refused by name. MOR_KILLS sets the number of kills. */
enum { N_KILLS = 5, N_FLIPS = 6 };

static double read_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void run_to_the_end(run_folder *folder, const char *const *arguments)
{
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
}

/* Every snapshot on the disk can be read in full. */
static void check_snapshots(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    mor_snapshot_list list;
    run_folder_file(folder, path, run);
    const int n_logged = folder->n_logged;
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, path), MOR_OK);
    assert_int_equal(folder->n_logged, n_logged); /* a damaged one would be logged */
    for (int64_t k = 0; k < list.n; ++k) {
        mor_snapshot snapshot;
        assert_int_equal(mor_snapshot_open(&folder->context, &snapshot, path, list.items[k].step), MOR_OK);
        mor_snapshot_close(&folder->context, &snapshot);
    }
    mor_snapshot_list_clear(&folder->context, &list);
}

/* Kills a run of a case, zero-terminated text, and resumes it until it ends. */
static void kill_at_random_moments(run_folder *folder, const char *text, const char *spacing)
{
    char case_path[MOR_PATH_BYTES];
    const char *wish = getenv("MOR_KILLS");
    const int n_kills = wish != NULL ? atoi(wish) : N_KILLS;
    /* Checkpoints all the time, so that many kills fall into the writing of one. */
#define RUN                                                                                                            \
    "run", case_path, "-t", "1", "--set", spacing, "--set", "output.snapshots=6", "--set", "output.pictures=false",    \
        "--set", "output.checkpoint_seconds=0.02", "-o"
    const char *const whole[] = {RUN, "whole", NULL};
    const char *const killed[] = {RUN, "killed", "--resume", NULL};
    finished_run_store_text(folder, text, case_path);
    const double before = read_clock();
    run_to_the_end(folder, whole);
    const double duration = read_clock() - before;
    int n_killed = 0;
    for (int k = 0; k < n_kills; ++k) {
        const double part = mor_random_uniform(folder->context.seed, (uint64_t)k, 1);
        n_killed += program_kill_after(folder, killed, 0.35 * duration * part);
        check_snapshots(folder, "killed");
    }
    assert_true(n_killed >= 1); /* the first comes well before the end */
    run_to_the_end(folder, killed);
    finished_run_compare(folder, "whole", "killed");
}

static void run_killed_at_random_moments_ends_as_if_never_killed(void **state)
{
    kill_at_random_moments(*state, finished_run_case, "spacing=4 mm");
}

static void run_with_rocks_killed_at_random_moments_ends_as_if_never_killed(void **state)
{
    static const char probes[] = "probes = ( { type = 'kinetic_energy'; }, { type = 'contact_depth'; },"
                                 "  { type = 'wall_contact_force'; wall = 'floor'; direction = (0, 1, 0); } );";
    char text[sizeof body_plane + sizeof probes];
    snprintf(text, sizeof text, "%s%s", body_plane, probes);
    kill_at_random_moments(*state, text, "spacing=5 mm");
}

/* Runs the case into two folders: one undisturbed, one stopped half-way with a checkpoint and one before it. */
static void prepare_runs(run_folder *folder, char *case_path)
{
    const char *const whole[] = {"run", case_path, "-t", "1", "-o", "whole", NULL};
    finished_run_store_case(folder, case_path);
    run_to_the_end(folder, whole);
}

/* A run is killed in its first moments, again and again: the file that says which case the folder holds is there whole
 * or not at all, or the run could never be resumed. */
static void case_file_of_a_run_killed_at_its_start_is_whole_or_missing(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    size_t n_whole_bytes = 0;
    prepare_runs(folder, case_path);
    unsigned char *whole = run_folder_load(finished_run_file(folder, path, "whole", CASE_FILE), &n_whole_bytes);
    assert_non_null(whole);
    int n_found = 0;
    double seconds = 0.0005;
    /* Ever later, until the file has been there ten times. */
    for (int k = 0; k < 300 && n_found < 10; ++k, seconds *= 1.05) {
        char run[32];
        snprintf(run, sizeof run, "early_%d", k);
        const char *const started[] = {"run", case_path, "-t", "1", "-o", run, NULL};
        program_kill_after(folder, started, seconds);
        size_t n_bytes = 0;
        unsigned char *bytes = run_folder_load(finished_run_file(folder, path, run, CASE_FILE), &n_bytes);
        if (bytes != NULL) {
            assert_int_equal(n_bytes, n_whole_bytes);
            assert_memory_equal(bytes, whole, n_bytes);
        }
        n_found += bytes != NULL;
        free(bytes);
    }
    free(whole);
    assert_int_equal(n_found, 10);
}

static void stop_half_way(run_folder *folder, const char *case_path, const char *run)
{
    const char *const stopped[] = {"run", case_path, "-t", "1", "-o", run, "--stop-at", "0.03", NULL};
    run_to_the_end(folder, stopped);
}

/* Replaces a file by its first n_kept bytes with one bit turned; bit < 0: none. */
static void damage(run_folder *folder, const char *run, const char *name, double part_kept, int64_t bit)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(finished_run_file(folder, path, run, name), &n_bytes);
    assert_non_null(bytes);
    if (bit >= 0) {
        bytes[(size_t)bit / 8 % n_bytes] ^= (unsigned char)(1u << (bit % 8));
    }
    run_folder_store(path, bytes, (size_t)(part_kept * (double)n_bytes));
    free(bytes);
}

/* The damaged newest checkpoint is named, the one before is used, and the run ends as the undisturbed one. */
static void check_fallback(run_folder *folder, const char *case_path, const char *run)
{
    const char *const resumed[] = {"run", case_path, "-t", "1", "-o", run, "--resume", NULL};
    program_outcome outcome = program_run(folder, resumed, 0);
    program_expect_text(outcome.errors, "warning");
    program_expect_text(outcome.errors, MOR_CHECKPOINT_FILE);
    program_clear(&outcome);
    finished_run_compare(folder, "whole", run);
}

static void truncated_checkpoint_falls_back_to_the_one_before(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    static const double parts[] = {0.0, 0.5, 0.999};
    prepare_runs(folder, case_path);
    for (int k = 0; k < 3; ++k) {
        char run[32];
        snprintf(run, sizeof run, "truncated_%d", k);
        stop_half_way(folder, case_path, run);
        damage(folder, run, MOR_CHECKPOINT_FILE, parts[k], -1);
        check_fallback(folder, case_path, run);
    }
}

static void checkpoint_with_a_turned_bit_falls_back_to_the_one_before(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    prepare_runs(folder, case_path);
    for (int k = 0; k < N_FLIPS; ++k) {
        char run[32];
        snprintf(run, sizeof run, "turned_%d", k);
        stop_half_way(folder, case_path, run);
        damage(folder, run, MOR_CHECKPOINT_FILE, 1.0, (int64_t)(mor_random_mix((uint64_t)k) >> 16));
        check_fallback(folder, case_path, run);
    }
}

static void run_without_an_intact_checkpoint_is_refused_by_name(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    const char *const resumed[] = {"run", case_path, "-t", "1", "-o", "damaged", "--resume", NULL};
    finished_run_store_case(folder, case_path);
    stop_half_way(folder, case_path, "damaged");
    damage(folder, "damaged", MOR_CHECKPOINT_FILE, 0.5, -1);
    damage(folder, "damaged", MOR_CHECKPOINT_PREVIOUS_FILE, 1.0, 99991);
    program_outcome outcome = program_run(folder, resumed, 1);
    program_expect_text(outcome.errors, MOR_CHECKPOINT_FILE);
    program_expect_text(outcome.errors, MOR_CHECKPOINT_PREVIOUS_FILE);
    program_clear(&outcome);
    check_snapshots(folder, "damaged");
}

/* Killed before the first checkpoint, a run resumes from its beginning. */
static void run_without_a_checkpoint_starts_from_the_beginning(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    const char *const resumed[] = {"run", case_path, "-t", "1", "-o", "bare", "--resume", NULL};
    prepare_runs(folder, case_path);
    stop_half_way(folder, case_path, "bare");
    assert_int_equal(remove(finished_run_file(folder, path, "bare", MOR_CHECKPOINT_FILE)), 0);
    assert_int_equal(remove(finished_run_file(folder, path, "bare", MOR_CHECKPOINT_PREVIOUS_FILE)), 0);
    program_outcome outcome = program_run(folder, resumed, 0);
    program_expect_text(outcome.errors, "starts from the beginning");
    program_clear(&outcome);
    finished_run_compare(folder, "whole", "bare");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(run_killed_at_random_moments_ends_as_if_never_killed, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_with_rocks_killed_at_random_moments_ends_as_if_never_killed,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(case_file_of_a_run_killed_at_its_start_is_whole_or_missing, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(truncated_checkpoint_falls_back_to_the_one_before, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(checkpoint_with_a_turned_bit_falls_back_to_the_one_before, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_without_an_intact_checkpoint_is_refused_by_name, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_without_a_checkpoint_starts_from_the_beginning, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
