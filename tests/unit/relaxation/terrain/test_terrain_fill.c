/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/particle/kernel.h"
#include "relaxation/terrain/terrain.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { LAYERS = 4, N_NODES = 21 };

static const double smoothing_ratio = 1.3;
static const double origin[2] = {0.0, 0.0};
static const mor_bounds everywhere = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};

/* Slopes along x and y, roughness, and the factor of all lengths. */
typedef struct ground {
    double slope[2];
    double roughness;
    double scale;
} ground;

/* 4 m x 4 m in cells of 0.2 m. */
static mor_terrain make_terrain(mor_context *context, ground it)
{
    mor_terrain terrain = {
        .n_x = N_NODES, .n_y = N_NODES, .cell = {0.203125 * it.scale, 0.203125 * it.scale}, .origin = {0.0, 0.0}};
    assert_int_equal(MOR_NEW(context, &terrain.heights, N_NODES * N_NODES, "heights"), MOR_OK);
    for (int n = 0; n < N_NODES * N_NODES; ++n) {
        const double x = 0.203125 * (n % N_NODES);
        const double y = 0.203125 * (double)(n / N_NODES);
        const double rough = it.roughness * mor_random_uniform(3, (uint64_t)n, 1);
        terrain.heights[n] = it.scale * (it.slope[0] * x + it.slope[1] * y + rough);
    }
    return terrain;
}

static void columns_hang_below_the_surface_as_deep_as_asked(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.1;
    mor_terrain terrain = make_terrain(&context, (ground){{0.3, -0.5}, 0.5, 1.0});
    mor_shape *shape = NULL;
    assert_int_equal(mor_shape_new_terrain(&context, &terrain, 50.0, 2.0, &shape), MOR_OK);
    double *points = NULL;
    int64_t n = 0;
    assert_int_equal(mor_terrain_fill(&context, &terrain, spacing, origin, LAYERS, &everywhere, &points, &n), MOR_OK);
    const double end = 20 * 0.203125;
    int64_t n_columns = 0;
    int layer = 0;
    for (int64_t i = 0; i < n; ++i) {
        const double *point = points + 3 * i;
        const bool is_first = i == 0 || point[0] != point[-3] || point[1] != point[-2];
        layer = is_first ? 0 : layer + 1;
        n_columns += is_first;
        const double depth = mor_terrain_height(&terrain, point[0], point[1]) - point[2];
        assert_true(fabs(depth - (layer + 0.5) * spacing) < 1e-14); /* rounding of numbers near 2 */
        assert_true(point[0] > 0.0 && point[0] < end && point[1] > 0.0 && point[1] < end);
        assert_true(fabs(remainder(point[0] / spacing - 0.5, 1.0)) < 1e-12); /* rounding of 40 */
        /* Depth across the surface: a particle is there down to four spacings, and not below. Sides count as surface to
         * the shape, but not here. */
        if (fmin(fmin(point[0], end - point[0]), fmin(point[1], end - point[1])) > 5 * spacing) {
            const double below[3] = {point[0], point[1], point[2] - spacing};
            const bool is_last = i + 1 == n || point[3] != point[0] || point[4] != point[1];
            assert_true(-mor_shape_distance(shape, point) <=
                        LAYERS * spacing * (1.0 + 1e-8)); /* rounding of the depth */
            assert_true(is_last == (-mor_shape_distance(shape, below) > LAYERS * spacing * (1.0 + 1e-10)));
        }
    }
    assert_int_equal(n_columns, 41 * 41); /* 4.0625 m holds columns from 0.05 m to 4.05 m */
    mor_shape_free(&context, &shape);
    MOR_FREE(&context, &points);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void volume_above_a_level_is_that_of_the_ground(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.203125 / 4.0; /* columns fill the squares of the raster */
    mor_terrain terrain = make_terrain(&context, (ground){{0.3, -0.5}, 0.5, 1.0});
    double *points = NULL;
    int64_t n = 0;
    /* as many layers as reach below every place of the surface */
    assert_int_equal(mor_terrain_fill(&context, &terrain, spacing, origin, 100, &everywhere, &points, &n), MOR_OK);
    const double level = -3.0;
    double measured = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        /* the part of the particle's prism above the level */
        const double top = points[3 * i + 2] + 0.5 * spacing;
        measured += spacing * spacing * fmin(fmax(top - level, 0.0), spacing);
    }
    double exact = 0.0;
    for (int row = 0; row + 1 < N_NODES; ++row) {
        for (int column = 0; column + 1 < N_NODES; ++column) {
            /* two triangles; the cut runs through the middle of the square */
            const double *h = terrain.heights + row * N_NODES + column;
            const double x = (column + 0.5) * 0.203125;
            const double y = (row + 0.5) * 0.203125;
            const double corners = h[0] + h[1] + h[N_NODES] + h[N_NODES + 1];
            exact += 0.203125 * 0.203125 * ((corners + 2.0 * mor_terrain_height(&terrain, x, y)) / 6.0 - level);
        }
    }
    print_message("volume above %g m: %.6f m3, exact %.6f m3\n", level, measured, exact);
    /* The middle of a column stands for its height: no error on a plane; where the fold of a square crosses columns,
     * up to an eighth of (spacing * fold) of height in a quarter of the columns: 0.051 * 2 / 32 over 16.5 m2 at most,
     * and of either sign. */
    assert_true(fabs(measured - exact) < 0.051 * 2.0 / 32.0 * 16.5);
    MOR_FREE(&context, &points);
    mor_terrain_clear(&context, &terrain);
}

