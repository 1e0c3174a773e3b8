/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/isa.h"
#include "core/base/random.h"
#include "core/sph/lanes/soil_lanes.h"
#include "core/sph/pair/pair.h"

#include <math.h>
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

static const int32_t wall_places[CLUSTERS] = {-1, 0, -1};

static mor_soil_fit_job find_job(world *w, int dimension, const double *flow)
{
    return (mor_soil_fit_job){.n_particles = N,
                              .dimension = dimension,
                              .volume_factor = 0.97,
                              .wall_places = wall_places,
                              .moments = w->moments,
                              .closed = w->closed,
                              .continued = w->continued,
                              .density = w->density,
                              .flow = flow,
                              .gradient = w->gradient,
                              .density_rate = w->density_rate,
                              .strain_rate = w->strain_rate};
}

/* Soils of two kinds in turn, unlike within each register. */
static void run(const mor_soil_lanes *lanes, int dimension, const mor_soil_memory_kind kinds[2], world *w)
{
    double of_soil[PADDED * MOR_PAIR_OF_SOIL_SIZE] = {0.0};
    for (int i = 0; i < PADDED; ++i) {
        of_soil[i * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_INDEX] = i % 2;
    }
    const mor_soil_fit_job fit = find_job(w, dimension, w->flow);
    const mor_soil_memory_job memory = {.n_particles = N,
                                        .dimension = dimension,
                                        .length = 0.01,
                                        .gradient = w->gradient,
                                        .stress = w->stress,
                                        .of_soil = of_soil,
                                        .kinds = kinds,
                                        .wall_places = wall_places,
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

static const mor_soil_memory_kind first_kind = {.fade = 2.0, .kept = 0.9, .part = 0.1, .limit2 = 0.4};
static const mor_soil_memory_kind second_kind = {.fade = 1e-3, .kept = 0.5, .part = 0.3, .limit2 = 1e-6};

static void passes_give_the_same_bits_in_every_instruction_set(void **state)
{
    (void)state;
    static world plain;
    static world other;
    const mor_soil_memory_kind kinds[2] = {first_kind, second_kind};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        run(mor_soil_lanes_select("baseline"), dimension, kinds, &plain);
        for (int isa = MOR_ISA_BASELINE + 1; isa < MOR_ISA_COUNT; ++isa) {
            const mor_soil_lanes *lanes = mor_soil_lanes_select(mor_isa_name(isa));
            if (lanes != NULL) {
                run(lanes, dimension, kinds, &other);
                assert_memory_equal(&other, &plain, sizeof other); /* exact: nothing is fused */
            }
        }
    }
    assert_null(mor_soil_lanes_select("unknown"));
}

/* Sum of the rates of change of the volume, 1/s. */
static double trace_of(const double *gradient, int dimension)
{
    return gradient[0] + gradient[4] + (dimension == 3 ? gradient[8] : 0.0);
}

/* The moments that the fit of a particle divides by, shape [3, 3]. */
static void fill_moment(const world *w, int i, double *full)
{
    const bool is_at_wall = wall_places[i / MOR_CLUSTER] >= 0;
    const double *m = is_at_wall ? w->closed + 6 * (i % MOR_CLUSTER) : w->moments + 6 * i;
    const double rows[9] = {m[0], m[3], m[5], m[3], m[1], m[4], m[5], m[4], m[2]}; /* xx, yy, zz, xy, yz, zx */
    memcpy(full, rows, sizeof rows);
}

/* The gradient of a sum without what it makes of the rotation of a fit: s - W M. */
static void find_strain_of_sum(const world *w, const double *fit, int i, int dimension, double *s)
{
    double full[9];
    fill_moment(w, i, full);
    memcpy(s, w->gradient + 9 * i, 9 * sizeof *s);
    for (int a = 0; a < dimension; ++a) {
        for (int b = 0; b < dimension; ++b) {
            for (int c = 0; c < dimension; ++c) {
                s[3 * a + b] -= 0.5 * (fit[3 * a + c] - fit[3 * c + a]) * full[3 * c + b];
            }
        }
    }
}

/* Where soil flows the rate of shear is that of the sum, and partly so in between; rotation, change of volume and what
 * velocities are reconstructed with are those of the fit. */
static void shear_fades_to_the_sum_where_soil_flows(void **state)
{
    (void)state;
    static world sum;
    static world fit;
    static world faded;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        fill(&sum);
        fill(&fit);
        fill(&faded);
        faded.flow[0] = 1.0;
        const mor_soil_fit_job without = find_job(&fit, dimension, NULL);
        const mor_soil_fit_job with = find_job(&faded, dimension, faded.flow);
        mor_soil_lanes_select(NULL)->fit(&without, 0, CLUSTERS);
        mor_soil_lanes_select(NULL)->fit(&with, 0, CLUSTERS);
        assert_memory_equal(faded.density_rate, fit.density_rate, sizeof fit.density_rate);
        assert_memory_equal(faded.strain_rate, fit.strain_rate, sizeof fit.strain_rate);
        for (int k = 0; k < N * 9; ++k) {
            const int i = k / 9;
            const int a = k % 9 / 3;
            const int b = k % 3;
            double s[9];
            const double *f = fit.gradient + 9 * i;
            find_strain_of_sum(&sum, f, i, dimension, s);
            const double volume = (trace_of(s, dimension) - trace_of(f, dimension)) / dimension;
            const double change =
                0.5 * ((s[3 * a + b] - f[3 * a + b]) + (s[3 * b + a] - f[3 * b + a])) - (a == b ? volume : 0.0);
            const double expected = f[3 * a + b] + (a < dimension && b < dimension ? faded.flow[i] * change : 0.0);
            assert_true(fabs(faded.gradient[k] - expected) < 1e-14); /* rounding of numbers around 1 */
        }
    }
}

