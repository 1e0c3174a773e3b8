/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { N_X = 8, N_Y = 6, N_QUERIES = 120, N_PAIRS = 20000, N_STEPS = 45, N_FACES = 4 * N_X * N_Y };

static const double thickness = 0.7;

typedef double (*height_function)(double x, double y);

static double rough_height(double x, double y)
{
    const uint64_t id = (uint64_t)(1000.0 * x + 0.5) * 100003 + (uint64_t)(1000.0 * y + 0.5);
    return mor_random_uniform(11, id, 1) - 0.2 * x;
}

static double plane_height(double x, double y)
{
    return 3.0 + 0.5 * x - 0.25 * y;
}

static double cone_height(double x, double y)
{
    return 2.0 - 0.5 * sqrt((x - 2.0) * (x - 2.0) + (y - 2.0) * (y - 2.0));
}

static mor_terrain make_terrain(mor_context *context, height_function height, int n_x, int n_y, double scale)
{
    const double cell[2] = {3.5 / (n_x - 1), 4.0 / (n_y - 1)};
    mor_terrain terrain = {.n_x = n_x, .n_y = n_y, .origin = {0.25 * scale, 0.5 * scale}};
    assert_int_equal(MOR_NEW(context, &terrain.heights, (int64_t)n_x * n_y, "heights"), MOR_OK);
    for (int n = 0; n < n_x * n_y; ++n) {
        terrain.heights[n] = scale * height(0.25 + n % n_x * cell[0], 0.5 + n / n_x * cell[1]);
    }
    terrain.cell[0] = scale * cell[0];
    terrain.cell[1] = scale * cell[1];
    return terrain;
}

static void draw_point(uint64_t id, double *point)
{
    static const double low[3] = {-0.6, -0.4, -2.0};
    static const double high[3] = {4.6, 5.2, 2.0};
    for (uint64_t a = 0; a < 3; ++a) {
        point[a] = low[a] + (high[a] - low[a]) * mor_random_uniform(5, id, a);
    }
}

static void surface_meets_the_nodes_and_continues_the_edge(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain rough = make_terrain(&context, rough_height, N_X, N_Y, 1.0);
    for (int n = 0; n < N_X * N_Y; ++n) {
        const double x = rough.origin[0] + n % N_X * rough.cell[0];
        const double y = rough.origin[1] + n / N_X * rough.cell[1];
        /* the node's share of its square is 0 or 1 to a few ulp of 10 */
        assert_true(fabs(mor_terrain_height(&rough, x, y) - rough.heights[n]) < 1e-14);
    }
    assert_true(mor_terrain_height(&rough, -7.0, 0.5) == rough.heights[0]);
    assert_true(mor_terrain_height(&rough, 99.0, 99.0) == rough.heights[N_X * N_Y - 1]);
    mor_terrain_clear(&context, &rough);
    mor_terrain plane = make_terrain(&context, plane_height, N_X, N_Y, 1.0);
    for (uint64_t id = 0; id < N_QUERIES; ++id) {
        const double x = 0.25 + 3.5 * mor_random_uniform(1, id, 0);
        const double y = 0.5 + 4.0 * mor_random_uniform(1, id, 1);
        assert_true(fabs(mor_terrain_height(&plane, x, y) - plane_height(x, y)) <
                    1e-14); /* rounding of numbers near 5 */
    }
    mor_terrain_clear(&context, &plane);
    assert_int_equal(context.memory_bytes, 0);
}

static void squares_are_cut_where_they_fold_less(void **state)
{
    (void)state;
    /* Corners lower left, lower right, upper left, upper right, and the height of the center for the smaller fold: one
     * raised corner is cut off, so that the fold joins the two corners beside it. */
    static const double squares[4][5] = {
        {0.0, 0.0, 0.0, 1.0, 0.0}, {1.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0, 0.0}, {1.0, 1.0, 0.0, 1.0, 1.0}};
    for (int k = 0; k < 4; ++k) {
        double heights[4];
        memcpy(heights, squares[k], sizeof heights);
        const mor_terrain terrain = {.heights = heights, .n_x = 2, .n_y = 2, .cell = {1.0, 1.0}};
        assert_true(mor_terrain_height(&terrain, 0.5, 0.5) == squares[k][4]);
    }
}

