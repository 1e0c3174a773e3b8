/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "materials/frame/lane_math.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void exponential_and_logarithm_agree_with_the_library(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 200000; ++k) {
        const double x = 1390.0 * (mor_random_uniform(5, k, 0) - 0.5);
        const double y = pow(10.0, 600.0 * (mor_random_uniform(5, k, 1) - 0.5));
        const double near = 1.0 + 1e-3 * (mor_random_uniform(5, k, 2) - 0.5);
        assert_true(fabs(mor_lane_exp(x) / exp(x) - 1.0) < 4.0 * DBL_EPSILON); /* a few ulp: polynomial, reduction */
        assert_true(fabs(mor_lane_log(y) / log(y) - 1.0) < 4.0 * DBL_EPSILON); /* likewise */
        assert_true(fabs(mor_lane_log(near) - log(near)) <= 4.0 * DBL_EPSILON * fabs(log(near)) + 1e-300);
    }
    assert_true(mor_lane_exp(0.0) == 1.0 && mor_lane_log(1.0) == 0.0); /* exact */
}

static void arguments_out_of_range_stay_finite(void **state)
{
    (void)state;
    assert_true(mor_lane_exp(-1e300) == mor_lane_exp(-700.0));  /* exact: the same argument */
    assert_true(mor_lane_exp(INFINITY) == mor_lane_exp(700.0)); /* likewise */
    assert_true(isfinite(mor_lane_exp(-INFINITY)) && isfinite(mor_lane_log(1e-300)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exponential_and_logarithm_agree_with_the_library),
        cmocka_unit_test(arguments_out_of_range_stay_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
