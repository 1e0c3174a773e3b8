/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_VARIED_H
#define MOR_CORE_MATERIAL_VARIED_H

#include "core/material/kit/material.h"

/** @file
 *  A material some of whose parameters vary from particle to particle. They are state variables that never change,
 *  named as the parameters, after those of the law: so sorting, checkpoints and snapshots carry them like any other.
 *  Each operation derives the constants of the law anew for every run of particles with the same values, in memory on
 *  the stack; particles with the values of the law's own instance are computed by that one. The law itself knows
 *  nothing of it. */

/** Makes a material of one in rate form.
 *  @param inner     [in,out]  the address of one pointer; taken over and set NULL on success, and destroyed with it;
 *                             left to the caller on failure
 *  @param entries   [in]      shape [n_entries]; places in the law's schema of parameters, all different: real numbers
 *  @param n_entries [in]      1 <= n_entries
 *  @param varied    [out]     one pointer; freed by mor_material_destroy; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a parameter that is no real number or has the name of a state variable, for
 *  too many state variables, and for a law whose constants need more memory than there is on the stack;
 *  MOR_ERROR_MEMORY.
 *  Cost: allocates here, never in an operation. Threads: as the law. */
mor_status mor_varied_create(mor_context *context, mor_material_instance **inner, const int *entries, int n_entries,
                             mor_material_instance **varied);

/** Returns whether an instance was made by mor_varied_create. */
int mor_varied_is(const mor_material_instance *instance);

/** Says whether the values of the particles are there: init_state then takes them from state_in, and else writes the
 *  parameters of the law's own instance.
 *  @param instance    [in,out]  made by mor_varied_create
 *  @param is_assigned [in]      0 or 1
 *  Threads: none at the same time. */
void mor_varied_set_assigned(mor_material_instance *instance, int is_assigned);

/** Checks the parameters of a particle as a whole: range of each, relations between them, and that no wave is faster
 *  than with the parameters of the law's own instance, which the scheme takes its time step from.
 *  @param instance   [in]  made by mor_varied_create
 *  @param parameters [in]  shape [n_values]; in the order of the law's schema; its units
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT saying why not. */
mor_status mor_varied_check(mor_context *context, const mor_material_instance *instance, const double *parameters);

/** Returns the law of a particle and its parameters; of any other instance itself and its own parameters.
 *  @param state      [in]   shape [n_values] of the state of the instance; units of its schema
 *  @param parameters [out]  shape [n_values]; in the order of the law's schema; its units */
const mor_material_instance *mor_varied_find_law(const mor_material_instance *instance, const double *state,
                                                 double *parameters);

#endif
