/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_reader.h"

#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Shapes of the ground: terrain from a raster, releases on it, posts in it. */

/* Default thickness of ground, and the reach of exact distances, in spacings: twice the layers of wall particles. */
#define GROUND_SPACINGS 8.0

/* A domain that ends on the raster's edge may exceed it by this fraction of a cell. */
#define ON_EDGE 1e-9

/* Posts go this far below the lowest place of the ground under them, in spacings. */
#define POST_SPACINGS 2.0

/* Samples of the ground below the foot of a post along each side. */
enum { FOOT_PLACES = 9 };

static const mor_case_node *find_root(const mor_case_node *node)
{
    while (node->parent != NULL) {
        node = node->parent;
    }
    return node;
}

/* Reads the raster and multiplies it by the scale of the case. */
static mor_status read_raster(const mor_case_reader *reader, const mor_case_node *node, const mor_case_ground *ground,
                              mor_terrain *terrain)
{
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.path = ground->file;
    request.cell = ground->cell;
    request.fills_no_data = ground->fills_no_data;
    memcpy(request.crop_minimum, ground->crop_minimum, sizeof request.crop_minimum);
    memcpy(request.crop_maximum, ground->crop_maximum, sizeof request.crop_maximum);
    memcpy(request.offset, ground->offset, sizeof request.offset);
    const mor_status status = mor_terrain_read(reader->context, &request, terrain);
    if (status == MOR_ERROR_MEMORY) {
        return mor_context_pass(reader->context, status, MOR_HERE);
    }
    if (status != MOR_OK) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%.1500s", reader->context->message);
        return MOR_CASE_NODE_FAIL(reader->context, node, "found a terrain that cannot be read: %s", why);
    }
    const double scale = ldexp(1.0, reader->length_power);
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    for (int a = 0; a < 2; ++a) {
        terrain->origin[a] *= scale;
        terrain->cell[a] *= scale;
    }
    for (int64_t n = 0; n < n_nodes; ++n) {
        terrain->heights[n] *= scale;
    }
    return MOR_OK;
}

/* There must be ground over the whole domain: beyond the raster it is extended if the case says so. Beyond the edge of
 * the domain it continues by the thickness of a wall, as walls do, so that soil there is fully supported. */
static mor_status cover_domain(const mor_case_reader *reader, const mor_case_node *node, const mor_case_ground *ground,
                               mor_terrain *terrain)
{
    double low[2];
    double high[2];
    double from[2];
    double to[2];
    double beyond = 0.0;
    mor_terrain_reach(terrain, low, high);
    for (int a = 0; a < 2; ++a) {
        from[a] = reader->domain.minimum[a] - MOR_CASE_WALL_LAYERS * reader->spacing;
        to[a] = reader->domain.maximum[a] + MOR_CASE_WALL_LAYERS * reader->spacing;
        const double allowed = ON_EDGE * terrain->cell[a];
        const double gap = fmax(low[a] - reader->domain.minimum[a], reader->domain.maximum[a] - high[a]);
        beyond = gap > allowed ? fmax(beyond, gap) : beyond;
    }
    if (beyond > 0.0 && !ground->extends_edge) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found a domain that reaches up to %g m beyond the raster: the raster covers x from %g to %g m and y from "
            "%g "
            "to %g m, the domain x from %g to %g m and y from %g to %g m; allowed is a domain over the raster; make it "
            "smaller, read more of the raster, or extend the ground at the height of its edge: extend_edge = true",
            beyond, low[0], high[0], low[1], high[1], reader->domain.minimum[0], reader->domain.maximum[0],
            reader->domain.minimum[1], reader->domain.maximum[1]);
    }
    if (beyond > 0.0) {
        mor_context_log(reader->context, MOR_LOG_WARNING,
                        "%s: ends up to %g m inside the domain; beyond its edge the ground is extended at the "
                        "height of the edge, which is an assumption",
                        ground->file, beyond);
    }
    MOR_TRY(reader->context, mor_terrain_extend(reader->context, terrain, from, to));
    return MOR_OK;
}

