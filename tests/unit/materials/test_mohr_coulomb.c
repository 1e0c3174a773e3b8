/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/hexagon_oracle.h"
#include "tests/common/principal_point.h"

#define DEG POINT_DEGREE

static const double YOUNGS = 5.98e6;
static const double POISSON = 0.3;

typedef struct soil_values {
    double youngs, poisson, friction, cohesion, dilation, tension_ratio; /* schema order */
} soil_values;

static soil_values soil(double friction, double cohesion, double dilation)
{
    return (soil_values){YOUNGS, POISSON, friction, cohesion, dilation, 1.0};
}

static void open_soil(law_point *p, soil_values values)
{
    law_point_open(p, "mohr_coulomb", &values.youngs);
}

static void triaxial_tests_fail_at_the_closed_form(void **state)
{
    (void)state;
    /* phi deg, c Pa, psi deg */
    const double soils[][3] = {
        {30.0, 0.0, 0.0}, {30.0, 20e3, 0.0}, {15.0, 8.4e3, 10.0}, {40.0, 1e3, 40.0}, {0.0, 30e3, 0.0}};
    const double lateral = 100e3;
    for (size_t k = 0; k < sizeof soils / sizeof soils[0]; ++k) {
        const double phi = soils[k][0] * DEG;
        const double ratio = (1.0 + sin(phi)) / (1.0 - sin(phi));
        const double expected[2] = {ratio * lateral + 2.0 * soils[k][1] * sqrt(ratio),
                                    (lateral - 2.0 * soils[k][1] * sqrt(ratio)) / ratio};
        for (int is_extension = 0; is_extension < 2; ++is_extension) {
            law_point p;
            open_soil(&p, soil(phi, soils[k][1], soils[k][2] * DEG));
            law_point_start_isotropic(&p, lateral);
            const double axial = is_extension ? 1e-3 : -1e-3;
            double across = 0.0;
            point_compress(&p, axial, -lateral, 0);
            law_point_check_close(fabs(p.stress[MOR_ZZ] + lateral), YOUNGS * 1e-3,
                                  1e-5); /* lateral stress met to 1e-11 */
            for (int n = 0; n < 100; ++n) {
                across = point_compress(&p, axial, -lateral, 0);
            }
            const double found = -p.stress[MOR_ZZ];
            law_point_check_close(found, expected[is_extension], 1e-9 * lateral); /* asked: 1e-6 */
            /* Flow on the edge dilates by 2 sin(psi) for each 1 -+ sin(psi) along the axis. */
            const double sine = sin(soils[k][2] * DEG);
            const double growth = axial + 2.0 * across;
            const double dilation = 2.0 * sine / (is_extension ? 1.0 + sine : 1.0 - sine) * 1e-3;
            law_point_check_close(growth, dilation, 1e-10); /* lateral stress met to 1e-11 of E times 1e-3 */
            law_point_close(&p);
        }
    }
}

static void plane_strain_flow_mobilizes_the_friction_angle(void **state)
{
    (void)state;
    const double dilations[3] = {0.0, 10.0, 30.0};
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_soil(&p, soil(30.0 * DEG, 5e3, dilations[k] * DEG));
        law_point_start_isotropic(&p, 100e3);
        for (int n = 0; n < 200; ++n) {
            point_compress(&p, -1e-3, -100e3, 1);
        }
        const double half = 0.5 * (p.stress[MOR_XX] - p.stress[MOR_ZZ]);
        const double mean = 0.5 * (p.stress[MOR_XX] + p.stress[MOR_ZZ]);
        const double sine = half / (5e3 / tan(30.0 * DEG) - mean);
        law_point_check_close(sine, 0.5, 1e-9); /* asked: 1e-6 */
        law_point_close(&p);
    }
}

