/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/finished_run.h"
#include "tests/common/fortran.h"
#include "tests/common/program.h"

#include <math.h>

/* Laws in Fortran that a case names: run, resumed, guarded, and what ends a run in which one fails. */

static const char head[] =
    "title = 'heap'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '40 ms';"
    "domain = { min = ('-0.2 m', '-0.1 m'); max = ('0.6 m', '0.4 m'); };"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "probes = ( { type = 'run_out'; } ); output = { snapshots = 6; pictures = false; };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.2 m'); };"
    "  material = { model = 'umat'; density = '2000 kg/m3'; ";

static void write_case(run_folder *folder, const char *law)
{
    char path[MOR_PATH_BYTES];
    char text[sizeof head + 512];
    snprintf(text, sizeof text, "%s%s }; } );", head, law);
    finished_run_store_text(folder, text, path);
}

static void write_drucker_prager(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    fortran_compile(folder, "umat_drucker_prager", path);
    write_case(folder, "library = './umat_drucker_prager.so'; props = (2e6, 0.3, 0.25, 100, 0); "
                       "state = ('plastic_strain');");
}

static void write_fault(run_folder *folder, int fault)
{
    char path[MOR_PATH_BYTES];
    char law[256];
    fortran_compile(folder, "umat_faults", path);
    snprintf(law, sizeof law, "library = './umat_faults.so'; props = (2e6, 0.3, %d, 0.01);", fault);
    write_case(folder, law);
}

static program_outcome run(run_folder *folder, const char *name, int exit_code, const char *option, const char *value)
{
    return program_run(folder, (const char *const[]){"run", "case.cfg", "-t", "2", "-o", name, option, value, NULL},
                       exit_code);
}

static void run_well(run_folder *folder, const char *name, const char *option, const char *value)
{
    program_outcome outcome = run(folder, name, 0, option, value);
    program_clear(&outcome);
}

static void resumed_run_of_a_umat_has_the_bits_of_a_whole_one(void **state)
{
    run_folder *folder = *state;
    write_drucker_prager(folder);
    run_well(folder, "whole", NULL, NULL);
    run_well(folder, "part", "--stop-at", "15 ms");
    run_well(folder, "part", "--resume", NULL);
    finished_run_compare(folder, "whole", "part");
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "whole/case.resolved.cfg", "-t", "1", "-o", "again", NULL}, 0);
    program_clear(&outcome);
    finished_run_compare(folder, "whole", "again");
}

/* Two regions of laws in Fortran over one of a built-in law. */
static void several_soils_may_be_of_laws_in_fortran(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char text[sizeof head + 2048];
    fortran_compile(folder, "umat_drucker_prager", path);
    fortran_compile(folder, "umat_mohr_coulomb", path);
    snprintf(
        text, sizeof text,
        "%slibrary = './umat_drucker_prager.so'; props = (2e6, 0.3, 0.25, 100, 0); state = ('plastic_strain'); }; }, "
        "{ name = 'middle'; shape = { type = 'box'; min = ('0.2 m', '0 m'); max = ('0.3 m', '0.1 m'); };"
        "  material = { model = 'umat'; density = '1800 kg/m3'; library = './umat_mohr_coulomb.so';"
        "    props = (1e6, 0.3, 0.5, 100, 0); }; }, "
        "{ name = 'right'; shape = { type = 'box'; min = ('0.3 m', '0 m'); max = ('0.4 m', '0.1 m'); };"
        "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
        "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );",
        head);
    finished_run_store_text(folder, text, path);
    run_well(folder, "whole", NULL, NULL);
    run_well(folder, "part", "--stop-at", "15 ms");
    run_well(folder, "part", "--resume", NULL);
    finished_run_compare(folder, "whole", "part");
}

