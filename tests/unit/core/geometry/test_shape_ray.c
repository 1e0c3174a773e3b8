/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double radius = 0.6;
static const double touch = 1e-3;

static double draw(uint64_t id, uint64_t purpose)
{
    return 2.0 * mor_random_uniform(11, id, purpose) - 1.0;
}

/* Rays from a sphere of twice the radius to random places; those that pass the surface by less than ten times touch,
 * where grazing may count as either, are left out. */
static void a_ray_meets_a_sphere_where_its_quadratic_has_a_root_in_reach(void **state)
{
    (void)state;
    static const double center[3] = {0.0, 0.0, 0.0};
    enum { N_RAYS = 400 };
    mor_context context;
    mor_shape *sphere = NULL;
    int n_met = 0;
    int n_missed = 0;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_sphere(&context, center, radius, &sphere), MOR_OK);
    for (uint64_t k = 0; k < N_RAYS; ++k) {
        double from[3] = {draw(k, 0), draw(k, 1), draw(k, 2)};
        double direction[3];
        const double length = mor_vector_length(from);
        for (int a = 0; a < 3; ++a) {
            from[a] *= 2.0 * radius / length;
            direction[a] = draw(k, 3 + (uint64_t)a) - from[a];
        }
        const double reach = mor_vector_length(direction);
        for (int a = 0; a < 3; ++a) {
            direction[a] /= reach;
        }
        const double along = -mor_vector_dot(from, direction);
        const double across = sqrt(fmax(mor_vector_dot(from, from) - along * along, 0.0));
        const double entry = along - sqrt(fmax(radius * radius - across * across, 0.0));
        if (fabs(across - radius) < 10.0 * touch || fabs(entry - reach) < 10.0 * touch) {
            continue;
        }
        const bool is_met = across < radius && along > 0.0 && entry < reach;
        assert_true(mor_shape_meets_ray(sphere, from, direction, reach, touch) == is_met);
        n_met += is_met;
        n_missed += !is_met;
    }
    assert_true(n_met > 50 && n_missed > 50);
    mor_shape_free(&context, &sphere);
    assert_true(context.memory_bytes == 0);
}

static void a_ray_without_length_meets_nothing_and_one_that_starts_inside_does(void **state)
{
    (void)state;
    static const double center[3] = {0.0, 0.0, 0.0};
    static const double up[3] = {0.0, 0.0, 1.0};
    mor_context context;
    mor_shape *sphere = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_sphere(&context, center, radius, &sphere), MOR_OK);
    assert_false(mor_shape_meets_ray(sphere, center, up, 0.0, touch));
    assert_false(mor_shape_meets_ray(sphere, center, up, -1.0, touch));
    assert_true(mor_shape_meets_ray(sphere, center, up, 1e-9, touch));
    mor_shape_free(&context, &sphere);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_meets_a_sphere_where_its_quadratic_has_a_root_in_reach),
        cmocka_unit_test(a_ray_without_length_meets_nothing_and_one_that_starts_inside_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
