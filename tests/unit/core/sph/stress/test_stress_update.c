/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/sph/stress/separation.h"
#include "core/sph/stress/stress_update.h"
#include "tests/common/law_point.h"

/* Soil that comes apart and closes again, and soil that loses compression: docs/theory/separation.md. */

enum { N = 5 };

static const double YOUNGS = 4e6;
static const double POISSON = 0.3;
static const double BULK = 4e6 / (3.0 * (1.0 - 0.6));

/* Some particles of one law. */
typedef struct sample {
    law_point law;
    mor_stress_update update;
    double density[N], gradient[9 * N], stress[6 * N], plastic[N], separation[N];
} sample;

static void open_sample(sample *s, double friction, double cohesion, bool remembers)
{
    const double values[6] = {YOUNGS, POISSON, friction, cohesion, 0.0, 1.0};
    memset(s, 0, sizeof *s);
    law_point_open(&s->law, "mohr_coulomb", values);
    for (int i = 0; i < N; ++i) {
        s->density[i] = LAW_POINT_DENSITY;
    }
    s->update = (mor_stress_update){.material = s->law.law,
                                    .length = 1e-4,
                                    .stiffness = {BULK},
                                    .widths = {1},
                                    .density = s->density,
                                    .velocity_gradient = s->gradient,
                                    .stress = s->stress,
                                    .separation = remembers ? s->separation : NULL,
                                    .state = {s->plastic}};
}

/* Strains particle i by a volumetric strain and a shear, all others by nothing. */
static void strain(sample *s, int i, double volumetric, double shear)
{
    mor_stress_failed failed;
    memset(s->gradient, 0, sizeof s->gradient);
    for (int a = 0; a < 3; ++a) {
        s->gradient[9 * i + 4 * a] = volumetric / (3.0 * s->update.length);
    }
    s->gradient[9 * i + 1] = shear / s->update.length;
    assert_int_equal(mor_stress_advance(&s->update, 0, N, &failed), MOR_OK);
}

static double pressure_of(const sample *s, int i)
{
    return -(s->stress[6 * i] + s->stress[6 * i + 1] + s->stress[6 * i + 2]) / 3.0;
}

/* Sand that expands by a tenth and is compressed by a tenth and 1e-4 has the pressure of 1e-4. */
static void sand_bears_stress_from_the_volume_it_came_apart_at(void **state)
{
    (void)state;
    for (int remembers = 0; remembers < 2; ++remembers) {
        sample s;
        open_sample(&s, 0.5, 0.0, remembers != 0);
        for (int k = 0; k < 100; ++k) {
            strain(&s, 2, 1e-3, 3e-4);
        }
        for (int k = 0; k < 100; ++k) {
            strain(&s, 2, -1e-3, -5e-4);
        }
        strain(&s, 2, -1e-4, 0.0);
        const double expected = BULK * (remembers ? 1e-4 : 0.1001);
        assert_true(fabs(pressure_of(&s, 2) - expected) < 1e-12 * BULK); /* rounding of 200 sums of strains */
        assert_true(fabs(s.separation[2]) < 1e-15);                      /* closed to the rounding of a strain of 0.1 */
        assert_true(pressure_of(&s, 1) == 0.0);
        law_point_close(&s.law);
    }
}

/* At any time what has opened and not closed is the expansion from where the stress was lost. */
static void separation_is_the_expansion_beyond_the_last_loss_of_stress(void **state)
{
    (void)state;
    sample s;
    open_sample(&s, 0.5, 0.0, true);
    double elastic = 0.0; /* compression that the stress has, 1 */
    double open = 0.0;
    for (uint64_t k = 0; k < 2000; ++k) {
        const double step = 2e-3 * (mor_random_uniform(5, k, 0) - 0.5);
        const double after = elastic - open - step; /* compression from the volume at which stress begins */
        strain(&s, 0, step, 0.0);
        elastic = fmax(after, 0.0);
        open = fmax(-after, 0.0);
        assert_true(fabs(pressure_of(&s, 0) - BULK * elastic) < 1e-11 * BULK); /* rounding, 2000 sums */
        assert_true(fabs(s.separation[0] - open) < 1e-11);
    }
    law_point_close(&s.law);
}

