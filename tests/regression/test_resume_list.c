/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/program.h"

/* Rocks of a table run with their pictures, and go on only with the table that they began with. */

static const char text[] =
    "title = \"rocks of a table\"; dimension = 2; spacing = 0.1; end = 0.02; gravity = (0.0, -9.81);\n"
    "domain = { min = (-3.0, -1.0); max = (5.0, 3.0); };\n"
    "rocks = ( { name = \"b\"; list = \"b.csv\"; material = { model = \"rigid\"; density = 2500.0; };\n"
    "  forms = ( { type = \"sphere\"; }, { type = \"ellipsoid\"; elongation = 0.7; } ); } );\n"
    "probes = ( { name = \"energy\"; type = \"bodies_kinetic_energy\"; } ); output = { snapshots = 1; };\n";

static void store(run_folder *folder, const char *name, const char *content)
{
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, name), content, strlen(content));
}

static void a_changed_table_is_noticed(void **state)
{
    run_folder *folder = *state;
    static const char table[] = "x,y,diameter [cm]\n0,0.5,60\n1.5,0.5,80\n";
    const char *const start[] = {"run", "case.cfg", "-o", "run", "--stop-at", "0.005", NULL};
    const char *const again[] = {"run", "case.cfg", "-o", "run", "--resume", NULL};
    store(folder, "case.cfg", text);
    store(folder, "b.csv", table);
    program_outcome outcome = program_run(folder, start, 0);
    program_clear(&outcome);
    store(folder, "b.csv", "x,y,diameter [cm]\n0,0.5,60\n1.5,0.5,81\n");
    outcome = program_run(folder, again, 2);
    program_expect_text(outcome.errors, "the file has changed since");
    program_clear(&outcome);
    store(folder, "b.csv", table);
    outcome = program_run(folder, again, 0);
    program_expect_text(outcome.output, "picture: ");
    assert_null(strstr(outcome.errors, "needs arrays")); /* a chart of a curve that a table does not have */
    program_clear(&outcome);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_changed_table_is_noticed, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
