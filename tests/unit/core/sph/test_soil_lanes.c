/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/isa.h"
#include "core/base/random.h"
#include "core/sph/soil_lanes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Passes over particles in lanes: the same bits in every instruction set, and nothing behind the last particle. */

enum { N = 21, CLUSTERS = 3, PADDED = 24 }; /* N: no multiple of the lanes */

/* All that the passes read and write. */
typedef struct world {
    double moments[6 * PADDED], closed[6 * PADDED], continued[6 * PADDED], density[PADDED], stress[6 * PADDED];
    double left[3 * PADDED], hourglass_rate[3 * PADDED];
    double gradient[9 * PADDED], density_rate[PADDED], strain_rate[6 * PADDED];
    double spin[3 * PADDED], mean[6 * PADDED], flow[PADDED], hourglass[3 * PADDED];
} world;

/* The same numbers each time: around 1 on the diagonals of moments, 0 to 0.3 elsewhere. */
static void fill(world *w)
{
    double *values = (double *)w;
    memset(w, 0, sizeof *w);
    for (uint64_t k = 0; k < sizeof *w / sizeof *values; ++k) {
        values[k] = 0.3 * mor_random_uniform(11, k, 0);
    }
    for (int k = 0; k < 6 * PADDED; ++k) {
        w->moments[k] += k % 6 < 3 ? 0.2 * (k % 5) : 0.0;
        w->closed[k] += k % 6 < 3 ? 1.0 : 0.0;
    }
}

static void run(const mor_soil_lanes *lanes, int dimension, world *w)
{
    static const int8_t at_wall[CLUSTERS] = {0, 1, 0};
    const mor_soil_memory_kind kind = {.fade = 2.0, .kept = 0.9, .part = 0.1, .limit2 = 0.4};
    const mor_soil_fit_job fit = {N,           dimension,       0.97,          at_wall,
                                  w->moments,  w->closed,       w->continued,  w->density,
                                  w->gradient, w->density_rate, w->strain_rate};
    const mor_soil_memory_job memory = {.n_particles = N,
                                        .dimension = dimension,
                                        .length = 0.01,
                                        .gradient = w->gradient,
                                        .stress = w->stress,
                                        .kinds = &kind,
                                        .at_wall = at_wall,
                                        .moments = w->moments,
                                        .closed = w->closed,
                                        .left = w->left,
                                        .spin = w->spin,
                                        .mean = w->mean,
                                        .flow = w->flow,
                                        .hourglass_rate = w->hourglass_rate,
                                        .hourglass = w->hourglass};
    fill(w);
    lanes->fit(&fit, 0, CLUSTERS);
    lanes->remember(&memory, 0, CLUSTERS);
}

static void passes_give_the_same_bits_in_every_instruction_set(void **state)
{
    (void)state;
    static world plain;
    static world other;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        run(mor_soil_lanes_select("baseline"), dimension, &plain);
        for (int isa = MOR_ISA_BASELINE + 1; isa < MOR_ISA_COUNT; ++isa) {
            const mor_soil_lanes *lanes = mor_soil_lanes_select(mor_isa_name(isa));
            if (lanes != NULL) {
                run(lanes, dimension, &other);
                assert_memory_equal(&other, &plain, sizeof other); /* exact: nothing is fused */
            }
        }
    }
    assert_null(mor_soil_lanes_select("unknown"));
}

static void nothing_is_written_behind_the_last_particle(void **state)
{
    (void)state;
    static world before;
    static world after;
    fill(&before);
    run(mor_soil_lanes_select(NULL), 3, &after);
    assert_memory_equal(after.gradient + 9 * N, before.gradient + 9 * N, 9 * (PADDED - N) * sizeof(double));
    assert_memory_equal(after.mean + 6 * N, before.mean + 6 * N, 6 * (PADDED - N) * sizeof(double));
    assert_memory_equal(after.spin + 3 * N, before.spin + 3 * N, 3 * (PADDED - N) * sizeof(double));
    assert_true(memcmp(after.gradient, before.gradient, sizeof(double)) != 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_give_the_same_bits_in_every_instruction_set),
        cmocka_unit_test(nothing_is_written_behind_the_last_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
