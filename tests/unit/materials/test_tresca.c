/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/hexagon_oracle.h"
#include "tests/common/principal_point.h"

static const double YOUNGS = 6e6;
static const double STRENGTH = 20e3;

static void open_clay(law_point *p, double poisson, double rate_coefficient, double reference_rate)
{
    const double values[] = {YOUNGS, poisson, STRENGTH, rate_coefficient, reference_rate};
    law_point_open(p, "tresca", values);
}

static void triaxial_tests_fail_at_twice_the_strength_at_any_pressure(void **state)
{
    (void)state;
    for (int k = 0; k < 6; ++k) {
        law_point p;
        const double lateral = k % 3 * 100e3;
        open_clay(&p, 0.49, 0.0, 1.0);
        law_point_start_isotropic(&p, lateral);
        const double axial = k < 3 ? -1e-3 : 1e-3;
        point_compress(&p, axial, -lateral, 0);
        law_point_check_close(p.stress[MOR_ZZ] + lateral, YOUNGS * axial,
                              1e-5); /* elastic; lateral stress met to 1e-11 */
        for (int n = 0; n < 30; ++n) {
            point_compress(&p, axial, -lateral, 0);
        }
        law_point_check_close(fabs(p.stress[MOR_ZZ] + lateral), 2.0 * STRENGTH,
                              1e-9 * 2.0 * STRENGTH); /* asked: 1e-6 */
        law_point_close(&p);
    }
}

static void simple_shear_reaches_the_strength(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 0.495, 0.0, 1.0);
    law_point_start_isotropic(&p, 50e3);
    const double gradient[9] = {0, 0.03, 0, 0.03, 0, 0, 0, 0, 0};
    law_point_steps(&p, gradient, 1.0, 100);
    const double slip = 0.06 - STRENGTH / (YOUNGS / 2.99);
    law_point_check_close(p.stress[MOR_XY], STRENGTH, 1e-9 * STRENGTH);            /* asked: 1e-6 */
    law_point_check_close(law_point_pressure(&p), 50e3, 1e-9 * 50e3);              /* rounding of 100 steps */
    law_point_check_close(p.dissipation, STRENGTH * slip, 1e-9 * STRENGTH * slip); /* closed form; rounding */
    law_point_check_close(p.state[0], slip / sqrt(3.0), 1e-9);                     /* closed form; rounding */
    law_point_close(&p);
}

/* The bulk modulus is that of Hooke's law up to the incompressible limit. */
static void nearly_incompressible_clay_keeps_its_volume(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 0.4995, 0.0, 1.0);
    const double gradient[9] = {-1e-4, 0, 0, 0, -1e-4, 0, 0, 0, -1e-4};
    law_point_steps(&p, gradient, 1.0, 10);
    const double bulk = YOUNGS / (3.0 * (1.0 - 2.0 * 0.4995));
    law_point_check_close(law_point_pressure(&p), bulk * 3e-4, 1e-9 * bulk * 3e-4); /* rounding */
    const double density = 2000.0;
    const mor_batch batch = {.n = 1, .density = &density, .stress_in = p.stress};
    double speed = 0.0;
    assert_int_equal(p.law->operations.wave_speed(p.law, &batch, &speed), MOR_OK);
    law_point_check_close(speed, sqrt(bulk / 2000.0), 1e-9 * speed); /* rounding */
    law_point_close(&p);
}

static void return_solves_the_complementarity_problem(void **state)
{
    (void)state;
    int n_yielded = 0;
    for (uint64_t k = 0; k < 2000; ++k) {
        const double poisson = 0.49 * mor_random_uniform(5, k, 2);
        const double values[] = {YOUNGS, poisson, STRENGTH, 0.0, 1.0};
        double trial[3];
        for (uint64_t a = 0; a < 3; ++a) {
            trial[a] = 1.5e5 * (mor_random_uniform(6, k, a) - 0.5);
        }
        double rotation[9];
        double stress[6];
        double expected[3];
        double expected_stress[6];
        point_random_rotation(k, rotation);
        point_compose(trial, rotation, stress);
        const hexagon_oracle oracle = oracle_make(YOUNGS, poisson, 0.0, STRENGTH, 0.0, INFINITY);
        assert_true(oracle_return(&oracle, trial, expected));
        point_compose(expected, rotation, expected_stress);
        law_point p;
        law_point_open(&p, "tresca", values);
        point_map(&p, stress);
        for (int a = 0; a < 6; ++a) {
            law_point_check_close(p.stress[a], expected_stress[a], 1e-11 * 1.5e5); /* rounding; asked: 1e-6 */
        }
        n_yielded += p.state[0] > 0.0;
        law_point_close(&p);
    }
    assert_true(n_yielded > 500);
}

static void strength_grows_with_the_logarithm_of_the_rate(void **state)
{
    (void)state;
    const double rates[4] = {1e-3, 1e-2, 1.0, 50.0};
    for (int k = 0; k < 4; ++k) {
        law_point p;
        open_clay(&p, 0.49, 0.1, 1e-2);
        const double shear[9] = {0, 0.5 * rates[k], 0, 0.5 * rates[k], 0, 0, 0, 0, 0};
        law_point_steps(&p, shear, 0.3 / rates[k], 300);
        const double expected = STRENGTH * (1.0 + 0.1 * fmax(0.0, log10(rates[k] / 1e-2)));
        law_point_check_close(p.stress[MOR_XY], expected,
                              1e-9 * expected);                       /* asked: 1e-6; the rate is steady at the end */
        law_point_check_close(p.state[1], expected / STRENGTH, 1e-9); /* likewise */
        law_point_check_close(point_distance(&p), 0.0, 1e-9 * expected); /* on the surface of its rate */
        law_point_close(&p);
    }
}

/* With the strain held, G times the rate of the strength law: s = s0 - m ln(1 + t G r0 / m), m = strength by unit of
 * the natural logarithm, r0 the rate that belongs to s0. */
static void held_strain_relaxes_by_the_closed_form(void **state)
{
    (void)state;
    double miss[2];
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_clay(&p, 0.49, 0.1, 1e-6);
        p.stress[MOR_XY] = 1.4 * STRENGTH;
        p.state[1] = 1.4;
        const double still[9] = {0};
        law_point_steps(&p, still, 10.0, k == 0 ? 1000 : 2000);
        const double m = 0.1 * STRENGTH / log(10.0);
        const double first = 1e-6 * pow(10.0, 4.0);
        const double expected = 1.4 * STRENGTH - m * log1p(10.0 * YOUNGS / 2.98 * first / m);
        assert_true(expected > 1.01 * STRENGTH); /* still above the reference rate */
        miss[k] = fabs(p.stress[MOR_XY] - expected);
        law_point_check_close(p.stress[MOR_XY], expected, 1e-3 * STRENGTH); /* first order in steps of 1e-3 */
        law_point_close(&p);
    }
    law_point_check_close(miss[0] / miss[1], 2.0, 0.1); /* first order, next term 1/1000 and its logarithm */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triaxial_tests_fail_at_twice_the_strength_at_any_pressure),
        cmocka_unit_test(simple_shear_reaches_the_strength),
        cmocka_unit_test(nearly_incompressible_clay_keeps_its_volume),
        cmocka_unit_test(return_solves_the_complementarity_problem),
        cmocka_unit_test(strength_grows_with_the_logarithm_of_the_rate),
        cmocka_unit_test(held_strain_relaxes_by_the_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
