/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Parameters of a soil that vary in space. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/formula/formula.h"
#include "core/material/params.h"
#include "core/material/varied.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What varies must not be what the scheme counts on to be the same in a soil, as Poisson's ratio in K0, or how a law is
 * integrated. */
static bool may_vary(const mor_schema *parameter)
{
    static const mor_role roles[] = {MOR_ROLE_COHESION,
                                     MOR_ROLE_FRICTION_ANGLE,
                                     MOR_ROLE_DILATION_ANGLE,
                                     MOR_ROLE_TENSION_RATIO,
                                     MOR_ROLE_RESIDUAL_COHESION,
                                     MOR_ROLE_RESIDUAL_FRICTION_ANGLE,
                                     MOR_ROLE_RESIDUAL_DILATION_ANGLE,
                                     MOR_ROLE_YOUNGS_MODULUS,
                                     MOR_ROLE_SHEAR_MODULUS,
                                     MOR_ROLE_BULK_MODULUS};
    bool may = false;
    for (size_t k = 0; k < sizeof roles / sizeof *roles; ++k) {
        may = may || (parameter->role == roles[k] && parameter->kind == MOR_SCHEMA_REAL);
    }
    return may;
}

/* ---- The parameter ----------------------------------------------------------------------------------------------- */

static mor_status find_parameter(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *soil,
                                 mor_case_field *field)
{
    const mor_case_node *name = mor_case_node_find(node, "parameter");
    const char *words[MOR_MATERIAL_PARAMETERS_MAX];
    int n_words = 0;
    field->entry = -1;
    for (int k = 0; soil->law->parameters[k].key != NULL; ++k) {
        if (may_vary(&soil->law->parameters[k])) {
            words[n_words++] = soil->law->parameters[k].key;
            field->entry = strcmp(soil->law->parameters[k].key, field->parameter) == 0 ? k : field->entry;
        }
    }
    if (n_words == 0) {
        return MOR_CASE_NODE_FAIL(
            reader->context, name,
            "found 'fields' of soil '%s', whose law '%s' has no parameter that may vary in space: "
            "none has the role of a strength or a stiffness; take another law, or divide the "
            "soil into regions",
            soil->name, soil->law->name);
    }
    if (field->entry < 0) {
        return mor_case_reader_refuse(reader, name, "parameter of the law that may vary in space", words, n_words);
    }
    for (const mor_case_field *other = soil->fields; other < field; ++other) {
        if (other->entry == field->entry) {
            return MOR_CASE_NODE_FAIL(reader->context, name,
                                      "found '%s' again in the fields of soil '%s'; allowed: each parameter once; "
                                      "remove one",
                                      field->parameter, soil->name);
        }
    }
    return MOR_OK;
}

/* Numbers with the unit of the parameter: nothing is read where they are not written. */
static mor_status read_number(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *parameter,
                              const char *key, const char *text, double least, double *value)
{
    const mor_case_node *child = mor_case_node_find(node, key);
    mor_schema schema = *parameter;
    schema.key = key;
    schema.text = text;
    schema.minimum = least;
    schema.maximum = INFINITY;
    schema.excludes_minimum = 0;
    schema.excludes_maximum = 0;
    return child == NULL ? MOR_OK : mor_case_reader_numbers(reader, child, &schema, false, value);
}

static mor_status read_numbers(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *soil,
                               mor_case_field *field)
{
    const mor_schema *parameter = &soil->law->parameters[field->entry];
    field->unit = 1.0;
    field->standard_deviation = NAN;
    field->minimum = -INFINITY;
    field->maximum = INFINITY;
    MOR_TRY(reader->context, mor_case_reader_scale(reader, parameter->unit, &field->unit, 1, 1));
    MOR_TRY(reader->context, read_number(reader, node, parameter, "standard_deviation",
                                         "standard deviation of the parameter", 0.0, &field->standard_deviation));
    MOR_TRY(reader->context,
            read_number(reader, node, parameter, "minimum", "smallest value of the field", -INFINITY, &field->minimum));
    MOR_TRY(reader->context,
            read_number(reader, node, parameter, "maximum", "largest value of the field", -INFINITY, &field->maximum));
    if (!(field->minimum <= field->maximum)) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "maximum"),
                                  "found a maximum of %.6g below the minimum of %.6g of '%s'; allowed: at least that; "
                                  "correct one of them",
                                  field->maximum, field->minimum, field->parameter);
    }
    return MOR_OK;
}

static mor_status check_formula(const mor_case_reader *reader, const mor_case_node *node, const mor_case_field *field)
{
    mor_formula *formula = NULL;
    if (mor_case_node_find(node, "formula") == NULL) {
        return MOR_OK;
    }
    const mor_status status = mor_formula_new(reader->context, field->formula, &formula);
    mor_formula_free(reader->context, &formula);
    if (status == MOR_ERROR_CONFIG) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%s", reader->context->message);
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "formula"), "%s", why);
    }
    return status;
}

/* ---- Which keys go together -------------------------------------------------------------------------------------- */

