/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"

#include <stdio.h>
#include <string.h>

/* Soil regions and walls. */

/* ---- Soil -------------------------------------------------------------------------------------------------------- */

static mor_status read_material(const mor_case_reader *reader, const mor_case_node *node, mor_case_soil *soil)
{
    const mor_case_material_slot slot = {.group = &mor_case_material_group,
                                         .record = soil,
                                         .form = MOR_MATERIAL_RATE,
                                         .density = &soil->density,
                                         .parameters = soil->parameters,
                                         .written = &soil->written_parameters,
                                         .law = &soil->law,
                                         .external = &soil->external,
                                         .outer_group = &mor_case_external_group,
                                         .what = "material model of a soil"};
    return mor_case_reader_material(reader, node, &slot);
}

/* Keys that a type of initial stress does not use are refused, because they would have no effect. */
static mor_status check_stress_keys(const mor_case_reader *reader, const mor_case_node *node, mor_case_stress type)
{
    static const struct {
        const char *key;
        const char *types;
        bool is_used[5]; /* by none, k0, settled, uniform, formula */
    } uses[] = {{"lateral_ratio", "\"k0\" or \"settled\"", {false, true, true, false}},
                {"surface_level", "\"k0\" or \"settled\"", {false, true, true, false}},
                {"settle_time", "\"settled\"", {false, false, true, false}},
                {"settle_speed_ratio", "\"settled\"", {false, false, true, false}},
                {"settle_method", "\"settled\"", {false, false, true, false}},
                {"settle_from", "\"settled\"", {false, false, true, false}},
                {"settle_force_ratio", "\"settled\"", {false, false, true, false}},
                {"pressure", "\"uniform\"", {false, false, false, true}},
                {"formula", "\"formula\"", {false, false, false, false, true}}};
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        const mor_case_node *child = mor_case_node_find(node, uses[k].key);
        if (child != NULL && !uses[k].is_used[type]) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect with this type of initial "
                                      "stress; allowed: with type = %s; remove it or change the type",
                                      uses[k].key, uses[k].types);
        }
    }
    return MOR_OK;
}

/* Keys that the chosen way of settling does not use are refused likewise. */
static mor_status check_settle_keys(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *soil)
{
    const bool is_relaxed = soil->settle_method == MOR_CASE_SETTLE_RELAXATION;
    const struct {
        const char *key, *condition;
        bool is_used;
    } uses[] = {{"settle_speed_ratio", "settle_method = \"damping\"", !is_relaxed},
                {"settle_force_ratio", "settle_method = \"relaxation\"", is_relaxed},
                {"lateral_ratio", "settle_from = \"k0\"", soil->settle_from == 0},
                {"surface_level", "settle_from = \"k0\"", soil->settle_from == 0}};
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        const mor_case_node *child = mor_case_node_find(node, uses[k].key);
        if (soil->initial_stress == MOR_CASE_STRESS_SETTLED && child != NULL && !uses[k].is_used) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect with this way of settling; allowed: with %s; "
                                      "remove it or change the way",
                                      uses[k].key, uses[k].condition);
        }
    }
    return MOR_OK;
}

static mor_status check_stress_pressure(const mor_case_reader *reader, const mor_case_node *node,
                                        const mor_case_soil *soil)
{
    if (soil->initial_stress != MOR_CASE_STRESS_UNIFORM || mor_case_node_find(node, "pressure") != NULL) {
        return MOR_OK;
    }
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found no 'pressure' in an initial stress of type \"uniform\"; allowed: >= 0 Pa; add it, "
                              "or use \"none\" for soil without stress");
}

/* Without weight there is no geostatic stress, and no load to settle under. */
static mor_status check_stress_weight(const mor_case_reader *reader, const mor_case_node *node,
                                      const mor_case *the_case, const mor_case_soil *soil)
{
    if (soil->initial_stress == MOR_CASE_STRESS_NONE || soil->initial_stress == MOR_CASE_STRESS_UNIFORM ||
        soil->initial_stress == MOR_CASE_STRESS_FORMULA || mor_vector_length(the_case->gravity) > 0.0) {
        return MOR_OK;
    }
    const mor_case_node *type = mor_case_node_find(node, "type");
    return MOR_CASE_NODE_FAIL(reader->context, type,
                              "found an initial stress of type \"%s\" in a case without gravity, where it would be "
                              "zero; allowed: with gravity, or \"none\"; correct 'gravity' or the type",
                              type->text);
}

static mor_status read_stress_formula(const mor_case_reader *reader, const mor_case_node *node, mor_case_soil *soil)
{
    static const char what[] = "xx, yy, zz, xy and in three dimensions yz, zx";
    if (soil->initial_stress != MOR_CASE_STRESS_FORMULA) {
        return MOR_OK;
    }
    if (mor_case_node_find(node, "formula") == NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found no 'formula' in an initial stress of type \"formula\"; allowed: formulas of "
                                  "the components %s; add it",
                                  what);
    }
    return mor_case_reader_formulas(reader, node, "formula", what, reader->dimension == 2 ? 4 : 6,
                                    soil->stress_formula);
}

