/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_STRESS_SEPARATION_H
#define MOR_CORE_SPH_STRESS_SEPARATION_H

#include "core/base/math.h"

#include <math.h>
#include <stdbool.h>

/** @file
 *  Soil that has come apart, and soil that has lost compression. A law in rate form builds up stress from any state,
 *  however far its grains are from one another. By how much soil has opened without a stress to show for it is kept
 *  here, as the volumetric strain of separation, and closes again before the law sees compression. By how much soil has
 *  been compressed without such a stress is kept as the same strain, negative: what goes beyond a bound is restored
 *  to the law. docs/theory/separation.md. */

/** MOR_SEPARATION_ZERO: stresses are zero up to this part of the stiffness rho_0 c_0^2, 1: far above the rounding of a
 *  return to the apex, far below any stress of interest. MOR_SEPARATION_ELASTIC: least rise of the mean stress of an
 *  elastic expansion, over stiffness times strain, 1: K / (K + 4 G / 3) is a third and more, and soil may be up to
 *  fifteen times softer than the speed of sound of its law tells. MOR_SEPARATION_SLACK: largest separation over the
 *  part of the density that is missing, 1. MOR_SEPARATION_ALONE: largest separation of a particle without neighbors,
 *  1: what a wall closes between the end of its support and its face, twice half of the kernel. MOR_SEPARATION_FEW:
 *  mean moment of the kernel over the soil from which on it has neighbors, 1: the nearest one on a lattice adds 0.045
 *  in space, 0.12 in plane strain. MOR_SEPARATION_LOST: lost compression up to which nothing is restored, 1: sums over
 *  disordered neighbors scatter by some percent. MOR_SEPARATION_RESTORED: part of what goes beyond that is restored in
 *  a step, 1; a wave crosses a particle in a few. MOR_SEPARATION_UNKNOWN: value at the start, 1, until a density was
 *  found by summation, which tells how particles were placed, at walls above all; then losses count. */
#define MOR_SEPARATION_ZERO 1.0e-13
#define MOR_SEPARATION_ELASTIC 0.02
#define MOR_SEPARATION_SLACK 10.0
#define MOR_SEPARATION_ALONE 1.0
#define MOR_SEPARATION_FEW 0.3
#define MOR_SEPARATION_LOST 0.1
#define MOR_SEPARATION_RESTORED 0.05
#define MOR_SEPARATION_UNKNOWN (-1.0e-300)

/** What a law sees of the strain of a step. */
typedef struct mor_separation_part {
    double share; /* of all of it, 0 to 1, 1 */
    double taken; /* volumetric strain to be added to that share, 1: what closes without stress, >= 0; minus what is
                   * restored of lost compression, <= 0 */
    double left;  /* strain of separation after the step, as far as nothing opens, 1 */
} mor_separation_part;

/** Returns whether a stress, shape [6], unit Pa, is zero up to a bound, unit Pa. */
static inline bool mor_separation_is_free(const double *stress, double zero)
{
    bool is_free = true;
    for (int a = 0; a < 6; ++a) {
        is_free = is_free && fabs(stress[a]) <= zero;
    }
    return is_free;
}

/** Mean of a stress, shape [6], tension positive, Pa. */
static inline double mor_separation_mean(const double *stress)
{
    return (stress[0] + stress[1] + stress[2]) / 3.0;
}

/** Finds what the law sees of a step of soil that is open. An expansion: all of it, for it tells whether there is
 *  tension. A compression without any stress: nothing, until the soil has closed (A1); with some, of soil with
 *  cohesion: all but what goes beyond the part that takes its tension (A2).
 *  @param separation [in]  strain of separation before the step, > 0, 1
 *  @param strain     [in]  volumetric strain of the step, 1
 *  @param stress     [in]  shape [6]; before the step, Pa
 *  @param stiffness  [in]  rho_0 c_0^2, Pa */