static mor_status build_terrain(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                mor_shape **shape)
{
    mor_terrain terrain;
    mor_case_ground *ground = &outline->ground;
    MOR_TRY(reader->context, mor_case_reader_locate(reader, node, "a terrain", ground->file, &outline->file_hash));
    if (isnan(ground->thickness)) {
        ground->thickness = GROUND_SPACINGS * reader->spacing;
    }
    MOR_TRY(reader->context, read_raster(reader, node, ground, &terrain));
    outline->file_hash = terrain.hash; /* with the files beside it that give its position and units */
    mor_status status = cover_domain(reader, node, ground, &terrain);
    if (status == MOR_OK) {
        status = mor_shape_new_terrain(reader->context, &terrain, ground->thickness, GROUND_SPACINGS * reader->spacing,
                                       shape);
    }
    mor_terrain_clear(reader->context, &terrain);
    return status;
}

/* The shape of the wall that is named as ground. */
static mor_status find_ground(const mor_case_reader *reader, const mor_case_node *node, const char *wall,
                              const mor_case_node **found)
{
    const mor_case_node *walls = mor_case_node_find(find_root(node), "walls");
    const char *words[MOR_CASE_WALLS_MAX];
    int n_words = 0;
    const bool is_list = walls != NULL && walls->kind == MOR_CASE_NODE_LIST;
    for (const mor_case_node *k = is_list ? walls->first_child : NULL; k != NULL; k = k->next) {
        const bool is_group = k->kind == MOR_CASE_NODE_GROUP;
        const mor_case_node *name = is_group ? mor_case_node_find(k, "name") : NULL;
        const mor_case_node *shape = is_group ? mor_case_node_find(k, "shape") : NULL;
        const mor_case_node *type =
            shape != NULL && shape->kind == MOR_CASE_NODE_GROUP ? mor_case_node_find(shape, "type") : NULL;
        const bool is_terrain = name != NULL && name->kind == MOR_CASE_NODE_TEXT && type != NULL &&
                                type->kind == MOR_CASE_NODE_TEXT && strcmp(type->text, "terrain") == 0;
        if (is_terrain && strcmp(name->text, wall) == 0) {
            *found = shape;
            return MOR_OK;
        }
        if (is_terrain && n_words < MOR_CASE_WALLS_MAX) {
            words[n_words++] = name->text;
        }
    }
    const mor_case_node *place = mor_case_node_find(node, "ground");
    return n_words > 0
               ? mor_case_reader_refuse(reader, place, "wall of type terrain", words, n_words)
               : MOR_CASE_NODE_FAIL(reader->context, place,
                                    "found ground = \"%s\", but no wall has a shape of type \"terrain\"; allowed: the "
                                    "name of such a wall; add it to walls",
                                    wall);
}

/* The terrain of the ground, owned by the shape that comes with it. */
static mor_status open_ground(const mor_case_reader *reader, const mor_case_node *node,
                              mor_case_shape_reader read_shape, const mor_case_shape *outline, mor_shape **shape)
{
    const mor_case_node *ground = NULL;
    mor_case_shape copy = {0};
    *shape = NULL;
    MOR_TRY(reader->context, find_ground(reader, node, outline->ground.wall, &ground));
    /* Messages about the raster are logged once, when the wall itself is read. */
    const mor_log_sink sink = reader->context->log_sink;
    reader->context->log_sink = NULL;
    const mor_status status = read_shape(reader, ground, &copy, shape);
    reader->context->log_sink = sink;
    mor_case_shape_clear(reader->context, &copy);
    MOR_TRY(reader->context, status);
    return MOR_OK;
}

/* Lowest place of the surface under a post. */
static double find_lowest(const mor_terrain *terrain, const double *middle, const double *size)
{
    double lowest = INFINITY;
    for (int k = 0; k < FOOT_PLACES * FOOT_PLACES; ++k) {
        const double x = middle[0] + size[0] * (k % FOOT_PLACES / (FOOT_PLACES - 1.0) - 0.5);
        const double y = middle[1] + size[1] * ((double)(k / FOOT_PLACES) / (FOOT_PLACES - 1.0) - 0.5);
        lowest = fmin(lowest, mor_terrain_height(terrain, x, y));
    }
    return lowest;
}

