/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/ticks.h"
#include "cases/driver/picture/view/model.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "tests/common/full_disk.h"
#include "tests/common/pile.h"
#include "tests/common/run_folder.h"

#include <errno.h>
#include <math.h>

static double distance_between(const double *a, const double *b)
{
    const double difference[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return mor_vector_length(difference);
}

/* From linear sRGB: lightness in [0, 1] and the two color axes; Ottosson's published matrices. */
static void convert_to_oklab(const double *linear, double *oklab)
{
    const double l = cbrt(0.4122214708 * linear[0] + 0.5363325363 * linear[1] + 0.0514459929 * linear[2]);
    const double m = cbrt(0.2119034982 * linear[0] + 0.6806995451 * linear[1] + 0.1073969566 * linear[2]);
    const double s = cbrt(0.0883024619 * linear[0] + 0.2817188376 * linear[1] + 0.6299787005 * linear[2]);
    oklab[0] = 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
    oklab[1] = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
    oklab[2] = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
}

static void color_map_starts_dark_and_ends_light(void **state)
{
    (void)state;
    mor_colormap map;
    mor_colormap_init(&map);
    double color[3];
    double oklab[3];
    mor_colormap_at(&map, 0.0, color);
    convert_to_oklab(color, oklab);
    assert_true(fabs(oklab[0] - 0.30) < 1e-6); /* ten digits of the published matrices */
    assert_true(oklab[2] < -0.09);             /* blue side */
    mor_colormap_at(&map, 1.0, color);
    convert_to_oklab(color, oklab);
    assert_true(fabs(oklab[0] - 0.925) < 1e-6); /* ten digits of the published matrices */
    assert_true(oklab[2] > 0.15);               /* yellow side */
}

static void color_map_rises_in_lightness_by_steps_the_eye_sees_as_equal(void **state)
{
    (void)state;
    mor_colormap map;
    mor_colormap_init(&map);
    double previous[3] = {0.0, 0.0, 0.0};
    double smallest = 1.0;
    double largest = 0.0;
    for (int k = 0; k <= 64; ++k) {
        double color[3];
        double oklab[3];
        mor_colormap_at(&map, k / 64.0, color);
        for (int c = 0; c < 3; ++c) {
            assert_true(color[c] >= 0.0 && color[c] <= 1.0);
        }
        convert_to_oklab(color, oklab);
        if (k > 0) {
            assert_true(oklab[0] > previous[0]);
            smallest = fmin(smallest, distance_between(oklab, previous));
            largest = fmax(largest, distance_between(oklab, previous));
        }
        memcpy(previous, oklab, sizeof previous);
    }
    assert_true(largest / smallest < 1.01); /* chords of a curved path: second order in the step */
}

static void palette_colors_lie_apart(void **state)
{
    (void)state;
    for (int i = 0; i < MOR_COLORMAP_CATEGORIES; ++i) {
        for (int j = 0; j < i; ++j) {
            double color[2][3];
            double oklab[2][3];
            mor_colormap_category(i, color[0]);
            mor_colormap_category(j, color[1]);
            convert_to_oklab(color[0], oklab[0]);
            convert_to_oklab(color[1], oklab[1]);
            assert_true(distance_between(oklab[0], oklab[1]) > 0.1); /* five just noticeable differences */
        }
    }
}

static void screen_values_and_linear_light_are_inverse(void **state)
{
    (void)state;
    for (int k = 0; k <= 255; ++k) {
        const double screen = k / 255.0;
        const double back = mor_colormap_encode(mor_colormap_decode(screen));
        assert_true(fabs(back - screen) < 1e-6); /* the two branches of sRGB meet to seven digits */
    }
}

static bool is_round(double step)
{
    const double mantissa = step / pow(10.0, floor(log10(step * (1.0 + 1e-9))));
    return fabs(mantissa - 1.0) < 1e-9 || fabs(mantissa - 2.0) < 1e-9 || fabs(mantissa - 5.0) < 1e-9;
}

static void ticks_are_round_inside_the_range_and_as_many_as_allowed(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 2000; ++k) {
        const double size = pow(10.0, 16.0 * mor_random_uniform(1, k, 0) - 8.0);
        const double low = size * (4.0 * mor_random_uniform(1, k, 1) - 2.0);
        const double high = low + size * (0.1 + mor_random_uniform(1, k, 2));
        const int limit = 2 + (int)(10.0 * mor_random_uniform(1, k, 3));
        const mor_ticks ticks = mor_ticks_choose(low, high, limit);
        const double slack = 1e-8 * (high - low); /* the stated 1e-9, and rounding of values up to 20 times the range */
        assert_true(is_round(ticks.step));
        assert_in_range(ticks.n_ticks, 1, limit);
        assert_true(mor_ticks_value(&ticks, 0) >= low - slack);
        assert_true(mor_ticks_value(&ticks, ticks.n_ticks - 1) <= high + slack);
        assert_true(mor_ticks_value(&ticks, 0) - ticks.step < low + slack);
        assert_true(mor_ticks_value(&ticks, ticks.n_ticks) > high - slack);
        assert_true((limit + 3) * ticks.step > 0.3 * (high - low)); /* steps of 1, 2, 5 waste at most a factor of 2.5 */
    }
}

