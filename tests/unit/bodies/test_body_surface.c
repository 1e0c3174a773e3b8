/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body_surface.h"
#include "tests/common/contact_scene.h"

static const double SPACING = 0.01;

static void open_one(contact_scene *scene, const contact_scene_body *body, int dimension)
{
    const contact_scene_request request = {.dimension = dimension,
                                           .spacing = SPACING,
                                           .bodies = body,
                                           .n_bodies = 1,
                                           .law = {0.0, 1.0},
                                           .modulus = 1.0e7,
                                           .poisson = 0.3,
                                           .density = 1000.0,
                                           .damping_factor = 1.0,
                                           .end = 1.0};
    contact_scene_open(scene, &request);
}

/* Distance of a node from the surface and the sum of areas. */
static double worst_gap(contact_scene *scene, double *area)
{
    const mor_body_group *group = contact_scene_group(scene, 0);
    const mor_body *body = &group->bodies[0];
    double worst = 0.0;
    *area = 0.0;
    for (int64_t k = body->first_node; k < body->first_node + body->n_nodes; ++k) {
        double offset[3], place[3];
        for (int a = 0; a < 3; ++a) {
            offset[a] = group->node_reference[3 * k + a] - body->shape_translation[a];
        }
        mor_matrix_apply_transposed(body->shape_rotation, offset, place);
        worst = fmax(worst, fabs(mor_shape_distance(body->shape, place)));
        *area += group->node_area[k];
    }
    return worst;
}

static const contact_scene_body bodies[] = {
    {.kind = &mor_rigid_operations, .radius = 0.05, .position = {0.3, 0.1, 0.0}},
    {.kind = &mor_elastic_operations, .radius = 0.05},
    {.kind = &mor_elastic_operations, .half = {0.03, 0.04, 0.02}, .axis = {0.0, 0.0, 1.0}, .angle = 0.7},
    {.kind = &mor_rigid_operations,
     .half = {0.032, 0.041, 0.027},
     .position = {1.0, 2.0, 0.0},
     .axis = {0, 0, 1},
     .angle = 2},
};
enum { BODIES = sizeof bodies / sizeof *bodies };

static double true_surface(const contact_scene_body *body, int dimension)
{
    const double *h = body->half;
    if (body->radius > 0.0) {
        return dimension == 2 ? 2.0 * MOR_PI * body->radius : 4.0 * MOR_PI * body->radius * body->radius;
    }
    return dimension == 2 ? 4.0 * (h[0] + h[1]) : 8.0 * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0]);
}

static void nodes_lie_on_the_surface_and_share_its_area(void **state)
{
    (void)state;
    for (int k = 0; k < BODIES; ++k) {
        for (int dimension = 2; dimension <= 3; ++dimension) {
            contact_scene scene;
            double area;
            open_one(&scene, &bodies[k], dimension);
            const double surface = true_surface(&bodies[k], dimension);
            assert_true(worst_gap(&scene, &area) < 1.0e-6 * SPACING);    /* Newton steps on exact distances */
            contact_scene_expect("area", area, surface, 0.03 * surface); /* flat patches on a curved surface; edges */
            contact_scene_close(&scene);
        }
    }
}

/* The second box is no multiple of the spacing. */
static void corners_of_boxes_are_nodes(void **state)
{
    (void)state;
    for (int k = 2; k < 4; ++k) {
        contact_scene scene;
        open_one(&scene, &bodies[k], 3);
        const mor_body_group *group = contact_scene_group(&scene, 0);
        const mor_body *body = &group->bodies[0];
        int n_corners = 0;
        for (int64_t node = 0; node < group->n_nodes; ++node) {
            double offset[3], own[3];
            bool is_corner = true;
            for (int a = 0; a < 3; ++a) {
                offset[a] = group->node_reference[3 * node + a] - body->shape_translation[a];
            }
            mor_matrix_apply_transposed(body->shape_rotation, offset, own);
            for (int a = 0; a < 3; ++a) {
                is_corner = is_corner && fabs(fabs(own[a]) - bodies[k].half[a]) < 1.0e-3 * SPACING; /* EDGE_STAY */
            }
            n_corners += is_corner;
        }
        assert_int_equal(n_corners, 8);
        if (k == 2) {
            assert_int_equal(group->n_nodes, 7 * 9 * 5 - 5 * 7 * 3); /* all lattice corners but the inner ones */
        }
        contact_scene_close(&scene);
    }
}

static void nodes_are_exact_for_linear_fields(void **state)
{
    (void)state;
    for (int k = 1; k < 3; ++k) {
        for (int dimension = 2; dimension <= 3; ++dimension) {
            contact_scene scene;
            open_one(&scene, &bodies[k], dimension);
            const mor_body_group *group = contact_scene_group(&scene, 0);
            for (int64_t node = 0; node < group->n_nodes; ++node) {
                const mor_body_support support = mor_body_node_support(group, node);
                double sum = 0.0;
                double place[3] = {0.0, 0.0, 0.0};
                assert_in_range(support.count, dimension + 1, MOR_BODY_NODE_PARTICLES);
                for (int j = 0; j < support.count; ++j) {
                    sum += support.weights[j];
                    for (int a = 0; a < 3; ++a) {
                        place[a] += support.weights[j] * group->reference[3 * (int64_t)support.particles[j] + a];
                    }
                }
                assert_true(fabs(sum - 1.0) < 1.0e-12); /* rounding of 32 terms */
                for (int a = 0; a < 3; ++a) {
                    assert_true(fabs(place[a] - group->node_reference[3 * node + a]) < 1.0e-12); /* m; likewise */
                }
            }
            contact_scene_close(&scene);
        }
    }
}

