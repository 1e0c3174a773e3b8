/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_START_SIMULATION_FIELD_H
#define MOR_CASES_DRIVER_SCENE_START_SIMULATION_FIELD_H

#include "cases/driver/scene/simulation.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  Parameters of soil that vary in space: values of the particles by formulas and random fields of their places at the
 *  start. The particles carry them from then on as state variables of the soil. */

/** Makes the material of a region one of parameters that vary, where the region has fields.
 *  @param soil     [in]      index of the region
 *  @param instance [in,out]  the address of one pointer; replaced
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_simulation_vary_material(mor_context *context, const mor_case *the_case, int soil,
                                        mor_material_instance **instance);

/** Gives the particles of all regions the values of their parameters that vary, reduced where the case says so; those
 *  of regions without such a field get the value of their material. Keeps what was found in simulation->fields.
 *  @param simulation [in,out]  particles in the order of the regions
 *  @param regions    [in]      shape [regions of the case]; their points
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a value that is not finite, a mean of a lognormal field that is not above
 *  zero, and parameters that the law refuses, naming the place; MOR_ERROR_MEMORY. */
mor_status mor_simulation_set_fields(mor_context *context, mor_simulation *simulation,
                                     const mor_lattice_points *regions);

/** Checks the parameters of particles that brought some of them from the run that the case starts from, once they have
 *  them.
 *  @param simulation [in]  particles in the order of the regions
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for parameters that the law refuses, naming the place. */
mor_status mor_simulation_check_fields(mor_context *context, const mor_simulation *simulation);

#endif
