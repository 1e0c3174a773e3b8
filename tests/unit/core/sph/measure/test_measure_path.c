/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/sph/measure/measure_path.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>

#include <cmocka.h>

/* Places along a polyline on a map, against a search in small steps. */

enum { CORNERS = 5, POINTS = 200, STEPS = 4000 };

static const double corners[3 * CORNERS] = {0, 0, 50, 30, 10, 40, 50, 40, 30, 80, 45, 25, 120, 20, 5};
static const double up[3] = {0.0, 0.0, 1.0};

/* Nearest of many places of the line and its straight continuation over 100 m at both ends. */
static void search(const double *position, double *along, double *distance)
{
    double passed = 0.0;
    *distance = INFINITY;
    for (int k = 0; k + 1 < CORNERS; ++k) {
        const double *from = corners + 3 * k;
        const double leg[2] = {from[3] - from[0], from[4] - from[1]};
        const double length = sqrt(leg[0] * leg[0] + leg[1] * leg[1]);
        const double begin = k == 0 ? -100.0 : 0.0;
        const double end = k + 2 == CORNERS ? length + 100.0 : length;
        for (int j = 0; j <= STEPS; ++j) {
            const double s = begin + (end - begin) * j / STEPS;
            const double x = from[0] + s / length * leg[0] - position[0];
            const double y = from[1] + s / length * leg[1] - position[1];
            if (sqrt(x * x + y * y) < *distance) {
                *distance = sqrt(x * x + y * y);
                *along = passed + s;
            }
        }
        passed += length;
    }
}

static void points_belong_to_the_nearest_place(void **state)
{
    mor_context context;
    mor_measure_path path;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_measure_path_new(&context, corners, CORNERS, up, &path), MOR_OK);
    for (int i = 0; i < POINTS; ++i) {
        /* Golden ratios scatter the points evenly. */
        const double position[3] = {fmod(i * 0.6180339887, 1.0) * 160.0 - 20.0,
                                    fmod(i * 0.7548776662, 1.0) * 100.0 - 25.0, fmod(i * 0.5698402910, 1.0) * 60.0};
        double along = 0.0;
        double distance = 0.0;
        mor_measure_station station;
        search(position, &along, &distance);
        mor_measure_path_locate(&path, position, &station);
        assert_true(fabs(fabs(station.beside) - distance) < 0.04); /* a step of the search */
        /* Where two places are about as near, the search may find the other one. */
        if (fabs(station.along - along) > 0.08) {
            double there[2] = {0.0, 0.0};
            search((const double[3]){position[0] + 1e-6, position[1], position[2]}, &there[0], &there[1]);
            assert_true(fabs(there[1] - distance) < 1e-3);
        }
        assert_true(fabs(mor_vector_length(station.tangent) - 1.0) < 1e-12);
    }
    assert_true(fabs(mor_measure_path_length(&path) -
                     (sqrt(1000.0) + sqrt(1300.0) + sqrt(925.0) + sqrt(1600.0 + 625.0))) < 1e-9);
    mor_measure_path_clear(&context, &path);
    assert_int_equal(context.memory_bytes, 0);
}

static void left_is_positive_and_heights_do_not_matter(void **state)
{
    const double straight[6] = {0.0, 0.0, 100.0, 10.0, 0.0, 0.0};
    mor_context context;
    mor_measure_path path;
    mor_measure_station station;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_measure_path_new(&context, straight, 2, up, &path), MOR_OK);
    mor_measure_path_locate(&path, (const double[3]){4.0, 3.0, -700.0}, &station);
    assert_true(station.along == 4.0 && station.beside == 3.0);
    mor_measure_path_locate(&path, (const double[3]){-2.0, -1.0, 5.0}, &station);
    assert_true(station.along == -2.0 && station.beside == -1.0); /* straight on before the first corner */
    mor_measure_path_locate(&path, (const double[3]){12.0, 0.0, 0.0}, &station);
    assert_true(station.along == 12.0 && station.beside == 0.0);
    assert_true(mor_measure_path_length(&path) == 10.0);
    mor_measure_path_clear(&context, &path);
}

static void lines_without_direction_are_refused(void **state)
{
    const double above[6] = {1.0, 2.0, 0.0, 1.0, 2.0, 9.0};
    mor_context context;
    mor_measure_path path;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_measure_path_new(&context, above, 2, up, &path), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "points 1 and 2 of a path lie above one another"));
    mor_measure_path_clear(&context, &path);
    assert_int_equal(mor_measure_path_new(&context, above, 1, up, &path), MOR_ERROR_ARGUMENT);
    mor_measure_path_clear(&context, &path);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_belong_to_the_nearest_place),
        cmocka_unit_test(left_is_positive_and_heights_do_not_matter),
        cmocka_unit_test(lines_without_direction_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
