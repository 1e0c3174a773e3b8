/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/params.h"

#include <math.h>
#include <string.h>

/* Bodies, and the contact among them and with walls. */

/* Directions whose cosine is beyond this are not meant to be at right angles. */
static const double right_angle_cosine = 1.0e-6;

/* ---- Parts of a body --------------------------------------------------------------------------------------------- */

/* Keys that this body does not use are refused, because they would have no effect. */
static mor_status check_conditions(const mor_case_reader *reader, const mor_case_node *node, const mor_case_body *body)
{
    for (const mor_case_node *child = node->first_child; child != NULL; child = child->next) {
        const char *condition = mor_case_body_condition(body, child->name);
        if (condition != NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect on the body '%s'; allowed: %s; remove it or "
                                      "change the type of the body",
                                      child->name, body->name, condition);
        }
    }
    return MOR_OK;
}

static mor_status read_material(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body)
{
    const mor_case_material_slot slot = {.group = &mor_case_body_material_group,
                                         .record = body,
                                         .form = MOR_MATERIAL_TOTAL,
                                         .bare_words = mor_case_rigid_words,
                                         .density = &body->density,
                                         .parameters = body->parameters,
                                         .written = &body->written_parameters,
                                         .what = "material model of a body"};
    return mor_case_reader_material(reader, node, &slot);
}

/* In plane strain the plane's own motion is all there is: x, y, rz. */
static bool is_lock_allowed(int dimension, int lock)
{
    return dimension == 3 || lock == 0 || lock == 1 || lock == MOR_CASE_LOCKS - 1;
}

static mor_status read_lock(const mor_case_reader *reader, const mor_case_node *node, bool *is_locked)
{
    const char *words[MOR_CASE_LOCKS];
    int n_words = 0;
    for (int k = 0; k < MOR_CASE_LOCKS; ++k) {
        if (!is_lock_allowed(reader->dimension, k)) {
            continue;
        }
        words[n_words++] = mor_case_lock_words[k];
        if (node->kind == MOR_CASE_NODE_TEXT && strcmp(node->text, mor_case_lock_words[k]) == 0) {
            is_locked[k] = true;
            return MOR_OK;
        }
    }
    return mor_case_reader_refuse(reader, node, "translation along an axis, or rotation about it, that is locked",
                                  words, n_words);
}

static mor_status read_locks(const mor_case_reader *reader, const mor_case_node *body_node, mor_case_body *body)
{
    const mor_case_node *list = mor_case_node_find(body_node, "locked");
    if (list == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, body_node, "locked", MOR_CASE_NODE_LIST, &list));
    for (const mor_case_node *node = list->first_child; node != NULL; node = node->next) {
        MOR_TRY(reader->context, read_lock(reader, node, body->is_locked));
    }
    return MOR_OK;
}

static mor_status read_spring(const mor_case_reader *reader, const mor_case_node *body_node, mor_case_body *body)
{
    const mor_case_node *node = mor_case_node_find(body_node, "spring");
    body->has_spring = node != NULL;
    if (!body->has_spring) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, body_node, "spring", MOR_CASE_NODE_GROUP, &node));
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_spring_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_spring_group, body));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "point", body->spring_point));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "anchor", body->spring_anchor));
    if (body->spring_stiffness == 0.0 && body->spring_damping == 0.0) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a spring of stiffness 0 and damping 0, which has no effect; allowed: one of "
                                  "them above 0; correct it or remove the spring");
    }
    return MOR_OK;
}

static mor_status check_clamp(const mor_case_reader *reader, const mor_case_node *body_node, mor_case_body *body)
{
    const mor_case_node *node = mor_case_node_find(body_node, "clamp");
    return node == NULL ? MOR_OK : mor_case_reader_shape(reader, node, &body->clamp_outline, &body->clamp);
}

/* ---- Velocity at the start --------------------------------------------------------------------------------------- */

static mor_status check_start_keys(const mor_case_reader *reader, const mor_case_node *node, const mor_case_body *body)
{
    static const char *const needed[] = {"axis", "direction", "length", "speed", "rate"};
    for (const mor_case_node *child = node->first_child; child != NULL; child = child->next) {
        const char *condition = mor_case_start_condition(body->motion, child->name);
        if (condition != NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect with this type of start; allowed: %s; remove it "
                                      "or change the type",
                                      child->name, condition);
        }
    }
    for (size_t k = 0; k < sizeof needed / sizeof needed[0]; ++k) {
        const bool is_used = mor_case_start_condition(body->motion, needed[k]) == NULL;
        if (is_used && mor_case_node_find(node, needed[k]) == NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found no '%s' in this type of start; allowed: with type = \"uniform\" only; "
                                      "add it",
                                      needed[k]);
        }
    }
    return MOR_OK;
}

static double find_cosine(const double *a, const double *b)
{
    double unit_a[3];
    double unit_b[3];
    const double largest_a = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    const double largest_b = fmax(fabs(b[0]), fmax(fabs(b[1]), fabs(b[2])));
    for (int k = 0; k < 3; ++k) {
        unit_a[k] = a[k] / largest_a; /* so that squares neither vanish nor overflow */
        unit_b[k] = b[k] / largest_b;
    }
    return mor_vector_dot(unit_a, unit_b) / (mor_vector_length(unit_a) * mor_vector_length(unit_b));
}

