/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_REGISTRY_H
#define MOR_CORE_MATERIAL_REGISTRY_H

#include "core/material/external.h"
#include "core/material/kit/plugin.h"

/** @file
 *  Name -> material descriptor. Registration is explicit: materials/builtin.h lists the built-in models,
 *  core/material/plugin.h those of a shared object. Nothing registers itself. */

enum { MOR_REGISTRY_INTERFACES_MAX = 4 };

typedef struct mor_registry mor_registry;

/** Makes an empty registry.
 *  @param registry [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY.
 *  Cost: allocates. */
mor_status mor_registry_new(mor_context *context, mor_registry **registry);

/** Frees a registry and sets the pointer to NULL; NULL is accepted. Descriptors are borrowed and stay.
 *  @param registry [in,out]  the address of one pointer */
void mor_registry_free(mor_context *context, mor_registry **registry);

/** Adds a model after mor_material_verify. Adding the same descriptor again changes nothing.
 *  @param material [in]      borrowed, must outlive the registry
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN when the descriptor is wrong or another model has the name; MOR_ERROR_MEMORY. */
mor_status mor_registry_add(mor_context *context, mor_registry *registry, const mor_material *material);

/** Adds all models of a list, in its order.
 *  @param list     [in]      borrowed, outlives the registry
 *  Returns: as mor_registry_add; models before the one refused stay. */
mor_status mor_registry_add_list(mor_context *context, mor_registry *registry, const mor_plugin_list *list);

/** Adds all models and interfaces of another registry, in its order.
 *  @param other    [in]      borrowed for this call; the models outlive both
 *  Returns: as mor_registry_add; models before the one refused stay. */
mor_status mor_registry_add_all(mor_context *context, mor_registry *registry, const mor_registry *other);

/** Returns the model of that name, or NULL.
 *  @param name     [in]  zero-terminated
 *  Threads: safe to call concurrently. */
const mor_material *mor_registry_find(const mor_registry *registry, const char *name);

/** As mor_registry_find, but a miss is an error that names the nearest model and lists all.
 *  @param name     [in]      zero-terminated
 *  @param material [out]     one pointer; borrowed; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_registry_require(mor_context *context, const mor_registry *registry, const char *name,
                                const mor_material **material);

/** Returns the name nearest to a misspelled one, or NULL when none is near.
 *  @param name     [in]  zero-terminated
 *  Returns: a string owned by the descriptor. */
const char *mor_registry_nearest(const mor_registry *registry, const char *name);

/** Adds an interface to laws of other programs. Adding the same one again changes nothing.
 *  @param interface [in]     borrowed, must outlive the registry
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN beyond MOR_REGISTRY_INTERFACES_MAX of them. */
mor_status mor_registry_add_interface(mor_context *context, mor_registry *registry,
                                      const mor_external_interface *interface);

/** Returns an interface by place, in order of registration; NULL outside.
 *  @param index    [in]  >= 0 */
const mor_external_interface *mor_registry_interface(const mor_registry *registry, int index);

/** Returns the interface of that name, or NULL.
 *  @param name     [in]  zero-terminated */
const mor_external_interface *mor_registry_find_interface(const mor_registry *registry, const char *name);

/** Number of models. */
int mor_registry_count(const mor_registry *registry);

/** Returns a model by place, in order of registration; NULL outside 0 .. count - 1.
 *  @param index    [in]  0 <= index < mor_registry_count */
const mor_material *mor_registry_get(const mor_registry *registry, int index);

#endif
