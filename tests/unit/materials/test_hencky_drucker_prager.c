/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/eigen.h"
#include "tests/common/law_point.h"

static const double YOUNGS = 1e6;
static const double POISSON = 0.2;
static const double SHEAR = 1e6 / 2.4;
static const double BULK = 1e6 / 1.8;

static void open_sand(law_point *p, double friction_angle, double gas_density_ratio)
{
    const double values[] = {YOUNGS, POISSON, friction_angle, gas_density_ratio};
    law_point_open(p, "hencky_drucker_prager", values);
}

/* One step from the unstressed state to principal stretches along the axes. */
static void stretch_to(law_point *p, const double *stretches)
{
    const double gradient[9] = {log(stretches[0]), 0, 0, 0, log(stretches[1]), 0, 0, 0, log(stretches[2])};
    law_point_steps(p, gradient, 1.0, 1);
}

static void principal_stretches_give_the_published_points(void **state)
{
    (void)state;
    /* stretches; Kirchhoff stress */
    const double table[5][6] = {{0.98, 1.0, 0.99, -25239.213, -8403.623, -16778.903},
                                {0.95, 1.02, 0.99, -39849.737, -8007.379, -21377.889},
                                {0.97, 1.005, 1.005, -20484.124, -6828.041, -6828.041},
                                {1.01, 1.0, 1.005, 0.0, 0.0, 0.0},
                                {0.9, 0.9, 0.9, -175600.859, -175600.859, -175600.859}};
    for (int k = 0; k < 5; ++k) {
        law_point p;
        open_sand(&p, MOR_PI / 6.0, 0.0);
        stretch_to(&p, table[k]);
        const double volume = table[k][0] * table[k][1] * table[k][2];
        for (int a = 0; a < 3; ++a) {
            /* the table has three decimals */
            law_point_check_close(volume * p.stress[a], table[k][3 + a], 5.1e-4);
            assert_true(fabs(p.stress[3 + a]) == 0.0); /* exact: along the axes */
        }
        law_point_close(&p);
    }
}

/* The same points by the formulas of eqs. 5 to 8, at the precision asked. */
static void principal_stretches_give_the_closed_form(void **state)
{
    (void)state;
    const double friction = 2.0 * sqrt(3.0) * 0.5 / 2.5;
    const double table[4][3] = {{0.98, 1.0, 0.99}, {0.95, 1.02, 0.99}, {0.97, 1.005, 1.005}, {0.5, 0.9, 1.3}};
    for (int k = 0; k < 4; ++k) {
        double strain[3];
        double sum = 0.0;
        double norm2 = 0.0;
        for (int a = 0; a < 3; ++a) {
            strain[a] = log(table[k][a]);
            sum += strain[a];
        }
        for (int a = 0; a < 3; ++a) {
            strain[a] -= sum / 3.0;
            norm2 += strain[a] * strain[a];
        }
        const double root = 2.0 * SHEAR * sqrt(0.5 * norm2);
        const double limit = -friction * BULK * sum;
        const double factor = root > limit ? limit / root : 1.0;
        law_point p;
        open_sand(&p, MOR_PI / 6.0, 0.0);
        stretch_to(&p, table[k]);
        for (int a = 0; a < 3; ++a) {
            const double kirchhoff = 2.0 * SHEAR * factor * strain[a] + BULK * sum;
            law_point_check_close(p.stress[a] * exp(sum), kirchhoff, 1e-12 * BULK * fabs(sum)); /* rounding */
            law_point_check_close(p.state[a], factor * strain[a] + sum / 3.0, 1e-14);           /* rounding */
        }
        const double slip = root > limit ? (root - limit) / SHEAR : 0.0;
        law_point_check_close(p.state[6], slip / sqrt(3.0), 1e-13); /* rounding */
        law_point_close(&p);
    }
}

