/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/kernel.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double lengths[] = {1.0, 0.0065, 1e-6, 37.0};
enum { LENGTHS = sizeof lengths / sizeof *lengths, NODES = 5 };

/* Gauss-Legendre nodes and weights on [-1, 1]: exact up to degree 9; value times surface has degree 7 in distance. */
static const double nodes[NODES] = {-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683, 0.906179845938664};
static const double weights[NODES] = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                      0.236926885056189};

/* Surface of the sphere of radius r in so many dimensions. */
static double surface(double r, int dimension)
{
    return dimension == 1 ? 2.0 : dimension == 2 ? 2.0 * MOR_PI * r : 4.0 * MOR_PI * r * r;
}

static void integral_over_space_is_one(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int k = 0; k < LENGTHS; ++k) {
            const double h = lengths[k];
            double sum = 0.0;
            for (int node = 0; node < NODES; ++node) {
                const double r = h * (1.0 + nodes[node]); /* 0 to 2 h */
                sum += h * weights[node] * surface(r, dimension) * mor_kernel_value(r, h, dimension);
            }
            assert_true(fabs(sum - 1.0) < 1e-13); /* the nodes are given to 15 digits */
        }
    }
}

static void gradient_moves_a_linear_field_by_its_slope(void **state)
{
    (void)state;
    /* Integration by parts: the integral of -r dW/dr over space is d times that of W. */
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int k = 0; k < LENGTHS; ++k) {
            const double h = lengths[k];
            double sum = 0.0;
            for (int node = 0; node < NODES; ++node) {
                const double r = h * (1.0 + nodes[node]);
                sum -= h * weights[node] * surface(r, dimension) * r * mor_kernel_derivative(r, h, dimension);
            }
            assert_true(fabs(sum - dimension) < 1e-12); /* the nodes are given to 15 digits */
        }
    }
}

static void values_at_center_and_smoothing_length_are_closed(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        const double alpha = mor_kernel_normalization(1.0, dimension);
        assert_true(mor_kernel_value(0.0, 1.0, dimension) == alpha);              /* exact: (1 - 0)^4 1 */
        assert_true(mor_kernel_value(1.0, 1.0, dimension) == alpha * 3.0 / 16.0); /* exact: powers of two */
        assert_true(mor_kernel_derivative(0.0, 1.0, dimension) == 0.0);           /* exact: a factor is zero */
        const double slope = mor_kernel_derivative(1.0, 1.0, dimension);
        assert_true(fabs(slope + alpha * 5.0 / 8.0) <= 2 * DBL_EPSILON * alpha); /* two products */
    }
    assert_true(mor_kernel_normalization(2.0, 1) == 3.0 / 8.0);                           /* exact: one quotient */
    assert_true(fabs(mor_kernel_normalization(1.0, 2) - 7.0 / (4.0 * MOR_PI)) < 1e-15);   /* one quotient */
    assert_true(fabs(mor_kernel_normalization(1.0, 3) - 21.0 / (16.0 * MOR_PI)) < 1e-15); /* one quotient */
}

static void derivative_is_the_slope_of_the_value(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int k = 0; k < LENGTHS; ++k) {
            const double h = lengths[k];
            const double scale = mor_kernel_normalization(h, dimension) / h;
            for (int i = 1; i < 100; ++i) {
                const double r = 0.02 * i * h;
                const double step = 1e-5 * h;
                const double rise = mor_kernel_value(r + step, h, dimension) - mor_kernel_value(r - step, h, dimension);
                const double slope = rise / (2.0 * step);
                const double derivative = mor_kernel_derivative(r, h, dimension);
                assert_true(fabs(slope - derivative) < 1e-9 * scale); /* truncation 1e-10 W''', rounding 1e-11 */
                assert_true(derivative < 0.0);                        /* inside the support neighbors push apart */
            }
        }
    }
}

static void nothing_is_left_at_the_support_and_beyond(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int k = 0; k < LENGTHS; ++k) {
            const double h = lengths[k];
            for (double r = MOR_KERNEL_SUPPORT * h; r < 10.0 * h; r += 0.37 * h) {
                assert_true(mor_kernel_value(r, h, dimension) == 0.0);      /* exact: lists may hold strangers */
                assert_true(mor_kernel_derivative(r, h, dimension) == 0.0); /* likewise */
            }
            const double edge = 0.999 * MOR_KERNEL_SUPPORT * h;
            assert_true(mor_kernel_value(edge, h, dimension) > 0.0);      /* but not before */
            assert_true(mor_kernel_derivative(edge, h, dimension) < 0.0); /* likewise */
        }
    }
}

static void gradient_factor_gives_the_derivative(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int k = 0; k < LENGTHS; ++k) {
            const double h = lengths[k];
            for (int i = 0; i < 100; ++i) {
                const double r = 0.02 * i * h;
                const double reach = 1.0 - 0.5 * r / h;
                const double expected = mor_kernel_derivative(r, h, dimension);
                const double slope = -mor_kernel_gradient_factor(h, dimension) * reach * reach * reach * r;
                assert_true(fabs(slope - expected) <= 16 * DBL_EPSILON * fabs(expected)); /* eight products */
            }
        }
    }
}

static void unit_of_length_changes_no_bit(void **state)
{
    (void)state;
    for (int dimension = 1; dimension <= 3; ++dimension) {
        for (int i = 0; i < 60; ++i) {
            const double r = 0.0317 * i;
            const double h = 0.9;
            const double value = ldexp(mor_kernel_value(r, h, dimension), -7 * dimension);
            const double slope = ldexp(mor_kernel_derivative(r, h, dimension), -7 * (dimension + 1));
            assert_true(mor_kernel_value(ldexp(r, 7), ldexp(h, 7), dimension) == value);      /* exact: powers of two */
            assert_true(mor_kernel_derivative(ldexp(r, 7), ldexp(h, 7), dimension) == slope); /* likewise */
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integral_over_space_is_one),
        cmocka_unit_test(gradient_moves_a_linear_field_by_its_slope),
        cmocka_unit_test(values_at_center_and_smoothing_length_are_closed),
        cmocka_unit_test(derivative_is_the_slope_of_the_value),
        cmocka_unit_test(nothing_is_left_at_the_support_and_beyond),
        cmocka_unit_test(gradient_factor_gives_the_derivative),
        cmocka_unit_test(unit_of_length_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
