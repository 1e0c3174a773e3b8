/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case_reader.h"

#include "core/material/params.h"

#include <stdio.h>
#include <string.h>

/* Soil regions and walls. */

/* In plane strain nothing moves out of the plane. */
static mor_status check_in_plane(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                 const double *vector)
{
    const mor_case_node *node = mor_case_node_find(group, name);
    if (reader->dimension == 3 || node == NULL || vector[2] == 0.0) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found %s with a component along z in plane strain; allowed: x and y; "
                              "set it to zero",
                              name);
}

static mor_status refuse_twin(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                              const mor_case_place *first)
{
    const mor_case_node *node = mor_case_node_find(group, "name");
    return MOR_CASE_NODE_FAIL(reader->context, node == NULL ? group : node,
                              "found the name '%s' again; allowed: each name "
                              "once (it is taken by line %d); choose another",
                              name, first->line);
}

/* ---- Soil -------------------------------------------------------------------------------------------------------- */

static mor_status read_model(const mor_case_reader *reader, const mor_case_node *node, const mor_material **model)
{
    const char *words[MOR_CASE_PARAMETERS_MAX];
    int n_words = 0;
    const mor_case_node *name = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "model", MOR_CASE_NODE_TEXT, &name));
    for (int k = 0; k < mor_registry_count(reader->registry); ++k) {
        const mor_material *listed = mor_registry_get(reader->registry, k);
        if (listed->form == MOR_MATERIAL_RATE && n_words < MOR_CASE_PARAMETERS_MAX) {
            words[n_words++] = listed->name;
        }
    }
    *model = mor_registry_find(reader->registry, name->text);
    if (*model == NULL || (*model)->form != MOR_MATERIAL_RATE) {
        return mor_case_reader_refuse(reader, name, "material model of a soil", words, n_words);
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
        char path[MOR_CASE_NODE_TEXT_BYTES];
        char allowed[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(node, path, sizeof path);
        mor_params_range(schema, allowed, sizeof allowed);
        return MOR_CASE_NODE_FAIL(reader->context, node, "found no '%s' in %s; allowed: %s (%s); add it", schema->key,
                                  path, allowed, schema->text);
    }
    for (int a = 0; a < schema->n_components; ++a) {
        values[a] = schema->kind == MOR_SCHEMA_CHOICE ? 0.0 : schema->default_value;
    }
    return mor_case_reader_scale(reader, schema->unit, values, schema->n_components, 1);
}

/* Relations between parameters are for the model to judge: it is asked to make an instance. */
static mor_status try_material(const mor_case_reader *reader, const mor_case_node *node, const mor_material *model,
                               const mor_case_soil *soil)
{
    mor_material_instance *instance = NULL;
    const mor_status status = mor_material_create(reader->context, model, soil->density, soil->parameters, &instance);
    mor_material_destroy(reader->context, &instance);
    if (status != MOR_ERROR_ARGUMENT) {
        return status;
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found parameters that '%s' refuses: %s; allowed: what its reference "
                              "says; correct them",
                              model->name, why);
}

static mor_status read_material(const mor_case_reader *reader, const mor_case_node *soil_node, mor_case_soil *soil)
{
    const mor_case_node *node = NULL;
    const mor_material *model = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, soil_node, "material", MOR_CASE_NODE_GROUP, &node));
    MOR_TRY(reader->context, read_model(reader, node, &model));
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_material_group, NULL, model->parameters));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_material_group, soil));
    double *values = soil->parameters;
    for (int k = 0; model->parameters[k].key != NULL; ++k) {
        const mor_schema *schema = &model->parameters[k];
        const mor_case_node *child = mor_case_node_find(node, schema->key);
        if (child == NULL) {
            MOR_TRY(reader->context, default_parameter(reader, node, schema, values));
        } else {
            MOR_TRY(reader->context, mor_case_reader_numbers(reader, child, schema, false, values));
            soil->written_parameters |= (uint64_t)1 << k;
        }
        values += schema->n_components;
    }
    return try_material(reader, node, model, soil);
}

