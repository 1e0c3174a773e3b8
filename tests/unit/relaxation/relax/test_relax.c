/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "relaxation/relax/relax_internal.h"
#include "tests/common/relax_scene.h"

#include <stdlib.h>

static void number_of_particles_is_the_volume_and_their_volumes_add_up(void **state)
{
    mor_context context;
    mor_relax_points points;
    mor_context_init(&context);
    mor_shape *ball = new_relax_shape(&context, "ball", 0.05);
    mor_relax_request request = new_relax_request(ball, 3, 0.1);
    const double volume = 4.0 / 3.0 * MOR_PI * 0.53 * 0.53 * 0.53;
    assert_int_equal(mor_relax(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, (int64_t)floor(volume / 1e-3 + 0.5));
    /* The shape does not know its volume: that which is found is promised to 1e-5. */
    assert_true(fabs((double)points.n_points * points.volume - volume) <= 1e-5 * volume);
    mor_relax_clear(&context, &points);
    request.volume = volume;
    assert_int_equal(mor_relax(&context, &request, &points), MOR_OK);
    assert_true(fabs((double)points.n_points * points.volume - volume) <= 1e-14 * volume); /* rounding */
    mor_relax_clear(&context, &points);
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

static void lattice_in_a_plane_box_is_kept(void **state)
{
    const double minimum[3] = {0.0, 0.0, -INFINITY};
    const double maximum[3] = {30.0, 20.0, INFINITY};
    mor_context context;
    mor_relax_points points;
    mor_relax_quality quality;
    mor_shape *box = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_box(&context, minimum, maximum, &box), MOR_OK);
    const mor_relax_request request = new_relax_request(box, 2, 1.0);
    assert_int_equal(mor_relax(&context, &request, &points), MOR_OK);
    assert_true(points.is_converged);
    assert_int_equal(points.n_points, 600);
    for (int64_t i = 0; i < points.n_points; ++i) {
        const double *x = points.positions + 3 * i;
        assert_true(fabs(x[0] - floor(x[0]) - 0.5) <= 0.1); /* 0.04 outwards at the faces, and what the jitter left */
        assert_true(fabs(x[1] - floor(x[1]) - 0.5) <= 0.1); /* likewise */
        assert_true(x[2] == 0.0);
    }
    assert_int_equal(mor_relax_measure(&context, &request, points.positions, points.n_points, points.volume, &quality),
                     MOR_OK);
    assert_true(quality.spacing_deviation < 0.02); /* a lattice has 0; what is left of the jitter of 0.02 */
    mor_relax_clear(&context, &points);
    mor_shape_free(&context, &box);
    (void)state;
}

/* A square lattice has all neighbors at one spacing, its layer half a spacing deep. */
static void measures_of_a_lattice_are_those_known(void **state)
{
    enum { SIDE = 12, N = SIDE * SIDE * SIDE };
    const double zero[3] = {0.0, 0.0, 0.0};
    const double corner[3] = {SIDE * 0.5, SIDE * 0.5, SIDE * 0.5};
    static double positions[3 * N];
    mor_context context;
    mor_relax_quality quality;
    mor_shape *box = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_box(&context, zero, corner, &box), MOR_OK);
    for (int i = 0; i < N; ++i) {
        positions[3 * i] = 0.5 * (i % SIDE + 0.5);
        positions[3 * i + 1] = 0.5 * (i / SIDE % SIDE + 0.5);
        positions[3 * i + 2] = 0.5 * (i / (SIDE * SIDE) + 0.5);
    }
    const mor_relax_request request = new_relax_request(box, 3, 0.5);
    assert_int_equal(mor_relax_measure(&context, &request, positions, N, 0.125, &quality), MOR_OK);
    assert_true(fabs(quality.spacing_deviation) <= 1e-12);       /* rounding */
    assert_true(fabs(quality.nearest_mean - 1.0) <= 1e-12);      /* rounding */
    assert_true(fabs(quality.smallest_distance - 1.0) <= 1e-12); /* rounding */
    assert_true(fabs(quality.surface_depth - 0.5) <= 1e-12);     /* rounding */
    assert_true(fabs(quality.surface_deviation) <= 1e-12);       /* rounding */
    double sum = 0.0;
    for (int i = -3; i <= 3; ++i) {
        for (int j = -3; j <= 3; ++j) {
            for (int k = -3; k <= 3; ++k) {
                sum += mor_kernel_value(sqrt((double)(i * i + j * j + k * k)), 1.5, 3);
            }
        }
    }
    assert_true(fabs(quality.kernel_sum_mean - sum) <= 1e-12);          /* rounding, other order */
    assert_true(fabs(quality.kernel_sum_error - (sum - 1.0)) <= 1e-12); /* rounding, other order */
    mor_shape_free(&context, &box);
    (void)state;
}

