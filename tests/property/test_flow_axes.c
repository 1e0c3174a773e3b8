/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that flows in simple shear: the axes of its stress do not depend on the length of a step. */
#include "tests/common/law_point.h"

typedef struct flowing_law {
    const char *name;
    double values[16]; /* in the order of the schema; zeros behind them */
} flowing_law;

enum { N_LAWS = 4, N_STEPS = 6 };

static const double YOUNGS = 6e6;
static const double PRESSURE = 50e3;

static const flowing_law laws[N_LAWS] = {
    {"drucker_prager", {6e6, 0.3, 0.52, 0.0, 0.0, 0.0, 1.0}},
    {"mohr_coulomb", {6e6, 0.3, 0.52, 0.0, 0.0, 1.0}},
    {"matsuoka_nakai", {6e6, 0.3, 0.52, 0.0, 0.0, 1.0}},
    {"tresca", {6e6, 0.3, 20e3, 0.0, 1.0}},
};

static const double shears[N_STEPS] = {1e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};

/* In the plane of shear, n = (xx - yy)/2 and t = xy of a stress whose plastic strain has its axes obey
 * dn = t dg - m n and dt = (G - n) dg - m t for the shear dg, m whatever the flow takes: at rest n G = n^2 + t^2. */
static void find_axes(const flowing_law *law, double shear, double *share, double *steady)
{
    const double modulus = YOUNGS / 2.6;
    const double gradient[9] = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    law_point p;
    law_point_open(&p, law->name, law->values);
    law_point_start_isotropic(&p, PRESSURE);
    law_point_steps(&p, gradient, 1.0, (int)lround(1.0 / shear));
    const double n = 0.5 * (p.stress[MOR_XX] - p.stress[MOR_YY]);
    const double length2 = n * n + p.stress[MOR_XY] * p.stress[MOR_XY];
    *share = n / sqrt(length2);
    *steady = sqrt(length2) / modulus;
    law_point_close(&p);
}

/* With half of each increment before the rotation and half after it the share would be off by half of the shear of a
 * step, 0.05 at the longest. The bound follows from w r, r = G shear / t, w the share before the rotation: at most 0.2.
 * Three tenths, for the strength differs a little from t. */
static void axes_of_flow_do_not_depend_on_the_step(void **state)
{
    (void)state;
    for (int k = 0; k < N_LAWS; ++k) {
        for (int s = 0; s < N_STEPS; ++s) {
            double share = 0.0;
            double steady = 0.0;
            find_axes(&laws[k], shears[s], &share, &steady);
            if (!(fabs(share - steady) <= 0.3 * steady)) {
                fail_msg("%s, shear of %g a step: normal stress over shear stress %g, not %g", laws[k].name, shears[s],
                         share, steady);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(axes_of_flow_do_not_depend_on_the_step)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
