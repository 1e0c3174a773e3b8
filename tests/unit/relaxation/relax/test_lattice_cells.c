/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/particle/kernel.h"
#include "relaxation/relax/lattice.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Cells that a surface cuts: they stand for the true volume up to the true surface, wherever it lies on the lattice. */

static const double degree = 0.017453292519943295;

typedef struct filled {
    mor_context context;
    mor_shape *shape;
    mor_lattice_points points;
    double *shares;
    double cell; /* volume, m3 or m2 */
} filled;

static void fill_shape(filled *it, const mor_lattice_request *request)
{
    const mor_status status = mor_lattice_fill_cells(&it->context, request, &it->points, &it->shares);
    if (status != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
    it->cell = pow(request->spacing, request->dimension);
}

static void empty(filled *it)
{
    mor_shape_free(&it->context, &it->shape);
    mor_lattice_clear(&it->context, &it->points);
    MOR_FREE(&it->context, &it->shares);
    assert_int_equal(it->context.memory_bytes, 0);
}

static double sum_volume(const filled *it)
{
    double sum = 0.0;
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        sum += it->shares[i] * it->cell;
    }
    return sum;
}

static void a_box_has_its_size_wherever_it_stands(void **state)
{
    (void)state;
    static const double sizes[] = {1.0, 0.8, 0.5, 1.3};
    double worst = 0.0;
    for (int k = 0; k < 4; ++k) {
        for (int shift = 0; shift < 7; ++shift) {
            filled it = {.shares = NULL};
            mor_context_init(&it.context);
            const double low[3] = {0.057 * shift, -0.031 * shift, 0.013 * shift};
            const double high[3] = {low[0] + sizes[k], low[1] + sizes[k], low[2] + 2.0};
            assert_int_equal(mor_shape_new_box(&it.context, low, high, &it.shape), MOR_OK);
            mor_lattice_request request;
            mor_lattice_request_init(&request);
            request.shape = it.shape;
            request.spacing = 0.4;
            fill_shape(&it, &request);
            const double error = sum_volume(&it) / (sizes[k] * sizes[k] * 2.0) - 1.0;
            worst = fmax(worst, fabs(error));
            double middle[3] = {0.0, 0.0, 0.0};
            for (int64_t i = 0; i < it.points.n_points; ++i) {
                /* a part of a cell that is cut stands at its middle */
                assert_true(mor_shape_distance(it.shape, it.points.positions + 3 * i) < 0.125 * 0.4);
                for (int a = 0; a < 3; ++a) {
                    middle[a] += it.shares[i] * it.cell / sum_volume(&it) * it.points.positions[3 * i + a];
                }
            }
            for (int a = 0; a < 3; ++a) {
                assert_true(fabs(middle[a] - 0.5 * (low[a] + high[a])) < 0.01 * 0.4); /* likewise */
            }
            empty(&it);
        }
    }
    print_message("boxes of 1.25 to 3.25 spacings: volume within %.2f %%\n", 100.0 * worst);
    /* faces along the axes are exact; along edges the parts of a cell are judged by one depth */
    assert_true(worst < 0.03);
}

static void a_shape_that_fits_the_lattice_is_filled_as_ever(void **state)
{
    (void)state;
    filled it = {.shares = NULL};
    mor_context_init(&it.context);
    mor_shape *floor = NULL;
    const double low[3] = {-1.0, -1.0, -1.0};
    const double high[3] = {2.0, 1.3, 0.7};
    assert_int_equal(mor_shape_new_box(&it.context, low, high, &it.shape), MOR_OK);
    assert_int_equal(
        mor_shape_new_half_space(&it.context, (const double[]){0, 0, -0.5}, (const double[]){0, 0, 1}, &floor), MOR_OK);
    const mor_shape *const excluded[] = {floor};
    mor_lattice_request request;
    mor_lattice_request_init(&request);
    request.shape = it.shape;
    request.spacing = 0.1;
    request.excluded = excluded;
    request.n_excluded = 1;
    request.depth = 0.4;
    mor_matrix_rotation((const double[]){0, 0.6, 0.8}, 0.3, request.rotation);
    request.translation[1] = 3.0;
    mor_lattice_points plain;
    assert_int_equal(mor_lattice_fill(&it.context, &request, &plain), MOR_OK);
    fill_shape(&it, &request);
    assert_int_equal(it.points.n_points, plain.n_points);
    assert_memory_equal(it.points.positions, plain.positions, 3 * (size_t)plain.n_points * sizeof(double));
    for (int64_t i = 0; i < plain.n_points; ++i) {
        assert_true(it.shares[i] == 1.0);
    }
    mor_lattice_clear(&it.context, &plain);
    mor_shape_free(&it.context, &floor);
    empty(&it);
}

