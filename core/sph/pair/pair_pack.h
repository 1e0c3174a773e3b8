/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_PACK_H
#define MOR_CORE_SPH_PAIR_PAIR_PACK_H

#include "core/base/context.h"
#include "core/sph/pair/pair.h"

#include <stdbool.h>
#include <string.h>

/** @file
 *  Packs what the pair loops read of a particle beside its record. */

/** Packs what the momentum loop reads of a stress with a skew part.
 *  @param stress [in]   shape [6], unit Pa
 *  @param spin   [in]   shape [3]; axial vector of the skew part, unit Pa
 *  @param extra  [out]  shape [MOR_EXTRA_SIZE], units of MOR_EXTRA_...; the components beside the diagonal */
static inline void mor_pair_pack_shears(const double *stress, const double *spin, double *extra)
{
    for (int a = 0; a < 3; ++a) {
        extra[MOR_EXTRA_LOWER + a] = stress[MOR_XY + a] + spin[(a + 2) % 3];
    }
    extra[MOR_EXTRA_UPPER] = stress[MOR_XY] - spin[2];
    extra[MOR_EXTRA_UPPER + 1] = stress[MOR_YZ] - spin[0];
}

/** What that is packed from. Borrowed. */
typedef struct mor_pair_extra_job {
    int64_t n_particles;
    const double *stress;    /* shape [n_particles, 6], Pa */
    const double *spin;      /* shape [n_particles, 3]; axial vector of its skew part, Pa; NULL: none */
    const double *hourglass; /* shape [n_particles, 3], m; displacement against it; NULL: none */
    const double *mean;      /* shape [n_particles, 6], Pa; NULL: what was packed stays, or is zero */
    bool is_whole;           /* nothing stays of what was packed */
    const double *flow;      /* shape [n_particles], 1; with mean */
    const int8_t *changing;  /* shape [clusters]; 0: it stays as it was packed; NULL: none does */
} mor_pair_extra_job;

/** Packs it for all particles.
 *  @param extra [in,out]  shape [n padded to 8, MOR_EXTRA_SIZE], units of MOR_EXTRA_... */
void mor_pair_pack_extra(mor_context *context, const mor_pair_extra_job *job, double *extra);

/** Gives the lanes behind the last particle its values; their sums are discarded.
 *  @param values [in,out]  shape [n padded to 8, width], any unit
 *  @param width  [in]      numbers of a particle, at least 1
 *  @param n      [in]      number of particles, at least 1 */
static inline void mor_pair_repeat_last(double *values, int width, int64_t n)
{
    for (int64_t i = n; i % MOR_CLUSTER != 0; ++i) {
        memcpy(values + i * width, values + (n - 1) * width, (size_t)width * sizeof *values);
    }
}

#endif
