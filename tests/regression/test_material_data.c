/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/program.h"

/* Measured values beside an element test: what is drawn, and what is told of columns and units. */

/* Tests a soil, beside a table unless that is NULL; returns the bytes of the figure. */
static unsigned char *draw_beside(run_folder *folder, const char *path_name, const char *table, const char *message,
                                  size_t *n_bytes)
{
    char path[MOR_PATH_BYTES];
    const char *const words[] = {"material",
                                 "hypoelastic",
                                 "--path",
                                 path_name,
                                 "-o",
                                 "out",
                                 "-s",
                                 "test.steps=20",
                                 "-s",
                                 "youngs_modulus=10 MPa",
                                 "-s",
                                 "poissons_ratio=0.3",
                                 "--strain",
                                 "1 %",
                                 table != NULL ? "--data" : NULL,
                                 "data.csv",
                                 NULL};
    if (table != NULL) {
        run_folder_store(run_folder_file(folder, path, "data.csv"), table, strlen(table));
    }
    program_outcome outcome = program_run(folder, words, 0);
    if (message[0] == '\0') {
        assert_string_equal(outcome.errors, "");
    } else {
        program_expect_text(outcome.errors, message);
    }
    program_clear(&outcome);
    unsigned char *bytes = run_folder_load(run_folder_file(folder, path, "out/element.png"), n_bytes);
    assert_non_null(bytes);
    return bytes;
}

/* Without the change of volume: an undrained specimen has none, of a drained one the axial strain is drawn. */
static void measured_values_are_drawn_where_they_can_be_and_missing_columns_named(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *path, *table, *message;
    } tests[] = {
        {"triaxial-compression", "axial_strain [%],q [kPa]\n0,0\n1,50\n",
         "data.csv: its points are missing in 3 of the 4 charts, which need 'eps_v [%]', 'p [kPa]'"},
        {"undrained-compression", "axial_strain [%],q [kPa]\n0,0\n1,50\n",
         "data.csv: its points are missing in 3 of the 4 charts, which need 'p [kPa]'"},
        {"undrained-compression", "axial_strain [1],p [kPa],q [kPa],void_ratio\n0,100,0,1.5\n1.5,100,50,1.5\n", ""},
        {"triaxial-compression", "q [kPa]\n0\n50\n",
         "data.csv: its points are missing in 4 of the 4 charts, which need 'eps_v [%]', 'eps_q [%]', 'p [kPa]'"},
    };
    static const char *const paths[2] = {"triaxial-compression", "undrained-compression"};
    unsigned char *plain[2];
    size_t n_plain[2];
    for (int k = 0; k < 2; ++k) {
        plain[k] = draw_beside(folder, paths[k], NULL, "", &n_plain[k]);
    }
    for (size_t k = 0; k < sizeof tests / sizeof *tests; ++k) {
        size_t n_bytes = 0;
        const int other = strcmp(tests[k].path, paths[0]) != 0;
        unsigned char *bytes = draw_beside(folder, tests[k].path, tests[k].table, tests[k].message, &n_bytes);
        const bool is_same = n_bytes == n_plain[other] && memcmp(bytes, plain[other], n_bytes) == 0;
        assert_int_equal(is_same, strstr(tests[k].message, "4 of the 4") != NULL);
        free(bytes);
    }
    free(plain[0]);
    free(plain[1]);
}

/* A unit that is left out is told; a strain that cannot be meant so is refused, in the list below. */
static void units_that_are_assumed_are_told(void **state)
{
    run_folder *folder = *state;
    size_t n_bytes = 0;
    free(draw_beside(folder, "triaxial-compression", "axial_strain,eps_v [1],p [-],q [kPa],void_ratio\n0,0,1,0,1.5\n",
                     "data.csv:1: found columns without a unit, read as 'axial_strain [1]', 'p [Pa]'; write",
                     &n_bytes));
}

/* The shear strain is axial - eps_v / 3 of a cylinder alone: such points are drawn where those
 * are that give it, of another specimen they are not. */
static void the_shear_strain_of_a_cylinder_is_that_of_no_other_specimen(void **state)
{
    static const char *const paths[2] = {"triaxial-compression", "true-triaxial"};
    run_folder *folder = *state;
    for (int k = 0; k < 2; ++k) {
        size_t n_bytes[2];
        unsigned char *without = draw_beside(
            folder, paths[k], "axial_strain [%],eps_v [%],p [kPa],q [kPa]\n0,0,100,0\n1,0.3,110,50\n", "", &n_bytes[0]);
        unsigned char *with = draw_beside(
            folder, paths[k], "axial_strain [%],eps_q [%],eps_v [%],p [kPa],q [kPa]\n0,0,0,100,0\n1,0.9,0.3,110,50\n",
            "", &n_bytes[1]);
        const bool is_same = n_bytes[0] == n_bytes[1] && memcmp(without, with, n_bytes[0]) == 0;
        assert_true(is_same == (k == 0));
        free(without);
        free(with);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(measured_values_are_drawn_where_they_can_be_and_missing_columns_named,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_shear_strain_of_a_cylinder_is_that_of_no_other_specimen, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(units_that_are_assumed_are_told, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
