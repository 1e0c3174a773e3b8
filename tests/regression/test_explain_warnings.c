/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* `moraine explain` warns of scenes that can be built but will not do what their author wants. */
#include "tests/common/program.h"

#define COLUMN MOR_SOURCE_DIR "/cases/column-at-rest/case.cfg"
#define MOVED "--set", "placement.angle=30 deg", "--set", "placement.move=(\"0.3 m\", \"0.2 m\", \"0 m\")"

enum { ARGUMENTS = 12 };

/* A column 0.4 m wide between two walls, in cells of a spacing; warning NULL: none. */
static const struct {
    const char *arguments[ARGUMENTS];
    const char *warning;
} explanations[] = {
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", NULL}, NULL},
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", MOVED, NULL}, NULL},
    /* 13 cells of 30 mm: the last center is 25 mm off the right wall. */
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=30 mm", NULL}, "0.83 spacings off wall 'right', not 0.5"},
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=30 mm", MOVED, NULL}, "0.83 spacings off wall 'right', not 0.5"},
    /* The lattice begins 9 mm above the floor, so the lowest center is 19 mm above it; or 12 mm, so it is 2 mm. */
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", "-s", "lattice.origin=(\"0 m\", \"9 mm\", \"0 m\")", NULL},
     "0.95 spacings off wall 'floor', not 0.5"},
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", "-s", "lattice.origin=(\"0 m\", \"12 mm\", \"0 m\")", NULL},
     "0.10 spacings off wall 'floor', not 0.5"},
    /* More than a spacing away is not meant to touch. */
    {{"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", "-s", "walls[2].shape.point=(\"0.44 m\", \"0 m\", \"0 m\")",
      NULL},
     NULL},
};

enum { N_EXPLANATIONS = sizeof explanations / sizeof *explanations };

static void soil_off_a_wall_is_warned_of(void **state)
{
    run_folder *folder = *state;
    for (int k = 0; k < N_EXPLANATIONS; ++k) {
        program_outcome outcome = program_run(folder, explanations[k].arguments, 0);
        if (explanations[k].warning != NULL) {
            program_expect_text(outcome.output, explanations[k].warning);
        } else if (strstr(outcome.output, "warning") != NULL) {
            fail_msg("scene %d is good and was warned of: %s", k, outcome.output);
        }
        program_clear(&outcome);
    }
}

static void ground_and_the_clocks_of_touching_bodies_are_told(void **state)
{
    run_folder *folder = *state;
    static const char *const arguments[] = {"explain", MOR_SOURCE_DIR "/cases/terrain-drop/case.cfg", "-t", "1", NULL};
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output,
                        "ground 'ground': 30 x 48 nodes of 10 m, x 5 to 295 m, y 5 to 475 m, z 100 to 195 m; "
                        "subtracted (0, 0, 0) m; no reference system named, meters assumed");
    program_expect_text(outcome.output, "1 sub-step per step now, up to about ");
    program_expect_text(outcome.output, "with the steps of bodies that touch");
    program_clear(&outcome);
}

/* One body, so one word for it. */
static void one_body_is_counted_in_the_singular(void **state)
{
    run_folder *folder = *state;
    static const char *const arguments[] = {"check", MOR_SOURCE_DIR "/cases/crater/case.cfg", "-s", "spacing=6 mm",
                                            NULL};
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "1 body of ");
    program_clear(&outcome);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(soil_off_a_wall_is_warned_of, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(ground_and_the_clocks_of_touching_bodies_are_told, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(one_body_is_counted_in_the_singular, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
