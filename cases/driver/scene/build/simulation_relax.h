/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_RELAX_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_RELAX_H

#include "cases/driver/scene/simulation.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  Soil whose particles are relaxed: all such regions of a case together, among walls, bodies and the soil that stays
 *  on the lattice, whose particles are fixed meanwhile. Each region has the number of particles that its volume holds,
 *  and their mass is that of its volume.
 *  Theory: docs/theory/relaxation.md, Soil. */

/** Returns whether a region of the case has relaxed particles. */
bool mor_simulation_has_relaxed_soil(const mor_case *the_case);

/** Replaces the particles of the regions that are to be relaxed, and sets the volume of the particles of all regions.
 *  @param simulation [in,out]  with its bodies; particle_volumes is set
 *  @param regions    [in,out]  shape [regions of the case]; as filled by mor_simulation_fill_soil, m
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for regions that are too thin, or whose particles do not come
 *  to rest; MOR_ERROR_MEMORY.
 *  Threads: uses the context's; the result does not depend on them. */
mor_status mor_simulation_relax_soil(mor_context *context, mor_simulation *simulation, mor_lattice_points *regions);

#endif