static void automatic_ranges_hold_the_data_and_end_round(void **state)
{
    (void)state;
    const double given[5][2] = {{0.013, 0.442}, {-3.2, -0.1}, {0.0, 0.0}, {7.0, 7.0}, {98.3, 104.9}};
    const double wanted[5][2] = {{0.0, 0.45}, {-3.25, 0.0}, {0.0, 1.0}, {3.5, 10.5}, {98.0, 105.0}};
    for (int k = 0; k < 5; ++k) {
        double low = given[k][0];
        double high = given[k][1];
        mor_ticks_round_out(&low, &high, 7);
        assert_true(fabs(low - wanted[k][0]) < 1e-12 * 105.0);  /* rounding of a product */
        assert_true(fabs(high - wanted[k][1]) < 1e-12 * 105.0); /* rounding of a product */
    }
}

static void numbers_are_written_with_the_decimals_of_their_step(void **state)
{
    (void)state;
    const double numbers[7][2] = {{0.25, 0.05},   {0.0, 0.1},  {-2.0, 0.5}, {1500.0, 500.0},
                                  {2.5e-7, 5e-8}, {0.0, 1e-7}, {3e8, 1e8}};
    const char *const texts[7] = {"0.25", "0.0", "−2.0", "1500", "2.5·10⁻⁷", "0", "3·10⁸"};
    for (int k = 0; k < 7; ++k) {
        char text[MOR_TICKS_TEXT_BYTES];
        mor_ticks_format(numbers[k][0], numbers[k][1], text);
        assert_string_equal(text, texts[k]);
    }
}

static void units_get_the_prefix_that_fits_the_values(void **state)
{
    (void)state;
    static const struct {
        const char *unit;
        double largest;
        const char *text;
        double factor;
    } cases[] = {{"Pa", 12000.0, "kPa", 1e-3},
                 {"Pa", 5.98e6, "MPa", 1e-6},
                 {"m", 0.05, "mm", 1e3},
                 {"m", 0.5, "m", 1.0},
                 {"m/s2", 0.02, "mm/s²", 1e3},
                 {"m2", 0.5, "m²", 1.0},
                 {"kg/m3", 2600.0, "kg/m³", 1.0},
                 {"1", 0.4, "–", 1.0},
                 {"1", 2e-6, "10⁻⁶", 1e6},
                 {"J", 0.0, "J", 1.0},
                 {"s", 4e4, "s", 1.0},
                 {"kg", 3e7, "10⁶ kg", 1e-6}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char text[MOR_TICKS_TEXT_BYTES];
        const double factor = mor_ticks_prefix(cases[k].unit, cases[k].largest, text);
        assert_string_equal(text, cases[k].text);
        assert_true(fabs(factor / cases[k].factor - 1.0) < 1e-15); /* a power of ten: one rounding */
    }
}

