/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that is not released: what its check refuses. */
#include "core/sph/sleep/hold.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { N = 300 };

static void soil_that_stands_has_no_velocity(void **state)
{
    static const double released[2] = {0.0, 1.0};
    static double region[N], velocity[3 * N];
    mor_context context;
    mor_hold hold;
    mor_set set;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_set_init(&context, &set, "sand", N, (uint64_t)1 << MOR_FIELD_POSITION), MOR_OK);
    for (int i = 0; i < N; ++i) {
        region[i] = i >= 100;
        velocity[3 * i] = i < 100 ? 2.0 : 0.0;
    }
    assert_int_equal(mor_hold_init(&context, &hold, N, released, 2), MOR_OK);
    assert_int_equal(mor_hold_find(&context, &hold, &set, region, 0.5), MOR_OK);
    assert_int_equal(hold.n_held, 200);
    /* 100 is in the middle of cluster 12, whose others move; the last has four particles. */
    assert_int_equal(hold.n_mixed, 4);
    assert_int_equal(hold.mixed[0], 100);
    assert_true(hold.clusters[11] == 0 && hold.clusters[12] == 0);
    assert_true(hold.clusters[13] == 1 && hold.clusters[N / MOR_CLUSTER] == 1);
    assert_int_equal(mor_hold_check(&context, &hold, &set, velocity), MOR_OK); /* the others move */
    velocity[3 * 250 + 2] = -1e-300;
    set.id[250] = 88;
    assert_int_equal(mor_hold_check(&context, &hold, &set, velocity), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "particle 88 of set 'sand'"));
    assert_int_equal(context.particle, 88);
    assert_int_equal(mor_hold_find(&context, &hold, &set, region, 1.5), MOR_OK);
    assert_int_equal(mor_hold_check(&context, &hold, &set, velocity), MOR_OK); /* it is released */
    mor_hold_clear(&context, &hold);
    mor_set_clear(&context, &set);
}

/* A number that is no region, as a file may hold it, would be a place behind the times. */
static void particle_of_no_region_is_named(void **state)
{
    static const double released[2] = {0.0, 1.0};
    static const double wrong[] = {2.0, -1.0, 1e300, NAN};
    double region[3] = {0.0, 1.0, 1.0};
    mor_context context;
    mor_hold hold;
    mor_set set;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_set_init(&context, &set, "sand", 3, 0), MOR_OK);
    assert_int_equal(mor_hold_init(&context, &hold, 3, released, 2), MOR_OK);
    set.id[2] = 77;
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        region[2] = wrong[k];
        assert_int_equal(mor_hold_find(&context, &hold, &set, region, 0.5), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, "particle 77 of set 'sand' is of soil region"));
    }
    region[2] = 1.0;
    assert_int_equal(mor_hold_find(&context, &hold, &set, region, 0.5), MOR_OK);
    assert_int_equal(hold.n_held, 2);
    mor_hold_clear(&context, &hold);
    mor_set_clear(&context, &set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(soil_that_stands_has_no_velocity),
                                       cmocka_unit_test(particle_of_no_region_is_named)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
