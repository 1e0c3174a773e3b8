/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/table.h"
#include "tests/common/near.h"
#include "tests/common/program.h"

/* The element test as a user types it: tables, summary, figure, measured values, and what is refused. */

enum { ARGUMENTS = 24 };

#define COLUMN MOR_SOURCE_DIR "/cases/column-2d/case.cfg"
#define LAYERS MOR_SOURCE_DIR "/cases/layered-slope/case.cfg"

#define SOIL                                                                                                           \
    "-s", "youngs_modulus=10 MPa", "-s", "poissons_ratio=0.3", "-s", "friction_angle=30 deg", "-s", "cohesion=20 kPa"

static int find_column(const mor_table_data *data, const char *heading)
{
    int column = 0;
    for (const char *at = data->header; at != NULL; at = strchr(at, ','), ++column) {
        at += *at == ',';
        if (strncmp(at, heading, strlen(heading)) == 0 && strchr(",", at[strlen(heading)]) != NULL) {
            return column;
        }
    }
    fail_msg("found no column '%s' in '%s'", heading, data->header);
    return -1;
}

static double last_value(const mor_table_data *data, const char *heading)
{
    return data->values[(data->n_rows - 1) * data->n_columns + find_column(data, heading)];
}

static void expect_picture(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(run_folder_file(folder, path, name), &n_bytes);
    assert_non_null(bytes);
    assert_true(n_bytes > 10000); /* four charts, not an empty sheet */
    assert_memory_equal(bytes, "\x89PNG", 4);
    free(bytes);
}

/* The reference values of a cone of 30 deg and 20 kPa at 100 kPa; the other specimens by the same formula. */
static void several_specimens_fail_at_their_strength(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"material", "drucker_prager",
                                 "--path",   "triaxial-compression",
                                 "--stress", "50 kPa, 100 kPa,200 kPa",
                                 "--strain", "5 %",
                                 "-o",       "out",
                                 "-s",       "test.steps=100",
                                 "-s",       "test.void_ratio=0.7",
                                 SOIL,       NULL};
    const double alpha = 0.160128154; /* tan(30 deg) / sqrt(9 + 12 tan(30 deg)^2) */
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "specimen of 200 kPa, 100 updates");
    program_expect_text(outcome.output, "peak q     q 155.024 kPa, p 151.675 kPa");
    program_expect_text(outcome.output, "mobilized friction 25.89 deg"); /* asin(155.024 / (2 * 100 + 155.024)) */
    for (int k = 0; k < 3; ++k) {
        char name[64];
        char path[MOR_PATH_BYTES];
        mor_table_data data;
        const double lateral = 50e3 * (1 << k);
        snprintf(name, sizeof name, "out/specimen-%d.csv", k + 1);
        run_folder_file(folder, path, name);
        assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
        assert_int_equal(data.n_rows, 101);
        const double q = sqrt(3.0) * (16641.006 + 3.0 * alpha * lateral) / (1.0 - sqrt(3.0) * alpha);
        assert_near(last_value(&data, "q [Pa]"), q, 1e-6 * q); /* digits of the constants */
        assert_near(last_value(&data, "stress_xx [Pa]"), -lateral, 1e-9 * 3.0 * lateral + 1e-3); /* solver */
        assert_near(last_value(&data, "axial_strain [1]"), 0.05, 1e-12);
        const double eps_v = last_value(&data, "eps_v [1]");
        assert_near(last_value(&data, "void_ratio [1]"), 1.7 * exp(-eps_v) - 1.0, 1e-14);
        assert_true(last_value(&data, "state.plastic_strain [1]") > 0.02);
        mor_table_data_clear(&folder->context, &data);
    }
    expect_picture(folder, "out/element.png");
    program_clear(&outcome);
}