static void camera_axes_are_a_right_handed_triad_with_up_upwards(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 200; ++k) {
        double view[3];
        double up[3];
        for (uint64_t a = 0; a < 3; ++a) {
            view[a] = k == 0 ? 0.0 : mor_random_uniform(2, k, a) - 0.5;
            up[a] = k == 1 ? view[a] : mor_random_uniform(2, k, a + 3) - 0.5; /* k == 1: straight from above */
        }
        mor_camera camera;
        mor_camera_orient(&camera, view, up);
        const double *axes[3] = {camera.right, camera.up, camera.toward};
        for (int a = 0; a < 3; ++a) {
            assert_true(fabs(mor_vector_length(axes[a]) - 1.0) < 1e-14);          /* a few ulp */
            assert_true(fabs(mor_vector_dot(axes[a], axes[(a + 1) % 3])) < 1e-9); /* cancellation near overhead */
        }
        const double volume = camera.right[0] * (camera.up[1] * camera.toward[2] - camera.up[2] * camera.toward[1]) -
                              camera.right[1] * (camera.up[0] * camera.toward[2] - camera.up[2] * camera.toward[0]) +
                              camera.right[2] * (camera.up[0] * camera.toward[1] - camera.up[1] * camera.toward[0]);
        assert_true(fabs(volume - 1.0) < 1e-9);               /* cancellation near overhead */
        assert_true(mor_vector_dot(camera.up, up) >= -1e-12); /* rounding when seen from above */
    }
}

static void scale_bar_is_length_times_scale_and_fills_its_place(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 300; ++k) {
        mor_camera camera = {.scale = pow(10.0, 12.0 * mor_random_uniform(3, k, 0) - 6.0)};
        double n_pixels = 0.0;
        const double length = mor_camera_scale_bar(&camera, 260.0, &n_pixels);
        assert_true(n_pixels == length * camera.scale); /* exact: the same product */
        assert_true(is_round(length));
        assert_true(n_pixels <= 260.0 * (1.0 + 1e-12) && n_pixels >= 0.399 * 260.0); /* 2 of 5, the widest gap */
    }
}

/* Distance along a ray to the first of some spheres, by the quadratic formula. */
static int first_by_hand(const float *spheres, int n, const mor_scene_ray *ray, double *distance)
{
    int first = -1;
    *distance = ray->reach;
    for (int i = 0; i < n; ++i) {
        const double to[3] = {(double)spheres[4 * i] - ray->origin[0], (double)spheres[4 * i + 1] - ray->origin[1],
                              (double)spheres[4 * i + 2] - ray->origin[2]};
        const double along = mor_vector_dot(to, ray->direction);
        const double radius = (double)spheres[4 * i + 3];
        const double inside = along * along - mor_vector_dot(to, to) + radius * radius;
        if (inside > 0.0 && along - sqrt(inside) > 0.0 && along - sqrt(inside) < *distance) {
            *distance = along - sqrt(inside);
            first = i;
        }
    }
    return first;
}

