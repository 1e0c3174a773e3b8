/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_COST_H
#define MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_COST_H

#include "core/material/kit/material.h"

/** @file
 *  What an update costs, to be compared with that of other laws timed just before or after on the same machine. */

/** Sizes of strain in a step that laws of rate form are timed with. */
enum { MOR_COST_STRAINS = 3 };

/** Norms of those strains, shape [MOR_COST_STRAINS]; unit 1. */
extern const double mor_conformance_cost_strains[];

/** A clock that never goes back, best one of processor time; returns a time, unit s. */
typedef double (*mor_cost_clock)(void);

/** Times updates of particles in states that random paths have reached, in random directions of strain. Takes some
 *  hundredths of a second.
 *  @param context    [in,out]  its seed decides paths and parameters; left without an error
 *  @param parameters [in]      shape [n_values] in schema order, units of the schema; NULL: drawn from the ranges,
 *                              with the defaults of what need not be given
 *  @param density    [in]      > 0; unit kg/m3
 *  @param clock      [in]      one function
 *  @param seconds    [out]     shape [MOR_COST_STRAINS], of an update of one particle, the least of several trials; NaN
 *                              where the law does not take such a step; of total form, all alike; unit s
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when no parameters are accepted; MOR_ERROR_PLUGIN; MOR_ERROR_MEMORY. */
mor_status mor_conformance_cost(mor_context *context, const mor_material *material, const double *parameters,
                                double density, mor_cost_clock clock, double *seconds);

#endif
