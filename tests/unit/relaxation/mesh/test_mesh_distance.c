/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/mesh/mesh_distance.h"
#include "tests/common/cloud.h"
#include "tests/common/mesh_forms.h"
#include "tests/common/near.h"

static void draw_point(uint64_t id, double reach, double *point)
{
    for (int a = 0; a < 3; ++a) {
        point[a] = cloud_number(id, 100 + (uint64_t)a, -reach, reach);
    }
}

static mor_mesh_distance *new_distance(mor_context *context, const mor_mesh *mesh)
{
    mor_mesh_distance *distance = NULL;
    assert_int_equal(mor_mesh_distance_new(context, mesh, &distance), MOR_OK);
    return distance;
}

static double measure_segment(const double *a, const double *b, const double *point)
{
    double along = 0.0;
    double length2 = 0.0;
    double out[3];
    for (int k = 0; k < 3; ++k) {
        along += (point[k] - a[k]) * (b[k] - a[k]);
        length2 += (b[k] - a[k]) * (b[k] - a[k]);
    }
    for (int k = 0; k < 3; ++k) {
        out[k] = point[k] - a[k] - fmin(1.0, fmax(0.0, along / length2)) * (b[k] - a[k]);
    }
    return mor_vector_length(out);
}

static void find_cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; ++k) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* Another way than that of the code: the plane's distance over the face, else that of the nearest edge. */
static double measure_triangle(const mor_mesh *mesh, int64_t triangle, const double *point)
{
    const double *corners[3];
    double sides[2][3];
    double normal[3];
    double nearest = INFINITY;
    bool is_over = true;
    for (int c = 0; c < 3; ++c) {
        corners[c] = mesh->vertices + 3 * (int64_t)mesh->triangles[3 * triangle + c];
    }
    for (int k = 0; k < 3; ++k) {
        sides[0][k] = corners[1][k] - corners[0][k];
        sides[1][k] = corners[2][k] - corners[0][k];
    }
    find_cross(sides[0], sides[1], normal);
    for (int c = 0; c < 3; ++c) {
        double side[3];
        double offset[3];
        double outward[3];
        for (int k = 0; k < 3; ++k) {
            side[k] = corners[(c + 1) % 3][k] - corners[c][k];
            offset[k] = point[k] - corners[c][k];
        }
        find_cross(side, normal, outward);
        is_over = is_over && mor_vector_dot(outward, offset) <= 0.0;
        nearest = fmin(nearest, measure_segment(corners[c], corners[(c + 1) % 3], point));
    }
    const double offset[3] = {point[0] - corners[0][0], point[1] - corners[0][1], point[2] - corners[0][2]};
    return is_over ? fabs(mor_vector_dot(normal, offset)) / mor_vector_length(normal) : nearest;
}

