/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/moraine.h"
#include "tests/common/session_run.h"

#include <math.h>

/* Maps of pressure as they are written: pressures are those on the structure, whatever cells were asked for. */

/* A column at rest, 0.4 m wide and 1 m high, between smooth walls. */
static const char column[] =
    "title = 'column'; dimension = 2; spacing = '50 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '60 ms';"
    "domain = { min = ('-0.1 m', '-0.1 m'); max = ('0.5 m', '1.2 m'); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2100 kg/m3'; youngs_modulus = '15 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; initial_stress = { type = 'k0'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); };"
    "    friction = 'rough'; },"
    "  { name = 'left'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; friction = 'smooth'; },"
    "  { name = 'right'; shape = { type = 'half_space'; point = (0.4, 0); normal = (-1, 0); };"
    "    friction = 'smooth'; } );"
    "gauges = ( { name = 'coarse'; wall = 'floor'; direction = (0, -1, 0); origin = (0, 0, 0); cell = '0.3 m';"
    "    filter = '0.03 s'; region = { type = 'box'; min = (0, -0.5); max = (0.4, 0.5); }; },"
    "  { name = 'wide'; wall = 'floor'; direction = (0, -1, 0); origin = (0, 0, 0); cell = '0.25 m';"
    "    filter = '0.03 s'; region = { type = 'box'; min = (0, -0.5); max = (0.4, 0.5); }; },"
    "  { name = 'side'; wall = 'right'; direction = (1, 0, 0); origin = (0.4, 0, 0); cell = '0.3 m';"
    "    filter = '0.03 s'; region = { type = 'box'; min = (0.3, 0); max = (0.6, 0.4); }; },"
    "  { name = 'fine'; wall = 'right'; direction = (1, 0, 0); origin = (0.4, 0, 0); cell = '0.1 m';"
    "    filter = '0.03 s'; region = { type = 'box'; min = (0.3, 0); max = (0.6, 0.4); }; } );"
    "output = { snapshots = 1; pictures = true; };";

/* A ball that nothing touches: a round structure in square cells. */
static const char ball[] =
    "title = 'ball'; dimension = 3; spacing = '50 mm'; gravity = (0, 0, 0); end = '1 ms';"
    "domain = { min = (-1, -1, -1); max = (1, 1, 1); };"
    "bodies = ( { name = 'ball'; position = (0, 0, 0); shape = { type = 'sphere'; center = (0, 0, 0); radius = 0.3; };"
    "  material = { model = 'rigid'; density = 2600; }; } );"
    "gauges = ( { name = 'ball'; body = 'ball'; direction = (1, 0, 0); cell = '50 mm'; } );"
    "output = { snapshots = 1; pictures = false; };";

static mor_table_data read_map(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    char file[64];
    mor_table_data data;
    snprintf(file, sizeof file, "gauge_%s_map.csv", name);
    finished_run_file(folder, path, "run", file);
    if (mor_table_data_read(&folder->context, &data, path) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    return data;
}

/* The number in a row of the column whose name begins so. */
static double find(const mor_table_data *data, int64_t row, const char *name)
{
    const char *at = data->header;
    for (int k = 0; k < data->n_columns; ++k) {
        if (strncmp(at, name, strlen(name)) == 0) {
            return data->values[row * data->n_columns + k];
        }
        at += strcspn(at, ",");
        at += *at == ',';
    }
    fail_msg("there is no column '%s'", name);
    return NAN;
}

static void run(run_folder *folder, const char *text)
{
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, path);
    const session_run it = {.case_path = path, .name = "run", .stop_at = NAN, .n_threads = 1};
    assert_int_equal(session_run_do(folder, &it, "run"), MOR_SESSION_FINISHED);
}

static void pressure_on_a_floor_is_that_of_the_weight_whatever_the_cells(void **state)
{
    static const char *const names[] = {"coarse", "wide"};
    static const int n_cells[] = {1, 2}; /* 0.4 m over 0.3 m and 0.25 m, rounded */
    run_folder *folder = *state;
    run(folder, column);
    for (int g = 0; g < 2; ++g) {
        mor_table_data data = read_map(folder, names[g]);
        assert_int_equal(data.n_rows, n_cells[g]);
        for (int64_t row = 0; row < data.n_rows; ++row) {
            /* the column at rest is within 1 % of its weight, test_column_at_rest */
            assert_true(fabs(find(&data, row, "last_soil") / (2100.0 * 9.81 * 1.0) - 1.0) < 0.02);
            assert_true(fabs(find(&data, row, "covered") - 0.4 / n_cells[g]) < 1e-12);
        }
        mor_table_data_clear(&folder->context, &data);
    }
}

/* Of linear pressures a mean over four cells is that over one. */
static void pressure_of_a_large_cell_is_the_mean_of_small_ones(void **state)
{
    run_folder *folder = *state;
    run(folder, column);
    mor_table_data side = read_map(folder, "side");
    mor_table_data fine = read_map(folder, "fine");
    double sum = 0.0;
    assert_int_equal(side.n_rows, 1);
    assert_int_equal(fine.n_rows, 4);
    for (int64_t row = 0; row < fine.n_rows; ++row) {
        sum += find(&fine, row, "last_soil");
    }
    const double mean = sum / 4.0;
    assert_true(mean > 1000.0);
    assert_true(fabs(find(&side, 0, "last_soil") / mean - 1.0) < 1e-6); /* digits of the table */
    mor_table_data_clear(&folder->context, &side);
    mor_table_data_clear(&folder->context, &fine);
}

static void cells_beside_a_round_structure_hold_no_pressure(void **state)
{
    run_folder *folder = *state;
    double sum = 0.0;
    int n_blank = 0;
    run(folder, ball);
    mor_table_data data = read_map(folder, "ball");
    assert_int_equal(data.n_rows, 12 * 12);
    for (int64_t row = 0; row < data.n_rows; ++row) {
        const double x = fabs(find(&data, row, "across"));
        const double y = fabs(find(&data, row, "up"));
        const double covered = find(&data, row, "covered");
        const double nearest = hypot(x - 0.025, y - 0.025);
        const double farthest = hypot(x + 0.025, y + 0.025);
        assert_true(nearest < 0.29 || covered < 0.0005); /* the square has 0.0025 m2 */
        assert_true(farthest > 0.29 || fabs(covered - 0.0025) < 1e-4);
        assert_int_equal(isnan(find(&data, row, "last_soil")), covered < 0.25 * 0.0025);
        sum += covered;
        n_blank += isnan(find(&data, row, "last_soil"));
    }
    assert_true(fabs(sum / (acos(-1.0) * 0.09) - 1.0) < 0.02); /* 64 points in each cell */
    assert_true(n_blank >= 12 && n_blank % 4 == 0);
    mor_table_data_clear(&folder->context, &data);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

/* What the leak sanitizer is to ignore: Fontconfig keeps what it knows of fonts until the process ends. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(pressure_on_a_floor_is_that_of_the_weight_whatever_the_cells),
        TEST(pressure_of_a_large_cell_is_the_mean_of_small_ones),
        TEST(cells_beside_a_round_structure_hold_no_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