/* Of more specimens than now; what a test did not write stays. */
static void tables_of_an_earlier_test_are_removed(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *words[] = {"material", "drucker_prager",      "--path", "oedometer",
                           "--stress", "1 kPa, 2 kPa, 3 kPa", "-o",     "out",
                           "-s",       "test.steps=5",        SOIL,     NULL};
    program_outcome outcome = program_run(folder, words, 0);
    program_clear(&outcome);
    run_folder_store(run_folder_file(folder, path, "out/specimen-4.csv"), "p [kPa],q [kPa]\n1,2\n", 20);
    words[5] = "1 kPa";
    outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "removed: out/specimen-2.csv, of an earlier test with more specimens");
    program_expect_text(outcome.output, "removed: out/specimen-3.csv");
    program_clear(&outcome);
    assert_int_equal(access(run_folder_file(folder, path, "out/specimen-1.csv"), F_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "out/specimen-2.csv"), F_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "out/specimen-3.csv"), F_OK), 0);
    assert_int_equal(access(run_folder_file(folder, path, "out/specimen-4.csv"), F_OK), 0);
}

/* Neither removed nor written over, though they are those of an earlier test. */
static void measured_values_stay_as_they_are(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *words[] = {"material", "drucker_prager",
                           "--path",   "oedometer",
                           "--stress", "1 kPa, 2 kPa",
                           "-o",       "out",
                           "-s",       "test.steps=5",
                           SOIL,       NULL,
                           NULL,       NULL};
    enum { STRESS = 5, MORE = sizeof words / sizeof *words - 3 };
    program_outcome outcome = program_run(folder, words, 0);
    program_clear(&outcome);
    words[STRESS] = "1 kPa";
    words[MORE] = "--data";
    words[MORE + 1] = "out/specimen-2.csv";
    outcome = program_run(folder, words, 0);
    program_clear(&outcome);
    assert_int_equal(access(run_folder_file(folder, path, "out/specimen-2.csv"), F_OK), 0);
    words[STRESS] = "1 kPa, 3 kPa";
    outcome = program_run(folder, words, 2);
    program_expect_text(outcome.errors, "found --data = 'out/specimen-2.csv', which a table of the test would replace");
    program_clear(&outcome);
}

/* The lateral stresses stay equal on the edge of the hexagon, where one equation is there twice: the axial stress is
 * 100 kPa / 3 - 2 c cos(phi) / (1 + sin(phi)) = 27.5598 kPa to the end of the path. */
static void mohr_coulomb_is_extended_beyond_its_strength(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"material", "mohr_coulomb",       "--path", "triaxial-extension",
                                 "-o",       "extended",           "-s",     "youngs_modulus=20 MPa",
                                 "-s",       "poissons_ratio=0.3", "-s",     "friction_angle=30 deg",
                                 "-s",       "cohesion=5 kPa",     NULL};
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "end        q -72.4402 kPa");
    program_expect_text(outcome.output, "0 repeated");
    assert_null(strstr(outcome.output, "stopped before the end"));
    program_clear(&outcome);
}

static void every_path_is_followed_and_drawn(void **state)
{
    run_folder *folder = *state;
    static const char *const paths[] = {"isotropic",
                                        "oedometer",
                                        "triaxial-extension",
                                        "undrained-compression",
                                        "undrained-extension",
                                        "true-triaxial",
                                        "simple-shear",
                                        "undrained-shear",
                                        "cyclic-triaxial",
                                        "cyclic-undrained-triaxial",
                                        "cyclic-shear",
                                        "cyclic-undrained-shear",
                                        "spin"};
    for (size_t k = 0; k < sizeof paths / sizeof *paths; ++k) {
        const bool is_cyclic = strncmp(paths[k], "cyclic", 6) == 0;
        const char *const words[] = {"material", "drucker_prager",
                                     "--path",   paths[k],
                                     "-o",       "out",
                                     "-s",       "test.steps=20",
                                     "-s",       is_cyclic ? "test.cycles=2" : "test.k0=1",
                                     SOIL,       NULL};
        program_outcome outcome = program_run(folder, words, 0);
        program_expect_text(outcome.output, paths[k]);
        program_expect_text(outcome.output, "picture: out/element.png");
        assert_string_equal(outcome.errors, "");
        program_clear(&outcome);
        expect_picture(folder, "out/element.png");
    }
}

