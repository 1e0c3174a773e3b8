/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SOIL_STIFFNESS_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SOIL_STIFFNESS_H

#include "core/sph/soil.h"

/** @file
 *  How fast waves are in the soil as it is: by what its law tells, and by what its law does. */

/** Speeds of waves, and where they are found. */
typedef struct mor_soil_stiffness {
    double ratio;     /* largest of a speed that the law tells over that without stress, >= 1; unit 1 */
    int64_t at_ratio; /* particle */
    double told;      /* largest speed that the law tells, with or without stress; unit m/s */
    double measured;  /* largest sqrt(K/density), K by small strains either way; 0: none found; unit m/s */
    int64_t at_measured;
} mor_soil_stiffness;

/** Finds the speeds. The soil is left as it is.
 *  @param soil  [in]   with its present stress and state
 *  @param found [out]  one object; particles whose law refuses the call are left out
 *  Cost: a wave speed and two updates of the law per particle. */
void mor_soil_stiffness_find(const mor_soil *soil, mor_soil_stiffness *found);

#endif
