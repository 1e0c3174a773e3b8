/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_check.h"

#include "core/base/math.h"

#include <float.h>

mor_status mor_shape_check_vector(mor_context *context, const double *vector, const char *what)
{
    MOR_CHECK(context, vector != NULL, MOR_ERROR_ARGUMENT, "%s is missing: give three numbers", what);
    MOR_CHECK(context, isfinite(vector[0]) && isfinite(vector[1]) && isfinite(vector[2]), MOR_ERROR_ARGUMENT,
              "%s is (%g, %g, %g): give three finite numbers", what, vector[0], vector[1], vector[2]);
    return MOR_OK;
}

mor_status mor_shape_check_length(mor_context *context, double length, const char *what)
{
    MOR_CHECK(context, isfinite(length) && length > 0.0, MOR_ERROR_ARGUMENT,
              "%s is %g m: give a finite length above zero", what, length);
    return MOR_OK;
}

mor_status mor_shape_check_direction(mor_context *context, const double *direction, const char *what, double *unit)
{
    MOR_TRY(context, mor_shape_check_vector(context, direction, what));
    const double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    MOR_CHECK(context, largest > 0.0, MOR_ERROR_ARGUMENT,
              "%s is (0, 0, 0) and points nowhere: give a direction of any length but zero", what);
    /* Divided by the largest component first, so that no length overflows or vanishes. */
    double scaled[3];
    for (int a = 0; a < 3; ++a) {
        scaled[a] = direction[a] / largest;
        if (fabs(scaled[a]) < 4.0 * DBL_EPSILON) {
            scaled[a] = 0.0;
        }
    }
    const double length = mor_vector_length(scaled);
    for (int a = 0; a < 3; ++a) {
        unit[a] = scaled[a] / length;
    }
    return MOR_OK;
}

mor_status mor_shape_check_rotation(mor_context *context, const double *rotation)
{
    const double tolerance = 1e-9;
    MOR_CHECK(context, rotation != NULL, MOR_ERROR_ARGUMENT, "the rotation is missing: give a rotation matrix");
    for (int a = 0; a < 3; ++a) {
        for (int b = a; b < 3; ++b) {
            const double product = mor_vector_dot(rotation + 3 * a, rotation + 3 * b);
            MOR_CHECK(context, fabs(product - (a == b ? 1.0 : 0.0)) <= tolerance, MOR_ERROR_ARGUMENT,
                      "the rotation is not a rotation matrix: the product of its rows %d and %d is %.12g, not %d; give "
                      "orthonormal rows",
                      a + 1, b + 1, product, a == b);
        }
    }
    const double determinant = mor_matrix_determinant(rotation);
    MOR_CHECK(context, determinant > 0.0, MOR_ERROR_ARGUMENT,
              "the rotation is a reflection: its determinant is %g, not 1; give a rotation matrix", determinant);
    return MOR_OK;
}
