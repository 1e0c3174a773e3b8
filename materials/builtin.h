/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_BUILTIN_H
#define MOR_MATERIALS_BUILTIN_H

#include "core/material/kit/plugin.h"

/** @file
 *  The models that come with Moraine. */

/** All of them, for mor_registry_add_list.
 *  @param instruction_set [in]  zero-terminated; nullable: the fastest this processor has; see mor_isa_select
 *  Returns: a static list; NULL when the instruction set asked for is none of this build or processor. */
const mor_plugin_list *mor_materials_builtin(const char *instruction_set);

#endif
