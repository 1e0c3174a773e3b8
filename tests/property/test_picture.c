/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/chart.h"
#include "cases/driver/picture/draw/colormap.h"
#include "cases/driver/picture/view/camera.h"
#include "cases/driver/picture/view/picture.h"
#include "tests/common/near.h"
#include "tests/common/pile.h"
#include "tests/common/run_folder.h"

#include <fenv.h>
#include <math.h>

/* Number of pixels in a row whose color is near to one given, and their mean column. */
static int count_in_row(const mor_canvas *canvas, int row, int n_columns, const int *color, double *mean)
{
    int n = 0;
    double sum = 0.0;
    for (int column = 0; column < n_columns; ++column) {
        uint8_t rgb[3];
        mor_canvas_pixel(canvas, column, row, rgb);
        if (abs(rgb[0] - color[0]) + abs(rgb[1] - color[1]) + abs(rgb[2] - color[2]) < 60) {
            n += 1;
            sum += column + 0.5;
        }
    }
    *mean = n > 0 ? sum / n : 0.0;
    return n;
}

static bool is_round(double step)
{
    const double mantissa = step / pow(10.0, floor(log10(step * (1.0 + 1e-9))));
    return fabs(mantissa - 1.0) < 1e-9 || fabs(mantissa - 2.0) < 1e-9 || fabs(mantissa - 5.0) < 1e-9;
}

static double find_mean_column(const mor_canvas *canvas, const int *color)
{
    double sum = 0.0;
    double weight = 0.0;
    for (int row = 60; row < 300; ++row) {
        double mean = 0.0;
        const int n = count_in_row(canvas, row, 640, color, &mean);
        sum += n * mean;
        weight += n;
    }
    assert_true(weight > 20.0);
    return sum / weight;
}

/* Length of a dark bar on white along a row, in px: pixels count by how dark they are. */
static double measure_ink(const mor_canvas *canvas, int row, int n_columns)
{
    uint8_t darkest = 255;
    double ink = 0.0;
    for (int column = 0; column < n_columns; ++column) {
        uint8_t rgb[3];
        mor_canvas_pixel(canvas, column, row, rgb);
        darkest = rgb[0] < darkest ? rgb[0] : darkest;
        ink += 255.0 - rgb[0];
    }
    assert_true(darkest < 60);
    return ink / (255.0 - darkest);
}

static void scale_bar_in_the_picture_measures_the_scene(void **state)
{
    run_folder *folder = *state;
    const double left[3] = {-0.3, 0.0, 0.0};
    const double right[3] = {0.2, 0.0, 0.0};
    const mor_picture_group groups[2] = {
        {.position = left, .n_particles = 1, .radius = 0.02, .color = {1.0, 0.0, 0.0}},
        {.position = right, .n_particles = 1, .radius = 0.02, .color = {0.0, 0.0, 1.0}}};
    mor_picture picture = pile_picture(groups, 2, 3);
    picture.width = 640;
    picture.height = 400;
    picture.view[1] = -1.0;
    picture.hides_ground = true;
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_picture_draw(&folder->context, &picture, &canvas), MOR_OK);
    const int red[3] = {225, 0, 0};
    const int blue[3] = {0, 0, 225};
    const double scale = (find_mean_column(canvas, blue) - find_mean_column(canvas, red)) / 0.5;
    const double n_pixels = measure_ink(canvas, 400 - 19, 640);
    const mor_camera measured = {.scale = scale};
    double expected = 0.0;
    assert_true(is_round(mor_camera_scale_bar(&measured, 260.0 * 0.4, &expected)));
    assert_true(fabs(n_pixels - expected) < 0.5); /* px: shading shifts a center by half a pixel in 555 */
    mor_canvas_free(&folder->context, &canvas);
}

static void write_picture(run_folder *folder, int n_threads, int dimension, const char *name)
{
    pile p;
    pile_fill(&p);
    pile wall = p;
    for (int i = 0; i < PILE; ++i) {
        wall.position[3 * i + 1] -= 0.3;
    }
    mor_picture_group groups[2] = {pile_group(&p), pile_group(&wall)};
    groups[1].name = "wall";
    groups[1].value = NULL;
    groups[1].style = MOR_PICTURE_GHOST;
    const mor_picture picture = pile_picture(groups, 2, dimension);
    char path[MOR_PATH_BYTES];
    folder->context.n_threads = n_threads;
    assert_int_equal(mor_picture_write(&folder->context, &picture, run_folder_file(folder, path, name)), MOR_OK);
}

static void expect_same_file(run_folder *folder, const char *a, const char *b)
{
    char path[MOR_PATH_BYTES];
    size_t n_a = 0;
    size_t n_b = 0;
    unsigned char *bytes_a = run_folder_load(run_folder_file(folder, path, a), &n_a);
    unsigned char *bytes_b = run_folder_load(run_folder_file(folder, path, b), &n_b);
    assert_true(n_a > 1000);
    assert_int_equal(n_a, n_b);
    assert_memory_equal(bytes_a, bytes_b, n_a);
    free(bytes_a);
    free(bytes_b);
}

