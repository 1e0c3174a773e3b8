/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_read.h"

#include "cases/driver/sweep/sweep_quantity.h"
#include "cases/driver/sweep/sweep_schema.h"
#include "core/base/memory.h"

#include <ctype.h>
#include <string.h>

/* ---- Variables --------------------------------------------------------------------------------------------------- */

/* "soil[0].material.friction_angle" is called friction_angle, "gravity[1]" gravity-1. */
static void name_variable(mor_sweep_variable *variable)
{
    const char *last = strrchr(variable->key, '.');
    size_t used = 0;
    for (const char *c = last != NULL ? last + 1 : variable->key; *c != '\0' && used + 1 < sizeof variable->name; ++c) {
        if (isalnum((unsigned char)*c) || *c == '_') {
            variable->name[used++] = *c;
        } else if (*c == '[') {
            variable->name[used++] = '-';
        }
    }
}

static mor_status check_name(const mor_case_reader *reader, const mor_case_node *node, const mor_sweep *sweep,
                             const mor_sweep_variable *variable)
{
    for (const mor_sweep_variable *other = sweep->variables; other < variable; ++other) {
        if (strcmp(other->name, variable->name) == 0) {
            return MOR_CASE_NODE_FAIL(
                reader->context, node,
                "found the name '%s', which is that of the variable at line %d; allowed: a name of "
                "its own; give one of them another 'name'",
                variable->name, other->place.line);
        }
        if (variable->key[0] != '\0' && strcmp(other->key, variable->key) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the key '%s', which varies already at line %d; remove one of them",
                                      variable->key, other->place.line);
        }
    }
    return MOR_OK;
}

static mor_status check_key(const mor_case_reader *reader, const mor_case_node *node, const mor_sweep_variable *it)
{
    if (it->key[strcspn(it->key, "= \t")] != '\0') {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found key = \"%s\"; allowed: a key of the case without '=' and blanks; write the "
                                  "values into 'values'",
                                  it->key);
    }
    if (it->name[0] == '\0') {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a variable without a 'name'; allowed: letters, digits, '_' and '-'; add one");
    }
    return MOR_OK;
}

static mor_status read_variable(const mor_case_reader *reader, const mor_case_node *node, mor_sweep *sweep)
{
    mor_sweep_variable *variable = &sweep->variables[sweep->n_variables++];
    mor_case_reader_place(node, &variable->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_sweep_variable_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_sweep_variable_group, variable));
    if (variable->name[0] == '\0') {
        name_variable(variable);
    }
    MOR_TRY(reader->context, check_key(reader, node, variable));
    MOR_TRY(reader->context, check_name(reader, node, sweep, variable));
    return mor_sweep_read_values(reader, node, variable);
}

/* ---- Variables that a choice leaves out -------------------------------------------------------------------------- */

static mor_status read_without(const mor_case_reader *reader, const mor_case_node *node, const mor_sweep *sweep,
                               int variable, mor_sweep_choice *choice)
{
    const char *names[MOR_SWEEP_VARIABLES_MAX];
    const mor_case_node *list = mor_case_node_find(node, "without");
    int n = 0;
    if (list == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "without", MOR_CASE_NODE_LIST, &list));
    for (int k = variable + 1; k < sweep->n_variables; ++k) {
        names[n++] = sweep->variables[k].name;
    }
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        int k = 0;
        while (k < n && (child->kind != MOR_CASE_NODE_TEXT || strcmp(names[k], child->text) != 0)) {
            ++k;
        }
        if (k == n) {
            return mor_case_reader_refuse(reader, child, "name of a variable that stands later in vary", names, n);
        }
        choice->without |= 1u << (variable + 1 + k);
    }
    return MOR_OK;
}

static mor_status read_variables(const mor_case_reader *reader, const mor_case_node *root, mor_sweep *sweep)
{
    const mor_case_node *list = NULL;
    int k = 0;
    MOR_TRY(reader->context, mor_case_reader_member(reader, root, "vary", MOR_CASE_NODE_LIST, &list));
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "vary", MOR_SWEEP_VARIABLES_MAX, &list));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        MOR_TRY(reader->context, read_variable(reader, child, sweep));
    }
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next, ++k) {
        const mor_case_node *choices = mor_case_node_find(child, "choices");
        int c = 0;
        for (const mor_case_node *one = choices != NULL ? choices->first_child : NULL; one != NULL; one = one->next) {
            MOR_TRY(reader->context, read_without(reader, one, sweep, k, &sweep->variables[k].choices[c++]));
        }
    }
    return MOR_OK;
}

/* ---- Results and thresholds -------------------------------------------------------------------------------------- */

/* A record of the group, whose place is told in messages. */
static mor_status read_measure(const mor_case_reader *reader, const mor_case_node *node, const mor_case_group *group,
                               void *record, mor_case_place *place)
{
    mor_case_reader_place(node, place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, group, NULL, NULL));
    return mor_case_reader_group(reader, node, group, record);
}

static mor_status read_results(const mor_case_reader *reader, const mor_case_node *root, mor_sweep *sweep)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "results", MOR_SWEEP_MEASURES_MAX, &list));
    for (const mor_case_node *child = list != NULL ? list->first_child : NULL; child != NULL; child = child->next) {
        mor_sweep_measure *it = &sweep->results[sweep->n_results++];
        MOR_TRY(reader->context, read_measure(reader, child, &mor_sweep_result_group, it, &it->place));
        for (const mor_sweep_measure *other = sweep->results; other < it; ++other) {
            if (strcmp(other->probe, it->probe) == 0 && other->statistic == it->statistic) {
                return MOR_CASE_NODE_FAIL(reader->context, child,
                                          "found the result '%s' twice, also at line %d; remove one of them", it->probe,
                                          other->place.line);
            }
        }
    }
    return MOR_OK;
}

