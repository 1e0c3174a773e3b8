/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/lattice.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* A shape that counts how often its distance is asked for. */
typedef struct counting_shape {
    mor_shape base;
    const mor_shape *inner;
    int64_t *n_calls;
} counting_shape;

static double counting_distance(const mor_shape *shape, const double *point)
{
    const counting_shape *counting = (const counting_shape *)shape;
    *counting->n_calls += 1;
    return mor_shape_distance(counting->inner, point);
}

static void counting_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    mor_shape_bounds(((const counting_shape *)shape)->inner, bounds);
}

static const mor_shape_operations counting_operations = {
    .kind = "counting", .distance = counting_distance, .bounds = counting_bounds};

/* A shape of unit bounds that is deep everywhere, so that rows are counted at a glance. */
static double abyss_distance(const mor_shape *shape, const double *point)
{
    (void)shape;
    (void)point;
    return -1e9;
}

static void abyss_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    (void)shape;
    *bounds = (mor_bounds){{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
}

static const mor_shape_operations abyss_operations = {
    .kind = "abyss", .distance = abyss_distance, .bounds = abyss_bounds};

static mor_shape *new_box(mor_context *context, double x0, double x1, double z0, double z1)
{
    const double minimum[3] = {x0, x0, z0};
    const double maximum[3] = {x1, x1, z1};
    mor_shape *box = NULL;
    assert_int_equal(mor_shape_new_box(context, minimum, maximum, &box), MOR_OK);
    return box;
}

static mor_shape *new_ball(mor_context *context, double x, double radius)
{
    const double center[3] = {x, x, x};
    mor_shape *ball = NULL;
    assert_int_equal(mor_shape_new_sphere(context, center, radius, &ball), MOR_OK);
    return ball;
}

static mor_lattice_request new_request(const mor_shape *shape, double spacing)
{
    mor_lattice_request request;
    mor_lattice_request_init(&request);
    request.shape = shape;
    request.spacing = spacing;
    return request;
}

static void box_with_faces_on_cells_is_filled_exactly_in_order(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.1; /* not a binary fraction: faces and nodes are rounded */
    mor_shape *box = new_box(&context, 0.3, 1.2, -0.7, 0.4);
    mor_lattice_request request = new_request(box, spacing);
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 9 * 9 * 11);
    int64_t i = 0;
    for (int z = -7; z < 4; ++z) {
        for (int y = 3; y < 12; ++y) {
            for (int x = 3; x < 12; ++x, ++i) {
                const double node[3] = {(x + 0.5) * spacing, (y + 0.5) * spacing, (z + 0.5) * spacing};
                assert_memory_equal(points.positions + 3 * i, node, sizeof node); /* exact: the same sum */
            }
        }
    }
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &box);
    assert_int_equal(context.memory_bytes, 0);
}

/* An annulus in the plane, of whole spacings: rings in the middle of spacings, each divided evenly. */
static void polar_lattice_fills_an_annulus_with_rings(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *annulus = NULL;
    mor_shape *parts[2] = {NULL, NULL};
    const double center[3] = {0.3, -0.2, 0.0};
    assert_int_equal(mor_shape_new_sphere(&context, center, 0.8, &parts[0]), MOR_OK);
    assert_int_equal(mor_shape_new_sphere(&context, center, 0.4, &parts[1]), MOR_OK);
    assert_int_equal(mor_shape_new_difference(&context, &parts[0], &parts[1], &annulus), MOR_OK);
    mor_lattice_request request = new_request(annulus, 0.1);
    request.dimension = 2;
    request.is_polar = true;
    memcpy(request.origin, center, sizeof center);
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    int64_t i = 0;
    for (int ring = 4; ring < 8; ++ring) {
        const double radius = 0.1 * (ring + 0.5);
        const int n = (int)lround(2.0 * M_PI * (ring + 0.5));
        for (int k = 0; k < n; ++k, ++i) {
            const double angle = 2.0 * M_PI * (k + 0.5) / n;
            assert_true(i < points.n_points);
            assert_true(fabs(points.positions[3 * i] - center[0] - radius * cos(angle)) < 1e-15);
            assert_true(fabs(points.positions[3 * i + 1] - center[1] - radius * sin(angle)) < 1e-15);
            assert_true(points.positions[3 * i + 2] == 0.0);
        }
    }
    assert_int_equal(i, points.n_points);
    mor_lattice_clear(&context, &points);
    double *shares = NULL;
    assert_int_equal(mor_lattice_fill_cells(&context, &request, &points, &shares), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "polar"));
    mor_shape_free(&context, &annulus);
    assert_int_equal(context.memory_bytes, 0);
}

