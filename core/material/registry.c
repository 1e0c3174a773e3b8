/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/registry.h"

#include "core/base/memory.h"
#include "core/base/nearest.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { FIRST_CAPACITY = 16, LIST_BYTES = 512, HINT_BYTES = 160 };

struct mor_registry {
    const mor_material **materials; /* shape [capacity], the first n are valid; owned array of borrowed pointers */
    int n;
    int capacity;
    const mor_external_interface *interfaces[MOR_REGISTRY_INTERFACES_MAX]; /* shape [n_interfaces]; borrowed */
    int n_interfaces;
};

mor_status mor_registry_new(mor_context *context, mor_registry **registry)
{
    *registry = NULL;
    MOR_TRY(context, MOR_NEW(context, registry, 1, "material registry"));
    return MOR_OK;
}

void mor_registry_free(mor_context *context, mor_registry **registry)
{
    if (*registry == NULL) {
        return;
    }
    MOR_FREE(context, &(*registry)->materials);
    MOR_FREE(context, registry);
}

static mor_status grow(mor_context *context, mor_registry *registry)
{
    const int capacity = registry->capacity == 0 ? FIRST_CAPACITY : 2 * registry->capacity;
    const mor_material **materials = NULL;
    MOR_TRY(context, MOR_NEW(context, &materials, capacity, "material registry"));
    for (int k = 0; k < registry->n; ++k) {
        materials[k] = registry->materials[k];
    }
    MOR_FREE(context, &registry->materials);
    registry->materials = materials;
    registry->capacity = capacity;
    return MOR_OK;
}

mor_status mor_registry_add(mor_context *context, mor_registry *registry, const mor_material *material)
{
    MOR_TRY(context, mor_material_verify(context, material));
    const mor_material *known = mor_registry_find(registry, material->name);
    if (known == material) {
        return MOR_OK;
    }
    MOR_CHECK(context, known == NULL, MOR_ERROR_PLUGIN,
              "material '%s' version %s cannot be added: version %s of that name is there already; rename one of them",
              material->name, material->version, known->version);
    if (registry->n == registry->capacity) {
        MOR_TRY(context, grow(context, registry));
    }
    registry->materials[registry->n++] = material;
    return MOR_OK;
}

mor_status mor_registry_add_list(mor_context *context, mor_registry *registry, const mor_plugin_list *list)
{
    for (int k = 0; k < list->n_materials; ++k) {
        MOR_TRY(context, mor_registry_add(context, registry, list->materials[k]));
    }
    return MOR_OK;
}

mor_status mor_registry_add_all(mor_context *context, mor_registry *registry, const mor_registry *other)
{
    for (int k = 0; k < other->n; ++k) {
        MOR_TRY(context, mor_registry_add(context, registry, other->materials[k]));
    }
    for (int k = 0; k < other->n_interfaces; ++k) {
        MOR_TRY(context, mor_registry_add_interface(context, registry, other->interfaces[k]));
    }
    return MOR_OK;
}

mor_status mor_registry_add_interface(mor_context *context, mor_registry *registry,
                                      const mor_external_interface *interface)
{
    if (mor_registry_find_interface(registry, interface->name) == interface) {
        return MOR_OK;
    }
    MOR_CHECK(context, registry->n_interfaces < MOR_REGISTRY_INTERFACES_MAX, MOR_ERROR_PLUGIN,
              "found more than %d interfaces to laws of other programs", MOR_REGISTRY_INTERFACES_MAX);
    registry->interfaces[registry->n_interfaces++] = interface;
    return MOR_OK;
}

const mor_external_interface *mor_registry_interface(const mor_registry *registry, int index)
{
    return index >= 0 && index < registry->n_interfaces ? registry->interfaces[index] : NULL;
}

const mor_external_interface *mor_registry_find_interface(const mor_registry *registry, const char *name)
{
    for (int k = 0; k < registry->n_interfaces; ++k) {
        if (strcmp(registry->interfaces[k]->name, name) == 0) {
            return registry->interfaces[k];
        }
    }
    return NULL;
}

const mor_material *mor_registry_find(const mor_registry *registry, const char *name)
{
    for (int k = 0; k < registry->n; ++k) {
        if (strcmp(registry->materials[k]->name, name) == 0) {
            return registry->materials[k];
        }
    }
    return NULL;
}

const char *mor_registry_nearest(const mor_registry *registry, const char *name)
{
    const char *best = NULL;
    int best_distance = INT_MAX;
    for (int k = 0; k < registry->n; ++k) {
        const char *candidate = registry->materials[k]->name;
        const int distance = mor_nearest_distance(name, candidate);
        if (distance < best_distance && mor_nearest_is_close(name, distance)) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

mor_status mor_registry_require(mor_context *context, const mor_registry *registry, const char *name,
                                const mor_material **material)
{
    *material = mor_registry_find(registry, name);
    if (*material != NULL) {
        return MOR_OK;
    }
    char list[LIST_BYTES] = "";
    for (int k = 0; k < registry->n; ++k) {
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", k == 0 ? "" : ", ", registry->materials[k]->name);
    }
    char hint[HINT_BYTES] = "";
    const char *nearest = mor_registry_nearest(registry, name);
    if (nearest != NULL) {
        snprintf(hint, sizeof hint, " did you mean '%s'?", nearest);
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "material '%s' is not known;%s known: %s", name, hint,
                    registry->n == 0 ? "none (no model is registered)" : list);
}

int mor_registry_count(const mor_registry *registry)
{
    return registry->n;
}

const mor_material *mor_registry_get(const mor_registry *registry, int index)
{
    return index >= 0 && index < registry->n ? registry->materials[index] : NULL;
}
