/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "bodies/body.h"
#include "cases/driver/case/log_owner.h"
#include "cases/driver/case/rock_list.h"
#include "cases/driver/case/sections/case_read.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/pack/pack.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Rocks packed into a region: each becomes a body that views one of a few forms of diameter 1. */

static const double check_spacings = 0.5; /* distance of the points at which two rocks are compared, in spacings */

static mor_status refuse_packing(const mor_case_reader *reader, const mor_case_node *node, mor_status status)
{
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    if (status != MOR_ERROR_ARGUMENT) {
        return mor_context_pass(reader->context, status, MOR_HERE);
    }
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found rocks that cannot be packed: %s", why);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static mor_status read_sizes(const mor_case_reader *reader, const mor_case_node *node, mor_case_rocks *rocks)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "sizes", MOR_CASE_NODE_LIST, &list));
    MOR_TRY(reader->context, mor_case_reader_list(reader, node, "sizes", MOR_CASE_ROCK_SIZES_MAX, &list));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        mor_case_size *size = &rocks->sizes[rocks->n_sizes++];
        MOR_TRY(reader->context, mor_case_reader_names(reader, child, &mor_case_size_group, NULL, NULL));
        MOR_TRY(reader->context, mor_case_reader_group(reader, child, &mor_case_size_group, size));
        if (rocks->n_sizes > 1 && (size->diameter <= size[-1].diameter || size->passing < size[-1].passing)) {
            return MOR_CASE_NODE_FAIL(
                reader->context, child,
                "found a point of the size distribution, %g m and %g, "
                "that does not lie above the one before, %g m and %g; allowed: rising diameters and shares; correct it",
                size->diameter, size->passing, size[-1].diameter, size[-1].passing);
        }
    }
    if (rocks->sizes[rocks->n_sizes - 1].passing != 1.0) {
        return MOR_CASE_NODE_FAIL(
            reader->context, list,
            "found a size distribution that ends with a share passing of %g; "
            "allowed: 1, because all rocks are smaller than the largest; correct it or add the largest size",
            rocks->sizes[rocks->n_sizes - 1].passing);
    }
    return MOR_OK;
}

static mor_status read_form_kind(const mor_case_reader *reader, const mor_case_node *node, int *kind)
{
    const mor_case_node *type = NULL;
    const char *words[MOR_CASE_ROCK_FORM_COUNT];
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "type", MOR_CASE_NODE_TEXT, &type));
    for (int k = 0; k < MOR_CASE_ROCK_FORM_COUNT; ++k) {
        words[k] = mor_case_rock_form_groups[k].name;
        if (strcmp(words[k], type->text) == 0) {
            *kind = k;
            return MOR_OK;
        }
    }
    return mor_case_reader_refuse(reader, type, "type of form", words, MOR_CASE_ROCK_FORM_COUNT);
}

/* Makes the shapes of a form, of diameter 1 m; the scale of the case is in the sizes of the rocks. */
static mor_status read_form(const mor_case_reader *reader, const mor_case_node *node, mor_case_rocks *rocks)
{
    mor_case_reader bare = *reader;
    mor_case_shape *outline = &rocks->forms[rocks->n_forms++];
    int kind = 0;
    bare.length_power = 0;
    bare.spacing = reader->spacing / rocks->sizes[rocks->n_sizes - 1].diameter;
    bare.spread = rocks->sizes[rocks->n_sizes - 1].diameter / rocks->sizes[0].diameter;
    MOR_TRY(reader->context, read_form_kind(reader, node, &kind));
    outline->kind = mor_case_rock_form_kinds[kind];
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_rock_form_groups[kind], "type", NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_rock_form_groups[kind], outline));
    outline->form.scale = outline->form.length = outline->form.volume = NAN;
    outline->form.diameter = 1.0;
    const uint64_t seed = outline->form.seed;
    const int n_variants = outline->kind == MOR_CASE_SHAPE_ROCK ? rocks->n_variants : 1;
    for (int k = 0; k < n_variants; ++k) {
        outline->form.seed = seed + (uint64_t)k;
        MOR_TRY(reader->context, mor_case_reader_form(&bare, node, outline, &rocks->shapes[rocks->n_shapes]));
        rocks->form_of[rocks->n_shapes++] = rocks->n_forms - 1;
    }
    outline->form.seed = seed;
    return MOR_OK;
}

static mor_status read_forms(const mor_case_reader *reader, const mor_case_node *node, mor_case_rocks *rocks)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "forms", MOR_CASE_NODE_LIST, &list));
    MOR_TRY(reader->context, mor_case_reader_list(reader, node, "forms", MOR_CASE_ROCK_FORMS_MAX, &list));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        MOR_TRY(reader->context, read_form(reader, child, rocks));
    }
    return MOR_OK;
}