/* The column of cases/column-3d at a spacing of a fifth of its radius, as it slumps. Returns its run-out, m. */
static double run_column(run_folder *folder, const char *name, const char *law)
{
    static const char column[] =
        "title = 'column'; dimension = 3; spacing = '20 mm'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2');"
        "end = '0.12 s'; domain = { min = ('-0.5 m', '-0.5 m', '-0.1 m'); max = ('0.5 m', '0.5 m', '0.5 m'); };"
        "walls = ( { name = 'floor'; friction = 'rough';"
        "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; } );"
        "probes = ( { type = 'run_out'; } ); output = { snapshots = 2; pictures = false; };"
        "soil = ( { name = 'sand'; shape = { type = 'cylinder'; base = ('0 m', '0 m', '0 m'); axis = (0, 0, 1);"
        "    radius = '0.1 m'; height = '0.1 m'; };"
        "  material = { density = '2600 kg/m3'; ";
    char path[MOR_PATH_BYTES];
    char text[sizeof column + 512];
    mor_table_data rows;
    snprintf(text, sizeof text, "%s%s }; } );", column, law);
    finished_run_store_text(folder, text, path);
    run_well(folder, name, NULL, NULL);
    assert_int_equal(
        mor_table_data_read(&folder->context, &rows, finished_run_file(folder, path, name, MOR_TABLE_SERIES_FILE)),
        MOR_OK);
    const double run_out = rows.values[rows.n_rows * rows.n_columns - 1];
    mor_table_data_clear(&folder->context, &rows);
    return run_out;
}

static void column_of_a_law_in_fortran_runs_out_as_of_the_built_in_one(void **state)
{
    run_folder *folder = *state;
    static const char elastic[] = "youngs_modulus = '5.98 MPa'; poissons_ratio = 0.3; friction_angle = '30 deg';";
    static const struct {
        const char *model, *library, *constants;
    } laws[] = {{"drucker_prager", "umat_drucker_prager",
                 "props = (5.98e6, 0.3, 0.16012815380508713, 0, 0); state = ('plastic_strain');"},
                {"mohr_coulomb", "umat_mohr_coulomb", "props = (5.98e6, 0.3, 0.52359877559829887, 0, 0);"}};
    for (int k = 0; k < 2; ++k) {
        char path[MOR_PATH_BYTES];
        char law[256];
        fortran_compile(folder, laws[k].library, path);
        snprintf(law, sizeof law, "model = '%s'; %s", laws[k].model, elastic);
        const double expected = run_column(folder, laws[k].model, law);
        snprintf(law, sizeof law, "model = 'umat'; library = './%s.so'; %s", laws[k].library, laws[k].constants);
        const double found = run_column(folder, laws[k].library, law);
        assert_true(expected > 0.12);                     /* from 0.1 m */
        assert_true(fabs(found / expected - 1.0) < 1e-3); /* asked: 0.1 %; rounding grows in the flow */
    }
}

static void changed_library_is_refused_on_resume(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char other[MOR_PATH_BYTES];
    write_drucker_prager(folder);
    run_well(folder, "part", "--stop-at", "15 ms");
    fortran_compile(folder, "umat_elastic", other);
    assert_int_equal(rename(other, run_folder_file(folder, path, "umat_drucker_prager.so")), 0);
    program_outcome outcome = run(folder, "part", 2, "--resume", NULL);
    program_expect_text(outcome.errors, "the file has changed since");
    program_clear(&outcome);
}

/* A law that keeps scratch in a common block is called by one thread at a time. */
static void law_with_a_common_block_gives_the_same_bits_with_any_number_of_threads(void **state)
{
    run_folder *folder = *state;
    write_fault(folder, 13);
    run_well(folder, "two", NULL, NULL);
    program_outcome outcome =
        program_run(folder, (const char *const[]){"run", "case.cfg", "-t", "1", "-o", "one", NULL}, 0);
    program_clear(&outcome);
    finished_run_compare(folder, "one", "two");
}

