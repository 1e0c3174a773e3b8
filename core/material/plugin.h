/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_PLUGIN_H
#define MOR_CORE_MATERIAL_PLUGIN_H

#include "core/material/kit/plugin.h"
#include "core/material/registry.h"

/** @file
 *  Materials from a shared object, which exports the function of core/material/kit/plugin.h; nothing registers itself
 *  and no folder is searched. Its code must stay loaded while anything made from it lives: destroy the instances and
 *  free the registry first, unload last. */

/** Largest number of models in one shared object. */
enum { MOR_PLUGIN_MATERIALS_MAX = 256 };

typedef struct mor_plugin mor_plugin;

/** Loads a shared object and verifies every model in it.
 *  @param path    [in]      zero-terminated; the file, absolute or from the working folder
 *  @param plugin  [out]     one pointer; owned by the caller; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_IO when there is no such file; MOR_ERROR_CONFIG when it is no shared library;
 *  MOR_ERROR_PLUGIN saying what is wrong with it; MOR_ERROR_MEMORY.
 *  Cost: allocates. Threads: not concurrently. */
mor_status mor_plugin_load(mor_context *context, const char *path, mor_plugin **plugin);

/** Refuses a plug-in with a model whose name a registry has for another, or for an interface.
 *  @param plugin   [in]  a loaded plug-in
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN. */
mor_status mor_plugin_check_names(mor_context *context, const mor_plugin *plugin, const mor_registry *registry);

/** Adds all models of a plug-in to a registry, or none of them.
 *  @param plugin   [in]      must outlive the registry
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN when a name is taken; MOR_ERROR_MEMORY. */
mor_status mor_plugin_register(mor_context *context, const mor_plugin *plugin, mor_registry *registry);

/** Number of models. */
int mor_plugin_count(const mor_plugin *plugin);

/** Returns a model by place; NULL outside 0 .. count - 1.
 *  @param index  [in]  0 <= index < mor_plugin_count */
const mor_material *mor_plugin_get(const mor_plugin *plugin, int index);

/** Returns the first function that a plug-in calls and may not: one that takes memory, prints or ends the process; NULL
 *  when there is none. A static string. */
const char *mor_plugin_forbidden_call(const mor_plugin *plugin);

/** Writes the models with their versions, "clay 1.0, sand 2.1", for people and for the provenance of a run.
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_plugin_describe(const mor_plugin *plugin, char *text, size_t text_bytes);

/** Unloads the object and sets the pointer to NULL; NULL is accepted. Descriptors from it are gone afterwards.
 *  @param plugin  [in,out]  the address of one pointer */
void mor_plugin_unload(mor_context *context, mor_plugin **plugin);

#endif