static void rays_meet_the_sphere_that_the_quadratic_formula_finds(void **state)
{
    enum { N = 200 };
    run_folder *folder = *state;
    float *spheres = NULL;
    assert_int_equal(MOR_NEW(&folder->context, &spheres, 4 * N, "spheres"), MOR_OK);
    for (uint64_t i = 0; i < 4 * N; ++i) {
        const double random = mor_random_uniform(4, i, 0);
        spheres[i] = (float)(i % 4 == 3 ? 2.0 + 6.0 * random : 100.0 * random);
    }
    mor_scene *scene = NULL;
    assert_int_equal(mor_scene_new(&folder->context, &scene, spheres, N), MOR_OK);
    int n_hits = 0;
    for (uint64_t k = 0; k < 500; ++k) {
        const double xy[2] = {100.0 * mor_random_uniform(5, k, 0), 100.0 * mor_random_uniform(5, k, 1)};
        const mor_scene_ray ray = {{xy[0], xy[1], 200.0}, {0.0, 0.0, -1.0}, INFINITY};
        double expected = 0.0;
        double found = INFINITY;
        const int by_hand = first_by_hand(spheres, N, &ray, &expected);
        assert_int_equal(mor_scene_first(scene, &ray, &found), by_hand);
        assert_int_equal(mor_scene_is_blocked(scene, &ray), by_hand >= 0);
        assert_true(by_hand < 0 || fabs(found - expected) < 2e-2); /* single precision, worst at the rim of a sphere */
        n_hits += by_hand >= 0;
    }
    assert_in_range(n_hits, 100, 499); /* both outcomes were tried */
    mor_scene_free(&folder->context, &scene);
    MOR_FREE(&folder->context, &spheres);
}

/* Draws and expects a refusal whose message holds a text. */
static void expect_refusal(run_folder *folder, const mor_picture *picture, const char *text)
{
    mor_canvas *canvas = NULL;
    assert_int_equal(mor_picture_draw(&folder->context, picture, &canvas), MOR_ERROR_ARGUMENT);
    assert_null(canvas);
    assert_non_null(strstr(folder->context.message, text));
}

static void bad_particles_are_refused_by_group_and_number(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    mor_picture_group group = pile_group(&p);
    const mor_picture picture = pile_picture(&group, 1, 3);
    p.position[3 * 7 + 1] = NAN;
    expect_refusal(folder, &picture, "group 'soil': particle 7 is at");
    p.position[3 * 7 + 1] = 0.0;
    p.value[9] = INFINITY;
    expect_refusal(folder, &picture, "group 'soil': particle 9 has value inf");
    p.value[9] = 0.0;
    group.radius = 0.0;
    expect_refusal(folder, &picture, "radius 0 m");
    group.radius = 0.01;
    group.color[2] = 255.0;
    expect_refusal(folder, &picture, "color component 2 is 255");
    group.color[2] = 0.0;
    group.part = p.value;
    p.value[11] = 0.5;
    expect_refusal(folder, &picture, "belongs to part 0.5");
    for (int i = 0; i < PILE; ++i) {
        p.value[i] = i == 13 ? -1.0 : 0.0;
    }
    expect_refusal(folder, &picture, "particle 13 belongs to part -1");
    group.n_particles = 0;
    expect_refusal(folder, &picture, "nothing to draw");
}

static void bad_settings_are_refused_with_what_is_allowed(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    mor_picture_group group = pile_group(&p);
    const mor_picture good = pile_picture(&group, 1, 3);
    mor_picture bad = good;
    bad.dimension = 1;
    expect_refusal(folder, &bad, "it must be 2 or 3");
    bad = good;
    bad.width = 20;
    expect_refusal(folder, &bad, "from 160 to 16384");
    bad = good;
    bad.has_range = true;
    bad.range[0] = 1.0;
    expect_refusal(folder, &bad, "the color range runs from 1 to 0");
    bad = good;
    bad.has_frame = true;
    expect_refusal(folder, &bad, "the frame runs from 0 m to 0 m");
    bad = good;
    bad.title = "\xff";
    expect_refusal(folder, &bad, "UTF-8");
    bad = good;
    for (int i = 0; i < PILE; ++i) {
        memcpy(p.position + 3 * i, (const double[3]){1e11, 0.0, 0.0}, 3 * sizeof(double));
    }
    expect_refusal(folder, &bad, "too small to be resolved");
}

