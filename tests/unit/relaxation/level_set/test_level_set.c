/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/level_set/level_set.h"
#include "relaxation/mesh/outline.h"
#include "tests/common/cloud.h"
#include "tests/common/mesh_forms.h"
#include "tests/common/near.h"

#include <unistd.h>

enum { N_POINTS = 50000 };

/* A shape that does not tell its moments: they are then integrated from its distances. */
typedef struct silent_shape {
    mor_shape base;
    const mor_shape *inner;
} silent_shape;

static double silent_distance(const mor_shape *shape, const double *point)
{
    return mor_shape_distance(((const silent_shape *)shape)->inner, point);
}

static void silent_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    mor_shape_bounds(((const silent_shape *)shape)->inner, bounds);
}

static const mor_shape_operations silent_operations = {
    .kind = "silent", .distance = silent_distance, .bounds = silent_bounds};

static void draw_point(uint64_t id, double reach, double *point)
{
    for (int a = 0; a < 3; ++a) {
        point[a] = cloud_number(id, 200 + (uint64_t)a, -reach, reach);
    }
}

/* Ball or cube of half a meter, by kind. */
static mor_shape *new_source(mor_context *context, int kind)
{
    const double center[3] = {0.0, 0.0, 0.0};
    const double low[3] = {-0.5, -0.5, -0.5};
    const double high[3] = {0.5, 0.5, 0.5};
    mor_shape *shape = NULL;
    const mor_status status =
        kind == 0 ? mor_shape_new_sphere(context, center, 0.5, &shape) : mor_shape_new_box(context, low, high, &shape);
    assert_int_equal(status, MOR_OK);
    return shape;
}

static mor_shape *new_level_set(mor_context *context, const mor_shape *source, int dimension, double cell, double band)
{
    const mor_level_set_request request = {dimension, cell, band};
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_level_set(context, source, &request, &shape), MOR_OK);
    return shape;
}

static mor_shape *new_mesh_shape(mor_context *context, const mor_mesh *mesh, double cell, double band)
{
    const mor_level_set_request request = {3, cell, band};
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_mesh(context, mesh, &request, &shape), MOR_OK);
    return shape;
}

/* Mean and largest difference of two shapes within a twentieth of a meter from the surface. */
static void compare_shapes(const mor_shape *exact, const mor_shape *other, mor_shape_measure measure, double *mean,
                           double *largest)
{
    double sum = 0.0;
    int n_near = 0;
    *largest = 0.0;
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        draw_point(id, 0.6, point);
        const double distance = mor_shape_distance(exact, point);
        if (fabs(distance) < 0.05) {
            const double error = fabs(measure(other, point) - distance);
            sum += error;
            *largest = fmax(*largest, error);
            ++n_near;
        }
    }
    *mean = sum / n_near;
}

static void error_of_a_ball_is_third_order(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *ball = new_source(&context, 0);
    double before = NAN;
    for (int n = 20; n <= 80; n *= 2) {
        double mean;
        double largest;
        mor_shape *set = new_level_set(&context, ball, 3, 1.0 / n, 0.15);
        compare_shapes(ball, set, mor_shape_distance, &mean, &largest);
        print_message("ball, %d cells across: mean error %.2e m, largest %.2e m\n", n, mean, largest);
        if (n > 20) {
            assert_true(before > 7.0 * largest); /* halved cells: 8 for the third order of cubic convolution */
        }
        before = largest;
        mor_shape_free(&context, &set);
    }
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
}

static void error_of_a_cube_is_second_order(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *box = new_source(&context, 1);
    mor_mesh mesh = mesh_cube(&context, 0.5);
    double before = NAN;
    for (int n = 20; n <= 80; n *= 2) {
        double mean;
        double largest;
        mor_shape *set = new_mesh_shape(&context, &mesh, 1.0 / n, 0.15);
        compare_shapes(box, set, mor_shape_distance, &mean, &largest);
        print_message("cube, %d cells across: mean error %.2e m, largest %.2e m\n", n, mean, largest);
        assert_true(largest < 0.25 / n); /* at edges inside distance has a kink, which costs a part of a cell */
        if (n > 20) {
            assert_true(before > 3.6 * mean); /* halved cells: 4, as large an error in half the layer; drawing */
        }
        before = mean;
        mor_shape_free(&context, &set);
    }
    mor_mesh_clear(&context, &mesh);
    mor_shape_free(&context, &box);
}

/* Two cells and more from kinks, distance to a plane is linear, and so is what is between the nodes. */
static void faces_of_a_cube_are_exact(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_cube(&context, 0.5);
    mor_shape *set = new_mesh_shape(&context, &mesh, 0.03, 0.2); /* cells do not divide the cube */
    for (uint64_t id = 0; id < 10000; ++id) {
        const double point[3] = {cloud_number(id, 1, -0.3, 0.3), cloud_number(id, 2, 0.44, 0.56),
                                 cloud_number(id, 3, -0.3, 0.3)};
        assert_near(mor_shape_distance(set, point), point[1] - 0.5, 4e-15); /* 64 terms to 0.1, rounded */
    }
    mor_shape_free(&context, &set);
    mor_mesh_clear(&context, &mesh);
}

