/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/drucker_prager.h"
#include "tests/common/principal_point.h"

#define DEG POINT_DEGREE

static const double YOUNGS = 5.98e6;

typedef struct soil_values {
    double youngs, poisson, friction, cohesion, dilation, cone, tension_ratio; /* schema order */
    double residual_strain, residual_friction, residual_cohesion, residual_dilation;
} soil_values;

static void open_soil(law_point *p, soil_values values)
{
    law_point_open(p, "drucker_prager", &values.youngs);
}

/* Simple shear by gamma without its spin. */
static void shear(law_point *p, double gamma, int n)
{
    const double gradient[9] = {0, 0.5 * gamma, 0, 0.5 * gamma, 0, 0, 0, 0, 0};
    law_point_steps(p, gradient, 1.0, n);
}

/* In plane-strain flow the matched cone mobilizes the friction angle for any dilation; the default cone does so for
 * flow that dilates with the friction angle alone. */
static void matched_cone_mobilizes_the_friction_angle_in_plane_strain(void **state)
{
    (void)state;
    const double dilations[4] = {0.0, 5.0, 15.0, 30.0};
    for (int k = 0; k < 4; ++k) {
        law_point p;
        open_soil(&p, (soil_values){.youngs = YOUNGS,
                                    .poisson = 0.3,
                                    .friction = 30.0 * DEG,
                                    .cohesion = 5e3,
                                    .dilation = dilations[k] * DEG,
                                    .cone = MOR_DRUCKER_PRAGER_MATCHED,
                                    .tension_ratio = 1.0});
        law_point_start_isotropic(&p, 100e3);
        double across = 0.0;
        for (int n = 0; n < 600; ++n) {
            across = point_compress(&p, -1e-3, -100e3, 1);
        }
        const double half = 0.5 * (p.stress[MOR_XX] - p.stress[MOR_ZZ]);
        const double mean = 0.5 * (p.stress[MOR_XX] + p.stress[MOR_ZZ]);
        law_point_check_close(half / (5e3 / tan(30.0 * DEG) - mean), 0.5,
                              1e-8); /* asked: 1e-6; steady after 600 steps */
        const double sine = (across - 1e-3) / (across + 1e-3);
        law_point_check_close(sine, sin(dilations[k] * DEG), 1e-7); /* likewise */
        law_point_close(&p);
    }
}

/* Simple shear at constant pressure: the strength follows friction and cohesion of the plastic strain, the sum of slip
 * over sqrt(3); friction moves on a straight line, and so does cohesion. */
static void strength_follows_the_plastic_strain(void **state)
{
    (void)state;
    /* softening, then hardening; phi, c at first and at last */
    const double table[2][4] = {{35.0, 20e3, 25.0, 5e3}, {20.0, 0.0, 32.0, 3e3}};
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_soil(&p, (soil_values){YOUNGS, 0.3, table[k][0] * DEG, table[k][1], 0.0, MOR_DRUCKER_PRAGER_MATCHED, 1.0,
                                    0.1, table[k][2] * DEG, table[k][3], 0.0});
        law_point_start_isotropic(&p, 80e3);
        const double modulus = YOUNGS / 2.6;
        double total = 0.0;
        for (int n = 0; n < 8; ++n) {
            shear(&p, 0.05, 7);
            total += 0.05;
            const double part = fmin(p.state[0] / 0.1, 1.0);
            const double phi = (table[k][0] + part * (table[k][2] - table[k][0])) * DEG;
            const double cohesion = table[k][1] + part * (table[k][3] - table[k][1]);
            const double strength = sin(phi) * 80e3 + cohesion * cos(phi);
            law_point_check_close(p.stress[MOR_XY], strength, 1e-9 * strength);                /* asked: 1e-6 */
            law_point_check_close(p.state[0], (total - strength / modulus) / sqrt(3.0), 1e-9); /* likewise */
            law_point_check_close(law_point_pressure(&p), 80e3, 1e-8);                         /* rounding */
            law_point_check_close(point_distance(&p), 0.0, 1e-8);                              /* rounding */
        }
        assert_true(p.state[0] > 0.1); /* the residual values were reached */
        law_point_close(&p);
    }
}

/* The end does not depend on the number of steps where the pressure is constant: backward Euler meets each cone. */
static void softening_does_not_depend_on_the_steps(void **state)
{
    (void)state;
    double found[2];
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_soil(&p, (soil_values){YOUNGS, 0.3, 35.0 * DEG, 20e3, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN, 1.0, 0.2,
                                    25.0 * DEG, 0.0, 0.0});
        law_point_start_isotropic(&p, 80e3);
        shear(&p, 0.15, k == 0 ? 3 : 500);
        found[k] = p.stress[MOR_XY];
        law_point_close(&p);
    }
    law_point_check_close(found[0], found[1], 1e-9 * found[1]); /* rounding of 500 steps */
}

/* Cohesion lost with the plastic strain takes the apex along. */
static void lost_cohesion_leaves_no_tension(void **state)
{
    (void)state;
    law_point p;
    open_soil(&p, (soil_values){YOUNGS, 0.3, 30.0 * DEG, 10e3, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN, 1.0, 0.02, 0.0,
                                0.0, 0.0});
    const double trial[6] = {90e3, 90e3, 90e3, 0, 0, 0};
    point_map(&p, trial);
    law_point_check_close(law_point_pressure(&p), -10e3 / tan(30.0 * DEG), 1e-9); /* some ulp of 2e4 */
    law_point_start_isotropic(&p, 50e3);
    shear(&p, 0.1, 20);
    assert_true(p.state[0] > 0.02);
    point_map(&p, trial);
    for (int a = 0; a < 6; ++a) {
        assert_true(p.stress[a] == 0.0); /* exact: a cone without cohesion holds nothing */
    }
    law_point_close(&p);
}

/* Dilation that ends at the residual strain: the volume then stays. With the lateral stress held, growth per axial
 * strain is that of the cone at first and none at last. */
static void dilation_ends_at_the_residual_strain(void **state)
{
    (void)state;
    law_point p;
    open_soil(&p, (soil_values){YOUNGS, 0.3, 35.0 * DEG, 0.0, 10.0 * DEG, MOR_DRUCKER_PRAGER_COMPRESSION, 1.0, 0.1,
                                30.0 * DEG, 0.0, 0.0});
    law_point_start_isotropic(&p, 100e3);
    double growth = 0.0;
    for (int n = 0; n < 400; ++n) {
        growth = -1e-3 + 2.0 * point_compress(&p, -1e-3, -100e3, 0);
        assert_true(growth > -1e-3);
    }
    assert_true(p.state[0] > 0.1);
    law_point_check_close(growth, 0.0, 1e-9); /* critical state; lateral stress met to 1e-11 */
    law_point_check_close(-p.stress[MOR_ZZ], 300e3,
                          1e-6 * 300e3); /* (1 + sin 30) / (1 - sin 30) of the lateral stress */
    law_point_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matched_cone_mobilizes_the_friction_angle_in_plane_strain),
        cmocka_unit_test(strength_follows_the_plastic_strain),
        cmocka_unit_test(softening_does_not_depend_on_the_steps),
        cmocka_unit_test(lost_cohesion_leaves_no_tension),
        cmocka_unit_test(dilation_ends_at_the_residual_strain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