/* With cohesion: torn at the apex, then without tension, then closed. */
static void torn_soil_closes_without_pressure(void **state)
{
    (void)state;
    const double cohesion = 1e3;
    const double apex = cohesion / tan(0.5);
    sample s;
    open_sample(&s, 0.5, cohesion, true);
    for (int k = 0; k < 1000; ++k) {
        strain(&s, 4, 1e-6, 0.0); /* it begins to tear within a step, of which a part may count as elastic */
    }
    for (int k = 0; k < 99; ++k) {
        strain(&s, 4, 1e-3, 0.0);
    }
    assert_true(fabs(pressure_of(&s, 4) + apex) < 1e-9 * apex);
    assert_true(fabs(s.separation[4] - (0.1 - apex / BULK)) < 1e-6);
    for (int k = 0; k < 50; ++k) {
        strain(&s, 4, -1e-3, 0.0);
    }
    assert_true(fabs(pressure_of(&s, 4)) < 1e-9 * apex);
    for (int k = 0; k < 51; ++k) {
        strain(&s, 4, -1e-3, 0.0);
    }
    assert_true(s.separation[4] == 0.0);
    assert_true(fabs(pressure_of(&s, 4) - BULK * 1e-3) < 1.1e-6 * BULK); /* of that part */
    law_point_close(&s.law);
}

/* What stays together, and what dilates under pressure, has not come apart. */
static void soil_that_keeps_its_stress_does_not_separate(void **state)
{
    (void)state;
    for (int dilates = 0; dilates < 2; ++dilates) {
        sample s;
        const double values[6] = {YOUNGS, POISSON, 0.5, 2e3, dilates ? 0.4 : 0.0, 1.0};
        open_sample(&s, 0.5, 2e3, true);
        law_point_close(&s.law);
        law_point_open(&s.law, "mohr_coulomb", values);
        s.update.material = s.law.law;
        strain(&s, 3, -2e-3, 0.0);
        for (int k = 0; k < 500; ++k) {
            strain(&s, 3, dilates ? 1e-6 : 0.0, 1e-4); /* dilation keeps up the pressure */
            assert_true(s.separation[3] == 0.0 && pressure_of(&s, 3) > 0.0);
        }
        law_point_close(&s.law);
    }
}

/* Elastic soil under tension has not come apart, whatever diffusion does to its stress. */
static void elastic_tension_that_diffuses_away_is_no_separation(void **state)
{
    (void)state;
    sample s;
    double diffusion[6 * N] = {0.0};
    open_sample(&s, 0.0, 1e9, true);
    s.update.diffusion = diffusion;
    strain(&s, 2, 1e-3, 0.0);
    for (int a = 0; a < 3; ++a) {
        diffusion[6 * 2 + a] = -2.0 * BULK * 1e-5 / s.update.length; /* twice what the expansion adds */
    }
    for (int k = 0; k < 20; ++k) {
        strain(&s, 2, 1e-5, 0.0);
        assert_true(s.separation[2] == 0.0);
    }
    assert_true(pressure_of(&s, 2) < 0.0);
    law_point_close(&s.law);
}

/* (A4): nothing is open in soil as dense as at the start; a tenth below it is no measure; between it depends on no
 * rounding. */
static void soil_as_dense_as_before_has_closed(void **state)
{
    (void)state;
    for (int k = 0; k <= 100; ++k) {
        const double ratio = 0.5 + 0.01 * k;
        const double found = mor_separation_bound(0.6, ratio);
        assert_true(found >= 0.0 && found <= 0.6);
        assert_true(ratio < 1.0 || found == 0.0);
        assert_true(ratio > 0.9 || found == 0.6);
        assert_true(fabs(mor_separation_bound(0.6, ratio + 1e-12) - found) < 1e-10);
    }
}

