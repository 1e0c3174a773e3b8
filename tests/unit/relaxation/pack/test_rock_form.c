/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/eigen.h"
#include "core/base/math.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/pack/rock_form.h"
#include "tests/common/near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Second moment along each axis of a body of known inertia: half the trace less the moment of inertia. */
static void find_axes(const mor_shape_moments *moments, double *lengths)
{
    const double *inertia = moments->inertia;
    const double half = 0.5 * (inertia[MOR_XX] + inertia[MOR_YY] + inertia[MOR_ZZ]);
    for (int a = 0; a < 3; ++a) {
        lengths[a] = sqrt(half - inertia[a]);
    }
}

static void outline_has_exact_area_center_and_elongation(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < 24; ++k) {
        mor_rock_form form;
        mor_rock_form_init(&form);
        form.elongation = 0.3 + 0.1 * (k % 8);
        form.angularity = 0.5 * (k % 3);
        form.roughness = k % 2;
        form.diameter = 3.0;
        form.seed = (uint64_t)k;
        mor_outline outline;
        mor_shape_moments moments;
        double xx = 0.0;
        double yy = 0.0;
        assert_int_equal(mor_rock_outline(&context, &form, 96, &outline), MOR_OK);
        mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
        assert_near(moments.volume / (0.25 * MOR_PI * 9.0), 1.0, 1e-13); /* rounding of a sum over 96 edges */
        assert_near(moments.center[0], 0.0, 1e-13 * form.diameter);      /* the same */
        assert_near(moments.center[1], 0.0, 1e-13 * form.diameter);      /* the same */
        for (int i = 0; i < outline.n_points; ++i) { /* integrals of x x and y y over the triangles to the center */
            const double *a = outline.points + 2 * i;
            const double *b = outline.points + 2 * ((i + 1) % outline.n_points);
            const double twelfth = (a[0] * b[1] - a[1] * b[0]) / 12.0;
            assert_true(twelfth > 0.0); /* star-shaped: no edge runs back, so none crosses another */
            xx += twelfth * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]);
            yy += twelfth * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]);
        }
        assert_near(sqrt(yy / xx), form.elongation, 1e-12); /* a linear map: rounding */
        mor_outline_clear(&context, &outline);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void mesh_has_exact_volume_center_and_axes(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < 6; ++k) {
        mor_rock_form form;
        mor_rock_form_init(&form);
        form.elongation = 0.4 + 0.12 * k;
        form.flatness = 1.0 - 0.12 * k;
        form.angularity = 0.2 * k;
        form.roughness = k % 2;
        form.diameter = 0.5;
        form.seed = (uint64_t)(10 + k);
        mor_mesh mesh;
        mor_shape_moments moments;
        double lengths[3];
        assert_int_equal(mor_rock_mesh(&context, &form, 3, &mesh), MOR_OK);
        assert_int_equal(mesh.n_triangles, 20 * 64);
        assert_int_equal(mesh.n_vertices, mesh.n_triangles / 2 + 2); /* Euler: closed, one shell, no hole */
        mor_mesh_moments(&mesh, &moments);
        find_axes(&moments, lengths);
        assert_near(moments.volume / (MOR_PI / 6.0 * 0.125), 1.0, 1e-12); /* rounding of a sum over 1280 */
        for (int a = 0; a < 3; ++a) {
            assert_near(moments.center[a], 0.0, 1e-12 * form.diameter); /* the same */
        }
        assert_near(lengths[1] / lengths[0], form.elongation, 1e-9); /* a linear map: rounding of differences */
        assert_near(lengths[2] / lengths[1], form.flatness, 1e-9);   /* the same */
        for (int64_t t = 0; t < mesh.n_triangles; ++t) { /* seen from the center every triangle faces outward */
            const double *a = mesh.vertices + 3 * (int64_t)mesh.triangles[3 * t];
            const double *b = mesh.vertices + 3 * (int64_t)mesh.triangles[3 * t + 1];
            const double *c = mesh.vertices + 3 * (int64_t)mesh.triangles[3 * t + 2];
            assert_true(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                            a[2] * (b[0] * c[1] - b[1] * c[0]) >
                        0.0);
        }
        mor_mesh_clear(&context, &mesh);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void rock_passes_the_check_of_meshes(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_rock_form form;
    mor_rock_form_init(&form);
    form.angularity = form.roughness = 1.0;
    mor_mesh mesh;
    mor_mesh checked;
    mor_mesh_report report;
    assert_int_equal(mor_rock_mesh(&context, &form, 4, &mesh), MOR_OK);
    assert_int_equal(mor_mesh_init(&context, mesh.vertices, mesh.n_vertices, mesh.triangles, mesh.n_triangles, "rock",
                                   &checked, &report),
                     MOR_OK);
    assert_int_equal(checked.n_triangles, mesh.n_triangles);
    assert_int_equal(report.n_crossings + report.n_open_edges + report.n_flipped + report.n_crowded_edges, 0);
    assert_int_equal(report.n_shells, 1);
    mor_mesh_clear(&context, &checked);
    mor_mesh_clear(&context, &mesh);
    assert_int_equal(context.memory_bytes, 0);
}

/* Largest part of the whole turn that the outline makes within one edge: 1 / 96 of a disc, more at corners. */
static double find_sharpest(const mor_outline *outline)
{
    double sharpest = 0.0;
    const int n = outline->n_points;
    for (int i = 0; i < n; ++i) {
        const double *a = outline->points + 2 * i;
        const double *b = outline->points + 2 * ((i + 1) % n);
        const double *c = outline->points + 2 * ((i + 2) % n);
        const double rotation = atan2((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]),
                                      (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]));
        sharpest = fmax(sharpest, rotation / (2.0 * MOR_PI));
    }
    return sharpest;
}