static mor_status read_exceed(const mor_case_reader *reader, const mor_case_node *root, mor_sweep *sweep)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "exceed", MOR_SWEEP_MEASURES_MAX, &list));
    for (const mor_case_node *child = list != NULL ? list->first_child : NULL; child != NULL; child = child->next) {
        mor_sweep_exceed *it = &sweep->exceed[sweep->n_exceed++];
        const mor_case_node *above = mor_case_node_find(child, "above");
        const mor_case_node *below = mor_case_node_find(child, "below");
        MOR_TRY(reader->context, read_measure(reader, child, &mor_sweep_exceed_group, it, &it->measure.place));
        if ((above != NULL) == (below != NULL)) {
            return MOR_CASE_NODE_FAIL(reader->context, child, "found %s above %s below; allowed: one of them; %s",
                                      above != NULL ? "both" : "neither", above != NULL ? "and" : "nor",
                                      above != NULL ? "remove one" : "add one, such as above = \"30 m\"");
        }
        it->is_below = below != NULL;
        if (mor_case_node_find(child, "absent") == NULL) { /* what never came is not above, but it may be below */
            it->absent = it->is_below ? MOR_SWEEP_ABSENT_UNKNOWN : MOR_SWEEP_ABSENT_MISS;
        }
        MOR_TRY(reader->context, mor_sweep_quantity_read(reader, above != NULL ? above : below, &it->threshold));
    }
    return MOR_OK;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

/* Samples belong to distributions. */
static mor_status check_samples(const mor_case_reader *reader, const mor_case_node *root, mor_sweep *sweep)
{
    bool is_random = false;
    for (int k = 0; k < sweep->n_variables; ++k) {
        is_random = is_random || sweep->variables[k].distribution.law != MOR_SWEEP_LAW_NONE;
    }
    if (is_random == (sweep->n_samples == 0)) {
        return MOR_CASE_NODE_FAIL(reader->context, is_random ? root : mor_case_node_find(root, "members"), "found %s",
                                  is_random
                                      ? "a distribution, but no 'members'; add how many samples are drawn, such as "
                                        "members = 20"
                                      : "members, but no distribution to draw them from; remove it, or give a "
                                        "variable a distribution");
    }
    sweep->n_samples = is_random ? sweep->n_samples : 1;
    return MOR_OK;
}

static mor_status read_root(const mor_case_reader *reader, const mor_case_node *root, mor_sweep *sweep)
{
    const mor_case_node *domain = mor_case_node_find(root, "domain");
    if (domain != NULL && mor_case_node_find(root, "vary") == NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, domain,
                                  "found 'domain', which a case has; allowed: a sweep file, which names a case and "
                                  "what varies; run a case as it is");
    }
    MOR_TRY(reader->context, mor_case_reader_names(reader, root, &mor_sweep_root_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, root, &mor_sweep_root_group, sweep));
    MOR_TRY(reader->context, mor_sweep_read_settings(reader, root, "set", &sweep->settings));
    MOR_TRY(reader->context, read_variables(reader, root, sweep));
    MOR_TRY(reader->context, check_samples(reader, root, sweep));
    MOR_TRY(reader->context, read_results(reader, root, sweep));
    return read_exceed(reader, root, sweep);
}

static mor_status read_file(mor_context *context, mor_case_file *file, const char *name, const mor_units *units,
                            mor_sweep *sweep)
{
    const mor_case_reader reader = {.context = context, .units = units, .dimension = 3};
    snprintf(sweep->path, sizeof sweep->path, "%s", name);
    const mor_status status = read_root(&reader, mor_case_file_root(file), sweep);
    mor_case_file_free(context, &file);
    if (status != MOR_OK) {
        mor_sweep_clear(context, sweep);
    }
    return status;
}

mor_status mor_sweep_read(mor_context *context, const char *path, const mor_units *units, mor_sweep *sweep)
{
    mor_case_file *file = NULL;
    memset(sweep, 0, sizeof *sweep);
    MOR_TRY(context, mor_case_file_load(context, path, &file));
    return read_file(context, file, path, units, sweep);
}

mor_status mor_sweep_read_text(mor_context *context, const mor_sweep_text *text, mor_sweep *sweep)
{
    mor_case_file *file = NULL;
    memset(sweep, 0, sizeof *sweep);
    MOR_TRY(context, mor_case_file_parse(context, text->name, text->text, text->n_bytes, &file));
    return read_file(context, file, text->name, text->units, sweep);
}

void mor_sweep_clear(mor_context *context, mor_sweep *sweep)
{
    MOR_FREE(context, &sweep->settings.bytes);
    for (int v = 0; v < sweep->n_variables; ++v) {
        mor_sweep_variable *variable = &sweep->variables[v];
        for (int k = 0; k < variable->n_choices; ++k) {
            MOR_FREE(context, &variable->choices[k].settings.bytes);
        }
        MOR_FREE(context, &variable->choices);
    }
    memset(sweep, 0, sizeof *sweep);
}
