/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/program.h"

#include <stdlib.h>

/* Rocks drawn, packed and relaxed, through the program: a run stopped and resumed, and one of the case as it was
 * resolved, give the series of the run that was never stopped, byte for byte. */

static const char text[] =
    "dimension = 2; spacing = 0.1; end = 0.02; gravity = (0, -10);\n"
    "domain = { min = (-1, -1); max = (6, 3); };\n"
    "soil = ( { name = \"soil\"; shape = { type = \"box\"; min = (0, 0); max = (4, 2); };\n"
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 5e6; poissons_ratio = 0.3;\n"
    "               friction_angle = 0.5; }; } );\n"
    "rocks = ( { name = \"rock\"; region = { type = \"box\"; min = (0, 0); max = (4, 2); }; content = 0.25; seed = 3;\n"
    "  sizes = ( { diameter = 0.6; passing = 0.0; }, { diameter = 1.0; passing = 1.0; } );\n"
    "  forms = ( { type = \"rock\"; elongation = 0.8; angularity = 0.5; } );\n"
    "  material = { model = \"saint_venant_kirchhoff\"; density = 2500; youngs_modulus = 2e7; poissons_ratio = 0.2; "
    "};\n"
    "} );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"box\"; min = (-1, -1); max = (6, 0); }; } );\n"
    "probes = ( { name = \"toe\"; type = \"toe\"; origin = (1, 1.5); direction = (1, 0); },\n"
    "  { name = \"none\"; type = \"toe\"; origin = (1, 2.9); direction = (1, 0); },\n"
    "  { name = \"turn\"; type = \"body_rotation_angle\"; body = \"rock_2\"; },\n"
    "  { name = \"energy\"; type = \"total_energy\"; } );\n"
    "output = { snapshots = 1; pictures = false; checkpoint_seconds = 1e6; };\n";

static void run_it(run_folder *folder, const char *case_path, const char *name, const char *option, const char *value)
{
    const char *const arguments[] = {"run", case_path, "-o", name, option, value, NULL};
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
}

/* The series of a run; zero-terminated, to be freed. */
static char *load_series(run_folder *folder, const char *name)
{
    char file[128];
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    snprintf(file, sizeof file, "%s/series.csv", name);
    char *series = (char *)run_folder_load(run_folder_file(folder, path, file), &n_bytes);
    assert_non_null(series);
    return series;
}

static void expect_same_series(run_folder *folder, const char *first, const char *second)
{
    char *one = load_series(folder, first);
    char *other = load_series(folder, second);
    assert_string_equal(one, other);
    free(one);
    free(other);
}

static void packed_rocks_resume_and_resolve_to_the_same_run(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    char resolved[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, case_path, "case.cfg"), text, sizeof text - 1);
    run_it(folder, case_path, "whole", NULL, NULL);
    run_it(folder, case_path, "stopped", "--stop-at", "0.01");
    run_it(folder, case_path, "stopped", "--resume", NULL);
    expect_same_series(folder, "whole", "stopped");
    run_folder_file(folder, resolved, "whole/case.resolved.cfg");
    run_it(folder, resolved, "again", NULL, NULL);
    expect_same_series(folder, "whole", "again");
}

static void toe_is_the_outermost_particle_above_its_origin(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    double time = NAN, step = NAN, length = NAN, ratio = NAN, toe = NAN, none = NAN;
    run_folder_store(run_folder_file(folder, case_path, "case.cfg"), text, sizeof text - 1);
    run_it(folder, case_path, "start", "--stop-at", "0");
    char *series = load_series(folder, "start");
    const char *row = strchr(series, '\n');
    assert_non_null(row);
    assert_int_equal(sscanf(row + 1, "%lf,%lf,%lf,%lf,%lf,%lf", &time, &step, &length, &ratio, &toe, &none), 6);
    assert_near(toe, 4.0 - 0.05 - 1.0, 1e-12); /* the last column of the lattice: rounding */
    assert_near(none, 0.0, 0.0);               /* nothing stands so high */
    free(series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(packed_rocks_resume_and_resolve_to_the_same_run, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(toe_is_the_outermost_particle_above_its_origin, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
