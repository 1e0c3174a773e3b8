/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include "core/base/math.h"

#include <stdio.h>

/* Walls and bodies on prescribed paths: a block slides off a floor that tilts at the angle of friction, drums that
 * rotate either way are mirror images, and the work of moving walls is what energies change by. */

/* A column of the series of a run; the caller frees the data. */
typedef struct series {
    mor_table_data data;
    int columns[4];
} series;

static void open_series(run_folder *folder, const char *text, const char *const *names, int n_names, series *it)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run run = {.case_path = path, .name = names[0], .stop_at = NAN, .n_threads = 2};
    session_run_do(folder, &run, names[0]);
    assert_int_equal(mor_table_data_read(&folder->context, &it->data,
                                         finished_run_file(folder, path, names[0], MOR_TABLE_SERIES_FILE)),
                     MOR_OK);
    for (int k = 1; k <= n_names; ++k) {
        const char *at = it->data.header;
        it->columns[k - 1] = 0;
        while (strncmp(at, names[k], strlen(names[k])) != 0 || at[strlen(names[k])] != ' ') {
            at = strchr(at, ',');
            assert_non_null(at);
            at += 1;
            it->columns[k - 1] += 1;
        }
    }
}

static double value_at(const series *it, int64_t row, int name)
{
    return it->data.values[row * it->data.n_columns + it->columns[name]];
}

static void a_block_slides_off_a_tilting_floor_at_its_angle_of_friction(void **state)
{
    static const char text[] =
        "dimension = 2; spacing = '25 mm'; gravity = (0, -9.81); end = 2; domain = { min = (-2, -2); max = (2, 2); };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); };"
        "  path = { point = (0, 0); interpolation = 'linear'; table = ( { time = 0; }, { time = 0.1; },"
        "    { time = 2; angle = '30 deg'; } ); }; } );"
        "bodies = ( { name = 'block'; shape = { type = 'box'; min = (-0.1, -0.05); max = (0.1, 0.05); };"
        "  position = (0, 0.05); material = { model = 'rigid'; density = 2000; }; contact_modulus = '2 MPa'; } );"
        "contact = { friction_coefficient = 0.4; restitution = 0.1; };"
        "probes = ( { name = 'x'; type = 'body_position'; body = 'block'; direction = (1, 0); },"
        "  { name = 'y'; type = 'body_position'; body = 'block'; direction = (0, 1); },"
        "  { name = 'angle'; type = 'body_rotation_angle'; body = 'block'; },"
        "  { name = 'balance'; type = 'energy_balance'; } );"
        "output = { snapshots = 1; pictures = false; };";
    static const char *const names[] = {"tilt", "x", "y", "angle", "balance"};
    run_folder *folder = *state;
    series it;
    open_series(folder, text, names, 4, &it);
    double start = 0.0; /* distance from the pivot along the floor, when the tilt begins */
    double slid_at = 0.0;
    for (int64_t row = 0; row < it.data.n_rows; ++row) {
        const double time = it.data.values[row * it.data.n_columns];
        const double tilt = time > 0.1 ? (time - 0.1) / 1.9 * MOR_PI / 6.0 : 0.0;
        const double along = value_at(&it, row, 0) * cos(tilt) + value_at(&it, row, 1) * sin(tilt);
        start = time < 0.11 ? along : start;
        assert_near(value_at(&it, row, 2), tilt, 0.01); /* it rotates with the floor */
        if (slid_at == 0.0 && fabs(along - start) > 2e-3) {
            slid_at = tilt;
        }
    }
    /* It slides from tan(angle) = mu on; to have slid 2 mm takes another 0.18 s by (6 s / (g cos omega))^(1/3), in
     * which the floor tilts by 0.05. */
    assert_true(slid_at > atan(0.4) - 0.005 && slid_at < atan(0.4) + 0.06);
    assert_near(value_at(&it, it.data.n_rows - 1, 3), 1.0, 1e-3); /* as of contact alone */
    mor_table_data_clear(&folder->context, &it.data);
}

/* Half a drum of sand that rotates one way, or the other. */
#define DRUM(angle)                                                                                                    \
    "dimension = 2; spacing = '20 mm'; gravity = (0, -9.81); end = 0.6;"                                               \
    "domain = { min = (-0.36, -0.36); max = (0.36, 0.36); };"                                                          \
    "soil = ( { name = 'sand'; shape = { type = 'difference';"                                                         \
    "    from = { type = 'sphere'; center = (0, 0); radius = 0.2; };"                                                  \
    "    minus = { type = 'box'; min = (-0.3, 0); max = (0.3, 0.3); }; };"                                             \
    "  material = { model = 'drucker_prager'; density = 1500; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"         \
    "    friction_angle = '25 deg'; }; initial_stress = { type = 'k0'; }; } );"                                        \
    "walls = ( { name = 'drum'; friction = 'rough'; shape = { type = 'difference';"                                    \
    "    from = { type = 'sphere'; center = (0, 0); radius = 0.29; };"                                                 \
    "    minus = { type = 'sphere'; center = (0, 0); radius = 0.2; }; };"                                              \
    "  path = { point = (0, 0); interpolation = 'smooth'; table = ( { time = 0; }, { time = 0.6; angle = '" angle      \
    "'; } ); }; } );"                                                                                                  \
    "probes = ( { name = 'fx'; type = 'wall_force'; wall = 'drum'; direction = (1, 0); },"                             \
    "  { name = 'x'; type = 'center_of_mass'; direction = (1, 0); },"                                                  \
    "  { name = 'balance'; type = 'energy_balance'; }, { name = 'work'; type = 'external_work'; } );"                  \
    "output = { snapshots = 1; pictures = false; };"