/* The missing gradient under a plane is the kernel integrated over the plane: in space a polynomial. */
static void push_of_a_plane_is_that_known(void **state)
{
    const double minimum[3] = {-12.0, -12.0, -8.0};
    const double maximum[3] = {12.0, 12.0, 0.0};
    mor_context context;
    mor_relax_frame frame;
    mor_relax_wall wall;
    mor_shape *box = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_box(&context, minimum, maximum, &box), MOR_OK);
    const mor_relax_request request = new_relax_request(box, 3, 1.0);
    assert_int_equal(mor_relax_frame_init(&context, &request, &frame), MOR_OK);
    assert_int_equal(mor_relax_wall_init(&context, &frame, &wall), MOR_OK);
    double largest = 0.0;
    double worst[3] = {0.0, 0.0, 0.0};
    for (double depth = 0.1; depth < MOR_RELAX_SUPPORT; depth += 0.17) {
        const double place[3] = {0.31, -0.23, 4.0 - depth};
        const int n = 2000;
        double force[3];
        double known = 0.0;
        for (int k = 0; k < n; ++k) {
            const double step = (MOR_RELAX_SUPPORT - depth) / n;
            const double r = depth + (k + 0.5) * step;
            known += 2.0 * MOR_PI * r * mor_kernel_value(r, MOR_RELAX_SMOOTHING, 3) * step;
        }
        mor_relax_wall_force(&wall, place, force);
        largest = fmax(largest, known);
        worst[0] = fmax(worst[0], fabs(force[0]));
        worst[1] = fmax(worst[1], fabs(force[1]));
        worst[2] = fmax(worst[2], fabs(force[2] + known));
    }
    printf("force of a plane: %.4f at most, off by %.4f along it and %.4f, %.4f across\n", largest, worst[2], worst[0],
           worst[1]);
    assert_true(worst[0] <= 1e-3 * largest); /* the grid is not symmetric about the place */
    assert_true(worst[1] <= 1e-3 * largest); /* likewise */
    /* Linear between nodes half a spacing apart: an eighth of 0.25 times the largest curvature, 2.1 times the largest
     * force; a third of it more as the surface is spread over a cell. */
    assert_true(worst[2] <= 0.087 * largest);
    mor_relax_wall_clear(&context, &wall);
    mor_shape_free(&context, &box);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

