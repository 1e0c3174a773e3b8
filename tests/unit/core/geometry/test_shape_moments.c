/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "tests/common/cloud.h"

/* Promised relative accuracy. */
#define PROMISED 1e-5

/* Sums of some thousand compensated terms. */
#define ROUNDING 1e-14

static mor_shape_moments find_moments(mor_context *context, mor_shape **shape, int dimension)
{
    mor_shape_moments moments;
    assert_int_equal(mor_shape_find_moments(context, *shape, dimension, &moments), MOR_OK);
    mor_shape_free(context, shape);
    assert_int_equal(context->memory_bytes, 0);
    return moments;
}

static mor_shape *new_box(mor_context *context, const double *low, const double *high)
{
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_box(context, low, high, &shape), MOR_OK);
    return shape;
}

static mor_shape *new_sphere(mor_context *context, const double *center, double radius)
{
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_sphere(context, center, radius, &shape), MOR_OK);
    return shape;
}

static void assert_near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g, expected %.17g, off by %.3g, allowed %.3g", found, expected, found - expected, tolerance);
    }
}

/* Lengths to a share of the size of the body, inertia to a share of its largest moment. */
static void assert_moments(const mor_shape_moments *found, const mor_shape_moments *expected, double size, double share)
{
    const double largest = fmax(expected->inertia[MOR_XX], fmax(expected->inertia[MOR_YY], expected->inertia[MOR_ZZ]));
    assert_near(found->volume, expected->volume, share * expected->volume);
    for (int a = 0; a < 3; ++a) {
        assert_near(found->center[a], expected->center[a], share * size);
    }
    for (int k = 0; k < 6; ++k) {
        assert_near(found->inertia[k], expected->inertia[k], share * largest);
    }
}

/* Of a box about its center, from its corners. */
static mor_shape_moments box_moments(const double *low, const double *high, int dimension)
{
    mor_shape_moments moments = {.volume = 1.0};
    for (int a = 0; a < dimension; ++a) {
        moments.volume *= high[a] - low[a];
        moments.center[a] = 0.5 * (low[a] + high[a]);
    }
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < 3; ++b) {
            moments.inertia[b] += b != a ? moments.volume * (high[a] - low[a]) * (high[a] - low[a]) / 12.0 : 0.0;
        }
    }
    return moments;
}

static void box_is_exact(void **state)
{
    (void)state;
    static const double boxes[][6] = {{-0.3, -0.1, -0.2, 1.0, 0.9, 0.77},
                                      {1.0, 2.0, -3.0, 2.0, 3.0, 4.0},
                                      {0.0, 0.0, -0.1, 1.0, 2.3, 0.2},
                                      {-5.0, -0.25, -0.25, 5.0, 0.25, 0.5}};
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < sizeof boxes / sizeof *boxes; ++k) {
        for (int dimension = 2; dimension <= 3; ++dimension) {
            mor_shape *shape = new_box(&context, boxes[k], boxes[k] + 3);
            const mor_shape_moments expected = box_moments(boxes[k], boxes[k] + 3, dimension);
            const mor_shape_moments found = find_moments(&context, &shape, dimension);
            assert_moments(&found, &expected, 10.0,
                           10.0 * ROUNDING); /* sides are differences of corners, 10 times as long */
        }
    }
}

static void ball_has_its_closed_form(void **state)
{
    (void)state;
    const double center[3] = {3.0, -2.0, 0.0};
    const double r = 0.7;
    mor_context context;
    mor_context_init(&context);
    mor_shape *shape = new_sphere(&context, center, r);
    const double volume = 4.0 / 3.0 * MOR_PI * r * r * r;
    const double moment = 0.4 * volume * r * r;
    const mor_shape_moments ball = {volume, {3.0, -2.0, 0.0}, {moment, moment, moment, 0.0, 0.0, 0.0}};
    mor_shape_moments found = find_moments(&context, &shape, 3);
    assert_moments(&found, &ball, r, PROMISED); /* promised */
    shape = new_sphere(&context, center, r);
    const double half = 0.25 * MOR_PI * r * r * r * r;
    const mor_shape_moments disc = {MOR_PI * r * r, {3.0, -2.0, 0.0}, {half, half, 2.0 * half, 0.0, 0.0, 0.0}};
    found = find_moments(&context, &shape, 2);
    assert_moments(&found, &disc, r, PROMISED); /* promised */
}

