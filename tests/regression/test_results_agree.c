/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/run_text.h"
#include "tests/common/session_run.h"

/* Results that tell the same thing in two ways agree. */

#define SAND(more)                                                                                                     \
    "  material = { model = 'mohr_coulomb'; density = '1900 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"   \
    "    friction_angle = '30 deg'; }; " more " } );"
#define FLOOR                                                                                                          \
    "{ name = 'floor'; friction = 'rough'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; }"

static void what_passes_an_open_face_is_what_left(void **state)
{
    run_folder *folder = *state;
    session_run_text(
        folder,
        "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '0.15 s';"
        "domain = { min = (-1, -1); max = (1, 3); outflow = 'remove'; };"
        "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 0.5); };" //
        SAND("velocity = (3, 0);") "walls = ( { name = 'floor'; friction = 'smooth';"
                                   "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
                                   "probes = ( { name = 'edge'; type = 'mass_passed'; origin = (1, 0); direction = (1, "
                                   "0); },"
                                   "  { name = 'before'; type = 'mass_passed'; origin = (0.97, 0); direction = (1, 0); "
                                   "},"
                                   "  { name = 'volume'; type = 'volume_beyond'; origin = (0.97, 0); direction = (1, "
                                   "0); },"
                                   "  { name = 'left'; type = 'outflow_mass'; }, { name = 'total'; type = "
                                   "'total_energy'; },"
                                   "  { name = 'low'; type = 'total_energy'; origin = (0, -10); },"
                                   "  { name = 'share'; type = 'energy_left'; },"
                                   "  { name = 'low_share'; type = 'energy_left'; origin = (0, -10); } );"
                                   "output = { snapshots = 2; pictures = false; };",
        "run");
    const double left = finished_run_read_value(folder, "run", "left", -1);
    assert_true(left > 300.0); /* of 950 kg/m, 0.45 m wide */
    assert_near(finished_run_read_value(folder, "run", "edge", -1), left, 1e-9 * left);
    /* 30 mm before the face have passed those that left, but for the one column that began there, and those between. */
    const double between = 1900.0 * finished_run_read_value(folder, "run", "volume", -1);
    const double column = 1900.0 * 0.05 * 0.5;
    assert_near(finished_run_read_value(folder, "run", "before", -1), left + between - column, 0.02 * left);
    /* What is left of the energy is its ratio to that of the start, about any origin. */
    for (int k = 0; k < 2; ++k) {
        const char *total = k == 0 ? "total" : "low";
        const double ratio =
            finished_run_read_value(folder, "run", total, -1) / finished_run_read_value(folder, "run", total, 0);
        assert_near(finished_run_read_value(folder, "run", k == 0 ? "share" : "low_share", -1), ratio, 1e-9);
    }
}

/* A floor bears the weight of the sand; a gauge that looks up sees it with the wrong sign. */
static void a_gauge_against_the_load_is_told_to_be_reversed(void **state)
{
    static const char *const looks[] = {"(0, -1)", "(0, 1)"};
    run_folder *folder = *state;
    for (int k = 0; k < 2; ++k) {
        char text[2048];
        snprintf(text, sizeof text,
                 "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '20 ms';"
                 "domain = { min = (-1, -1); max = (2, 2); };"
                 "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 0.5); };" //
                 SAND("initial_stress = { type = 'k0'; };") "walls = ( " FLOOR " );"
                                                            "gauges = ( { name = 'floor'; wall = 'floor'; direction = "
                                                            "%s; } );"
                                                            "output = { snapshots = 2; pictures = false; };",
                 looks[k]);
        program_outcome outcome = run_text(folder, text, k == 0 ? "down" : "up", as_it_is, 0);
        assert_true((strstr(outcome.errors, "acts against its direction") != NULL) == (k == 1));
        program_clear(&outcome);
    }
}