static void pictures_do_not_depend_on_run_or_number_of_threads(void **state)
{
    run_folder *folder = *state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        write_picture(folder, 1, dimension, "one.png");
        folder->context.seed += 1;
        write_picture(folder, 1, dimension, "again.png");
        write_picture(folder, 2, dimension, "two.png");
        write_picture(folder, 3, dimension, "three.png");
        expect_same_file(folder, "one.png", "again.png");
        expect_same_file(folder, "one.png", "two.png");
        expect_same_file(folder, "one.png", "three.png");
    }
}

/* Two square pieces of 6 x 6 particles that touch, and grains below. */
static void draw_pieces(run_folder *folder, const double *part, mor_canvas **canvas)
{
    double rock[72][3];
    double sand[24][3];
    double value[24];
    for (int i = 0; i < 72; ++i) {
        rock[i][0] = 0.02 * (i % 12) + 0.01;
        rock[i][1] = 0.02 * (i / 12) + 0.05;
        rock[i][2] = 0.0;
    }
    for (int i = 0; i < 24; ++i) {
        sand[i][0] = rock[i][0];
        sand[i][1] = 0.02 * (i / 12) + 0.01;
        sand[i][2] = 0.0;
        value[i] = i;
    }
    const mor_picture_group groups[2] = {
        {.name = "soil", .position = sand[0], .n_particles = 24, .radius = 0.01, .value = value},
        {.name = "rock",
         .position = rock[0],
         .n_particles = 72,
         .radius = 0.01,
         .part = part,
         .color = {0.8, 0.7, 0.6},
         .is_piece = true}};
    mor_picture picture = pile_picture(groups, 2, 2);
    picture.width = 800;
    picture.height = 500;
    assert_int_equal(mor_picture_draw(&folder->context, &picture, canvas), MOR_OK);
}

/* Number of separate dark stretches in a row of pixels between the first and the last dark one. */
static int count_lines(const mor_canvas *canvas, int row, int n_columns)
{
    int n = 0;
    bool was_dark = false;
    for (int column = 100; column < n_columns - 130; ++column) { /* between the axes' frame and the color bar */
        uint8_t rgb[3];
        mor_canvas_pixel(canvas, column, row, rgb);
        const bool is_dark = rgb[0] < 130 && rgb[0] > rgb[2]; /* darkened stone: warm, unlike the frame */
        n += is_dark && !was_dark;
        was_dark = is_dark;
    }
    return n;
}

static void touching_pieces_are_parted_by_a_line(void **state)
{
    run_folder *folder = *state;
    double part[72];
    for (int i = 0; i < 72; ++i) {
        part[i] = i % 12 < 6 ? 0.0 : 1.0;
    }
    for (int n_parts = 1; n_parts <= 2; ++n_parts) {
        mor_canvas *canvas = NULL;
        draw_pieces(folder, n_parts == 2 ? part : NULL, &canvas);
        assert_int_equal(count_lines(canvas, 170, 800), n_parts + 1); /* a row through the middle of the rocks */
        mor_canvas_free(&folder->context, &canvas);
    }
}

static void pictures_are_drawn_with_floating_point_traps_on(void **state)
{
    run_folder *folder = *state;
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    write_picture(folder, 2, 3, "trapped.png");
    const int still_on = fegetexcept();
    fedisableexcept(FE_ALL_EXCEPT);
    assert_int_equal(still_on, FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
}

static void light_falls_from_above(void **state)
{
    run_folder *folder = *state;
    const double point[3] = {0.0, 0.0, 0.0};
    const mor_picture_group group = {.position = point, .n_particles = 1, .radius = 1.0, .color = {0.5, 0.5, 0.5}};
    mor_picture picture = pile_picture(&group, 1, 3);
    picture.view[1] = -1.0;
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_picture_draw(&folder->context, &picture, &canvas), MOR_OK);
    uint8_t upper[3];
    uint8_t lower[3];
    mor_canvas_pixel(canvas, 90, 45, upper);
    mor_canvas_pixel(canvas, 90, 112, lower);
    assert_true(upper[0] > lower[0] + 20);
    assert_in_range(upper[0], 110, 145); /* near the color given, 128, so that a color bar can be read */
    mor_canvas_free(&folder->context, &canvas);
}

static bool shows_color(const mor_canvas *canvas, int category)
{
    double linear[3];
    int color[3];
    mor_colormap_category(category, linear);
    for (int c = 0; c < 3; ++c) {
        color[c] = (int)(255.0 * mor_colormap_encode(linear[c]) + 0.5);
    }
    int n = 0;
    for (int row = 110; row < 580; ++row) {
        double mean = 0.0;
        n += count_in_row(canvas, row, 1000, color, &mean);
    }
    return n > 50;
}