/* Initial velocity as a constant, or as formulas of the place. */
static mor_status read_velocity(const mor_case_reader *reader, const mor_case_node *node, mor_case_soil *soil)
{
    const mor_case_node *formula = mor_case_node_find(node, "velocity_formula");
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "velocity", soil->velocity));
    if (soil->released > 0.0 && (formula != NULL || mor_vector_length(soil->velocity) > 0.0)) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "released"),
                                  "found 'released' = %g s and a velocity of the soil '%s', which stands until then; "
                                  "allowed: one of the two; remove the other",
                                  soil->released, soil->name);
    }
    if (formula == NULL) {
        return MOR_OK;
    }
    if (mor_case_node_find(node, "velocity") != NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, formula,
                                  "found both 'velocity' and 'velocity_formula' of the soil '%s'; allowed: one of "
                                  "them; remove the other",
                                  soil->name);
    }
    return mor_case_reader_formulas(reader, node, "velocity_formula", "the components of the velocity",
                                    reader->dimension, soil->velocity_formula);
}

static mor_status read_stress(const mor_case_reader *reader, const mor_case_node *soil_node, const mor_case *the_case,
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
        soil->settle_time = the_case->end;
    }
    if (soil->settle_method == MOR_CASE_SETTLE_AUTO) {
        const bool can_rest = the_case->numerics.stress_diffusion_limiter == 2;
        const bool has_speed = mor_case_node_find(node, "settle_speed_ratio") != NULL;
        soil->settle_method = can_rest && !has_speed ? MOR_CASE_SETTLE_RELAXATION : MOR_CASE_SETTLE_DAMPING;
    }
    MOR_TRY(reader->context, check_stress_keys(reader, node, soil->initial_stress));
    MOR_TRY(reader->context, check_settle_keys(reader, node, soil));
    MOR_TRY(reader->context, check_stress_pressure(reader, node, soil));
    MOR_TRY(reader->context, read_stress_formula(reader, node, soil));
    return check_stress_weight(reader, node, the_case, soil);
}

static mor_status read_soil(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                            mor_case_soil *soil)
{
    const mor_case_node *shape = NULL;
    mor_case_reader_place(node, &soil->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_soil_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_soil_group, soil));
    MOR_TRY(reader->context, read_velocity(reader, node, soil));
    MOR_TRY(reader->context, read_material(reader, node, soil));
    MOR_TRY(reader->context, mor_case_reader_fields(reader, node, soil));
    MOR_TRY(reader->context, read_stress(reader, node, the_case, soil));
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &shape));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, shape, &soil->outline, &soil->shape));
    for (const mor_case_soil *other = the_case->soils; other < soil; ++other) {
        if (strcmp(other->name, soil->name) == 0) {
            return mor_case_reader_refuse_duplicate(reader, node, soil->name, &other->place);
        }
    }
    return MOR_OK;
}

/* ---- Walls ------------------------------------------------------------------------------------------------------- */

static bool has_terrain(const mor_case_shape *outline)
{
    bool has = outline->kind == MOR_CASE_SHAPE_TERRAIN;
    for (int k = 0; k < outline->n_children && !has; ++k) {
        has = has_terrain(&outline->children[k]);
    }
    return has;
}

/* Only the ground itself is followed by its particles and lies where the domain was compared with it. */
static mor_status check_ground(const mor_case_reader *reader, const mor_case_node *node, const mor_case_wall *wall)
{
    const bool is_ground = wall->outline.kind == MOR_CASE_SHAPE_TERRAIN;
    if (!is_ground && has_terrain(&wall->outline)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a wall with a terrain inside a shape of type '%s'; allowed is a terrain "
                                  "alone; translate it with 'offset', rotate the scene with 'placement', and list "
                                  "structures on it as separate walls",
                                  mor_case_shape_groups[wall->outline.kind].name);
    }
    if (is_ground && (mor_vector_length(wall->velocity) > 0.0 || wall->path.n_rows > 0)) {
        const char *name = wall->path.n_rows > 0 ? "path" : "velocity";
        return MOR_CASE_NODE_FAIL(
            reader->context, mor_case_node_find(node, name),
            "found a terrain that moves; allowed is terrain at rest, whose edge stays outside the "
            "domain; remove '%s', or give the soil the opposite velocity",
            name);
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
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "velocity", wall->velocity));
    MOR_TRY(reader->context, mor_case_reader_friction(reader, node, wall->friction));
    MOR_TRY(reader->context, mor_case_reader_frictions(reader, node, the_case, &wall->friction_with));
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &shape));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, shape, &wall->outline, &wall->shape));
    MOR_TRY(reader->context, mor_case_reader_path(reader, node, &wall->path));
    MOR_TRY(reader->context, check_ground(reader, node, wall));
    for (const mor_case_wall *other = the_case->walls; other < wall; ++other) {
        if (strcmp(other->name, wall->name) == 0) {
            return mor_case_reader_refuse_duplicate(reader, node, wall->name, &other->place);
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_scene(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    if (mor_case_node_find(root, "soil") == NULL && mor_case_node_find(root, "bodies") == NULL &&
        mor_case_node_find(root, "rocks") == NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, root,
                                  "found neither 'soil' nor 'bodies' in the file; allowed: at least one soil region or "
                                  "one body; add soil = ( { ... } ) or bodies = ( { ... } )");
    }
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "soil", MOR_CASE_SOILS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        /* Counted before it is read, so that a half-read one is freed, too. */
        mor_case_soil *soil = &the_case->soils[the_case->n_soils++];
        MOR_TRY(reader->context, read_soil(reader, node, the_case, soil));
    }
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "walls", MOR_CASE_WALLS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        mor_case_wall *wall = &the_case->walls[the_case->n_walls++];
        MOR_TRY(reader->context, read_wall(reader, node, the_case, wall));
    }
    return mor_case_reader_bodies(reader, root, the_case);
}
