/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_BUILTIN_H
#define MOR_MATERIALS_BUILTIN_H

#include "core/material/registry.h"

/** @file
 *  The models that come with Moraine. */

/** Adds every built-in model to a registry.
 *  @param context  [in,out]  one object
 *  @param registry [in,out]  one object
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN when a name is taken; MOR_ERROR_MEMORY. */
mor_status mor_materials_register_builtin(mor_context *context, mor_registry *registry);

#endif
