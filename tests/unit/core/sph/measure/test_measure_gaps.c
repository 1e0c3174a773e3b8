/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/particle/kernel.h"
#include "core/sph/measure/measure_gaps.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Gaps between particles on lattices, of which it is known how well they fill the space. */

enum { MOST = 8000, REACH = 7 };

#define SPACING 0.1

/* Particles of a lattice, of which some are left out. */
typedef struct lattice {
    int dimension;
    int n[3];       /* particles along each axis */
    double ratio;   /* smoothing length over spacing, 1 */
    double stretch; /* distance over spacing, 1 */
    double swell;   /* volume over that of the spacing, 1; 0: no densities are given */
    double removed; /* part left out at random, 1 */
    int n_threads;
} lattice;

static double position[3 * MOST];
static double mass[MOST];
static double density[MOST];

/* Sum V W over the other particles of a lattice without end that is stretched, and over itself where has_own. */
static double sum_lattice(int dimension, double ratio, double stretch, bool has_own)
{
    const double cube = pow(SPACING, dimension);
    const int depth = dimension == 3 ? REACH : 0;
    double sum = 0.0;
    for (int x = -REACH; x <= REACH; ++x) {
        for (int y = -REACH; y <= REACH; ++y) {
            for (int z = -depth; z <= depth; ++z) {
                const double distance = stretch * SPACING * sqrt(x * x + y * y + z * z);
                const bool is_own = x == 0 && y == 0 && z == 0;
                sum += is_own && !has_own ? 0.0 : cube * mor_kernel_value(distance, ratio * SPACING, dimension);
            }
        }
    }
    return sum;
}

static mor_measure_gaps measure(const lattice *it)
{
    const double cube = pow(SPACING, it->dimension);
    const int n_z = it->dimension == 3 ? it->n[2] : 1;
    const int64_t n_places = (int64_t)it->n[0] * it->n[1] * n_z;
    const mor_measure_reference reference = {it->ratio * SPACING, sum_lattice(it->dimension, it->ratio, 1.0, true)};
    int64_t n = 0;
    mor_measure_gaps gaps = {0.0, 0.0, 0.0};
    mor_context context;
    mor_context_init(&context);
    context.n_threads = it->n_threads;
    assert_true(n_places <= MOST);
    for (int64_t k = 0; k < n_places; ++k) {
        if (mor_random_uniform(5, (uint64_t)k, 0) < it->removed) {
            continue;
        }
        position[3 * n] = it->stretch * SPACING * (double)(k % it->n[0]);
        position[3 * n + 1] = it->stretch * SPACING * (double)(k / it->n[0] % it->n[1]);
        position[3 * n + 2] = it->stretch * SPACING * (double)(k / it->n[0] / it->n[1]);
        mass[n] = 2000.0 * cube;
        density[n] = it->swell > 0.0 ? 2000.0 / it->swell : NAN;
        n += 1;
    }
    const mor_measure_points points = {.n_points = n,
                                       .dimension = it->dimension,
                                       .spacing = SPACING,
                                       .position = position,
                                       .mass = mass,
                                       .density = it->swell > 0.0 ? density : NULL,
                                       .n_threads = it->n_threads};
    if (mor_measure_find_gaps(&context, &points, &reference, &gaps) != MOR_OK) {
        fail_msg("%s", context.message);
    }
    assert_true(context.memory_bytes == 0);
    return gaps;
}

static lattice block(int dimension, int side)
{
    return (lattice){
        .dimension = dimension, .n = {side, side, side}, .ratio = 1.3, .stretch = 1.0, .swell = 1.0, .n_threads = 1};
}

/* Of a block one row is not judged along each face: of 20 rows 18 are, along each axis. What a plane surface hides of
 * the second row is known to 0.005 of the sum. */
static void lattice_has_no_gaps(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        lattice it = block(dimension, 20);
        for (int k = 0; k < 2; ++k) {
            it.swell = k == 0 ? 1.0 : 0.0;
            const mor_measure_gaps gaps = measure(&it);
            assert_true(fabs(gaps.fill - 1.0) < 0.005 && gaps.loose_share == 0.0);
            assert_true(fabs(gaps.inner_share - pow(0.9, dimension)) < 1e-12); /* rounding of a sum */
        }
    }
}

