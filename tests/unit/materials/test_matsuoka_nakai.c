/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/principal_point.h"

#define DEG POINT_DEGREE

static const double YOUNGS = 5.98e6;

typedef struct soil_values {
    double youngs, poisson, friction, cohesion, dilation; /* schema order */
} soil_values;

static soil_values soil(double friction, double cohesion, double dilation)
{
    return (soil_values){YOUNGS, 0.3, friction, cohesion, dilation};
}

static void open_soil(law_point *p, soil_values values)
{
    law_point_open(p, "matsuoka_nakai", &values.youngs);
}

/* Invariants' ratio I1 I2 / I3 of principal pressures above the apex, and its gradient by the principal stresses. */
static double find_ratio(const double *stress, double apex, double *gradient)
{
    const double s[3] = {apex - stress[0], apex - stress[1], apex - stress[2]};
    const double i1 = s[0] + s[1] + s[2];
    const double i2 = s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
    const double i3 = s[0] * s[1] * s[2];
    for (int k = 0; k < 3; ++k) {
        gradient[k] = -(i2 / i3 + i1 * (i1 - s[k]) / i3 - i1 * i2 / (i3 * s[k]));
    }
    return i1 * i2 / i3;
}

static double surface_constant(double friction)
{
    return 9.0 + 8.0 * tan(friction) * tan(friction);
}

static void triaxial_tests_fail_where_mohr_coulomb_does(void **state)
{
    (void)state;
    const double soils[][3] = {
        {30.0, 0.0, 0.0}, {30.0, 20e3, 0.0}, {15.0, 8.4e3, 10.0}, {45.0, 1e3, 45.0}, {5.0, 20e3, 2.0}};
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
            for (int n = 0; n < 150; ++n) {
                across = point_compress(&p, axial, -lateral, 0);
            }
            law_point_check_close(-p.stress[MOR_ZZ], expected[is_extension], 1e-9 * lateral); /* asked: 1e-6 */
            if (!is_extension) {
                const double sine = sin(soils[k][2] * DEG);
                /* As Mohr-Coulomb in compression; lateral stress met to 1e-11 of E times 1e-3. */
                law_point_check_close(axial + 2.0 * across, 2.0 * sine / (1.0 - sine) * 1e-3, 1e-10);
            }
            law_point_close(&p);
        }
    }
}

/* Random trials: the end lies on the surface, and the plastic strain points along its gradient, with the given part
 * of the associated dilation. */
static void return_ends_on_the_surface_along_the_flow(void **state)
{
    (void)state;
    int n_yielded = 0;
    int n_apex = 0;
    for (uint64_t k = 0; k < 4000; ++k) {
        const double phi = (3.0 + 62.0 * mor_random_uniform(5, k, 0)) * DEG;
        const double psi = k % 3 == 0 ? 0.0 : phi * mor_random_uniform(5, k, 1);
        const double cohesion = k % 5 == 0 ? 0.0 : 20e3;
        const double apex = cohesion / tan(phi);
        double trial[3];
        for (uint64_t a = 0; a < 3; ++a) {
            trial[a] = 3e5 * (mor_random_uniform(6, k, a) - 0.8);
        }
        law_point p;
        open_soil(&p, soil(phi, cohesion, psi));
        point_map(&p, (const double[]){trial[0], trial[1], trial[2], 0, 0, 0});
        double gradient[3];
        if (fabs(p.stress[0] - apex) + fabs(p.stress[1] - apex) + fabs(p.stress[2] - apex) < 1e-6) {
            ++n_apex;
        } else if (p.state[0] > 0.0) {
            ++n_yielded;
            const double k_surface = surface_constant(phi);
            double strain[3];
            law_point_check_close(find_ratio(p.stress, apex, gradient), k_surface, 1e-7 * k_surface); /* asked: 1e-6 */
            point_plastic_strain(YOUNGS, 0.3, trial, p.stress, strain);
            const double mean = (gradient[0] + gradient[1] + gradient[2]) / 3.0;
            const double volume = strain[0] + strain[1] + strain[2];
            double length = 0.0;
            double along = 0.0;
            double strain2 = 0.0;
            for (int a = 0; a < 3; ++a) {
                along += (strain[a] - volume / 3.0) * (gradient[a] - mean);
                length += (gradient[a] - mean) * (gradient[a] - mean);
                strain2 += (strain[a] - volume / 3.0) * (strain[a] - volume / 3.0);
            }
            if (strain2 > 1e-12) {
                /* Same direction of the deviators; the square of an angle of 1e-6. */
                law_point_check_close(along / sqrt(length * strain2), 1.0, 1e-11);
                const double part = sin(psi) * (3.0 - sin(phi)) / (sin(phi) * (3.0 - sin(psi)));
                const double expected = part * 3.0 * mean * along / length;
                law_point_check_close(volume, expected, 1e-6 * sqrt(strain2)); /* rounding over the smallest strain */
            }
        }
        law_point_close(&p);
    }
    assert_true(n_yielded > 1500 && n_apex > 20);
}