static void cylinder_has_its_closed_form_at_any_tilt(void **state)
{
    (void)state;
    static const double axes[][3] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
    static const double heights[] = {0.5, 1.0, 1.5};
    const double base[3] = {0.5, -0.5, 1.0};
    const double r = 0.5;
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < 3; ++k) {
        const double h = heights[k];
        const double length = mor_vector_length(axes[k]);
        const double volume = MOR_PI * r * r * h;
        const double along = 0.5 * volume * r * r;
        const double across = volume * (3.0 * r * r + h * h) / 12.0;
        mor_shape_moments expected = {.volume = volume};
        double unit[3];
        for (int a = 0; a < 3; ++a) {
            unit[a] = axes[k][a] / length;
            expected.center[a] = base[a] + 0.5 * h * unit[a];
        }
        for (int a = 0; a < 3; ++a) {
            expected.inertia[a] = across + (along - across) * unit[a] * unit[a];
            expected.inertia[3 + a] = (along - across) * unit[a] * unit[(a + 1) % 3];
        }
        mor_shape *shape = NULL;
        assert_int_equal(mor_shape_new_cylinder(&context, base, axes[k], r, h, &shape), MOR_OK);
        const mor_shape_moments found = find_moments(&context, &shape, 3);
        assert_moments(&found, &expected, h + r, PROMISED); /* promised */
    }
}

/* A turned box has what the box has, placed: the one by cells, the other by algebra. */
static void turned_box_agrees_with_the_placed_moments(void **state)
{
    (void)state;
    const double low[3] = {-0.3, -0.1, -0.2};
    const double high[3] = {1.0, 0.9, 0.77};
    mor_context context;
    mor_context_init(&context);
    for (uint64_t k = 0; k < 3; ++k) {
        double axis[3];
        double rotation[9];
        double translation[3];
        const int dimension = k == 2 ? 2 : 3;
        for (uint64_t a = 0; a < 3; ++a) {
            axis[a] = dimension == 3 ? cloud_number(k, a, -1.0, 1.0) : a == 2;
            translation[a] = dimension == 3 || a < 2 ? cloud_number(k, 3 + a, -3.0, 3.0) : 0.0;
        }
        const double length = mor_vector_length(axis);
        for (int a = 0; a < 3; ++a) {
            axis[a] /= length;
        }
        mor_matrix_rotation(axis, cloud_number(k, 6, 0.2, 3.0), rotation);
        mor_shape *box = new_box(&context, low, high);
        mor_shape *shape = NULL;
        assert_int_equal(mor_shape_new_placed(&context, rotation, translation, &box, &shape), MOR_OK);
        mor_shape_moments expected = box_moments(low, high, dimension);
        mor_shape_moments_place(&expected, rotation, translation);
        const mor_shape_moments found = find_moments(&context, &shape, dimension);
        assert_moments(&found, &expected, 1.0, PROMISED); /* promised */
    }
}

/* Of a solid without a part of itself. */
static mor_shape_moments subtract(const mor_shape_moments *from, const mor_shape_moments *minus)
{
    static const int first[6] = {0, 1, 2, 0, 1, 2};
    static const int second[6] = {0, 1, 2, 1, 2, 0};
    const mor_shape_moments *parts[2] = {from, minus};
    mor_shape_moments rest = {.volume = from->volume - minus->volume};
    for (int a = 0; a < 3; ++a) {
        rest.center[a] = (from->volume * from->center[a] - minus->volume * minus->center[a]) / rest.volume;
    }
    for (int p = 0; p < 2; ++p) {
        double arm[3];
        const double sign = p == 0 ? 1.0 : -1.0;
        for (int a = 0; a < 3; ++a) {
            arm[a] = parts[p]->center[a] - rest.center[a];
        }
        for (int k = 0; k < 6; ++k) {
            const double square = k < 3 ? mor_vector_dot(arm, arm) : 0.0;
            rest.inertia[k] +=
                sign * (parts[p]->inertia[k] + parts[p]->volume * (square - arm[first[k]] * arm[second[k]]));
        }
    }
    return rest;
}

