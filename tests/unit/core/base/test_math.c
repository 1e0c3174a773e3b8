/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/cloud.h"

static void draw(uint64_t id, int n, double *numbers)
{
    for (int k = 0; k < n; ++k) {
        numbers[k] = cloud_number(id, (uint64_t)k, -2.0, 2.0);
    }
}

/* At right angles to both, as large as the parallelogram, and right-handed. */
static void vector_product_is_the_area_of_the_parallelogram(void **state)
{
    (void)state;
    const double x[3] = {1.0, 0.0, 0.0};
    const double y[3] = {0.0, 1.0, 0.0};
    double z[3];
    mor_vector_cross(x, y, z);
    assert_true(z[0] == 0.0 && z[1] == 0.0 && z[2] == 1.0); /* exact */
    for (uint64_t id = 0; id < 100; ++id) {
        double a[6];
        double c[3];
        draw(id, 6, a);
        const double *b = a + 3;
        mor_vector_cross(a, b, c);
        const double along = mor_vector_dot(a, b);
        const double area2 = mor_vector_dot(a, a) * mor_vector_dot(b, b) - along * along;
        assert_true(fabs(mor_vector_dot(a, c)) <= 1e-14);         /* rounding of numbers up to 30 */
        assert_true(fabs(mor_vector_dot(b, c)) <= 1e-14);         /* likewise */
        assert_true(fabs(mor_vector_dot(c, c) - area2) <= 1e-13); /* rounding of numbers up to 150 */
    }
}

static void adding_a_vector_product_adds_that_product(void **state)
{
    (void)state;
    for (uint64_t id = 0; id < 100; ++id) {
        double a[10];
        double c[3];
        draw(id, 10, a);
        mor_vector_cross(a, a + 3, c);
        double sum[3] = {a[6], a[7], a[8]};
        mor_vector_cross_add(a[9], a, a + 3, sum);
        for (int k = 0; k < 3; ++k) {
            assert_true(sum[k] == a[6 + k] + a[9] * c[k]); /* exact: the same operations */
        }
    }
}

static void tensor_times_its_cofactors_is_its_determinant(void **state)
{
    (void)state;
    for (uint64_t id = 0; id < 100; ++id) {
        double tensor[6];
        double cofactors[6];
        draw(id, 6, tensor);
        const double determinant = mor_symmetric_cofactors(tensor, cofactors);
        for (int axis = 0; axis < 3; ++axis) {
            const double unit[3] = {axis == 0, axis == 1, axis == 2};
            double turned[3];
            double back[3];
            mor_symmetric_apply(cofactors, unit, turned);
            mor_symmetric_apply(tensor, turned, back);
            for (int k = 0; k < 3; ++k) {
                assert_true(fabs(back[k] - determinant * unit[k]) <= 1e-14); /* rounding of numbers up to 16 */
            }
        }
    }
}

/* The volume between the rows, with the sign of their handedness: six for rows that are 1, 2 and 3 long. */
static void determinant_is_the_triple_product_of_the_rows(void **state)
{
    (void)state;
    const double stretch[9] = {0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 0.0, 3.0, 0.0}; /* z, x, y: right-handed */
    assert_true(mor_matrix_determinant(stretch) == 6.0);                     /* exact */
    for (uint64_t id = 0; id < 100; ++id) {
        double matrix[9];
        double normal[3];
        draw(id, 9, matrix);
        mor_vector_cross(matrix + 3, matrix + 6, normal);
        const double volume = mor_vector_dot(matrix, normal);
        assert_true(mor_matrix_determinant(matrix) == volume); /* exact: the same operations */
    }
}

/* What is damped locally comes back: damping changes a rate by a share of its own size against the motion. */
static void local_damping_is_undone(void **state)
{
    static const double motions[][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {-3.0, 2.0, 5.0}, {1e-9, -1e-9, 2e-9}};
    static const double rates[][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {-4.0, 3.0, 12.0}, {2.0, -1.0, -3.0}};
    (void)state;
    for (int m = 0; m < 4; ++m) {
        for (int r = 0; r < 4; ++r) {
            double rate[3] = {rates[r][0], rates[r][1], rates[r][2]};
            mor_damp_locally(0.8, motions[m], rate);
            double taken[3];
            for (int a = 0; a < 3; ++a) {
                taken[a] = rates[r][a] - rate[a];
            }
            const double share = m == 0 ? 0.0 : 0.8;
            assert_true(fabs(mor_vector_length(taken) - share * mor_vector_length(rates[r])) < 1e-14 * 13.0); /* ulp */
            assert_true(mor_vector_dot(taken, motions[m]) >= 0.0);
            mor_undamp_locally(0.8, motions[m], rate);
            for (int a = 0; a < 3; ++a) {
                assert_true(fabs(rate[a] - rates[r][a]) < 1e-13 * 13.0); /* rounding over 1 - 0.8^2 */
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vector_product_is_the_area_of_the_parallelogram),
        cmocka_unit_test(adding_a_vector_product_adds_that_product),
        cmocka_unit_test(tensor_times_its_cofactors_is_its_determinant),
        cmocka_unit_test(determinant_is_the_triple_product_of_the_rows),
        cmocka_unit_test(local_damping_is_undone),
    };
    return CLOUD_RUN(tests);
}
