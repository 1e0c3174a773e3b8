/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a sweep says of mistakes in its file. */
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

#define RUN_OUT "results = ( { probe = 'run_out'; } ); "
#define SMALL "case = 'case.cfg'; set = ( 'spacing=15 mm', 'end=40 ms' ); "

/* Stores the case of finished runs and a sweep of it; ' stands for ". */
static void store_sweep(run_folder *folder, const char *source)
{
    char path[MOR_PATH_BYTES];
    char other[MOR_PATH_BYTES];
    finished_run_store_text(folder, source, path);
    assert_int_equal(rename(path, run_folder_file(folder, other, "sweep.cfg")), 0);
    finished_run_store_case(folder, path);
}

/* Each row: what varies, and the message due, NULL: none. */
static void mistakes_are_told_once_and_with_their_place(void **state)
{
    static const char *const rows[][2] = {
        {"name = 'c'; key = 'soil[0].material.cohesn'; values = ( '1 kPa', '2 kPa', '3 kPa' );",
         "member 1 and 2 more: sweep.cfg:1: variable 'c': override 'soil[0].material.cohesn=1 kPa': found the unknown "
         "name 'cohesn'"},
        {"name = 'phi'; key = 'soil[0].material.friction_angle'; from = '10 deg'; to = '30 deg'; step = '5 deg';",
         NULL},
        {"name = 'phi'; key = 'soil[0].material.friction_angle'; from = '10 deg'; to = '30 deg'; step = '7 deg';",
         "found the range from 10 to 30 by 7 of 'soil[0].material.friction_angle', whose steps end at 24 and miss "
         "'to'"},
        {"name = 'x'; key = 'soil[0].material.dilation_angle'; from = 0.1; to = 0.3; step = 0.1;",
         NULL}, /* decimal fractions reach their ends */
        {"name = 'phi'; key = 'soil[0].material.friction_angle'; distribution = 'normal'; mean = '30 deg'; deviation = "
         "'0 deg';",
         "found a distribution of 'phi' with mean 30, deviation 0 in deg, whose deviation is not "
         "above zero"},
        {"name = 'c'; key = 'soil[0].material.cohesion'; replicates = true; values = ( '1 kPa', '2 kPa', '1000 Pa' );",
         "found members 1 and 3 with one and the same case"},
        {"name = 'c'; key = 'soil[0].material.cohesion'; values = ( '1 kPa', '1000 Pa' );", NULL}, /* told apart */
        {"name = 'seed'; key = 'seed'; replicates = true; values = ( 3000000000L, 3000000001L );", NULL},
        {"name = 'seed'; key = 'seed'; from = 20261128000001L; to = 20261128000003L;", NULL},
    };
    run_folder *folder = *state;
    const char *const arguments[] = {"sweep", "sweep.cfg", "--plan", NULL};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        char text[2048];
        snprintf(text, sizeof text, SMALL RUN_OUT "vary = ( { %s } );", rows[k][0]);
        store_sweep(folder, text);
        program_outcome outcome = program_run(folder, arguments, rows[k][1] != NULL ? 2 : 0);
        if (rows[k][1] != NULL) {
            program_expect_text(outcome.errors, rows[k][1]);
            assert_null(strstr(outcome.errors, "member 2:"));
        }
        program_clear(&outcome);
    }
}

/* A case given to sweep and a sweep given to run are told what they are. */
static void cases_and_sweeps_are_told_apart(void **state)
{
    run_folder *folder = *state;
    store_sweep(folder, SMALL RUN_OUT "vary = ( { name = 'x'; key = 'end'; values = ( 0.1 ); } );");
    program_outcome outcome = program_run(folder, (const char *[]){"check", "sweep.cfg", NULL}, 2);
    program_expect_text(outcome.errors, "found 'vary', which a sweep file has; allowed: a case; run it as a sweep");
    program_clear(&outcome);
    outcome = program_run(folder, (const char *[]){"sweep", "case.cfg", "--plan", NULL}, 2);
    program_expect_text(outcome.errors, "found 'domain', which a case has; allowed: a sweep file");
    program_clear(&outcome);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(mistakes_are_told_once_and_with_their_place),
        WITH_FOLDER(cases_and_sweeps_are_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