static void distance_is_that_of_a_search_through_all_triangles(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_ball(&context, 0.7, 2);
    const double translation[3] = {1000.0, -300.0, 20.0}; /* far from the origin, where single precision is coarse */
    for (int64_t k = 0; k < 3 * mesh.n_vertices; ++k) {
        mesh.vertices[k] += translation[k % 3];
    }
    mor_mesh_distance *distance = new_distance(&context, &mesh);
    for (uint64_t id = 0; id < 3000; ++id) {
        double point[3];
        double nearest[3];
        double expected = INFINITY;
        draw_point(id, id % 10 == 0 ? 50.0 : 1.0, point);
        for (int k = 0; k < 3; ++k) {
            point[k] += translation[k];
        }
        for (int64_t t = 0; t < mesh.n_triangles; ++t) {
            expected = fmin(expected, measure_triangle(&mesh, t, point));
        }
        const double found = mor_mesh_distance_find(distance, point, INFINITY, nearest);
        assert_near(found, expected, 3e-12); /* rounding of coordinates near 1000: 1e-13, a few times */
        const double way[3] = {point[0] - nearest[0], point[1] - nearest[1], point[2] - nearest[2]};
        assert_near(mor_vector_length(way), found, 1e-12); /* the nearest point is where the distance was taken */
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
    assert_int_equal(context.memory_bytes, 0);
}

static void limit_is_given_back_when_nothing_is_nearer(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_cube(&context, 1.0);
    mor_mesh_distance *distance = new_distance(&context, &mesh);
    const double point[3] = {1.5, 0.2, 0.1};
    double nearest[3] = {7.0, 7.0, 7.0};
    assert_near(mor_mesh_distance_find(distance, point, 0.4, nearest), 0.4, 0.0);   /* exact: the limit itself */
    assert_near(mor_mesh_distance_find(distance, point, 0.5, nearest), 0.5, 0.0);   /* not nearer than the limit */
    assert_near(nearest[0], 7.0, 0.0);                                              /* untouched */
    assert_near(mor_mesh_distance_find(distance, point, 0.6, nearest), 0.5, 1e-15); /* rounding */
    assert_near(nearest[0], 1.0, 1e-15);                                            /* rounding */
    assert_near(mor_mesh_distance_find(distance, point, 0.6, NULL), 0.5, 1e-15);    /* rounding */
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
}

/* Rays from the middle plane of the cube run into edges of its triangles when they are along axes or diagonals. */
static void symmetric_points_are_inside(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_cube(&context, 1.0);
    mor_mesh_distance *distance = new_distance(&context, &mesh);
    for (int k = 0; k < 343; ++k) {
        const double point[3] = {(k % 7 - 3) / 4.0, (k / 7 % 7 - 3) / 4.0, (k / 49 - 3) / 4.0};
        const double outer[3] = {2.0 * point[0] + (k % 2 == 0 ? 2.6 : -2.6), 2.0 * point[1], 2.0 * point[2]};
        assert_true(mor_mesh_distance_is_inside(distance, point));
        assert_false(mor_mesh_distance_is_inside(distance, outer));
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
}

/* The upper face is torn off along one edge and bent up: a slit as wide as a fiftieth of the cube. Rays through it are
 * wrong about one crossing. */
static void slit_is_outvoted(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh cube = mesh_cube(&context, 1.0);
    double vertices[30];
    memcpy(vertices, cube.vertices, 24 * sizeof *vertices);
    for (int k = 0; k < 3; ++k) {
        vertices[24 + k] = cube.vertices[3 * 4 + k] + (k == 2 ? 0.04 : 0.0);
        vertices[27 + k] = cube.vertices[3 * 5 + k] + (k == 2 ? 0.04 : 0.0);
    }
    mor_mesh torn = mesh_from(&context, vertices, 10, cube.triangles, 12);
    for (int k = 30; k < 36; ++k) {
        torn.triangles[k] = torn.triangles[k] == 4 ? 8 : torn.triangles[k] == 5 ? 9 : torn.triangles[k];
    }
    mor_mesh_distance *distance = new_distance(&context, &torn);
    for (uint64_t id = 0; id < 100000; ++id) {
        double point[3];
        draw_point(id, 1.2, point);
        const double depth = 1.0 - fmax(fabs(point[0]), fmax(fabs(point[1]), fabs(point[2])));
        if (fabs(depth) > 0.1) { /* nearer to the slit there is no inside */
            assert_int_equal(mor_mesh_distance_is_inside(distance, point), depth > 0.0);
        }
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &torn);
    mor_mesh_clear(&context, &cube);
}

static void unit_of_length_by_a_power_of_two_changes_no_bit(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_ball(&context, 0.7, 2);
    mor_mesh_distance *distance = new_distance(&context, &mesh);
    const double factors[2] = {ldexp(1.0, 40), ldexp(1.0, -60)};
    for (int f = 0; f < 2; ++f) {
        mor_mesh other = mesh_from(&context, mesh.vertices, mesh.n_vertices, mesh.triangles, mesh.n_triangles);
        for (int64_t k = 0; k < 3 * other.n_vertices; ++k) {
            other.vertices[k] *= factors[f];
        }
        mor_mesh_distance *scaled = new_distance(&context, &other);
        for (uint64_t id = 0; id < 2000; ++id) {
            double point[3];
            double nearest[2][3];
            draw_point(id, 1.0, point);
            const double there[3] = {factors[f] * point[0], factors[f] * point[1], factors[f] * point[2]};
            const double a = mor_mesh_distance_find(distance, point, INFINITY, nearest[0]);
            const double b = mor_mesh_distance_find(scaled, there, INFINITY, nearest[1]);
            assert_true(a * factors[f] == b); /* exact: powers of two do not round */
            for (int k = 0; k < 3; ++k) {
                assert_true(nearest[0][k] * factors[f] == nearest[1][k]); /* exact */
            }
            assert_int_equal(mor_mesh_distance_is_inside(distance, point), mor_mesh_distance_is_inside(scaled, there));
        }
        mor_mesh_distance_free(&context, &scaled);
        mor_mesh_clear(&context, &other);
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
}

static void triangle_without_area_is_a_line(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const int32_t triangles[6] = {0, 1, 2, 0, 0, 3};
    static const double vertices[12] = {0, 0, 0, 1, 0, 0, 3, 0, 0, 0, 2, 0};
    mor_mesh mesh = mesh_from(&context, vertices, 4, triangles, 2);
    mor_mesh_distance *distance = new_distance(&context, &mesh);
    const double points[3][3] = {{2.0, 0.0, 0.5}, {4.0, 0.0, 0.0}, {0.0, 1.5, -0.25}};
    const double expected[3] = {0.5, 1.0, 0.25};
    for (int i = 0; i < 3; ++i) {
        assert_near(mor_mesh_distance_find(distance, points[i], INFINITY, NULL), expected[i], 1e-15); /* rounding */
    }
    mor_mesh_distance_free(&context, &distance);
    mor_mesh_clear(&context, &mesh);
}

static void mesh_without_extent_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const mor_mesh empty = {0};
    mor_mesh_distance *distance = NULL;
    assert_int_equal(mor_mesh_distance_new(&context, &empty, &distance), MOR_ERROR_ARGUMENT);
    assert_null(distance);
    mor_mesh cube = mesh_cube(&context, 1.0);
    cube.vertices[4] = INFINITY;
    assert_int_equal(mor_mesh_distance_new(&context, &cube, &distance), MOR_ERROR_ARGUMENT);
    assert_null(distance);
    mor_mesh_clear(&context, &cube);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_is_that_of_a_search_through_all_triangles),
        cmocka_unit_test(limit_is_given_back_when_nothing_is_nearer),
        cmocka_unit_test(symmetric_points_are_inside),
        cmocka_unit_test(slit_is_outvoted),
        cmocka_unit_test(unit_of_length_by_a_power_of_two_changes_no_bit),
        cmocka_unit_test(triangle_without_area_is_a_line),
        cmocka_unit_test(mesh_without_extent_is_refused),
    };
    return CLOUD_RUN(tests);
}