static void a_folder_that_is_missing_is_an_error_with_its_path(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    mor_picture_group group = pile_group(&p);
    const mor_picture picture = pile_picture(&group, 1, 2);
    assert_int_equal(mor_picture_write(&folder->context, &picture, "no/such/folder/a.png"), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "no/such/folder/a.png"));
}

static void a_full_disk_leaves_the_picture_of_before(void **state)
{
    run_folder *folder = *state;
    pile p;
    full_disk disk;
    size_t n_bytes[2];
    char path[MOR_PATH_BYTES];
    pile_fill(&p);
    mor_picture_group group = pile_group(&p);
    const mor_picture picture = pile_picture(&group, 1, 2);
    run_folder_file(folder, path, "a.png");
    assert_int_equal(mor_picture_write(&folder->context, &picture, path), MOR_OK);
    uint8_t *before = run_folder_load(path, &n_bytes[0]);
    for (rlim_t limit = 0; limit < 6000; limit += 2000) { /* all that is buffered, and more */
        full_disk_begin(&disk, limit);
        const mor_status status = mor_picture_write(&folder->context, &picture, path);
        full_disk_end(&disk);
        assert_int_equal(status, MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, strerror(EFBIG)));
    }
    uint8_t *after = run_folder_load(path, &n_bytes[1]);
    assert_true(n_bytes[0] > 6000 && n_bytes[0] == n_bytes[1] && memcmp(before, after, n_bytes[0]) == 0);
    assert_int_not_equal(access(run_folder_file(folder, path, "a.png.tmp"), F_OK), 0);
    free(before);
    free(after);
}

/* Surveys, fits and builds; the caller clears the model. */
static void build_model(run_folder *folder, const mor_picture *picture, mor_model *model)
{
    mor_colormap map;
    mor_colormap_init(&map);
    const mor_camera_rectangle view = {.width = 400.0, .height = 300.0};
    assert_int_equal(mor_model_check(&folder->context, picture), MOR_OK);
    assert_int_equal(mor_model_survey(&folder->context, picture, model), MOR_OK);
    mor_camera_fit(&model->camera, &model->extent, &view);
    assert_int_equal(mor_model_build(&folder->context, picture, &map, model), MOR_OK);
}

static void a_cut_takes_a_quarter_from_the_near_side(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    mor_picture_group groups[2] = {pile_group(&p), pile_group(&p)};
    groups[1].is_whole = true;
    mor_picture picture = pile_picture(groups, 2, 3);
    picture.view[0] = picture.view[1] = -1.0; /* quadrants fall between the lattice planes */
    for (int has_cut = 0; has_cut < 2; ++has_cut) {
        picture.has_cut = has_cut == 1;
        mor_model model;
        build_model(folder, &picture, &model);
        assert_int_equal(model.solid.n_spheres, PILE + (has_cut == 1 ? PILE * 3 / 4 : PILE));
        mor_model_clear(&folder->context, &model);
    }
}

static void a_framed_group_is_in_the_picture_and_others_do_not_move_the_camera(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    const double far_away[3] = {3.0, 0.0, 0.0}; /* m; ten times as far as the pile is wide */
    mor_picture_group groups[2] = {pile_group(&p), {.position = far_away, .n_particles = 1, .radius = 0.01}};
    mor_picture picture = pile_picture(groups, 2, 3);
    picture.has_frame = true;
    picture.frame = (mor_bounds){{-0.15, -0.15, 0.0}, {0.15, 0.15, 0.15}};
    picture.view[1] = -1.0; /* x to the right */
    mor_model with;
    mor_model without;
    assert_int_equal(mor_model_survey(&folder->context, &picture, &without), MOR_OK);
    assert_true(without.extent.maximum[0] == 0.15); /* exact: a coordinate of the frame */
    groups[1].is_framed = true;
    assert_int_equal(mor_model_survey(&folder->context, &picture, &with), MOR_OK);
    assert_true(with.extent.maximum[0] > 3.0);
    assert_true(with.extent.minimum[0] == without.extent.minimum[0]);
    mor_model_clear(&folder->context, &with);
    mor_model_clear(&folder->context, &without);
}

