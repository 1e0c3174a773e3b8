/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/plugin.h"

#include "core/base/memory.h"
#include "core/material/shared_object.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct mor_plugin {
    char path[PATH_MAX];
    void *handle;                /* from mor_shared_object_open */
    const mor_plugin_list *list; /* inside the shared object */
};

static mor_status open_object(mor_context *context, const char *path, mor_plugin *plugin)
{
    /* An absolute path keeps the loader from searching its folders for a bare name. */
    MOR_CHECK(context, realpath(path, plugin->path) != NULL, MOR_ERROR_IO, "plug-in '%s' cannot be found: %s", path,
              strerror(errno));
    return mor_shared_object_open(context, "plug-in", plugin->path,
                                  "a shared object, as cc -shared -fPIC makes it, without undefined symbols (what it "
                                  "needs comes in the services record)",
                                  &plugin->handle);
}

static mor_status fetch_list(mor_context *context, mor_plugin *plugin)
{
    const mor_plugin_entry entry = (mor_plugin_entry)mor_shared_object_find(plugin->handle, MOR_PLUGIN_SYMBOL);
    MOR_CHECK(
        context, entry != NULL, MOR_ERROR_PLUGIN,
        "plug-in '%s' does not export '%s': define it and do not hide it; a law of another interface, as a UMAT, is "
        "no plug-in, but named by a case",
        plugin->path, MOR_PLUGIN_SYMBOL);
    const mor_plugin_list *list = entry(MOR_MATERIAL_ABI);
    MOR_CHECK(context, list != NULL, MOR_ERROR_PLUGIN,
              "plug-in '%s' does not serve interface %d of this program: rebuild it with this program's headers",
              plugin->path, MOR_MATERIAL_ABI);
    MOR_CHECK(context, list->abi == MOR_MATERIAL_ABI, MOR_ERROR_PLUGIN,
              "plug-in '%s' was built for interface %u; this program has %d: rebuild it with this program's headers",
              plugin->path, list->abi, MOR_MATERIAL_ABI);
    MOR_CHECK(context,
              list->n_materials >= 1 && list->n_materials <= MOR_PLUGIN_MATERIALS_MAX && list->materials != NULL,
              MOR_ERROR_PLUGIN, "plug-in '%s' lists %d materials; 1 to %d are allowed", plugin->path, list->n_materials,
              MOR_PLUGIN_MATERIALS_MAX);
    plugin->list = list;
    return MOR_OK;
}

static mor_status verify_materials(mor_context *context, const mor_plugin *plugin)
{
    const mor_plugin_list *list = plugin->list;
    for (int k = 0; k < list->n_materials; ++k) {
        const mor_status status = mor_material_verify(context, list->materials[k]);
        if (status != MOR_OK) {
            return MOR_FAIL(context, status, "plug-in '%s', material %d: %s", plugin->path, k, context->message);
        }
        for (int other = 0; other < k; ++other) {
            MOR_CHECK(context, strcmp(list->materials[other]->name, list->materials[k]->name) != 0, MOR_ERROR_PLUGIN,
                      "plug-in '%s' lists two materials named '%s': rename one of them", plugin->path,
                      list->materials[k]->name);
        }
    }
    return MOR_OK;
}

mor_status mor_plugin_load(mor_context *context, const char *path, mor_plugin **plugin)
{
    *plugin = NULL;
    mor_plugin *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "plug-in"));
    mor_status status = open_object(context, path, made);
    if (status == MOR_OK) {
        status = fetch_list(context, made);
    }
    if (status == MOR_OK) {
        status = verify_materials(context, made);
    }
    if (status != MOR_OK) {
        mor_plugin_unload(context, &made);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *plugin = made;
    return MOR_OK;
}

mor_status mor_plugin_check_names(mor_context *context, const mor_plugin *plugin, const mor_registry *registry)
{
    for (int k = 0; k < plugin->list->n_materials; ++k) {
        const mor_material *material = plugin->list->materials[k];
        const mor_material *known = mor_registry_find(registry, material->name);
        MOR_CHECK(context, known == NULL || known == material, MOR_ERROR_PLUGIN,
                  "plug-in '%s' brings a material '%s', but one of that name (version %s) is there already: rename it",
                  plugin->path, material->name, known->version);
        MOR_CHECK(
            context, mor_registry_find_interface(registry, material->name) == NULL, MOR_ERROR_PLUGIN,
            "plug-in '%s' brings a material '%s', but that is the name of an interface to laws of other programs: "
            "rename it",
            plugin->path, material->name);
    }
    return MOR_OK;
}

mor_status mor_plugin_register(mor_context *context, const mor_plugin *plugin, mor_registry *registry)
{
    /* Names first, so that a refusal leaves the registry as it was. */
    MOR_TRY(context, mor_plugin_check_names(context, plugin, registry));
    for (int k = 0; k < plugin->list->n_materials; ++k) {
        MOR_TRY(context, mor_registry_add(context, registry, plugin->list->materials[k]));
    }
    return MOR_OK;
}

int mor_plugin_count(const mor_plugin *plugin)
{
    return plugin->list->n_materials;
}

const mor_material *mor_plugin_get(const mor_plugin *plugin, int index)
{
    return index >= 0 && index < plugin->list->n_materials ? plugin->list->materials[index] : NULL;
}

const char *mor_plugin_forbidden_call(const mor_plugin *plugin)
{
    static const char *const names[] = {"malloc",  "calloc", "realloc", "aligned_alloc", "posix_memalign", "printf",
                                        "fprintf", "puts",   "putchar", "__printf_chk",  "__fprintf_chk",  "fopen",
                                        "exit",    "_exit",  "abort",   "getenv",        "setlocale"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        if (mor_shared_object_imports(plugin->handle, names[k])) {
            return names[k];
        }
    }
    return NULL;
}

void mor_plugin_describe(const mor_plugin *plugin, char *text, size_t text_bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < plugin->list->n_materials && used + 1 < text_bytes; ++k) {
        const mor_material *material = plugin->list->materials[k];
        snprintf(text + used, text_bytes - used, "%s%s %s", k > 0 ? ", " : "", material->name, material->version);
        used += strlen(text + used);
    }
}

void mor_plugin_unload(mor_context *context, mor_plugin **plugin)
{
    if (*plugin == NULL) {
        return;
    }
    mor_shared_object_close(&(*plugin)->handle);
    MOR_FREE(context, plugin);
}