static void far_from_the_surface_the_value_is_a_lower_bound_of_right_sign(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int kind = 0; kind < 2; ++kind) {
        mor_shape *source = new_source(&context, kind);
        mor_shape *set = new_level_set(&context, source, 3, 0.05, 0.15);
        for (uint64_t id = 0; id < N_POINTS; ++id) {
            double point[3];
            draw_point(id, id % 2 == 0 ? 0.7 : 4.0, point);
            const double exact = mor_shape_distance(source, point);
            const double value = mor_shape_distance(set, point);
            if (fabs(exact) > 0.15) {
                assert_true(value * exact > 0.0);
                assert_true(fabs(value) <= fabs(exact) * (1.0 + 1e-15)); /* the law, and rounding */
                assert_true(fabs(value) > 0.1); /* not less than the band by more than a cell */
            }
        }
        mor_shape_free(&context, &set);
        mor_shape_free(&context, &source);
    }
}

static void value_goes_on_without_a_step_beyond_the_grid(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *ball = new_source(&context, 0);
    mor_shape *set = new_level_set(&context, ball, 3, 0.05, 0.15);
    for (uint64_t id = 0; id < 1000; ++id) {
        double direction[3];
        draw_point(id, 1.0, direction);
        const double length = mor_vector_length(direction);
        double before = mor_shape_distance(set, (const double[3]){0.0, 0.0, 0.0});
        for (int k = 1; k < 400; ++k) {
            const double at = 0.005 * k / length;
            const double point[3] = {at * direction[0], at * direction[1], at * direction[2]};
            const double value = mor_shape_distance(set, point);
            assert_true(fabs(value - before) <= 1.4 * 0.005); /* 4/3 where a cubic turns at the kink of the band */
            before = value;
        }
        assert_true(before > 0.75); /* 2 m from the center, toward a corner of a grid that ends at 0.7 m: 0.79 m */
    }
    mor_shape_free(&context, &set);
    mor_shape_free(&context, &ball);
}

/* The law of shapes, over lengths on which it is used: 1.1 m per m. Within a cell of a kink it may be steeper. */
static void value_changes_by_at_most_a_tenth_more_than_the_way(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double cell = 0.05;
    mor_mesh mesh = mesh_cube(&context, 0.5);
    mor_shape *set = new_mesh_shape(&context, &mesh, cell, 0.2);
    double steepest[2] = {0.0, 0.0};
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double from[3];
        double to[3];
        double way[3];
        draw_point(id, 0.7, from);
        draw_point(id + N_POINTS, 1.0, way);
        const bool is_short = id % 2 == 0;
        const double length = cell * (is_short ? cloud_number(id, 9, 0.01, 1.0) : cloud_number(id, 9, 2.0, 8.0));
        for (int a = 0; a < 3; ++a) {
            to[a] = from[a] + way[a] * length / mor_vector_length(way);
        }
        const double change = fabs(mor_shape_distance(set, to) - mor_shape_distance(set, from));
        steepest[is_short] = fmax(steepest[is_short], change / length);
    }
    print_message("steepest: %.3f m/m over two cells and more, %.3f m/m over less than one\n", steepest[0],
                  steepest[1]);
    assert_true(steepest[0] <= MOR_SHAPE_SLOPE_MOST); /* the law */
    assert_true(steepest[1] <= 1.4);                  /* 4/3 where a cubic turns at a node of a kink */
    mor_shape_free(&context, &set);
    mor_mesh_clear(&context, &mesh);
}

/* Moments integrated from distances, against the exact ones of the mesh, at 20 particles across. */
static void expect_mesh_moments(mor_context *context, const mor_mesh *mesh, const char *name)
{
    mor_bounds bounds;
    mor_shape_moments exact;
    mor_shape_moments told;
    mor_shape_moments found;
    mor_mesh_bounds(mesh, &bounds);
    mor_mesh_moments(mesh, &exact);
    const double spacing = (bounds.maximum[0] - bounds.minimum[0]) / 20.0;
    mor_shape *set = new_mesh_shape(context, mesh, 0.5 * spacing, 4.0 * spacing);
    assert_true(mor_shape_moments_known(set, 3, &told));
    assert_memory_equal(&told, &exact, sizeof exact); /* exact: those of the mesh */
    assert_false(mor_shape_moments_known(set, 2, &told));
    const silent_shape silent = {{&silent_operations}, set};
    assert_int_equal(mor_shape_find_moments(context, &silent.base, 3, &found), MOR_OK);
    const double trace = mor_symmetric_trace(exact.inertia);
    double worst = 0.0;
    for (int k = 0; k < 6; ++k) {
        worst = fmax(worst, fabs(found.inertia[k] - exact.inertia[k]) / (trace / 3.0));
    }
    print_message("%s: volume %.5f m3, of the level set %+.3f %%; inertia %.3f %%\n", name, exact.volume,
                  100.0 * (found.volume / exact.volume - 1.0), 100.0 * worst);
    assert_near(found.volume, exact.volume, 0.01 * exact.volume); /* the law: 1 % at 20 particles */
    assert_true(worst < 0.02);                                    /* the law: 2 % */
    mor_shape_free(context, &set);
}