static void drums_that_rotate_either_way_are_mirror_images(void **state)
{
    static const char *const names[2][5] = {{"left", "fx", "x", "balance", "work"},
                                            {"right", "fx", "x", "balance", "work"}};
    run_folder *folder = *state;
    series it[2];
    open_series(folder, DRUM("60 deg"), names[0], 4, &it[0]);
    open_series(folder, DRUM("-60 deg"), names[1], 4, &it[1]);
    assert_int_equal(it[0].data.n_rows, it[1].data.n_rows);
    const int64_t last = it[0].data.n_rows - 1;
    /* Rounding grows in a flow; in half the time it stays small beside a weight of 940 N/m and a radius of 0.2 m. */
    for (int64_t row = 0; row < last / 2; ++row) {
        if (row > 0) { /* before the first step there is no force */
            assert_near(value_at(&it[0], row, 0), -value_at(&it[1], row, 0), 1.0);
        }
        assert_near(value_at(&it[0], row, 1), -value_at(&it[1], row, 1), 1e-5);
    }
    assert_true(fabs(value_at(&it[0], last, 1)) > 0.02); /* the sand is carried along */
    for (int k = 0; k < 2; ++k) {
        assert_true(value_at(&it[k], last, 3) > 5.0);      /* work is done on it, J/m */
        assert_near(value_at(&it[k], last, 2), 1.0, 0.01); /* sampled powers, docs/theory/energy.md */
        mor_table_data_clear(&folder->context, &it[k].data);
    }
}

static void a_piston_on_a_path_does_the_work_that_energies_tell(void **state)
{
    static const char text[] =
        "dimension = 2; spacing = '20 mm'; gravity = (0, 0); end = 0.1;"
        "domain = { min = (-0.2, -0.2); max = (0.6, 0.6); };"
        "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.4, 0.4); };"
        "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
        "    friction_angle = '30 deg'; cohesion = '1 MPa'; }; } );"
        "walls = ( { name = 'box'; friction = 'smooth'; shape = { type = 'difference';"
        "    from = { type = 'box'; min = (-0.1, -0.1); max = (0.5, 0.4); };"
        "    minus = { type = 'box'; min = (0, 0); max = (0.4, 0.5); }; }; },"
        "  { name = 'piston'; friction = 'smooth'; shape = { type = 'box'; min = (0, 0.4); max = (0.4, 0.5); };"
        "  path = { interpolation = 'smooth'; table = ( { time = 0; }, { time = '80 ms';"
        "    translation = ('0 m', '-8 mm'); } ); }; } );"
        "probes = ( { name = 'force'; type = 'wall_force'; wall = 'piston'; direction = (0, 1); },"
        "  { name = 'elastic'; type = 'elastic_energy'; }, { name = 'balance'; type = 'energy_balance'; },"
        "  { name = 'work'; type = 'external_work'; } );"
        "output = { snapshots = 1; pictures = false; };";
    static const char *const names[] = {"piston", "force", "elastic", "balance", "work"};
    run_folder *folder = *state;
    series it;
    open_series(folder, text, names, 4, &it);
    const int64_t last = it.data.n_rows - 1;
    /* Oedometer: M = E (1 - nu) / ((1 + nu) (1 - 2 nu)) = 1.346 MPa, strain 2 %, area 0.4 m2/m; waves and half a
     * spacing at each face leave 5 %. */
    const double modulus = 1e6 * 0.7 / (1.3 * 0.4);
    assert_near(value_at(&it, last, 0), modulus * 0.02 * 0.4, 0.05 * modulus * 0.02 * 0.4);
    const double work = 0.5 * modulus * 0.02 * 0.02 * 0.16;
    assert_near(value_at(&it, last, 3), work, 0.05 * work);
    assert_near(value_at(&it, last, 1), work, 0.06 * work);
    assert_near(value_at(&it, last, 2), 1.0, 0.01); /* sampled powers, docs/theory/energy.md */
    mor_table_data_clear(&folder->context, &it.data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_block_slides_off_a_tilting_floor_at_its_angle_of_friction, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(drums_that_rotate_either_way_are_mirror_images, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_piston_on_a_path_does_the_work_that_energies_tell, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
