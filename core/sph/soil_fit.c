/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that makes the velocity gradient that of a linear field fitted to the neighbors. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 16 };

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

/* Adds what one slot of a boundary closes of the moments. Across it velocities are mirrored; so they are along it where
 * the soil sticks. Where it slips, they continue along the boundary as in the soil. */
static void add_slot_moments(const mor_soil *soil, const mor_soil_contact *contact, int64_t slot)
{
    const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
    const int64_t n = soil->set.n_particles;
    const int dimension = soil->settings.dimension;
    for (int64_t lane = 0; lane < MOR_CLUSTER && first + lane < n; ++lane) {
        const double *sums = contact->sums + (slot * MOR_CLUSTER + lane) * MOR_KERNEL_SUMS;
        const double *gradient = sums + MOR_KERNEL_SUM_GRADIENT;
        const double length2 = mor_vector_dot(gradient, gradient);
        double applied[3];
        if (!(length2 > 0.0)) {
            continue;
        }
        mor_symmetric_apply(sums + MOR_KERNEL_SUM_MOMENT, gradient, applied);
        const double across = mor_vector_dot(applied, gradient) / length2;
        const double along = (mor_symmetric_trace(sums + MOR_KERNEL_SUM_MOMENT) - across) / (dimension - 1);
        const double stick = contact->stick[slot * MOR_CLUSTER + lane];
        double *moment = soil->closed + 6 * (first + lane);
        double *continued = soil->continued + 6 * (first + lane);
        for (int a = 0; a < 6; ++a) {
            const double square = gradient[a % 3] * gradient[a < 3 ? a : (a - 2) % 3] / length2;
            const double flat = along * ((a < dimension ? 1.0 : 0.0) - square);
            moment[a] += across * square + stick * flat;
            continued[a] += (1.0 - stick) * flat;
        }
    }
}

static void add_wall_moments(mor_context *context, mor_soil *soil, mor_view *view)
{
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact =
            mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
            for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
                add_slot_moments(soil, contact, slot);
            }
        }
    }
}

/* Rises from 0 to 1 between two values. */
static double fade(double value, double from, double to)
{
    return fmin(fmax((value - from) / (to - from), 0.0), 1.0);
}

/* Inverse of a moment, symmetric, blended with the unit tensor where neighbors are few or lie in a plane. */
static void invert_moment(const double *m, int dimension, double *inverse)
{
    const double mean = dimension == 3 ? mor_symmetric_trace(m) / 3.0 : 0.5 * (m[MOR_XX] + m[MOR_YY]);
    const double solid[6] = {m[MOR_XX], m[MOR_YY], dimension == 3 ? m[MOR_ZZ] : 1.0, m[MOR_XY], m[MOR_YZ], m[MOR_ZX]};
    double c[6];
    const double determinant = mor_symmetric_cofactors(solid, c);
    const double cube = dimension == 3 ? mean * mean * mean : mean * mean;
    const double share = mean > SPARSE ? fade(mean, SPARSE, FEW) * fade(determinant / cube, FLAT, THIN) : 0.0;
    for (int a = 0; a < 6; ++a) {
        inverse[a] = (a < 3 ? 1.0 - share : 0.0) + (share > 0.0 ? share * c[a] / determinant : 0.0);
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
    const double scale = 1.0 / fmax(closed, LEAST_CLOSED);
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
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    memcpy(closed, moments, (size_t)(6 * n) * sizeof *closed);
    memset(soil->continued, 0, (size_t)(6 * n) * sizeof *soil->continued);
    add_wall_moments(context, soil, view);
    MOR_PARALLEL_FOR (context, i, n, MOR_BLOCK) {
        fit_particle(&job, i);
    }
    return MOR_OK;
}
