/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/summary/summary.h"
#include "tests/common/run_folder.h"

#include <math.h>

static const mor_summary_statistics push = {.maximum = 4.5,
                                            .minimum = -1.25,
                                            .time_of_maximum = 0.3,
                                            .time_of_minimum = NAN,
                                            .mean = 0.5,
                                            .impulse = 0.1,
                                            .impulse_unit = "N s",
                                            .window = {0.25, 0.5},
                                            .n_measured = 12.0,
                                            .n_skipped = 2.0,
                                            .interval = 3};
static const mor_summary_result results[] = {{"run_out", 0.1, "m", NULL, NULL},
                                             {"energy", NAN, "J", NULL, NULL},
                                             {"ratio", 2.0, "1", NULL, NULL},
                                             {"push", 1.0, "N", &push, "soft \"contact\""}};
static const mor_summary_expectation expectations[] = {
    {"run_out", "value", 0.1, 0.224, 0.05, 0.01, false, false, "Lube et al. 2004"},
    {"energy", "value", NAN, 1.0, INFINITY, 1.0, true, false, NULL},
    {"ratio", "value", 2.0, 2.0, 0.1, 0.1, false, true, "closed form"},
    {"push", "maximum", 4.5, 4.5, 0.1, 0.1, false, true, "a statistic"},
    {"push", "impulse", 0.1, 0.2, 0.1, 0.1, false, false, "another"},
};
static const mor_summary_input inputs[] = {{"case.cfg", 0x0123456789ABCDEFu}, {"a \"b\".stl", 1}};

static const char *const warnings[] = {"the soil is \"soft\"", "deep \xFF"};

static mor_summary make_summary(void)
{
    return (mor_summary){.results = results,
                         .n_results = 4,
                         .expectations = expectations,
                         .n_expectations = 5,
                         .warnings = warnings,
                         .n_warnings = 2,
                         .state_hash = 0xFEDCBA9876543210u,
                         .particle_steps_per_second = 1234567.5,
                         .bytes_per_fine_particle = 400.25,
                         .version = "0.1.0",
                         .commit = "",
                         .seed = 42,
                         .command = "moraine run case.cfg",
                         .n_threads = 2,
                         .inputs = inputs,
                         .n_inputs = 2};
}

/* The written file as text; the caller frees it. */
static char *write_and_load(run_folder *folder, const mor_summary *summary, char *path)
{
    size_t n_bytes = 0;
    run_folder_file(folder, path, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_write(&folder->context, path, summary), MOR_OK);
    char *text = (char *)run_folder_load(path, &n_bytes);
    assert_non_null(text);
    return text;
}

static void members_are_written_as_documented(void **state)
{
    static const char *const wanted[] = {
        "\"run_out\": {\n      \"value\": 0.10000000000000001,\n      \"unit\": \"m\"\n    }",
        "\"energy\": {\n      \"value\": null,\n      \"unit\": \"J\"\n    }",
        "\"measured\": 0.10000000000000001,\n      \"reference\": 0.224",
        "\"tolerance\": null,\n      \"tolerance_low\": 1.0,\n      \"tolerance_kind\": \"absolute\"",
        "\"pass\": true",
        "\"maximum\": 4.5,\n      \"time_of_maximum\": 0.29999999999999999,\n      \"minimum\": -1.25,\n"
        "      \"time_of_minimum\": null,\n      \"mean\": 0.5,\n      \"impulse\": 0.10000000000000001,\n"
        "      \"impulse_unit\": \"N s\",\n      \"window\": [\n        0.25,\n        0.5\n      ],\n"
        "      \"interval\": 3,\n      \"measured\": 12,\n      \"skipped\": 2,\n      \"remark\": \"soft "
        "\\\"contact\\\"\"\n",
        "\"statistic\": \"impulse\",\n      \"measured\": 0.10000000000000001,\n      \"reference\": 0.2",
        "\"unit\": \"N s\",\n      \"pass\": false",
        "\"source\": \"Lube et al. 2004\"",
        "\"warnings\": [\n    \"the soil is \\\"soft\\\"\",\n    \"deep ?\"\n  ]",
        "\"state_hash\": \"fedcba9876543210\"",
        "\"speed\": {\n    \"particle_steps_per_second\": 1234567.5\n  }",
        "\"memory\": {\n    \"bytes_per_fine_particle\": 400.25\n  }",
        "\"seed\": 42",
        "\"threads\": 2",
        "\"inputs\": {\n      \"case.cfg\": \"0123456789abcdef\"",
        "      \"a \\\"b\\\".stl\": \"0000000000000001\"\n    }",
    };
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const mor_summary summary = make_summary();
    char *text = write_and_load(folder, &summary, path);
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; ++k) {
        assert_non_null(strstr(text, wanted[k]));
    }
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
    free(text);
}