/* Plane-strain flow that dilates with the friction angle holds the stress across at the root of the product of those
 * in the plane: with k^2 their ratio, (k^2 + k + 1)^2 / k^2 is the surface's constant. */
static void associated_plane_strain_flow_reaches_the_closed_form(void **state)
{
    (void)state;
    law_point p;
    open_soil(&p, soil(30.0 * DEG, 0.0, 30.0 * DEG));
    law_point_start_isotropic(&p, 100e3);
    for (int n = 0; n < 600; ++n) {
        point_compress(&p, -1e-3, -100e3, 1);
    }
    const double sum = sqrt(surface_constant(30.0 * DEG)) - 1.0;
    const double root = 0.5 * (sum + sqrt(sum * sum - 4.0));
    law_point_check_close(p.stress[MOR_ZZ], -100e3 * root * root, 1e-3); /* asked: 1e-6 of 4e5 */
    law_point_check_close(p.stress[MOR_YY], -100e3 * root, 1e-3);        /* likewise */
    law_point_close(&p);
}

/* Brute force: the nearest point of the surface in the energy norm is the associated return. */
static void associated_return_is_the_closest_point(void **state)
{
    (void)state;
    const double phi = 35.0 * DEG;
    const double trial[3] = {-20e3, -45e3, -150e3};
    law_point p;
    open_soil(&p, soil(phi, 0.0, phi));
    point_map(&p, (const double[]){trial[0], trial[1], trial[2], 0, 0, 0});
    double strain[3];
    point_plastic_strain(YOUNGS, 0.3, trial, p.stress, strain);
    const double energy = strain[0] * (trial[0] - p.stress[0]) + strain[1] * (trial[1] - p.stress[1]) +
                          strain[2] * (trial[2] - p.stress[2]);
    double best = INFINITY;
    const double constant = surface_constant(phi);
    for (int a = 1; a < 2000; ++a) {
        for (int b = 1; b < 2000; ++b) {
            /* Two of the stresses from the grid; the third from I1 I2 = constant I3, a quadratic. */
            const double x = 30.0 * a;
            const double y = 60.0 * b;
            const double half = 0.5 * ((x + y) * (x + y) + x * y - constant * x * y);
            const double root = half * half - (x + y) * (x + y) * x * y;
            for (int sign = -1; sign <= 1 && root >= 0.0; sign += 2) {
                const double z = (-half + sign * sqrt(root)) / (x + y);
                const double candidate[3] = {-x, -y, -z};
                point_plastic_strain(YOUNGS, 0.3, trial, candidate, strain);
                const double found =
                    strain[0] * (trial[0] + x) + strain[1] * (trial[1] + y) + strain[2] * (trial[2] + z);
                best = z > 0.0 && found < best ? found : best;
            }
        }
    }
    assert_true(p.state[0] > 0.0);
    assert_true(energy <= best * (1.0 + 1e-12));      /* no point of the grid is nearer; rounding */
    law_point_check_close(energy, best, 1e-4 * best); /* the grid's spacing over the distance, squared */
    law_point_close(&p);
}

