/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that flows in simple shear: the axes of its stress do not depend on the length of a step. */
#include "tests/common/law_point.h"

typedef struct flowing_law {
    const char *name;
    double second;     /* of the square of a step's shear: a rotation by tangents, or a stretch by exponentials; 1 */
    double values[16]; /* in the order of the schema; zeros behind them */
} flowing_law;

enum { N_LAWS = 8, N_STEPS = 6 };

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(axes_of_flow_do_not_depend_on_the_step)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