static void rows_of_neighbors_are_those_of_all_pairs(void **state)
{
    enum { N = 300 };
    double x[3 * N];
    mor_context context;
    mor_relax_neighbors neighbors;
    mor_context_init(&context);
    for (int i = 0; i < 3 * N; ++i) {
        x[i] = 9.0 * fmod(0.754877666 * (i + 1) + 0.1 * (i / N), 1.0);
    }
    x[0] = 1e7; /* one far away: the cells must not be as many as the space is large */
    assert_int_equal(mor_relax_neighbors_init(&context, N, N, 2.9, &neighbors), MOR_OK);
    assert_int_equal(mor_relax_neighbors_find(&context, &neighbors, x), MOR_OK);
    for (int i = 0; i < N; ++i) {
        int n_near = 0;
        for (int j = 0; j < N; ++j) {
            const double way[3] = {x[i] - x[j], x[N + i] - x[N + j], x[2 * N + i] - x[2 * N + j]};
            bool is_listed = false;
            for (int32_t k = 0; k < neighbors.counts[i]; ++k) {
                is_listed |= neighbors.rows[i * neighbors.capacity + k] == j;
            }
            const bool is_near = j != i && mor_vector_dot(way, way) < 2.9 * 2.9;
            assert_int_equal(is_listed, is_near);
            n_near += is_near;
        }
        assert_int_equal(neighbors.counts[i], n_near);
        assert_int_equal(neighbors.rows[(i + 1) * neighbors.capacity - 1], i);
    }
    mor_relax_neighbors_clear(&context, &neighbors);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

/* What is asked for can end up in a grid of cells: it must not be a number that no cell has. */
static void positions_that_are_not_finite_are_refused(void **state)
{
    mor_context context;
    mor_relax_quality quality;
    mor_context_init(&context);
    mor_shape *ball = new_relax_shape(&context, "ball", 0.1);
    const mor_relax_request request = new_relax_request(ball, 3, 0.1);
    const double wrong[3] = {NAN, INFINITY, -1e308};
    for (int k = 0; k < 3; ++k) {
        const double positions[6] = {0.0, 0.0, 0.0, 0.0, wrong[k], 0.0};
        assert_int_equal(mor_relax_measure(&context, &request, positions, 2, 1e-3, &quality), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, "particle 1 along y"));
        mor_context_clear_error(&context);
    }
    const double positions[6] = {0.0, 0.0, 0.0, 0.0, 0.025, 0.0};
    assert_int_equal(mor_relax_measure(&context, &request, positions, 2, 1e-3, &quality), MOR_OK);
    assert_true(fabs(quality.smallest_distance - 0.25) <= 1e-15); /* rounding */
    assert_int_equal(mor_relax_measure(&context, &request, positions, -1, 1e-3, &quality), MOR_ERROR_ARGUMENT);
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

/* A needle's nodes sink to its axis; they start apart and end apart. */
static void starts_in_a_needle_are_apart(void **state)
{
    const double points[6] = {0.0, 0.0, 60.0, -3.0, 60.0, 3.0};
    mor_context context;
    mor_relax_frame frame;
    mor_shape *needle = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_polygon(&context, points, 3, &needle), MOR_OK);
    const mor_relax_request request = new_relax_request(needle, 2, 1.0);
    assert_int_equal(mor_relax_frame_init(&context, &request, &frame), MOR_OK);
    enum { N = 180 };
    double places[3 * N];
    assert_int_equal(mor_relax_fill(&context, &frame, 0.02, 1, N, places), MOR_OK);
    double nearest = INFINITY;
    for (int i = 0; i < N; ++i) {
        for (int j = 0; j < i; ++j) {
            nearest = fmin(nearest, hypot(places[3 * i] - places[3 * j], places[3 * i + 1] - places[3 * j + 1]));
        }
    }
    assert_true(nearest > 0.4); /* half a spacing, less the jitter of both, 0.04 along each axis, and what it bends */
    mor_shape_free(&context, &needle);
    (void)state;
}

static void refuse(mor_context *context, const mor_relax_request *request, const char *word)
{
    mor_relax_points points;
    assert_int_equal(mor_relax(context, request, &points), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context->message, word));
    assert_null(points.positions);
    assert_int_equal(points.n_points, 0);
    mor_context_clear_error(context);
}

