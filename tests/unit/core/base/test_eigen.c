/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/eigen.h"
#include "tests/common/cloud.h"

#include <float.h>
#include <math.h>

enum { RANDOM_TENSORS = 500 };

/* tensor = Q diag(values) Q^T for the columns of Q. */
static void compose(const double *values, const double *q, double *tensor)
{
    static const int rows[6] = {0, 1, 2, 0, 1, 2};
    static const int columns[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c) {
        tensor[c] = 0.0;
        for (int k = 0; k < 3; ++k) {
            tensor[c] += values[k] * q[3 * rows[c] + k] * q[3 * columns[c] + k];
        }
    }
}

static double largest(const double *tensor)
{
    double most = 0.0;
    for (int c = 0; c < 6; ++c) {
        most = fmax(most, fabs(tensor[c]));
    }
    return most;
}

static void sort_three(double *values)
{
    for (int pass = 0; pass < 2; ++pass) {
        for (int k = 0; k < 2; ++k) {
            const double low = fmin(values[k], values[k + 1]);
            values[k + 1] = fmax(values[k], values[k + 1]);
            values[k] = low;
        }
    }
}

static void fill_random(int i, double *tensor)
{
    for (int c = 0; c < 6; ++c) {
        tensor[c] = cloud_number((uint64_t)i, (uint64_t)c, -1.0, 1.0);
    }
}

/* A turn by a random angle about a random axis. */
static void fill_rotation(int i, double *q)
{
    double axis[3];
    for (int a = 0; a < 3; ++a) {
        axis[a] = cloud_number((uint64_t)i, 20 + (uint64_t)a, -1.0, 1.0);
    }
    const double length = mor_vector_length(axis);
    for (int a = 0; a < 3; ++a) {
        axis[a] /= length;
    }
    mor_matrix_rotation(axis, cloud_number((uint64_t)i, 30, -4.0, 4.0), q);
}

/* Directions must be orthonormal and give the tensor back. */
static void assert_diagonalizes(const double *tensor, const double *values, const double *directions)
{
    double back[6];
    for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) {
            double product = 0.0;
            for (int a = 0; a < 3; ++a) {
                product += directions[3 * a + k] * directions[3 * a + l];
            }
            assert_true(fabs(product - (k == l ? 1.0 : 0.0)) < 32 * DBL_EPSILON); /* a dozen rotations, 2 ulp each */
        }
    }
    compose(values, directions, back);
    for (int c = 0; c < 6; ++c) {
        assert_true(fabs(back[c] - tensor[c]) <= 64 * DBL_EPSILON * largest(tensor)); /* as above, and the product */
    }
}

static void random_tensors_are_diagonalized(void **state)
{
    (void)state;
    for (int i = 0; i < RANDOM_TENSORS; ++i) {
        double tensor[6];
        double values[3];
        double directions[9];
        fill_random(i, tensor);
        mor_symmetric_eigen(tensor, values, directions);
        assert_diagonalizes(tensor, values, directions);
    }
}

static void known_values_are_found_in_any_frame(void **state)
{
    (void)state;
    static const double known[][3] = {{1.0, 2.0, 3.0},     {-5.0, 0.0, 5.0}, {2.0, 2.0, 7.0},
                                      {-3.0, -3.0, -3.0},  {0.0, 0.0, 1.0},  {1.0, 1.0 + 1e-9, 1.0 + 2e-9},
                                      {-1.0, -1.0, -1e-8}, {0.0, 0.0, 0.0},  {-4.0, 1e-12, 1e-12}};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        for (int i = 0; i < 40; ++i) {
            double q[9];
            double tensor[6];
            double values[3];
            double directions[9];
            fill_rotation(i, q);
            compose(known[k], q, tensor);
            mor_symmetric_eigen(tensor, values, directions);
            assert_diagonalizes(tensor, values, directions);
            sort_three(values);
            for (int a = 0; a < 3; ++a) {
                /* Values of a symmetric tensor move no more than the tensor does: rounding of tensor and rotations. */
                assert_true(fabs(values[a] - known[k][a]) <= 64 * DBL_EPSILON * 8.0);
            }
        }
    }
}