static void difference_is_the_difference(void **state)
{
    (void)state;
    const double low[3] = {-1.0, -1.0, -1.0};
    const double high[3] = {1.0, 1.5, 1.0};
    const double center[3] = {0.2, 0.1, -0.1};
    const double r = 0.6;
    const double volume = 4.0 / 3.0 * MOR_PI * r * r * r;
    const double moment = 0.4 * volume * r * r;
    const mor_shape_moments ball = {volume, {0.2, 0.1, -0.1}, {moment, moment, moment, 0.0, 0.0, 0.0}};
    const mor_shape_moments box = box_moments(low, high, 3);
    const mor_shape_moments expected = subtract(&box, &ball);
    mor_context context;
    mor_context_init(&context);
    mor_shape *from = new_box(&context, low, high);
    mor_shape *minus = new_sphere(&context, center, r);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_difference(&context, &from, &minus, &shape), MOR_OK);
    const mor_shape_moments found = find_moments(&context, &shape, 3);
    assert_moments(&found, &expected, 1.0, PROMISED); /* promised */
}

/* Gauss' sums over the edges. */
static void polygon_has_the_moments_of_its_corners(void **state)
{
    (void)state;
    static const double points[] = {0.0, 0.0, 2.0, 0.3, 1.5, 1.8, 0.7, 0.6, -0.4, 1.1};
    enum { N = 5 };
    double area = 0.0;
    double first[2] = {0.0};
    double second[3] = {0.0}; /* xx, yy, xy */
    for (int i = 0; i < N; ++i) {
        const double *p = points + 2 * i;
        const double *q = points + 2 * ((i + 1) % N);
        const double cross = p[0] * q[1] - p[1] * q[0];
        area += cross / 2.0;
        for (int a = 0; a < 2; ++a) {
            first[a] += cross * (p[a] + q[a]) / 6.0;
            second[a] += cross * (p[a] * p[a] + p[a] * q[a] + q[a] * q[a]) / 12.0;
        }
        second[2] += cross * (p[0] * q[1] + 2.0 * p[0] * p[1] + 2.0 * q[0] * q[1] + q[0] * p[1]) / 24.0;
    }
    const double x = first[0] / area;
    const double y = first[1] / area;
    const double xx = second[0] - area * x * x;
    const double yy = second[1] - area * y * y;
    const mor_shape_moments expected = {area, {x, y, 0.0}, {yy, xx, xx + yy, area * x * y - second[2], 0.0, 0.0}};
    double turned[2 * N]; /* the same corners clockwise */
    for (int k = 0; k < 2 * N; ++k) {
        turned[k] = points[2 * (N - 1 - k / 2) + k % 2];
    }
    const double *const orders[2] = {points, turned};
    const double unmoved[3] = {0.0};
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < 2; ++k) {
        mor_shape *shape = NULL;
        mor_shape *silent = NULL;
        mor_shape_moments told;
        assert_int_equal(mor_shape_new_polygon(&context, orders[k], N, &shape), MOR_OK);
        assert_true(mor_shape_moments_known(shape, 2, &told));
        assert_false(mor_shape_moments_known(shape, 3, &told)); /* without end in z */
        const mor_shape_moments found = find_moments(&context, &shape, 2);
        assert_moments(&found, &expected, 1.0, ROUNDING); /* sums of five terms */
        /* A moved shape does not tell: found by cells. */
        assert_int_equal(mor_shape_new_polygon(&context, orders[k], N, &shape), MOR_OK);
        assert_int_equal(mor_shape_new_translate(&context, unmoved, &shape, &silent), MOR_OK);
        assert_false(mor_shape_moments_known(silent, 2, &told));
        const mor_shape_moments integrated = find_moments(&context, &silent, 2);
        assert_moments(&integrated, &expected, 1.0, PROMISED); /* promised */
    }
}

/* A shape whose distances grow as fast as is allowed. */
typedef struct steep_shape {
    mor_shape base;
    const mor_shape *inner;
} steep_shape;

static double steep_distance(const mor_shape *shape, const double *point)
{
    return MOR_SHAPE_SLOPE_MOST * mor_shape_distance(((const steep_shape *)shape)->inner, point);
}

static void steep_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    mor_shape_bounds(((const steep_shape *)shape)->inner, bounds);
}