/* Kernel sum of a filled half-space at a place. */
static double sum_kernel(const filled *it, double spacing, const double *place)
{
    double sum = 0.0;
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        const double *x = it->points.positions + 3 * i;
        const double r[3] = {x[0] - place[0], x[1] - place[1], x[2] - place[2]};
        sum += it->shares[i] * it->cell * mor_kernel_value(mor_vector_length(r), 1.3 * spacing, 2);
    }
    return sum;
}

/* Where the kernel sum is one half, in spacings above the true face. */
static double find_surface(const filled *it, const double *foot, const double *normal, double spacing)
{
    double low = -0.6;
    double high = 0.6;
    while (high - low > 1e-6) {
        const double middle = 0.5 * (low + high);
        const double place[3] = {foot[0] + middle * spacing * normal[0], foot[1] + middle * spacing * normal[1], 0.0};
        *(sum_kernel(it, spacing, place) > 0.5 ? &low : &high) = middle;
    }
    return low;
}

/* A staircase of whole cells puts its face up to half a spacing off; cut cells keep to it on any slope. */
static void faces_lie_where_they_are_on_any_slope(void **state)
{
    (void)state;
    const double spacing = 0.1;
    for (int angle = 0; angle <= 45; angle += 15) {
        double worst[2] = {0.0, 0.0};
        for (int shift = 0; shift < 5; ++shift) {
            filled it = {.shares = NULL};
            mor_context_init(&it.context);
            const double normal[3] = {-sin(angle * degree), cos(angle * degree), 0.0};
            const double point[3] = {0.0, 0.02 * shift, 0.0};
            assert_int_equal(mor_shape_new_half_space(&it.context, point, normal, &it.shape), MOR_OK);
            mor_lattice_request request;
            mor_lattice_request_init(&request);
            request.shape = it.shape;
            request.spacing = spacing;
            request.dimension = 2;
            request.domain = (mor_bounds){{-1, -2, 0}, {1, 2, 0}};
            fill_shape(&it, &request);
            filled whole = it;
            assert_int_equal(mor_lattice_fill(&it.context, &request, &whole.points), MOR_OK);
            double ones[4096];
            assert_true(whole.points.n_points <= 4096);
            for (int64_t i = 0; i < whole.points.n_points; ++i) {
                ones[i] = 1.0;
            }
            whole.shares = ones;
            for (int k = 0; k < 9; ++k) {
                const double along = 0.03 * (k - 4);
                const double foot[3] = {along * normal[1], point[1] - along * normal[0], 0.0};
                worst[0] = fmax(worst[0], fabs(find_surface(&it, foot, normal, spacing)));
                worst[1] = fmax(worst[1], fabs(find_surface(&whole, foot, normal, spacing)));
            }
            mor_lattice_clear(&it.context, &whole.points);
            empty(&it);
        }
        print_message("slope of %2d degrees: face within %.3f spacings, of whole cells %.3f\n", angle, worst[0],
                      worst[1]);
        assert_true(worst[0] < 0.05); /* second order in the part of a cell */
        assert_true(worst[1] > 4.0 * worst[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_its_size_wherever_it_stands),
        cmocka_unit_test(a_shape_that_fits_the_lattice_is_filled_as_ever),
        cmocka_unit_test(faces_lie_where_they_are_on_any_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
