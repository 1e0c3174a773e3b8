/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/sand_specimen.h"

/* What the published law says of its rates, states that all paths approach, and measured compression. */

/* The rate of stress, shape [6], for a strain rate, shape [6]. */
static void find_rate(const specimen *s, const double *d, double *rate)
{
    const double density = 1600.0;
    const double gradient[9] = {d[0], d[3], d[5], d[3], d[1], d[4], d[5], d[4], d[2]};
    const double *state_in[] = {&s->void_ratio, s->intergranular};
    double void_ratio_rate = 0.0;
    double intergranular_rate[6];
    double *state_rate[] = {&void_ratio_rate, intergranular_rate};
    const mor_batch batch = {
        .n = 1, .density = &density, .velocity_gradient = gradient, .stress_in = s->stress, .state_in = state_in};
    assert_int_equal(s->instance->operations.stress_rate(s->instance, &batch, rate, state_rate), MOR_OK);
}

static double length_of(const double *d)
{
    double sum = 0.0;
    for (int a = 0; a < 6; ++a) {
        sum += (a < 3 ? 1.0 : 2.0) * d[a] * d[a];
    }
    return sqrt(sum);
}

/* A strain rate of length one, of a number. */
static void draw_direction(uint64_t number, double *d)
{
    for (uint64_t a = 0; a < 6; ++a) {
        d[a] = mor_random_uniform(11, number, a) - 0.5;
    }
    const double length = length_of(d);
    for (int a = 0; a < 6; ++a) {
        d[a] /= length;
    }
}

/* A specimen under an oblique stress. */
static void make_oblique(specimen *s, double range)
{
    static const double stress[6] = {-120e3, -70e3, -90e3, 15e3, -8e3, 5e3};
    make(s, 0.75, range, 1e-4);
    memcpy(s->stress, stress, sizeof stress);
}

static void check_close(const double *found, const double *expected, double factor, double tolerance)
{
    const double size = length_of(expected) * fabs(factor);
    for (int a = 0; a < 6; ++a) {
        if (!(fabs(found[a] - factor * expected[a]) <= tolerance * size)) {
            fail_msg("component %d: found %.17g, expected %.17g", a, found[a], factor * expected[a]);
        }
    }
}

/* Without intergranular strain the rate is L : D + N |D|: the response envelope is an ellipsoid about N. */
static void response_envelope_is_an_ellipsoid_about_the_nonlinear_part(void **state)
{
    (void)state;
    specimen s;
    double center[6] = {0};
    make_oblique(&s, 0.0);
    for (uint64_t k = 0; k < 100; ++k) {
        double d[6];
        double opposite[6];
        double one[6];
        double other[6];
        draw_direction(k, d);
        for (int a = 0; a < 6; ++a) {
            opposite[a] = -d[a];
        }
        find_rate(&s, d, one);
        find_rate(&s, opposite, other);
        for (int a = 0; a < 6; ++a) {
            one[a] = 0.5 * (one[a] + other[a]);
        }
        if (k == 0) {
            memcpy(center, one, sizeof center);
        }
        check_close(one, center, 1.0, 1e-12); /* rounding */
        for (int a = 0; a < 6; ++a) {
            opposite[a] = 1e-3 * d[a];
        }
        find_rate(&s, d, one);
        find_rate(&s, opposite, other);
        check_close(other, one, 1e-3, 1e-12); /* homogeneous of degree one in the strain rate; rounding */
    }
    discard(&s);
}

/* Axes may be renamed: x to y to z to x. */
static void response_has_no_preferred_axis(void **state)
{
    (void)state;
    static const int NEXT[6] = {1, 2, 0, 4, 5, 3};
    for (int with_range = 0; with_range < 2; ++with_range) {
        for (uint64_t k = 0; k < 50; ++k) {
            specimen s;
            specimen renamed;
            double d[6];
            double d_renamed[6];
            double rate[6];
            double rate_renamed[6];
            double expected[6];
            make_oblique(&s, with_range ? 1e-4 : 0.0);
            make_oblique(&renamed, with_range ? 1e-4 : 0.0);
            draw_direction(k, d);
            draw_direction(1000 + k, s.intergranular);
            for (int a = 0; a < 6; ++a) {
                d_renamed[NEXT[a]] = d[a];
                renamed.stress[NEXT[a]] = s.stress[a];
                s.intergranular[a] *= 0.7;
                renamed.intergranular[NEXT[a]] = s.intergranular[a];
            }
            find_rate(&s, d, rate);
            find_rate(&renamed, d_renamed, rate_renamed);
            for (int a = 0; a < 6; ++a) {
                expected[NEXT[a]] = rate[a];
            }
            check_close(rate_renamed, expected, 1.0, 1e-12); /* rounding */
            discard(&s);
            discard(&renamed);
        }
    }
}

/* With the intergranular strain mobilized, |h| = 1: continued strain sees the law without it, a reversal m_R times its
 * linear part, a turn by 90 degrees m_T times; with none, |h| = 0, every direction sees m_R times. */
