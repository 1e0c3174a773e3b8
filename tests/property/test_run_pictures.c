/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/charts.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/picture/view/picture.h"
#include "core/geometry/shape_analytic.h"
#include "core/io/snapshot.h"
#include "core/io/summary/summary.h"
#include "tests/common/run_folder.h"

#include <math.h>
#include <sys/stat.h>

/* What the leak sanitizer is to ignore: Fontconfig, behind Cairo, keeps what it knows of fonts. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

enum { COLUMNS = 24, ROWS = 6, N_PARTICLES = COLUMNS * ROWS };
static const double spacing = 0.01; /* m */

/* A block of particles whose lower left corner is at (x, 0), moving at a speed. */
static void fill_set(run_folder *folder, mor_set *set, const char *name, double x, double speed)
{
    const uint64_t fields = 1U << MOR_FIELD_POSITION | 1U << MOR_FIELD_VELOCITY | 1U << MOR_FIELD_STRESS;
    assert_int_equal(mor_set_init(&folder->context, set, name, N_PARTICLES, fields), MOR_OK);
    for (int i = 0; i < N_PARTICLES; ++i) {
        set->data[MOR_FIELD_POSITION][3 * i] = x + spacing * (i % COLUMNS + 0.5);
        set->data[MOR_FIELD_POSITION][3 * i + 1] = spacing * (i / COLUMNS + 0.5);
        set->data[MOR_FIELD_VELOCITY][3 * i] = speed * (i % COLUMNS);
        set->data[MOR_FIELD_STRESS][6 * i] = speed * (i / COLUMNS);
    }
}

/* The upper half is body 1, the lower half body 0. */
static void add_bodies(run_folder *folder, mor_set *set)
{
    const mor_field_info info = {"body", 1, "1", MOR_FIELD_OUTPUT, "number of the body"};
    int index = 0;
    assert_int_equal(mor_set_add_field(&folder->context, set, &info, &index), MOR_OK);
    for (int i = 0; i < N_PARTICLES; ++i) {
        set->data[index][i] = i < N_PARTICLES / 2 ? 0.0 : 1.0;
    }
}

static void make_part(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    assert_int_equal(mkdir(run_folder_file(folder, path, name), 0700), 0);
}

static void write_series(run_folder *folder, int n_energies)
{
    char path[MOR_PATH_BYTES];
    FILE *file = fopen(run_folder_file(folder, path, "series.csv"), "w");
    assert_non_null(file);
    fprintf(file, "time [s],step [1],step_length [s],rate_ratio [1],depth [m]");
    for (int k = 0; k < n_energies; ++k) {
        fprintf(file, ",energy_%d [J/m]", k);
    }
    for (int row = 0; row < 3; ++row) {
        fprintf(file, "\n%d,%d,1,1,%s", row, row, row == 0 ? "nan" : "0.5");
        for (int k = 0; k < n_energies; ++k) {
            fprintf(file, ",%d", row * k);
        }
    }
    fprintf(file, "\n");
    assert_int_equal(fclose(file), 0);
}

/* Writes one snapshot of the sets and draws it; the caller frees what was printed. */
static char *render_case(run_folder *folder, const mor_case *the_case, mor_set *const *sets, int n_sets, int n_energies,
                         mor_status *status)
{
    const mor_snapshot_options options = {.is_single = false};
    mor_snapshot_writer writer;
    char *printed = NULL;
    size_t n_bytes = 0;
    make_part(folder, "snapshots");
    make_part(folder, "images");
    write_series(folder, n_energies);
    assert_int_equal(mor_snapshot_writer_init(&folder->context, &writer, folder->path, &options, -1), MOR_OK);
    assert_int_equal(mor_snapshot_writer_add(&folder->context, &writer, sets, n_sets, 0, 0.0), MOR_OK);
    mor_snapshot_writer_clear(&folder->context, &writer);
    FILE *output = open_memstream(&printed, &n_bytes);
    assert_non_null(output);
    *status = mor_pictures_render(&folder->context, the_case, folder->path, MOR_PICTURES_KEY, output);
    assert_int_equal(fclose(output), 0);
    return printed;
}