static void node_on_a_surface_is_outside(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    /* Nodes at 0.05, 0.15, ...: both faces of each pair go through nodes. */
    mor_shape *box = new_box(&context, 0.05, 0.45, 0.05, 0.45);
    mor_shape *hole = new_box(&context, 0.15, 0.35, 0.15, 0.35);
    const mor_shape *excluded[1] = {hole};
    mor_lattice_request request = new_request(box, 0.1);
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 27); /* 0.15, 0.25, 0.35 each way */
    mor_lattice_clear(&context, &points);
    request.excluded = excluded;
    request.n_excluded = 1;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 26); /* the hole holds its middle only, not the nodes on its surface */
    mor_lattice_clear(&context, &points);
    for (int a = 0; a < 3; ++a) {
        request.domain.minimum[a] = 0.15;
    }
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 7); /* 0.25, 0.35 each way, less the middle */
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &hole);
    mor_shape_free(&context, &box);
}

static bool is_node_wanted(const mor_lattice_request *request, const double *node)
{
    const double tolerance = 1e-9 * request->spacing;
    const double distance = mor_shape_distance(request->shape, node);
    bool is_wanted = distance < -tolerance && distance > -request->depth + tolerance;
    for (int a = 0; a < 3; ++a) {
        is_wanted = is_wanted && node[a] > request->domain.minimum[a] + tolerance &&
                    node[a] < request->domain.maximum[a] - tolerance;
    }
    for (int i = 0; i < request->n_excluded; ++i) {
        is_wanted = is_wanted && mor_shape_distance(request->excluded[i], node) >= -tolerance;
    }
    return is_wanted;
}

/* Tests every node of a cube around everything, one by one. */
static void expect_all_wanted_nodes(mor_context *context, const mor_lattice_request *request)
{
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(context, request, &points), MOR_OK);
    int64_t n_found = 0;
    for (int z = -16; z < 16; ++z) {
        for (int y = -16; y < 16; ++y) {
            for (int x = -16; x < 16; ++x) {
                const double node[3] = {request->origin[0] + (x + 0.5) * request->spacing,
                                        request->origin[1] + (y + 0.5) * request->spacing,
                                        request->origin[2] + (z + 0.5) * request->spacing};
                if (is_node_wanted(request, node)) {
                    assert_true(n_found < points.n_points);
                    assert_memory_equal(points.positions + 3 * n_found, node, sizeof node); /* exact: same sum */
                    n_found += 1;
                }
            }
        }
    }
    assert_int_equal(points.n_points, n_found);
    assert_true(n_found > 100);
    mor_lattice_clear(context, &points);
}