/* The closed surface of the ground as triangles, made without the code under test but for the cut of the squares. */
typedef struct soup {
    double faces[4 * N_FACES][3][3];
    int n;
} soup;

static void add_face(soup *all, const double *a, const double *b, const double *c)
{
    memcpy(all->faces[all->n][0], a, 3 * sizeof *a);
    memcpy(all->faces[all->n][1], b, 3 * sizeof *b);
    memcpy(all->faces[all->n++][2], c, 3 * sizeof *c);
}

static void get_node(const mor_terrain *terrain, int column, int row, double *node)
{
    node[0] = terrain->origin[0] + column * terrain->cell[0];
    node[1] = terrain->origin[1] + row * terrain->cell[1];
    node[2] = terrain->heights[row * terrain->n_x + column];
}

static void add_square(soup *all, const mor_terrain *terrain, int column, int row)
{
    double node[4][3];
    for (int k = 0; k < 4; ++k) {
        get_node(terrain, column + k % 2, row + k / 2, node[k]);
    }
    const double middle = mor_terrain_height(terrain, 0.5 * (node[0][0] + node[3][0]), 0.5 * (node[0][1] + node[3][1]));
    if (fabs(middle - 0.5 * (node[0][2] + node[3][2])) < fabs(middle - 0.5 * (node[1][2] + node[2][2]))) {
        add_face(all, node[0], node[1], node[3]);
        add_face(all, node[0], node[3], node[2]);
    } else {
        add_face(all, node[0], node[1], node[2]);
        add_face(all, node[1], node[3], node[2]);
    }
}

static void add_side(soup *all, const mor_terrain *terrain, double bottom, const int *from, const int *to)
{
    double node[4][3];
    get_node(terrain, from[0], from[1], node[0]);
    get_node(terrain, to[0], to[1], node[1]);
    memcpy(node[2], node, 2 * sizeof node[0]);
    node[2][2] = bottom;
    node[3][2] = bottom;
    add_face(all, node[0], node[1], node[2]);
    add_face(all, node[1], node[3], node[2]);
}

static void make_soup(const mor_terrain *terrain, double bottom, soup *all)
{
    all->n = 0;
    for (int column = 0; column + 1 < N_X; ++column) {
        for (int row = 0; row + 1 < N_Y; ++row) {
            add_square(all, terrain, column, row);
        }
        add_side(all, terrain, bottom, (int[]){column, 0}, (int[]){column + 1, 0});
        add_side(all, terrain, bottom, (int[]){column, N_Y - 1}, (int[]){column + 1, N_Y - 1});
    }
    for (int row = 0; row + 1 < N_Y; ++row) {
        add_side(all, terrain, bottom, (int[]){0, row}, (int[]){0, row + 1});
        add_side(all, terrain, bottom, (int[]){N_X - 1, row}, (int[]){N_X - 1, row + 1});
    }
    double corner[4][3];
    for (int k = 0; k < 4; ++k) {
        get_node(terrain, k % 2 * (N_X - 1), k / 2 * (N_Y - 1), corner[k]);
        corner[k][2] = bottom;
    }
    add_face(all, corner[0], corner[1], corner[2]);
    add_face(all, corner[1], corner[3], corner[2]);
}

/* Least distance over the points corner 0 + s * (edge to 1) + s t * (edge from 1 to 2), by nested ternary search: the
 * squared distance is convex along every line. */
