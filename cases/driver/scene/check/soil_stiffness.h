/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SOIL_STIFFNESS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SOIL_STIFFNESS_H

#include "core/sph/soil.h"

/** @file
 *  How fast waves are in the soil as it is: by the wave speed that its law declares, and by the stiffness that the law
 *  shows. */

/** Speeds of waves, and the particles where they are found. */
typedef struct mor_soil_stiffness {
    double ratio; /* largest of a declared speed over that of the same soil without stress, >= 1; unit 1 */
    int64_t at_ratio;
    double declared; /* largest declared speed, with or without stress; unit m/s */
    int64_t at_declared;
    double measured; /* largest sqrt(K/density), K by small strains either way; 0: none found; unit m/s */
    int64_t at_measured;
} mor_soil_stiffness;

/** Finds the speeds. Stress, state and density of the soil stay as they are; laws that are given by their rates count
 *  the updates (core/material/rate_integration.h).
 *  @param soil  [in]   with its present stress and state
 *  @param found [out]  one object; particles at which the law refuses a strain, or crashes, have no measured speed
 *  Cost: a wave speed and three updates of the law per particle. */
void mor_soil_stiffness_find(const mor_soil *soil, mor_soil_stiffness *found);

#endif
