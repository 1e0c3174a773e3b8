/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A block a little narrower than its cells has nodes a little less than a spacing from its edges. Their normals leaned
 * to the edge, so that they felt a floor a hundredth of a spacing early: a block laid on a slope was thrown up. */
#include "tests/common/program.h"

static const char *const slope_case =
    "dimension = 3; spacing = 0.2; gravity = (4.905, 0.0, -8.4957092); end = 0.2;\n"
    "domain = { min = (-2.0, -2.0, -1.0); max = (4.0, 2.0, 2.0); };\n"
    "bodies = ( { name = \"block\"; position = (0.0, 0.0, 0.5); material = { model = \"rigid\"; density = 2000.0; };\n"
    "  shape = { type = \"box\"; min = (-0.5, -0.5, -0.5); max = (0.5, 0.5, 0.5); }; } );\n"
    "walls = ( { name = \"slope\"; shape = { type = \"half_space\"; point = (0.0, 0.0, 0.0); normal = (0, 0, 1); }; } "
    ");\n"
    "contact = { friction_coefficient = 0.3; restitution = 0.5; };\n"
    "probes = ( { name = \"way\"; type = \"body_position\"; body = \"block\"; direction = (1, 0, 0); },\n"
    "  { name = \"height\"; type = \"body_position\"; body = \"block\"; direction = (0, 0, 1); },\n"
    "  { name = \"balance\"; type = \"bodies_energy_balance\"; } );\n"
    "expect = (\n"
    /* g (sin 30 - 0.3 cos 30) t^2 / 2, as cases/incline-block; the tolerance is that of tests/physics. */
    "  { probe = \"way\"; value = 0.0471256; tolerance = 0.01; },\n"
    /* It lies there from the start and settles by about a micrometer. */
    "  { probe = \"height\"; statistic = \"maximum\"; value = 0.5; tolerance = 1e-5; absolute = true; },\n"
    "  { probe = \"balance\"; value = 1.0; tolerance = 0.01; } );\n"
    "output = { pictures = false; snapshots = 1; };\n";

static void slide(run_folder *folder, const char *spacing)
{
    char path[MOR_PATH_BYTES];
    const char *const words[] = {"run", "case.cfg", "-o", spacing, "--set", spacing, "-t", "1", NULL};
    run_folder_store(run_folder_file(folder, path, "case.cfg"), slope_case, strlen(slope_case));
    program_outcome outcome = program_run(folder, words, 0); /* 3: an expectation was missed */
    assert_null(strstr(outcome.output, "NO"));               /* as its table says */
    program_clear(&outcome);
}

static void a_block_of_whole_spacings_lies_where_it_was_laid(void **state)
{
    slide(*state, "spacing=0.2");
}

static void a_block_a_little_narrower_than_its_cells_lies_where_it_was_laid(void **state)
{
    slide(*state, "spacing=0.17");   /* nodes 0.94 spacings from the edges */
    slide(*state, "spacing=0.145");  /* 0.95 */
    slide(*state, "spacing=0.1675"); /* 0.985 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_block_of_whole_spacings_lies_where_it_was_laid, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_block_a_little_narrower_than_its_cells_lies_where_it_was_laid,
                                        run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