static double search_line(double face[3][3], double s, const double *point)
{
    double low = 0.0;
    double high = 1.0;
    double distance2[2] = {0.0, 0.0};
    for (int step = 0; step < N_STEPS; ++step) {
        const double tries[2] = {(2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0};
        for (int k = 0; k < 2; ++k) {
            distance2[k] = 0.0;
            for (int a = 0; a < 3; ++a) {
                const double at = face[0][a] + s * (face[1][a] - face[0][a] + tries[k] * (face[2][a] - face[1][a]));
                distance2[k] += (at - point[a]) * (at - point[a]);
            }
        }
        *(distance2[0] <= distance2[1] ? &high : &low) = distance2[0] <= distance2[1] ? tries[1] : tries[0];
    }
    return fmin(distance2[0], distance2[1]);
}

static double search_face(double face[3][3], const double *point)
{
    double low = 0.0;
    double high = 1.0;
    double distance2[2] = {0.0, 0.0};
    for (int step = 0; step < N_STEPS; ++step) {
        const double tries[2] = {(2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0};
        distance2[0] = search_line(face, tries[0], point);
        distance2[1] = search_line(face, tries[1], point);
        *(distance2[0] <= distance2[1] ? &high : &low) = distance2[0] <= distance2[1] ? tries[1] : tries[0];
    }
    return sqrt(fmin(distance2[0], distance2[1]));
}

static void ground_distance_is_that_of_all_faces(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, rough_height, N_X, N_Y, 1.0);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, thickness, 100.0, &shape), MOR_OK);
    mor_bounds bounds;
    mor_shape_bounds(shape, &bounds);
    double lowest = INFINITY;
    for (int n = 0; n < N_X * N_Y; ++n) {
        lowest = fmin(lowest, terrain.heights[n]);
    }
    assert_true(bounds.minimum[2] == lowest - thickness);
    soup all;
    make_soup(&terrain, bounds.minimum[2], &all);
    int n_inside = 0;
    for (uint64_t id = 0; id < N_QUERIES; ++id) {
        double point[3];
        draw_point(id, point);
        double nearest = INFINITY;
        for (int f = 0; f < all.n; ++f) {
            nearest = fmin(nearest, search_face(all.faces[f], point));
        }
        const bool is_inside = point[0] > bounds.minimum[0] && point[0] < bounds.maximum[0] &&
                               point[1] > bounds.minimum[1] && point[1] < bounds.maximum[1] &&
                               point[2] > bounds.minimum[2] &&
                               point[2] < mor_terrain_height(&terrain, point[0], point[1]);
        n_inside += is_inside;
        const double distance = mor_shape_distance(shape, point);
        assert_true(is_inside == (distance < 0.0));
        /* 45 thirds leave 1e-8 of an edge, and a distance is flat at its least: 1e-16 over the distance, above 1e-4 */
        assert_true(fabs(fabs(distance) - nearest) < 1e-7);
    }
    assert_true(n_inside > 10 && n_inside < N_QUERIES - 10);
    mor_shape_free(&context, &shape);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void distance_from_a_slope_is_the_gap_times_the_cosine(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, plane_height, 30, 20, 1.0);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, 5.0, 0.5, &shape), MOR_OK);
    const double cosine = 1.0 / sqrt(1.0 + 0.25 + 0.0625);
    for (uint64_t id = 0; id < 1000; ++id) {
        /* the foot stays off the edges of the raster: 0.5 m below or above at most */
        const double x = 0.8 + 2.4 * mor_random_uniform(1, id, 0);
        const double y = 1.1 + 2.8 * mor_random_uniform(1, id, 1);
        const double gap = 0.98 * (mor_random_uniform(1, id, 2) - 0.5);
        const double point[3] = {x, y, plane_height(x, y) + gap};
        assert_true(fabs(mor_shape_distance(shape, point) - gap * cosine) < 1e-14); /* rounding of numbers near 5 */
    }
    mor_shape_free(&context, &shape);
    mor_terrain_clear(&context, &terrain);
}