/* What a list leaves no room for. */
static const char *const packing_names[] = {"region", "sizes", "gap", "margin", "seed"};

/* Exactly one of content, count and list. */
static mor_status check_amount(const mor_case_reader *reader, const mor_case_node *node, const mor_case_rocks *rocks)
{
    const int n_given = !isnan(rocks->content) + (rocks->count > 0) + (rocks->list[0] != '\0');
    if (n_given != 1) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found rocks with %s of content, count and list; allowed: one of content, a share of "
                                  "the region, count, a number of rocks from 1, and list, a table; %s",
                                  n_given == 0 ? "none" : "more than one",
                                  n_given == 0 ? "give one" : "remove the others");
    }
    for (size_t k = 0; k < sizeof packing_names / sizeof *packing_names && rocks->list[0] != '\0'; ++k) {
        const mor_case_node *child = mor_case_node_find(node, packing_names[k]);
        if (child != NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s', which has no effect with a list of rocks; allowed: list, forms, "
                                      "n_forms, material and the common keys of bodies; remove it",
                                      packing_names[k]);
        }
    }
    return MOR_OK;
}

static mor_status read_rocks(const mor_case_reader *reader, const mor_case_node *node, mor_case_rocks *rocks)
{
    const mor_case_node *region = NULL;
    mor_case_reader_place(node, &rocks->body.place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_rocks_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_rocks_group, rocks));
    MOR_TRY(reader->context, check_amount(reader, node, rocks));
    rocks->body.axis[2] = 1.0;
    rocks->body.removed_at = NAN; /* never */
    rocks->gap = isnan(rocks->gap) ? reader->spacing : rocks->gap;
    rocks->margin = isnan(rocks->margin) ? reader->spacing : rocks->margin;
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "velocity", rocks->body.velocity));
    MOR_TRY(reader->context, mor_case_reader_body_material(reader, node, &rocks->body));
    if (rocks->list[0] != '\0') {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "region", MOR_CASE_NODE_GROUP, &region));
    MOR_TRY(reader->context, mor_case_reader_shape(reader, region, &rocks->region_outline, &rocks->region));
    return read_sizes(reader, node, rocks);
}

/* ---- Packing ----------------------------------------------------------------------------------------------------- */

static mor_status place_view(mor_context *context, const mor_case_body *body, mor_shape **placed)
{
    mor_shape *view = NULL;
    double axis[3];
    double rotation[9];
    const double length = mor_vector_length(body->axis);
    for (int a = 0; a < 3; ++a) {
        axis[a] = body->axis[a] / length;
    }
    mor_matrix_rotation(axis, body->angle, rotation);
    MOR_TRY(context, mor_shape_new_view(context, body->shape, &view));
    const mor_status status = mor_shape_new_placed(context, rotation, body->position, &view, placed);
    mor_shape_free(context, &view);
    return status;
}

/* The bodies that are there already; NULL when there are none. */
static mor_status join_bodies(mor_context *context, const mor_case *the_case, mor_shape **obstacle)
{
    mor_shape **parts = NULL;
    mor_status status = MOR_OK;
    *obstacle = NULL;
    if (the_case->n_bodies == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &parts, the_case->n_bodies, "bodies that rocks avoid"));
    for (int k = 0; k < the_case->n_bodies && status == MOR_OK; ++k) {
        status = place_view(context, &the_case->bodies[k], &parts[k]);
    }
    if (status == MOR_OK) {
        status = mor_shape_new_union(context, parts, the_case->n_bodies, obstacle);
    }
    for (int k = 0; k < the_case->n_bodies; ++k) {
        mor_shape_free(context, &parts[k]);
    }
    MOR_FREE(context, &parts);
    return status;
}

