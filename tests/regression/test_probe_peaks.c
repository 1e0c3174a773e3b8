/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_run.h"

#include <math.h>

/* A hit between two rows of series.csv was missed by every result of a run. */

static const char hit[] =
    "title = 'hit'; dimension = 2; spacing = '0.025 m'; end = '0.2 s'; gravity = (0, 0, 0);"
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); }; contact = { friction_coefficient = 0; restitution = 1; };"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
    "bodies = ( { name = 'box'; shape = { type = 'sphere'; center = (0, 0); radius = 0.2; };"
    "    position = (0, 0.25); velocity = (0, -1); contact_modulus = '10 MPa';"
    "    material = { model = 'rigid'; density = 2400; }; } );"
    "probes = ( { name = 'force'; type = 'wall_contact_force'; wall = 'floor'; direction = (0, -1); },"
    "  { name = 'late'; type = 'wall_contact_force'; wall = 'floor'; direction = (0, -1); window = [0.1, 0.2]; } );"
    "expect = ( { probe = 'force'; statistic = 'maximum'; value = '50.27 kN/m'; tolerance = 0.02; source = 'spring'; },"
    "  { probe = 'force'; statistic = 'impulse'; value = '603.2 N s/m'; tolerance = 0.002; source = 'momentum'; },"
    "  { probe = 'force'; statistic = 'mean'; value = 0; tolerance = 1; absolute = true; source = 'wrong'; },"
    "  { probe = 'force'; value = 0; tolerance = 1; absolute = true; source = 'gone'; } );"
    "output = { snapshots = 1; series_interval = '45 ms'; pictures = false; };";

/* Runs the case; what it printed, the caller frees it. */
static char *run_hit(run_folder *folder)
{
    char case_path[MOR_PATH_BYTES];
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *output = open_memstream(&text, &n_bytes);
    assert_non_null(output);
    finished_run_store_text(folder, hit, case_path);
    const session_run it = {.case_path = case_path,
                            .name = "run",
                            .stop_at = NAN,
                            .n_threads = folder->context.n_threads,
                            .output = output};
    assert_int_equal(session_run_do(folder, &it, "hit"), MOR_SESSION_MISSED); /* the mean that is not zero */
    fclose(output);
    return text;
}

static double find_largest_in_rows(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    double largest = 0.0;
    assert_int_equal(
        mor_table_data_read(&folder->context, &data, finished_run_file(folder, path, "run", MOR_TABLE_SERIES_FILE)),
        MOR_OK);
    for (int64_t row = 0; row < data.n_rows; ++row) {
        largest = fmax(largest, data.values[row * data.n_columns + 4]);
    }
    assert_int_equal(data.n_rows, 6); /* the start, four of 45 ms, the end */
    mor_table_data_clear(&folder->context, &data);
    return largest;
}

static void peak_between_rows_is_in_summary_and_table(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char remark[8];
    char shown[32];
    mor_summary_statistics it;
    /* v sqrt(k m) of a linear spring: a disc on a floor has k = pi/4 of its modulus over 1 - nu^2. */
    const double pi = 3.14159265358979;
    const double mass = 2400.0 * pi * 0.04;
    const double peak = sqrt(0.25 * pi * 1.0e7 / (1.0 - 0.25 * 0.25) * mass);
    char *text = run_hit(folder);
    assert_true(find_largest_in_rows(folder) < 0.5 * peak);
    finished_run_file(folder, path, "run", MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "force", &it, remark, sizeof remark), MOR_OK);
    assert_true(fabs(it.maximum / peak - 1.0) < 0.02);         /* sums over nodes */
    assert_true(fabs(it.time_of_maximum - 0.05942) < 0.0007);  /* a step */
    assert_true(fabs(it.impulse / (2.0 * mass) - 1.0) < 2e-3); /* restitution 1: error of the step */
    snprintf(shown, sizeof shown, " %.5g", it.maximum);
    assert_non_null(strstr(text, shown));
    snprintf(shown, sizeof shown, " %.5g", it.impulse);
    assert_non_null(strstr(text, shown));
    assert_non_null(strstr(text, "(1) maximum, minimum, mean and impulse are those from 0.1 s to 0.2 s"));
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, "late", &it, remark, sizeof remark), MOR_OK);
    assert_true(it.maximum == 0.0 && it.impulse == 0.0 && it.window[0] == 0.1 && it.window[1] == 0.2);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(peak_between_rows_is_in_summary_and_table, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
