/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_STRESS_STRESS_LIMITS_H
#define MOR_CORE_SPH_STRESS_STRESS_LIMITS_H

#include "core/base/context.h"
#include "core/material/kit/material.h"

/** @file
 *  What a law says of the time step for the particles as they are. */

/** Limits of the time step. */
typedef struct mor_stress_limits {
    double speed; /* largest speed of waves in a particle, m/s; 0 for laws in which it does not change */
    double step;  /* longest step that the law allows, s; infinite for most */
} mor_stress_limits;

/** Numbers of a block of mor_stress_find_limits. */
enum { MOR_STRESS_LIMIT_VALUES = 2 };

/** Finds the limits over all particles of a batch.
 *  @param n_threads [in]   threads there are, >= 1
 *  @param material  [in]   rate form
 *  @param batch     [in]   as of the operations wave_speed and max_step
 *  @param partial   [out]  shape [blocks of MOR_STRESS_BATCH, MOR_STRESS_LIMIT_VALUES]; scratch, unit m/s and s
 *  Returns: the limits; not a number where the law failed. Threads: any number, same result. */
mor_stress_limits mor_stress_find_limits(int n_threads, const mor_material_instance *material, const mor_batch *batch,
                                         double *partial);

#endif
