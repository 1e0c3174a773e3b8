/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that integrates the displacement which no velocity gradient sees (hourglass control). */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/material/composite.h"

#include <math.h>

/* Turns a displacement with the soil, moves it on, and limits its squared length, m2. */
static void advance_displacement(double *d, const double *rate, const double *gradient, double length, double limit2)
{
    const double spin[3] = {0.5 * (gradient[7] - gradient[5]), 0.5 * (gradient[2] - gradient[6]),
                            0.5 * (gradient[3] - gradient[1])};
    double turned[3];
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        turned[a] = d[a] + length * (rate[a] + spin[b] * d[c] - spin[c] * d[b]);
    }
    const double size2 = mor_vector_dot(turned, turned);
    const double factor = size2 > limit2 ? sqrt(limit2 / size2) : 1.0;
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
    double limits[MOR_COMPOSITE_PARTS_MAX]; /* length over the size of the stress, squared, m2/Pa2 */
    for (int k = 0; k < soil->n_kinds; ++k) {
        const double limit = scheme->soil_hourglass_limit * soil->settings.spacing / soil->pair_soils[k].hourglass;
        limits[k] = limit * limit;
    }
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, n); ++i) {
            const double *s = stress + 6 * i;
            const double size2 = (s[MOR_XX] * s[MOR_XX] + s[MOR_YY] * s[MOR_YY] + s[MOR_ZZ] * s[MOR_ZZ] +
                                  2.0 * (s[MOR_XY] * s[MOR_XY] + s[MOR_YZ] * s[MOR_YZ] + s[MOR_ZX] * s[MOR_ZX])) *
                                 (1.0 / 3.0);
            const double limit2 = limits[mor_soil_kind_of(soil, i) - soil->kinds] * size2;
            advance_displacement(displacement + 3 * i, rate + 3 * i, gradient + 9 * i, step->length, limit2);
        }
    }
    return MOR_OK;
}