static void the_soil_of_a_case_is_tested_beside_measured_values(void **state)
{
    run_folder *folder = *state;
    static const char data[] = "# a box\r\nname,axial_strain [%],eps v [%],eps_v [%],q [kPa],p [kPa]\r\n"
                               "a,0,0,0,0,100\r\nb,0.5,0.2,0.2,48,116\r\nc,1,,,,";
    char path[MOR_PATH_BYTES];
    const char *const words[] = {
        "material", "--case",   COLUMN, "--path", "triaxial-compression", "--stress", "5 kPa", "-o", "out", "--data",
        "data.csv", "--strain", "2 %",  "-s",     "test.steps=50",        NULL};
    run_folder_store(run_folder_file(folder, path, "data.csv"), data, sizeof data - 1);
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, ", triaxial-compression: drained");
    program_expect_text(outcome.errors, "data.csv:2: passed over 2 columns, which are none of an element test: 'name', "
                                        "'eps v' (did you mean 'eps_v'?)");
    expect_picture(folder, "out/element.png");
    program_clear(&outcome);
}

static void results_of_a_soil_go_into_a_folder_of_its_own(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"material", "--case", LAYERS, "--soil",       "clay",
                                 "--path",   "spin",   "-s",   "test.steps=5", NULL};
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "picture: runs/material-clay/element.png");
    program_clear(&outcome);
}

/* A law that depends on the rate creeps where nothing drives it. */
static void a_control_without_a_drive_is_left_to_laws_that_move_by_themselves(void **state)
{
    run_folder *folder = *state;
    const char *const words[] = {"material", "bingham",
                                 "-s",       "test.control=0, 0, 0, 0, 0, 0",
                                 "--stress", "1 kPa",
                                 "-s",       "test.steps=5",
                                 "-s",       "bulk_modulus=1 MPa",
                                 "-s",       "shear_modulus=0.1 MPa",
                                 "-s",       "yield_stress=20 Pa",
                                 "-s",       "viscosity=5 Pa s",
                                 "-o",       "out",
                                 NULL};
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "specimen of 1 kPa, 5 updates");
    program_clear(&outcome);
}

static void a_control_of_ones_own_compresses_in_plane_strain(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    const char *const words[] = {"material", "hypoelastic",
                                 "-s",       "test.control=stress, 0, -1, 0, 0, 0",
                                 "--strain", "1 %",
                                 "-o",       "out",
                                 "-s",       "youngs_modulus=10 MPa",
                                 "-s",       "poissons_ratio=0.3",
                                 "-s",       "density=2.0", /* t/m3 were meant, of which nothing here depends */
                                 NULL};
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.errors, "soil 'hypoelastic' has a density of 2 kg/m3, which is not that of a soil");
    program_clear(&outcome);
    run_folder_file(folder, path, "out/specimen-1.csv");
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
    /* Plane strain: the modulus is E / (1 - nu^2), and the stress across the plane nu times as large. */
    const double rise = 10e6 / (1.0 - 0.09) * 0.01;
    assert_near(last_value(&data, "stress_zz [Pa]"), -100e3 - rise, 2e-9 * 210e3); /* the solver's tolerance */
    assert_near(last_value(&data, "stress_yy [Pa]"), -100e3 - 0.3 * rise, 2e-9 * 210e3);
    assert_near(last_value(&data, "stress_xx [Pa]"), -100e3, 2e-9 * 210e3);
    mor_table_data_clear(&folder->context, &data);
}