/* Sum of W V over all points at a place. */
static double sum_kernel(const double *points, int64_t n, double spacing, const double *place)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        const double offset[3] = {points[3 * i] - place[0], points[3 * i + 1] - place[1], points[3 * i + 2] - place[2]};
        sum += mor_kernel_value(mor_vector_length(offset), smoothing_ratio * spacing, 3);
    }
    return sum * spacing * spacing * spacing;
}

/* Largest distance from the surface, in spacings, of the place where the sum is one half. */
static double measure_surface(mor_context *context, double slope)
{
    const double spacing = 0.1;
    mor_terrain terrain = make_terrain(context, (ground){{slope * 0.8, slope * 0.6}, 0.0, 1.0});
    double *points = NULL;
    int64_t n = 0;
    mor_bounds middle = {{1.5, 1.5, -INFINITY}, {2.5, 2.5, INFINITY}};
    assert_int_equal(mor_terrain_fill(context, &terrain, spacing, origin, LAYERS, &middle, &points, &n), MOR_OK);
    double largest = 0.0;
    for (uint64_t id = 0; id < 40; ++id) {
        const double x = 2.0 + spacing * (mor_random_uniform(4, id, 0) - 0.5);
        const double y = 2.0 + spacing * (mor_random_uniform(4, id, 1) - 0.5);
        const double surface = mor_terrain_height(&terrain, x, y);
        double low = -spacing;
        double high = spacing;
        for (int step = 0; step < 40; ++step) {
            const double gap = 0.5 * (low + high);
            *(sum_kernel(points, n, spacing, (double[3]){x, y, surface + gap}) > 0.5 ? &low : &high) = gap;
        }
        largest = fmax(largest, fabs(low) / sqrt(1.0 + slope * slope) / spacing);
    }
    MOR_FREE(context, &points);
    mor_terrain_clear(context, &terrain);
    return largest;
}

