/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SOIL_ABOVE_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SOIL_ABOVE_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  What soil lies straight above each particle, found from the shapes of the regions: columns of relaxed particles have
 *  no even height. */

/** Finds the height of the soil's surface straight above each particle, and the weight of what lies between them beyond
 *  that of as much of the particle's own soil.
 *  @param simulation [in]      particles in the order of the regions
 *  @param tops       [out]     shape [n_particles]; height of the surface along up over the origin of space, m; that of
 *                              the particle where no shape lies above it
 *  @param excess     [out]     shape [n_particles]; per area, Pa; zero where all soil has one density
 *  Accuracy: tops to 1e-6 spacings, lengths in each soil to a fiftieth of a spacing. Threads: uses the context's. */
void mor_soil_above_find(mor_context *context, const mor_simulation *simulation, double *tops, double *excess);

#endif
