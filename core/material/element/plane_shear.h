/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_ELEMENT_PLANE_SHEAR_H
#define MOR_CORE_MATERIAL_ELEMENT_PLANE_SHEAR_H

#include "core/material/kit/material.h"

/** @file
 *  The strength that a law mobilizes in plane strain, whatever its parameters are called. */

/** Shears a specimen in plane strain, each update under the guard of the context, from equal stress on all sides and
 *  with the mean of the two stresses in the plane kept, until its shear stress no longer grows; so slowly that rates do
 *  not count.
 *  @param instance [in]   of a law in rate form; borrowed
 *  @param density  [in]   > 0; unit kg/m3
 *  @param pressure [in]   > 0, kept as that mean; unit Pa
 *  @param shear    [out]  one number: the largest half difference of the stresses in the plane, unit Pa; unset on
 *                         failure
 *  Returns: MOR_OK; MOR_NOT_CONVERGED when the stress still grows after a strain of 1, or the law takes very short
 *  steps; MOR_ERROR_CRASH; MOR_ERROR_ARGUMENT for a law in total form or a pressure that it does not admit; what the
 *  law returns; MOR_ERROR_MEMORY. */
mor_status mor_plane_shear_find(mor_context *context, const mor_material_instance *instance, double density,
                                double pressure, double *shear);

#endif