static void one_frame_gives_one_camera_and_one_ground(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    mor_picture_group group = pile_group(&p);
    mor_picture picture = pile_picture(&group, 1, 3);
    picture.has_frame = true;
    mor_picture_bounds_init(&picture.frame);
    for (int k = 0; k < 3 * PILE; ++k) {
        picture.frame.minimum[k % 3] = fmin(picture.frame.minimum[k % 3], p.position[k] - group.radius);
        picture.frame.maximum[k % 3] = fmax(picture.frame.maximum[k % 3], p.position[k] + group.radius);
    }
    mor_model before;
    mor_model after;
    build_model(folder, &picture, &before);
    for (int i = 0; i < PILE; ++i) {
        p.position[3 * i + 2] *= 0.5;
    }
    build_model(folder, &picture, &after);
    assert_memory_equal(&before.camera, &after.camera, sizeof before.camera);
    assert_memory_equal(before.ground.center, after.ground.center, sizeof before.ground.center);
    assert_true(before.ground.is_shown && before.grid == after.grid);
    mor_model_clear(&folder->context, &before);
    mor_model_clear(&folder->context, &after);
}

static void ground_lies_on_top_of_an_inclined_floor(void **state)
{
    (void)state;
    const double axis[3] = {0.6, 0.8, 0.0};
    double rotation[9];
    double position[3 * 900];
    mor_matrix_rotation(axis, 0.4, rotation);
    for (int i = 0; i < 900; ++i) {
        const double flat[3] = {0.1 * (i % 20), 0.1 * (i / 20 % 15), -0.1 * (i / 300) - 0.05};
        mor_matrix_apply(rotation, flat, position + 3 * i);
    }
    const mor_picture_group floor_group = {.position = position, .n_particles = 900, .radius = 0.05};
    const double up[3] = {0.0, 0.0, 1.0};
    double normal[3];
    const double level = mor_model_plane(&floor_group, up, normal);
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(normal[a] - rotation[3 * a + 2]) < 1e-12); /* rounding of sums over 900 particles */
    }
    assert_true(fabs(level) < 1e-12); /* rounding of sums over 900 particles */
}

static void color_range_leaves_out_a_runaway_particle(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    p.value[3] = 1e9;
    mor_picture_group group = pile_group(&p);
    const mor_picture picture = pile_picture(&group, 1, 3);
    mor_model model;
    assert_int_equal(mor_model_survey(&folder->context, &picture, &model), MOR_OK);
    assert_true(model.range.is_shown && model.range.has_above && !model.range.has_below);
    assert_true(model.range.low >= 0.0 && model.range.high < 130.0); /* values reach 110 */
}

static void a_field_of_zeros_has_no_color_bar(void **state)
{
    run_folder *folder = *state;
    pile p;
    pile_fill(&p);
    memset(p.value, 0, sizeof p.value);
    mor_picture_group group = pile_group(&p);
    mor_picture picture = pile_picture(&group, 1, 3);
    mor_model model;
    assert_int_equal(mor_model_survey(&folder->context, &picture, &model), MOR_OK);
    assert_false(model.range.is_shown);
    picture.has_range = true; /* one of a series, whose others have values */
    picture.range[1] = 1.0;
    assert_int_equal(mor_model_survey(&folder->context, &picture, &model), MOR_OK);
    assert_true(model.range.is_shown);
}