static void simple_shear_without_dilation_stays_at_the_strength(void **state)
{
    (void)state;
    law_point p;
    open_soil(&p, soil(30.0 * DEG, 20e3, 0.0));
    law_point_start_isotropic(&p, 150e3);
    const double modulus = YOUNGS / 2.6;
    const double strength = 150e3 * 0.5 + 20e3 * cos(30.0 * DEG);
    const double gradient[9] = {0, 0.05, 0, 0.05, 0, 0, 0, 0, 0};
    law_point_steps(&p, gradient, 1.0, 300);
    const double slip = 0.1 - strength / modulus;
    law_point_check_close(p.stress[MOR_XY], strength, 1e-9 * strength);            /* rounding of 300 steps */
    law_point_check_close(law_point_pressure(&p), 150e3, 1e-9 * 150e3);            /* likewise */
    law_point_check_close(p.stress[MOR_ZZ], -150e3, 1e-9 * 150e3);                 /* likewise */
    law_point_check_close(p.state[0], slip / sqrt(3.0), 1e-9);                     /* closed form; rounding */
    law_point_check_close(p.dissipation, strength * slip, 1e-9 * strength * slip); /* closed form; rounding */
    law_point_close(&p);
}

static void simple_shear_with_dilation_raises_the_pressure(void **state)
{
    (void)state;
    law_point p;
    open_soil(&p, soil(30.0 * DEG, 0.0, 10.0 * DEG));
    law_point_start_isotropic(&p, 50e3);
    const double shear = YOUNGS / 2.6;
    const double lame = YOUNGS * 0.3 / (1.3 * 0.4);
    const double first = 50e3 * 0.5 / shear;
    const double sine = sin(10.0 * DEG);
    const double gradient[9] = {0, 0.05, 0, 0.05, 0, 0, 0, 0, 0};
    law_point_steps(&p, gradient, 1.0, 400);
    /* f = 0 and constant volume: 2 G sin(psi) (lame + G) of pressure in the plane by unit shear, over the stiffness. */
    const double multiplier = (0.1 - first) * shear / (2.0 * shear * (1.0 + 0.5 * sine) + 2.0 * lame * 0.5 * sine);
    const double pressure = 50e3 + 2.0 * multiplier * sine * (lame + shear);
    const double across = 50e3 + 2.0 * multiplier * sine * lame;
    law_point_check_close(-0.5 * (p.stress[MOR_XX] + p.stress[MOR_YY]), pressure, 1e-9 * pressure); /* asked: 1e-6 */
    law_point_check_close(p.stress[MOR_XY], 0.5 * pressure, 1e-9 * pressure);                       /* likewise */
    law_point_check_close(-p.stress[MOR_ZZ], across, 1e-9 * pressure);                              /* likewise */
    law_point_close(&p);
}

/* Random trials in random directions against brute force; counts which corners were met, so that all are tried. */
static void return_solves_the_complementarity_problem(void **state)
{
    (void)state;
    int n_apex = 0;
    int n_torn = 0;
    int n_unsolved = 0;
    int n_yielded = 0;
    for (uint64_t k = 0; k < 4000; ++k) {
        const double phi = 50.0 * DEG * mor_random_uniform(5, k, 0);
        const double psi = k % 3 == 0 ? 0.0 : phi * mor_random_uniform(5, k, 1);
        const double cohesion = k % 5 == 0 ? 0.0 : 20e3;
        const double poisson = -0.2 + 0.65 * mor_random_uniform(5, k, 2);
        const double part = k % 2 == 0 ? 1.0 : mor_random_uniform(5, k, 3);
        const double tension = part < 1.0 ? part * cohesion / tan(phi) : INFINITY;
        const double values[] = {YOUNGS, poisson, phi, cohesion, psi, part};
        double trial[3];
        for (uint64_t a = 0; a < 3; ++a) {
            trial[a] = 3e5 * (mor_random_uniform(6, k, a) - 0.6) + (k % 4 == 0 ? 1e5 : 0.0);
        }
        double rotation[9];
        double stress[6];
        double expected[3];
        double expected_stress[6];
        point_random_rotation(k, rotation);
        point_compose(trial, rotation, stress);
        const hexagon_oracle oracle = oracle_make(YOUNGS, poisson, phi, cohesion, psi, tension);
        if (!oracle_return(&oracle, trial, expected)) {
            for (int a = 0; a < 3; ++a) {
                expected[a] = cohesion / tan(phi);
            }
            ++n_unsolved;
            assert_true(tension == INFINITY && trial[0] + trial[1] + trial[2] > 3.0 * expected[0]);
        }
        point_compose(expected, rotation, expected_stress);
        law_point p;
        law_point_open(&p, "mohr_coulomb", values);
        point_map(&p, stress);
        for (int a = 0; a < 6; ++a) {
            law_point_check_close(p.stress[a], expected_stress[a],
                                  1e-10 * 3e5); /* rounding over 1 - sin(phi); asked 1e-6 */
        }
        n_yielded += p.state[0] > 0.0;
        n_apex += fabs(expected[0] - expected[1]) + fabs(expected[1] - expected[2]) < 1e-6;
        n_torn += expected[0] > tension - 1e-6 || expected[1] > tension - 1e-6 || expected[2] > tension - 1e-6;
        law_point_close(&p);
    }
    assert_true(n_yielded > 1000 && n_apex > 100 && n_torn > 100 && n_unsolved > 10);
}