/* What a kind of initial stress does not use is refused, so that nobody believes it had an effect. */
static mor_status check_stress_keys(const mor_case_reader *reader, const mor_case_node *node, mor_case_stress type)
{
    static const struct {
        const char *key;
        bool is_used[3]; /* by none, k0, settled */
    } uses[] = {{"lateral_ratio", {false, true, true}},
                {"surface_level", {false, true, true}},
                {"settle_time", {false, false, true}},
                {"settle_speed_ratio", {false, false, true}}};
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        const mor_case_node *child = mor_case_node_find(node, uses[k].key);
        if (child != NULL && !uses[k].is_used[type]) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect with this type of initial "
                                      "stress; allowed: with type = %s; remove it or change the type",
                                      uses[k].key,
                                      uses[k].is_used[MOR_CASE_STRESS_K0] ? "\"k0\" or \"settled\"" : "\"settled\"");
        }
    }
    return MOR_OK;
}

static mor_status read_stress(const mor_case_reader *reader, const mor_case_node *soil_node, double end,
                              mor_case_soil *soil)
{
    const mor_case_node *node = mor_case_node_find(soil_node, "initial_stress");
    if (node != NULL) {
        MOR_TRY(reader->context,
                mor_case_reader_member(reader, soil_node, "initial_stress", MOR_CASE_NODE_GROUP, &node));
        MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_stress_group, NULL, NULL));
    }
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_stress_group, soil));
    if (!mor_case_reader_has(&mor_case_stress_group, soil->written_stress, "settle_time")) {
        soil->settle_time = end;
    }
    return check_stress_keys(reader, node, soil->initial_stress);
}

static mor_status read_soil(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                            mor_case_soil *soil)
{
    const mor_case_node *shape = NULL;
    mor_case_reader_place(node, &soil->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_soil_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_soil_group, soil));
    MOR_TRY(reader->context, check_in_plane(reader, node, "velocity", soil->velocity));
    MOR_TRY(reader->context, read_material(reader, node, soil));
    MOR_TRY(reader->context, read_stress(reader, node, the_case->end, soil));
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &shape));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, shape, &soil->outline, &soil->shape));
    for (const mor_case_soil *other = the_case->soils; other < soil; ++other) {
        if (strcmp(other->name, soil->name) == 0) {
            return refuse_twin(reader, node, soil->name, &other->place);
        }
    }
    return MOR_OK;
}

/* ---- Walls ------------------------------------------------------------------------------------------------------- */

static mor_status check_friction(const mor_case_reader *reader, const mor_case_node *node, const mor_case_wall *wall)
{
    const mor_case_node *coefficient = mor_case_node_find(node, "friction_coefficient");
    const bool is_coulomb = wall->friction == MOR_CASE_FRICTION_COULOMB;
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

static mor_status read_wall(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                            mor_case_wall *wall)
{
    const mor_case_node *shape = NULL;
    mor_case_reader_place(node, &wall->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_wall_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_wall_group, wall));
    MOR_TRY(reader->context, check_in_plane(reader, node, "velocity", wall->velocity));
    MOR_TRY(reader->context, check_friction(reader, node, wall));
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &shape));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, shape, &wall->outline, &wall->shape));
    for (const mor_case_wall *other = the_case->walls; other < wall; ++other) {
        if (strcmp(other->name, wall->name) == 0) {
            return refuse_twin(reader, node, wall->name, &other->place);
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_scene(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, root, "soil", MOR_CASE_NODE_LIST, &list));
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "soil", MOR_CASE_SOILS_MAX, &list));
    for (const mor_case_node *node = list->first_child; node != NULL; node = node->next) {
        /* Counted before it is read, so that a half-read one is freed, too. */
        mor_case_soil *soil = &the_case->soils[the_case->n_soils++];
        MOR_TRY(reader->context, read_soil(reader, node, the_case, soil));
    }
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "walls", MOR_CASE_WALLS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        mor_case_wall *wall = &the_case->walls[the_case->n_walls++];
        MOR_TRY(reader->context, read_wall(reader, node, the_case, wall));
    }
    return MOR_OK;
}
