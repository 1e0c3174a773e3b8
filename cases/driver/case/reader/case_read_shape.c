/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_reader.h"

#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Shapes: first the outline as the file gives it, then the tree of shapes that computes distances. */

static const mor_schema corner_schema = {.key = "points",
                                         .kind = MOR_SCHEMA_VECTOR,
                                         .n_components = 2,
                                         .unit = "m",
                                         .minimum = -INFINITY,
                                         .maximum = INFINITY,
                                         .text = "one corner"};

/* ---- Outline ----------------------------------------------------------------------------------------------------- */

static mor_status read_kind(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape_kind *kind)
{
    if (node->kind != MOR_CASE_NODE_GROUP) {
        char found[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_format(node, found, sizeof found);
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a shape that is %s; allowed: { type = \"box\"; ... }; "
                                  "write it in that form",
                                  found);
    }
    const mor_case_node *type = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "type", MOR_CASE_NODE_TEXT, &type));
    const char *words[MOR_CASE_SHAPE_COUNT];
    for (int k = 0; k < MOR_CASE_SHAPE_COUNT; ++k) {
        words[k] = mor_case_shape_groups[k].name;
        if (strcmp(words[k], type->text) == 0) {
            *kind = (mor_case_shape_kind)k;
            return MOR_OK;
        }
    }
    return mor_case_reader_refuse(reader, type, "type of shape", words, MOR_CASE_SHAPE_COUNT);
}

/* Corners of a polygon or places of posts. */
static mor_status read_points(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline)
{
    const bool is_polygon = outline->kind != MOR_CASE_SHAPE_POSTS;
    const int n_least = is_polygon ? 3 : 1;
    const int n_most = is_polygon ? MOR_CASE_POLYGON_POINTS_MAX : MOR_CASE_SHAPE_PARTS_MAX;
    const mor_case_node *points = NULL;
    MOR_TRY(reader->context,
            mor_case_reader_member(reader, node, is_polygon ? "points" : "at", MOR_CASE_NODE_LIST, &points));
    if (points->n_children < n_least || points->n_children > n_most) {
        return MOR_CASE_NODE_FAIL(reader->context, points, "found %s of %d %s; allowed: %d to %d; correct the list",
                                  is_polygon ? "a polygon" : "a list", points->n_children,
                                  is_polygon ? "corners" : "posts", n_least, n_most);
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, &outline->points, 2 * (int64_t)points->n_children, "polygon"));
    for (const mor_case_node *corner = points->first_child; corner != NULL; corner = corner->next) {
        double *values = &outline->points[2 * outline->n_points];
        MOR_TRY(reader->context, mor_case_reader_numbers(reader, corner, &corner_schema, false, values));
        outline->n_points += 1;
    }
    return MOR_OK;
}

static mor_status append_parts(const mor_case_reader *reader, const mor_case_node *part, const mor_case_node **parts,
                               int *n_parts)
{
    const bool is_list = part->kind == MOR_CASE_NODE_LIST;
    if (is_list && (part->n_children == 0 || part->n_children > MOR_CASE_SHAPE_PARTS_MAX - 1)) {
        char path[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(part, path, sizeof path);
        return MOR_CASE_NODE_FAIL(reader->context, part, "found %s with %d shapes; allowed: 1 to %d; correct the list",
                                  path, part->n_children, MOR_CASE_SHAPE_PARTS_MAX - 1);
    }
    for (const mor_case_node *k = is_list ? part->first_child : part; k != NULL; k = is_list ? k->next : NULL) {
        parts[(*n_parts)++] = k;
    }
    return MOR_OK;
}

/* Finds the nodes of the shapes that this one is made of. Shape parts: at most MOR_CASE_SHAPE_PARTS_MAX. */
static mor_status collect_parts(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape_kind kind,
                                const mor_case_node **parts, int *n_parts)
{
    const mor_case_node *part = NULL;
    *n_parts = 0;
    if (kind == MOR_CASE_SHAPE_UNION) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, node, "parts", MOR_CASE_NODE_LIST, &part));
        return append_parts(reader, part, parts, n_parts);
    }
    if (kind == MOR_CASE_SHAPE_DIFFERENCE) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, node, "from", MOR_CASE_NODE_GROUP, &parts[0]));
        *n_parts = 1;
        part = mor_case_node_find(node, "minus");
        if (part == NULL || part->kind != MOR_CASE_NODE_LIST) {
            MOR_TRY(reader->context, mor_case_reader_member(reader, node, "minus", MOR_CASE_NODE_GROUP, &part));
        }
        return append_parts(reader, part, parts, n_parts);
    }
    if (kind == MOR_CASE_SHAPE_TRANSLATE || kind == MOR_CASE_SHAPE_ROTATE) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, node, "shape", MOR_CASE_NODE_GROUP, &parts[0]));
        *n_parts = 1;
    }
    return MOR_OK;
}

