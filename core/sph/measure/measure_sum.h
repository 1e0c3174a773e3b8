/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_SUM_H
#define MOR_CORE_SPH_MEASURE_MEASURE_SUM_H

/** @file
 *  Compensated sums and the volume of a particle, shared by the measurements. Needs strict floating point: it must not
 *  be compiled with -ffast-math. */

#include "core/base/reduce.h"
#include "core/sph/measure/measure.h"

/** Threads that share one measurement. */
typedef struct mor_measure_team {
    int n_threads; /* 1 for few particles */
} mor_measure_team;

/** Returns the threads for a number of particles.
 *  @param n         [in]  particles
 *  @param n_threads [in]  threads there are; 0: one */
mor_measure_team mor_measure_team_for(int64_t n, int n_threads);

/** Returns the compensated sum of the terms of particles, in their unit, 1 for numbers; the same for any number of
 *  threads.
 *  @param n         [in]  particles
 *  @param n_threads [in]  threads there are; 0: one
 *  @param fill      [in]  the terms
 *  @param job       [in]  first argument of fill */
double mor_sum_over(int64_t n, int n_threads, mor_sum_fill fill, const void *job);

/** Writes the terms of all particles.
 *  @param n         [in]   particles
 *  @param n_threads [in]   threads there are; 0: one
 *  @param fill      [in]   the terms
 *  @param job       [in]   first argument of fill
 *  @param values    [out]  shape [n]; any unit */
void mor_fill_over(int64_t n, int n_threads, mor_sum_fill fill, const void *job, double *values);

/** Returns the volume of a particle, unit m3 (2D: m2).
 *  @param i      [in]  index of the particle */
static inline double mor_measure_volume(const mor_measure_points *points, int64_t i)
{
    const double cube = points->spacing * points->spacing * (points->dimension == 3 ? points->spacing : 1.0);
    return points->density != NULL ? points->mass[i] / points->density[i] : cube;
}

/** Refuses points without particles, spacing or a dimension.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_measure_check_points(mor_context *context, const mor_measure_points *points);

/** Writes the run-out distances of all particles.
 *  @param distances [out]  shape [n_points]; unit m */
void mor_measure_distances(const mor_measure_points *points, const mor_measure_frame *frame, double *distances);

/** Refuses a vector whose length is not 1 to within 1e-9.
 *  @param vector  [in]      shape [3]; unit 1
 *  @param what    [in]      zero-terminated; names the vector in the message
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_measure_check_unit(mor_context *context, const double *vector, const char *what);

/** Refuses a frame whose vectors are not of length 1.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_measure_check_frame(mor_context *context, const mor_measure_frame *frame);

/** Returns the height of a place over the frame's origin, unit m.
 *  @param position [in]  shape [3]; unit m */
double mor_measure_frame_height(const mor_measure_frame *frame, const double *position);

/** Returns the run-out distance of a place, unit m.
 *  @param position [in]  shape [3]; unit m */
double mor_measure_frame_distance(const mor_measure_frame *frame, const double *position);

#endif