/* Each particle tears at the stiffness of its own soil: with that of another it would count as elastic. */
static void stiffness_is_that_of_the_soil_of_the_particle(void **state)
{
    (void)state;
    double of_soil[MOR_PAIR_OF_SOIL_SIZE * N] = {0.0};
    sample s;
    open_sample(&s, 0.5, 0.0, true);
    s.update.of_soil = of_soil;
    s.update.stiffness[0] = 1e-9 * BULK;
    s.update.stiffness[1] = BULK;
    of_soil[3 * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_INDEX] = 1.0;
    strain(&s, 3, -2e-3, 0.0);
    strain(&s, 3, 3e-3, 0.0);
    assert_true(fabs(s.separation[3] - 1e-3) < 1e-12); /* 2e-3 were elastic; rounding */
    law_point_close(&s.law);
}

/* A failure is told with what the law saw. */
static void what_the_law_sees_of_open_soil_is_told(void **state)
{
    (void)state;
    sample s;
    double seen[9];
    double diffusion[6];
    open_sample(&s, 0.5, 0.0, true);
    strain(&s, 1, 3e-3, 0.0);
    for (int a = 0; a < 9; ++a) {
        s.gradient[9 + a] = a % 4 == 0 ? -20.0 : 1.0; /* closes half way through the step: 3e-3 of 6e-3 */
    }
    mor_stress_find_seen(&s.update, 1, seen, diffusion);
    assert_true(fabs(seen[0] + 10.0) < 1e-12 && fabs(seen[1] - 0.5) < 1e-12); /* rounding */
    assert_true(diffusion[0] == 0.0);
    law_point_close(&s.law);
}

/* Compression whose pressure diffuses away is lost: the pressure and what is lost are always those of all compression,
 * and what is lost beyond a bound comes back. */
static void pressure_and_lost_compression_add_up_to_the_compression(void **state)
{
    (void)state;
    enum { PRESSED = 200, WAIT = 400 };
    double diffusion[6 * N] = {0.0};
    double restored[N] = {0.0};
    double sum = 0.0;
    sample s;
    open_sample(&s, 0.5, 0.0, true);
    s.update.diffusion = diffusion;
    s.update.counts_lost = true;
    s.update.restored = restored;
    strain(&s, 2, -0.01, 0.0);
    for (int k = 1; k <= PRESSED + WAIT; ++k) {
        const bool is_pressed = k <= PRESSED;
        for (int a = 0; a < 3; ++a) {
            diffusion[12 + a] = is_pressed ? BULK * 1e-3 / s.update.length : 0.0;
        }
        strain(&s, 2, is_pressed ? -1e-3 : 0.0, 0.0);
        sum += restored[2];
        const double all = 0.01 + 1e-3 * fmin(k, PRESSED);
        assert_true(fabs(pressure_of(&s, 2) / BULK - s.separation[2] - all) < 1e-12); /* rounding of 600 sums */
    }
    /* A part of what goes beyond the bound comes back in each step. */
    const double left = 0.1 * pow(1.0 - MOR_SEPARATION_RESTORED, WAIT);
    assert_true(s.separation[2] <= -MOR_SEPARATION_LOST && s.separation[2] > -MOR_SEPARATION_LOST - left - 1e-12);
    assert_true(fabs(sum + 0.2 + s.separation[2]) < 1e-12);
    assert_true(pressure_of(&s, 1) == 0.0 && s.separation[1] == 0.0 && restored[1] == 0.0);
    law_point_close(&s.law);
}

/* Where densities are not found by summation nothing bounds a loss, and none is kept. */
static void losses_count_only_where_densities_are_summed(void **state)
{
    (void)state;
    double diffusion[6 * N] = {0.0};
    sample s;
    open_sample(&s, 0.5, 0.0, true);
    s.update.diffusion = diffusion;
    diffusion[12] = diffusion[13] = diffusion[14] = BULK * 1e-3 / s.update.length;
    strain(&s, 2, -0.01, 0.0);
    assert_true(s.separation[2] == 0.0);
    assert_true(mor_separation_lose(MOR_SEPARATION_UNKNOWN, BULK, BULK) == MOR_SEPARATION_UNKNOWN);
    law_point_close(&s.law);
}