static void law_that_fails_in_a_run_ends_it_with_the_particle_named(void **state)
{
    run_folder *folder = *state;
    static const struct {
        int fault;
        const char *part;
    } cases[] = {{1, "the computation failed"}, {11, "the code of the material crashed"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char name[16];
        char path[MOR_PATH_BYTES];
        size_t n_bytes = 0;
        snprintf(name, sizeof name, "run_%zu", k);
        write_fault(folder, cases[k].fault);
        program_outcome outcome = run(folder, name, 1, NULL, NULL);
        program_expect_text(outcome.errors, "the stress update of material 'umat' failed for particle ");
        program_expect_text(outcome.errors, cases[k].part);
        program_clear(&outcome);
        /* The run ended in order: its summary tells the particle. */
        char *text = (char *)run_folder_load(finished_run_file(folder, path, name, MOR_SUMMARY_FILE), &n_bytes);
        assert_non_null(text);
        program_expect_text(text, "\"status\": \"failed\"");
        program_expect_text(text, "\"set\": \"soil\"");
        free(text);
    }
}

static void library_that_fails_in_its_first_call_is_refused_with_its_place(void **state)
{
    run_folder *folder = *state;
    static const int faults[] = {3, 4, 5};
    for (int k = 0; k < 3; ++k) {
        write_fault(folder, faults[k]);
        program_outcome outcome = program_run(folder, (const char *const[]){"check", "case.cfg", NULL}, 2);
        program_expect_text(outcome.errors, "case.cfg:1: ");
        program_expect_text(outcome.errors, "its first call, with no strain and no stress, failed");
        program_clear(&outcome);
    }
}

static void law_that_stops_the_program_is_told(void **state)
{
    run_folder *folder = *state;
    write_fault(folder, 10);
    program_outcome outcome = run(folder, "run", 1, NULL, NULL);
    program_expect_text(outcome.errors, "the library of a material ended the program");
    program_clear(&outcome);
}

static void material_of_a_case_is_checked_with_its_parameters(void **state)
{
    run_folder *folder = *state;
    write_drucker_prager(folder);
    program_outcome outcome = program_run(folder, (const char *const[]){"check-material", "case.cfg", NULL}, 0);
    program_expect_text(outcome.output, "soil 'sand': umat");
    program_expect_text(outcome.output, "pass  a superposed rotation turns the stress with it");
    program_expect_text(outcome.output, "    drucker_prager "); /* in the table of costs */
    program_clear(&outcome);
    write_fault(folder, 6);
    outcome = program_run(folder, (const char *const[]){"check-material", "case.cfg", NULL}, 1);
    program_expect_text(outcome.output, "FAIL  a superposed rotation turns the stress with it");
    program_clear(&outcome);
}

static void case_that_asks_for_what_there_is_not_is_refused(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *law, *part;
    } cases[] = {
        {"", "library"},
        {"library = './none.so';", "a library that cannot be read: cannot open '"},
        {"library = './case.cfg';", "is no shared library, but a file of another kind"},
        {"library = './umat_elastic.so'; state = ('a[2]'); state_start = (1, 2, 3);",
         "3 initial values, state_start, for state variables of 2 numbers in all"},
        {"library = './umat_elastic.so'; props = (1e6, 'x');", "numbers without a unit"},
        {"library = './umat_elastic.so'; props = 3;", "a list of up to"},
        {"library = './umat_elastic.so'; props = (1e6, 0.3); state = ('A b');", "lower-case"},
        {"library = './umat_elastic.so'; props = (0, 0.3);",
         "check number and order of the 2 constants in props, or give wave_speed"},
        {"library = './umat_elastic.so'; props = (1e6, 0.3); is_reentrant = 3;", "is_reentrant"},
        {"library = './umat_elastic.so'; prop = (1e6, 0.3);", "did you mean 'props'"},
        {"library = './umat_elastic.so'; props = (1e6, 0.3); }; } ); scale = { length = 4.0;", "with a scale"},
    };
    char path[MOR_PATH_BYTES];
    fortran_compile(folder, "umat_elastic", path);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        write_case(folder, cases[k].law);
        if (strstr(cases[k].law, "scale") != NULL) { /* the group is closed already */
            char text[sizeof head + 512];
            snprintf(text, sizeof text, "%s%s };", head, cases[k].law);
            finished_run_store_text(folder, text, path);
        }
        program_outcome outcome = program_run(folder, (const char *const[]){"check", "case.cfg", NULL}, 2);
        program_expect_text(outcome.errors, cases[k].part);
        program_clear(&outcome);
    }
}