static void skipping_finds_the_nodes_that_testing_each_one_finds(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double axis[3] = {1.0, 2.0, -1.0};
    const double foot[3] = {-0.7, -0.9, 0.5};
    const double outline[] = {-1.0, -1.0, 1.0, -0.8, 0.1, 0.0, 1.1, 1.2, -0.9, 0.9};
    const double normal[3] = {0.3, 0.2, 1.0};
    mor_shape *parts[2] = {NULL, NULL};
    mor_shape *both = NULL;
    mor_shape *prism = NULL;
    mor_shape *ground = NULL;
    mor_shape *hole = new_ball(&context, 0.3, 0.5);
    assert_int_equal(mor_shape_new_cylinder(&context, foot, axis, 0.45, 1.9, &parts[0]), MOR_OK);
    parts[1] = new_ball(&context, -0.1, 0.8);
    assert_int_equal(mor_shape_new_union(&context, parts, 2, &both), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, outline, 5, &prism), MOR_OK);
    assert_int_equal(mor_shape_new_half_space(&context, foot, normal, &ground), MOR_OK);
    const mor_shape *shapes[3] = {both, prism, ground};
    const mor_shape *excluded[2] = {hole, ground};
    for (int s = 0; s < 3; ++s) {
        for (int variant = 0; variant < 4; ++variant) {
            mor_lattice_request request = new_request(shapes[s], 0.1);
            request.origin[0] = 0.013;
            request.origin[2] = -0.007;
            for (int a = 0; a < 3; ++a) {
                request.domain.minimum[a] = -1.3;
                request.domain.maximum[a] = 1.4;
            }
            request.depth = variant & 1 ? 0.3 : INFINITY;
            request.excluded = excluded;
            request.n_excluded = variant & 2 ? (s == 2 ? 1 : 2) : 0;
            expect_all_wanted_nodes(&context, &request);
        }
    }
    mor_shape_free(&context, &both);
    mor_shape_free(&context, &prism);
    mor_shape_free(&context, &ground);
    mor_shape_free(&context, &hole);
    assert_int_equal(context.memory_bytes, 0);
}

static void wall_gets_as_many_layers_as_its_depth_asks(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double point[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, 1.0};
    mor_shape *ground = NULL;
    assert_int_equal(mor_shape_new_half_space(&context, point, up, &ground), MOR_OK);
    mor_lattice_request request = new_request(ground, 0.01);
    request.depth = 0.04;
    request.domain = (mor_bounds){{0.0, 0.0, -1.0}, {0.2, 0.3, 1.0}};
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 20 * 30 * 4);
    assert_true(fabs(points.positions[2] + 0.035) < 1e-15); /* rounding: the deepest layer comes first */
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &ground);
    /* Surface and greatest depth both go through nodes: neither counts, three layers are left. */
    const double node[3] = {0.0, 0.0, 0.005};
    assert_int_equal(mor_shape_new_half_space(&context, node, up, &ground), MOR_OK);
    request.shape = ground;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 20 * 30 * 3);
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &ground);
}

static void thin_wall_in_a_large_domain_costs_few_distances(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double point[3] = {0.0, 0.0, -90.0};
    const double up[3] = {0.0, 0.0, 1.0};
    mor_shape *ground = NULL;
    int64_t n_calls = 0;
    assert_int_equal(mor_shape_new_half_space(&context, point, up, &ground), MOR_OK);
    counting_shape counting = {{&counting_operations}, ground, &n_calls};
    mor_lattice_request request = new_request(&counting.base, 1.0);
    request.depth = 4.0;
    request.domain = (mor_bounds){{-100.0, -100.0, -100.0}, {100.0, 100.0, 100.0}};
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 200 * 200 * 4);
    assert_true(n_calls < 8000000 / 10); /* a tenth of the nodes, in both passes together */
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &ground);
}

static void turned_scene_is_the_image_of_the_scene(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double line[3] = {1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0};
    mor_shape *ball = new_ball(&context, 0.4, 0.5);
    mor_lattice_request request = new_request(ball, 0.11);
    request.jitter_ratio = 0.1;
    mor_lattice_points plain;
    mor_lattice_points turned;
    assert_int_equal(mor_lattice_fill(&context, &request, &plain), MOR_OK);
    mor_matrix_rotation(line, 0.9, request.rotation);
    request.translation[0] = 5.0;
    request.translation[2] = -2.0;
    assert_int_equal(mor_lattice_fill(&context, &request, &turned), MOR_OK);
    assert_int_equal(turned.n_points, plain.n_points);
    for (int64_t i = 0; i < plain.n_points; ++i) {
        double image[3];
        mor_matrix_apply(request.rotation, plain.positions + 3 * i, image);
        for (int a = 0; a < 3; ++a) {
            image[a] += request.translation[a];
        }
        assert_memory_equal(turned.positions + 3 * i, image, sizeof image); /* exact: the same operations */
    }
    mor_lattice_clear(&context, &plain);
    mor_lattice_clear(&context, &turned);
    mor_shape_free(&context, &ball);
}