static mor_status build_post(const mor_case_reader *reader, const mor_terrain *terrain, const mor_case_ground *ground,
                             const double *middle, mor_shape **shape)
{
    double corners[2][3];
    for (int a = 0; a < 2; ++a) {
        corners[0][a] = middle[a] - 0.5 * ground->size[a];
        corners[1][a] = middle[a] + 0.5 * ground->size[a];
    }
    const double surface = mor_terrain_height(terrain, middle[0], middle[1]);
    corners[0][2] = find_lowest(terrain, middle, ground->size) - POST_SPACINGS * reader->spacing;
    corners[1][2] = isnan(ground->top) ? surface + ground->height : ground->top;
    MOR_CHECK(reader->context, corners[1][2] > surface, MOR_ERROR_ARGUMENT,
              "the post at (%g, %g) m ends at %g m, below the ground at %g m", middle[0], middle[1], corners[1][2],
              surface);
    return mor_shape_new_box(reader->context, corners[0], corners[1], shape);
}

static mor_status build_posts(const mor_case_reader *reader, const mor_case_shape *outline, const mor_terrain *terrain,
                              mor_shape **shape)
{
    mor_shape **parts = NULL;
    MOR_TRY(reader->context, MOR_NEW(reader->context, &parts, outline->n_points, "posts"));
    mor_status status = MOR_OK;
    for (int k = 0; k < outline->n_points && status == MOR_OK; ++k) {
        status = mor_terrain_check_point(reader->context, terrain, "post", k, &outline->points[2 * k]);
        if (status == MOR_OK) {
            status = build_post(reader, terrain, &outline->ground, &outline->points[2 * k], &parts[k]);
        }
    }
    if (status == MOR_OK) {
        status = mor_shape_new_union(reader->context, parts, outline->n_points, shape);
    }
    for (int k = 0; k < outline->n_points; ++k) {
        mor_shape_free(reader->context, &parts[k]);
    }
    MOR_FREE(reader->context, &parts);
    return status;
}

static mor_status build_on_ground(const mor_case_reader *reader, const mor_case_node *node,
                                  mor_case_shape_reader read_shape, const mor_case_shape *outline, mor_shape **shape)
{
    const mor_case_ground *it = &outline->ground;
    if (outline->kind == MOR_CASE_SHAPE_POSTS && isnan(it->height) == isnan(it->top)) {
        return MOR_CASE_NODE_FAIL(reader->context, node, "found posts with %s; allowed: one of height and top; %s",
                                  isnan(it->top) ? "neither height nor top" : "both height and top",
                                  isnan(it->top) ? "add one" : "remove one");
    }
    mor_shape *ground = NULL;
    MOR_TRY(reader->context, open_ground(reader, node, read_shape, outline, &ground));
    const mor_terrain *terrain = mor_terrain_view(ground);
    const mor_status status =
        outline->kind == MOR_CASE_SHAPE_RELEASE
            ? mor_shape_new_release(reader->context, terrain, outline->points, outline->n_points, it->thickness,
                                    it->rim, GROUND_SPACINGS * reader->spacing, shape)
            : build_posts(reader, outline, terrain, shape);
    mor_shape_free(reader->context, &ground);
    return status;
}

mor_status mor_case_reader_ground(const mor_case_reader *reader, const mor_case_node *node,
                                  mor_case_shape_reader read_shape, mor_case_shape *outline, mor_shape **shape)
{
    *shape = NULL;
    if (reader->dimension == 2) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a shape of terrain in plane strain; allowed: with dimension = 3; give the "
                                  "profile as a polygon");
    }
    const mor_status status = outline->kind == MOR_CASE_SHAPE_TERRAIN
                                  ? build_terrain(reader, node, outline, shape)
                                  : build_on_ground(reader, node, read_shape, outline, shape);
    if (status != MOR_ERROR_ARGUMENT) {
        return status == MOR_OK ? MOR_OK : mor_context_pass(reader->context, status, MOR_HERE);
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found a shape of type %s that cannot be made: %s; correct its numbers",
                              mor_case_shape_groups[outline->kind].name, why);
}
