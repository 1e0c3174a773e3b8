/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that flows in simple shear: the axes of its stress do not depend on the length of a step. */
#include "tests/common/law_point.h"
#include "tests/common/sand_specimen.h"

typedef struct flowing_law {
    const char *name;
    double second;     /* of the square of a step's shear: a rotation by tangents, or a stretch by exponentials; 1 */
    double values[16]; /* in the order of the schema; zeros behind them */
} flowing_law;

enum { N_LAWS = 9, N_STEPS = 6 };

static const double SHEAR_MODULUS = 6e6 / 2.6;
static const double PRESSURE = 50e3;

static const flowing_law laws[N_LAWS] = {
    {"drucker_prager", 0.25, {6e6, 0.3, 0.52, 0.0, 0.0, 0.0, 1.0}},
    {"mohr_coulomb", 0.25, {6e6, 0.3, 0.52, 0.0, 0.0, 1.0}},
    {"matsuoka_nakai", 0.25, {6e6, 0.3, 0.52, 0.0, 0.0, 1.0}},
    {"tresca", 0.25, {6e6, 0.3, 20e3, 0.0, 1.0}},
    {"mu_i", 0.25, {6e6, 0.3, 0.38, 0.64, 0.279, 1e-3, 2650.0, 0.0}},
    {"bingham", 0.25, {5e6, 6e6 / 2.6, 20e3, 100.0, 50.0}},
    {"hencky_drucker_prager", 1.0, {6e6, 0.3, 0.52, 0.0, 0.0}},
    {"nonlocal_fluidity", 1.0, {6e6, 0.3, 0.38, 0.64, 0.279, 1e-3, 2650.0, 0.0, 1e-3, 0.01, 0.9}},
    {"modified_cam_clay", 0.25, {0.1, 0.02, 0.5, 6e6 / 2.6, 1.0, 5e3, 1.0, 1e3}},
};

static const double shears[N_STEPS] = {1e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};

/* The axes of a stress: n = (xx - yy)/2 over the radius of Mohr's circle in the plane of shear. */
typedef struct flow_axes {
    double found;
    double steady;   /* what it is in steady flow */
    double expected; /* with what a step leaves */
} flow_axes;

/* For plastic strain with the axes of the stress dn = t dg - m n and dt = (G - n) dg - m t for the shear dg, t = xy, m
 * whatever the flow takes. At rest n G = n^2 + t^2. A share w of the increment before the rotation adds w dg (D6). */
static flow_axes find_axes(const flowing_law *law, double shear)
{
    const double gradient[9] = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    law_point p;
    law_point_open(&p, law->name, law->values);
    law_point_start_isotropic(&p, PRESSURE);
    law_point_steps(&p, gradient, 1.0, (int)lround(1.0 / shear));
    const double n = 0.5 * (p.stress[MOR_XX] - p.stress[MOR_YY]);
    const double radius2 = n * n + p.stress[MOR_XY] * p.stress[MOR_XY];
    const double beside = p.stress[MOR_ZZ] - 0.5 * (p.stress[MOR_XX] + p.stress[MOR_YY]);
    const double j2 = radius2 + beside * beside / 3.0;
    const double ratio = pow(SHEAR_MODULUS * shear, 4) / (j2 * j2);
    const double steady = sqrt(radius2) / SHEAR_MODULUS;
    law_point_close(&p);
    return (flow_axes){n / sqrt(radius2), steady, steady + 0.5 * shear / ((1.0 + ratio) * (1.0 + ratio))};
}

/* With half of each increment before the rotation n would be off by half of the shear of a step, at the longest by 0.05
 * or five times what it is. */
static void axes_of_flow_do_not_depend_on_the_step(void **state)
{
    (void)state;
    for (int k = 0; k < N_LAWS; ++k) {
        for (int s = 0; s < N_STEPS; ++s) {
            const flow_axes axes = find_axes(&laws[k], shears[s]);
            /* Terms of second order in the rotation and in the elastic strain, which is a hundredth. */
            const double allowed = laws[k].second * shears[s] * shears[s] + 2.5e-4;
            if (!(fabs(axes.found - axes.expected) <= allowed * axes.steady) ||
                !(fabs(axes.expected - axes.steady) <= 0.25 * axes.steady)) {
                fail_msg(
                    "%s, shear of %g a step: n over the radius %.5f, not %.5f as with what the step leaves, or %.5f",
                    laws[k].name, shears[s], axes.found, axes.expected, axes.steady);
            }
        }
    }
}

/* Stress of sand that was sheared by 1 at constant volume, shape [6], Pa. */
static void shear_sand(double shear, double range, double *stress)
{
    const double gradient[9] = {0.0, shear, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    specimen s;
    make(&s, 0.8, range, 1e-6);
    press(&s, PRESSURE, PRESSURE);
    for (int k = 0; k < (int)lround(1.0 / shear); ++k) {
        assert_int_equal(step(&s, gradient), MOR_OK);
    }
    memcpy(stress, s.stress, sizeof s.stress);
    discard(&s);
}

/* The strain rate stands still in the axes of the middle of the step while rates are integrated, and in flow in space:
 * an error of second order, since sand by rates forgets its stress over strains far above those of a step. Found are
 * 2.2 to 2.8 times the square of the shear, over the pressure. */
static void stress_by_rates_is_of_second_order_in_the_step(void **state)
{
    static const double ranges[] = {0.0, 1e-4}; /* without and with intergranular strain */
    static const double lengths[] = {0.01, 0.02, 0.05, 0.1};
    (void)state;
    for (int r = 0; r < 2; ++r) {
        double reference[6];
        shear_sand(1e-3, ranges[r], reference);
        const double pressure = -mor_symmetric_trace(reference) / 3.0;
        for (int k = 0; k < 4; ++k) {
            double stress[6];
            shear_sand(lengths[k], ranges[r], stress);
            for (int a = 0; a < 6; ++a) {
                if (!(fabs(stress[a] - reference[a]) <= 3.0 * lengths[k] * lengths[k] * pressure)) {
                    fail_msg("range %g, shear of %g a step, component %d: %.7g, not %.7g Pa", ranges[r], lengths[k], a,
                             stress[a], reference[a]);
                }
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(axes_of_flow_do_not_depend_on_the_step),
                                       cmocka_unit_test(stress_by_rates_is_of_second_order_in_the_step)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
