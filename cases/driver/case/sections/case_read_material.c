/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/material/params.h"

#include <stdio.h>
#include <string.h>

/* What soil, walls and bodies have in common: a material, friction, a name of its own, a plane. */

enum { WORDS_MAX = 64, WHAT_BYTES = 256 };

/* ---- Material ---------------------------------------------------------------------------------------------------- */

/* The words that stand for a model: those without code, the models of the form, the interfaces. */
static int list_words(const mor_case_reader *reader, const mor_case_material_slot *slot, const char **words)
{
    int n = 0;
    for (const char *const *word = slot->bare_words; word != NULL && *word != NULL; ++word) {
        words[n++] = *word;
    }
    for (int k = 0; k < mor_registry_count(reader->registry); ++k) {
        const mor_material *listed = mor_registry_get(reader->registry, k);
        if (listed->form == slot->form && n < WORDS_MAX) {
            words[n++] = listed->name;
        }
    }
    const mor_external_interface *interface = NULL;
    for (int k = 0; slot->external != NULL && (interface = mor_registry_interface(reader->registry, k)) != NULL; ++k) {
        if (n < WORDS_MAX) {
            words[n++] = interface->name;
        }
    }
    return n;
}

static bool is_bare(const mor_case_material_slot *slot, const char *name)
{
    bool is_found = false;
    for (const char *const *word = slot->bare_words; word != NULL && *word != NULL; ++word) {
        is_found = is_found || strcmp(*word, name) == 0;
    }
    return is_found;
}

/* Model: NULL for the word that stands for no model, and where it is an interface that has yet to make it. */
static mor_status read_model(const mor_case_reader *reader, const mor_case_node *node,
                             const mor_case_material_slot *slot, const mor_material **model,
                             const mor_external_interface **interface)
{
    const char *words[WORDS_MAX];
    const mor_case_node *name = NULL;
    *model = NULL;
    *interface = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "model", MOR_CASE_NODE_TEXT, &name));
    if (is_bare(slot, name->text)) {
        return MOR_OK;
    }
    *interface = slot->external != NULL ? mor_registry_find_interface(reader->registry, name->text) : NULL;
    if (*interface != NULL) {
        return MOR_OK;
    }
    *model = mor_registry_find(reader->registry, name->text);
    if (*model == NULL || (*model)->form != slot->form) {
        char what[WHAT_BYTES];
        snprintf(what, sizeof what, "%s; that of a plug-in where the case has plugins = [ \"./FILE.so\" ]", slot->what);
        return mor_case_reader_refuse(reader, name, *model == NULL ? what : slot->what, words,
                                      list_words(reader, slot, words));
    }
    MOR_CHECK(reader->context, mor_params_count((*model)->parameters) <= MOR_CASE_PARAMETERS_MAX, MOR_ERROR_PLUGIN,
              "the model '%s' has %d parameters; at most %d are allowed", name->text,
              mor_params_count((*model)->parameters), MOR_CASE_PARAMETERS_MAX);
    return MOR_OK;
}

static mor_status default_parameter(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                                    double *values)
{
    if (schema->is_required) {
        char range[MOR_CASE_NODE_TEXT_BYTES];
        char allowed[MOR_CONTEXT_MESSAGE_BYTES];
        mor_params_range(schema, range, sizeof range);
        snprintf(allowed, sizeof allowed, "%s (%s)", range, schema->text);
        return mor_case_reader_refuse_missing(reader, node, schema->key, allowed);
    }
    for (int a = 0; a < schema->n_components; ++a) {
        values[a] = schema->kind == MOR_SCHEMA_CHOICE ? 0.0 : schema->default_value;
    }
    return mor_case_reader_scale(reader, schema->unit, values, schema->n_components, 1);
}

