/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Gauges, and probes that look back to the start, of a run that was stopped and resumed leave the same files behind as
 * those of one that never stopped. */

static const char text[] =
    "title = 'gauges'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');"
    "end = '60 ms'; domain = { min = ('-0.1 m', '-0.1 m', '-1 m'); max = ('0.6 m', '0.6 m', '1 m'); };"
    "soil = ( { name = 'sand'; velocity = ('1 m/s', 0, 0);"
    "  shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.3 m', '0.2 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; },"
    "  { name = 'stop'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0.32 m', '0 m', '0 m'); normal = (-1, 0, 0); }; } );"
    "bodies = ( { name = 'ball'; position = ('0.25 m', '0.27 m'); velocity = ('1 m/s', 0, 0);"
    "  shape = { type = 'sphere'; center = (0, 0, 0); radius = '0.06 m'; }; contact_modulus = '10 MPa';"
    "  material = { model = 'rigid'; density = '2500 kg/m3'; }; } );"
    "gauges = ( { name = 'mean'; wall = 'stop'; direction = (1, 0); origin = ('0.32 m', 0); filter = '7 ms';"
    "    cell = '0.05 m'; },"
    "  { name = 'low_pass'; wall = 'stop'; direction = (1, 0); cutoff = '50 Hz'; },"
    "  { name = 'ball'; body = 'ball'; direction = (0, -1); } );"
    "probes = ( { type = 'gauge_normal'; gauge = 'mean'; }, { type = 'gauge_height'; gauge = 'mean'; },"
    "  { type = 'gauge_moment'; gauge = 'low_pass'; }, { type = 'gauge_shear'; gauge = 'ball'; },"
    "  { type = 'mass_passed'; origin = ('0.305 m', 0); direction = (1, 0); }, { type = 'displacement'; },"
    "  { type = 'boulder_travel'; }, { name = 'line'; type = 'passages'; origin = ('0.255 m', 0); direction = (1, 0); "
    "},"
    "  { type = 'passage_energy'; origin = ('0.255 m', 0); direction = (1, 0); },"
    "  { type = 'angle_of_reach'; direction = (1, 0); }, { type = 'angle_of_centers'; direction = (1, 0); } );"
    "numerics = { sort_interval = 11; }; output = { snapshots = 6; pictures = false; series_interval = '1 ms'; };";

static void run_case(run_folder *folder, const char *name, double stop_at, bool is_resume, int n_threads)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    const session_run run = {
        .case_path = case_path, .name = name, .stop_at = stop_at, .is_resume = is_resume, .n_threads = n_threads};
    assert_int_equal(session_run_do(folder, &run, name), isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
}

static void gauges_go_on_as_if_never_stopped(void **state)
{
    static const char *const names[] = {"gauges.csv",   "gauge_peaks.csv",   "gauge_mean_map.csv",
                                        "boulders.csv", "boulder_paths.csv", "displacements.csv"};
    run_folder *folder = *state;
    run_case(folder, "whole", NAN, false, 1);
    run_case(folder, "stopped", 0.0111, false, 1);
    run_case(folder, "stopped", 0.0432, true, 2);
    run_case(folder, "stopped", NAN, true, 1);
    finished_run_compare(folder, "whole", "stopped");
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        finished_run_compare_bytes(folder, "whole", "stopped", names[k]);
    }
}

/* The rows of gauges.csv are means, so that their sum over time is the impulse that the peaks tell. */
static void rows_add_up_to_the_impulse(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    mor_summary_statistics it;
    char remark[8];
    double sum = 0.0;
    double largest = 0.0;
    run_case(folder, "run", NAN, false, 1);
    assert_int_equal(mor_table_data_read(&folder->context, &data, finished_run_file(folder, path, "run", "gauges.csv")),
                     MOR_OK);
    assert_int_equal(data.n_columns, 1 + 3 * 8);
    for (int64_t row = 1; row < data.n_rows; ++row) {
        const double *cells = data.values + row * data.n_columns;
        sum += (cells[0] - cells[-data.n_columns]) * (cells[2] + cells[3]);
        assert_true(fabs(cells[1] - cells[2] - cells[3]) <= 1e-9 * fabs(cells[1])); /* shares of the whole */
        largest = fmax(largest, cells[8]);
    }
    mor_table_data_clear(&folder->context, &data);
    finished_run_file(folder, path, "run", MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "gauge_normal", &it, remark, sizeof remark),
                     MOR_OK);
    assert_true(sum > 0.0 && largest > 0.0);
    assert_true(largest == it.maximum); /* of every step, in both */
    /* A running mean over the last 7 ms of 60 ms is late, and so is its integral. */
    assert_true(fabs(it.impulse / sum - 1.0) < 0.12);
}

/* The number behind a member of a result. */
static double find_number(const char *json, const char *result, const char *member)
{
    const char *at = strstr(json, result);
    assert_non_null(at);
    at = strstr(at, member);
    assert_non_null(at);
    return strtod(at + strlen(member) + 2, NULL); /* behind the quote's colon */
}