static void init_case(mor_case *the_case, int dimension, const char *color)
{
    *the_case = (mor_case){.dimension = dimension, .spacing = spacing, .title = "Pictures"};
    the_case->gravity[dimension - 1] = -9.81;
    the_case->rotation[0] = the_case->rotation[4] = the_case->rotation[8] = 1.0;
    snprintf(the_case->output.color_field, sizeof the_case->output.color_field, "%s", color);
}

static char *render(run_folder *folder, const char *color, mor_set *const *sets, int n_sets, int n_energies,
                    mor_status *status)
{
    static mor_case the_case; /* large */
    init_case(&the_case, 2, color);
    return render_case(folder, &the_case, sets, n_sets, n_energies, status);
}

static void expect_picture(run_folder *folder, const char *printed, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    free(run_folder_load(run_folder_file(folder, path, name), &n_bytes));
    assert_true(n_bytes > 5000); /* an empty plate with a title has about 4000 bytes */
    assert_non_null(strstr(printed, name));
}

static void soil_with_rocks_and_rocks_alone_are_drawn(void **state)
{
    run_folder *folder = *state;
    mor_set soil;
    mor_set rocks;
    mor_status status = MOR_OK;
    fill_set(folder, &soil, "soil", 0.0, 0.1);
    fill_set(folder, &rocks, "neo_hookean", 0.24, 0.4);
    add_bodies(folder, &rocks);
    char *printed = render(folder, "speed", (mor_set *const[]){&soil, &rocks}, 2, 2, &status);
    assert_int_equal(status, MOR_OK);
    expect_picture(folder, printed, "images/step_000000_speed.png");
    free(printed);
    mor_set_clear(&folder->context, &soil);
    mor_set_clear(&folder->context, &rocks);
}

static void without_soil_bodies_are_colored_and_those_that_cannot_be_stay_stone(void **state)
{
    run_folder *folder = *state;
    mor_set rigid;
    mor_set rocks;
    mor_status status = MOR_OK;
    fill_set(folder, &rocks, "neo_hookean", 0.0, 1e5);
    const uint64_t fields = 1U << MOR_FIELD_POSITION | 1U << MOR_FIELD_VELOCITY;
    assert_int_equal(mor_set_init(&folder->context, &rigid, "rigid", 1, fields), MOR_OK);
    char *printed = render(folder, "von_mises", (mor_set *const[]){&rigid, &rocks}, 2, 2, &status);
    assert_int_equal(status, MOR_OK);
    expect_picture(folder, printed, "images/step_000000_von_mises.png");
    free(printed);
    mor_set_clear(&folder->context, &rigid);
    mor_set_clear(&folder->context, &rocks);
}

static void a_color_that_no_set_has_is_refused_by_name(void **state)
{
    run_folder *folder = *state;
    mor_set rigid;
    mor_status status = MOR_OK;
    const uint64_t fields = 1U << MOR_FIELD_POSITION | 1U << MOR_FIELD_VELOCITY;
    assert_int_equal(mor_set_init(&folder->context, &rigid, "rigid", 1, fields), MOR_OK);
    free(render(folder, "pressure", (mor_set *const[]){&rigid}, 1, 2, &status));
    assert_int_equal(status, MOR_ERROR_CONFIG);
    assert_non_null(strstr(folder->context.message, "the bodies have no field 'stress'"));
    mor_set_clear(&folder->context, &rigid);
}

static void charts_hold_as_many_curves_as_colors_tell_apart(void **state)
{
    run_folder *folder = *state;
    mor_set rocks;
    mor_status status = MOR_OK;
    fill_set(folder, &rocks, "rigid", 0.0, 1.0);
    char *printed = render(folder, "speed", (mor_set *const[]){&rocks}, 1, 10, &status);
    assert_int_equal(status, MOR_OK);
    expect_picture(folder, printed, "images/chart_depth.png");
    expect_picture(folder, printed, "images/chart_energy_0.png");
    expect_picture(folder, printed, "images/chart_energy_8.png"); /* the ninth starts a second chart */
    assert_null(strstr(printed, "chart_energy_1.png"));
    assert_null(strstr(printed, "chart_energy_9.png"));
    free(printed);
    mor_set_clear(&folder->context, &rocks);
}

