/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages of the stress diffusion that leaves any equilibrium alone. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/material/composite.h"

#include <math.h>
#include <string.h>

/* MEMORY: time over which the recent mean follows the stress, over h / c0. A wave of length l is diffused by y^2 /
 * (1 + y^2) of what diffusion does without the mean, y = 2 pi MEMORY h / l: one as long as the support, 4 h, by 0.98,
 * one of eight supports by half. For waves much longer y is small, and their error of order two in h. Three and less
 * leave a rock on sand, with hourglass control, to swing ever more.
 * NOISE: the part of the stress that noise may be in flow. Strain at a rate g leaves noise at about g of the stress,
 * and diffusion removes it at zeta c0 / h. */
#define MEMORY 5.0
#define NOISE 0.01

/* Turns a mean stress with the soil and lets it follow the stress by a part of their difference. */
static void follow_stress(double *mean, const double *stress, const double *gradient, double length, double part)
{
    /* Skew part of the gradient, times the step: W_ab, and W m - m W. */
    const double xy = 0.5 * length * (gradient[1] - gradient[3]);
    const double yz = 0.5 * length * (gradient[5] - gradient[7]);
    const double zx = 0.5 * length * (gradient[6] - gradient[2]);
    const double *m = mean;
    const double spin[6] = {2.0 * (xy * m[MOR_XY] - zx * m[MOR_ZX]),
                            2.0 * (yz * m[MOR_YZ] - xy * m[MOR_XY]),
                            2.0 * (zx * m[MOR_ZX] - yz * m[MOR_YZ]),
                            xy * (m[MOR_YY] - m[MOR_XX]) - zx * m[MOR_YZ] + yz * m[MOR_ZX],
                            yz * (m[MOR_ZZ] - m[MOR_YY]) - xy * m[MOR_ZX] + zx * m[MOR_XY],
                            zx * (m[MOR_XX] - m[MOR_ZZ]) - yz * m[MOR_XY] + xy * m[MOR_YZ]};
    for (int a = 0; a < 6; ++a) {
        const double turned = mean[a] + spin[a];
        mean[a] = turned + part * (stress[a] - turned);
    }
}

/* Rate of shear, the root of 2 e : e with the deviator e of the strain rate, 1/s. */
static double find_shear_rate(const double *gradient)
{
    const double third = (gradient[0] + gradient[4] + gradient[8]) / 3.0;
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double rate = 0.5 * (gradient[3 * a + b] + gradient[3 * b + a]) - (a == b ? third : 0.0);
            sum += 2.0 * rate * rate;
        }
    }
    return sqrt(sum);
}

/* What the advance of means takes of one soil in one step. */
typedef struct follow {
    double fade; /* time over which flow is forgotten, s */
    double kept; /* part of the flow that is left after the step, 1 */
    double part; /* of the difference to the stress by which the mean follows, 1 */
} follow;

mor_status mor_soil_follow_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_soil *soil = owner;
    const double *gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT);
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    double *mean = mor_view_write(view, MOR_FIELD_MEAN_STRESS);
    double *flow = mor_view_write(view, MOR_FIELD_FLOW);
    const int64_t n = soil->set.n_particles;
    follow of[MOR_COMPOSITE_PARTS_MAX];
    for (int k = 0; k < soil->n_kinds; ++k) {
        const double period = soil->smoothing_length / soil->kinds[k].sound_speed;
        const double fade = period / (NOISE * soil->settings.scheme.stress_diffusion);
        of[k] = (follow){fade, exp(-step->length / fade), -expm1(-step->length / (MEMORY * period))};
    }
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, n); ++i) {
            const follow *it = &of[mor_soil_kind_of(soil, i) - soil->kinds];
            const double rate = soil->is_relaxing ? 0.0 : it->fade * find_shear_rate(gradient + 9 * i);
            const double now = rate < 1.0 ? rate : 1.0;
            follow_stress(mean + 6 * i, stress + 6 * i, gradient + 9 * i, step->length, it->part);
            const double left = it->kept * flow[i];
            flow[i] = now > left ? now : left;
        }
    }
    return MOR_OK;
}
