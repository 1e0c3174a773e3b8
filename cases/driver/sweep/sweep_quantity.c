/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_quantity.h"

#include <math.h>
#include <string.h>

enum { SI_BYTES = MOR_UNITS_TEXT_BYTES };

/* A unit that the table knows, and that fits. */
static bool is_unit(const mor_case_reader *reader, const char *text)
{
    mor_context quiet; /* of its own: a word is no error */
    mor_dimension dimension;
    mor_context_init(&quiet);
    return strlen(text) < MOR_SWEEP_UNIT_BYTES &&
           mor_units_dimension(&quiet, reader->units, text, &dimension) == MOR_OK;
}

bool mor_sweep_quantity_is(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_quantity *found)
{
    *found = (mor_sweep_quantity){.number = node->real};
    if (node->kind != MOR_CASE_NODE_TEXT) {
        return node->kind == MOR_CASE_NODE_INTEGER || node->kind == MOR_CASE_NODE_REAL;
    }
    const char *rest = mor_units_number(reader->units, node->text, &found->number);
    if (rest == NULL || (rest[0] != '\0' && !is_unit(reader, rest))) {
        return false;
    }
    snprintf(found->unit, sizeof found->unit, "%s", rest);
    return isfinite(found->number);
}

mor_status mor_sweep_quantity_read(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_quantity *found)
{
    if (mor_sweep_quantity_is(reader, node, found) && isfinite(found->number)) {
        return MOR_OK;
    }
    char path[MOR_CASE_NODE_TEXT_BYTES];
    char text[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_path(node, path, sizeof path);
    mor_case_node_format(node, text, sizeof text);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found %s = %s, which is no number with a unit; allowed: a number in SI, or a text with "
                              "number and unit, as \"25 deg\"; correct it",
                              path, text);
}

mor_status mor_sweep_quantity_convert(mor_context *context, const mor_units *units, const mor_sweep_quantity *quantity,
                                      const char *unit, double *value)
{
    char text[MOR_SWEEP_UNIT_BYTES + 32];
    char si[SI_BYTES];
    mor_dimension dimension;
    double factor = 1.0;
    *value = quantity->number;
    if (strcmp(quantity->unit, unit) == 0) {
        return MOR_OK;
    }
    const char *known = unit[0] != '\0' ? unit : quantity->unit;
    MOR_TRY(context, mor_units_dimension(context, units, known, &dimension));
    mor_dimension_format(&dimension, si, sizeof si);
    if (quantity->unit[0] != '\0' && unit[0] != '\0') {
        mor_sweep_quantity_format(units, quantity->number, quantity->unit, text, sizeof text);
        return mor_units_convert(context, units, text, unit, value);
    }
    snprintf(text, sizeof text, "1 %s",
             known); /* one of the two is SI: units without a shifted zero differ by a factor */
    MOR_TRY(context, mor_units_convert(context, units, text, si, &factor));
    *value = unit[0] != '\0' ? quantity->number / factor : quantity->number * factor;
    return MOR_OK;
}

/* What is bare beside others with a unit is more likely a unit forgotten than SI. */
static mor_status read_member(const mor_case_reader *reader, const mor_case_node *node, bool is_first, char *unit,
                              double *value)
{
    mor_sweep_quantity found;
    MOR_TRY(reader->context, mor_sweep_quantity_read(reader, node, &found));
    if (is_first) {
        snprintf(unit, MOR_SWEEP_UNIT_BYTES, "%s", found.unit);
    }
    const bool is_alike = (found.unit[0] == '\0') == (unit[0] == '\0');
    if (is_alike && mor_sweep_quantity_convert(reader->context, reader->units, &found, unit, value) == MOR_OK) {
        return MOR_OK;
    }
    char path[MOR_CASE_NODE_TEXT_BYTES];
    char text[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_path(node, path, sizeof path);
    mor_case_node_format(node, text, sizeof text);
    return MOR_CASE_NODE_FAIL(
        reader->context, node,
        "found %s = %s beside a number %s%s; allowed: units of one kind, or none at all; give all "
        "numbers of a variable such a unit",
        path, text, unit[0] == '\0' ? "without a unit" : "in ", unit);
}

mor_status mor_sweep_quantity_members(const mor_case_reader *reader, const mor_case_node *group,
                                      const char *const *names, int n, char *unit, double *values)
{
    bool is_first = true;
    unit[0] = '\0';
    for (int k = 0; k < n; ++k) {
        const mor_case_node *node = mor_case_node_find(group, names[k]);
        values[k] = NAN;
        if (node != NULL) {
            MOR_TRY(reader->context, read_member(reader, node, is_first, unit, &values[k]));
            is_first = false;
        }
    }
    return MOR_OK;
}

const char *mor_sweep_quantity_suffix(double value)
{
    return fabs(value) > 2147483647.0 ? "L" : "";
}

void mor_sweep_quantity_format(const mor_units *units, double value, const char *unit, char *text, size_t text_bytes)
{
    const double exact = 9007199254740992.0;                 /* 2^53: up to here doubles hold all whole numbers */
    if (value == nearbyint(value) && fabs(value) <= exact) { /* they stay whole numbers, which some keys need */
        snprintf(text, text_bytes, "%.0f%s", value, unit[0] == '\0' ? mor_sweep_quantity_suffix(value) : "");
    } else {
        mor_units_format(units, value, text, text_bytes);
    }
    if (unit[0] != '\0') {
        const size_t used = strlen(text);
        snprintf(text + used, text_bytes - used, " %s", unit);
    }
}