/* A depth of 0.1 m beside a run-out of 30 m would lie on the axis; 3 m is a tenth, and does not. What is zero
 * throughout fits any, and says nothing of the others. */
static void quantities_of_unlike_size_have_charts_of_their_own(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    FILE *file = fopen(run_folder_file(folder, path, "series.csv"), "w");
    assert_non_null(file);
    fprintf(file, "time [s],step [1],step_length [s],rate_ratio [1],zero [m],run_out [m],height [m],depth [m],gap [m]\n"
                  "0,0,1,1,0,0,3,0,nan\n1,1,1,1,0,30,2,-0.1,0.02\n");
    assert_int_equal(fclose(file), 0);
    make_part(folder, "images");
    assert_int_equal(mor_charts_render(&folder->context, folder->path, stdout), MOR_OK);
    assert_int_equal(access(run_folder_file(folder, path, "images/chart_zero.png"), R_OK), 0);
    assert_int_equal(access(run_folder_file(folder, path, "images/chart_depth.png"), R_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "images/chart_run_out.png"), R_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "images/chart_height.png"), R_OK), 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "images/chart_gap.png"), R_OK), 0);
}

/* Two probes of one quantity, each with a window of its own: neither hides the other. */
static void curves_of_probes_are_drawn_over_each_other_in_their_windows_alone(void **state)
{
    enum { TIMES = 5 };
    static const double times[TIMES] = {0.0, 1.0, 2.0 - 0x1p-52, 3.0 + 0x1p-51, 4.0}; /* clocks are rounded */
    static const double depths[TIMES] = {0.5, 0.5, 0.5, 0.5, 0.5};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes[2] = {0, 0};
    mor_summary_statistics statistics[2];
    for (int k = 0; k < 2; ++k) { /* all the same, so that there is no mark */
        statistics[k] = (mor_summary_statistics){.maximum = 0.5, .minimum = 0.5, .mean = 0.5, .interval = 1};
        statistics[k].n_measured = 2.0;
        statistics[k].window[0] = k == 0 ? 0.0 : 2.0;
        statistics[k].window[1] = k == 0 ? 1.0 : 3.0;
    }
    const mor_summary_result results[2] = {{"early", 0.5, "m", &statistics[0], NULL},
                                           {"late", 0.5, "m", &statistics[1], NULL}};
    const mor_summary summary = {
        .results = results, .n_results = 2, .version = "1", .commit = "", .command = "", .n_threads = 1};
    FILE *file = fopen(run_folder_file(folder, path, "series.csv"), "w");
    assert_non_null(file);
    fprintf(file, "time [s],step [1],step_length [s],rate_ratio [1],early [m],late [m]\n");
    for (int row = 0; row < TIMES; ++row) {
        fprintf(file, "%.17g,%d,1,1,%g,%g\n", times[row], row, depths[row], depths[row]);
    }
    assert_int_equal(fclose(file), 0);
    make_part(folder, "images");
    assert_int_equal(mor_summary_write(&folder->context, run_folder_file(folder, path, MOR_SUMMARY_FILE), &summary),
                     MOR_OK);
    assert_int_equal(mor_charts_render(&folder->context, folder->path, stdout), MOR_OK);
    uint8_t *drawn = run_folder_load(run_folder_file(folder, path, "images/chart_early.png"), &n_bytes[0]);
    const mor_chart_series series[4] = {
        {.x = times, .y = depths, .n_points = TIMES, .style = MOR_CHART_PALE},
        {.x = times, .y = depths, .n_points = TIMES, .style = MOR_CHART_PALE},
        {.name = "early", .x = times, .y = depths, .n_points = 2, .style = MOR_CHART_LINE, .color_of = 1},
        {.name = "late", .x = times + 2, .y = depths + 2, .n_points = 2, .style = MOR_CHART_LINE, .color_of = 2}};
    const char *const notes[] = {"Pale: outside of a probe's window."};
    const mor_chart wanted = {.title = "early, late",
                              .x_name = "time",
                              .x_unit = "s",
                              .y_unit = "m",
                              .series = series,
                              .n_series = 4,
                              .notes = notes,
                              .n_notes = 1};
    assert_int_equal(mor_picture_chart(&folder->context, &wanted, run_folder_file(folder, path, "wanted.png")), MOR_OK);
    uint8_t *expected = run_folder_load(path, &n_bytes[1]);
    assert_int_equal(n_bytes[0], n_bytes[1]);
    assert_memory_equal(drawn, expected, n_bytes[0]); /* exact: the same chart */
    free(drawn);
    free(expected);
}

