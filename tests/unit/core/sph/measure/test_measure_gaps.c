/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/particle/kernel.h"
#include "core/sph/measure/measure_gaps.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Gaps between particles on lattices, of which it is known how well they fill the space. */

enum { SIDE_2D = 60, SIDE_3D = 16, MOST = 4200 };

#define SPACING 0.1
#define SMOOTHING (1.3 * SPACING)

/* Particles of a lattice, of which some are left out. */
typedef struct lattice {
    int dimension;
    double stretch; /* distance over the spacing, 1 */
    double swell;   /* volume over that of the spacing, 1 */
    double removed; /* part left out at random, 1 */
    int n_threads;
} lattice;

static double position[3 * MOST];
static double mass[MOST];
static double density[MOST];

/* Sum V W of the lattice itself, term by term. */
static double sum_lattice(int dimension)
{
    const double cube = pow(SPACING, dimension);
    const int depth = dimension == 3 ? 3 : 0;
    double sum = 0.0;
    for (int x = -3; x <= 3; ++x) {
        for (int y = -3; y <= 3; ++y) {
            for (int z = -depth; z <= depth; ++z) {
                sum += cube * mor_kernel_value(SPACING * sqrt(x * x + y * y + z * z), SMOOTHING, dimension);
            }
        }
    }
    return sum;
}

static mor_measure_gaps measure(const lattice *it)
{
    const int side = it->dimension == 3 ? SIDE_3D : SIDE_2D;
    const int64_t n_places = it->dimension == 3 ? side * side * side : side * side;
    const double cube = pow(SPACING, it->dimension);
    const mor_measure_sight sight = {SMOOTHING, sum_lattice(it->dimension)};
    int64_t n = 0;
    mor_measure_gaps gaps = {0.0, 0.0, 0.0};
    mor_context context;
    mor_context_init(&context);
    context.n_threads = it->n_threads;
    for (int64_t k = 0; k < n_places; ++k) {
        if (mor_random_uniform(5, (uint64_t)k, 0) < it->removed) {
            continue;
        }
        position[3 * n] = it->stretch * SPACING * (double)(k % side);
        position[3 * n + 1] = it->stretch * SPACING * (double)(k / side % side);
        position[3 * n + 2] = it->stretch * SPACING * (double)(k / side / side);
        mass[n] = 2000.0 * cube;
        density[n] = 2000.0 / it->swell;
        n += 1;
    }
    const mor_measure_points points = {.n_points = n,
                                       .dimension = it->dimension,
                                       .spacing = SPACING,
                                       .position = position,
                                       .mass = mass,
                                       .density = density,
                                       .n_threads = it->n_threads};
    assert_int_equal(mor_measure_find_gaps(&context, &points, &sight, &gaps), MOR_OK);
    assert_true(context.memory_bytes == 0);
    return gaps;
}

/* What a plane surface hides is known by the gradient of the sum; at edges and corners it hides more, in space of a
 * tenth of those judged. */
static void lattice_has_no_gaps(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        const mor_measure_gaps gaps = measure(&(lattice){dimension, 1.0, 1.0, 0.0, 1});
        if (!(fabs(gaps.fill - 1.0) < 0.02 && gaps.loose_share == 0.0 && gaps.inner_share > 0.6)) {
            fail_msg("%d: fill %g, loose %g, inner %g", dimension, gaps.fill, gaps.loose_share, gaps.inner_share);
        }
    }
}

/* A lattice that was stretched by a tenth has a kernel sum of 1.1^-d, the own share included, and is loose unless
 * volumes grew with it. */
static void stretched_lattice_is_loose_unless_its_volumes_tell(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        const double volume = pow(1.1, dimension);
        const mor_measure_gaps untold = measure(&(lattice){dimension, 1.1, 1.0, 0.0, 1});
        const mor_measure_gaps told = measure(&(lattice){dimension, 1.1, volume, 0.0, 1});
        const double own = pow(SPACING, dimension) * mor_kernel_value(0.0, SMOOTHING, dimension);
        /* Rows beside surfaces, and sums over few neighbors: 0.03. */
        if (!(fabs(untold.fill - (1.0 / volume - own) / (1.0 - own)) < 0.03)) {
            fail_msg("%d: fill %g", dimension, untold.fill);
        }
        assert_true(untold.loose_share > 0.99);
        assert_true(fabs(told.fill - 1.0) < 0.03 && told.loose_share == 0.0);
    }
}

/* The more particles are left out at random, the less is filled. Losses to one side look like a surface, so that what
 * is found is less than what is missing. */
static void fill_falls_with_what_is_left_out(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        double last = 1.0;
        for (int k = 1; k <= 3; ++k) {
            const double removed = 0.1 * k;
            const mor_measure_gaps gaps = measure(&(lattice){dimension, 1.0, 1.0, removed, 1});
            if (!(gaps.fill < last && gaps.fill > 1.0 - removed)) {
                fail_msg("%d: %g of a lattice left out, fill %g after %g", dimension, removed, gaps.fill, last);
            }
            last = gaps.fill;
        }
    }
}

static void gaps_do_not_depend_on_threads(void **state)
{
    (void)state;
    const mor_measure_gaps one = measure(&(lattice){2, 1.0, 1.0, 0.1, 1});
    const mor_measure_gaps three = measure(&(lattice){2, 1.0, 1.0, 0.1, 3});
    assert_true(one.fill == three.fill && one.loose_share == three.loose_share);
    assert_true(one.inner_share == three.inner_share);
}

static void grains_that_are_alone_are_not_judged(void **state)
{
    (void)state;
    const mor_measure_gaps gaps = measure(&(lattice){2, 1.0, 1.0, 0.999, 1});
    assert_true(gaps.loose_share == 0.0 && gaps.inner_share == 0.0 && isnan(gaps.fill));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_has_no_gaps),
        cmocka_unit_test(stretched_lattice_is_loose_unless_its_volumes_tell),
        cmocka_unit_test(fill_falls_with_what_is_left_out),
        cmocka_unit_test(gaps_do_not_depend_on_threads),
        cmocka_unit_test(grains_that_are_alone_are_not_judged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
