/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a picture costs, counted in rays, because times depend on the machine. The linker puts the functions of this
 * file in front of those of the scene (--wrap). */
#include "cases/driver/picture/view/picture.h"
#include "cases/driver/picture/view/scene.h"
#include "tests/common/run_folder.h"

static long long n_first;
static long long n_blocked;

int64_t __real_mor_scene_first(const mor_scene *scene, const mor_scene_ray *ray, double *distance);
int64_t __wrap_mor_scene_first(const mor_scene *scene, const mor_scene_ray *ray, double *distance);
bool __real_mor_scene_is_blocked(const mor_scene *scene, const mor_scene_ray *ray);
bool __wrap_mor_scene_is_blocked(const mor_scene *scene, const mor_scene_ray *ray);

int64_t __wrap_mor_scene_first(const mor_scene *scene, const mor_scene_ray *ray, double *distance)
{
    n_first += 1;
    return __real_mor_scene_first(scene, ray, distance);
}

bool __wrap_mor_scene_is_blocked(const mor_scene *scene, const mor_scene_ray *ray)
{
    n_blocked += 1;
    return __real_mor_scene_is_blocked(scene, ray);
}

/* What the leak sanitizer is to ignore: Fontconfig, behind Cairo, keeps what it knows of fonts. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

enum { ALONG = 5, HIGH = 4, N_BALLS = ALONG * ALONG * HIGH, WIDTH = 800, HEIGHT = 500 };

/* A hundred balls on a floor, as a first small run shows them. */
static mor_canvas *draw_balls(run_folder *folder, int dimension)
{
    double position[3 * N_BALLS];
    for (int i = 0; i < N_BALLS; ++i) {
        position[3 * i] = 0.1 * (i % ALONG);
        position[3 * i + 1] = 0.1 * (i / ALONG % ALONG);
        position[3 * i + 2] = dimension == 3 ? 0.1 * (i / (ALONG * ALONG)) : 0.0;
    }
    const mor_picture_group group = {.name = "soil", .position = position, .n_particles = N_BALLS, .radius = 0.05};
    const mor_picture picture = {
        .dimension = dimension, .groups = &group, .n_groups = 1, .width = WIDTH, .height = HEIGHT};
    mor_canvas *canvas = NULL;
    folder->context.n_threads = 1; /* the counters are for one */
    n_first = n_blocked = 0;
    assert_int_equal(mor_picture_draw(&folder->context, &picture, &canvas), MOR_OK);
    return canvas;
}

/* A corner of pixels asks what is seen there, and where something is lit sends two rays to the sky and one to the lamp;
 * only pixels with an edge in them take nine samples. If every pixel did, there would be nine rays to what is seen in
 * each that shows a ball. */
static void a_small_picture_sends_few_rays(void **state)
{
    run_folder *folder = *state;
    mor_canvas *canvas = draw_balls(folder, 3);
    mor_canvas_free(&folder->context, &canvas);
    const double first = (double)n_first / (WIDTH * HEIGHT);
    const double blocked = (double)n_blocked / (WIDTH * HEIGHT);
    print_message("rays of a pixel: %.3g to what is seen, %.3g to the light\n", first, blocked);
    assert_true(first > 0.1 && first < 1.0);
    assert_true(blocked > 0.1 && blocked < 3.0);
}

/* In the plane nothing throws a shadow. */
static void a_plane_picture_sends_no_rays_to_the_light(void **state)
{
    run_folder *folder = *state;
    mor_canvas *canvas = draw_balls(folder, 2);
    mor_canvas_free(&folder->context, &canvas);
    assert_int_equal(n_blocked, 0);
    assert_true(n_first > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_small_picture_sends_few_rays, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_plane_picture_sends_no_rays_to_the_light, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