/* summary.json has the peak that a probe of the gauge has seen in every step, when it was, and how it was filtered. */
static void summary_tells_peaks_and_filters(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    run_case(folder, "run", NAN, false, 1);
    char *bytes = (char *)run_folder_load(finished_run_file(folder, path, "run", MOR_SUMMARY_FILE), &n_bytes);
    assert_non_null(bytes);
    const double largest = find_number(bytes, "\"gauge_normal\"", "\"maximum\"");
    assert_true(largest > 0.0 && largest == find_number(bytes, "\"gauge.mean.peak_normal\"", "\"value\""));
    assert_true(find_number(bytes, "\"gauge_normal\"", "\"time_of_maximum\"") ==
                find_number(bytes, "\"gauge.mean.time_of_peak\"", "\"value\""));
    assert_true(find_number(bytes, "\"gauge.mean.impulse_soil\"", "\"value\"") > 0.0);
    assert_non_null(strstr(bytes, "filter: running mean over 0.007 s"));
    assert_non_null(strstr(bytes, "filter: Butterworth low pass at 50 Hz"));
    assert_non_null(strstr(bytes, "\"gauge.ball.peak_of_single_steps\""));
    free(bytes);
}

/* A peak at the end of a run may not be the largest load. The soil reaches the wall at 4 ms, and its first blow is over
 * at 17 ms; nothing loads the ball from below. */
static void loads_that_grow_at_the_end_are_told(void **state)
{
    static const struct {
        const char *setting;
        bool grows;
    } rows[] = {{"end=10 ms", true}, {"end=60 ms", false}};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        char summary[MOR_PATH_BYTES];
        size_t n_bytes = 0;
        const session_run run = {.case_path = path,
                                 .name = rows[k].setting + strlen("end="),
                                 .settings = &rows[k].setting,
                                 .n_settings = 1,
                                 .stop_at = NAN,
                                 .n_threads = 1};
        assert_int_equal(session_run_do(folder, &run, run.name), MOR_SESSION_FINISHED);
        finished_run_file(folder, summary, run.name, MOR_SUMMARY_FILE);
        char *bytes = (char *)run_folder_load(summary, &n_bytes);
        assert_non_null(bytes);
        assert_int_equal(strstr(bytes, "the load on gauge 'mean' was still growing") != NULL, rows[k].grows);
        assert_int_equal(strstr(bytes, "the load on gauge 'low_pass' was still growing") != NULL, rows[k].grows);
        assert_null(strstr(bytes, "the load on gauge 'ball'"));
        free(bytes);
    }
}

/* boulders.csv holds what the probes tell of the one body. */
static void boulders_have_a_line_each(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    double numbers[17];
    run_case(folder, "run", NAN, false, 1);
    char *bytes = (char *)run_folder_load(finished_run_file(folder, path, "run", "boulders.csv"), &n_bytes);
    assert_non_null(bytes);
    const char *line = strchr(bytes, '\n') + 1;
    assert_int_equal(strncmp(line, "ball,", 5), 0);
    line = strchr(line, ',');
    for (int k = 0; k < 17;
         ++k) { /* diameter, mass, start, end, path, fastest, its time, last, rest, removed, passage */
        assert_non_null(line);
        numbers[k] = strtod(line + 1, NULL);
        line = strchr(line + 1, ',');
    }
    assert_null(line);
    assert_true(fabs(numbers[0] - 0.12) < 1e-3); /* of the shape, by its volume */
    assert_true(fabs(numbers[2] - 0.25) < 1e-9 && fabs(numbers[3] - 0.27) < 1e-9);
    const double way = hypot(numbers[5] - numbers[2], numbers[6] - numbers[3]);
    assert_true(numbers[8] >= way * (1.0 - 1e-9) && numbers[8] < 0.1); /* no shorter than straight, at 1 m/s */
    assert_true(numbers[9] >= 1.0 && numbers[14] == 0.0);              /* it comes back from the wall */
    assert_true(fabs(numbers[15] - 0.005) < 0.001);                    /* 5 mm at 1 m/s */
    assert_true(fabs(numbers[16] / (0.5 * numbers[1]) - 1.0) < 0.1);   /* it falls by a few centimeters per second */
    free(bytes);
}

/* What looks back to the start cannot be added to a run that goes on. */
static void probes_of_the_start_cannot_be_appended(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char path[MOR_PATH_BYTES];
    char more[sizeof text + 128];
    mor_session *session = NULL;
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    run_case(folder, "run", 0.0111, false, 1);
    const char *end = strstr(text, "numerics = {");
    assert_non_null(end);
    const int n = (int)(end - text);
    snprintf(more, sizeof more, "%.*s", n, text);
    char *close = strrchr(more, ')');
    assert_non_null(close);
    snprintf(close, sizeof more - (size_t)(close - more), ", { name = 'late'; type = 'displacement'; } ); %s", end);
    finished_run_store_text(folder, more, case_path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_load_file(session, case_path), MOR_OK);
    assert_int_equal(mor_session_run(session, run_folder_file(folder, path, "run"), true, NAN, &outcome),
                     MOR_ERROR_CONFIG);
    assert_non_null(strstr(mor_session_message(session), "begins at the start of a run"));
    mor_session_free(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(gauges_go_on_as_if_never_stopped, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(rows_add_up_to_the_impulse, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(summary_tells_peaks_and_filters, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(loads_that_grow_at_the_end_are_told, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(boulders_have_a_line_each, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(probes_of_the_start_cannot_be_appended, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