static void angular_rocks_have_sharper_corners_and_seeds_differ(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double rounded = 0.0;
    double angular = 0.0;
    mor_outline first = {.n_points = 0};
    for (uint64_t seed = 0; seed < 20; ++seed) {
        for (int k = 0; k < 2; ++k) {
            mor_rock_form form;
            mor_outline outline;
            mor_rock_form_init(&form);
            form.roughness = 0.0;
            form.angularity = k;
            form.seed = seed;
            assert_int_equal(mor_rock_outline(&context, &form, 96, &outline), MOR_OK);
            *(k == 0 ? &rounded : &angular) += find_sharpest(&outline) / 20.0;
            if (seed == 0 && k == 0) {
                first = outline;
                continue;
            }
            assert_memory_not_equal(outline.points, first.points, 96 * 2 * sizeof *outline.points);
            mor_outline_clear(&context, &outline);
        }
    }
    assert_true(angular > 2.0 * rounded);
    mor_outline_clear(&context, &first);
    assert_int_equal(context.memory_bytes, 0);
}

/* Adds the squared logarithms of the radii of points, shape [n_points, d], of a rough rock over those of the smooth one
 * of the same seed. */
static double compare_radii(const double *smooth, const double *rough, int64_t n_points, int d)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n_points; ++i) {
        double squares[2] = {0.0, 0.0};
        for (int a = 0; a < d; ++a) {
            squares[0] += smooth[d * i + a] * smooth[d * i + a];
            squares[1] += rough[d * i + a] * rough[d * i + a];
        }
        const double change = 0.5 * log(squares[1] / squares[0]);
        sum += change * change / (double)n_points;
    }
    return sum;
}

/* Mean square of the logarithm of the radius that roughness adds, over some rocks of equal axes. */
static double measure_roughness(mor_context *context, int dimension, double roughness)
{
    enum { SEEDS = 24 };
    double sum = 0.0;
    for (uint64_t seed = 0; seed < SEEDS; ++seed) {
        mor_rock_form form;
        mor_outline outlines[2] = {{.n_points = 0}, {.n_points = 0}};
        mor_mesh meshes[2] = {{.n_vertices = 0}, {.n_vertices = 0}};
        mor_rock_form_init(&form);
        form.elongation = form.flatness = 1.0;
        form.angularity = 0.0;
        form.seed = seed;
        for (int k = 0; k < 2; ++k) {
            form.roughness = k * roughness;
            if (dimension == 2) {
                assert_int_equal(mor_rock_outline(context, &form, 192, &outlines[k]), MOR_OK);
            } else {
                assert_int_equal(mor_rock_mesh(context, &form, 2, &meshes[k]), MOR_OK);
            }
        }
        sum += dimension == 2 ? compare_radii(outlines[0].points, outlines[1].points, 192, 2)
                              : compare_radii(meshes[0].vertices, meshes[1].vertices, meshes[0].n_vertices, 3);
        for (int k = 0; k < 2; ++k) {
            mor_outline_clear(context, &outlines[k]);
            mor_mesh_clear(context, &meshes[k]);
        }
    }
    return sum / SEEDS;
}