/* A layer of a few rows has a surface on either side, whose gradients cancel: what they hide is no gap. */
static void layers_of_a_few_rows_have_no_gaps(void **state)
{
    static const double ratios[] = {1.0, 1.15, 1.3, 1.5, 2.0, 3.0};
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (size_t r = 0; r < sizeof ratios / sizeof *ratios; ++r) {
            for (int rows = 1; rows <= 6; ++rows) {
                lattice it = block(dimension, dimension == 3 ? 24 : 60);
                it.n[dimension - 1] = rows;
                it.ratio = ratios[r];
                const mor_measure_gaps gaps = measure(&it);
                if (gaps.loose_share != 0.0) {
                    fail_msg("%d rows in %d dimensions at a ratio of %g: %g are loose, fill %g", rows, dimension,
                             it.ratio, gaps.loose_share, gaps.fill);
                }
            }
        }
    }
}

/* A lattice that was stretched by a tenth is loose unless volumes grew with it: its sum is that of the stretched one,
 * term by term. Surfaces: 0.01. */
static void stretched_lattice_is_loose_unless_its_volumes_tell(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        lattice it = block(dimension, 20);
        it.stretch = 1.1;
        const mor_measure_gaps untold = measure(&it);
        it.swell = pow(1.1, dimension);
        const mor_measure_gaps told = measure(&it);
        const double others = sum_lattice(dimension, it.ratio, 1.1, false);
        const double whole = sum_lattice(dimension, it.ratio, 1.0, true);
        const double own = whole - sum_lattice(dimension, it.ratio, 1.0, false);
        if (!(fabs(untold.fill - others / (whole - own)) < 0.01 &&
              fabs(told.fill - it.swell * others / (whole - it.swell * own)) < 0.01)) {
            fail_msg("%d: fill %g and %g", dimension, untold.fill, told.fill);
        }
        assert_true(untold.loose_share == 1.0 && told.loose_share == 0.0);
    }
}

/* The more particles are left out at random, the less is filled. Losses to one side look like a surface, so that what
 * is found is less than what is missing, but more than a fifth of it. */
static void fill_falls_with_what_is_left_out(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        for (int k = 1; k <= 3; ++k) {
            lattice it = block(dimension, dimension == 3 ? 20 : 80);
            it.removed = 0.1 * k;
            const mor_measure_gaps gaps = measure(&it);
            if (!(gaps.fill < 1.0 - it.removed / 5.0 && gaps.fill > 1.0 - it.removed)) {
                fail_msg("%d: %g of a lattice left out, fill %g, loose %g", dimension, it.removed, gaps.fill,
                         gaps.loose_share);
            }
        }
    }
}

/* Enough particles for several threads to sum. */
static void gaps_do_not_depend_on_threads(void **state)
{
    (void)state;
    lattice it = block(2, 80);
    it.removed = 0.1;
    const mor_measure_gaps one = measure(&it);
    it.n_threads = 3;
    const mor_measure_gaps three = measure(&it);
    assert_true(one.fill == three.fill && one.loose_share == three.loose_share);
    assert_true(one.inner_share == three.inner_share && one.loose_share > 0.0);
}

static void grains_that_are_alone_are_not_judged(void **state)
{
    (void)state;
    lattice it = block(2, 60);
    it.removed = 0.999;
    const mor_measure_gaps gaps = measure(&it);
    assert_true(gaps.loose_share == 0.0 && gaps.inner_share == 0.0 && isnan(gaps.fill));
}

static void reference_that_is_no_number_above_zero_is_refused(void **state)
{
    static const mor_measure_reference wrong[] = {{0.0, 1.0}, {INFINITY, 1.0}, {NAN, 1.0}, {0.1, 0.0}, {0.1, INFINITY}};
    (void)state;
    const mor_measure_points points = {
        .n_points = 1, .dimension = 2, .spacing = SPACING, .position = position, .mass = mass};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        mor_measure_gaps gaps;
        mor_context context;
        mor_context_init(&context);
        assert_int_equal(mor_measure_find_gaps(&context, &points, &wrong[k], &gaps), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, "finite numbers above zero"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_has_no_gaps),
        cmocka_unit_test(layers_of_a_few_rows_have_no_gaps),
        cmocka_unit_test(stretched_lattice_is_loose_unless_its_volumes_tell),
        cmocka_unit_test(fill_falls_with_what_is_left_out),
        cmocka_unit_test(gaps_do_not_depend_on_threads),
        cmocka_unit_test(grains_that_are_alone_are_not_judged),
        cmocka_unit_test(reference_that_is_no_number_above_zero_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
