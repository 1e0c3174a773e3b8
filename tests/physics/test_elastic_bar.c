/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/body_scene.h"

/* Waves along a bar of granite run at sqrt(E/rho), in space whatever Poisson's ratio, in plane strain for nu = 0. The
 * first mode of a bar free at both ends has the period 2 L/c, of one held at an end 4 L/c.
 *
 * test_elastic_bar [N]: measures with N particles across the bar. */

static const double LENGTH = 2.0;
static const double THICKNESS = 0.1;
static const double YOUNGS = 18e9;
static const double DENSITY = 2400.0;

typedef struct bar_request {
    int dimension;
    int n_across;
    double poisson; /* 1 */
    bool is_held;   /* at x < 0 */
} bar_request;

static double mode_of(const bar_request *request, double x)
{
    return request->is_held ? sin(0.5 * MOR_PI * x / LENGTH) : cos(MOR_PI * x / LENGTH);
}

static void open_bar(body_scene *bar, const bar_request *request, double end)
{
    const double dp = THICKNESS / request->n_across;
    const double boxes[1][6] = {{request->is_held ? -4.0 * dp : 0.0, 0, 0, LENGTH, THICKNESS, THICKNESS}};
    const body_scene_request body = {.dimension = request->dimension,
                                     .spacing = dp,
                                     .boxes = boxes,
                                     .n_boxes = 1,
                                     .youngs = YOUNGS,
                                     .poisson = request->poisson,
                                     .density = DENSITY,
                                     .end = end};
    body_scene_open(bar, &body);
    const double *x0 = body_scene_reference(bar);
    for (int64_t i = 0; i < body_scene_count(bar); ++i) {
        bar->elastic.held[i] = x0[3 * i] < 0.0;
        body_scene_velocities(bar)[3 * i] = x0[3 * i] < 0.0 ? 0.0 : mode_of(request, x0[3 * i]);
    }
    body_scene_start(bar);
}

/* Period from the first two zeros of the velocity along the mode, half a period apart; s. */
static double measure(const bar_request *request)
{
    body_scene bar;
    const double end = 1.2 * (request->is_held ? 4.0 : 2.0) * LENGTH / sqrt(YOUNGS / DENSITY);
    open_bar(&bar, request, end);
    body_scene_watch watch = {0};
    double first = 0.0;
    while (watch.n_crossings < 2) {
        double sum = 0.0;
        body_scene_step(&bar, end);
        assert_true(body_scene_time(&bar) < end);
        for (int64_t i = 0; i < body_scene_count(&bar); ++i) {
            const double x = body_scene_reference(&bar)[3 * i];
            sum += body_scene_velocities(&bar)[3 * i] * (x < 0.0 ? 0.0 : mode_of(request, x));
        }
        body_scene_sample(&watch, body_scene_time(&bar), sum);
        first = watch.n_crossings == 1 ? watch.last_crossing : first;
    }
    body_scene_close(&bar);
    return 2.0 * (watch.last_crossing - first);
}

static const double FREE_PERIOD = 1.46059e-3;
static const double HELD_PERIOD = 2.92119e-3;

static void a_free_bar_in_plane_strain_rings_at_twice_its_length(void **state)
{
    (void)state;
    const double period = measure(&(bar_request){2, 5, 0.0, false});
    body_scene_expect("period", period, FREE_PERIOD, 0.02 * FREE_PERIOD); /* truncation: spacing / length, steps */
}

static void a_held_bar_in_plane_strain_rings_at_four_times_its_length(void **state)
{
    (void)state;
    const double period = measure(&(bar_request){2, 5, 0.0, true});
    body_scene_expect("period", period, HELD_PERIOD, 0.02 * HELD_PERIOD); /* truncation: spacing / length, steps */
}

static void a_bar_in_space_contracts_sideways_and_keeps_the_speed(void **state)
{
    (void)state;
    const double period = measure(&(bar_request){3, 5, 0.25, false});
    body_scene_expect("period", period, FREE_PERIOD, 0.02 * FREE_PERIOD); /* truncation: spacing / length, steps */
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        const int n_across = atoi(argv[1]);
        const double periods[3] = {measure(&(bar_request){2, n_across, 0.0, false}),
                                   measure(&(bar_request){2, n_across, 0.0, true}),
                                   measure(&(bar_request){3, n_across, 0.25, false})};
        printf("%d across: free %+.2f %%, held %+.2f %%, free in space %+.2f %%\n", n_across,
               100.0 * (periods[0] / FREE_PERIOD - 1.0), 100.0 * (periods[1] / HELD_PERIOD - 1.0),
               100.0 * (periods[2] / FREE_PERIOD - 1.0));
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_free_bar_in_plane_strain_rings_at_twice_its_length),
        cmocka_unit_test(a_held_bar_in_plane_strain_rings_at_four_times_its_length),
        cmocka_unit_test(a_bar_in_space_contracts_sideways_and_keeps_the_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
