/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages of the stress diffusion that leaves any equilibrium alone. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* MEMORY: time over which the recent mean follows the stress, over h / c0: a few periods of the waves that single
 * particles make, which diffusion is to remove, and short beside those of the soil.
 * NOISE: the part of the stress that noise may be in flow. Strain at a rate g leaves noise at about g of the stress,
 * and diffusion removes it at zeta c0 / h. */
#define MEMORY 5.0
#define NOISE 0.01

/* Turns a mean stress with the soil and lets it follow the stress by a part of their difference. */
static void follow_stress(double *mean, const double *stress, const double *gradient, double length, double part)
{
    static const int place[6] = {0, 4, 8, 1, 5, 2};
    const double m[9] = {mean[MOR_XX], mean[MOR_XY], mean[MOR_ZX], mean[MOR_XY], mean[MOR_YY],
                         mean[MOR_YZ], mean[MOR_ZX], mean[MOR_YZ], mean[MOR_ZZ]};
    for (int k = 0; k < 6; ++k) {
        const int a = place[k] / 3;
        const int b = place[k] % 3;
        double spin = 0.0; /* W m - m W, W the skew part of the gradient */
        for (int c = 0; c < 3; ++c) {
            spin += 0.5 * (gradient[3 * a + c] - gradient[3 * c + a]) * m[3 * c + b];
            spin += 0.5 * (gradient[3 * b + c] - gradient[3 * c + b]) * m[3 * a + c];
        }
        const double turned = m[place[k]] + length * spin;
        mean[k] = turned + part * (stress[k] - turned);
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

mor_status mor_soil_follow_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_soil *soil = owner;
    const double *gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT);
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    double *mean = mor_view_write(view, MOR_FIELD_MEAN_STRESS);
    double *flow = mor_view_write(view, MOR_FIELD_FLOW);
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, n); ++i) {
            const double period = soil->smoothing_length / mor_soil_kind_of(soil, i)->sound_speed;
            const double fade = period / (NOISE * soil->settings.scheme.stress_diffusion);
            const double now = soil->is_relaxing ? 0.0 : fmin(fade * find_shear_rate(gradient + 9 * i), 1.0);
            follow_stress(mean + 6 * i, stress + 6 * i, gradient + 9 * i, step->length,
                          -expm1(-step->length / (MEMORY * period)));
            flow[i] = fmax(now, exp(-step->length / fade) * flow[i]);
        }
    }
    return MOR_OK;
}