static void charts_show_each_curve_and_refuse_gaps(void **state)
{
    run_folder *folder = *state;
    double x[40];
    double y[2][40];
    for (int k = 0; k < 40; ++k) {
        x[k] = 0.01 * k;
        y[0][k] = 2000.0 * x[k];
        y[1][k] = 500.0;
    }
    const mor_chart_series series[2] = {
        {.name = "measured", .x = x, .y = y[0], .n_points = 40, .style = MOR_CHART_POINTS},
        {.name = "computed", .x = x, .y = y[1], .n_points = 40}};
    const mor_chart chart = {.title = "Two curves",
                             .x_name = "time",
                             .x_unit = "s",
                             .y_name = "energy",
                             .y_unit = "J",
                             .series = series,
                             .n_series = 2,
                             .width = 1000,
                             .height = 625}; /* lines two pixels wide: one row of them is fully covered */
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_OK);
    assert_true(shows_color(canvas, 0) && shows_color(canvas, 1) && !shows_color(canvas, 2));
    mor_canvas_free(&folder->context, &canvas);
    y[1][5] = NAN;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "series 1 (computed): point 5"));
}

/* Whether a pixel has the color of a category. */
static bool has_color(const mor_canvas *canvas, int category, int column, int row)
{
    double linear[3];
    uint8_t rgb[3];
    int difference = 0;
    mor_colormap_category(category, linear);
    mor_canvas_pixel(canvas, column, row, rgb);
    for (int c = 0; c < 3; ++c) {
        difference += abs(rgb[c] - (int)(255.0 * mor_colormap_encode(linear[c]) + 0.5));
    }
    return difference < 12;
}

/* Middle of the dots of a category, columns, left of a column; unit px. */
static double find_dots(const mor_canvas *canvas, int category, int first, int last)
{
    double sum = 0.0;
    int n = 0;
    for (int row = 0; row < 625; ++row) {
        for (int column = first; column < last; ++column) {
            if (has_color(canvas, category, column, row)) {
                sum += column;
                n += 1;
            }
        }
    }
    assert_true(n > 10);
    return sum / n;
}

/* Rows from the first to the last that has the color of a category, between two columns; unit px. */
static int measure_height(const mor_canvas *canvas, int category, int first, int last)
{
    int rows[2] = {625, 0};
    for (int row = 0; row < 625; ++row) {
        for (int column = first; column < last; ++column) {
            if (has_color(canvas, category, column, row)) {
                rows[0] = row < rows[0] ? row : rows[0];
                rows[1] = row;
            }
        }
    }
    return rows[1] - rows[0];
}

/* Bars are as long as their intervals, and the axis holds them whole. */
static void bars_reach_from_end_to_end(void **state)
{
    run_folder *folder = *state;
    const double x[2] = {1.0, 2.0};
    const double y[2] = {1.0, 1.0};
    const double low[2] = {-8.0, 0.0};
    double high[2] = {8.0, 4.0};
    mor_chart_series series = {.x = x, .y = y, .low = low, .high = high, .n_points = 2, .style = MOR_CHART_POINTS};
    const mor_chart chart = {.series = &series, .n_series = 1, .has_margin = true, .width = 1000, .height = 625};
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_OK);
    const int long_bar = measure_height(canvas, 0, 0, 500);
    const int short_bar = measure_height(canvas, 0, 500, 1000);
    assert_true(long_bar > 350);
    assert_near(short_bar, 0.25 * long_bar, 3.0); /* the width of a line */
    mor_canvas_free(&folder->context, &canvas);
    high[1] = INFINITY;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "the bar of point 1"));
    series.high = NULL;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "it needs both, or none"));
}

/* Dots at 1, 10 and 100 are evenly spaced where the axis is logarithmic. */
static void a_logarithmic_axis_gives_decades_equal_room(void **state)
{
    run_folder *folder = *state;
    double x[3] = {1.0, 10.0, 100.0};
    const double y[3] = {1.0, 2.0, 3.0};
    const mor_chart_series series = {.x = x, .y = y, .n_points = 3, .style = MOR_CHART_POINTS};
    const mor_chart chart = {.x_name = "pressure",
                             .x_unit = "Pa",
                             .series = &series,
                             .n_series = 1,
                             .has_log_x = true,
                             .width = 1000,
                             .height = 625};
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_OK);
    const double left = find_dots(canvas, 0, 0, 300);
    const double middle = find_dots(canvas, 0, 300, 800);
    const double right = find_dots(canvas, 0, 800, 1000);
    assert_true(right - left > 700.0);
    assert_near(middle, 0.5 * (left + right), 1.0); /* a pixel */
    mor_canvas_free(&folder->context, &canvas);
    x[1] = 0.0;
    assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "on a logarithmic axis x must be > 0"));
}

