/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "tests/common/near.h"

#include <string.h>

static const uint64_t seed = 7;

static mor_shape *make(mor_context *context, const double *center, const double *radii)
{
    mor_shape *shape = NULL;
    mor_context_init(context);
    context->n_threads = 1;
    assert_int_equal(mor_shape_new_ellipsoid(context, center, radii, &shape), MOR_OK);
    return shape;
}

static double draw(uint64_t k, uint64_t purpose)
{
    return 2.0 * mor_random_uniform(seed, k, purpose) - 1.0;
}

/* From a point of the surface along its normal: the way is the distance, as far as the curvature lets it. */
static void distance_is_the_way_along_the_normal(void **state)
{
    enum { POINTS = 2000 };
    static const double center[3] = {0.3, -0.2, 0.1};
    static const double all_radii[4][3] = {{2.0, 1.0, 0.5}, {0.4, 1.5, 0.9}, {1.0, 1.0, 1.0}, {0.1, 0.1, 3.0}};
    (void)state;
    for (int k = 0; k < 4 * POINTS; ++k) {
        const double *radii = all_radii[k % 4];
        mor_context context;
        mor_shape *shape = make(&context, center, radii);
        double on_ball[3];
        double normal[3];
        double point[3];
        const double least = fmin(radii[0], fmin(radii[1], radii[2]));
        const double most = fmax(radii[0], fmax(radii[1], radii[2]));
        for (int a = 0; a < 3; ++a) {
            on_ball[a] = k % 7 == a ? 0.0 : draw((uint64_t)k, (uint64_t)a + 1); /* some in planes of symmetry */
        }
        const double length = mor_vector_length(on_ball);
        for (int a = 0; a < 3; ++a) {
            normal[a] = on_ball[a] / length / radii[a];
        }
        const double steepness = mor_vector_length(normal);
        /* Inside up to the least radius of curvature, least^2 / most; outside anywhere. */
        const double way =
            k % 2 == 0 ? 5.0 * fabs(draw((uint64_t)k, 4)) : -0.99 * least * least / most * fabs(draw((uint64_t)k, 5));
        for (int a = 0; a < 3; ++a) {
            point[a] = center[a] + radii[a] * on_ball[a] / length + way * normal[a] / steepness;
        }
        assert_near(mor_shape_distance(shape, point), way, 1e-12 * 8.0); /* rounding of the largest coordinate */
        mor_shape_free(&context, &shape);
    }
}

static void the_middle_is_as_deep_as_the_least_radius(void **state)
{
    static const double center[3] = {0.0, 0.0, 0.0};
    static const double radii[3] = {2.0, 0.5, 1.0};
    mor_context context;
    mor_shape *shape = make(&context, center, radii);
    (void)state;
    assert_true(mor_shape_distance(shape, center) == -0.5);
    assert_near(mor_shape_distance(shape, (const double[]){1.9, 0.0, 0.0}), -0.1, 1e-15);
    mor_shape_free(&context, &shape);
}

static void moments_are_those_of_the_closed_form(void **state)
{
    static const double center[3] = {0.3, -0.2, 0.0};
    static const double radii[3] = {2.0, 1.0, 3.0};
    mor_context context;
    mor_shape_moments space;
    mor_shape_moments plane;
    mor_shape *shape = make(&context, center, radii);
    (void)state;
    assert_true(mor_shape_moments_known(shape, 3, &space));
    assert_true(mor_shape_moments_known(shape, 2, &plane));
    assert_near(space.volume, 8.0 * MOR_PI, 1e-12);                 /* 4/3 pi a b c */
    assert_near(space.inertia[MOR_XX], 16.0 * MOR_PI, 1e-12);       /* V (b2 + c2) / 5 */
    assert_near(space.inertia[MOR_ZZ], 8.0 * MOR_PI, 1e-12);        /* V (a2 + b2) / 5 */
    assert_near(plane.volume, 2.0 * MOR_PI, 1e-12);                 /* pi a b */
    assert_near(plane.inertia[MOR_ZZ], 2.5 * MOR_PI, 1e-12);        /* A (a2 + b2) / 4 */
    assert_true(plane.center[0] == 0.3 && plane.center[1] == -0.2); /* exact */
    mor_shape_free(&context, &shape);
}

static void radii_of_zero_are_refused(void **state)
{
    static const double center[3] = {0.0, 0.0, 0.0};
    mor_context context;
    mor_shape *shape = NULL;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_ellipsoid(&context, center, (const double[]){1.0, 0.0, 1.0}, &shape),
                     MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "along y"));
    assert_null(shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_is_the_way_along_the_normal),
        cmocka_unit_test(the_middle_is_as_deep_as_the_least_radius),
        cmocka_unit_test(moments_are_those_of_the_closed_form),
        cmocka_unit_test(radii_of_zero_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
