/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_GAPS_H
#define MOR_CORE_SPH_MEASURE_MEASURE_GAPS_H

#include "core/sph/measure/measure.h"

/** @file
 *  Gaps between particles that no density tells of: soil that fell or flew apart and lies more loosely than the volumes
 *  of its particles say. Theory: docs/theory/separation.md, gaps. */

/** What a particle sees of the soil around it. Plain data. */
typedef struct mor_measure_sight {
    double smoothing_length; /* m, > 0 */
    double lattice_sum;      /* kernel sum of particles as they were at the start, their own share included, 1 */
} mor_measure_sight;

/** How well particles fill the space between them. Only those with soil on all sides are judged: none at surfaces or
 *  walls, and none alone. */
typedef struct mor_measure_gaps {
    double fill;        /* kernel sum over that of the start, own shares left out, mean by mass, 1; NaN for none */
    double loose_share; /* mass of those whose sum is below MOR_MEASURE_LOOSE over that of all judged, 1; 0 for none */
    double inner_share; /* mass of those judged over that of all, 1 */
} mor_measure_gaps;

/** Sum over that of the start below which a particle lies loosely, 1. */
#define MOR_MEASURE_LOOSE 0.85

/** Compares the space that particles take by their positions with that by their volumes.
 *  @param points [in]   with densities; positions in any order, compact if each eight in turn lie together
 *  @param sight  [in]   of the set
 *  @param gaps   [out]  one object
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. Cost: O(n), builds lists of neighbors; allocates. */
mor_status mor_measure_find_gaps(mor_context *context, const mor_measure_points *points, const mor_measure_sight *sight,
                                 mor_measure_gaps *gaps);

#endif
