/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* `moraine explain` warns of scenes that can be built but will not do what their author wants. */
#include "tests/common/program.h"

#define COLUMN MOR_SOURCE_DIR "/cases/column-at-rest/case.cfg"
#define MOVED "--set", "placement.angle=30 deg", "--set", "placement.translation=(\"0.3 m\", \"0.2 m\", \"0 m\")"

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
            assert_null(strstr(strstr(outcome.output, "\nwarning: "), "\n  ")); /* they stand last */
        } else if (strstr(outcome.output, "warning") != NULL) {
            fail_msg("scene %d is good and was warned of: %s", k, outcome.output);
        }
        program_clear(&outcome);
    }
}

/* A unit that was forgotten, and a plate on which contact would meet the other side. */
static void forgotten_units_and_thin_walls_are_warned_of(void **state)
{
    static const char block[] = MOR_SOURCE_DIR "/cases/incline-block/case.cfg";
    static const char *const plates[] = {
        "walls[0].shape={type=\"box\"; min=(\"-1 m\", \"-0.08 m\"); max=(\"4 m\", \"0 m\");}",
        "walls[0].shape={type=\"box\"; min=(\"-1 m\", \"-0.15 m\"); max=(\"4 m\", \"0 m\");}",
        "walls[0].shape={type=\"union\"; parts=({type=\"box\"; min=(\"-1 m\", \"-1 m\"); max=(\"1 m\", \"0 m\");},"
        "{type=\"box\"; min=(\"2 m\", \"-1 m\"); max=(\"2.12 m\", \"0 m\");});}"};
#define INCLINE "{name=\"incline\"; shape={type=\"box\"; min=(\"-1 m\", \"-1 m\"); max=(\"1 m\", \"0 m\");};}"
    static const char *const flush[] = {
        "walls=(" INCLINE ",{name=\"step\"; shape={type=\"box\"; min=(\"1 m\", \"-1 m\"); max=(\"4 m\", \"0 m\");}; "
        "contact_modulus=\"1 GPa\";})",
        "walls=(" INCLINE ",{name=\"step\"; shape={type=\"box\"; min=(\"1 m\", \"-1 m\"); max=(\"4 m\", \"0 m\");};})",
        "walls=(" INCLINE ",{name=\"step\"; shape={type=\"box\"; min=(\"1 m\", \"-1 m\"); max=(\"4 m\", \"1 m\");};})",
        /* Their bottoms, which make one face, lie in the domain. */
        "walls=({name=\"incline\"; shape={type=\"box\"; min=(\"-1 m\", \"-0.5 m\"); max=(\"1 m\", \"0 m\");};},"
        "{name=\"step\"; shape={type=\"box\"; min=(\"1 m\", \"-0.5 m\"); max=(\"4 m\", \"1 m\");};})"};
#undef INCLINE
    const struct {
        const char *path, *setting, *warning;
    } rows[] = {
        /* the shipped soil has 25 degrees and no cohesion: Rankine's limits are 0.406 and 2.46 */
        {COLUMN, "soil[0].initial_stress.lateral_ratio=4.3", "begins with a lateral stress of 4.3 of the vertical one"},
        {COLUMN, "soil[0].initial_stress.lateral_ratio=0.05", "begins with a lateral stress of 0.05 of the vertical"},
        {COLUMN, "soil[0].material.density=2.1", "soil 'soil' has a density of 2.1 kg/m3, which is not that of a soil"},
        {block, "bodies[0].material.density=2.6",
         "body 'block' has a density of 2.6 kg/m3, which is not that of a body"},
        {block, "bodies[0].material.density=20 kg/m3", NULL},
        {block, "bodies[0].contact_modulus=50", "body 'block' has a contact_modulus of 50 Pa, softer than any rock"},
        {block, "walls[0].contact_modulus=30", "wall 'incline' has a contact_modulus of 30 Pa, softer than any"},
        {block, "walls[0].contact_modulus=30 MPa", NULL},
        {block, "gravity=(\"4.9 m/s2\", \"8.5 m/s2\", 0)", "gravity points up, along +y"},
        {block, plates[0], "wall 'incline' is 0.08 m thick, 0.8 spacings, at ("},
        {block, plates[1], NULL},
        {block, plates[2], "wall 'incline' is 0.12 m thick, 1.2 spacings, at ("},
        {block, flush[0], "wall 'step' continues in wall 'incline' at ("},
        {block, flush[1], NULL},
        {block, flush[2], NULL},
        {block, flush[3], "but forms an inner corner with it elsewhere"},
    };
    run_folder *folder = *state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        program_outcome outcome =
            program_run(folder, (const char *[]){"explain", rows[k].path, "-t", "1", "-s", rows[k].setting, NULL}, 0);
        if (rows[k].warning != NULL) {
            program_expect_text(outcome.output, rows[k].warning);
        } else {
            assert_null(strstr(outcome.output, "warning"));
        }
        program_clear(&outcome);
    }
}