static void moments_of_the_level_set_are_those_of_the_mesh(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh cube = mesh_cube(&context, 0.5);
    expect_mesh_moments(&context, &cube, "cube");
    mor_mesh_clear(&context, &cube);
    mor_mesh ball = mesh_ball(&context, 0.5, 3);
    expect_mesh_moments(&context, &ball, "ball");
    mor_mesh_clear(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
}

static void moments_of_the_level_set_are_those_of_scanned_rocks(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const double volumes[3] = {0.45576, 1.17584, 0.70792};
    for (int rock = 0; rock < 3; ++rock) {
        char path[512];
        mor_mesh mesh;
        snprintf(path, sizeof path, "%s/../shared/data/rocks/rock%d.obj", MOR_SOURCE_DIR, rock + 1);
        if (access(path, R_OK) != 0) {
            print_message("skipped: there is no %s\n", path);
            skip();
        }
        assert_int_equal(mor_mesh_read(&context, path, &mesh, NULL), MOR_OK);
        mor_shape_moments exact;
        mor_mesh_moments(&mesh, &exact);
        assert_near(exact.volume, volumes[rock], 6e-6); /* five digits are stated */
        expect_mesh_moments(&context, &mesh, strrchr(path, '/') + 1);
        mor_mesh_clear(&context, &mesh);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void level_set_of_a_shape_knows_moments_when_the_shape_does(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double corners[8] = {0.0, 0.0, 2.0, 0.0, 2.0, 1.0, 0.0, 1.0};
    mor_outline outline;
    mor_shape *profile = NULL;
    mor_shape_moments moments;
    assert_int_equal(mor_outline_init(&context, corners, 4, &outline), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, outline.points, outline.n_points, &profile), MOR_OK);
    mor_shape *set = new_level_set(&context, profile, 2, 0.05, 0.2);
    assert_true(mor_shape_moments_known(set, 2, &moments));
    assert_near(moments.volume, 2.0, 1e-15); /* rounding */
    const double point[3] = {1.0, 0.9, 77.0};
    assert_near(mor_shape_distance(set, point), -0.1, 1e-15); /* rounding; z does not matter */
    mor_shape_free(&context, &set);
    mor_shape_free(&context, &profile);
    mor_outline_clear(&context, &outline);
    mor_shape *ball = new_source(&context, 0);
    set = new_level_set(&context, ball, 3, 0.05, 0.2);
    assert_false(mor_shape_moments_known(set, 3, &moments));
    mor_shape_free(&context, &set);
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
}

/* The same mesh in another unit and with other threads: each value must be the same bits. */
static void threads_and_units_change_no_bit(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_ball(&context, 0.7, 2);
    mor_shape *set = new_mesh_shape(&context, &mesh, 0.04, 0.15);
    for (int variant = 0; variant < 3; ++variant) {
        const double factor = variant == 0 ? 1.0 : variant == 1 ? 1024.0 : ldexp(1.0, -50);
        context.n_threads = variant + 2;
        mor_mesh scaled = mesh_from(&context, mesh.vertices, mesh.n_vertices, mesh.triangles, mesh.n_triangles);
        for (int64_t k = 0; k < 3 * scaled.n_vertices; ++k) {
            scaled.vertices[k] *= factor;
        }
        mor_shape *other = new_mesh_shape(&context, &scaled, 0.04 * factor, 0.15 * factor);
        for (uint64_t id = 0; id < 20000; ++id) {
            double point[3];
            draw_point(id, 1.2, point);
            const double there[3] = {factor * point[0], factor * point[1], factor * point[2]};
            assert_true(mor_shape_distance(set, point) * factor == mor_shape_distance(other, there)); /* exact */
        }
        mor_shape_free(&context, &other);
        mor_mesh_clear(&context, &scaled);
    }
    mor_shape_free(&context, &set);
    mor_mesh_clear(&context, &mesh);
    assert_int_equal(context.memory_bytes, 0);
}

/* The shape's bounds hold every point that its distance calls inside. */
static void no_inside_is_beyond_the_bounds(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_ball(&context, 0.5, 0);
    mor_shape *set = new_mesh_shape(&context, &mesh, 0.06, 0.2);
    mor_bounds bounds;
    mor_shape_bounds(set, &bounds);
    int n_inside = 0;
    for (uint64_t id = 0; id < N_POINTS; ++id) {
        double point[3];
        draw_point(id, 0.6, point);
        bool is_held = true;
        for (int a = 0; a < 3; ++a) {
            is_held = is_held && point[a] >= bounds.minimum[a] && point[a] <= bounds.maximum[a];
        }
        const bool is_inside = mor_shape_distance(set, point) < 0.0;
        n_inside += is_inside;
        assert_true(is_held || !is_inside);
    }
    assert_true(n_inside > N_POINTS / 10);
    mor_shape_free(&context, &set);
    mor_mesh_clear(&context, &mesh);
}

static void wrong_requests_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const double normal[3] = {0.0, 0.0, 1.0};
    mor_mesh mesh = mesh_cube(&context, 0.5);
    mor_shape *half = NULL;
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_half_space(&context, (const double[3]){0.0, 0.0, 0.0}, normal, &half), MOR_OK);
    static const mor_level_set_request wrong[] = {
        {2, 0.1, 0.4},  /* a mesh has no plane form */
        {3, 0.1, 0.25}, /* less than three cells */
        {3, 0.0, 0.4},    {3, NAN, 0.4}, {3, 0.1, INFINITY}, {4, 0.1, 0.4}, {3, 0.001, 0.01}, /* a milliard of nodes */
        {3, 1e-300, 1.0},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        assert_int_equal(mor_shape_new_mesh(&context, &mesh, &wrong[k], &shape), MOR_ERROR_ARGUMENT);
        assert_null(shape);
    }
    const mor_level_set_request right = {3, 0.1, 0.3}; /* three cells, rounded */
    assert_int_equal(mor_shape_new_level_set(&context, half, &right, &shape), MOR_ERROR_ARGUMENT);
    assert_null(shape);
    assert_non_null(strstr(context.message, "cut it to a box"));
    assert_int_equal(mor_shape_new_mesh(&context, &mesh, &right, &shape), MOR_OK);
    mor_shape_free(&context, &shape);
    mor_shape_free(&context, &half);
    mor_mesh_clear(&context, &mesh);
    assert_int_equal(context.memory_bytes, 0);
}

