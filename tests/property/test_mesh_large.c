/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "relaxation/mesh/mesh.h"
#include "tests/common/mesh_forms.h"
#include "tests/common/near.h"
#include "tests/common/run_folder.h"

#include <time.h>

enum { DIVISIONS = 8 };

/* Sends the triangles of a divided one, their corners drawn to the unit ball, to a binary STL file. */
static void write_divided(FILE *file, double corners[3][3], int n_divisions)
{
    if (n_divisions == 0) {
        float numbers[12] = {0};
        for (int k = 0; k < 9; ++k) {
            numbers[3 + k] = (float)corners[k / 3][k % 3];
        }
        assert_int_equal(fwrite(numbers, sizeof numbers, 1, file), 1);
        assert_int_equal(fwrite("\0", 2, 1, file), 1);
        return;
    }
    double middles[3][3];
    for (int c = 0; c < 3; ++c) {
        for (int a = 0; a < 3; ++a) {
            middles[c][a] = corners[c][a] + corners[(c + 1) % 3][a];
        }
        const double length = mor_vector_length(middles[c]);
        for (int a = 0; a < 3; ++a) {
            middles[c][a] /= length;
        }
    }
    for (int c = 0; c < 4; ++c) {
        double part[3][3];
        memcpy(part[0], c < 3 ? corners[c] : middles[0], sizeof part[0]);
        memcpy(part[1], c < 3 ? middles[c] : middles[1], sizeof part[1]);
        memcpy(part[2], c < 3 ? middles[(c + 2) % 3] : middles[2], sizeof part[2]);
        write_divided(file, part, n_divisions - 1);
    }
}

/* A ball of 20 * 4^n triangles, every one with corners of its own. */
static void write_ball(run_folder *folder, const char *path, int n_divisions)
{
    mor_mesh coarse = mesh_ball(&folder->context, 1.0, 0);
    char header[80] = "ball";
    uint32_t n = 20u << (2 * n_divisions);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(header, sizeof header, 1, file), 1);
    assert_int_equal(fwrite(&n, sizeof n, 1, file), 1);
    for (int t = 0; t < 20; ++t) {
        double corners[3][3];
        for (int k = 0; k < 9; ++k) {
            corners[k / 3][k % 3] = coarse.vertices[3 * (ptrdiff_t)coarse.triangles[3 * t + k / 3] + k % 3];
        }
        write_divided(file, corners, n_divisions);
    }
    assert_int_equal(fclose(file), 0);
    mor_mesh_clear(&folder->context, &coarse);
}

static void balls_of_up_to_a_million_triangles_approach_the_sphere_in_second_order(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, "ball.stl");
    folder->context.n_threads = 2;
    double last = 0.0;
    for (int n = 2; n <= DIVISIONS; n += 3) {
        mor_mesh mesh;
        mor_mesh_report report;
        mor_shape_moments moments;
        write_ball(folder, path, n);
        const clock_t start = clock();
        assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, &report), MOR_OK);
        print_message("%lld triangles read and checked in %.2f s of processor time, the reader's own apart\n",
                      (long long)mesh.n_triangles, (double)(clock() - start) / CLOCKS_PER_SEC);
        assert_int_equal(mesh.n_triangles, 20 << (2 * n));
        assert_int_equal(mesh.n_vertices, (10 << (2 * n)) + 2); /* Euler */
        assert_int_equal(report.n_flipped + report.n_degenerate + report.n_duplicate, 0);
        mor_mesh_moments(&mesh, &moments);
        const double volume = 4.0 / 3.0 * MOR_PI;
        const double error = 1.0 - moments.volume / volume;
        if (last > 0.0) {
            assert_near(last / error, 64.0, 3.0); /* 8^2 in three divisions, less terms of higher order */
        }
        last = error;
        /* Volume and inertia fall short by 3 and 5 times the mean shortfall of the radius. */
        assert_near(moments.inertia[MOR_XX], 0.4 * volume * (1.0 - 5.0 / 3.0 * error), 0.5 * error);
        assert_near(mor_vector_length(moments.center), 0.0, 1e-8); /* single precision, averaged */
        mor_mesh_clear(&folder->context, &mesh);
    }
}