static mor_status check_start_plane(const mor_case_reader *reader, const mor_case_node *node, const mor_case_body *body)
{
    if (reader->dimension == 2 && body->motion == MOR_CASE_MOTION_TWIST) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "type"),
                                  "found a twist in plane strain, which leaves the plane; allowed: \"uniform\" and "
                                  "\"cantilever\"; change the type");
    }
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "axis", body->motion_axis));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "direction", body->motion_direction));
    return mor_case_reader_in_plane(reader, node, "origin", body->motion_origin);
}

static mor_status read_start(const mor_case_reader *reader, const mor_case_node *body_node, mor_case_body *body)
{
    const mor_case_node *node = mor_case_node_find(body_node, "start");
    if (node != NULL) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, body_node, "start", MOR_CASE_NODE_GROUP, &node));
        MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_start_group, NULL, NULL));
    }
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_start_group, body));
    if (node == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, check_start_keys(reader, node, body));
    MOR_TRY(reader->context, check_start_plane(reader, node, body));
    if (body->motion == MOR_CASE_MOTION_CANTILEVER &&
        fabs(find_cosine(body->motion_axis, body->motion_direction)) > right_angle_cosine) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "direction"),
                                  "found a direction of bending that is not at right angles to axis; allowed: across "
                                  "the bar; correct it");
    }
    return MOR_OK;
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

static mor_status check_plane(const mor_case_reader *reader, const mor_case_node *node, const mor_case_body *body)
{
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "position", body->position));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "velocity", body->velocity));
    MOR_TRY(reader->context, mor_case_reader_out_of_plane(reader, node, "axis", body->axis));
    return mor_case_reader_out_of_plane(reader, node, "angular_velocity", body->angular_velocity);
}

/* A body has mass, so its shape must be bounded in every direction of the case. */
static mor_status check_shape(const mor_case_reader *reader, const mor_case_node *shape, const mor_case_body *body)
{
    mor_bounds bounds;
    mor_shape_bounds(body->shape, &bounds);
    for (int a = 0; a < reader->dimension; ++a) {
        if (!isfinite(bounds.minimum[a]) || !isfinite(bounds.maximum[a])) {
            return MOR_CASE_NODE_FAIL(reader->context, shape,
                                      "found a body whose shape is unbounded along %c; allowed: a bounded "
                                      "shape; close it, or make it a wall",
                                      "xyz"[a]);
        }
    }
    return MOR_OK;
}

/* An elastic body is as stiff in contact as it is inside; what is chosen for a rigid one depends on the whole case. */
static mor_status complete_modulus(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body)
{
    if (!isnan(body->contact_modulus) || mor_case_body_is_rigid(body)) {
        return MOR_OK;
    }
    const mor_schema *schemas = mor_registry_find(reader->registry, body->model)->parameters;
    body->contact_modulus = mor_params_youngs_modulus(schemas, body->parameters, NAN);
    if (isnan(body->contact_modulus)) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found no 'contact_modulus' for the model '%s', whose parameters have no Young's modulus as "
            "its default; allowed: > 0 Pa; add it",
            body->model);
    }
    return MOR_OK;
}

mor_status mor_case_reader_body_name(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                     const mor_case_body *body)
{
    for (int k = 0; k < the_case->n_walls; ++k) {
        if (strcmp(the_case->walls[k].name, body->name) == 0) {
            return mor_case_reader_refuse_duplicate(reader, node, body->name, &the_case->walls[k].place);
        }
    }
    for (const mor_case_body *other = the_case->bodies; other < body; ++other) {
        if (strcmp(other->name, body->name) == 0) {
            return mor_case_reader_refuse_duplicate(reader, node, body->name, &other->place);
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_body_material(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body)
{
    MOR_TRY(reader->context, read_material(reader, node, body));
    MOR_TRY(reader->context, check_conditions(reader, node, body));
    MOR_TRY(reader->context, mor_case_reader_friction(reader, node, body->soil_friction));
    return complete_modulus(reader, node, body);
}

mor_status mor_case_reader_body(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body)
{
    const mor_case_node *shape = NULL;
    mor_case_reader_place(node, &body->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_body_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_body_group, body));
    if (!mor_case_reader_has(&mor_case_body_group, body->written, "axis")) {
        memcpy(body->axis, (double[]){0.0, 0.0, 1.0}, sizeof body->axis);
    }
    MOR_TRY(reader->context, mor_case_reader_body_material(reader, node, body));
    MOR_TRY(reader->context, check_plane(reader, node, body));
    MOR_TRY(reader->context, read_locks(reader, node, body));
    MOR_TRY(reader->context, read_spring(reader, node, body));
    MOR_TRY(reader->context, read_start(reader, node, body));
    MOR_TRY(reader->context, mor_case_reader_path(reader, node, &body->path));
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &shape));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, shape, &body->outline, &body->shape));
    MOR_TRY(reader->context, check_shape(reader, shape, body));
    return check_clamp(reader, node, body);
}
