/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/relax/relax_internal.h"
#include "tests/common/relax_scene.h"

/* A box of soil around a ring with a hole that is too narrow for particles. Lengths in spacings. */

enum { WIDTH = 20, HEIGHT = 16 };
#define OUTER 4.0
#define HOLE 0.7

enum { POINTS_MOST = 1000 };

typedef struct ring_scene {
    mor_context context;
    mor_shape *soil;
    mor_shape *ring;
    double positions[3 * POINTS_MOST];
    double volumes[POINTS_MOST];
    int64_t n_points;
} ring_scene;

static void open_scene(ring_scene *it)
{
    const double minimum[3] = {0.0, 0.0, -INFINITY};
    const double maximum[3] = {WIDTH, HEIGHT, INFINITY};
    const double center[3] = {0.5 * WIDTH, 0.5 * HEIGHT + 0.5, 0.0}; /* between two nodes of the starting lattice */
    mor_shape *disc = NULL;
    mor_shape *hole = NULL;
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    assert_int_equal(mor_shape_new_box(&it->context, minimum, maximum, &it->soil), MOR_OK);
    assert_int_equal(mor_shape_new_sphere(&it->context, center, OUTER, &disc), MOR_OK);
    assert_int_equal(mor_shape_new_sphere(&it->context, center, HOLE, &hole), MOR_OK);
    assert_int_equal(mor_shape_new_difference(&it->context, &disc, &hole, &it->ring), MOR_OK);
    /* Four to a cell, so that they fit the curved faces. */
    for (int k = 0; k < 4 * WIDTH * HEIGHT; ++k) {
        const double point[3] = {0.25 + 0.5 * (k % (2 * WIDTH)), 0.25 + 0.5 * (k / (2 * WIDTH)), 0.0};
        if (mor_shape_distance(it->ring, point) < 0.0) {
            memcpy(it->positions + 3 * it->n_points, point, sizeof point);
            it->volumes[it->n_points++] = 0.25;
        }
    }
}

static void close_scene(ring_scene *it)
{
    mor_shape_free(&it->context, &it->ring);
    mor_shape_free(&it->context, &it->soil);
    assert_int_equal(it->context.memory_bytes, 0);
}

static void find_nearest(const double *x, int64_t n, int64_t i, double *nearest)
{
    *nearest = INFINITY;
    for (int64_t j = 0; j < n; ++j) {
        const double d[2] = {x[j] - x[i], x[n + j] - x[n + i]};
        *nearest = j == i ? *nearest : fmin(*nearest, hypot(d[0], d[1]));
    }
}

/* Particles of a lattice fill all of the box but one place, where the trapped one belongs. */
static void trapped_particle_goes_where_there_is_room(void **state)
{
    ring_scene *it = *state;
    enum { N = WIDTH * HEIGHT };
    static double x[3 * POINTS_MOST];
    const int64_t counts[1] = {N};
    const int64_t missing = 3 * WIDTH + 3; /* at (3.5, 3.5), outside the ring */
    const mor_shape *const solids[] = {it->ring};
    const mor_relax_around around = {.counts = counts, .solids = solids, .n_solids = 1};
    mor_relax_request request = new_relax_request(it->soil, 2, 1.0);
    mor_relax_frame frame;
    request.around = &around;
    assert_int_equal(mor_relax_frame_init(&it->context, &request, &frame), MOR_OK);
    for (int64_t i = 0; i < N; ++i) {
        x[i] = (double)(i % WIDTH) + 0.5 - frame.middle[0];
        x[N + i] = (double)(i / WIDTH) + 0.5 - frame.middle[1];
        x[2 * N + i] = 0.0;
    }
    x[missing] = 0.0; /* in the hole, beside another */
    x[N + missing] = 0.3;
    assert_true(mor_relax_frame_make_room(&frame, 0, missing, x, N));
    const double place[3] = {x[missing], x[N + missing], 0.0};
    double nearest;
    find_nearest(x, N, missing, &nearest);
    assert_true(mor_relax_frame_depth(&frame, place) > 1.0);
    assert_true(mor_relax_frame_clearance(&frame, place, 2.0) >= 1.0);
    /* Of the places in a square lattice a share of 1 - pi / 4 is farther than 0.5 from all nodes: of 64 none is with a
     * chance of 2e-7. */
    assert_true(nearest > 0.5);
    mor_relax_frame_free(&it->context, &frame);
}

static mor_status relax_ring(ring_scene *it, mor_relax_points *points)
{
    const double ring = MOR_PI * (OUTER * OUTER - HOLE * HOLE);
    const int64_t count = (int64_t)floor(WIDTH * HEIGHT - ring + 0.5);
    const mor_shape *const solids[] = {it->ring};
    const mor_relax_around around = {.counts = &count,
                                     .solids = solids,
                                     .n_solids = 1,
                                     .positions = it->positions,
                                     .volumes = it->volumes,
                                     .n_points = it->n_points};
    mor_relax_request request = new_relax_request(it->soil, 2, 1.0);
    request.around = &around;
    request.volume = WIDTH * HEIGHT - ring;
    request.most_steps = 1000;
    return mor_relax(&it->context, &request, points);
}

static void soil_around_a_ring_comes_to_rest_off_it(void **state)
{
    ring_scene *it = *state;
    mor_relax_points points;
    assert_int_equal(relax_ring(it, &points), MOR_OK);
    assert_true(points.is_converged);
    for (int64_t i = 0; i < points.n_points; ++i) {
        /* Least clearance of relaxation: a quarter of a spacing; rounding. */
        assert_true(mor_shape_distance(it->ring, points.positions + 3 * i) > 0.25 - 1e-9);
    }
    mor_relax_clear(&it->context, &points);
}

int main(void)
{
    static ring_scene scene;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(trapped_particle_goes_where_there_is_room, &scene),
        cmocka_unit_test_prestate(soil_around_a_ring_comes_to_rest_off_it, &scene),
    };
    open_scene(&scene);
    const int result = cmocka_run_group_tests(tests, NULL, NULL);
    close_scene(&scene);
    return result;
}
