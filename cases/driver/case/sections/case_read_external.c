/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Laws of other programs: library, constants, names and initial values of the state. */

static mor_status find_list(const mor_case_reader *reader, const mor_case_node *group, const char *name, int n_max,
                            const mor_case_node **list)
{
    char found[MOR_CASE_NODE_TEXT_BYTES];
    *list = mor_case_node_find(group, name);
    if (*list == NULL || ((*list)->kind == MOR_CASE_NODE_LIST && (*list)->n_children <= n_max)) {
        return MOR_OK;
    }
    mor_case_node_format(*list, found, sizeof found);
    return MOR_CASE_NODE_FAIL(reader->context, *list,
                              "found %s = %s; allowed: a list of up to %d; write %s = ( ..., ... )", name, found, n_max,
                              name);
}

static mor_status read_numbers(const mor_case_reader *reader, const mor_case_node *group, const char *name, int n_max,
                               double **values, int *n)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, find_list(reader, group, name, n_max, &list));
    if (list == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, values, list->n_children, "constants of a law"));
    for (const mor_case_node *node = list->first_child; node != NULL; node = node->next) {
        const bool is_number = node->kind == MOR_CASE_NODE_INTEGER || node->kind == MOR_CASE_NODE_REAL;
        if (!is_number || !isfinite(node->real)) {
            char found[MOR_CASE_NODE_TEXT_BYTES];
            mor_case_node_format(node, found, sizeof found);
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found %s in %s; allowed: numbers without a unit, as the law takes them", found,
                                      name);
        }
        (*values)[(*n)++] = node->real;
    }
    return MOR_OK;
}

static mor_status read_states(const mor_case_reader *reader, const mor_case_node *group, mor_case_external *external)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, find_list(reader, group, "state", MOR_MATERIAL_STATES_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        if (node->kind != MOR_CASE_NODE_TEXT || strlen(node->text) >= MOR_CASE_NAME_BYTES) {
            char found[MOR_CASE_NODE_TEXT_BYTES];
            mor_case_node_format(node, found, sizeof found);
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the state variable %s; allowed: a name in quotes of up to %d letters",
                                      found, MOR_CASE_NAME_BYTES - 1);
        }
        snprintf(external->states[external->n_states++], MOR_CASE_NAME_BYTES, "%s", node->text);
    }
    return MOR_OK;
}

mor_status mor_case_reader_external(const mor_case_reader *reader, const mor_external_interface *interface,
                                    const mor_case_node *node, mor_case_external *external)
{
    const char *names[MOR_MATERIAL_STATES_MAX];
    const mor_case_node *library = mor_case_node_find(node, "library");
    MOR_TRY(reader->context, mor_case_reader_locate(reader, library != NULL ? library : node, "a library",
                                                    external->file, &external->file_hash));
    MOR_TRY(reader->context, read_numbers(reader, node, "props", MOR_EXTERNAL_CONSTANTS_MAX, &external->constants,
                                          &external->n_constants));
    MOR_TRY(reader->context, read_states(reader, node, external));
    MOR_TRY(reader->context, read_numbers(reader, node, "state_start", MOR_EXTERNAL_STATE_VALUES_MAX,
                                          &external->state_start, &external->n_state_start));
    for (int k = 0; k < external->n_states; ++k) {
        names[k] = external->states[k];
    }
    const mor_external_request request = {.library = external->file,
                                          .law = external->law,
                                          .constants = external->constants,
                                          .n_constants = external->n_constants,
                                          .states = names,
                                          .n_states = external->n_states,
                                          .state_start = external->state_start,
                                          .n_state_start = external->n_state_start};
    const mor_status status = interface->make(reader->context, &request, &external->made);
    if (status == MOR_OK || status == MOR_ERROR_MEMORY) {
        return status;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found a law of model '%s' that cannot be used: %s",
                              interface->name, why);
}