/* A box of two numbers per corner has no ends in z. */
static mor_status flatten_box(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline)
{
    const int n_min = mor_case_node_find(node, "min")->n_children;
    const int n_max = mor_case_node_find(node, "max")->n_children;
    if (n_min != n_max) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found min with %d and max with %d numbers; allowed: as many in "
                                  "both; add or remove z",
                                  n_min, n_max);
    }
    outline->is_flat = n_min == 2;
    if (outline->is_flat) {
        outline->first[2] = -INFINITY;
        outline->second[2] = INFINITY;
    }
    return MOR_OK;
}

/* In plane strain a shape is its cut with the plane z = 0. A ball beside the plane would be cut to a smaller disc, and
 * the distance from an oblique face would be too large. */
static mor_status check_shape_plane(const mor_case_reader *reader, const mor_case_node *node,
                                    const mor_case_shape *outline)
{
    const bool is_along_z = outline->second[0] == 0.0 && outline->second[1] == 0.0;
    switch (outline->kind) {
    case MOR_CASE_SHAPE_SPHERE:
    case MOR_CASE_SHAPE_ELLIPSOID:
        return mor_case_reader_in_plane(reader, node, "center", outline->first);
    case MOR_CASE_SHAPE_HALF_SPACE:
        return mor_case_reader_in_plane(reader, node, "normal", outline->second);
    case MOR_CASE_SHAPE_TRANSLATE:
        return mor_case_reader_in_plane(reader, node, "translation", outline->first);
    case MOR_CASE_SHAPE_ROTATE:
        return mor_case_reader_out_of_plane(reader, node, "axis", outline->second);
    case MOR_CASE_SHAPE_CYLINDER:
        if (is_along_z) {
            return MOR_OK; /* a disc */
        }
        MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "axis", outline->second));
        return mor_case_reader_in_plane(reader, node, "base", outline->first);
    case MOR_CASE_SHAPE_CONE:
        MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "axis", outline->second));
        return mor_case_reader_in_plane(reader, node, "base", outline->first);
    default:
        return MOR_OK;
    }
}

static mor_status read_own_keys(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline)
{
    const mor_case_group *group = &mor_case_shape_groups[outline->kind];
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, group, "type", NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, group, outline));
    if (outline->kind == MOR_CASE_SHAPE_ROTATE && !mor_case_reader_has(group, outline->written, "axis")) {
        memcpy(outline->second, (double[]){0.0, 0.0, 1.0}, sizeof outline->second);
    }
    MOR_TRY(reader->context, check_shape_plane(reader, node, outline));
    if (outline->kind == MOR_CASE_SHAPE_BOX) {
        return flatten_box(reader, node, outline);
    }
    if (outline->kind == MOR_CASE_SHAPE_ELLIPSOID && reader->dimension == 2) {
        outline->second[2] = fmax(outline->second[0], outline->second[1]);
    }
    const bool has_points = outline->kind == MOR_CASE_SHAPE_POLYGON || outline->kind == MOR_CASE_SHAPE_RELEASE ||
                            outline->kind == MOR_CASE_SHAPE_POSTS;
    return has_points ? read_points(reader, node, outline) : MOR_OK;
}

/* ---- From the outline to the shape ------------------------------------------------------------------------------- */

static mor_status join_difference(mor_context *context, mor_shape **parts, int n_parts, mor_shape **shape)
{
    mor_shape *minus = NULL;
    MOR_TRY(context, mor_shape_new_union(context, parts + 1, n_parts - 1, &minus));
    const mor_status status = mor_shape_new_difference(context, &parts[0], &minus, shape);
    mor_shape_free(context, &minus);
    return status;
}

