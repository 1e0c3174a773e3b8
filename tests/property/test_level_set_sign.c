/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/level_set/level_set.h"
#include "relaxation/mesh/mesh_distance.h"
#include "tests/common/cloud.h"
#include "tests/common/mesh_forms.h"

/* Which side a million random points are on, asked of meshes and of level sets, against closed forms. */

enum { N_POINTS = 1000000 };

static const double radius = 0.5; /* of the ball, half a side of the cube */

static void draw_point(uint64_t id, double *point)
{
    for (int a = 0; a < 3; ++a) {
        point[a] = cloud_number(id, 300 + (uint64_t)a, -1.2 * radius, 1.2 * radius);
    }
}

static double measure_cube(const double *point)
{
    return fmax(fabs(point[0]), fmax(fabs(point[1]), fabs(point[2]))) - radius;
}

/* Planes of the faces of a convex mesh, shape [n_triangles, 4]: normal and offset, m. */
static double *new_planes(const mor_mesh *mesh)
{
    double *planes = calloc((size_t)mesh->n_triangles, 4 * sizeof *planes);
    assert_non_null(planes);
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        const double *a = mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t];
        const double *b = mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t + 1];
        const double *c = mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t + 2];
        double *plane = planes + 4 * t;
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3;
            const int j = (k + 2) % 3;
            plane[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
        }
        plane[3] = mor_vector_dot(plane, a);
    }
    return planes;
}

static void rays_tell_the_side_of_a_cube(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_cube(&context, radius);
    mor_mesh_distance *distance = NULL;
    assert_int_equal(mor_mesh_distance_new(&context, &mesh, &distance), MOR_OK);
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        draw_point(id, point);
        assert_int_equal(mor_mesh_distance_is_inside(distance, point), measure_cube(point) < 0.0);
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
}

static void rays_tell_the_side_of_a_divided_icosahedron(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_ball(&context, radius, 2);
    double *planes = new_planes(&mesh);
    mor_mesh_distance *distance = NULL;
    assert_int_equal(mor_mesh_distance_new(&context, &mesh, &distance), MOR_OK);
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        bool is_inside = true;
        draw_point(id, point);
        for (int64_t t = 0; t < mesh.n_triangles && is_inside; ++t) {
            is_inside = mor_vector_dot(planes + 4 * t, point) < planes[4 * t + 3];
        }
        assert_int_equal(mor_mesh_distance_is_inside(distance, point), is_inside);
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
    free(planes);
}

static void level_set_of_a_ball_has_the_right_sign(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double center[3] = {0.0, 0.0, 0.0};
    const double cell = radius / 20.0;
    const mor_level_set_request request = {3, cell, 8.0 * cell};
    mor_shape *ball = NULL;
    mor_shape *set = NULL;
    assert_int_equal(mor_shape_new_sphere(&context, center, radius, &ball), MOR_OK);
    assert_int_equal(mor_shape_new_level_set(&context, ball, &request, &set), MOR_OK);
    int n_undecided = 0;
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        draw_point(id, point);
        const double exact = mor_shape_distance(ball, point);
        const double value = mor_shape_distance(set, point);
        /* The error of distance at this cell is below 3e-4 cells (third order): nearer, the sign is the error's. */
        assert_true(fabs(exact) < 3e-4 * cell || exact * value > 0.0);
        n_undecided += exact * value <= 0.0;
    }
    print_message("ball: %d of a million within the error of distance\n", n_undecided);
    assert_true(n_undecided < 20); /* a layer of 2 x 3e-4 cells holds 27 of the points */
    mor_shape_free(&context, &set);
    mor_shape_free(&context, &ball);
}

static void level_set_of_a_cube_has_the_right_sign(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double cell = radius / 20.0;
    const mor_level_set_request request = {3, cell, 8.0 * cell};
    mor_mesh mesh = mesh_cube(&context, radius);
    mor_shape *set = NULL;
    assert_int_equal(mor_shape_new_mesh(&context, &mesh, &request, &set), MOR_OK);
    int n_undecided = 0;
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        draw_point(id, point);
        const double exact = measure_cube(point);
        const bool is_right = exact * mor_shape_distance(set, point) > 0.0;
        int n_near = 0; /* faces within two cells: two at an edge, three at a corner */
        for (int a = 0; a < 3; ++a) {
            n_near += fabs(fabs(point[a]) - radius) < 2.0 * cell;
        }
        /* Edges come out rounded by a fifth of a cell; faces are exact. */
        assert_true(is_right || (n_near >= 2 && fabs(exact) < 0.2 * cell));
        n_undecided += !is_right;
    }
    print_message("cube: %d of a million at its edges, within a fifth of a cell\n", n_undecided);
    mor_shape_free(&context, &set);
    mor_mesh_clear(&context, &mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_tell_the_side_of_a_cube),
        cmocka_unit_test(rays_tell_the_side_of_a_divided_icosahedron),
        cmocka_unit_test(level_set_of_a_ball_has_the_right_sign),
        cmocka_unit_test(level_set_of_a_cube_has_the_right_sign),
    };
    return CLOUD_RUN(tests);
}
