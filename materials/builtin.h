/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_BUILTIN_H
#define MOR_MATERIALS_BUILTIN_H

#include "core/material/kit/plugin.h"

/** @file
 *  The models that come with Moraine. */

/** All of them, for mor_registry_add_list. */
extern const mor_plugin_list mor_materials_builtin;

#endif
