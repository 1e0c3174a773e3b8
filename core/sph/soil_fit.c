/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that makes the velocity gradient that of a linear field fitted to the neighbors. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* SPARSE: mean of the moment below which neighbors are too few for a fit; FEW: from where on it is taken as it is.
 * FLAT, THIN: determinant of the moment over the cube (square) of its mean, likewise. */
#define SPARSE 0.1
#define FEW 0.2
#define FLAT 0.02
#define THIN 0.1
/* Least part of the moment that the change of volume is taken to see: about that of a particle on an edge. */
#define LEAST_CLOSED 0.5

/* What the fit reads and writes. */
typedef struct fit {
    const mor_soil *soil;
    const double *density;
    double *gradient, *density_rate;
    double volume_factor; /* kernel's own moment over that of the gradients, 1 */
} fit;

/* Rises from 0 to 1 between two values. */
static double fade(double value, double from, double to)
{
    return value >= to ? 1.0 : (value <= from ? 0.0 : (value - from) / (to - from));
}

/* Inverse of a moment, symmetric, blended with the unit tensor where neighbors are few or lie in a plane. */
static void invert_moment(const double *m, int dimension, double *inverse)
{
    const double mean = dimension == 3 ? mor_symmetric_trace(m) / 3.0 : 0.5 * (m[MOR_XX] + m[MOR_YY]);
    double c[6];
    const double determinant = mor_soil_moment_cofactors(m, dimension, c);
    const double cube = dimension == 3 ? mean * mean * mean : mean * mean;
    const double share = mean > SPARSE ? fade(mean, SPARSE, FEW) * fade(determinant / cube, FLAT, THIN) : 0.0;
    const double part = share > 0.0 ? share / determinant : 0.0;
    for (int a = 0; a < 6; ++a) {
        inverse[a] = (a < 3 ? 1.0 - share : 0.0) + part * c[a];
    }
}

static void fit_particle(const fit *it, int64_t i)
{
    const mor_soil *soil = it->soil;
    const int dimension = soil->settings.dimension;
    const double *m = soil->closed + 6 * i;
    const double *c = soil->continued + 6 * i;
    double *gradient = it->gradient + 9 * i;
    double inverse[6];
    double fitted[9];
    invert_moment(m, dimension, inverse);
    for (int a = 0; a < 3; ++a) {
        mor_symmetric_apply(inverse, gradient + 3 * a, fitted + 3 * a);
    }
    double volume = gradient[0] + gradient[4] + gradient[8];
    volume += c[MOR_XX] * fitted[0] + c[MOR_YY] * fitted[4] + c[MOR_ZZ] * fitted[8] +
              c[MOR_XY] * (fitted[1] + fitted[3]) + c[MOR_YZ] * (fitted[5] + fitted[7]) +
              c[MOR_ZX] * (fitted[2] + fitted[6]);
    const double closed = (mor_symmetric_trace(m) + mor_symmetric_trace(c)) / dimension;
    const double scale = 1.0 / (closed > LEAST_CLOSED ? closed : LEAST_CLOSED);
    const double change = (scale * volume - fitted[0] - fitted[4] - fitted[8]) / dimension;
    for (int a = 0; a < dimension; ++a) {
        fitted[4 * a] += change;
    }
    memcpy(gradient, fitted, sizeof fitted);
    it->density_rate[i] = -it->density[i] * it->volume_factor * volume;
}

mor_status mor_soil_fit_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    const int64_t n = soil->set.n_particles;
    const fit job = {.soil = soil,
                     .density = mor_view_read(view, MOR_FIELD_DENSITY),
                     .gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT),
                     .density_rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE),
                     .volume_factor = soil->settings.scheme.lattice_normalization ? soil->lattice_moment : 1.0};
    const double *moments = mor_view_read_shared(view, MOR_RESOURCE_MOMENTS, soil->moments);
    double *closed = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->closed);
    double *continued = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->continued);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    MOR_PARALLEL_FOR (context, k, 6 * n, MOR_BLOCK) {
        closed[k] = moments[k];
        continued[k] = 0.0;
    }
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact =
            mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        mor_soil_contact_add_moments(context, contact, n, closed, continued);
    }
    MOR_PARALLEL_FOR (context, i, n, MOR_BLOCK) {
        fit_particle(&job, i);
    }
    return MOR_OK;
}
