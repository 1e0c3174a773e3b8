/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/material/plugin.h"

#include <stdio.h>
#include <string.h>

/* The list plugins: shared objects whose models the case may name. */

static mor_status find_list(const mor_case_reader *reader, const mor_case_node *root, const mor_case_node **list)
{
    *list = mor_case_node_find(root, "plugins");
    if (*list == NULL) {
        return MOR_OK;
    }
    char found[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_format(*list, found, sizeof found);
    if ((*list)->kind != MOR_CASE_NODE_LIST || (*list)->n_children > MOR_CASE_PLUGINS_MAX) {
        return MOR_CASE_NODE_FAIL(reader->context, *list,
                                  "found plugins = %s; allowed: a list of up to %d paths; write plugins = "
                                  "[ \"./file.so\" ]",
                                  found, MOR_CASE_PLUGINS_MAX);
    }
    return MOR_OK;
}

/* What is wrong with a file becomes an error of the case, with the place where it is named. */
static mor_status annotate_error(const mor_case_reader *reader, const mor_case_node *node, mor_status status)
{
    if (status == MOR_OK || status == MOR_ERROR_MEMORY) {
        return status;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found a plug-in that cannot be used: %s; allowed: a shared object made for this "
                              "program; build it anew or correct the path",
                              why);
}

static mor_status read_plugin(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case)
{
    mor_case_plugin *it = &the_case->plugins[the_case->n_plugins];
    char found[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_format(node, found, sizeof found);
    if (node->kind != MOR_CASE_NODE_TEXT || strlen(node->text) >= sizeof it->file || node->text[0] == '\0') {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found the plug-in %s; allowed: a path of up to %zu letters in quotes; write "
                                  "\"./file.so\"",
                                  found, sizeof it->file - 1);
    }
    snprintf(it->file, sizeof it->file, "%s", node->text);
    MOR_TRY(reader->context, mor_case_reader_locate(reader, node, "a plug-in", it->file, &it->file_hash));
    for (int k = 0; k < the_case->n_plugins; ++k) {
        if (strcmp(the_case->plugins[k].file, it->file) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the plug-in %s twice; allowed: each file once; remove one of them", found);
        }
    }
    MOR_TRY(reader->context, annotate_error(reader, node, mor_plugin_load(reader->context, it->file, &it->plugin)));
    the_case->n_plugins += 1; /* from here on it is the case that unloads it */
    mor_plugin_describe(it->plugin, it->models, sizeof it->models);
    return annotate_error(reader, node, mor_plugin_register(reader->context, it->plugin, the_case->registry));
}

mor_status mor_case_reader_plugins(mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_registry_new(reader->context, &the_case->registry));
    MOR_TRY(reader->context, mor_registry_add_all(reader->context, the_case->registry, reader->registry));
    reader->registry = the_case->registry;
    MOR_TRY(reader->context, find_list(reader, root, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        MOR_TRY(reader->context, read_plugin(reader, node, the_case));
    }
    return MOR_OK;
}