static void results_are_read_back_exactly(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char unit[8];
    double value = 0.0;
    const mor_summary summary = make_summary();
    free(write_and_load(folder, &summary, path));
    assert_int_equal(mor_summary_read_result(&folder->context, path, "run_out", &value, unit, sizeof unit), MOR_OK);
    assert_true(value == 0.1); /* exact: 17 digits tell all doubles apart */
    assert_string_equal(unit, "m");
    assert_int_equal(mor_summary_read_result(&folder->context, path, "energy", &value, unit, sizeof unit), MOR_OK);
    assert_true(isnan(value));
    assert_int_equal(mor_summary_read_result(&folder->context, path, "none", &value, unit, sizeof unit), MOR_ERROR_IO);
    assert_int_equal(mor_summary_read_result(&folder->context, path, "run_out", &value, unit, 1), MOR_ERROR_IO);
}

static void statistics_are_read_back_exactly(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char remark[64];
    mor_summary_statistics it;
    const mor_summary summary = make_summary();
    free(write_and_load(folder, &summary, path));
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "push", &it, remark, sizeof remark), MOR_OK);
    assert_true(it.maximum == 4.5 && it.minimum == -1.25 && it.time_of_maximum == 0.3 && it.mean == 0.5);
    assert_true(isnan(it.time_of_minimum) && it.impulse == 0.1 && it.window[0] == 0.25 && it.window[1] == 0.5);
    assert_true(it.n_measured == 12.0 && it.n_skipped == 2.0 && it.interval == 3);
    assert_string_equal(remark, "soft \"contact\"");
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "ratio", &it, remark, sizeof remark),
                     MOR_ERROR_IO);
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "none", &it, remark, sizeof remark),
                     MOR_ERROR_IO);
}

static void odd_texts_and_large_seeds_do_not_lose_the_summary(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_summary summary = make_summary();
    const mor_summary_input odd_input = {"\xE9.cfg", 3};
    summary.command = "moraine run \xFF\xFE \"x\" \n \xC3\xA9";
    summary.seed = UINT64_MAX;
    summary.inputs = &odd_input;
    summary.n_inputs = 1;
    char *text = write_and_load(folder, &summary, path);
    assert_non_null(strstr(text, "\"command\": \"moraine run ?? \\\"x\\\" \\n ??\""));
    assert_non_null(strstr(text, "\"seed\": \"18446744073709551615\""));
    assert_non_null(strstr(text, "\"?.cfg\": \"0000000000000003\""));
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
    free(text);
}

static void run_without_probes_has_a_complete_summary(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_summary summary = make_summary();
    summary.n_results = summary.n_expectations = summary.n_inputs = 0;
    summary.particle_steps_per_second = NAN;
    free(write_and_load(folder, &summary, path));
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
}

