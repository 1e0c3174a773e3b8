/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/case_file/case_file.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Looking at the tree of a case file, and errors about its nodes. */

enum { PATH_DEPTH_MAX = 72 };

const mor_case_node *mor_case_node_find(const mor_case_node *group, const char *name)
{
    if (group == NULL || group->kind != MOR_CASE_NODE_GROUP) {
        return NULL;
    }
    for (const mor_case_node *child = group->first_child; child != NULL; child = child->next) {
        if (strcmp(child->name, name) == 0) {
            return child;
        }
    }
    return NULL;
}

void mor_case_node_format(const mor_case_node *node, char *text, size_t text_bytes)
{
    switch (node->kind) {
    case MOR_CASE_NODE_GROUP:
        snprintf(text, text_bytes, "a group { }");
        return;
    case MOR_CASE_NODE_LIST:
        snprintf(text, text_bytes, node->n_children == 0 ? "an empty list" : "a list of %d", node->n_children);
        return;
    case MOR_CASE_NODE_INTEGER:
        snprintf(text, text_bytes, "%" PRId64, node->integer);
        return;
    case MOR_CASE_NODE_REAL:
        snprintf(text, text_bytes, "%.9g", node->real);
        return;
    case MOR_CASE_NODE_BOOLEAN:
        snprintf(text, text_bytes, "%s", node->truth ? "true" : "false");
        return;
    case MOR_CASE_NODE_TEXT:
        snprintf(text, text_bytes, "\"%.60s%s\"", node->text, strlen(node->text) > 60 ? "..." : "");
        return;
    }
}

static int find_index(const mor_case_node *node)
{
    int index = 0;
    for (const mor_case_node *k = node->parent->first_child; k != NULL && k != node; k = k->next) {
        ++index;
    }
    return index;
}

void mor_case_node_path(const mor_case_node *node, char *text, size_t text_bytes)
{
    const mor_case_node *chain[PATH_DEPTH_MAX];
    int n = 0;
    for (; node->parent != NULL && n < PATH_DEPTH_MAX; node = node->parent) {
        chain[n++] = node;
    }
    size_t used = 0;
    snprintf(text, text_bytes, "%s", n == 0 ? "the file" : "");
    while (n-- > 0 && used < text_bytes) {
        if (chain[n]->name == NULL) {
            used += (size_t)snprintf(text + used, text_bytes - used, "[%d]", find_index(chain[n]));
        } else {
            used += (size_t)snprintf(text + used, text_bytes - used, "%s%s", used > 0 ? "." : "", chain[n]->name);
        }
    }
}

void mor_case_node_place(const mor_case_node *node, char *text, size_t text_bytes)
{
    if (node->line == 0 && node->parent != NULL) {
        snprintf(text, text_bytes, "override '%s'", node->origin);
    } else {
        snprintf(text, text_bytes, "%s:%d", node->origin, node->line);
    }
}

mor_status mor_case_node_fail(mor_context *context, const mor_case_node *node, const mor_frame *place,
                              const char *format, ...)
{
    char where[MOR_CASE_PLACE_BYTES];
    char what[MOR_CONTEXT_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    mor_case_node_place(node, where, sizeof where);
    return mor_context_fail(context, MOR_ERROR_CONFIG, place, "%s: %s", where, what);
}