/* Largest error of distances from a cone, away from its tip, on a grid of n x n nodes. */
static double measure_cone(mor_context *context, int n)
{
    mor_terrain terrain = make_terrain(context, cone_height, n, n, 1.0);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_terrain(context, &terrain, 5.0, 1.0, &shape), MOR_OK);
    double largest = 0.0;
    for (uint64_t id = 0; id < 2000; ++id) {
        const double angle = 2.0 * MOR_PI * mor_random_uniform(3, id, 0);
        const double radius = 0.7 + 0.5 * mor_random_uniform(3, id, 1);
        const double gap = 0.4 * (mor_random_uniform(3, id, 2) - 0.5);
        const double point[3] = {2.0 + radius * cos(angle), 2.0 + radius * sin(angle), 2.0 - 0.5 * radius + gap};
        largest = fmax(largest, fabs(mor_shape_distance(shape, point) - gap / sqrt(1.25)));
    }
    mor_shape_free(context, &shape);
    mor_terrain_clear(context, &terrain);
    return largest;
}

static void distance_from_a_cone_is_second_order_in_the_cell(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double coarse = measure_cone(&context, 41);
    const double fine = measure_cone(&context, 81);
    print_message("cone: error %.3g m with 0.1 m cells, %.3g m with 0.05 m\n", coarse, fine);
    assert_true(coarse < 0.5 * 0.1 * 0.1 * 0.5 / 0.6);       /* cell^2 / 2 times the curvature, 0.5 / radius */
    assert_true(coarse / fine > 3.4 && coarse / fine < 4.6); /* 4 for second order; sampled maxima differ by some % */
}

static void check_bound(const mor_shape *exact, const mor_shape *bounded, double reach)
{
    int n_exact = 0;
    for (uint64_t id = 0; id < N_PAIRS; ++id) {
        double a[3];
        double b[3];
        draw_point(2 * id, a);
        draw_point(2 * id + 1, b);
        for (int k = 0; k < 3 && id % 2 == 0; ++k) {
            b[k] = a[k] + 0.01 * (b[k] - a[k]); /* near pairs and far ones */
        }
        const double offset[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const double from = mor_shape_distance(bounded, a);
        /* 1e-12: rounding of a difference of numbers near 5 */
        assert_true(fabs(from - mor_shape_distance(bounded, b)) <= mor_vector_length(offset) + 1e-12);
        if (exact != NULL) {
            const double truth = mor_shape_distance(exact, a);
            assert_true((truth < 0.0) == (from < 0.0) && fabs(from) <= fabs(truth) + 1e-14); /* 1e-14: rounding */
            if (fabs(truth) < reach) {
                assert_true(from == truth);
                ++n_exact;
            }
        }
    }
    assert_true(exact == NULL || n_exact > N_PAIRS / 20);
}

static void distance_is_exact_in_reach_and_a_bound_beyond(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, rough_height, N_X, N_Y, 1.0);
    mor_shape *exact = NULL;
    mor_shape *bounded = NULL;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, thickness, 100.0, &exact), MOR_OK);
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, thickness, 0.2, &bounded), MOR_OK);
    check_bound(exact, exact, 100.0);
    check_bound(exact, bounded, 0.2);
    mor_shape_free(&context, &bounded);
    mor_shape_free(&context, &exact);
    mor_terrain_clear(&context, &terrain);
}

static const double corners[] = {1.0, 1.0, 3.0, 1.5, 3.0, 4.0, 1.5, 3.0};