/* What sums find beyond the rates is lost, up to all compression that there is; the first sum tells nothing. */
static void sums_tell_lost_compression_within_the_density(void **state)
{
    (void)state;
    assert_true(fabs(mor_separation_correct(-0.02, 1.05, 1.2) + 0.02 + log(1.05)) < 1e-15); /* rounding */
    assert_true(fabs(mor_separation_correct(-0.30, 1.05, 1.2) + log(1.2)) < 1e-15);
    assert_true(mor_separation_correct(-0.02, 0.9, 1.2) == 0.0);
    assert_true(mor_separation_correct(-0.30, 1.0, 0.98) == 0.0);
    assert_true(mor_separation_correct(MOR_SEPARATION_UNKNOWN, 1.3, 1.3) == 0.0);
}

/* A particle separates by no more than what closes it on its way to a face, with many neighbors by what a lattice takes
 * to lose sight of itself; in between it depends on no rounding of a moment. */
static void separation_is_bounded_by_the_neighbors_that_are_seen(void **state)
{
    (void)state;
    const double spread = mor_stress_find_spread(1.0, exp(-1.7));
    assert_true(fabs(spread - 1.7) < 1e-15); /* rounding */
    assert_true(mor_stress_find_spread(1.0, 0.5) == MOR_SEPARATION_ALONE);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        double moments[6 * N] = {0.0};
        double least = MOR_SEPARATION_ALONE;
        sample s;
        open_sample(&s, 0.5, 0.0, true);
        s.update.moments = moments;
        s.update.dimension = dimension;
        s.update.spread = spread;
        for (int k = 0; k <= 100; ++k) {
            for (int a = 0; a < 3; ++a) {
                moments[6 * 2 + a] = a < dimension ? 0.005 * k : 1e3;
            }
            s.separation[2] = 0.5;
            strain(&s, 2, 3.0, 0.0);
            assert_true(k > 0 || fabs(s.separation[2] - MOR_SEPARATION_ALONE) < 1e-12);
            assert_true(0.005 * k < MOR_SEPARATION_FEW || fabs(s.separation[2] - spread) < 1e-12);
            assert_true(s.separation[2] >= least && s.separation[2] < least + 0.02); /* (1.7 - 1) 0.005 / 0.3 */
            least = s.separation[2];
            s.separation[2] = 0.5;
            strain(&s, 2, 0.25, 0.0);
            assert_true(fabs(s.separation[2] - 0.75) < 1e-12); /* what is within the bound stays */
        }
        law_point_close(&s.law);
    }
}

/* The speed of sound may be that of stiffer soil: tension that is elastic is none of separation. */
static void elastic_tension_of_soil_softer_than_told_is_no_separation(void **state)
{
    (void)state;
    sample s;
    open_sample(&s, 0.5, 1e9, true);
    s.update.stiffness[0] = 15.0 * BULK;
    for (int k = 0; k < 300; ++k) {
        strain(&s, 2, k < 100 ? 1e-5 : -1e-5, 0.0);
        assert_true(s.separation[2] == 0.0);
    }
    assert_true(fabs(pressure_of(&s, 2) - BULK * 1e-3) < 1e-12 * BULK); /* rounding */
    law_point_close(&s.law);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sand_bears_stress_from_the_volume_it_came_apart_at),
        cmocka_unit_test(separation_is_the_expansion_beyond_the_last_loss_of_stress),
        cmocka_unit_test(torn_soil_closes_without_pressure),
        cmocka_unit_test(soil_that_keeps_its_stress_does_not_separate),
        cmocka_unit_test(elastic_tension_that_diffuses_away_is_no_separation),
        cmocka_unit_test(soil_as_dense_as_before_has_closed),
        cmocka_unit_test(stiffness_is_that_of_the_soil_of_the_particle),
        cmocka_unit_test(what_the_law_sees_of_open_soil_is_told),
        cmocka_unit_test(pressure_and_lost_compression_add_up_to_the_compression),
        cmocka_unit_test(losses_count_only_where_densities_are_summed),
        cmocka_unit_test(sums_tell_lost_compression_within_the_density),
        cmocka_unit_test(separation_is_bounded_by_the_neighbors_that_are_seen),
        cmocka_unit_test(elastic_tension_of_soil_softer_than_told_is_no_separation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