static void superposed_rotation_leaves_the_principal_stresses(void **state)
{
    (void)state;
    law_point p;
    open_sand(&p, MOR_PI / 6.0, 0.0);
    const double stretches[3] = {0.95, 1.02, 0.99};
    stretch_to(&p, stretches);
    const double before[3] = {p.stress[0], p.stress[1], p.stress[2]};
    const double spin[9] = {0.0, -0.4, 0.3, 0.4, 0.0, -0.5, -0.3, 0.5, 0.0};
    law_point_steps(&p, spin, 17.0, 40);
    double values[3];
    double directions[9];
    mor_symmetric_eigen(p.stress, values, directions);
    for (int a = 0; a < 3; ++a) {
        double nearest = INFINITY;
        for (int b = 0; b < 3; ++b) {
            nearest = fmin(nearest, fabs(values[b] - before[a]));
        }
        law_point_check_close(nearest, 0.0, 1e-12 * fabs(before[0])); /* asked */
    }
    assert_true(fabs(p.stress[MOR_XY]) > 1e-3 * fabs(before[0])); /* it did turn */
    law_point_close(&p);
}

/* Under a pressure that keeps it elastic, a simple shear has the stress of its end, without oscillation and for any
 * number of steps: the exponential of a constant velocity gradient is exact. */
static void simple_shear_has_the_stress_of_its_deformation(void **state)
{
    (void)state;
    const int steps[] = {4, 64};
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_sand(&p, 85.0 / 180.0 * MOR_PI, 0.0);
        const double squeeze[9] = {log(0.5), 0, 0, 0, log(0.5), 0, 0, 0, log(0.5)};
        law_point_steps(&p, squeeze, 1.0, 2);
        const double gamma = 2.0;
        law_point_shear(&p, gamma, 1.0, steps[k], 1);
        assert_true(p.state[6] == 0.0); /* exact: elastic */
        /* In the plane the principal stretches are s and 1/s with s - 1/s = gamma. */
        const double s = 0.5 * (gamma + sqrt(gamma * gamma + 4.0));
        const double angle = 0.5 * atan2(2.0, gamma); /* of b = (1 + gamma^2, gamma; gamma, 1) */
        const double kirchhoff = 2.0 * SHEAR * log(s);
        const double volume = 0.125;
        law_point_check_close(volume * p.stress[MOR_XY], kirchhoff * sin(2.0 * angle), 1e-12 * SHEAR); /* rounding */
        law_point_check_close(volume * 0.5 * (p.stress[MOR_XX] - p.stress[MOR_YY]), kirchhoff * cos(2.0 * angle),
                              1e-12 * SHEAR);                                                        /* rounding */
        law_point_check_close(volume * law_point_pressure(&p), 3.0 * BULK * log(2.0), 1e-12 * BULK); /* rounding */
        law_point_close(&p);
    }
}

static void grains_apart_are_a_gas_until_they_are_compressed_again(void **state)
{
    (void)state;
    law_point p;
    open_sand(&p, MOR_PI / 6.0, 1.0); /* the rule of the paper: gas below the first density */
    const double squeeze[3] = {0.99, 0.99, 0.99};
    stretch_to(&p, squeeze);
    assert_true(law_point_pressure(&p) > 1e4);
    const double stored = 0.5 * BULK * pow(3.0 * log(0.99), 2.0) / pow(0.99, 3.0);
    const double apart[9] = {0.1, 0, 0, 0, 0, 0, 0, 0, 0};
    law_point_steps(&p, apart, 1.0, 1);
    for (int a = 0; a < 6; ++a) {
        assert_true(p.stress[a] == 0.0 && p.state[a] == 0.0); /* exact: a gas has no stress and no elastic strain */
    }
    law_point_check_close(p.dissipation, stored * pow(0.99, 3.0) * p.density / LAW_POINT_DENSITY,
                          1e-12 * stored); /* what was stored is lost; rounding */
    const double together[9] = {-0.1, 0, 0, 0, 0, 0, 0, 0, 0};
    law_point_steps(&p, together, 0.5, 1);
    assert_true(p.density < LAW_POINT_DENSITY && p.stress[MOR_XX] == 0.0); /* exact: still a gas */
    law_point_steps(&p, together, 0.25, 1); /* density 0.99^-3 e^-0.025, above the reference */
    assert_true(p.density > LAW_POINT_DENSITY);
    const double volume = LAW_POINT_DENSITY / p.density;
    law_point_check_close(law_point_pressure(&p), BULK * 0.025 / volume, 1e-12 * BULK); /* strain of the last step */
    law_point_close(&p);
}

