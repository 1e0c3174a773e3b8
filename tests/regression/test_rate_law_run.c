/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_run.h"

#include <math.h>
#include <stdio.h>

/* A run of a law whose rates are integrated: its bits and its counts of sub-steps depend on no thread and no stop. */

static const char sand_case[] =
    "title = 'sand'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');"
    "end = '30 ms'; domain = { min = ('-0.1 m', '-0.05 m', '-1 m'); max = ('0.4 m', '0.3 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.15 m', '0.12 m'); };"
    "  material = { model = 'hypoplastic_sand'; density = '1600 kg/m3'; critical_friction_angle = '30 deg';"
    "    granulate_hardness = '2.6 GPa'; exponent = 0.27; densest_void_ratio = 0.61; critical_void_ratio = 0.98;"
    "    loosest_void_ratio = 1.1; alpha = 0.18; beta = 1.1; void_ratio = 0.75; wave_pressure = '5 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"
    "probes = ( { type = 'run_out'; }, { type = 'height'; }, { type = 'kinetic_energy'; } );"
    "output = { snapshots = 6; pictures = false; };";

static void run_case(run_folder *folder, const char *name, double stop_at, bool is_resume, int n_threads)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, sand_case, case_path);
    const session_run run = {
        .case_path = case_path, .name = name, .stop_at = stop_at, .is_resume = is_resume, .n_threads = n_threads};
    assert_int_equal(session_run_do(folder, &run, name), isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
}

/* The text of the counts in summary.json, shape [256]. */
static void read_counts(run_folder *folder, const char *name, char *counts)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(finished_run_file(folder, path, name, MOR_SUMMARY_FILE), &n_bytes);
    assert_non_null(bytes);
    char *text = calloc(n_bytes + 1, 1);
    assert_non_null(text);
    memcpy(text, bytes, n_bytes);
    const char *start = strstr(text, "\"integration\"");
    assert_non_null(start);
    assert_non_null(strstr(start, "\"sub_steps\": "));
    snprintf(counts, 256, "%.*s", (int)strcspn(start, "}"), start);
    free(text);
    free(bytes);
}

static void threads_and_stops_change_neither_bits_nor_counts(void **state)
{
    run_folder *folder = *state;
    char whole[256];
    char stopped[256];
    run_case(folder, "whole", NAN, false, 1);
    run_case(folder, "stopped", 0.011, false, 2);
    run_case(folder, "stopped", NAN, true, 2);
    finished_run_compare(folder, "whole", "stopped");
    read_counts(folder, "whole", whole);
    read_counts(folder, "stopped", stopped);
    assert_string_equal(whole, stopped); /* exact: whole numbers */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(threads_and_stops_change_neither_bits_nor_counts, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