/* Soil that turns as a whole is not sheared, however much it flows and wherever its neighbors are: the sum of a
 * rotation W is W M, at boundaries with the moments that these close. */
static void rotation_strains_no_soil_that_flows(void **state)
{
    (void)state;
    static world w;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        fill(&w);
        for (int i = 0; i < N; ++i) {
            const double spin[3] = {dimension == 3 ? 0.7 : 0.0, dimension == 3 ? -0.4 : 0.0, 1.1};
            const double turn[9] = {0.0, -spin[2], spin[1], spin[2], 0.0, -spin[0], -spin[1], spin[0], 0.0};
            double full[9];
            fill_moment(&w, i, full);
            w.flow[i] = 1.0;
            for (int k = 0; k < 9; ++k) {
                w.gradient[9 * i + k] = 0.0;
                for (int c = 0; c < dimension && k / 3 < dimension && k % 3 < dimension; ++c) {
                    w.gradient[9 * i + k] += turn[3 * (k / 3) + c] * full[3 * c + k % 3];
                }
            }
        }
        const mor_soil_fit_job job = find_job(&w, dimension, w.flow);
        mor_soil_lanes_select(NULL)->fit(&job, 0, CLUSTERS);
        int n_turned = 0;
        for (int i = 0; i < N; ++i) {
            const double *g = w.gradient + 9 * i;
            const bool is_fitted = fabs(g[3] - g[1] - 2.2) < 1e-9; /* where neighbors are few the sum stays */
            n_turned += is_fitted;
            for (int k = 0; k < 9 && is_fitted; ++k) {
                assert_true(fabs(g[k] + g[3 * (k % 3) + k / 3]) < 1e-9); /* rounding over small determinants */
            }
        }
        assert_true(n_turned > N / 2); /* or else nothing is tested */
    }
}

/* The same particles with one kind of soil for all: those of the other kind alone differ. */
static void each_particle_remembers_by_its_own_soil(void **state)
{
    (void)state;
    static world of_one;
    static world of_two;
    const mor_soil_memory_kind one[2] = {first_kind, first_kind};
    const mor_soil_memory_kind two[2] = {first_kind, second_kind};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        run(mor_soil_lanes_select(NULL), dimension, one, &of_one);
        run(mor_soil_lanes_select(NULL), dimension, two, &of_two);
        for (int i = 0; i < N; ++i) {
            const bool is_same = i % 2 == 0;
            const double *a = of_one.hourglass + 3 * i;
            const double *b = of_two.hourglass + 3 * i;
            assert_int_equal(memcmp(of_one.mean + 6 * i, of_two.mean + 6 * i, 6 * sizeof(double)) == 0, is_same);
            assert_int_equal(of_one.flow[i] == of_two.flow[i], is_same);
            assert_int_equal(a[0] * a[0] + a[1] * a[1] == b[0] * b[0] + b[1] * b[1], is_same);
        }
    }
}

static void nothing_is_written_behind_the_last_particle(void **state)
{
    (void)state;
    static world before;
    static world after;
    const mor_soil_memory_kind kinds[2] = {first_kind, second_kind};
    const struct {
        size_t offset;
        size_t n;
    } outputs[] = {{offsetof(world, gradient), 9},    {offsetof(world, density_rate), 1},
                   {offsetof(world, strain_rate), 6}, {offsetof(world, spin), 3},
                   {offsetof(world, mean), 6},        {offsetof(world, flow), 1},
                   {offsetof(world, hourglass), 3}};
    fill(&before);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        run(mor_soil_lanes_select(NULL), dimension, kinds, &after);
        for (size_t k = 0; k < sizeof outputs / sizeof *outputs; ++k) {
            const char *then = (const char *)&before + outputs[k].offset;
            const char *now = (const char *)&after + outputs[k].offset;
            const size_t row = outputs[k].n * sizeof(double);
            assert_memory_equal(now + N * row, then + N * row, (PADDED - N) * row);
            assert_true(memcmp(now, then, sizeof(double)) != 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_give_the_same_bits_in_every_instruction_set),
        cmocka_unit_test(shear_fades_to_the_sum_where_soil_flows),
        cmocka_unit_test(rotation_strains_no_soil_that_flows),
        cmocka_unit_test(each_particle_remembers_by_its_own_soil),
        cmocka_unit_test(nothing_is_written_behind_the_last_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