/* What lies behind PROPS is not a number. */
static void law_that_computes_with_a_constant_that_is_not_given_is_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    fortran_compile(folder, "umat_elastic", path);
    static const char *const laws[] = {"library = './umat_elastic.so';",
                                       "library = './umat_elastic.so'; props = (1e6);"};
    for (int k = 0; k < 2; ++k) {
        write_case(folder, laws[k]);
        program_outcome outcome = program_run(folder, (const char *const[]){"check", "case.cfg", NULL}, 2);
        program_expect_text(outcome.errors, "parameters that 'umat' refuses");
        program_clear(&outcome);
    }
}

/* Without its constants even a sound law may crash, and its complaint would hide the misspelled name. */
static void law_is_not_tried_while_a_name_of_its_case_is_unknown(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    fortran_compile(folder, "umat_elastic", path);
    write_case(folder, "library = './umat_elastic.so'; prop = (1e6, 0.3);");
    program_outcome outcome = program_run(folder, (const char *const[]){"check", "case.cfg", NULL}, 2);
    program_expect_text(outcome.errors, "did you mean 'props'");
    assert_null(strstr(outcome.errors, "refuses"));
    program_clear(&outcome);
}

/* Constants in MPa, as in millimeters and newtons. 0.2 m of 2000 kg/m3 weigh 3924 Pa, and K = E / 1.2. */
static void law_too_soft_for_its_weight_is_warned_of(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char *const check[] = {"check", "case.cfg", NULL};
    fortran_compile(folder, "umat_elastic", path);
    write_case(folder, "library = './umat_elastic.so'; props = (10, 0.3);");
    program_outcome outcome = program_run(folder, check, 0);
    program_expect_text(outcome.output, "soil 'sand' is so soft that its own weight compresses it by about 4.71e+04 %");
    program_expect_text(outcome.output, "raise its stiffness to 392 kPa or more; a bare number is in Pa");
    program_clear(&outcome);
    write_case(folder, "library = './umat_elastic.so'; props = (10e6, 0.3);");
    outcome = program_run(folder, check, 0);
    assert_null(strstr(outcome.output, "warning"));
    program_clear(&outcome);
}

int main(void)
{
#define UMAT_TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        UMAT_TEST(resumed_run_of_a_umat_has_the_bits_of_a_whole_one),
        UMAT_TEST(several_soils_may_be_of_laws_in_fortran),
        UMAT_TEST(column_of_a_law_in_fortran_runs_out_as_of_the_built_in_one),
        UMAT_TEST(changed_library_is_refused_on_resume),
        UMAT_TEST(law_with_a_common_block_gives_the_same_bits_with_any_number_of_threads),
        UMAT_TEST(law_that_fails_in_a_run_ends_it_with_the_particle_named),
        UMAT_TEST(library_that_fails_in_its_first_call_is_refused_with_its_place),
        UMAT_TEST(law_that_stops_the_program_is_told),
        UMAT_TEST(material_of_a_case_is_checked_with_its_parameters),
        UMAT_TEST(law_too_soft_for_its_weight_is_warned_of),
        UMAT_TEST(case_that_asks_for_what_there_is_not_is_refused),
        UMAT_TEST(law_that_computes_with_a_constant_that_is_not_given_is_refused),
        UMAT_TEST(law_is_not_tried_while_a_name_of_its_case_is_unknown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
