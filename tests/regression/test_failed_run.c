/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/gauge/gauge_table.h"
#include "tests/common/body_variant.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

#include <math.h>
#include <unistd.h>

/* A run that a guard stops leaves everything behind that it has: the table, summary.json, pictures, and a snapshot of
 * its last finished step, in which every number is one. */

/* Soil leaves the domain of the shared case early, here; other ways to fail are settings over it. */
#define LEAVES "domain.max=(\"0.148 m\", \"0.3 m\", \"1 m\")"

static char *load_text(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(finished_run_file(folder, path, run, name), &n_bytes);
    assert_non_null(text);
    return text;
}

/* Runs case.cfg with two settings and expects that a guard stops it; the caller clears the outcome. */
static program_outcome fail_run(run_folder *folder, const char *run, const char *first, const char *second,
                                const char *option)
{
    const char *const arguments[] = {"run",   "case.cfg", "-t",    "1",    "-o",   run,
                                     "--set", first,      "--set", second, option, NULL};
    return program_run(folder, arguments, 1);
}

/* Every number of the last snapshot of a run is finite, and it says that the run stopped there. */
static void check_last_snapshot(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    mor_snapshot_list list;
    mor_snapshot last;
    run_folder_file(folder, path, run);
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, path), MOR_OK);
    assert_true(list.n >= 2);
    assert_int_equal(mor_snapshot_open(&folder->context, &last, path, list.items[list.n - 1].step), MOR_OK);
    assert_string_equal(last.note, "run stopped");
    assert_string_equal(list.items[0].note, "");
    for (int set = 0; set < last.n_sets; ++set) {
        for (int field = 0; field < last.sets[set].n_fields; ++field) {
            const int64_t n = last.sets[set].n_particles * last.sets[set].fields[field].n_components;
            double *values = malloc((size_t)n * sizeof *values);
            assert_non_null(values);
            assert_int_equal(mor_snapshot_read_field(&folder->context, &last, &last.sets[set],
                                                     &last.sets[set].fields[field], values),
                             MOR_OK);
            for (int64_t k = 0; k < n; ++k) {
                assert_true(isfinite(values[k]));
            }
            free(values);
        }
    }
    mor_snapshot_close(&folder->context, &last);
    mor_snapshot_list_clear(&folder->context, &list);
}

static void check_folder(run_folder *folder, const char *run, const program_outcome *outcome)
{
    char path[MOR_PATH_BYTES];
    mor_summary_outcome summary;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_outcome(&folder->context, path, &summary), MOR_OK);
    assert_true(summary.is_failed);
    program_expect_text(outcome->output, "incomplete: the run stopped at t = ");
    program_expect_text(outcome->output, "kinetic_energy");
    check_last_snapshot(folder, run);
}

static void run_whose_soil_leaves_keeps_its_results_and_pictures(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    program_outcome outcome = fail_run(folder, "run", LEAVES, "output.pictures=true", NULL);
    check_folder(folder, "run", &outcome);
    program_expect_text(outcome.errors, "left the domain");
    program_expect_text(outcome.output, "picture: run/images/step_");
    program_expect_text(outcome.output, "chart: run/images/");
    char *summary = load_text(folder, "run", MOR_SUMMARY_FILE);
    program_expect_text(summary, "\"status\": \"failed\"");
    program_expect_text(summary, "left the domain");
    program_expect_text(summary, "\"set\": \"soil\"");
    free(summary);
    program_clear(&outcome);
}

/* The steps since the state that was kept are taken again; from wherever they are taken, they give the same bits. */
static void last_finished_step_is_the_same_after_a_resume(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char hash_a[32];
    char hash_b[32];
    finished_run_store_case(folder, case_path);
    program_outcome outcome = fail_run(folder, "whole", LEAVES, "seed=1", NULL);
    program_clear(&outcome);
    const char *const stopped[] = {"run",   case_path, "-t",        "1",      "-o", "parts",
                                   "--set", LEAVES,    "--stop-at", "0.0107", NULL};
    outcome = program_run(folder, stopped, 0);
    program_clear(&outcome);
    outcome = fail_run(folder, "parts", LEAVES, "seed=1", "--resume");
    program_clear(&outcome);
    finished_run_read_hash(folder, "whole", hash_a);
    finished_run_read_hash(folder, "parts", hash_b);
    assert_string_equal(hash_a, hash_b);
    finished_run_compare_bytes(folder, "whole", "parts", MOR_TABLE_SERIES_FILE);
    finished_run_compare_results(folder, "whole", "parts");
}