/* The exact distance of a mesh has no bulges beside edges, however it is placed, scaled and combined; rounding of a
 * meter is far below 1e-14. */
static void exact_distance_of_a_mesh_is_that_of_its_faces(void **state)
{
    (void)state;
    static const double upright[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double origin[3] = {0.0, 0.0, 0.0};
    mor_context context;
    mor_context_init(&context);
    mor_mesh mesh = mesh_cube(&context, 0.25);
    mor_shape *cube = new_source(&context, 1);
    mor_shape *scaled = new_mesh_shape(&context, &mesh, 0.025, 0.1);
    mor_shape *placed = NULL;
    mor_shape *whole = NULL;
    mor_mesh_clear(&context, &mesh); /* what is asked is a copy */
    assert_int_equal(mor_shape_new_scaled(&context, 2.0, &scaled, &placed), MOR_OK);
    assert_int_equal(mor_shape_new_placed(&context, upright, origin, &placed, &whole), MOR_OK);
    double mean, largest;
    compare_shapes(cube, whole, mor_shape_exact_distance, &mean, &largest);
    assert_true(largest < 1e-14);
    compare_shapes(cube, whole, mor_shape_distance, &mean, &largest);
    assert_true(largest > 1e-3); /* the interpolated distance is farther off */
    mor_shape_free(&context, &whole);
    mor_shape_free(&context, &cube);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_of_a_ball_is_third_order),
        cmocka_unit_test(error_of_a_cube_is_second_order),
        cmocka_unit_test(faces_of_a_cube_are_exact),
        cmocka_unit_test(exact_distance_of_a_mesh_is_that_of_its_faces),
        cmocka_unit_test(far_from_the_surface_the_value_is_a_lower_bound_of_right_sign),
        cmocka_unit_test(value_goes_on_without_a_step_beyond_the_grid),
        cmocka_unit_test(value_changes_by_at_most_a_tenth_more_than_the_way),
        cmocka_unit_test(moments_of_the_level_set_are_those_of_the_mesh),
        cmocka_unit_test(moments_of_the_level_set_are_those_of_scanned_rocks),
        cmocka_unit_test(level_set_of_a_shape_knows_moments_when_the_shape_does),
        cmocka_unit_test(threads_and_units_change_no_bit),
        cmocka_unit_test(no_inside_is_beyond_the_bounds),
        cmocka_unit_test(wrong_requests_are_refused),
    };
    return CLOUD_RUN(tests);
}
