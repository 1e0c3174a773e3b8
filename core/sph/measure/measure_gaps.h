/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_GAPS_H
#define MOR_CORE_SPH_MEASURE_MEASURE_GAPS_H

#include "core/sph/measure/measure.h"

/** @file
 *  Gaps between particles that no density tells of: soil that came apart and lies more loosely than the volumes of its
 *  particles say. Theory: docs/theory/separation.md, (A9). */

/** What sums over particles are compared with. Plain data. */
typedef struct mor_measure_reference {
    double smoothing_length; /* m, > 0 */
    double lattice_sum;      /* kernel sum of particles without gaps, their own share included, 1: that of the lattice,
                              * or of relaxed particles at the start */
} mor_measure_reference;

/** How well particles fill the space between them. Only those with soil on all sides are judged: none at surfaces, at
 *  walls or at the faces of a periodic domain, none in sheets and none alone. */
typedef struct mor_measure_gaps {
    double fill;        /* kernel sum over that without gaps, own shares left out, mean by mass, 1; NaN for none */
    double loose_share; /* mass of those whose sum is below MOR_MEASURE_LOOSE over that of all judged, 1; 0 for none */
    double inner_share; /* mass of those judged over that of all, 1 */
} mor_measure_gaps;

/** Sum over that without gaps below which a particle lies loosely, 1. */
#define MOR_MEASURE_LOOSE 0.85

/** Compares the space that particles take by their places with that by their volumes, (A9).
 *  @param points    [in]   in any order; lists are short where each eight in turn lie together
 *  @param reference [in]   of the set
 *  @param gaps      [out]  one object
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. Cost: O(n log n), as lists of neighbors are built; allocates.
 *  Threads: safe to call concurrently with a context each. */
mor_status mor_measure_find_gaps(mor_context *context, const mor_measure_points *points,
                                 const mor_measure_reference *reference, mor_measure_gaps *gaps);

#endif
