/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that integrates the displacement which no velocity gradient sees (hourglass control). */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>

/* Turns a displacement with the soil, moves it on, and limits its length, m. */
static void advance_displacement(double *d, const double *rate, const double *gradient, double length, double limit)
{
    const double spin[3] = {0.5 * (gradient[7] - gradient[5]), 0.5 * (gradient[2] - gradient[6]),
                            0.5 * (gradient[3] - gradient[1])};
    double turned[3];
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        turned[a] = d[a] + length * (rate[a] + spin[b] * d[c] - spin[c] * d[b]);
    }
    const double size = mor_vector_length(turned);
    const double factor = size > limit ? limit / size : 1.0;
    for (int a = 0; a < 3; ++a) {
        d[a] = factor * turned[a];
    }
}

mor_status mor_soil_advance_hourglass(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_soil *soil = owner;
    const mor_scheme *scheme = &soil->settings.scheme;
    const double *rate = mor_view_read(view, MOR_FIELD_HOURGLASS_RATE);
    const double *gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT);
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    double *displacement = mor_view_write(view, MOR_FIELD_HOURGLASS);
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, n); ++i) {
            const double *s = stress + 6 * i;
            const double size = sqrt((s[MOR_XX] * s[MOR_XX] + s[MOR_YY] * s[MOR_YY] + s[MOR_ZZ] * s[MOR_ZZ] +
                                      2.0 * (s[MOR_XY] * s[MOR_XY] + s[MOR_YZ] * s[MOR_YZ] + s[MOR_ZX] * s[MOR_ZX])) /
                                     3.0);
            const double stiffness = soil->pair_soils[mor_soil_kind_of(soil, i) - soil->kinds].hourglass;
            const double limit = scheme->soil_hourglass_limit * size * soil->settings.spacing / stiffness;
            advance_displacement(displacement + 3 * i, rate + 3 * i, gradient + 9 * i, step->length, limit);
        }
    }
    return MOR_OK;
}
