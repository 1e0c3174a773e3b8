/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/shade.h"

#include "tests/common/run_folder.h"

#include <math.h>

/* Pixels on the inside of a surface take their light from shared corners: against pixels that all take samples. */

enum { WIDTH = 200, HEIGHT = 150, N_SPHERES = 12, N_BYTES = 3 * WIDTH * HEIGHT };

static float spheres[4 * N_SPHERES];
static float colors[3 * N_SPHERES];
static float rims[N_SPHERES];

/* Two rows of balls of 18 px upon a plane, seen from above at a slant; in the plane as discs. */
static mor_shade make_shade(run_folder *folder, bool is_flat, mor_scene **scene)
{
    const double slant = is_flat ? 0.0 : 0.5;
    for (int k = 0; k < N_SPHERES; ++k) {
        const float place[4] = {(float)(28.0 * (k % 6) - 70.0), (float)(30.0 * (k / 6) - 15.0),
                                is_flat ? 0.0f : (float)(-10.0 * (k / 6)), 18.0f};
        for (int a = 0; a < 4; ++a) {
            spheres[4 * k + a] = place[a];
        }
        for (int a = 0; a < 3; ++a) {
            colors[3 * k + a] = 0.2f + 0.05f * (float)((k + 3 * a) % 12);
        }
        rims[k] = 0.3f;
    }
    assert_int_equal(mor_scene_new(&folder->context, scene, spheres, N_SPHERES), MOR_OK);
    mor_shade shade = {.solid = {*scene, spheres, colors, rims},
                       .is_flat = is_flat,
                       .up = {0.0, sqrt(1.0 - slant * slant), slant},
                       .background = {1.0, 1.0, 1.0},
                       .origin = {100.0, 75.0},
                       .size = {WIDTH, HEIGHT},
                       .low = {-88.1, -33.1, -28.1},
                       .high = {88.1, 33.1, 18.1},
                       .ambient_reach = 40.0,
                       .n_samples = is_flat ? 4 : 3,
                       .n_ambient = 2};
    if (!is_flat) {
        shade.ground = (mor_shade_ground){.is_shown = true,
                                          .normal = {0.0, sqrt(0.75), 0.5},
                                          .first = {1.0, 0.0, 0.0},
                                          .second = {0.0, -0.5, sqrt(0.75)},
                                          .origin = {0.0, -36.0, 0.0},
                                          .center = {0.0, -36.0, 0.0},
                                          .radius = 300.0,
                                          .color = {0.9, 0.9, 0.9}};
    }
    return shade;
}

static void render(run_folder *folder, mor_shade shade, double least_radius, uint8_t *rgb)
{
    shade.least_radius = least_radius;
    assert_int_equal(mor_shade_render(&folder->context, &shade, rgb), MOR_OK);
}

static void compare(run_folder *folder, bool is_flat, double mean_bound, double rms_bound)
{
    static uint8_t full[N_BYTES];
    static uint8_t smooth[N_BYTES];
    mor_scene *scene = NULL;
    double sum = 0.0;
    double squares = 0.0;
    const mor_shade shade = make_shade(folder, is_flat, &scene);
    render(folder, shade, 0.0, full);
    render(folder, shade, 18.0, smooth);
    for (int k = 0; k < N_BYTES; ++k) {
        const double difference = (double)smooth[k] - (double)full[k];
        sum += difference / N_BYTES;
        squares += difference * difference / N_BYTES;
    }
    mor_scene_free(&folder->context, &scene);
    if (fabs(sum) > mean_bound || sqrt(squares) > rms_bound) {
        fail_msg("smooth pixels differ by %.3f in the mean and %.3f in the root mean square", sum, sqrt(squares));
    }
}

static void discs_look_as_if_every_pixel_took_all_samples(void **state)
{
    compare(*state, true, 0.1, 1.0); /* of 255; a rim within one pixel, sampled once instead of 16 times */
}

static void balls_look_as_if_every_pixel_took_all_samples(void **state)
{
    compare(*state, false, 0.5, 5.0); /* of 255; the noise of 18 rays to the sky: 0.64 * 255 * sqrt(p q / 18) = 4 on
                                         balls, p about a tenth */
}

static void pictures_do_not_depend_on_the_number_of_threads(void **state)
{
    run_folder *folder = *state;
    static uint8_t one[N_BYTES];
    static uint8_t three[N_BYTES];
    mor_scene *scene = NULL;
    const mor_shade shade = make_shade(folder, false, &scene);
    folder->context.n_threads = 1;
    render(folder, shade, 18.0, one);
    folder->context.n_threads = 3;
    render(folder, shade, 18.0, three);
    assert_memory_equal(one, three, sizeof one);
    mor_scene_free(&folder->context, &scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(discs_look_as_if_every_pixel_took_all_samples, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(balls_look_as_if_every_pixel_took_all_samples, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(pictures_do_not_depend_on_the_number_of_threads, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