static mor_status pack_rocks(const mor_case_reader *reader, const mor_case *the_case, const mor_case_rocks *rocks,
                             mor_pack_result *result)
{
    double diameters[MOR_CASE_ROCK_SIZES_MAX];
    double passing[MOR_CASE_ROCK_SIZES_MAX];
    mor_shape *obstacle = NULL;
    mor_pack_request request;
    for (int k = 0; k < rocks->n_sizes; ++k) {
        diameters[k] = rocks->sizes[k].diameter;
        passing[k] = rocks->sizes[k].passing;
    }
    MOR_TRY(reader->context, join_bodies(reader->context, the_case, &obstacle));
    mor_pack_request_init(&request);
    request.dimension = reader->dimension;
    request.region = rocks->region;
    request.forms = (const mor_shape *const *)rocks->shapes;
    request.n_forms = rocks->n_shapes;
    request.content = rocks->count > 0 ? 0.0 : rocks->content;
    request.count = rocks->count;
    request.diameters = diameters;
    request.passing = passing;
    request.n_sizes = rocks->n_sizes;
    request.gap = rocks->gap;
    request.margin = rocks->margin;
    request.obstacle = obstacle;
    request.resolution = check_spacings * reader->spacing;
    request.seed = rocks->seed;
    mor_log_owner owner;
    mor_log_owner_begin(&owner, reader->context, "%s:%d: rocks '%s'", rocks->body.place.file, rocks->body.place.line,
                        rocks->body.name);
    const mor_status status = mor_pack(reader->context, &request, result);
    mor_log_owner_end(&owner, reader->context);
    mor_shape_free(reader->context, &obstacle);
    return status;
}

static void note_result(const mor_pack_result *result, mor_case_rocks *rocks)
{
    rocks->n_rocks = result->n_rocks;
    rocks->n_given_up = result->n_given_up;
    rocks->content_reached = result->content;
    rocks->smallest_gap = result->smallest_gap;
    memcpy(rocks->passing_reached, result->passing, (size_t)rocks->n_sizes * sizeof *rocks->passing_reached);
}

static double find_volume(int dimension, double diameter)
{
    return dimension == 2 ? 0.25 * MOR_PI * diameter * diameter : MOR_PI / 6.0 * diameter * diameter * diameter;
}

/* An item without a single rock would silently be a case without rocks. */
static mor_status refuse_none(const mor_case_reader *reader, const mor_case_node *node, const mor_case_rocks *rocks)
{
    if (rocks->n_given_up > 0) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found rocks of which none fits into the region; allowed: rocks that lie "
                                  "%g m deep in it and %g m from listed bodies; enlarge the region, lower margin or "
                                  "gap, or use smaller rocks",
                                  rocks->margin, rocks->gap);
    }
    mor_shape_moments region;
    char most[64] = "";
    const int dimension = reader->dimension;
    const char *unit = dimension == 2 ? "m2" : "m3";
    const double largest = rocks->sizes[rocks->n_sizes - 1].diameter;
    const mor_status status = mor_shape_find_moments(reader->context, rocks->region, dimension, &region);
    if (status != MOR_OK) {
        return refuse_packing(reader, node, status);
    }
    if (rocks->n_sizes > 1) {
        snprintf(most, sizeof most, ", the largest %.4g %s", find_volume(dimension, largest), unit);
    }
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found rocks without volume: %.4g %% of the region is %.4g %s, and the smallest rock "
                              "has %.4g %s%s; allowed: a content of half of a rock at least; raise content, enlarge "
                              "the region, or use smaller rocks",
                              100.0 * rocks->content, rocks->content * region.volume, unit,
                              find_volume(dimension, rocks->sizes[0].diameter), unit, most);
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

static mor_status make_room(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case, int n_more)
{
    mor_case_body *bodies = NULL;
    const int n_bodies = the_case->n_bodies + n_more;
    if (n_bodies > MOR_CASE_BODIES_MAX) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %d rocks, %d bodies in all; allowed: %d bodies; use fewer or larger rocks",
                                  n_more, n_bodies, MOR_CASE_BODIES_MAX);
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, &bodies, n_bodies, "bodies of a case"));
    for (int k = 0; k < the_case->n_bodies; ++k) {
        bodies[k] = the_case->bodies[k];
    }
    MOR_FREE(reader->context, &the_case->bodies);
    the_case->bodies = bodies;
    return MOR_OK;
}

static mor_status add_body(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                           const mor_case_rocks *rocks, const mor_pack_rock *rock, int number)
{
    mor_case_body *body = &the_case->bodies[the_case->n_bodies];
    mor_shape *view = NULL;
    *body = rocks->body;
    snprintf(body->name, sizeof body->name, "%.*s_%d", MOR_CASE_NAME_BYTES / 2, rocks->body.name, number);
    body->outline.kind = rocks->forms[rocks->form_of[rock->form]].kind;
    memcpy(body->position, rock->position, sizeof body->position);
    memcpy(body->axis, rock->axis, sizeof body->axis);
    body->angle = rock->angle;
    body->packed_diameter = rock->diameter;
    the_case->n_bodies += 1;
    MOR_TRY(reader->context, mor_shape_new_view(reader->context, rocks->shapes[rock->form], &view));
    const mor_status status = mor_shape_new_scaled(reader->context, rock->diameter, &view, &body->shape);
    mor_shape_free(reader->context, &view);
    MOR_TRY(reader->context, status);
    return mor_case_reader_body_name(reader, node, the_case, body);
}