/* One corner of a million-triangle ball drawn through the far side. */
static void one_spike_through_a_large_mesh_is_found_for_any_number_of_threads(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char messages[2][MOR_CONTEXT_MESSAGE_BYTES];
    mor_mesh mesh;
    mor_mesh broken;
    mor_mesh_report reports[2];
    write_ball(folder, run_folder_file(folder, path, "ball.stl"), 7);
    assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, NULL), MOR_OK);
    for (int a = 0; a < 3; ++a) {
        mesh.vertices[3 * 1000 + a] *= -1.5;
    }
    for (int k = 0; k < 2; ++k) {
        folder->context.n_threads = 1 + k;
        assert_int_equal(mor_mesh_init(&folder->context, mesh.vertices, mesh.n_vertices, mesh.triangles,
                                       mesh.n_triangles, "spiked", &broken, &reports[k]),
                         MOR_ERROR_ARGUMENT);
        memcpy(messages[k], folder->context.message, sizeof messages[k]);
    }
    assert_non_null(strstr(messages[0], "intersects itself"));
    assert_string_equal(messages[0], messages[1]);
    assert_memory_equal(&reports[0], &reports[1], sizeof reports[0]);
    assert_true(reports[0].n_crossings >= 3);
    mor_mesh_clear(&folder->context, &mesh);
}

/* Two cones on one rim: all triangles of each meet in its tip, so all their boxes do. */
static mor_status build_cones(mor_context *context, int n, mor_mesh *mesh)
{
    mor_mesh raw = {.n_vertices = n + 2, .n_triangles = 2 * (int64_t)n};
    assert_int_equal(MOR_NEW(context, &raw.vertices, 3 * raw.n_vertices, "cones"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &raw.triangles, 3 * raw.n_triangles, "cones"), MOR_OK);
    for (int k = 0; k < n; ++k) {
        const int32_t corners[6] = {k, (k + 1) % n, n, (k + 1) % n, k, n + 1};
        raw.vertices[3 * k] = cos(2.0 * MOR_PI * k / n);
        raw.vertices[3 * k + 1] = sin(2.0 * MOR_PI * k / n);
        memcpy(raw.triangles + 6 * (ptrdiff_t)k, corners, sizeof corners);
    }
    raw.vertices[3 * n + 2] = 1.0;
    raw.vertices[3 * n + 5] = -1.0;
    const mor_status status =
        mor_mesh_init(context, raw.vertices, raw.n_vertices, raw.triangles, raw.n_triangles, "cones", mesh, NULL);
    mor_mesh_clear(context, &raw);
    return status;
}

static void many_triangles_in_one_corner_are_checked_or_refused_in_bounded_time(void **state)
{
    run_folder *folder = *state;
    mor_mesh mesh;
    mor_shape_moments moments;
    assert_int_equal(build_cones(&folder->context, 10000, &mesh), MOR_OK);
    mor_mesh_moments(&mesh, &moments);
    assert_near(moments.volume, 2.0 / 3.0 * MOR_PI, 1e-6); /* 2 pi^3 / (3 n^2) * 2 / 3 missing: 1.4e-7 */
    mor_mesh_clear(&folder->context, &mesh);
    const clock_t start = clock();
    assert_int_equal(build_cones(&folder->context, 100000, &mesh), MOR_ERROR_ARGUMENT);
    print_message("refused after %.1f s of processor time\n", (double)(clock() - start) / CLOCKS_PER_SEC);
    assert_non_null(strstr(folder->context.message, "divide long triangles"));
    assert_null(mesh.triangles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(balls_of_up_to_a_million_triangles_approach_the_sphere_in_second_order,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(many_triangles_in_one_corner_are_checked_or_refused_in_bounded_time,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(one_spike_through_a_large_mesh_is_found_for_any_number_of_threads,
                                        run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