static void pieces_in_the_plane_lie_on_levels_of_their_own_each_upon_a_dark_copy(void **state)
{
    run_folder *folder = *state;
    const double grain[3] = {0.0, 0.0, 0.0};
    const double two[6] = {0.02, 0.0, 0.0, 0.04, 0.0, 0.0};
    const double part[2] = {0.0, 1.0};
    const mor_picture_group groups[2] = {
        {.position = two, .n_particles = 2, .radius = 0.01, .part = part, .is_piece = true},
        {.position = grain, .n_particles = 1, .radius = 0.01}};
    const mor_picture picture = pile_picture(groups, 2, 2);
    mor_model model;
    build_model(folder, &picture, &model);
    assert_int_equal(model.solid.n_spheres, 5);
    for (int k = 0; k < 2; ++k) {
        const float *copy = model.solid.spheres + 8 * k;
        const float *disc = copy + 4;
        assert_true(copy[0] == disc[0] && copy[1] == disc[1]); /* exact: the same place */
        assert_true(copy[3] >= disc[3] && copy[2] + copy[3] < disc[2] - disc[3]);
        assert_true(model.solid.color[6 * k] < 0.2f * model.solid.color[6 * k + 3]);
        assert_true(model.solid.rim[2 * k + 1] < model.solid.rim[4]);
        assert_true(copy[2] - copy[3] > (k == 0 ? model.solid.spheres[18] : disc[2 - 8]));
    }
    mor_model_clear(&folder->context, &model);
}

static void parts_of_one_color_differ_in_shade(void **state)
{
    run_folder *folder = *state;
    double position[24] = {0.0};
    double part[8];
    for (int k = 0; k < 8; ++k) {
        position[3 * k] = 0.1 * k;
        part[k] = k;
    }
    const mor_picture_group group = {
        .position = position, .n_particles = 8, .radius = 0.01, .part = part, .is_piece = true};
    const mor_picture picture = pile_picture(&group, 1, 3);
    mor_model model;
    build_model(folder, &picture, &model);
    assert_int_equal(model.solid.n_spheres, 8); /* in space a piece has no dark copy */
    for (int k = 0; k < 8; ++k) {
        const float *color = model.solid.color + 3 * k;
        assert_true(color[0] > color[1] && color[1] > color[2]); /* all of them a warm gray */
        for (int other = 0; other < k; ++other) {
            assert_true(fabsf(color[0] / model.solid.color[3 * other] - 1.0f) > 0.02f); /* the eye sees 1 to 2 % */
        }
    }
    mor_model_clear(&folder->context, &model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(color_map_starts_dark_and_ends_light),
        cmocka_unit_test(color_map_rises_in_lightness_by_steps_the_eye_sees_as_equal),
        cmocka_unit_test(palette_colors_lie_apart),
        cmocka_unit_test(screen_values_and_linear_light_are_inverse),
        cmocka_unit_test(ticks_are_round_inside_the_range_and_as_many_as_allowed),
        cmocka_unit_test(automatic_ranges_hold_the_data_and_end_round),
        cmocka_unit_test(numbers_are_written_with_the_decimals_of_their_step),
        cmocka_unit_test(units_get_the_prefix_that_fits_the_values),
        cmocka_unit_test(camera_axes_are_a_right_handed_triad_with_up_upwards),
        cmocka_unit_test(scale_bar_is_length_times_scale_and_fills_its_place),
        cmocka_unit_test_setup_teardown(rays_meet_the_sphere_that_the_quadratic_formula_finds, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(bad_particles_are_refused_by_group_and_number, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(bad_settings_are_refused_with_what_is_allowed, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_folder_that_is_missing_is_an_error_with_its_path, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_full_disk_leaves_the_picture_of_before, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_cut_takes_a_quarter_from_the_near_side, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_framed_group_is_in_the_picture_and_others_do_not_move_the_camera,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(one_frame_gives_one_camera_and_one_ground, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test(ground_lies_on_top_of_an_inclined_floor),
        cmocka_unit_test_setup_teardown(a_field_of_zeros_has_no_color_bar, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(color_range_leaves_out_a_runaway_particle, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(pieces_in_the_plane_lie_on_levels_of_their_own_each_upon_a_dark_copy,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(parts_of_one_color_differ_in_shade, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