/* Brute force: every particle tested. */
static void the_tree_finds_what_brute_force_finds(void **state)
{
    (void)state;
    contact_scene scene;
    open_one(&scene, &bodies[1], 3);
    const mor_body_group *group = contact_scene_group(&scene, 0);
    enum { ROOM = 2048 };
    static int32_t found[ROOM];
    mor_tree tree;
    assert_int_equal(mor_tree_init(&scene.context, &tree, group->set.n_particles), MOR_OK);
    mor_tree_fit(&tree, group->reference, 3);
    for (int query = 0; query < 50; ++query) {
        const double point[3] = {0.06 * sin(1.0 * query), 0.06 * cos(2.0 * query), 0.06 * sin(3.0 * query)};
        const double radius = 0.01 * (1 + query % 4);
        const int n = mor_body_find_near(&tree, group->reference, 0, point, radius, 0.0, found, ROOM);
        int expected = 0;
        for (int64_t i = 0; i < group->set.n_particles; ++i) {
            const double *x = group->reference + 3 * i;
            const double d[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
            if (mor_vector_dot(d, d) < radius * radius) {
                assert_true(expected < n);
                assert_int_equal(found[expected++], i);
            }
        }
        assert_int_equal(n, expected);
    }
    mor_tree_clear(&scene.context, &tree);
    contact_scene_close(&scene);
}

static void weights_reproduce_a_linear_map_and_its_gradient(void **state)
{
    (void)state;
    static const double gradient[9] = {1.1, 0.2, -0.1, 0.05, 0.9, 0.3, 0.0, -0.2, 1.2};
    enum { N = 40 };
    double x[3 * N], y[3 * N], weights[N], found[9];
    int32_t particles[N];
    for (int i = 0; i < N; ++i) {
        for (int a = 0; a < 3; ++a) {
            x[3 * i + a] = sin(1.0 + 3.7 * i + 1.3 * a * i);
        }
        mor_matrix_apply(gradient, x + 3 * i, y + 3 * i);
        particles[i] = i;
    }
    const double point[3] = {0.2, -0.3, 0.4};
    assert_true(mor_body_linear_weights(3, x, particles, N, point, 1.5, weights, y, found));
    double expected[3];
    mor_matrix_apply(gradient, point, expected);
    for (int a = 0; a < 3; ++a) {
        double sum = 0.0;
        for (int i = 0; i < N; ++i) {
            sum += weights[i] * y[3 * i + a];
        }
        assert_true(fabs(sum - expected[a]) < 1.0e-12); /* rounding of 40 terms */
    }
    for (int k = 0; k < 9; ++k) {
        assert_true(fabs(found[k] - gradient[k]) < 1.0e-12); /* likewise */
    }
}

static void particles_in_a_plane_are_refused(void **state)
{
    (void)state;
    const double x[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.5, 0.3, 0};
    const int32_t particles[5] = {0, 1, 2, 3, 4};
    const double point[3] = {0.4, 0.4, 0.1};
    double weights[5];
    assert_false(mor_body_linear_weights(3, x, particles, 5, point, 3.0, weights, NULL, NULL));
    assert_true(mor_body_linear_weights(2, x, particles, 5, x + 12, 3.0, weights, NULL, NULL));
    assert_false(mor_body_linear_weights(2, x, particles, 2, x, 3.0, weights, NULL, NULL));
    assert_false(mor_body_linear_weights(2, x, particles, 0, x, 3.0, weights, NULL, NULL));
}

/* Particles that are no lattice: a box with each particle moved a little. */
static void irregular_particles_are_covered_too(void **state)
{
    (void)state;
    contact_scene scene;
    open_one(&scene, &bodies[0], 3);
    mor_body_group *group = contact_scene_group(&scene, 0);
    for (int64_t i = 0; i < 3 * group->set.n_particles; ++i) {
        group->reference[i] += 0.2 * SPACING * sin(7.3 * (double)i);
    }
    mor_context *context = &scene.context;
    MOR_FREE(context, &group->node_reference);
    MOR_FREE(context, &group->node_area);
    MOR_FREE(context, &group->node_count);
    group->n_nodes = 0;
    assert_int_equal(mor_body_group_make_nodes(context, group), MOR_OK);
    double area;
    const double surface = true_surface(&bodies[0], 3);
    assert_true(worst_gap(&scene, &area) < 1.0e-6 * SPACING);    /* Newton steps */
    contact_scene_expect("area", area, surface, 0.25 * surface); /* volume of a layer that is not one spacing thick */
    assert_true((double)group->n_nodes > surface / (SPACING * SPACING)); /* no holes: nodes nearer than a spacing */
    contact_scene_close(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_lie_on_the_surface_and_share_its_area),
        cmocka_unit_test(corners_of_boxes_are_nodes),
        cmocka_unit_test(nodes_are_exact_for_linear_fields),
        cmocka_unit_test(the_tree_finds_what_brute_force_finds),
        cmocka_unit_test(weights_reproduce_a_linear_map_and_its_gradient),
        cmocka_unit_test(particles_in_a_plane_are_refused),
        cmocka_unit_test(irregular_particles_are_covered_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