static void beyond_the_apex_the_stress_is_the_apex(void **state)
{
    (void)state;
    const double apex = 8.4e3 / tan(25.0 * DEG);
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_soil(&p, soil(25.0 * DEG, 8.4e3, k * 20.0 * DEG));
        point_map(&p, (const double[]){80e3, 60e3, 70e3, 5e3, 0, 0});
        for (int a = 0; a < 6; ++a) {
            law_point_check_close(p.stress[a], a < 3 ? apex : 0.0, 1e-10); /* some ulp of 2e4 */
        }
        law_point_close(&p);
        open_soil(&p, soil(25.0 * DEG, 0.0, k * 20.0 * DEG));
        point_map(&p, (const double[]){1e9, 1.0, 1e9, 0, 0, 1e-3});
        for (int a = 0; a < 6; ++a) {
            assert_true(p.stress[a] == 0.0); /* exact: no cohesion, no stress */
        }
        law_point_close(&p);
    }
}

/* The two corners of the section: a circle as the angle vanishes, a triangle as it grows. */
static void extreme_angles_are_solved(void **state)
{
    (void)state;
    const double angles[4] = {1e-3, 0.5, 80.0, 89.5};
    for (uint64_t k = 0; k < 2000; ++k) {
        const double phi = angles[k % 4] * DEG;
        law_point p;
        open_soil(&p, soil(phi, 1e3 * tan(phi), k % 8 < 4 ? 0.0 : 0.7 * phi));
        double trial[6];
        for (uint64_t a = 0; a < 6; ++a) {
            trial[a] = 1e5 * (mor_random_uniform(2, k, a) - (a < 3 ? 1.0 : 0.5));
        }
        point_map(&p, trial);
        const double excess = point_distance(&p);
        if (!(excess <= 1e-9 * 1e5)) { /* rounding of the trial */
            fail_msg("angle %g, trial %d: outside by %g Pa", angles[k % 4], (int)k, excess);
        }
        const law_point once = p;
        const double still[9] = {0};
        assert_int_equal(law_point_try(&p, still, NULL, 0.0), MOR_OK);
        for (int a = 0; a < 6; ++a) {
            law_point_check_close(p.stress[a], once.stress[a], 1e-9 * 1e5); /* rounding, over 1 - sin(phi) */
        }
        law_point_close(&p);
    }
}

static void mapping_twice_changes_nothing(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 500; ++k) {
        const double phi = (1.0 + 49.0 * mor_random_uniform(1, k, 0)) * DEG;
        law_point p;
        open_soil(&p, soil(phi, k % 3 == 0 ? 0.0 : 8.4e3, k % 2 == 0 ? 0.0 : 0.5 * phi));
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
    } cases[] = {{{1e6, 0.3, 0.5, 0, 0.6}, "dilation_angle"}, {{1e6, 0.3, 0.0, 1e3, 0}, "friction_angle"}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_material_instance *law = NULL;
        assert_int_equal(
            mor_material_create(&context, law_named("matsuoka_nakai"), 2000.0, &cases[k].values.youngs, &law),
            MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, cases[k].word));
        assert_int_equal(context.memory_bytes, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triaxial_tests_fail_where_mohr_coulomb_does),
        cmocka_unit_test(return_ends_on_the_surface_along_the_flow),
        cmocka_unit_test(associated_plane_strain_flow_reaches_the_closed_form),
        cmocka_unit_test(associated_return_is_the_closest_point),
        cmocka_unit_test(beyond_the_apex_the_stress_is_the_apex),
        cmocka_unit_test(extreme_angles_are_solved),
        cmocka_unit_test(mapping_twice_changes_nothing),
        cmocka_unit_test(wrong_parameters_are_refused_with_a_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