/* A particle that starts under pressure becomes a gas when that has gone, not at the density of the start. */
static void first_pressure_is_released_before_grains_part(void **state)
{
    (void)state;
    law_point p;
    open_sand(&p, MOR_PI / 6.0, 1.0);
    law_point_start_isotropic(&p, 1e4);
    const double release = 1e4 / BULK; /* the strain of that pressure */
    const double apart[9] = {release / 3.0, 0, 0, 0, release / 3.0, 0, 0, 0, release / 3.0};
    law_point_steps(&p, apart, 0.9, 3);
    const double volume = exp(0.9 * release);
    law_point_check_close(law_point_pressure(&p), 1e3 / volume, 1e-12 * 1e4); /* closed form; rounding */
    law_point_steps(&p, apart, 0.2, 1);
    assert_true(p.stress[MOR_XX] == 0.0); /* exact */
    const double together[9] = {-apart[0], 0, 0, 0, -apart[4], 0, 0, 0, -apart[8]};
    law_point_steps(&p, together, 0.5, 1);
    law_point_check_close(law_point_pressure(&p), 5e3 / exp(0.6 * release), 1e-12 * 1e4); /* strain of that step */
    law_point_close(&p);
}

static void stress_diffusion_adds_its_cauchy_stress(void **state)
{
    (void)state;
    law_point p;
    open_sand(&p, MOR_PI / 6.0, 0.0);
    const double squeeze[3] = {0.9, 0.91, 0.89};
    stretch_to(&p, squeeze);
    double before[6];
    memcpy(before, p.stress, sizeof before);
    const double extra[6] = {-900.0, 400.0, -100.0, 300.0, -200.0, 500.0};
    assert_int_equal(law_point_try(&p, NULL, extra, 0.5), MOR_OK);
    for (int a = 0; a < 6; ++a) {
        law_point_check_close(p.stress[a] - before[a], 0.5 * extra[a], 1e-14 * BULK); /* rounding of the stress */
    }
    law_point_close(&p);
}

static void first_stress_is_held_by_its_elastic_strain(void **state)
{
    (void)state;
    law_point p;
    open_sand(&p, MOR_PI / 6.0, 0.0);
    p.density = 2100.0;
    const double stress[6] = {-9e3, -2e4, -1.2e4, 1e3, -2e3, 5e2};
    law_point_start(&p, stress);
    double stored = 0.0;
    const double *state_in[] = {p.state, p.state + 6, p.state + 7};
    const mor_batch batch = {.n = 1, .stress_in = p.stress, .state_in = state_in};
    assert_int_equal(p.law->operations.energy(p.law, &batch, &stored), MOR_OK);
    assert_int_equal(law_point_try(&p, NULL, NULL, 1.0), MOR_OK);
    const double volume = LAW_POINT_DENSITY / 2100.0;
    double root = law_point_root_j2(&p);
    double pressure = law_point_pressure(&p);
    for (int a = 0; a < 6; ++a) {
        law_point_check_close(p.stress[a], stress[a], 1e-14 * 2e4); /* rounding */
    }
    /* eq. 5 over the change of volume, with the Kirchhoff stress */
    const double exact = volume * (0.5 * pressure * pressure / BULK + 0.5 * root * root / SHEAR);
    law_point_check_close(stored, exact, 1e-13 * exact); /* rounding */
    law_point_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(principal_stretches_give_the_published_points),
        cmocka_unit_test(principal_stretches_give_the_closed_form),
        cmocka_unit_test(superposed_rotation_leaves_the_principal_stresses),
        cmocka_unit_test(simple_shear_has_the_stress_of_its_deformation),
        cmocka_unit_test(grains_apart_are_a_gas_until_they_are_compressed_again),
        cmocka_unit_test(first_pressure_is_released_before_grains_part),
        cmocka_unit_test(stress_diffusion_adds_its_cauchy_stress),
        cmocka_unit_test(first_stress_is_held_by_its_elastic_strain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
