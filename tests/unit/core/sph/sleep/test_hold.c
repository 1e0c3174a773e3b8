/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that is not released: what its check refuses. */
#include "core/sph/sleep/hold.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { N = 300 };

static void soil_that_stands_has_no_velocity(void **state)
{
    static const double released[2] = {0.0, 1.0};
    static double region[N], velocity[3 * N];
    mor_context context;
    mor_hold hold;
    (void)state;
    mor_context_init(&context);
    for (int i = 0; i < N; ++i) {
        region[i] = i >= 100;
        velocity[3 * i] = i < 100 ? 2.0 : 0.0;
    }
    assert_int_equal(mor_hold_init(&context, &hold, N, released, 2), MOR_OK);
    mor_hold_find(&hold, region, N, 0.5);
    assert_int_equal(hold.n_held, 200);
    /* 100 is in the middle of cluster 12, whose others move; the last has four particles. */
    assert_int_equal(hold.n_mixed, 4);
    assert_int_equal(hold.mixed[0], 100);
    assert_true(hold.clusters[11] == 0 && hold.clusters[12] == 0);
    assert_true(hold.clusters[13] == 1 && hold.clusters[N / MOR_CLUSTER] == 1);
    assert_int_equal(mor_hold_check(&context, &hold, velocity, N), MOR_OK); /* the others move */
    velocity[3 * 250 + 2] = -1e-300;
    assert_int_equal(mor_hold_check(&context, &hold, velocity, N), MOR_ERROR_INTERNAL);
    mor_hold_find(&hold, region, N, 1.5);
    assert_int_equal(mor_hold_check(&context, &hold, velocity, N), MOR_OK); /* it is released */
    mor_hold_clear(&context, &hold);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(soil_that_stands_has_no_velocity)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