/* Lines across a chart, at both ends of its range: on the frame, or off it by 3 % of the range. */
static void a_margin_keeps_curves_off_the_frame(void **state)
{
    run_folder *folder = *state;
    static const double x[2][2] = {{1.0, 1.0}, {2.0, 2.0}};
    static const double y[2] = {0.0, 1.0};
    double place[2][2];
    mor_chart_series series[2] = {{.x = x[0], .y = y, .n_points = 2}, {.x = x[1], .y = y, .n_points = 2}};
    for (int k = 0; k < 2; ++k) {
        const mor_chart chart = {.x_unit = "Pa",
                                 .y_unit = "Pa",
                                 .series = series,
                                 .n_series = 2,
                                 .has_margin = k == 1,
                                 .width = 1000,
                                 .height = 625};
        mor_canvas *canvas = NULL;
        assert_int_equal(mor_chart_draw(&folder->context, &chart, &canvas), MOR_OK);
        place[k][0] = find_dots(canvas, 0, 0, 500);
        place[k][1] = find_dots(canvas, 1, 500, 1000);
        mor_canvas_free(&folder->context, &canvas);
    }
    const double width = (place[1][1] - place[1][0]) * 1.06;
    assert_near(place[1][0] - place[0][0], 0.03 * width, 0.03 * width); /* without it, between none and half of it */
    assert_true(place[1][0] - place[0][0] > 8.0 && place[0][1] - place[1][1] > 8.0);
}

static void long_texts_never_leave_their_place(void **state)
{
    run_folder *folder = *state;
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_canvas_new(&folder->context, &canvas, 300, 40), MOR_OK);
    const double place[2] = {20.0, 20.0};
    const mor_canvas_font font = {.size = 20.0, .anchor = MOR_CANVAS_LEFT, .limit = 100.0};
    mor_canvas_text(canvas, place, "Böschungsbruch mit Blöcken, 25° geneigt, wassergesättigt", &font);
    assert_int_equal(mor_canvas_check(&folder->context, canvas), MOR_OK);
    const int white[3] = {255, 255, 255};
    int n_beyond = 0;
    for (int row = 0; row < 40; ++row) {
        double mean = 0.0;
        n_beyond += 300 - count_in_row(canvas, row, 300, white, &mean);
        for (int column = 122; column < 300; ++column) {
            uint8_t rgb[3];
            mor_canvas_pixel(canvas, column, row, rgb);
            assert_int_equal(rgb[0], 255);
        }
    }
    assert_true(n_beyond > 100); /* something was written */
    mor_canvas_free(&folder->context, &canvas);
}

/* Of a line that others may lie over there is less: two thirds of the width, two fifths of the color. */
static void pale_line_has_less_ink_than_a_line(void **state)
{
    (void)state;
    static const double x[2] = {0.0, 1.0};
    static const double y[2] = {0.13, 0.87}; /* across the lines of the grid */
    static const mor_chart_style styles[2] = {MOR_CHART_LINE, MOR_CHART_PALE};
    mor_context context;
    double ink[2] = {0.0, 0.0};
    mor_context_init(&context);
    for (int k = 0; k < 2; ++k) {
        const mor_chart_series series = {.x = x, .y = y, .n_points = 2, .style = styles[k]};
        const mor_chart chart = {.series = &series, .n_series = 1, .width = 640, .height = 400};
        mor_canvas *canvas = NULL;
        assert_int_equal(mor_chart_draw(&context, &chart, &canvas), MOR_OK);
        for (int row = 60; row < 300; ++row) {
            for (int column = 120; column < 600; ++column) {
                uint8_t rgb[3];
                mor_canvas_pixel(canvas, column, row, rgb);
                ink[k] += abs(rgb[0] - rgb[2]); /* the grid is gray, the line blue */
            }
        }
        mor_canvas_free(&context, &canvas);
    }
    const double share = 0.4 * 2.0 / 3.2;
    assert_true(ink[1] > 0.0 && fabs(ink[1] / ink[0] - share) < 0.2 * share); /* edges are blended in sRGB */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pale_line_has_less_ink_than_a_line),
        cmocka_unit_test_setup_teardown(scale_bar_in_the_picture_measures_the_scene, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(pictures_do_not_depend_on_run_or_number_of_threads, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(touching_pieces_are_parted_by_a_line, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(pictures_are_drawn_with_floating_point_traps_on, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(light_falls_from_above, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(charts_show_each_curve_and_refuse_gaps, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_margin_keeps_curves_off_the_frame, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(bars_reach_from_end_to_end, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_logarithmic_axis_gives_decades_equal_room, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(long_texts_never_leave_their_place, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