/* The waves of roughness 1 have an rms of 0.05 of the logarithm of the radius, and those of less in proportion. */
static void roughness_is_the_strength_of_the_shortest_waves(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (int k = 1; k <= 2; ++k) {
            const double rms = sqrt(measure_roughness(&context, dimension, 0.5 * k));
            print_message("%dD, roughness %.1f: rms %.4f\n", dimension, 0.5 * k, rms);
            assert_near(rms / (0.025 * k), 1.0, 0.1); /* 24 rocks of some 20 waves that count: deviation 0.03 */
        }
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void find_face_normal(const mor_mesh *mesh, int64_t t, double *normal)
{
    double edges[2][3];
    for (int k = 0; k < 2; ++k) {
        for (int a = 0; a < 3; ++a) {
            edges[k][a] = mesh->vertices[3 * (int64_t)mesh->triangles[3 * t + k + 1] + a] -
                          mesh->vertices[3 * (int64_t)mesh->triangles[3 * t] + a];
        }
    }
    mor_vector_cross(edges[0], edges[1], normal);
    const double length = mor_vector_length(normal);
    for (int a = 0; a < 3; ++a) {
        normal[a] /= length;
    }
}

/* Largest angle between two triangles that share an edge, rad. */
static double find_sharpest_edge(const mor_mesh *mesh)
{
    double least = 1.0;
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        double normal[3];
        find_face_normal(mesh, t, normal);
        for (int64_t u = 0; u < t; ++u) {
            int n_shared = 0;
            for (int k = 0; k < 9; ++k) {
                n_shared += mesh->triangles[3 * t + k / 3] == mesh->triangles[3 * u + k % 3];
            }
            if (n_shared == 2) {
                double other[3];
                find_face_normal(mesh, u, other);
                least = fmin(least, mor_vector_dot(normal, other));
            }
        }
    }
    return acos(least);
}

static void angular_rocks_have_sharper_edges_in_space(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double sharpest[2] = {0.0, 0.0};
    for (uint64_t seed = 0; seed < 4; ++seed) {
        for (int k = 0; k < 2; ++k) {
            mor_rock_form form;
            mor_mesh mesh;
            mor_rock_form_init(&form);
            form.elongation = form.flatness = 1.0;
            form.roughness = 0.0;
            form.angularity = k;
            form.seed = seed;
            assert_int_equal(mor_rock_mesh(&context, &form, 2, &mesh), MOR_OK);
            sharpest[k] += find_sharpest_edge(&mesh) / 4.0;
            mor_mesh_clear(&context, &mesh);
        }
    }
    print_message("sharpest edge: %.3f rad of rounded rocks, %.3f rad of angular ones\n", sharpest[0], sharpest[1]);
    assert_true(sharpest[1] > 2.0 * sharpest[0]);
    assert_int_equal(context.memory_bytes, 0);
}

static void size_by_a_power_of_two_changes_no_bit(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_rock_form form;
    mor_mesh small;
    mor_mesh large;
    mor_rock_form_init(&form);
    assert_int_equal(mor_rock_mesh(&context, &form, 2, &small), MOR_OK);
    form.diameter = 1024.0;
    assert_int_equal(mor_rock_mesh(&context, &form, 2, &large), MOR_OK);
    for (int64_t i = 0; i < 3 * small.n_vertices; ++i) {
        assert_true(1024.0 * small.vertices[i] == large.vertices[i]);
    }
    mor_mesh_clear(&context, &small);
    mor_mesh_clear(&context, &large);
}

static void wrong_numbers_are_refused_by_name(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const struct {
        size_t offset;
        double value;
        const char *name;
    } wrong[] = {{offsetof(mor_rock_form, elongation), 0.2, "elongation"},
                 {offsetof(mor_rock_form, flatness), 1.1, "flatness"},
                 {offsetof(mor_rock_form, angularity), -0.1, "angularity"},
                 {offsetof(mor_rock_form, roughness), NAN, "roughness"},
                 {offsetof(mor_rock_form, diameter), 0.0, "diameter"}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        mor_rock_form form;
        mor_outline outline;
        mor_mesh mesh;
        mor_rock_form_init(&form);
        memcpy((char *)&form + wrong[k].offset, &wrong[k].value, sizeof(double));
        assert_int_equal(mor_rock_outline(&context, &form, 96, &outline), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, wrong[k].name));
        assert_int_equal(mor_rock_mesh(&context, &form, 3, &mesh), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, wrong[k].name));
        assert_null(outline.points);
        assert_null(mesh.vertices);
    }
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(outline_has_exact_area_center_and_elongation),
        cmocka_unit_test(mesh_has_exact_volume_center_and_axes),
        cmocka_unit_test(rock_passes_the_check_of_meshes),
        cmocka_unit_test(angular_rocks_have_sharper_corners_and_seeds_differ),
        cmocka_unit_test(angular_rocks_have_sharper_edges_in_space),
        cmocka_unit_test(roughness_is_the_strength_of_the_shortest_waves),
        cmocka_unit_test(size_by_a_power_of_two_changes_no_bit),
        cmocka_unit_test(wrong_numbers_are_refused_by_name),
    };
    return cmocka_run_group_tests_name("rock_form", tests, NULL, NULL);
}