static void wrong_requests_are_refused(void **state)
{
    const double zero[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, 1.0};
    mor_context context;
    mor_shape *half = NULL;
    mor_context_init(&context);
    mor_shape *ball = new_relax_shape(&context, "ball", 0.1);
    assert_int_equal(mor_shape_new_half_space(&context, zero, up, &half), MOR_OK);
    const mor_relax_request right = new_relax_request(ball, 3, 0.1);
    mor_relax_request request = right;
    request.shape = NULL;
    refuse(&context, &request, "no shape");
    request.shape = half;
    refuse(&context, &request, "unbounded");
    request = right;
    request.dimension = 1;
    refuse(&context, &request, "dimension");
    request = right;
    request.spacing = 0.0;
    refuse(&context, &request, "spacing");
    request.spacing = 1e-6; /* 1e19 nodes: none is visited */
    refuse(&context, &request, "larger spacing");
    request.spacing = 0.54; /* 2.12 / 0.54 = 3.9 spacings */
    refuse(&context, &request, "thick");
    request = right;
    request.volume = -1.0;
    refuse(&context, &request, "volume");
    request.volume = 1e3; /* of a ball of 5 m3 in bounds of 9.5 m3 */
    refuse(&context, &request, "volume");
    request = right;
    request.largest_residual = 1.0;
    refuse(&context, &request, "residual");
    request = right;
    request.most_steps = -1;
    refuse(&context, &request, "steps");
    mor_shape_free(&context, &ball);
    mor_shape_free(&context, &half);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

static void note_warning(void *user, mor_log_level level, const char *text)
{
    *(bool *)user |= level == MOR_LOG_WARNING && strstr(text, "stopped after 3 steps") != NULL;
}

static void stop_before_the_residual_is_told(void **state)
{
    mor_context context;
    mor_relax_points points;
    bool is_warned = false;
    mor_context_init(&context);
    context.log_sink = note_warning;
    context.log_user = &is_warned;
    mor_shape *ball = new_relax_shape(&context, "ball", 0.05);
    mor_relax_request request = new_relax_request(ball, 3, 0.1);
    request.most_steps = 3;
    assert_int_equal(mor_relax(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_steps, 3);
    assert_false(points.is_converged);
    assert_true(points.residual > request.largest_residual && isfinite(points.residual));
    assert_true(is_warned);
    mor_relax_clear(&context, &points);
    mor_shape_free(&context, &ball);
    (void)state;
}

/* Two boxes in the plane, side by side on a floor of four layers of particles. */
typedef struct neighbors_scene {
    mor_shape *left, *right, *floor;
    double positions[3 * 4 * 60], volumes[4 * 60];
    int64_t counts[2];
    const mor_shape *adjoining[1], *solids[1];
    mor_relax_around around;
    mor_relax_request request;
} neighbors_scene;

static void make_neighbors(mor_context *context, neighbors_scene *it)
{
    static const double corners[3][2][3] = {{{0.0, 0.0, -INFINITY}, {11.3, 9.0, INFINITY}},
                                            {{11.3, 0.0, -INFINITY}, {21.0, 9.0, INFINITY}},
                                            {{-20.0, -8.0, -INFINITY}, {40.0, 0.0, INFINITY}}};
    mor_shape **const shapes[3] = {&it->left, &it->right, &it->floor};
    memset(it, 0, sizeof *it);
    for (int k = 0; k < 3; ++k) {
        assert_int_equal(mor_shape_new_box(context, corners[k][0], corners[k][1], shapes[k]), MOR_OK);
    }
    for (int k = 0; k < 4 * 60; ++k) {
        it->positions[3 * k] = k % 60 - 19.5;
        it->positions[3 * k + 1] = -0.5 - k / 60;
        it->volumes[k] = 1.0;
    }
    it->counts[0] = 102; /* 11.3 x 9 */
    it->counts[1] = 87;  /* 9.7 x 9 */
    it->adjoining[0] = it->right;
    it->solids[0] = it->floor;
    it->around = (mor_relax_around){it->adjoining, 1, it->counts, it->solids, 1, it->positions, it->volumes, 4 * 60};
    it->request = new_relax_request(it->left, 2, 1.0);
    it->request.around = &it->around;
    it->request.volume = 21.0 * 9.0;
    it->request.jitter = 0.5;
}

static void free_neighbors(mor_context *context, neighbors_scene *it)
{
    mor_shape_free(context, &it->left);
    mor_shape_free(context, &it->right);
    mor_shape_free(context, &it->floor);
    assert_int_equal(context->memory_bytes, 0);
}

/* No layer is missing or doubled where they meet, and on the floor particles lie half a layer above it. */
static void adjoining_shapes_are_filled_together(void **state)
{
    mor_context context;
    mor_relax_points points;
    neighbors_scene it;
    mor_context_init(&context);
    make_neighbors(&context, &it);
    assert_int_equal(mor_relax(&context, &it.request, &points), MOR_OK);
    assert_true(points.is_converged);
    assert_int_equal(points.n_points, 189);
    double mean[2] = {0.0, 0.0};
    int n_seam = 0;
    for (int64_t i = 0; i < points.n_points; ++i) {
        const double *x = points.positions + 3 * i;
        const int part = i < it.counts[0] ? 0 : 1;
        mean[part] += x[0] / (double)it.counts[part];
        n_seam += fabs(x[0] - 11.3) < 2.0;
        assert_true(x[1] > 0.24 && x[1] < 8.56);  /* a quarter off the floor; the outer layer lies at 0.46 */
        assert_true(x[0] > 0.44 && x[0] < 20.56); /* likewise */
    }
    assert_true(fabs(mean[0] - 5.65) < 0.5 && fabs(mean[1] - 16.15) < 0.5); /* half a spacing */
    assert_true(abs(n_seam - 36) <= 5); /* 4 x 9 spacings; a row more or less of half as many on each side */
    mor_relax_clear(&context, &points);
    free_neighbors(&context, &it);
    (void)state;
}

static void wrong_surroundings_are_refused(void **state)
{
    mor_context context;
    mor_relax_points points;
    neighbors_scene it;
    mor_context_init(&context);
    make_neighbors(&context, &it);
    const mor_relax_request right = it.request;
    it.request.volume = NAN;
    assert_int_equal(mor_relax(&context, &it.request, &points), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "give that of all that is filled"));
    it.request = right;
    it.request.jitter = 0.6;
    assert_int_equal(mor_relax(&context, &it.request, &points), MOR_ERROR_ARGUMENT);
    it.request = right;
    it.request.most_steps = 20;
    assert_int_equal(mor_relax(&context, &it.request, &points), MOR_NOT_CONVERGED);
    assert_non_null(strstr(context.message, "stopped after 20 steps"));
    free_neighbors(&context, &it);
    (void)state;
}

static uint64_t hash_request(mor_relax_request request)
{
    uint64_t hash = 0;
    mor_relax_request_hash(&request, &hash);
    return hash;
}

static void hash_stands_for_all_that_decides(void **state)
{
    mor_context context;
    mor_context_init(&context);
    mor_shape *ball = new_relax_shape(&context, "ball", 0.1);
    mor_shape *same = new_relax_shape(&context, "ball", 0.1);
    const double center[3] = {0.0, 0.0, 0.0};
    mor_shape *other = NULL;
    assert_int_equal(mor_shape_new_sphere(&context, center, 1.06000001, &other), MOR_OK);
    const mor_relax_request first = new_relax_request(ball, 3, 0.1);
    mor_relax_request request = first;
    request.shape = same;
    assert_true(hash_request(request) == hash_request(first));
    request.shape = other;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.dimension = 2;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.spacing = 0.1001;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.seed = 2;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.volume = 5.0;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.most_steps += 1;
    assert_true(hash_request(request) != hash_request(first));
    request = first;
    request.jitter = 0.5;
    assert_true(hash_request(request) != hash_request(first));
    const int64_t counts[1] = {4989};
    const double place[3] = {2.0, 0.0, 0.0};
    const double one = 1.0;
    mor_relax_around around = {.counts = counts};
    request = first;
    request.around = &around;
    const uint64_t alone = hash_request(request);
    assert_true(alone != hash_request(first));
    around.positions = place;
    around.volumes = &one;
    around.n_points = 1;
    assert_true(hash_request(request) != alone);
    request = first;
    request.largest_residual = 1e-4;
    assert_true(hash_request(request) != hash_request(first));
    mor_shape_free(&context, &ball);
    mor_shape_free(&context, &same);
    mor_shape_free(&context, &other);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(number_of_particles_is_the_volume_and_their_volumes_add_up),
        cmocka_unit_test(lattice_in_a_plane_box_is_kept),
        cmocka_unit_test(measures_of_a_lattice_are_those_known),
        cmocka_unit_test(push_of_a_plane_is_that_known),
        cmocka_unit_test(rows_of_neighbors_are_those_of_all_pairs),
        cmocka_unit_test(positions_that_are_not_finite_are_refused),
        cmocka_unit_test(starts_in_a_needle_are_apart),
        cmocka_unit_test(wrong_requests_are_refused),
        cmocka_unit_test(stop_before_the_residual_is_told),
        cmocka_unit_test(adjoining_shapes_are_filled_together),
        cmocka_unit_test(wrong_surroundings_are_refused),
        cmocka_unit_test(hash_stands_for_all_that_decides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