static void diagonal_tensors_keep_their_axes_exactly(void **state)
{
    (void)state;
    static const double diagonals[][3] = {{-1.3e4, -1.3e4, -1.3e4}, {3.0, -2.0, 0.1}, {0.0, 0.0, 0.0}};
    for (size_t k = 0; k < sizeof diagonals / sizeof *diagonals; ++k) {
        const double tensor[6] = {diagonals[k][0], diagonals[k][1], diagonals[k][2], 0.0, 0.0, 0.0};
        double values[3];
        double directions[9];
        mor_symmetric_eigen(tensor, values, directions);
        assert_memory_equal(values, diagonals[k], sizeof values);
        for (int a = 0; a < 9; ++a) {
            assert_true(directions[a] == (a % 4 == 0 ? 1.0 : 0.0)); /* exact: nothing is to be turned */
        }
    }
}

static void plane_tensor_is_mohrs_circle(void **state)
{
    (void)state;
    for (int i = 0; i < 50; ++i) {
        double t[6] = {0.0};
        double values[3];
        double directions[9];
        for (int c = 0; c < 4; ++c) {
            t[c] = cloud_number((uint64_t)i, 40 + (uint64_t)c, -1.0, 1.0);
        }
        mor_symmetric_eigen(t, values, directions);
        assert_true(values[MOR_ZZ] == t[MOR_ZZ]); /* exact: the third axis takes no part */
        const double center = 0.5 * (t[MOR_XX] + t[MOR_YY]);
        const double radius = hypot(0.5 * (t[MOR_XX] - t[MOR_YY]), t[MOR_XY]);
        assert_true(fabs(fmax(values[0], values[1]) - (center + radius)) < 8 * DBL_EPSILON); /* one rotation */
        assert_true(fabs(fmin(values[0], values[1]) - (center - radius)) < 8 * DBL_EPSILON); /* one rotation */
    }
}

static void unit_of_stress_changes_no_direction(void **state)
{
    (void)state;
    static const int exponents[] = {-300, -20, 1, 17, 300};
    for (int i = 0; i < 60; ++i) {
        double tensor[6];
        double values[3];
        double directions[9];
        fill_random(i, tensor);
        mor_symmetric_eigen(tensor, values, directions);
        for (size_t k = 0; k < sizeof exponents / sizeof *exponents; ++k) {
            double scaled[6];
            double scaled_values[3];
            double scaled_directions[9];
            for (int c = 0; c < 6; ++c) {
                scaled[c] = ldexp(tensor[c], exponents[k]);
            }
            mor_symmetric_eigen(scaled, scaled_values, scaled_directions);
            assert_memory_equal(directions, scaled_directions, sizeof directions);
            for (int a = 0; a < 3; ++a) {
                assert_true(scaled_values[a] == ldexp(values[a], exponents[k])); /* exact: powers of two */
            }
        }
    }
}

static void entries_of_very_different_size_do_not_overflow(void **state)
{
    (void)state;
    static const double tensors[][6] = {{1e200, -1e200, 0.0, 1e-200, 1e-150, 1e100},
                                        {1.0, 2.0, 3.0, 1e-300, 1e-310, 5e-324},
                                        {1e-300, 1e-300, 1e-300, 1.0, 1.0, 1.0},
                                        {0.0, 0.0, 0.0, 1e-160, -1e-160, 1e-160}};
    for (size_t k = 0; k < sizeof tensors / sizeof *tensors; ++k) {
        double values[3];
        double directions[9];
        mor_symmetric_eigen(tensors[k], values, directions);
        assert_diagonalizes(tensors[k], values, directions);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_tensors_are_diagonalized),
        cmocka_unit_test(known_values_are_found_in_any_frame),
        cmocka_unit_test(diagonal_tensors_keep_their_axes_exactly),
        cmocka_unit_test(plane_tensor_is_mohrs_circle),
        cmocka_unit_test(unit_of_stress_changes_no_direction),
        cmocka_unit_test(entries_of_very_different_size_do_not_overflow),
    };
    return CLOUD_RUN(tests);
}