static void the_impulse_on_a_gate_is_that_of_its_gauge_and_no_gap_is_left_of_it(void **state)
{
    run_folder *folder = *state;
    session_run_text(
        folder,
        "dimension = 2; spacing = '20 mm'; gravity = (0, -9.81); end = '0.2 s';"
        "domain = { min = (-0.1, -0.1); max = (2, 0.6); };"
        "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.4, 0.3); };" //
        SAND("initial_stress = { type = 'k0'; };") "walls = ( " FLOOR ","
                                                   "  { name = 'back'; friction = 'smooth';"
                                                   "    shape = { type = 'half_space'; point = (0, 0); normal = (1, "
                                                   "0); }; },"
                                                   "  { name = 'gate'; friction = 'smooth'; removed_at = '0.1 s';"
                                                   "    shape = { type = 'box'; min = (0.4, 0); max = (0.46, 0.5); }; "
                                                   "} );"
                                                   "gauges = ( { name = 'gate'; wall = 'gate'; direction = (1, 0); "
                                                   "filter = '0.05 s'; } );"
                                                   "probes = ( { name = 'gap'; type = 'wall_gap'; wall = 'gate'; },"
                                                   "  { name = 'gauge'; type = 'gauge_normal'; gauge = 'gate'; },"
                                                   "  { name = 'soil'; type = 'gauge_normal_soil'; gauge = 'gate'; },"
                                                   "  { name = 'wall'; type = 'wall_force'; wall = 'gate'; direction = "
                                                   "(1, 0); } );"
                                                   "output = { snapshots = 2; pictures = false; };",
        "run");
    const double impulse = read_impulse(folder, "run", "wall");
    assert_true(impulse > 10.0); /* N s/m: 0.1 s of some 300 N/m */
    assert_near(read_impulse(folder, "run", "gauge"), impulse, 1e-9 * impulse);
    assert_near(read_impulse(folder, "run", "soil"), impulse, 1e-9 * impulse);
    assert_true(isfinite(finished_run_read_value(folder, "run", "gap", 0)));
    assert_true(isnan(finished_run_read_value(folder, "run", "gap", -1)));
    /* What was measured while it was there stays: nothing lies inside the gate by half a spacing. */
    assert_true(read_statistics(folder, "run", "gap").minimum > -0.01);
}

/* A box that collapses to both sides: from either end of its top the lines to the fronts descend alike. */
static void the_angle_of_reach_is_that_of_the_mirror_image(void **state)
{
    run_folder *folder = *state;
    session_run_text(folder,
                     "dimension = 2; spacing = '0.1 m'; gravity = (0, -9.81); end = '0.6 s';"
                     "domain = { min = (-5, -1); max = (5, 4); };"
                     "soil = ( { name = 'sand'; shape = { type = 'box'; min = (-1, 0); max = (1, 2); };" //
                     SAND("") "walls = ( " FLOOR " );"
                              "probes = ( { name = 'right'; type = 'angle_of_reach'; direction = (1, 0); },"
                              "  { name = 'left'; type = 'angle_of_reach'; direction = (-1, 0); },"
                              "  { name = 'front'; type = 'run_out'; direction = (1, 0); } );"
                              "output = { snapshots = 2; pictures = false; };",
                     "run");
    const double front = finished_run_read_value(folder, "run", "front", -1);
    const double right = finished_run_read_value(folder, "run", "right", -1);
    assert_true(front > 1.2);
    /* From the rear end of the top, half a spacing inside of it; the foot of the front is thinner than 0.3 m. */
    const double along = front + 0.95;
    assert_near(tan(right), 1.85 / along, 0.2 / along);
    assert_near(finished_run_read_value(folder, "run", "left", -1), right, 1e-3);
}

/* Four grains of two thousand lie far beyond and below the front: a straight line from the top to the front is at
 * atan(2 / 10), to the waves of 20 ms. */
static void grains_beyond_the_front_do_not_steepen_the_angle_of_reach(void **state)
{
    run_folder *folder = *state;
    session_run_text(
        folder,
        "dimension = 2; spacing = '0.1 m'; gravity = (0, -9.81); end = '20 ms';"
        "domain = { min = (-5, -40); max = (80, 10); };"
        "soil = ( { name = 'sand'; shape = { type = 'union'; parts = ("
        "  { type = 'box'; min = (0, 0); max = (10, 2); },"
        "  { type = 'box'; min = (60, -30); max = (60.2, -29.8); } ); };" SAND(
            "") "probes = ( { name = 'angle'; type = 'angle_of_reach'; }, { name = 'run_out'; type = 'run_out'; } "
                ");"
                "output = { snapshots = 2; pictures = false; };",
        "run");
    assert_near(finished_run_read_value(folder, "run", "angle", 0), atan2(2.0, 10.0), 0.01);
    assert_near(finished_run_read_value(folder, "run", "angle", -1), atan2(2.0, 10.0), 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_passes_an_open_face_is_what_left, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_gauge_against_the_load_is_told_to_be_reversed, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_impulse_on_a_gate_is_that_of_its_gauge_and_no_gap_is_left_of_it,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_angle_of_reach_is_that_of_the_mirror_image, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(grains_beyond_the_front_do_not_steepen_the_angle_of_reach, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
