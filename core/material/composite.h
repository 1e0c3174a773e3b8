/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_COMPOSITE_H
#define MOR_CORE_MATERIAL_COMPOSITE_H

#include "core/material/kit/material.h"

/** @file
 *  Several materials behind one instance. A state variable tells which of them a particle is made of; each operation
 *  gathers the particles of a material, lets it work on them, and puts the results back. So a solver of one material
 *  computes layered soil without knowing it. */

enum { MOR_COMPOSITE_PARTS_MAX = 16 };

/** State variable of a composite that tells the material of a particle: its index, 0 <= index < number of parts. It
 *  is the first. */
#define MOR_COMPOSITE_INDEX_KEY "soil"

/** Makes a composite of rate-form materials. Its state variables are the index, then those of all parts; parts that
 *  declare the same variable (key, number of components, unit) share it. A particle's variables that its material does
 *  not have stay as they are.
 *  @param parts    [in]   shape [n_parts]; borrowed, outlive the composite
 *  @param n_parts  [in]   1 <= n_parts <= MOR_COMPOSITE_PARTS_MAX
 *  @param instance [out]  one pointer; the composite, to be freed with mor_material_destroy; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a part in total form, for a variable that two parts declare differently, and
 *  for too many variables; MOR_ERROR_MEMORY.
 *  Cost: allocates here, never in an operation. Threads: as the parts. */
mor_status mor_composite_create(mor_context *context, const mor_material_instance *const *parts, int n_parts,
                                mor_material_instance **instance);

/** Returns the material that a particle of a composite is made of, and its part of the state; of any other instance
 *  itself and the whole state.
 *  @param state      [in]   shape [n_values]; of the particle; schema order; units of the schema of the instance
 *  @param part_state [out]  shape [n_values]; schema order; units of the schema of the material returned */
const mor_material_instance *mor_composite_find_part(const mor_material_instance *instance, const double *state,
                                                     double *part_state);

/** Returns which state variable is the field of a nonlocal part, see mor_material_operations.diffusivity; parts that
 *  share the variable share the field.
 *  @param part [in]  of a composite; any other instance is its own part 0
 *  Returns: its index among the state variables of the instance; -1 for a part without a field. */
int mor_composite_field(const mor_material_instance *instance, int part);

/** Returns whether an instance was made by mor_composite_create. */
int mor_composite_is(const mor_material_instance *instance);

/** Returns the law of a part of a composite; of any other instance, itself. Borrowed.
 *  @param part [in]  0 .. n_parts - 1 */
const mor_material_instance *mor_composite_part(const mor_material_instance *instance, int part);

#endif
