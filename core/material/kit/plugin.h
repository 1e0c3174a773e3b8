/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_PLUGIN_H
#define MOR_CORE_MATERIAL_KIT_PLUGIN_H

#include "core/material/kit/material.h"

/** @file
 *  What a collection of models shows to the program: a list, and in a shared object the one function that returns it.
 *  The built-in models are such a list, too. */

/** A list of models. Constant and static in the plug-in. */
typedef struct mor_plugin_list {
    uint32_t abi;                         /* MOR_MATERIAL_ABI the plug-in was built for */
    int32_t n_materials;                  /* number of models, >= 1 */
    const mor_material *const *materials; /* shape [n_materials] of pointers to descriptors */
} mor_plugin_list;

/** Type of the exported function.
 *  @param host_abi [in]  MOR_MATERIAL_ABI of the program that loads the plug-in
 *  Returns: the list; NULL when the plug-in cannot serve this program. */
typedef const mor_plugin_list *(*mor_plugin_entry)(uint32_t host_abi);

/** Name of the exported function. */
#define MOR_PLUGIN_SYMBOL "mor_plugin_materials"

/** Put before the exported function when the rest of the object is compiled with hidden symbols. */
#define MOR_PLUGIN_EXPORT __attribute__((visibility("default")))

#endif