/* Keys without effect are refused, those that are needed are asked for. */
static mor_status check_keys(const mor_case_reader *reader, const mor_case_node *node, const mor_case_field *field)
{
    const bool is_random = field->distribution != MOR_CASE_DISTRIBUTION_NONE;
    const bool is_correlated = is_random && mor_case_node_find(node, "correlated_with") != NULL;
    const bool has_deviation = mor_case_node_find(node, "standard_deviation") != NULL;
    const struct {
        const char *key, *condition;
        bool is_used, is_needed;
    } uses[] = {{"formula", "distribution = \"none\"", true, !is_random},
                {"coefficient_of_variation", "a distribution and without standard_deviation",
                 is_random && !has_deviation, is_random && !has_deviation},
                {"standard_deviation", "a distribution", is_random, false},
                {"correlated_with", "a distribution", is_random, false},
                {"cross_correlation", "correlated_with", is_correlated, is_correlated},
                {"correlation", "a distribution and without correlated_with", is_random && !is_correlated, false},
                {"correlation_length", "a distribution and without correlated_with", is_random && !is_correlated,
                 is_random && !is_correlated},
                {"seed", "a distribution and without correlated_with", is_random && !is_correlated, false}};
    for (size_t k = 0; k < sizeof uses / sizeof *uses; ++k) {
        const mor_case_node *child = mor_case_node_find(node, uses[k].key);
        if (child != NULL && !uses[k].is_used) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect in this field of '%s'; allowed: with %s; remove "
                                      "it",
                                      uses[k].key, field->parameter, uses[k].condition);
        }
        if (child == NULL && uses[k].is_needed) {
            return MOR_CASE_NODE_FAIL(
                reader->context, node, "found no '%s' in the field of '%s', where it is needed with %s; add it%s",
                uses[k].key, field->parameter, uses[k].condition, k == 0 ? ", or a distribution" : "");
        }
    }
    return MOR_OK;
}

/* The other field is earlier in the list and random by itself. */
static mor_status find_other(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *soil,
                             mor_case_field *field)
{
    const char *words[MOR_CASE_FIELDS_MAX];
    int n_words = 0;
    field->other = -1;
    if (mor_case_node_find(node, "correlated_with") == NULL) {
        return MOR_OK;
    }
    for (const mor_case_field *it = soil->fields; it < field; ++it) {
        if (it->distribution != MOR_CASE_DISTRIBUTION_NONE && it->other < 0) {
            words[n_words++] = it->parameter;
            field->other = strcmp(it->parameter, field->correlated_with) == 0 ? (int)(it - soil->fields) : field->other;
        }
    }
    if (field->other < 0) {
        return mor_case_reader_refuse(reader, mor_case_node_find(node, "correlated_with"),
                                      "parameter with a random field of its own earlier in the list", words, n_words);
    }
    const mor_case_field *other = &soil->fields[field->other];
    field->correlation = other->correlation;
    field->seed = other->seed;
    memcpy(field->correlation_length, other->correlation_length, sizeof field->correlation_length);
    return MOR_OK;
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

static mor_status read_field(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *soil,
                             mor_case_field *field)
{
    mor_case_place place;
    mor_case_reader_place(node, &place);
    field->line = place.line;
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_field_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_field_group, field));
    MOR_TRY(reader->context, find_parameter(reader, node, soil, field));
    MOR_TRY(reader->context, read_numbers(reader, node, soil, field));
    MOR_TRY(reader->context, check_formula(reader, node, field));
    MOR_TRY(reader->context, check_keys(reader, node, field));
    if (reader->dimension == 2) {
        field->correlation_length[2] = field->correlation_length[1]; /* nothing depends on it */
    }
    return find_other(reader, node, soil, field);
}

/* A law that cannot take the parameters of single particles says so now. */
static mor_status try_law(const mor_case_reader *reader, const mor_case_node *list, const mor_case_soil *soil)
{
    int entries[MOR_CASE_FIELDS_MAX];
    mor_material_instance *law = NULL;
    mor_material_instance *varied = NULL;
    for (int k = 0; k < soil->n_fields; ++k) {
        entries[k] = soil->fields[k].entry;
    }
    MOR_TRY(reader->context, mor_material_create(reader->context, soil->law, soil->density, soil->parameters, &law));
    const mor_status status = mor_varied_create(reader->context, &law, entries, soil->n_fields, &varied);
    mor_material_destroy(reader->context, &varied);
    mor_material_destroy(reader->context, &law);
    if (status != MOR_ERROR_ARGUMENT && status != MOR_ERROR_PLUGIN) {
        return status;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, list, "found fields of soil '%s' that its law refuses: %s", soil->name,
                              why);
}

mor_status mor_case_reader_fields(const mor_case_reader *reader, const mor_case_node *owner, mor_case_soil *soil)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, owner, "fields", MOR_CASE_FIELDS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        MOR_TRY(reader->context, read_field(reader, node, soil, &soil->fields[soil->n_fields++]));
    }
    return list == NULL ? MOR_OK : try_law(reader, list, soil);
}