static void steep_distances_lose_no_cell(void **state)
{
    (void)state;
    static const mor_shape_operations operations = {
        .kind = "steep", .distance = steep_distance, .bounds = steep_bounds};
    const double center[3] = {0.3, -0.2, 0.1};
    mor_context context;
    mor_context_init(&context);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        mor_shape *ball = new_sphere(&context, center, 0.7);
        mor_shape_moments plain;
        mor_shape_moments found;
        const steep_shape steep = {{&operations}, ball};
        assert_int_equal(mor_shape_find_moments(&context, ball, dimension, &plain), MOR_OK);
        assert_int_equal(mor_shape_find_moments(&context, &steep.base, dimension, &found), MOR_OK);
        assert_moments(&found, &plain, 0.7, PROMISED); /* promised; cells skipped too early miss 1.3e-5 in 2D */
        mor_shape_free(&context, &ball);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void unit_of_length_changes_no_bit(void **state)
{
    (void)state;
    static const double units[] = {64.0, 1.0 / 1048576.0};
    mor_context context;
    mor_context_init(&context);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        mor_shape_moments plain = {.volume = 0.0};
        for (int k = -1; k < 2; ++k) {
            const double unit = k < 0 ? 1.0 : units[k];
            const double low[3] = {-0.3 * unit, -0.2 * unit, -0.5 * unit};
            const double high[3] = {0.7 * unit, 0.9 * unit, 0.4 * unit};
            const double center[3] = {0.4 * unit, 0.9 * unit, 0.1 * unit};
            mor_shape *from = new_box(&context, low, high);
            mor_shape *minus = new_sphere(&context, center, 0.55 * unit);
            mor_shape *shape = NULL;
            assert_int_equal(mor_shape_new_difference(&context, &from, &minus, &shape), MOR_OK);
            const mor_shape_moments found = find_moments(&context, &shape, dimension);
            const double cell = dimension == 3 ? unit * unit * unit : unit * unit;
            plain = k < 0 ? found : plain;
            assert_true(found.volume == cell * plain.volume); /* exact: a power of two */
            for (int a = 0; a < 6; ++a) {
                assert_true(found.center[a % 3] == unit * plain.center[a % 3]);         /* exact: likewise */
                assert_true(found.inertia[a] == cell * unit * unit * plain.inertia[a]); /* exact: likewise */
            }
        }
    }
}

static void endless_and_empty_shapes_are_refused(void **state)
{
    (void)state;
    const double origin[3] = {0.0, 0.0, 0.0};
    const double up[3] = {0.0, 0.0, 1.0};
    const double corner[3] = {1.0, 1.0, 1.0};
    mor_context context;
    mor_shape_moments moments;
    mor_context_init(&context);
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_half_space(&context, origin, up, &shape), MOR_OK);
    assert_int_equal(mor_shape_find_moments(&context, shape, 3, &moments), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "is unbounded along x"));
    mor_shape_free(&context, &shape);
    mor_shape *from = new_box(&context, origin, corner);
    mor_shape *minus = new_sphere(&context, origin, 3.0);
    assert_int_equal(mor_shape_new_difference(&context, &from, &minus, &shape), MOR_OK);
    assert_int_equal(mor_shape_find_moments(&context, shape, 3, &moments), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "is empty"));
    assert_true(moments.volume == 0.0); /* exact: cleared */
    mor_shape_free(&context, &shape);
    const double low[3] = {0.0, 0.0, 2.0};
    const double high[3] = {1.0, 1.0, 3.0};
    shape = new_box(&context, low, high); /* does not meet the plane z = 0 */
    assert_int_equal(mor_shape_find_moments(&context, shape, 2, &moments), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_shape_find_moments(&context, shape, 4, &moments), MOR_ERROR_ARGUMENT);
    mor_shape_free(&context, &shape);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_is_exact),
        cmocka_unit_test(ball_has_its_closed_form),
        cmocka_unit_test(cylinder_has_its_closed_form_at_any_tilt),
        cmocka_unit_test(turned_box_agrees_with_the_placed_moments),
        cmocka_unit_test(difference_is_the_difference),
        cmocka_unit_test(polygon_has_the_moments_of_its_corners),
        cmocka_unit_test(steep_distances_lose_no_cell),
        cmocka_unit_test(unit_of_length_changes_no_bit),
        cmocka_unit_test(endless_and_empty_shapes_are_refused),
    };
    return CLOUD_RUN(tests);
}
