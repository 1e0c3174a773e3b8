/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <stdio.h>

/* Bodies from one stage to the next: those that have moved make no hole where the case places them. */

#define CASE_OF(start, end, bodies)                                                                                    \
    start "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '" end "';"                                   \
          "domain = { min = (-3, -1); max = (5, 4); };"                                                                \
          "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 0.8); };"                         \
          "  initial_stress = { type = 'k0'; }; material = { model = 'drucker_prager'; density = 1600;"                \
          "    youngs_modulus = '2 MPa'; poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"                     \
          "walls = ( { name = 'floor'; friction = 'rough';"                                                            \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; },"                                  \
          "  { name = 'left'; friction = 'smooth';"                                                                    \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; } );"                                \
          "bodies = (" bodies ");"                                                                                     \
          "probes = ( { name = 'mass'; type = 'mass'; }, { name = 'balance'; type = 'energy_balance'; },"              \
          "  { name = 'front'; type = 'run_out'; }, { name = 'v'; type = 'largest_speed'; } );"                        \
          "output = { snapshots = 2; pictures = false; };"

/* The last value of a column that begins with a name, or that at a row. */
static double read_value(run_folder *folder, const char *run, const char *name, int64_t row)
{
    char path[MOR_PATH_BYTES];
    mor_table_data data;
    int column = 0;
    assert_int_equal(
        mor_table_data_read(&folder->context, &data, finished_run_file(folder, path, run, MOR_TABLE_SERIES_FILE)),
        MOR_OK);
    const char *at = data.header;
    while (strncmp(at, name, strlen(name)) != 0 || at[strlen(name)] != ' ') {
        at = strchr(at, ',');
        assert_non_null(at);
        at += 1;
        column += 1;
    }
    const double value = data.values[(row < 0 ? data.n_rows - 1 : row) * data.n_columns + column];
    mor_table_data_clear(&folder->context, &data);
    return value;
}

static void run_stage(run_folder *folder, const char *text, const char *name)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run it = {.case_path = path, .name = name, .stop_at = NAN, .n_threads = 2};
    session_run_do(folder, &it, name);
}

#define ELASTIC                                                                                                        \
    "{ name = 'block'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); }; position = (1.225, 0.23);"     \
    "  friction = 'smooth'; contact_modulus = '5 MPa'; material = { model = 'neo_hookean'; density = 800;"             \
    "    youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; }"

/* Sand pushes an elastic block aside and lies then where the block stood. */
static void soil_stays_where_an_elastic_body_stood_before(void **state)
{
    run_folder *folder = *state;
    run_stage(folder, CASE_OF("", "0.6 s", ELASTIC), "before");
    run_stage(folder, CASE_OF("start_from = 'before';", "10 ms", ELASTIC), "after");
    assert_true(read_value(folder, "before", "front", -1) > 1.1); /* it is there */
    assert_true(read_value(folder, "after", "mass", 0) == read_value(folder, "before", "mass", -1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(soil_stays_where_an_elastic_body_stood_before, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