static void jitter_is_bounded_and_depends_on_the_node_and_seed_only(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *small = new_box(&context, 0.0, 4.0, 0.0, 4.0);
    mor_shape *large = new_box(&context, -3.0, 6.0, -2.0, 5.0);
    mor_lattice_request request = new_request(small, 1.0);
    mor_lattice_points exact;
    mor_lattice_points moved;
    mor_lattice_points around;
    mor_lattice_points other;
    assert_int_equal(mor_lattice_fill(&context, &request, &exact), MOR_OK);
    request.jitter_ratio = 0.2;
    assert_int_equal(mor_lattice_fill(&context, &request, &moved), MOR_OK);
    request.seed = 2;
    assert_int_equal(mor_lattice_fill(&context, &request, &other), MOR_OK);
    request.seed = 1;
    request.shape = large;
    assert_int_equal(mor_lattice_fill(&context, &request, &around), MOR_OK);
    double mean = 0.0;
    double largest = 0.0;
    for (int64_t i = 0; i < exact.n_points; ++i) {
        const double *node = exact.positions + 3 * i;
        /* Index in the larger box, 9 x 9 nodes a layer. */
        const int64_t j = (int64_t)(node[0] + 3.0) + 9 * ((int64_t)(node[1] + 3.0) + 9 * (int64_t)(node[2] + 2.0));
        assert_memory_equal(moved.positions + 3 * i, around.positions + 3 * j, 3 * sizeof(double)); /* exact */
        assert_memory_not_equal(moved.positions + 3 * i, other.positions + 3 * i, 3 * sizeof(double));
        for (int a = 0; a < 3; ++a) {
            const double shift = moved.positions[3 * i + a] - node[a];
            mean += shift / (double)(3 * exact.n_points);
            largest = fmax(largest, fabs(shift));
        }
    }
    assert_true(largest < 0.2 + 1e-15 && largest > 0.19); /* 192 uniform numbers: missing the top 5 % has odds 5e-5 */
    assert_true(fabs(mean) < 0.03);                       /* 3.6 standard deviations of the mean */
    mor_lattice_clear(&context, &exact);
    mor_lattice_clear(&context, &moved);
    mor_lattice_clear(&context, &around);
    mor_lattice_clear(&context, &other);
    mor_shape_free(&context, &small);
    mor_shape_free(&context, &large);
}

static void plane_scene_gets_one_layer_at_zero(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double outline[] = {0.0, 0.0, 1.0, 0.0, 1.0, 0.5, 0.0, 0.5};
    const double axis[3] = {0.0, 0.0, 1.0};
    mor_shape *prism = NULL;
    assert_int_equal(mor_shape_new_polygon(&context, outline, 4, &prism), MOR_OK);
    mor_lattice_request request = new_request(prism, 0.1);
    request.dimension = 2;
    request.jitter_ratio = 0.3;
    request.origin[2] = 77.0; /* of no effect */
    mor_matrix_rotation(axis, 0.4, request.rotation);
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 50);
    for (int64_t i = 0; i < points.n_points; ++i) {
        assert_true(points.positions[3 * i + 2] == 0.0); /* exact */
    }
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &prism);
}

static void expect_refusal(mor_context *context, const mor_lattice_request *request, const char *word)
{
    mor_lattice_points points = {(double *)context, 9};
    const uint64_t n_allocations = context->n_allocations;
    assert_int_equal(mor_lattice_fill(context, request, &points), MOR_ERROR_ARGUMENT);
    if (strstr(context->message, word) == NULL) {
        fail_msg("'%s' does not say '%s'", context->message, word);
    }
    assert_null(points.positions);
    assert_int_equal(points.n_points, 0);
    assert_int_equal(context->n_allocations, n_allocations);
}

