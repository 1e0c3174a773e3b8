/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "materials/frame/principal_lanes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum { BLOCKS = 200 };

static double draw(uint64_t id, uint64_t purpose)
{
    return 2.0 * mor_random_uniform(5, id, purpose) - 1.0;
}

/* Checks all lanes of a block: directions are orthonormal, values fall, and together they are the trial again. */
static void check(const mor_principal_block *p)
{
    static const int rows[6] = {0, 1, 2, 0, 1, 2};
    static const int columns[6] = {0, 1, 2, 1, 2, 0};
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        double largest = 0.0;
        for (int a = 0; a < 6; ++a) {
            largest = fmax(largest, fabs(p->trial[a][lane]));
        }
        for (int a = 0; a < 6; ++a) {
            double sum = 0.0;
            double unit = 0.0;
            for (int k = 0; k < 3; ++k) {
                sum += p->start[k][lane] * p->direction[k][rows[a]][lane] * p->direction[k][columns[a]][lane];
                unit += p->direction[rows[a]][k][lane] * p->direction[columns[a]][k][lane];
            }
            /* Rounding of fifteen rotations, and what five sweeps leave, 1e-19. */
            assert_true(fabs(sum - p->trial[a][lane]) <= 1e-14 * largest);
            assert_true(fabs(unit - (a < 3 ? 1.0 : 0.0)) <= 1e-14);
        }
        assert_true(p->start[0][lane] >= p->start[1][lane] && p->start[1][lane] >= p->start[2][lane]);
    }
}

/* Components of diagonal and beside it: 1e6 Pa times random numbers times these. */
static void run(const double *sizes, double mean)
{
    mor_principal_block *p = calloc(1, sizeof *p);
    assert_non_null(p);
    for (uint64_t block = 0; block < BLOCKS; ++block) {
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            for (int a = 0; a < 6; ++a) {
                const uint64_t id = block * MOR_LANES + (uint64_t)lane;
                p->trial[a][lane] = 1e6 * ((a < 3 ? mean : 0.0) + sizes[a] * draw(id, (uint64_t)a));
            }
        }
        mor_principal_split(p);
        check(p);
    }
    free(p);
}

static void principal_values_and_directions_compose_any_stress(void **state)
{
    (void)state;
    run((const double[]){1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, 0.0);
    run((const double[]){1.0, 1.0, 1.0, 1e-9, 1e-6, 1e-12}, 0.0);
    run((const double[]){1.0, 1e-3, 1e-6, 1e-3, 1e-6, 1e-9}, 0.0);
}

static void nearly_isotropic_stress_is_split_as_exactly(void **state)
{
    (void)state;
    for (double size = 1e-3; size > 1e-17; size *= 1e-3) {
        run((const double[]){size, size, size, size, size, size}, -1.0);
    }
}

/* Components whose squares, and then they themselves, vanish in single precision, in which angles are found. */
static void components_too_small_for_single_precision_leave_a_rotation(void **state)
{
    (void)state;
    for (double size = 1e-15; size > 1e-60; size *= 1e-3) {
        for (double along = size; along > 1e-60; along *= 1e-6) {
            run((const double[]){1.0, along, along, size, size, size}, 0.0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(principal_values_and_directions_compose_any_stress),
        cmocka_unit_test(nearly_isotropic_stress_is_split_as_exactly),
        cmocka_unit_test(components_too_small_for_single_precision_leave_a_rotation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