/* 50 particles of 20 mm stand on each other, so H = 1 m, and rho g H = 2100 * 9.81 * 1 Pa = 20.6 kPa, which is 1 % of
 * 2.06 MPa and 1.98 % of 1.04 MPa. */
static void soil_too_soft_for_its_weight_is_warned_of(void **state)
{
    static const char *const commands[] = {"check", "explain"};
    static const struct {
        const char *setting;
        const char *warning;
    } soils[] = {
        {"soil[0].material.youngs_modulus=1.04 MPa", NULL},
        {"soil[0].material.youngs_modulus=0.75 MPa", "by about 2.75 % (rho g H / E); below 1 % is advisable: raise "
                                                     "youngs_modulus to 2.06 MPa or more"},
        {"soil[0].material.youngs_modulus=5", "by about 4.12e+05 % (rho g H / E)"}, /* 5 MPa were meant */
        {"gravity=(0.0, 0.0, 0.0)", NULL},
    };
    run_folder *folder = *state;
    for (size_t k = 0; k < 2 * sizeof soils / sizeof *soils; ++k) {
        const char *const arguments[] = {commands[k % 2],
                                         COLUMN,
                                         "-t",
                                         "1",
                                         "-s",
                                         "spacing=20 mm",
                                         "-s",
                                         "soil[0].initial_stress={type=\"none\";}",
                                         "-s",
                                         soils[k / 2].setting,
                                         MOVED,
                                         NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        if (soils[k / 2].warning != NULL) {
            program_expect_text(outcome.output, soils[k / 2].warning);
        } else {
            assert_null(strstr(outcome.output, "so soft"));
        }
        assert_string_equal(outcome.errors, "");
        program_clear(&outcome);
    }
}

/* To explain a scene is not to run it: its first steps may fail, and nothing is said of checkpoints. */
static void scene_that_cannot_take_a_step_is_explained(void **state)
{
    run_folder *folder = *state;
    static const char *const arguments[] = {"explain", COLUMN,
                                            "-t",      "1",
                                            "-s",      "spacing=20 mm",
                                            "-s",      "soil[0].initial_stress={type=\"none\";}",
                                            "-s",      "gravity=(0, -1e8, 0)",
                                            NULL};
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "warning: a run would stop within its first steps: particle");
    program_expect_text(outcome.output, "speeds must stay below that of sound");
    program_expect_text(outcome.output, "bytes per soil particle");
    assert_null(strstr(outcome.output, "checkpoint"));
    program_clear(&outcome);
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

/* Each soil in a row, also where there is one; surfaces that are alike share a row. */
static void soils_and_their_friction_are_listed(void **state)
{
    run_folder *folder = *state;
    static const char *const layers[] = {
        "explain", MOR_SOURCE_DIR "/cases/layered-slope/case.cfg",        "-t", "1", "-s", "spacing=\"0.25 m\"",
        "-s",      "bodies[2].friction_with[0].friction_coefficient=0.2", NULL};
    static const char *const column[] = {"explain", COLUMN, "-t", "1", "-s", "spacing=20 mm", NULL};
    program_outcome outcome = program_run(folder, layers, 0);
    program_expect_text(
        outcome.output,
        "  soils                   model                  density [kg/m3]  wave speed [m/s]    particles\n"
        "    sand                  drucker_prager                    1900             93.66 ");
    /* c0 of Young's modulus 8 MPa and Poisson's ratio 0.4: sqrt(K/rho), K = 8 MPa/0.6 */
    program_expect_text(outcome.output,
                        "    clay                  drucker_prager                    1700             88.56 ");
    /* 3 tan(phi) / sqrt(9 + 12 tan^2(phi)) over sin(phi), of 36 and 8 degrees; at a thousandth of
     * Young's modulus, or 3 c cos(phi) / (1 - sin(phi)) */
    program_expect_text(
        outcome.output,
        "    sand                  strength in plane strain 0.947 times that of Mohr and Coulomb, at 20 kPa\n"
        "    clay                  strength in plane strain 0.997 times that of Mohr and Coulomb, at 10.4 kPa\n");
    program_expect_text(outcome.output, "  friction with           sand           clay\n"
                                        "    wall base             rough          rough\n"
                                        "    wall front and 1 more smooth         smooth\n"
                                        "    body upper and 1 more coulomb 0.4    coulomb 0.1\n"
                                        "    body lower            coulomb 0.4    coulomb 0.2\n");
    program_clear(&outcome);
    outcome = program_run(folder, column, 0);
    program_expect_text(outcome.output, "\n    soil                  drucker_prager ");
    program_expect_text(outcome.output, "\n  friction with           soil\n    wall floor ");
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
        cmocka_unit_test_setup_teardown(forgotten_units_and_thin_walls_are_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_too_soft_for_its_weight_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(scene_that_cannot_take_a_step_is_explained, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(ground_and_the_clocks_of_touching_bodies_are_told, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soils_and_their_friction_are_listed, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(one_body_is_counted_in_the_singular, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