/* Relations between parameters are checked by the model: an instance is created. */
static mor_status try_material(const mor_case_reader *reader, const mor_case_node *node, const mor_material *model,
                               const mor_case_material_slot *slot)
{
    mor_material_instance *instance = NULL;
    const mor_status status = mor_material_create(reader->context, model, *slot->density, slot->parameters, &instance);
    mor_material_destroy(reader->context, &instance);
    if (status != MOR_ERROR_ARGUMENT && status != MOR_ERROR_PLUGIN) {
        return status;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found parameters that '%s' refuses: %s", model->name, why);
}

static mor_status read_parameters(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schemas,
                                  const mor_case_material_slot *slot)
{
    double *values = slot->parameters;
    for (int k = 0; schemas[k].key != NULL; ++k) {
        const mor_case_node *child = mor_case_node_find(node, schemas[k].key);
        if (child == NULL) {
            MOR_TRY(reader->context, default_parameter(reader, node, &schemas[k], values));
        } else {
            MOR_TRY(reader->context, mor_case_reader_numbers(reader, child, &schemas[k], false, values));
            *slot->written |= (uint64_t)1 << k;
        }
        values += schemas[k].n_components;
    }
    return MOR_OK;
}

/* Constants without units cannot follow the scale of the case. */
static mor_status check_scale(const mor_case_reader *reader, const mor_case_node *node, const mor_material *model)
{
    const bool is_scaled = reader->length_power != 0 || reader->time_power != 0 || reader->mass_power != 0;
    if (is_scaled && (model->capabilities & MOR_MATERIAL_FIXED_UNITS) != 0) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found the model '%s', whose constants have no units, in a case with a scale; "
                                  "allowed: no scale; remove it",
                                  model->name);
    }
    return MOR_OK;
}

mor_status mor_case_reader_material(const mor_case_reader *reader, const mor_case_node *owner,
                                    const mor_case_material_slot *slot)
{
    const mor_case_node *node = NULL;
    const mor_material *model = NULL;
    const mor_external_interface *interface = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, owner, "material", MOR_CASE_NODE_GROUP, &node));
    MOR_TRY(reader->context, read_model(reader, node, slot, &model, &interface));
    const mor_schema *schemas = interface != NULL ? interface->parameters : model == NULL ? NULL : model->parameters;
    const mor_case_group *group = interface != NULL ? slot->outer_group : slot->group;
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, group, NULL, schemas));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, group, slot->record));
    if (interface != NULL) {
        MOR_TRY(reader->context, mor_case_reader_external(reader, interface, node, slot->external));
        model = &slot->external->made->material;
    }
    if (slot->law != NULL) {
        *slot->law = model;
    }
    if (model == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, read_parameters(reader, node, schemas, slot));
    MOR_TRY(reader->context, check_scale(reader, node, model));
    const bool is_whole = reader->mistakes == NULL || reader->mistakes->n == 0; /* else a value may be missing */
    return is_whole ? try_material(reader, node, model, slot) : MOR_OK;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

mor_status mor_case_reader_in_plane(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                    const double *vector)
{
    const mor_case_node *node = mor_case_node_find(group, name);
    if (reader->dimension == 3 || vector[2] == 0.0) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(reader->context, node == NULL ? group : node, /* written under its former name */
                              "found %s with a component along z in plane strain; allowed: x and y; set it to zero",
                              name);
}

mor_status mor_case_reader_out_of_plane(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                        const double *vector)
{
    const mor_case_node *node = mor_case_node_find(group, name);
    if (reader->dimension == 3 || node == NULL || (vector[0] == 0.0 && vector[1] == 0.0)) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(
        reader->context, node,
        "found %s with a component in the plane, which rotates out of it; allowed in plane strain: "
        "(0, 0, z); set x and y to zero",
        name);
}

mor_status mor_case_reader_refuse_duplicate(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                            const mor_case_place *first)
{
    const mor_case_node *node = mor_case_node_find(group, "name");
    return MOR_CASE_NODE_FAIL(reader->context, node == NULL ? group : node,
                              "found the name '%s' again; allowed: each name "
                              "once (it is taken by line %d); choose another",
                              name, first->line);
}