static void a_specimen_beyond_its_strength_keeps_its_table(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    const char *const words[] = {"material", "drucker_prager",
                                 "-s",       "test.control=stress, stress, stress -2 kPa/s, 0, 0, 0",
                                 "-s",       "test.rate=0.01",
                                 "--strain", "1",
                                 "-o",       "out",
                                 SOIL,       NULL};
    program_outcome outcome = program_run(folder, words, 1);
    program_expect_text(outcome.errors, "beyond the strength");
    program_expect_text(outcome.errors, "did not reach the end of its path");
    program_expect_text(outcome.output, "stopped before the end");
    run_folder_file(folder, path, "out/specimen-1.csv");
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
    /* 155.02 kPa at 2 kPa/s and 0.2 s per step: the last whole step before */
    assert_near(last_value(&data, "q [Pa]"), 154.8e3, 400.0);
    mor_table_data_clear(&folder->context, &data);
    expect_picture(folder, "out/element.png");
    program_clear(&outcome);
}

static const struct {
    const char *words[ARGUMENTS];
    const char *message;
} refusals[] = {
    {{"material", NULL}, "found no model to be tested"},
    {{"material", "druker_prager", "--path", "oedometer", NULL}, "did you mean"},
    {{"material", "neo_hookean", "--path", "oedometer", "-s", "youngs_modulus=1 MPa", "-s", "poissons_ratio=0.3", NULL},
     "'neo_hookean' gives the stress from the deformation gradient"},
    {{"material", "drucker_prager", SOIL, NULL}, "found no path for the test; allowed: isotropic, oedometer"},
    {{"material", "drucker_prager", "--path", "oedometr", SOIL, NULL}, "did you mean oedometer"},
    {{"material", "drucker_prager", "--path", "oedometer", NULL}, "found no 'youngs_modulus'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "frictoin_angle=1", NULL},
     "did you mean friction_angle?"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "E=1 MPa", NULL},
     "did you mean youngs_modulus?"},
    {{"material", "bingham", "--path", "oedometer", "-s", "c=1 kPa", NULL}, "did you mean yield_stress?"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "cohesion=1 m", NULL}, "cohesion = '1 m'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "friction_angle=30", NULL}, "out of range"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "cone=round", NULL},
     "allowed: plane_strain|compression|extension"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "dilation_angle=40 deg", NULL},
     "more than friction_angle"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--stress", "-5 kPa", NULL}, "--stress = '-5 kPa'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.steps=2.5", NULL},
     "which is no whole number"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.k0=0", NULL},
     "outside of what 'drucker_prager' admits"},
    {{"material", "drucker_prager", "--path", "true-triaxial", SOIL, "-s", "test.k0=0.5", NULL}, "equal stresses"},
    {{"material", "drucker_prager", "-s", "test.control=0, 0, -1", SOIL, NULL}, "with 3 parts; allowed: six"},
    {{"material", "drucker_prager", "-s", "test.control=0, 0, fast, 0, 0, 0", SOIL, NULL}, "with 'fast'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "nowhere.csv", NULL},
     "cannot open 'nowhere.csv'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "bad.csv", NULL},
     "bad.csv:3: found 'wet' in column 2"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "unit.csv", NULL},
     "unit.csv:1: found the column"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "comma.csv", NULL},
     "comma.csv:3: found 3 cells under 2 names of columns"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "short.csv", NULL},
     "short.csv:2: found 1 cells under 2 names of columns"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "other.csv", NULL},
     "found no column of an element test in the first line, but 'load', 'axial strains' (did you mean "
     "'axial_strain'?)"},
    {{"material", "hypoelastic", "--path", "oedometer", "--case", COLUMN, NULL}, "has 'drucker_prager'"},
    {{"material", "--path", "oedometer", "--case", COLUMN, "--soil", "peat", NULL}, "found no soil 'peat'"},
    {{"material", "drucker_prager", "--path", "oedometer", "--soil", "peat", SOIL, NULL},
     "found --soil without --case"},
    {{"material", "drucker_prager", "--path", "oedometer", "-s", "test.soil=peat", SOIL, NULL},
     "found test.soil without --case"},
    {{"material", "--path", "oedometer", "--case", LAYERS, NULL}, "choose one by --soil"},
    {{"material", "my_clay", "--path", "oedometer", NULL},
     "by --plugin FILE.so or by a case (--case) that has plugins = [ \"./FILE.so\" ]"},
    {{"material", "umat", "--path", "oedometer", NULL}, "found 'umat', an interface to laws of other programs"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--strain", "8", NULL},
     "found --strain = '8', a strain of more than 100 % without a unit; write '8 %' or '800 %'"},
    {{"material", "drucker_prager", "--path", "spin", SOIL, "--strain", "90", NULL}, "write '90 deg' or '90 rad'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--strain", "20000 %", NULL}, "in (0, 100]"},
    {{"material", "drucker_prager", "-s", "test.control=stress, stress, stress, 0, 0, 0", SOIL, NULL},
     "nothing drives the specimen"},
    {{"material", "drucker_prager", "-s", "test.control=0, 0, 0, 0, 0, 0", SOIL, NULL}, "nothing drives the specimen"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "--data", "bare.csv", NULL},
     "bare.csv:3: found 8 in column 2, 'axial_strain' without a unit: a strain of more than 100 %; write 'axial_strain "
     "[%]' or 'axial_strain [1]'"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.void_ratio=70", NULL},
     "test.void_ratio = '70', out of range"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.b=0.3", NULL}, "found test.b for"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.cycles=3", NULL},
     "found test.cycles for 'oedometer', which does not turn"},
    {{"material", "drucker_prager", "--path", "oedometer", SOIL, "-s", "test.amplitude=3 kPa", NULL},
     "found test.amplitude for 'oedometer', which does not turn"},
    {{"material", "hypoplastic_sand", "--path", "oedometer", "-s", "test.void_ratio=0.7", NULL},
     "give state.void_ratio"},
    {{"check", COLUMN, "--path", "oedometer", NULL}, "belongs to moraine material"},
};