static void endless_or_vast_regions_are_refused_before_memory_is_asked_for(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double point[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, 1.0};
    const double oblique[3] = {1.0, 1.0, 1.0};
    mor_shape *ground = NULL;
    mor_shape *box = new_box(&context, 0.0, 1.0, 0.5, 1.0);
    assert_int_equal(mor_shape_new_half_space(&context, point, up, &ground), MOR_OK);
    const mor_lattice_request good = new_request(box, 0.1);
    mor_lattice_request request = good;
    request.shape = ground;
    expect_refusal(&context, &request, "unbounded along x");
    request.domain = (mor_bounds){{0.0, 0.0, -INFINITY}, {1.0, 1.0, INFINITY}};
    expect_refusal(&context, &request, "unbounded along z");
    mor_shape_free(&context, &ground);
    assert_int_equal(mor_shape_new_half_space(&context, point, oblique, &ground), MOR_OK);
    request = good;
    request.shape = ground;
    expect_refusal(&context, &request, "half_space");
    request = good;
    request.spacing = 1e-6; /* 1e6 x 5e5 rows */
    expect_refusal(&context, &request, "rows");
    request.spacing = 1e-12;
    expect_refusal(&context, &request, "cells");
    const mor_shape abyss = {&abyss_operations};
    request.shape = &abyss;
    request.spacing = 5e-4; /* 2000^3 = 8e9 nodes */
    expect_refusal(&context, &request, "holds more than 2147483584");
    request = good;
    request.dimension = 2;
    expect_refusal(&context, &request, "z = 0");
    mor_shape_free(&context, &ground);
    mor_shape_free(&context, &box);
}

static void wrong_requests_are_refused_by_value(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *box = new_box(&context, 0.0, 1.0, -0.5, 1.0);
    const mor_lattice_request good = new_request(box, 0.1);
    mor_lattice_request request = good;
    request.shape = NULL;
    expect_refusal(&context, &request, "no shape");
    request = good;
    request.spacing = 0.0;
    expect_refusal(&context, &request, "spacing");
    request = good;
    request.dimension = 4;
    expect_refusal(&context, &request, "4");
    request.dimension = 2;
    mor_matrix_rotation((double[]){1.0, 0.0, 0.0}, 0.1, request.rotation);
    expect_refusal(&context, &request, "about z");
    request = good;
    request.rotation[1] = 0.1;
    expect_refusal(&context, &request, "rotation");
    request = good;
    request.depth = 0.0;
    expect_refusal(&context, &request, "depth");
    request = good;
    request.jitter_ratio = 0.5;
    expect_refusal(&context, &request, "jitter");
    request = good;
    request.n_excluded = 1;
    expect_refusal(&context, &request, "excluded");
    request = good;
    request.domain.maximum[1] = -INFINITY;
    expect_refusal(&context, &request, "along y");
    request = good;
    request.origin[0] = NAN;
    expect_refusal(&context, &request, "origin");
    mor_shape_free(&context, &box);
}

static void region_without_nodes_comes_out_empty(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *box = new_box(&context, 0.01, 0.02, 0.01, 0.02);
    mor_lattice_request request = new_request(box, 0.1);
    mor_lattice_points points;
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 0);
    request.domain.minimum[2] = 5.0; /* apart from the shape */
    assert_int_equal(mor_lattice_fill(&context, &request, &points), MOR_OK);
    assert_int_equal(points.n_points, 0);
    assert_null(points.positions);
    mor_lattice_clear(&context, &points);
    mor_shape_free(&context, &box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_with_faces_on_cells_is_filled_exactly_in_order),
        cmocka_unit_test(polar_lattice_fills_an_annulus_with_rings),
        cmocka_unit_test(node_on_a_surface_is_outside),
        cmocka_unit_test(skipping_finds_the_nodes_that_testing_each_one_finds),
        cmocka_unit_test(wall_gets_as_many_layers_as_its_depth_asks),
        cmocka_unit_test(thin_wall_in_a_large_domain_costs_few_distances),
        cmocka_unit_test(turned_scene_is_the_image_of_the_scene),
        cmocka_unit_test(jitter_is_bounded_and_depends_on_the_node_and_seed_only),
        cmocka_unit_test(plane_scene_gets_one_layer_at_zero),
        cmocka_unit_test(endless_or_vast_regions_are_refused_before_memory_is_asked_for),
        cmocka_unit_test(wrong_requests_are_refused_by_value),
        cmocka_unit_test(region_without_nodes_comes_out_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
