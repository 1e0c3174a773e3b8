/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that does not come to rest before the start: why, by how much, and what it looks like. */
#include "core/io/table.h"
#include "tests/common/finished_run.h"
#include "tests/common/near.h"
#include "tests/common/program.h"

/* A slope of 27 to 45 degrees, 2 m high, beside a smooth wall; ' stands for ". */
static const char slope[] =
    "title = 'slope'; dimension = 2; spacing = '0.1 m'; end = '0.1 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('8 m', '4 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'polygon'; points = (('0 m', '0 m'), ('5 m', '0 m'), ('4 m', '1 m'),"
    "    ('2 m', '2 m'), ('0 m', '2 m')); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; };"
    "  initial_stress = { type = 'settled'; settle_time = '1 s'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; } );"
    "numerics = { scheme = 'zhang2024'; stress_diffusion = 0; };"
    "probes = ( { type = 'run_out'; }, { type = 'wall_force'; wall = 'floor'; direction = (0, -1); } ); output = { "
    "pictures = false; snapshots = 1; };";

#define STRONG "-s", "soil[0].material.cohesion=20 kPa"
#define TIME "-s", "soil[0].initial_stress.settle_time="

static void expect_picture(run_folder *folder, const char *run, const char *name)
{
    static const unsigned char signature[4] = {0x89, 'P', 'N', 'G'};
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(finished_run_file(folder, path, run, name), &n_bytes);
    assert_non_null(bytes);
    assert_true(n_bytes > 10000); /* a picture with particles, axes and colors; an empty one has 2 kB */
    assert_memory_equal(bytes, signature, sizeof signature);
    free(bytes);
}

/* What came to rest presses on the floor at the start as it does afterwards: 7.5 m2 of 2000 kg/m3, whose edges are of
 * whole particles. */
static void expect_steady_force(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    mor_table_data rows;
    const double weight = 7.5 * 2000.0 * 9.81;
    finished_run_file(folder, path, run, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_data_read(&folder->context, &rows, path), MOR_OK);
    assert_true(rows.n_rows > 2);
    const double first = rows.values[rows.n_columns - 1];
    const double second = rows.values[2 * rows.n_columns - 1];
    assert_near(first, weight, 0.05 * weight);
    assert_near(second, first, 0.01 * weight); /* damping ends, next to nothing moves */
    mor_table_data_clear(&folder->context, &rows);
}

/* Friction of 25 degrees alone does not hold it: it flows, and goes on. */
static void slope_that_does_not_stand_is_told_and_drawn(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"run", path, "-t", "1", "-o", "mine", NULL};
    finished_run_store_text(folder, slope, path);
    program_outcome outcome = program_run(folder, arguments, 1);
    program_expect_text(outcome.errors, "the soil does not stand under its own weight: after settling for 1 s");
    program_expect_text(outcome.errors, "times the limit of 0.00432 m/s"); /* 1e-3 sqrt(9.81 * 1.9) */
    program_expect_text(outcome.errors, "A longer 'settle_time' does not help");
    program_expect_text(outcome.output, "picture: mine/images/settling-velocity.png");
    program_clear(&outcome);
    expect_picture(folder, "mine", "images/settling-velocity.png");
    expect_picture(folder, "mine", "images/settling-plastic-strain.png");
}

/* With cohesion it stands, and only the time was too short: with the time that is asked for it comes to rest. */
static void slope_that_needs_longer_is_told_how_long(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char setting[64] = "soil[0].initial_stress.settle_time=";
    const char *const hurried[] = {"run", path, "-t", "1", "-o", "mine", STRONG, TIME "0.3", NULL};
    finished_run_store_text(folder, slope, path);
    program_outcome outcome = program_run(folder, hurried, 1);
    program_expect_text(outcome.errors, "the soil needs longer to settle: after settling for 0.3 s");
    program_expect_text(outcome.errors, "and it decays by a factor of e every 0.1");
    const char *advice = strstr(outcome.errors, "Raise 'settle_time' to ");
    double time = 0.0;
    assert_non_null(advice);
    assert_int_equal(sscanf(advice, "Raise 'settle_time' to %lf s", &time), 1);
    assert_true(time > 0.3 && time < 1.0);
    snprintf(setting + strlen(setting), sizeof setting - strlen(setting), "%g", time);
    program_clear(&outcome);
    const char *const patient[] = {"run", path, "-t", "1", "-o", "other", STRONG, "-s", setting, NULL};
    outcome = program_run(folder, patient, 0);
    assert_null(strstr(outcome.errors, "settle"));
    program_clear(&outcome);
    expect_steady_force(folder, "other");
}

/* A slope that comes to rest elsewhere is not the one that was described. */
static void slope_that_moved_while_it_settled_is_warned_of(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {
        "run", path, "-t", "1", "-o", "mine", TIME "30", "-s", "soil[0].initial_stress.settle_speed_ratio=0.015", NULL};
    finished_run_store_text(folder, slope, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.errors,
                        "spacings) while its initial stress settled, so the run starts from a deformed shape");
    program_clear(&outcome);
}

/* Settling may take far longer than the run: its time has room on the clock. */
static void settling_far_longer_than_the_run_ends(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"run", path, "-t", "1", "-o", "mine", STRONG, TIME "1000", "-s", "end=1e-4", NULL};
    finished_run_store_text(folder, slope, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
    size_t n_bytes = 0;
    char *log = (char *)run_folder_load(finished_run_file(folder, path, "mine", "log.txt"), &n_bytes);
    program_expect_text(log, "initial stress converged after 0.4");
    free(log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(slope_that_does_not_stand_is_told_and_drawn, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(slope_that_needs_longer_is_told_how_long, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(slope_that_moved_while_it_settled_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(settling_far_longer_than_the_run_ends, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
