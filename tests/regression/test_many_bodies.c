/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* 4096 bodies were promised, but a case that listed 1200 was refused for having more than 10000 settings. */
#include "tests/common/program.h"
#include "tests/common/sanitized.h"

enum { TEXT_BYTES = 1 << 20, COLUMNS = 64 };

/* A grid of discs of five spacings. */
static void place_case(run_folder *folder, int n_bodies)
{
    char path[MOR_PATH_BYTES];
    char *text = calloc(TEXT_BYTES, 1);
    assert_non_null(text);
    int n = snprintf(text, TEXT_BYTES,
                     "title = \"discs\"; dimension = 2; spacing = 0.02; gravity = (0.0, -9.81); end = 0.001;\n"
                     "domain = { min = (-1.0, -1.0); max = (9.0, 9.0); };\nbodies = (");
    for (int k = 0; k < n_bodies; ++k) {
        n += snprintf(
            text + n, TEXT_BYTES - (size_t)n,
            "%s\n  { name = \"b%d\"; position = (%g, %g); material = { model = \"rigid\"; density = 2600.0; };\n"
            "    shape = { type = \"sphere\"; center = (0.0, 0.0); radius = 0.05; }; friction = \"smooth\"; }",
            k > 0 ? "," : "", k, 0.12 * (k % COLUMNS), 0.12 * (k / COLUMNS));
    }
    n += snprintf(text + n, TEXT_BYTES - (size_t)n, " );\noutput = { pictures = false; snapshots = 1; };\n");
    assert_true(n < TEXT_BYTES);
    run_folder_store(run_folder_file(folder, path, "case.cfg"), text, (size_t)n);
    free(text);
}

static void twelve_hundred_listed_bodies_run(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"run", "case.cfg", "-o", "run", "--set", "end=2e-5", NULL};
    place_case(folder, 1200);
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "particles");
    program_clear(&outcome);
    /* What was resolved is far longer than what was written, and is read again. */
    const char *const again[] = {"check", "run/case.resolved.cfg", NULL};
    outcome = program_run(folder, again, 0);
    program_expect_text(outcome.output, "1200 bodies");
    program_clear(&outcome);
}

static void as_many_listed_bodies_as_are_promised_are_read(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"check", "case.cfg", NULL};
    if (TEST_IS_SANITIZED) {
        skip(); /* the same with fewer is above */
    }
    place_case(folder, 4096);
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "4096 bodies");
    program_clear(&outcome);
    place_case(folder, 4097);
    outcome = program_run(folder, words, 2);
    program_expect_text(outcome.errors, "4096");
    program_clear(&outcome);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(twelve_hundred_listed_bodies_run, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(as_many_listed_bodies_as_are_promised_are_read, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