static void kernel_sum_is_one_half_at_the_surface_of_slopes(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const double degrees[] = {0.0, 10.0, 20.0, 30.0, 40.0, 45.0};
    for (int k = 0; k < 6; ++k) {
        const double offset = measure_surface(&context, tan(degrees[k] * MOR_PI / 180.0));
        print_message("slope of %2g degrees: surface within %.4f spacings\n", degrees[k], offset);
        assert_true(offset <
                    0.1); /* a quarter of a spacing is what ground is to be kept to; lattice sums of W ripple */
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void release_columns_stand_on_the_surface(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.1;
    static const double corners[] = {1.0, 1.0, 3.0, 1.0, 3.0, 3.0, 1.0, 3.0};
    mor_terrain terrain = make_terrain(&context, (ground){{0.3, -0.5}, 0.3, 1.0});
    for (int k = 0; k < 2; ++k) {
        const double rim = 0.47 * k; /* no layer ends in the middle of a particle */
        mor_shape *shape = NULL;
        double *points = NULL;
        int64_t n = 0;
        assert_int_equal(mor_shape_new_release(&context, &terrain, corners, 4, 0.5, rim, 1.0, &shape), MOR_OK);
        assert_int_equal(mor_terrain_fill_release(&context, shape, spacing, origin, &points, &n), MOR_OK);
        for (int64_t i = 0; i < n; ++i) {
            const bool is_first =
                i == 0 || points[3 * i] != points[3 * i - 3] || points[3 * i + 1] != points[3 * i - 2];
            const double gap = points[3 * i + 2] - mor_terrain_height(&terrain, points[3 * i], points[3 * i + 1]);
            assert_true(mor_shape_distance(shape, points + 3 * i) < 0.0);
            assert_true(!is_first || fabs(gap - 0.5 * spacing) < 1e-14); /* rounding of numbers near 2 */
        }
        /* As many layers as have their middle below the top of the layer, on each of 20 x 20 columns. */
        int64_t n_expected = 0;
        for (int column = 0; column < 400; ++column) {
            const double x = fmin(column % 20 + 0.5, 19.5 - column % 20);
            const double y = fmin(column / 20 + 0.5, 19.5 - column / 20);
            const double depth = spacing * fmin(x, y);
            const double layer = depth < rim ? 0.5 * depth / rim : 0.5;
            n_expected += (int64_t)floor(layer / spacing + 0.5);
        }
        assert_int_equal(n, n_expected);
        MOR_FREE(&context, &points);
        mor_shape_free(&context, &shape);
    }
    mor_shape *ball = NULL;
    double *points = NULL;
    int64_t n = 0;
    assert_int_equal(mor_shape_new_sphere(&context, (double[3]){0.0}, 1.0, &ball), MOR_OK);
    assert_int_equal(mor_terrain_fill_release(&context, ball, spacing, origin, &points, &n), MOR_ERROR_ARGUMENT);
    assert_null(mor_terrain_view(ball));
    mor_shape_free(&context, &ball);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void fill_does_not_depend_on_threads_or_unit(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double *points[3] = {NULL, NULL, NULL};
    int64_t n[3];
    static const double scales[3] = {1.0, 1.0, 0.03125};
    for (int k = 0; k < 3; ++k) {
        context.n_threads = k == 1 ? 3 : 1;
        mor_terrain terrain = make_terrain(&context, (ground){{0.3, -0.5}, 0.5, scales[k]});
        const double moved[2] = {0.013 * scales[k], -0.3 * scales[k]};
        assert_int_equal(
            mor_terrain_fill(&context, &terrain, 0.07 * scales[k], moved, LAYERS, &everywhere, &points[k], &n[k]),
            MOR_OK);
        mor_terrain_clear(&context, &terrain);
        assert_int_equal(n[k], n[0]);
        for (int64_t i = 0; i < 3 * n[0]; ++i) {
            assert_true(points[k][i] == scales[k] * points[0][i]);
        }
    }
    for (int k = 0; k < 3; ++k) {
        MOR_FREE(&context, &points[k]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void wrong_fills_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain = make_terrain(&context, (ground){{0.0, 0.0}, 0.0, 1.0});
    double *points = NULL;
    int64_t n = 0;
    assert_int_equal(mor_terrain_fill(&context, &terrain, 0.0, origin, 4, &everywhere, &points, &n),
                     MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_terrain_fill(&context, &terrain, 0.1, origin, 0, &everywhere, &points, &n),
                     MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_terrain_fill(&context, &terrain, 1e-9, origin, 4, &everywhere, &points, &n),
                     MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_terrain_fill(&context, &terrain, 1e-5, origin, 4, &everywhere, &points, &n),
                     MOR_ERROR_ARGUMENT);
    const mor_bounds beside = {{9.0, 9.0, 0.0}, {10.0, 10.0, 1.0}};
    assert_int_equal(mor_terrain_fill(&context, &terrain, 0.1, origin, 4, &beside, &points, &n), MOR_OK);
    assert_int_equal(n, 0);
    assert_null(points);
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_hang_below_the_surface_as_deep_as_asked),
        cmocka_unit_test(volume_above_a_level_is_that_of_the_ground),
        cmocka_unit_test(kernel_sum_is_one_half_at_the_surface_of_slopes),
        cmocka_unit_test(release_columns_stand_on_the_surface),
        cmocka_unit_test(fill_does_not_depend_on_threads_or_unit),
        cmocka_unit_test(wrong_fills_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
