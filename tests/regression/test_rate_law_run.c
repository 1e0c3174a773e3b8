/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/program.h"
#include "tests/common/session_run.h"
#include "tests/common/template.h"

#include <math.h>
#include <stdio.h>

/* A run of a law whose rates are integrated: its bits and its counts of sub-steps depend on no thread and no stop. */

#define CASE_OF(plugins, law)                                                                                          \
    "title = 'sand'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');" plugins          \
    "end = '10 ms'; domain = { min = ('-0.1 m', '-0.05 m', '-1 m'); max = ('0.4 m', '0.3 m', '1 m'); };"               \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.15 m', '0.12 m'); };"           \
    "  material = { density = '1600 kg/m3'; " law " }; } );"                                                           \
    "walls = ( { name = 'floor'; friction = 'rough';"                                                                  \
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"                    \
    "probes = ( { type = 'run_out'; }, { type = 'height'; }, { type = 'kinetic_energy'; } );"                          \
    "output = { snapshots = 6; pictures = false; checkpoint_seconds = 0.02; };"

static const char sand_case[] =
    CASE_OF("", "model = 'hypoplastic_sand'; critical_friction_angle = '30 deg'; granulate_hardness = '2.6 GPa';"
                "exponent = 0.27; densest_void_ratio = 0.61; critical_void_ratio = 0.98; loosest_void_ratio = 1.1;"
                "alpha = 0.18; beta = 1.1; void_ratio = 0.75; wave_pressure = '5 kPa';");

/* %s: the plug-in. */
static const char creep_case[] =
    CASE_OF("plugins = ( '%s' );", "model = 'viscoplastic_soil'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
                                   "friction_angle = '25 deg'; cohesion = '0.05 kPa'; viscosity = '10 Pa s';");

static void run_case(run_folder *folder, const char *case_path, const char *name, double stop_at, bool is_resume,
                     int n_threads)
{
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

/* Snapshots, state and counts are those of the whole run. */
static void compare(run_folder *folder, const char *other)
{
    char whole[256];
    char counts[256];
    finished_run_compare(folder, "whole", other);
    read_counts(folder, "whole", whole);
    read_counts(folder, other, counts);
    assert_string_equal(counts, whole); /* exact: whole numbers */
}

static void try_threads_stops_and_kills(run_folder *folder, const char *text)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    run_case(folder, case_path, "whole", NAN, false, 1);
    run_case(folder, case_path, "stopped", 0.004, false, 2);
    run_case(folder, case_path, "stopped", NAN, true, 3);
    compare(folder, "stopped");
    const char *const killed[] = {"run", case_path, "-t", "2", "-o", "killed", "--resume", NULL};
    int n_killed = 0;
    for (int k = 0; k < 3; ++k) {
        n_killed += program_kill_after(folder, killed, 0.1 + 0.05 * k);
    }
    assert_true(n_killed >= 1);
    run_case(folder, case_path, "killed", NAN, true, 1);
    compare(folder, "killed");
}

static void sand_has_the_same_bits_by_any_threads_stops_and_kills(void **state)
{
    try_threads_stops_and_kills(*state, sand_case);
}

static void template_of_rates_has_the_same_bits_by_any_threads_stops_and_kills(void **state)
{
    run_folder *folder = *state;
    template_law it = {0};
    char path[MOR_PATH_BYTES];
    char text[sizeof creep_case + MOR_PATH_BYTES];
    template_open(&folder->context, MOR_SOURCE_DIR, "template_rates", "viscoplastic_soil", &it);
    snprintf(path, sizeof path, "%s/viscoplastic_soil.so", it.folder);
    snprintf(text, sizeof text, creep_case, path);
    try_threads_stops_and_kills(folder, text);
    template_close(&folder->context, &it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(sand_has_the_same_bits_by_any_threads_stops_and_kills, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(template_of_rates_has_the_same_bits_by_any_threads_stops_and_kills,
                                        run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