static void contradictions_are_refused_and_the_old_file_stays(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    const mor_summary_result twice[] = {{"a", 1.0, "m", NULL, NULL}, {"a", 2.0, "m", NULL, NULL}};
    const mor_summary_input same[] = {{"a", 1}, {"a", 2}};
    const mor_summary_expectation unknown = {"none", "value", 1.0, 1.0, 0.1, 0.1, false, true, NULL};
    const mor_summary_expectation other = {"run_out", "value", 0.2, 0.2, 0.1, 0.1, false, true, NULL};
    const mor_summary_expectation passing = {"energy", "value", NAN, 1.0, 0.1, 0.1, false, true, NULL};
    const mor_summary_expectation odd = {"push", "median", 4.5, 4.5, 0.1, 0.1, false, true, NULL};
    const mor_summary_expectation wrong = {"push", "mean", 4.5, 4.5, 0.1, 0.1, false, true, NULL};
    const mor_summary good = make_summary();
    char *before = write_and_load(folder, &good, path);
    for (int fault = 0; fault < 8; ++fault) {
        mor_summary bad = make_summary();
        bad.n_expectations = 0;
        if (fault < 5) {
            bad.expectations =
                (const mor_summary_expectation *const[]){&unknown, &other, &passing, &odd, &wrong}[fault];
            bad.n_expectations = 1;
        } else if (fault == 5) {
            bad.results = twice;
            bad.n_results = 2;
        } else if (fault == 6) {
            bad.inputs = same;
        } else {
            bad.commit = NULL;
        }
        assert_int_equal(mor_summary_write(&folder->context, path, &bad), MOR_ERROR_ARGUMENT);
    }
    char *after = (char *)run_folder_load(path, &n_bytes);
    assert_string_equal(before, after);
    free(before);
    free(after);
}

/* Replaces the first occurrence of a word by another of any length. */
static void store_replaced(const char *path, const char *text, const char *word, const char *other)
{
    char changed[8192];
    const char *place = strstr(text, word);
    assert_non_null(place);
    const int n_bytes =
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(place - text), text, other, place + strlen(word));
    assert_true(n_bytes > 0 && n_bytes < (int)sizeof changed);
    run_folder_store(path, changed, (size_t)n_bytes);
}

static void incomplete_files_are_refused(void **state)
{
    static const char *const changes[][2] = {
        {"\"version\": 1", "\"version\": 2"},
        {"\"results\"", "\"result\""},
        {"\"value\": 0.1", "\"value\": \"\", \"x\": 0.1"},
        {"\"unit\": \"m\"", "\"unit\": 1"},
        {"\"measured\": 0.1", "\"measured\": 0.2"},
        {"\"pass\": true", "\"pass\": 1"},
        {"\"probe\": \"ratio\"", "\"probe\": \"x\""},
        {"fedcba98", "FEDCBA98"},
        {"particle_steps", "steps"},
        {"bytes_per_fine", "bytes_per"},
        {"\"seed\": 42", "\"seed\": 0.5"},
        {"0123456789abcdef", "0123"},
        {"\"threads\": 2", "\"threads\": null"},
        {"\"commit\"", "\"command\""},
    };
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const mor_summary summary = make_summary();
    char *text = write_and_load(folder, &summary, path);
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        store_replaced(path, text, changes[k][0], changes[k][1]);
        assert_int_equal(mor_summary_check(&folder->context, path), MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, path));
    }
    for (size_t n_bytes = 0; n_bytes + 2 < strlen(text); n_bytes += 7) {
        run_folder_store(path, text, n_bytes);
        assert_int_equal(mor_summary_check(&folder->context, path), MOR_ERROR_IO);
    }
    free(text);
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(members_are_written_as_documented),
        FOLDER_TEST(results_are_read_back_exactly),
        FOLDER_TEST(statistics_are_read_back_exactly),
        FOLDER_TEST(odd_texts_and_large_seeds_do_not_lose_the_summary),
        FOLDER_TEST(run_without_probes_has_a_complete_summary),
        FOLDER_TEST(contradictions_are_refused_and_the_old_file_stays),
        FOLDER_TEST(incomplete_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