static void wrong_input_is_refused_with_what_is_allowed(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *name, *text;
    } tables[] = {{"bad.csv", "p [kPa],q [kPa]\n1,2\n3,wet\n"},        {"unit.csv", "p [m],q [kPa]\n1,2\n"},
                  {"comma.csv", "p [kPa],q [kPa]\n1,2\n0,5,2\n"},      {"short.csv", "p [kPa],q [kPa]\n1\n"},
                  {"bare.csv", "q [kPa],axial_strain\n0,0.5\n10,8\n"}, {"other.csv", "load,axial strains [%]\n1,2\n"}};
    for (size_t k = 0; k < sizeof tables / sizeof *tables; ++k) {
        char path[MOR_PATH_BYTES];
        run_folder_store(run_folder_file(folder, path, tables[k].name), tables[k].text, strlen(tables[k].text));
    }
    for (size_t k = 0; k < sizeof refusals / sizeof *refusals; ++k) {
        program_outcome outcome = program_run(folder, refusals[k].words, 2);
        program_expect_text(outcome.errors, refusals[k].message);
        assert_string_equal(outcome.output, "");
        program_clear(&outcome);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(several_specimens_fail_at_their_strength, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(tables_of_an_earlier_test_are_removed, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(measured_values_stay_as_they_are, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(mohr_coulomb_is_extended_beyond_its_strength, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(every_path_is_followed_and_drawn, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_soil_of_a_case_is_tested_beside_measured_values, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(results_of_a_soil_go_into_a_folder_of_its_own, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_control_of_ones_own_compresses_in_plane_strain, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_control_without_a_drive_is_left_to_laws_that_move_by_themselves,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_specimen_beyond_its_strength_keeps_its_table, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(wrong_input_is_refused_with_what_is_allowed, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
