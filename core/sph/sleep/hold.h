/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SLEEP_HOLD_H
#define MOR_CORE_SPH_SLEEP_HOLD_H

#include "core/particle/set.h"
#include "core/sph/sleep/sleep.h"

/** @file
 *  Soil that is not released yet stands as it was placed, whatever pushes it. Clusters that hold nothing else sleep.
 *  Where a cluster holds other soil, too, it is computed, and what is not released is stopped within the step and put
 *  back at its end. Theory: docs/theory/sleep.md. */

enum { MOR_HOLD_REGIONS_MAX = 16 };

/** Soil that is not released. Owner: the soil. */
typedef struct mor_hold {
    double released[MOR_HOLD_REGIONS_MAX]; /* shape [n_regions]; time at which each region is, s */
    int n_regions;                         /* 0: all is from the start */
    int64_t n_held;                        /* particles that are held in this step */
    int64_t n_mixed;                       /* of these, such in clusters with other soil */
    int8_t *is_held;                       /* shape [n_particles]; 1: it is held in this step; NULL without regions */
    int8_t *clusters;                      /* shape [clusters]; 1: all particles of it are */
    int32_t *mixed;                        /* shape [n_mixed]; particles, rising */
    double *kept;     /* shape [capacity]; their values at the start of the step, units of the arrays */
    int64_t capacity; /* numbers there is room for */
} mor_hold;

/** Values of particles. Borrowed. */
typedef struct mor_hold_array {
    double *data; /* shape [n_particles, width], any unit; NULL: there are none */
    int width;
} mor_hold_array;

/** Makes room for a number of particles.
 *  @param hold        [out]  cleared with mor_hold_clear, also after a failure
 *  @param n_particles [in]   largest number of particles there will be, >= 1
 *  @param released    [in]   shape [n_regions], unit s
 *  @param n_regions   [in]   at most MOR_HOLD_REGIONS_MAX
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_hold_init(mor_context *context, mor_hold *hold, int64_t n_particles, const double *released,
                         int n_regions);

/** Frees what it owns; accepts a zeroed one. */
void mor_hold_clear(mor_context *context, mor_hold *hold);

/** Finds the particles that are held at a time.
 *  @param set    [in]  of the particles
 *  @param region [in]  shape [n_particles], number of the region of each, 1; NULL: one region
 *  @param time   [in]  unit s; infinite: none is held
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a particle of a region without a time of release. */
mor_status mor_hold_find(mor_context *context, mor_hold *hold, const mor_set *set, const double *region, double time);

/** Checks that no particle that is held has a velocity, which would carry it along.
 *  @param set      [in]  of the particles, with their positions
 *  @param velocity [in]  shape [n_particles, 3], unit m/s
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL. */
mor_status mor_hold_check(mor_context *context, const mor_hold *hold, const mor_set *set, const double *velocity);

/** Keeps values of held particles in clusters with other soil.
 *  @param arrays   [in]  shape [n_arrays]
 *  @param n_arrays [in]  number of arrays
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates only for more than ever before. */
mor_status mor_hold_keep(mor_context *context, mor_hold *hold, const mor_hold_array *arrays, int n_arrays);

/** Puts these values back.
 *  @param arrays   [in,out]  shape [n_arrays]; as they were kept
 *  @param n_arrays [in]      number of arrays */
void mor_hold_put_back(const mor_hold *hold, const mor_hold_array *arrays, int n_arrays);

/** Sets values of held particles in clusters with other soil to zero.
 *  @param data  [in,out]  shape [n_particles, width], any unit; NULL: nothing is done
 *  @param width [in]      of one particle */
void mor_hold_stop(const mor_hold *hold, double *data, int width);

#endif