/* Draws a block of soil, 0.24 m long, with one wall in the shape of a box; returns the bytes of the picture. */
static uint8_t *draw_box(run_folder *folder, const double *low, const double *high, size_t *n_bytes)
{
    static mor_case the_case; /* large */
    char path[MOR_PATH_BYTES];
    mor_set soil;
    mor_status status = MOR_OK;
    init_case(&the_case, 3, "speed");
    for (int a = 0; a < 3; ++a) {
        the_case.domain_minimum[a] = -2.0;
        the_case.domain_maximum[a] = 2.0;
    }
    the_case.n_walls = 1;
    snprintf(the_case.walls[0].name, sizeof the_case.walls[0].name, "house");
    assert_int_equal(mor_shape_new_box(&folder->context, low, high, &the_case.walls[0].shape), MOR_OK);
    fill_set(folder, &soil, "soil", 0.0, 0.1);
    char *printed = render_case(folder, &the_case, (mor_set *const[]){&soil}, 1, 2, &status);
    assert_int_equal(status, MOR_OK);
    free(printed);
    mor_set_clear(&folder->context, &soil);
    mor_shape_free(&folder->context, &the_case.walls[0].shape);
    return run_folder_load(run_folder_file(folder, path, "images/step_000000_speed.png"), n_bytes);
}

/* Whether pictures of two boxes that begin at the same corner are the same. */
static bool look_alike(run_folder *folder, const double *low, const double *high, const double *other_high)
{
    void *other = NULL;
    size_t n_bytes[2] = {0, 0};
    uint8_t *first = draw_box(folder, low, high, &n_bytes[0]);
    assert_int_equal(run_folder_setup(&other), 0);
    uint8_t *second = draw_box(other, low, other_high, &n_bytes[1]);
    const bool is_same = n_bytes[0] == n_bytes[1] && memcmp(first, second, n_bytes[0]) == 0;
    free(first);
    free(second);
    assert_int_equal(run_folder_teardown(&other), 0);
    return is_same;
}

static void a_house_far_from_the_soil_is_seen_to_its_top(void **state)
{
    const double low[3] = {0.5, 0.0, 0.0};
    const double high[3] = {0.53, 0.03, 0.1};
    const double higher[3] = {0.53, 0.03, 0.2};
    assert_false(look_alike(*state, low, high, higher));
}

static void how_far_a_floor_reaches_does_not_matter(void **state)
{
    const double low[3] = {-0.5, -0.5, -0.05};
    const double high[3] = {0.5, 0.5, 0.0};
    const double wider[3] = {1.0, 0.8, 0.0};
    assert_true(look_alike(*state, low, high, wider));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(soil_with_rocks_and_rocks_alone_are_drawn, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(without_soil_bodies_are_colored_and_those_that_cannot_be_stay_stone,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_color_that_no_set_has_is_refused_by_name, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_house_far_from_the_soil_is_seen_to_its_top, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(how_far_a_floor_reaches_does_not_matter, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(curves_of_probes_are_drawn_over_each_other_in_their_windows_alone,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(quantities_of_unlike_size_have_charts_of_their_own, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(charts_hold_as_many_curves_as_colors_tell_apart, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
