/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Friction of walls and bodies with the soil, and with single soils. */
#include "cases/driver/case/sections/case_sections.h"

#include <string.h>

mor_status mor_case_reader_friction(const mor_case_reader *reader, const mor_case_node *node,
                                    mor_case_friction friction)
{
    const mor_case_node *coefficient = mor_case_node_find(node, "friction_coefficient");
    const bool is_coulomb = friction == MOR_CASE_FRICTION_COULOMB;
    if (is_coulomb && coefficient == NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found no 'friction_coefficient' for friction = \"coulomb\"; "
                                  "allowed: >= 0; add it");
    }
    if (!is_coulomb && coefficient != NULL) {
        return MOR_CASE_NODE_FAIL(
            reader->context, coefficient,
            "found 'friction_coefficient', which has no effect with "
            "this friction; allowed: with friction = \"coulomb\"; remove it or change the friction");
    }
    return MOR_OK;
}

/* The soil is one of the case and is listed once. */
static mor_status check_soil(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                             const mor_case_frictions *frictions)
{
    const mor_case_soil_friction *it = &frictions->of[frictions->n - 1];
    const mor_case_node *name = mor_case_node_find(node, "soil");
    const char *names[MOR_CASE_SOILS_MAX];
    bool is_known = false;
    for (int k = 0; k < the_case->n_soils; ++k) {
        names[k] = the_case->soils[k].name;
        is_known = is_known || strcmp(names[k], it->soil) == 0;
    }
    if (!is_known) {
        return mor_case_reader_refuse(reader, name, "name of a soil", names, the_case->n_soils);
    }
    for (const mor_case_soil_friction *other = frictions->of; other < it; ++other) {
        if (strcmp(other->soil, it->soil) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, name,
                                      "found the soil '%s' again in friction_with; allowed: each soil once; remove one",
                                      it->soil);
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_frictions(const mor_case_reader *reader, const mor_case_node *owner,
                                     const mor_case *the_case, mor_case_frictions *frictions)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, owner, "friction_with", MOR_CASE_SOILS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        mor_case_soil_friction *it = &frictions->of[frictions->n++];
        MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_friction_group, NULL, NULL));
        MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_friction_group, it));
        MOR_TRY(reader->context, mor_case_reader_friction(reader, node, it->friction));
        MOR_TRY(reader->context, check_soil(reader, node, the_case, frictions));
    }
    return MOR_OK;
}