/* parts: shape [outline->n_children]; what is taken becomes NULL. */
static mor_status construct(mor_context *context, const mor_case_shape *outline, mor_shape **parts, mor_shape **shape)
{
    switch (outline->kind) {
    case MOR_CASE_SHAPE_BOX:
        return mor_shape_new_box(context, outline->first, outline->second, shape);
    case MOR_CASE_SHAPE_CYLINDER:
        return mor_shape_new_cylinder(context, outline->first, outline->second, outline->radius, outline->height,
                                      shape);
    case MOR_CASE_SHAPE_CONE:
        return mor_shape_new_cone(context, outline->first, outline->second, outline->radius, outline->height, shape);
    case MOR_CASE_SHAPE_SPHERE:
        return mor_shape_new_sphere(context, outline->first, outline->radius, shape);
    case MOR_CASE_SHAPE_ELLIPSOID:
        return mor_shape_new_ellipsoid(context, outline->first, outline->second, shape);
    case MOR_CASE_SHAPE_HALF_SPACE:
        return mor_shape_new_half_space(context, outline->first, outline->second, shape);
    case MOR_CASE_SHAPE_POLYGON:
        return mor_shape_new_polygon(context, outline->points, outline->n_points, shape);
    case MOR_CASE_SHAPE_UNION:
        return mor_shape_new_union(context, parts, outline->n_children, shape);
    case MOR_CASE_SHAPE_DIFFERENCE:
        return join_difference(context, parts, outline->n_children, shape);
    case MOR_CASE_SHAPE_TRANSLATE:
        return mor_shape_new_translate(context, outline->first, &parts[0], shape);
    case MOR_CASE_SHAPE_ROTATE:
        return mor_shape_new_rotate(context, outline->second, outline->angle, outline->first, &parts[0], shape);
    case MOR_CASE_SHAPE_TERRAIN:
    case MOR_CASE_SHAPE_RELEASE:
    case MOR_CASE_SHAPE_POSTS: /* read with their raster, not from parts */
    case MOR_CASE_SHAPE_MESH:
    case MOR_CASE_SHAPE_OUTLINE:
    case MOR_CASE_SHAPE_ROCK: /* read or drawn */
    case MOR_CASE_SHAPE_COUNT:
        break;
    }
    return MOR_FAIL(context, MOR_ERROR_INTERNAL, "shape kind %d is not known", (int)outline->kind);
}

static mor_status report_refusal(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape_kind kind,
                                 mor_status status)
{
    if (status != MOR_ERROR_ARGUMENT) {
        return mor_context_pass(reader->context, status, MOR_HERE);
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found a %s that cannot be made: %s; allowed: a shape with an inside; "
                              "correct its numbers",
                              mor_case_shape_groups[kind].name, why);
}

/* Reads the children and builds this shape from them. parts has room for all children. */
static mor_status build_from_parts(const mor_case_reader *reader, const mor_case_node *node,
                                   const mor_case_node *const *nodes, mor_case_shape *outline, mor_shape **parts,
                                   mor_shape **shape)
{
    for (int k = 0; k < outline->n_children; ++k) {
        MOR_TRY(reader->context, mor_case_reader_shape(reader, nodes[k], &outline->children[k], &parts[k]));
    }
    if (outline->kind == MOR_CASE_SHAPE_TERRAIN || outline->kind == MOR_CASE_SHAPE_RELEASE ||
        outline->kind == MOR_CASE_SHAPE_POSTS) {
        MOR_TRY(reader->context, mor_case_reader_ground(reader, node, mor_case_reader_shape, outline, shape));
        return MOR_OK;
    }
    if (outline->kind == MOR_CASE_SHAPE_MESH || outline->kind == MOR_CASE_SHAPE_OUTLINE ||
        outline->kind == MOR_CASE_SHAPE_ROCK) {
        MOR_TRY(reader->context, mor_case_reader_form(reader, node, outline, shape));
        return MOR_OK;
    }
    const mor_status status = construct(reader->context, outline, parts, shape);
    return status == MOR_OK ? MOR_OK : report_refusal(reader, node, outline->kind, status);
}

mor_status mor_case_reader_shape(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                 mor_shape **shape)
{
    const mor_case_node *nodes[MOR_CASE_SHAPE_PARTS_MAX];
    mor_shape **parts = NULL;
    int n_parts = 0;
    *shape = NULL;
    MOR_TRY(reader->context, read_kind(reader, node, &outline->kind));
    MOR_TRY(reader->context, read_own_keys(reader, node, outline));
    MOR_TRY(reader->context, collect_parts(reader, node, outline->kind, nodes, &n_parts));
    MOR_TRY(reader->context, MOR_NEW(reader->context, &outline->children, n_parts, "parts of a shape"));
    outline->n_children = n_parts;
    MOR_TRY(reader->context, MOR_NEW(reader->context, &parts, n_parts, "parts of a shape"));
    const mor_status status = build_from_parts(reader, node, nodes, outline, parts, shape);
    for (int k = 0; k < n_parts; ++k) {
        mor_shape_free(reader->context, &parts[k]);
    }
    MOR_FREE(reader->context, &parts);
    return status;
}