static inline mor_separation_part mor_separation_find(double separation, double strain, const double *stress,
                                                      double stiffness)
{
    const double after = separation + strain;
    if (strain < 0.0 && mor_separation_is_free(stress, MOR_SEPARATION_ZERO * stiffness)) {
        return after > 0.0 ? (mor_separation_part){.share = 0.0, .left = after}
                           : (mor_separation_part){.share = after / strain};
    }
    const double pressed = -strain - mor_separation_mean(stress) / stiffness;
    const double most = mor_min(separation, mor_max(-strain, 0.0));
    const double taken = mor_max(mor_min(pressed, most), 0.0);
    return (mor_separation_part){.share = 1.0, .taken = taken, .left = separation - taken};
}

/** Returns by how much soil has opened in a step that the law saw, >= 0, 1: what of an expansion has not become tension
 *  (A3). None where there is pressure, nor where the expansion is elastic or begins to tear.
 *  @param strain    [in]  volumetric strain of the step, 1
 *  @param before    [in]  shape [6]; stress before the step, Pa
 *  @param stress    [in]  shape [6]; after it, Pa
 *  @param diffused  [in]  mean stress that came by diffusion, which no strain goes with, Pa
 *  @param stiffness [in]  rho_0 c_0^2, Pa */
static inline double mor_separation_open(double strain, const double *before, const double *stress, double diffused,
                                         double stiffness)
{
    const double zero = MOR_SEPARATION_ZERO * stiffness;
    const double mean = mor_separation_mean(stress);
    const double rise = (mean - mor_separation_mean(before)) / stiffness;
    const bool is_torn = mean >= -zero && rise - diffused / stiffness < MOR_SEPARATION_ELASTIC * strain;
    const bool is_open = strain > 0.0 && (is_torn || mor_separation_is_free(stress, zero));
    return is_open ? mor_min(mor_max(strain - rise, 0.0), strain) : 0.0;
}

/** Returns the strain of separation, >= 0, 1, of soil whose density by summation is a ratio of the one at rest (A4).
 *  What is as dense as at the start has closed: a free surface only lowers the sum. Below, the sum is no measure, for
 *  it counts grains too high that lie in pairs; the bound is steep so that nothing depends on the rounding of a sum.
 *  @param separation [in]  >= 0, 1
 *  @param ratio      [in]  of both densities, 1 */
static inline double mor_separation_bound(double separation, double ratio)
{
    return mor_min(separation, MOR_SEPARATION_SLACK * mor_max(1.0 - ratio, 0.0));
}

/** Restores lost compression to the law: it sees all of the step, and of what is lost beyond a bound a part (A7).
 *  @param separation [in]  strain of separation before the step, <= 0, 1 */
static inline mor_separation_part mor_separation_restore(double separation)
{
    const double restored = MOR_SEPARATION_RESTORED * mor_max(-separation - MOR_SEPARATION_LOST, 0.0);
    return (mor_separation_part){.share = 1.0, .taken = -restored, .left = separation + restored};
}

/** Returns the strain of separation, <= 0, 1, of soil after stress came or went that no strain goes with (A5).
 *  @param separation [in]  before, <= 0, 1
 *  @param diffused   [in]  mean stress that came, tension positive, Pa
 *  @param stiffness  [in]  rho_0 c_0^2, Pa */
static inline double mor_separation_lose(double separation, double diffused, double stiffness)
{
    return separation == MOR_SEPARATION_UNKNOWN ? separation : mor_min(separation - diffused / stiffness, 0.0);
}

/** Returns the strain of separation, <= 0, 1, of soil whose density was found by summation (A6): what the rates have
 *  missed of its compression is lost; no more than all compression since the start is.
 *  @param separation [in]  before, <= 0, 1
 *  @param change     [in]  density that was found over that of the rates, > 0, 1
 *  @param ratio      [in]  density by summation over that at the start, > 0, 1 */
static inline double mor_separation_correct(double separation, double change, double ratio)
{
    return separation == MOR_SEPARATION_UNKNOWN
               ? 0.0
               : mor_min(mor_max(separation - log(change), -log(mor_max(ratio, 1.0))), 0.0);
}

#endif