static mor_status add_bodies(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                             mor_case_rocks *rocks)
{
    mor_pack_result result;
    const mor_status packed = pack_rocks(reader, the_case, rocks, &result);
    if (packed != MOR_OK) {
        return refuse_packing(reader, node, packed);
    }
    note_result(&result, rocks);
    if (result.n_rocks == 0) {
        mor_pack_clear(reader->context, &result);
        return refuse_none(reader, node, rocks);
    }
    if (rocks->count > 0 && result.n_rocks != rocks->count) {
        mor_pack_clear(reader->context, &result);
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found space for %d of %d rocks; allowed: as many as fit %g m deep in the "
                                  "region and %g m from each other; enlarge the region, lower margin or gap, or "
                                  "use fewer or smaller rocks",
                                  rocks->n_rocks, rocks->count, rocks->margin, rocks->gap);
    }
    mor_status status = make_room(reader, node, the_case, result.n_rocks);
    for (int k = 0; k < result.n_rocks && status == MOR_OK; ++k) {
        status = add_body(reader, node, the_case, rocks, &result.rocks[k], k + 1);
    }
    mor_pack_clear(reader->context, &result);
    return status;
}

/* ---- Rocks of a table -------------------------------------------------------------------------------------------- */

/* Brings a row, in SI, to the scale of the case. */
static mor_status scale_row(const mor_case_reader *reader, mor_rock_row *row)
{
    MOR_TRY(reader->context, mor_case_reader_scale(reader, "m", row->position, 3, 1));
    MOR_TRY(reader->context, mor_case_reader_scale(reader, "m", &row->diameter, 1, 1));
    return mor_case_reader_scale(reader, "kg/m3", &row->density, 1, 1);
}

/* Rows in their order; each takes the next of the forms, and is not rotated. */
static mor_status add_rows(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                           mor_case_rocks *rocks, mor_rock_list *list)
{
    mor_case_size ends[2] = {{.diameter = INFINITY}, {.passing = 1.0}};
    for (int k = 0; k < list->n_rows; ++k) {
        MOR_TRY(reader->context, scale_row(reader, &list->rows[k]));
        ends[0].diameter = fmin(ends[0].diameter, list->rows[k].diameter);
        ends[1].diameter = fmax(ends[1].diameter, list->rows[k].diameter);
    }
    memcpy(rocks->sizes, ends, sizeof ends);
    rocks->n_sizes = 2; /* how fine the forms must be; the table has no curve of its own */
    const mor_status made = read_forms(reader, node, rocks);
    rocks->n_sizes = 0;
    MOR_TRY(reader->context, made);
    MOR_TRY(reader->context, make_room(reader, node, the_case, list->n_rows));
    for (int k = 0; k < list->n_rows; ++k) {
        const mor_rock_row *row = &list->rows[k];
        mor_pack_rock rock = {.form = k % rocks->n_shapes, .diameter = row->diameter, .axis = {0.0, 0.0, 1.0}};
        memcpy(rock.position, row->position, sizeof rock.position);
        MOR_TRY(reader->context, add_body(reader, node, the_case, rocks, &rock, k + 1));
        if (!isnan(row->density)) {
            the_case->bodies[the_case->n_bodies - 1].density = row->density;
        }
    }
    rocks->n_rocks = list->n_rows;
    return MOR_OK;
}

static mor_status add_list(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                           mor_case_rocks *rocks)
{
    mor_rock_list list;
    MOR_TRY(reader->context, mor_case_reader_locate(reader, node, "a list of rocks", rocks->list, &rocks->list_hash));
    MOR_TRY(reader->context, mor_rock_list_read(reader->context, reader->units, rocks->list, reader->dimension, &list));
    const mor_status status = add_rows(reader, node, the_case, rocks, &list);
    mor_rock_list_clear(reader->context, &list);
    return status;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

mor_status mor_case_reader_rocks(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "rocks", MOR_CASE_ROCKS_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        mor_case_rocks *rocks = &the_case->rocks[the_case->n_rocks++];
        MOR_TRY(reader->context, read_rocks(reader, node, rocks));
        MOR_TRY(reader->context, mor_case_reader_frictions(reader, node, the_case, &rocks->body.friction_with));
        if (rocks->list[0] != '\0') {
            MOR_TRY(reader->context, add_list(reader, node, the_case, rocks));
        } else {
            MOR_TRY(reader->context, read_forms(reader, node, rocks));
            MOR_TRY(reader->context, add_bodies(reader, node, the_case, rocks));
        }
    }
    return MOR_OK;
}
