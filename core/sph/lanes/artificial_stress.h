/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_LANES_ARTIFICIAL_STRESS_H
#define MOR_CORE_SPH_LANES_ARTIFICIAL_STRESS_H

/** @file
 *  The artificial stress of one particle against tensile instability. */

/** Answers principal tensions by -factor times themselves, in two and three dimensions: Zhang et al. (2024) eqs. 28-31.
 *  @param stress     [in]   shape [6], unit Pa
 *  @param factor     [in]   epsilon, 1
 *  @param artificial [out]  shape [6], unit Pa; no principal value above zero */
void mor_artificial_stress_find(const double *stress, double factor, double *artificial);

#endif