static void stiffness_after_reversal_and_turn_has_its_factors(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 50; ++k) {
        specimen plain;
        specimen s;
        double h[6];
        double d[3][6]; /* continued, reversed, turned */
        double with[3][6];
        double without[6];
        double mirrored[6];
        make_oblique(&plain, 0.0);
        make_oblique(&s, 1e-4);
        draw_direction(k, h);
        draw_direction(500 + k, d[2]);
        double along = 0.0;
        for (int a = 0; a < 6; ++a) {
            along += (a < 3 ? 1.0 : 2.0) * h[a] * d[2][a];
        }
        for (int a = 0; a < 6; ++a) {
            d[0][a] = h[a];
            d[1][a] = -h[a];
            d[2][a] -= along * h[a];
            s.intergranular[a] = h[a];
        }
        const double factors[3] = {1.0, M_R, M_T};
        for (int way = 0; way < 3; ++way) {
            double linear[6];
            double back[6];
            find_rate(&s, d[way], with[way]);
            find_rate(&plain, d[way], without);
            for (int a = 0; a < 6; ++a) {
                back[a] = -d[way][a];
            }
            find_rate(&plain, back, mirrored);
            for (int a = 0; a < 6; ++a) {
                linear[a] = 0.5 * (without[a] - mirrored[a]);
            }
            check_close(with[way], way == 0 ? without : linear, factors[way], 1e-10); /* closed form; h:d by rounding */
            memset(s.intergranular, 0, sizeof s.intergranular);
            find_rate(&s, d[way], with[way]);
            check_close(with[way], linear, M_R, 1e-10); /* closed form */
            memcpy(s.intergranular, h, sizeof h);
        }
        discard(&plain);
        discard(&s);
    }
}

/* Proportional strain makes the stress proportional, whatever it was: one K0 for all starts. */
static void compression_without_lateral_strain_forgets_its_start(void **state)
{
    (void)state;
    double ratio[3];
    double void_ratio[3];
    for (int k = 0; k < 3; ++k) {
        specimen s;
        make(&s, 0.9, 1e-4, 1e-6);
        press(&s, 2e3, (const double[]){0.8e3, 1.4e3, 2.4e3}[k]);
        while (-s.stress[2] < 1e6) {
            strain(&s, 0.0, -1e-3, 10);
        }
        ratio[k] = (SHIFT - s.stress[0]) / (SHIFT - s.stress[2]);
        void_ratio[k] = s.void_ratio / decay(pressure_of(s.stress));
        discard(&s);
    }
    assert_true(fabs(ratio[1] / ratio[0] - 1.0) < 0.01 && fabs(ratio[2] / ratio[0] - 1.0) < 0.01); /* approached */
    assert_true(ratio[0] > 0.8 * (1.0 - sin(PHI)) && ratio[0] < 1.2 * (1.0 - sin(PHI)));           /* Jaky (1944) */
    assert_true(fabs(void_ratio[1] - void_ratio[0]) < 0.01 && fabs(void_ratio[2] - void_ratio[0]) < 0.01);
}

/* Karlsruhe fine sand, parameters of Wichtmann et al. (2019), loose and dense, compressed without lateral strain: void
 * ratios at axial stresses as measured, Wichtmann and Triantafyllidis (2016), tests OE1 and OE6, whose data are named
 * in docs/validation/hypoplastic-sand.md. Their change from the start is compared: from 55 kPa on within 17 %, as two
 * specimens alike, OE1 and OE2, differ in it; below, the seating of the specimen is measured as well. */
static void karlsruhe_fine_sand_compresses_as_measured(void **state)
{
    (void)state;
    static const double stresses[6] = {5.413e3, 15.202e3, 55.720e3, 114.479e3, 241.142e3, 407.089e3};
    static const double start[2] = {1.02631, 0.90319};
    static const double measured[2][6] = {{1.01500, 1.00471, 0.99149, 0.98011, 0.96934, 0.96041},
                                          {0.89708, 0.89263, 0.88583, 0.88093, 0.87463, 0.86916}};
    for (int k = 0; k < 2; ++k) {
        specimen s;
        const mor_material *law = law_named("hypoplastic_sand");
        double values[MOR_MATERIAL_PARAMETERS_MAX];
        mor_params_defaults(law->parameters, values);
        set(law, values, "critical_friction_angle", 33.1 * MOR_PI / 180.0);
        set(law, values, "granulate_hardness", 4e9);
        set(law, values, "exponent", 0.27);
        set(law, values, "densest_void_ratio", 0.677);
        set(law, values, "critical_void_ratio", 1.054);
        set(law, values, "loosest_void_ratio", 1.212);
        set(law, values, "alpha", 0.14);
        set(law, values, "beta", 2.5);
        set(law, values, "void_ratio", start[k]);
        set(law, values, "elastic_range", 0.0);
        set(law, values, "minimum_pressure", 1.0);
        memset(&s, 0, sizeof s);
        mor_context_init(&s.context);
        assert_int_equal(mor_material_create(&s.context, law, 1500.0, values, &s.instance), MOR_OK);
        s.void_ratio = start[k];
        press(&s, 0.998e3, 0.455 * 0.998e3);
        for (int m = 0; m < 6; ++m) {
            while (-s.stress[2] < stresses[m]) {
                strain(&s, 0.0, -1e-5, 1);
            }
            const double change = start[k] - measured[k][m];
            assert_true(fabs(start[k] - s.void_ratio - change) < (m < 2 ? 0.25 : 0.17) * change);
        }
        discard(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(response_envelope_is_an_ellipsoid_about_the_nonlinear_part),
        cmocka_unit_test(response_has_no_preferred_axis),
        cmocka_unit_test(stiffness_after_reversal_and_turn_has_its_factors),
        cmocka_unit_test(compression_without_lateral_strain_forgets_its_start),
        cmocka_unit_test(karlsruhe_fine_sand_compresses_as_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
