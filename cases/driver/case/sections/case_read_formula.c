/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Formulas of a place. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/formula/formula.h"

#include <stdio.h>
#include <string.h>

static mor_status read_formula(const mor_case_reader *reader, const mor_case_node *node, char *text)
{
    mor_formula *formula = NULL;
    if (node->kind == MOR_CASE_NODE_INTEGER || node->kind == MOR_CASE_NODE_REAL) {
        snprintf(text, MOR_CASE_TEXT_BYTES, "%.17g", node->real);
        return MOR_OK;
    }
    if (node->kind != MOR_CASE_NODE_TEXT || strlen(node->text) >= MOR_CASE_TEXT_BYTES) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found what is no formula, or one of %d letters or more; allowed: a text in quotes, "
                                  "as \"0.1*y\", with " MOR_FORMULA_ALLOWED "; correct it",
                                  MOR_CASE_TEXT_BYTES);
    }
    memcpy(text, node->text, strlen(node->text) + 1);
    const mor_status status = mor_formula_new(reader->context, text, &formula);
    mor_formula_free(reader->context, &formula);
    if (status == MOR_ERROR_CONFIG) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%s", reader->context->message);
        return MOR_CASE_NODE_FAIL(reader->context, node, "%s", why);
    }
    return status;
}

mor_status mor_case_reader_formulas(const mor_case_reader *reader, const mor_case_node *owner, const char *name,
                                    const char *what, int n, char (*formulas)[MOR_CASE_TEXT_BYTES])
{
    const mor_case_node *list = NULL;
    int k = 0;
    MOR_TRY(reader->context, mor_case_reader_member(reader, owner, name, MOR_CASE_NODE_LIST, &list));
    if (list->n_children != n) {
        return MOR_CASE_NODE_FAIL(reader->context, list,
                                  "found %d formulas in '%s'; allowed: %d in ( ), each in quotes: %s; write \"0\" for "
                                  "those that are zero",
                                  list->n_children, name, n, what);
    }
    for (const mor_case_node *node = list->first_child; node != NULL; node = node->next) {
        MOR_TRY(reader->context, read_formula(reader, node, formulas[k++]));
    }
    return MOR_OK;
}