static double read_result(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    char unit[32];
    double value = NAN;
    finished_run_file(folder, path, "run", MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_result(&folder->context, path, name, &value, unit, sizeof unit), MOR_OK);
    return value;
}

/* Rows lie closer together than the states that are kept: the last row is the mean since the one before it. */
static void rows_of_gauges_add_up_to_the_impulse(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char text[sizeof finished_run_case + 128];
    mor_table_data rows;
    double impulse = 0.0;
    snprintf(text, sizeof text, "%s gauges = ( { name = 'floor'; wall = 'floor'; direction = (0, -1); } );",
             finished_run_case);
    finished_run_store_text(folder, text, path);
    program_outcome outcome = fail_run(folder, "run", LEAVES, "output.series_interval=1 ms", NULL);
    program_clear(&outcome);
    finished_run_file(folder, path, "run", MOR_GAUGE_TABLE_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &rows, path), MOR_OK);
    assert_true(rows.n_rows > 3);
    for (int64_t k = 1; k < rows.n_rows; ++k) {
        const double *row = rows.values + k * rows.n_columns; /* time, normal, ... */
        impulse += row[1] * (row[0] - row[-rows.n_columns]);
    }
    mor_table_data_clear(&folder->context, &rows);
    const double expected = read_result(folder, "gauge.floor.impulse_soil");
    assert_true(expected > 1.0);
    assert_true(fabs(impulse - expected) < 1e-7 * expected); /* rounding of times in the table */
}

/* The remedy that the message names is taken, and nothing of the stop is left. */
static void failed_run_goes_on_in_a_larger_domain(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    mor_summary_outcome summary;
    finished_run_store_case(folder, case_path);
    program_outcome outcome = fail_run(folder, "run", LEAVES, "seed=1", NULL);
    program_clear(&outcome);
    const char *const resumed[] = {"run", case_path, "-t", "1", "-o", "run", "--resume", NULL};
    outcome = program_run(folder, resumed, 0);
    program_clear(&outcome);
    finished_run_file(folder, path, "run", MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_outcome(&folder->context, path, &summary), MOR_OK);
    assert_false(summary.is_failed);
    mor_snapshot_list list;
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, run_folder_file(folder, path, "run")), MOR_OK);
    assert_int_equal(list.n, 7);
    mor_snapshot_list_clear(&folder->context, &list);
}

/* Weight that the soil cannot bear. */
static void runaway_soil_keeps_its_results(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    program_outcome outcome =
        fail_run(folder, "run", "gravity=(\"0 m/s2\", \"-1e5 m/s2\", \"0 m/s2\")", "numerics.courant=0.9", NULL);
    check_folder(folder, "run", &outcome);
    program_clear(&outcome);
}

/* Rocks in soil, which rise through the top of the domain: what their contact remembers is taken back, too. */
static void rocks_that_leave_keep_the_results(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, body_plane, case_path);
    program_outcome outcome =
        fail_run(folder, "run", "gravity=(\"0 m/s2\", \"400 m/s2\", \"0 m/s2\")", "spacing=5 mm", NULL);
    program_expect_text(outcome.output, "incomplete: the run stopped at t = ");
    check_last_snapshot(folder, "run");
    program_clear(&outcome);
}

static void expectations_of_a_failed_run_are_not_reached(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    program_outcome outcome = fail_run(
        folder, "run", LEAVES, "expect=({probe=\"height\"; value=\"0.1 m\"; tolerance=10.0; source=\"s\";})", NULL);
    program_expect_text(outcome.output, "expectations were not reached");
    char *summary = load_text(folder, "run", MOR_SUMMARY_FILE);
    program_expect_text(summary, "\"pass\": false");
    free(summary);
    program_clear(&outcome);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(run_whose_soil_leaves_keeps_its_results_and_pictures),
        TEST(last_finished_step_is_the_same_after_a_resume),
        TEST(rows_of_gauges_add_up_to_the_impulse),
        TEST(failed_run_goes_on_in_a_larger_domain),
        TEST(runaway_soil_keeps_its_results),
        TEST(rocks_that_leave_keep_the_results),
        TEST(expectations_of_a_failed_run_are_not_reached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