static void cohesionless_soil_holds_no_tension_at_all(void **state)
{
    (void)state;
    const double trials[][6] = {{1, 1, 1, 0, 0, 0}, {1e-30, 0, 0, 0, 0, 0}, {1e9, 0, 0, 1e9, 0, 1}};
    for (size_t k = 0; k < sizeof trials / sizeof trials[0]; ++k) {
        law_point p;
        open_soil(&p, soil(30.0 * DEG, 0.0, 0.0));
        point_map(&p, trials[k]);
        for (int a = 0; a < 6; ++a) {
            assert_true(p.stress[a] == 0.0); /* exact: no trace of tension, nor of shear */
        }
        law_point_close(&p);
    }
}

static void a_limit_of_tension_holds_in_uniaxial_tension(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        law_point p;
        soil_values values = soil(30.0 * DEG, 10e3, 0.0);
        values.tension_ratio = k == 0 ? 0.2 : 1.0;
        open_soil(&p, values);
        for (int n = 0; n < 20; ++n) {
            point_compress(&p, 1e-3, 0.0, 0);
        }
        /* Without the limit, the circle through zero: 2 c cos(phi) / (1 + sin(phi)). */
        const double expected = k == 0 ? 0.2 * 10e3 / tan(30.0 * DEG) : 20e3 * cos(30.0 * DEG) / 1.5;
        law_point_check_close(p.stress[MOR_ZZ], expected, 1e-8 * expected); /* lateral stress met to 1e-11 */
        law_point_close(&p);
    }
}

static void mapping_twice_changes_nothing(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 500; ++k) {
        const double phi = 45.0 * DEG * mor_random_uniform(1, k, 0);
        soil_values values = soil(phi, k % 3 == 0 ? 0.0 : 8.4e3, k % 2 == 0 ? 0.0 : 0.5 * phi);
        values.tension_ratio = k % 5 == 0 ? 0.3 : 1.0;
        law_point p;
        open_soil(&p, values);
        point_check_mapping_twice(&p, k);
        law_point_close(&p);
    }
}

static void wrong_parameters_are_refused_with_a_reason(void **state)
{
    (void)state;
    const struct {
        soil_values values;
        const char *word;
    } cases[] = {
        {{1e6, 0.3, 0.5, 0, 0.6, 1}, "dilation_angle"}, {{1e6, 0.3, 0.0, 1e3, 0, 0.5}, "tension_ratio"},
        {{1e6, 0.5, 0.5, 0, 0, 1}, "poissons_ratio"},   {{1e6, 0.3, 1.6, 0, 0, 1}, "friction_angle"},
        {{1e6, 0.3, 0.5, -1.0, 0, 1}, "cohesion"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_material_instance *law = NULL;
        assert_int_equal(
            mor_material_create(&context, law_named("mohr_coulomb"), 2000.0, &cases[k].values.youngs, &law),
            MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, cases[k].word));
        assert_int_equal(context.memory_bytes, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triaxial_tests_fail_at_the_closed_form),
        cmocka_unit_test(plane_strain_flow_mobilizes_the_friction_angle),
        cmocka_unit_test(simple_shear_without_dilation_stays_at_the_strength),
        cmocka_unit_test(simple_shear_with_dilation_raises_the_pressure),
        cmocka_unit_test(return_solves_the_complementarity_problem),
        cmocka_unit_test(cohesionless_soil_holds_no_tension_at_all),
        cmocka_unit_test(a_limit_of_tension_holds_in_uniaxial_tension),
        cmocka_unit_test(mapping_twice_changes_nothing),
        cmocka_unit_test(wrong_parameters_are_refused_with_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