static void release_is_the_layer_between_surface_and_thickness(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, rough_height, N_X, N_Y, 1.0);
    mor_shape *polygon = NULL;
    assert_int_equal(mor_shape_new_polygon(&context, corners, 4, &polygon), MOR_OK);
    for (int k = 0; k < 2; ++k) {
        const double rim = 0.4 * k;
        mor_shape *shape = NULL;
        assert_int_equal(mor_shape_new_release(&context, &terrain, corners, 4, 0.6, rim, 0.3, &shape), MOR_OK);
        mor_bounds bounds;
        mor_shape_bounds(shape, &bounds);
        int n_inside = 0;
        for (uint64_t id = 0; id < N_PAIRS; ++id) {
            double point[3];
            draw_point(id, point);
            const double depth = -mor_shape_distance(polygon, point);
            const double gap = point[2] - mor_terrain_height(&terrain, point[0], point[1]);
            const double layer = depth >= rim ? 0.6 : 0.6 * depth / rim;
            const bool is_inside = depth > 0.0 && gap > 0.0 && gap < layer;
            assert_true(is_inside == (mor_shape_distance(shape, point) < 0.0));
            for (int a = 0; a < 3 && is_inside; ++a) {
                assert_true(point[a] >= bounds.minimum[a] && point[a] <= bounds.maximum[a]);
            }
            n_inside += is_inside;
        }
        assert_true(n_inside > N_PAIRS / 100);
        check_bound(NULL, shape, 0.3);
        mor_shape_free(&context, &shape);
    }
    mor_shape_free(&context, &polygon);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void distances_scale_exactly_with_a_power_of_two(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *shapes[2][2];
    const double scales[2] = {1.0, 1024.0};
    double scaled[8];
    for (int k = 0; k < 2; ++k) {
        mor_terrain terrain = make_terrain(&context, rough_height, N_X, N_Y, scales[k]);
        for (int c = 0; c < 8; ++c) {
            scaled[c] = corners[c] * scales[k];
        }
        assert_int_equal(
            mor_shape_new_terrain(&context, &terrain, thickness * scales[k], 0.2 * scales[k], &shapes[k][0]), MOR_OK);
        assert_int_equal(mor_shape_new_release(&context, &terrain, scaled, 4, 0.6 * scales[k], 0.4 * scales[k],
                                               0.2 * scales[k], &shapes[k][1]),
                         MOR_OK);
        mor_terrain_clear(&context, &terrain);
    }
    for (uint64_t id = 0; id < N_PAIRS; ++id) {
        double point[3];
        draw_point(id, point);
        const double large[3] = {1024.0 * point[0], 1024.0 * point[1], 1024.0 * point[2]};
        for (int s = 0; s < 2; ++s) {
            assert_true(1024.0 * mor_shape_distance(shapes[0][s], point) == mor_shape_distance(shapes[1][s], large));
        }
    }
    for (int k = 0; k < 4; ++k) {
        mor_shape_free(&context, &shapes[k / 2][k % 2]);
    }
}

static void wrong_ground_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, rough_height, N_X, N_Y, 1.0);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, 0.0, 1.0, &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, 1.0, NAN, &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_release(&context, &terrain, corners, 4, 1.0, -1.0, 1.0, &shape), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_new_release(&context, &terrain, corners, 2, 1.0, 0.0, 1.0, &shape), MOR_ERROR_ARGUMENT);
    const double beside[] = {1.0, 1.0, 99.0, 1.5, 3.0, 4.0};
    assert_int_equal(mor_shape_new_release(&context, &terrain, beside, 3, 1.0, 0.0, 1.0, &shape), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "outside the terrain"));
    terrain.heights[9] = NAN;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, 1.0, 1.0, &shape), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "node (1, 1)"));
    assert_null(shape);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surface_meets_the_nodes_and_continues_the_edge),
        cmocka_unit_test(squares_are_cut_where_they_fold_less),
        cmocka_unit_test(ground_distance_is_that_of_all_faces),
        cmocka_unit_test(distance_from_a_slope_is_the_gap_times_the_cosine),
        cmocka_unit_test(distance_from_a_cone_is_second_order_in_the_cell),
        cmocka_unit_test(distance_is_exact_in_reach_and_a_bound_beyond),
        cmocka_unit_test(release_is_the_layer_between_surface_and_thickness),
        cmocka_unit_test(distances_scale_exactly_with_a_power_of_two),
        cmocka_unit_test(wrong_ground_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
