/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* From the rocks of a case to groups of bodies and their contact. */
#include "cases/driver/scene/simulation_bodies.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/scene/build/body_kinds.h"
#include "cases/driver/scene/build/simulation_fill.h"
#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/simulation_motion.h"
#include "cases/driver/scene/wall_seams.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "core/material/checked.h"
#include "core/particle/kernel.h"

#include <stdio.h>
#include <string.h>

/* Overlap below this part of the spacing is touching. */
#define TOUCHING 0.05

/* A ball in the thinnest relaxed rock that is not refused, spacings. */
#define THICKNESS_LEAST 4.0

static mor_status make_request(mor_context *context, const mor_case *c, const mor_case_body *it, mor_point_cache *cache,
                               mor_lattice_points *points, mor_body_request *request)
{
    MOR_TRY(context, mor_simulation_fill_body(context, c, it, cache, points));
    *request = (mor_body_request){.name = it->name,
                                  .positions = points->positions,
                                  .n_particles = points->n_points,
                                  .shape = it->shape,
                                  .density = it->density,
                                  .soil_friction = (mor_wall_friction)it->soil_friction,
                                  .soil_friction_coefficient = it->soil_friction_coefficient,
                                  .contact_modulus = mor_case_contact_modulus(c, it),
                                  .contact_poisson = it->contact_poisson};
    mor_simulation_body_frame(c, it, request->shape_rotation, request->shape_translation);
    MOR_TRY(context, mor_shape_find_moments(context, it->shape, c->dimension, &request->geometry));
    mor_shape_moments_place(&request->geometry, request->shape_rotation, request->shape_translation);
    mor_matrix_apply(c->rotation, it->velocity, request->velocity);
    mor_matrix_apply(c->rotation, it->angular_velocity, request->angular_velocity);
    return MOR_OK;
}

static bool has_same_material(const mor_case_body *a, const mor_case_body *b)
{
    return strcmp(a->model, b->model) == 0 && a->density == b->density &&
           memcmp(a->parameters, b->parameters, sizeof a->parameters) == 0;
}

/* One group in the making. Zeroed before each. */
typedef struct group_spec {
    int members[MOR_CASE_BODIES_MAX]; /* numbers in the case */
    int n_members;
    mor_lattice_points points[MOR_CASE_BODIES_MAX];
    mor_body_request requests[MOR_CASE_BODIES_MAX];
} group_spec;

/* What the groups are made with. */
typedef struct group_builder {
    const mor_registry *registry; /* borrowed */
    mor_point_cache cache;        /* of all groups */
    group_spec group_spec;
} group_builder;

static void name_group(const mor_simulation_bodies *bodies, const char *model, char *name, size_t room)
{
    int n_same = 1;
    for (int g = 0; g < bodies->n_groups; ++g) {
        n_same += strncmp(bodies->groups[g]->set.name, model, strlen(model)) == 0;
    }
    snprintf(name, room, n_same > 1 ? "%s_%d" : "%s", model, n_same);
}

/* A body that cannot be made, or that its law refuses, is an error of the case: adds the place in the file. */
static mor_status annotate_error(mor_context *context, const mor_case *c, const group_spec *r, mor_status status)
{
    if (status != MOR_ERROR_ARGUMENT && status != MOR_ERROR_NUMERIC) {
        return status;
    }
    const int m = context->item >= 0 ? context->item : r->n_members - 1; /* the one that was gathered last */
    const mor_case_body *it = &c->bodies[r->members[m]];
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: found a body that cannot be made: %s", it->place.file,
                    it->place.line, context->message);
}

/* An estimate of the thickness of a shape, never too large. */
static double estimate_thickness(const mor_shape *shape, int dimension)
{
    enum { ACROSS = 20 };
    mor_bounds bounds;
    double deepest = 0.0;
    mor_shape_bounds(shape, &bounds);
    const int n_layers = dimension == 3 ? ACROSS : 1;
    for (int k = 0; k < ACROSS * ACROSS * n_layers; ++k) {
        const int index[3] = {k % ACROSS, k / ACROSS % ACROSS, k / (ACROSS * ACROSS)};
        double point[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < dimension; ++a) {
            point[a] = bounds.minimum[a] + (index[a] + 0.5) / ACROSS * (bounds.maximum[a] - bounds.minimum[a]);
        }
        deepest = fmax(deepest, -mor_shape_distance(shape, point));
    }
    return 2.0 * deepest;
}

/* Another spacing may lead to another packing: proposes one that is fine enough for any rock of the sizes. */
static mor_status explain_thin_body(mor_context *context, const mor_case *c, const mor_case_body *it)
{
    const mor_case_rocks *rocks = c->rocks;
    int end = c->n_listed_bodies + rocks->n_rocks;
    while (it - c->bodies >= end) {
        rocks += 1;
        end += rocks->n_rocks;
    }
    double least = INFINITY;
    for (int k = 0; k < rocks->n_shapes; ++k) {
        least = fmin(least, estimate_thickness(rocks->shapes[k], c->dimension));
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s; it is the thinnest of the rocks, and another spacing may generate thinner ones, that one, "
                    "too: %.3g m is fine enough for all sizes",
                    context->message, 0.98 * least * rocks->sizes[0].diameter / THICKNESS_LEAST);
}

/* Fills the thinnest packed rock before all others, so that not each of them is refused in turn. */
static mor_status try_thinnest(mor_context *context, const mor_case *c, mor_point_cache *cache)
{
    const mor_case_body *thinnest = NULL;
    double least = INFINITY;
    for (int b = 0; b < c->n_bodies; ++b) {
        const mor_case_body *it = &c->bodies[b];
        const double thickness = it->packed_diameter > 0.0 ? estimate_thickness(it->shape, c->dimension) : INFINITY;
        if (thickness < least) {
            least = thickness;
            thinnest = it;
        }
    }
    if (thinnest == NULL) {
        return MOR_OK;
    }
    mor_lattice_points points;
    const mor_status status = mor_simulation_fill_body(context, c, thinnest, cache, &points);
    mor_lattice_clear(context, &points);
    return status == MOR_ERROR_CONFIG ? explain_thin_body(context, c, thinnest) : status;
}

/* Gathers a body and all later ones that go into one group with it. */
static mor_status gather_members(mor_context *context, const mor_case *c, const mor_body_kind *kind, int leader,
                                 group_builder *builder)
{
    group_spec *r = &builder->group_spec;
    mor_status status = MOR_OK;
    for (int b = leader; b < c->n_bodies && status == MOR_OK; ++b) {
        const mor_case_body *it = &c->bodies[b];
        if (mor_body_kind_is(kind, it) && (kind->word != NULL || has_same_material(&c->bodies[leader], it))) {
            const int m = r->n_members++;
            r->members[m] = b;
            status = make_request(context, c, it, &builder->cache, &r->points[m], &r->requests[m]);
        }
    }
    return status;
}

/* Makes the group of the members that were gathered, and the material they are of. */
static mor_status finish_group(mor_context *context, mor_simulation_bodies *bodies, const mor_case *c,
                               const mor_body_kind *kind, const mor_material *material, const group_spec *r)
{
    const mor_case_body *first = &c->bodies[r->members[0]];
    mor_material_instance **instance = &bodies->materials[bodies->n_groups];
    mor_body_group *group = NULL;
    char name[MOR_FIELD_NAME_BYTES];
    name_group(bodies, first->model, name, sizeof name);
    if (material != NULL) {
        MOR_TRY(context, mor_material_create(context, material, first->density, first->parameters, instance));
        MOR_TRY(context, mor_checked_wrap(context, instance));
    }
    MOR_TRY(
        context,
        kind->make(context, &(mor_body_group_spec){c, name, r->members, r->requests, r->n_members, *instance}, &group));
    for (int m = 0; m < r->n_members; ++m) {
        bodies->of[r->members[m]] = (mor_simulation_body){group, m};
    }
    bodies->groups[bodies->n_groups++] = group;
    return MOR_OK;
}

/* The group of one body and of all later bodies of its kind and material. */
static mor_status make_group(mor_context *context, mor_simulation_bodies *bodies, const mor_case *c,
                             const mor_body_kind *kind, int leader, group_builder *builder)
{
    group_spec *r = &builder->group_spec;
    const mor_case_body *first = &c->bodies[leader];
    const mor_material *material = NULL;
    MOR_CHECK(context, bodies->n_groups < MOR_BODY_GROUPS_MAX, MOR_ERROR_CONFIG,
              "%s:%d: found body '%s' of one more material; allowed are %d materials of bodies, all rigid bodies "
              "counting as one; give some bodies the same material",
              first->place.file, first->place.line, first->name, MOR_BODY_GROUPS_MAX);
    if (kind->word == NULL) {
        MOR_TRY(context, mor_registry_require(context, builder->registry, first->model, &material));
    }
    memset(r, 0, sizeof *r);
    mor_status status = gather_members(context, c, kind, leader, builder);
    if (status == MOR_OK) {
        status = finish_group(context, bodies, c, kind, material, r);
    }
    status = annotate_error(context, c, r, status);
    for (int m = 0; m < r->n_members; ++m) {
        mor_lattice_clear(context, &r->points[m]);
    }
    return status;
}

/* A body's number as a field, so that pictures can tell bodies apart. */
static mor_status add_body_field(mor_context *context, mor_body_group *group)
{
    const mor_field_info info = {.name = "body",
                                 .n_components = 1,
                                 .unit = "1",
                                 .flags = MOR_FIELD_OUTPUT,
                                 .text = "number of the body in its group"};
    int field = 0;
    MOR_TRY(context, mor_set_add_field(context, &group->set, &info, &field));
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        group->set.data[field][i] = (double)group->body_of[i];
    }
    return MOR_OK;
}

/* The number of a body in the case by its group and place there. */
static int case_number(const mor_simulation_bodies *bodies, const mor_case *c, const mor_body *body)
{
    int b = 0;
    while (b + 1 < c->n_bodies && &bodies->of[b].group->bodies[bodies->of[b].index] != body) {
        ++b;
    }
    return b;
}

/* Remedy for a body in a wrong place; the places of packed rocks are not given in the case. */
static const char *advise_place(const mor_case_body *it, const char *advice)
{
    return it->packed_diameter > 0.0 ? "rocks are packed without regard to walls and the domain; raise 'margin' or "
                                       "shrink 'region'"
                                     : advice;
}

/* What is moved as prescribed or clamped may stand in a wall. */
static mor_status check_walls(mor_context *context, const mor_case *c, const mor_case_body *it, const double *point)
{
    for (int w = 0; w < c->n_walls && !it->is_prescribed && it->clamp == NULL; ++w) {
        const double depth = -mor_simulation_placed_distance(c->walls[w].shape, c->rotation, c->translation, point);
        MOR_CHECK(context, depth <= TOUCHING * c->spacing, MOR_ERROR_CONFIG,
                  "%s:%d: found body '%s' overlapping wall '%s' by at least %.2g m at (%g, %g, %g) m; allowed is less "
                  "than %g m; %s",
                  it->place.file, it->place.line, it->name, c->walls[w].name, depth, point[0], point[1], point[2],
                  TOUCHING * c->spacing, advise_place(it, "move the body or the wall"));
    }
    return MOR_OK;
}

/* A point of a body may not lie deep in another one. */
static mor_status check_others(mor_context *context, const mor_simulation_bodies *bodies, const mor_case *c,
                               const mor_bounds *boxes, int number, const double *point)
{
    const mor_case_body *it = &c->bodies[number];
    for (int b = 0; b < c->n_bodies; ++b) {
        if (b == number || !mor_simulation_body_may_hold(&boxes[b], point)) {
            continue;
        }
        const mor_body *other = &bodies->of[b].group->bodies[bodies->of[b].index];
        const double depth =
            -mor_simulation_placed_distance(other->shape, other->shape_rotation, other->shape_translation, point);
        MOR_CHECK(context, depth <= TOUCHING * c->spacing, MOR_ERROR_CONFIG,
                  "%s:%d: found body '%s' overlapping body '%s' by at least %.2g m at (%g, %g, %g) m; allowed is less "
                  "than %g m; move one of them",
                  it->place.file, it->place.line, it->name, c->bodies[b].name, depth, point[0], point[1], point[2],
                  TOUCHING * c->spacing);
    }
    return MOR_OK;
}

static mor_status check_node(mor_context *context, const mor_simulation_bodies *bodies, const mor_case *c,
                             const mor_simulation_frame *frame, const mor_bounds *boxes, int number, const double *node)
{
    const mor_case_body *it = &c->bodies[number];
    const double *low = frame->domain_minimum;
    const double *high = frame->domain_maximum;
    double local[3];
    mor_domain_localize(frame->is_placed ? &frame->placement : NULL, node, local);
    MOR_CHECK(context, mor_domain_holds(low, high, c->dimension, local), MOR_ERROR_CONFIG,
              "%s:%d: found body '%s' reaching out of the domain at (%g, %g, %g) m; the domain is (%g, %g, %g) to "
              "(%g, %g, %g) m; allowed are bodies inside it; %s",
              it->place.file, it->place.line, it->name, local[0], local[1], local[2], low[0], low[1], low[2], high[0],
              high[1], high[2], advise_place(it, "enlarge 'domain' or move the body"));
    MOR_TRY(context, check_others(context, bodies, c, boxes, number, node));
    return check_walls(context, c, it, node);
}

/* Surfaces give overlaps exactly, particles only to half a spacing; but a wall may lie inside a body. */
static mor_status check_groups(mor_context *context, const mor_simulation_bodies *bodies, const mor_case *c,
                               const mor_simulation_frame *frame, const mor_bounds *boxes)
{
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_body_group *group = bodies->groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            const int number = case_number(bodies, c, body);
            /* Of bodies in one place the surfaces coincide, and no point of one lies in the other. */
            for (int k = 0; k < 3; ++k) {
                const int64_t i = body->first + k * (body->n_particles - 1) / 2;
                MOR_TRY(context, check_others(context, bodies, c, boxes, number, group->reference + 3 * i));
            }
            for (int64_t s = body->first_node; s < body->first_node + body->n_nodes; ++s) {
                MOR_TRY(context, check_node(context, bodies, c, frame, boxes, number, group->node_reference + 3 * s));
            }
            for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
                MOR_TRY(context, check_walls(context, c, &c->bodies[number], group->reference + 3 * i));
            }
        }
    }
    return MOR_OK;
}

static mor_status check_places(mor_context *context, const mor_simulation_bodies *bodies, const mor_case *c,
                               const mor_simulation_frame *frame)
{
    mor_bounds *boxes = NULL;
    MOR_TRY(context, MOR_NEW(context, &boxes, c->n_bodies, "boxes around bodies"));
    for (int b = 0; b < c->n_bodies; ++b) {
        mor_simulation_body_box(c, &c->bodies[b], &boxes[b]);
    }
    const mor_status status = check_groups(context, bodies, c, frame, boxes);
    MOR_FREE(context, &boxes);
    return status;
}

static bool has_removals(const mor_case *c)
{
    bool has = false;
    for (int w = 0; w < c->n_walls; ++w) {
        has = has || c->walls[w].removed_at > 0.0;
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        has = has || c->bodies[b].removed_at > 0.0;
    }
    return has;
}

/* The motions of bodies on paths, about their centers of mass unless told otherwise. */
static mor_status make_motions(mor_context *context, mor_simulation_bodies *bodies, const mor_case *c)
{
    bool has_paths = false;
    for (int b = 0; b < c->n_bodies; ++b) {
        has_paths = has_paths || c->bodies[b].path.n_rows > 0;
    }
    if (!has_paths) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &bodies->motions, c->n_bodies, "motions of bodies"));
    bodies->n_motions = c->n_bodies;
    for (int b = 0; b < c->n_bodies; ++b) {
        const mor_simulation_body *it = &bodies->of[b];
        MOR_TRY(context, mor_simulation_make_motion(context, c, &c->bodies[b].path,
                                                    it->group->bodies[it->index].geometry.center, &bodies->motions[b]));
    }
    return MOR_OK;
}

static mor_status make_contact(mor_context *context, mor_simulation_bodies *bodies, const mor_case *c,
                               const mor_simulation_frame *frame, int first_bit)
{
    mor_contact_wall walls[MOR_CASE_WALLS_MAX];
    uint64_t bits[MOR_BODY_GROUPS_MAX];
    const double strength = mor_vector_length(frame->gravity);
    const double slowest = strength > 0.0 ? 0.1 * sqrt(strength * c->spacing) : 1.0e-3 * mor_case_largest_speed(c);
    memset(walls, 0, sizeof walls);
    for (int w = 0; w < c->n_walls; ++w) {
        snprintf(walls[w].name, sizeof walls[w].name, "%s", c->walls[w].name);
        walls[w].shape = c->walls[w].shape;
        memcpy(walls[w].rotation, c->rotation, sizeof walls[w].rotation);
        memcpy(walls[w].translation, c->translation, sizeof walls[w].translation);
        mor_matrix_apply(c->rotation, c->walls[w].velocity, walls[w].velocity);
        walls[w].motion = frame->wall_motions[w].n_rows > 0 ? &frame->wall_motions[w] : NULL;
        walls[w].fastest = mor_simulation_wall_speed(c, w, &frame->wall_motions[w]);
        walls[w].removed_at = c->walls[w].removed_at > 0.0 ? c->walls[w].removed_at : 0.0;
        walls[w].modulus = c->walls[w].contact_modulus;
        walls[w].poisson = c->walls[w].contact_poisson;
    }
    MOR_TRY(context, mor_wall_seams_join(context, c, walls, bodies->wholes));
    for (int p = 0; p < c->contact.n_pairs; ++p) {
        const mor_case_contact_pair *it = &c->contact.pairs[p];
        snprintf(bodies->pairs[p].first, sizeof bodies->pairs[p].first, "%s", it->first);
        snprintf(bodies->pairs[p].second, sizeof bodies->pairs[p].second, "%s", it->second);
        bodies->pairs[p].law = (mor_contact_law){it->friction_coefficient, it->restitution};
    }
    for (int g = 0; g < bodies->n_groups; ++g) {
        bits[g] = MOR_BIT(first_bit + g);
    }
    const mor_contact_settings settings = {{c->contact.friction_coefficient, c->contact.restitution},
                                           bodies->pairs,
                                           c->contact.n_pairs,
                                           slowest,
                                           mor_case_start_speed(c),
                                           has_removals(c)};
    MOR_TRY(context, mor_contact_init(context, &bodies->contact, &settings, bodies->groups, bits, bodies->n_groups,
                                      walls, c->n_walls));
    bodies->has_contact = true;
    mor_contact_exchange(&bodies->contact, &bodies->exchange);
    return MOR_OK;
}

static mor_status make_groups(mor_context *context, mor_simulation_bodies *bodies, const mor_case *c,
                              const mor_registry *registry)
{
    group_builder *builder = NULL;
    MOR_TRY(context, MOR_NEW(context, &builder, 1, "groups of bodies"));
    builder->registry = registry;
    mor_point_cache_init(&builder->cache, context->cache_folder);
    mor_status status = try_thinnest(context, c, &builder->cache);
    for (const mor_body_kind *kind = mor_body_kinds; kind->make != NULL; ++kind) {
        for (int b = 0; b < c->n_bodies && status == MOR_OK; ++b) {
            if (mor_body_kind_is(kind, &c->bodies[b]) && bodies->of[b].group == NULL) {
                status = make_group(context, bodies, c, kind, b, builder);
            }
        }
    }
    mor_point_cache_clear(context, &builder->cache);
    MOR_FREE(context, &builder);
    return status;
}

mor_status mor_simulation_bodies_init(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                      const mor_registry *registry, const mor_simulation_frame *frame, int first_bit)
{
    memset(bodies, 0, sizeof *bodies);
    if (the_case->n_bodies == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, make_groups(context, bodies, the_case, registry));
    for (int g = 0; g < bodies->n_groups; ++g) {
        mor_body_group *group = bodies->groups[g];
        memcpy(group->gravity, frame->gravity, sizeof group->gravity);
        memcpy(group->domain_minimum, frame->domain_minimum, sizeof group->domain_minimum);
        memcpy(group->domain_maximum, frame->domain_maximum, sizeof group->domain_maximum);
        group->placement = frame->is_placed ? &frame->placement : NULL;
        group->gravity_ramp = the_case->numerics.gravity_ramp;
        group->has_smooth_ramp = the_case->numerics.gravity_ramp_form == 1;
        group->damping = the_case->numerics.damping;
        group->local_damping = the_case->numerics.local_damping;
        group->damping_time = the_case->numerics.damping_time;
        MOR_TRY(context, add_body_field(context, group));
    }
    MOR_TRY(context, make_motions(context, bodies, the_case));
    MOR_TRY(context, check_places(context, bodies, the_case, frame));
    MOR_TRY(context, make_contact(context, bodies, the_case, frame, first_bit));
    return mor_simulation_bodies_settle(context, bodies, the_case, NULL);
}

void mor_simulation_bodies_clear(mor_context *context, mor_simulation_bodies *bodies)
{
    if (bodies->has_contact) {
        mor_contact_clear(context, &bodies->contact);
    }
    for (int w = 0; w < MOR_CASE_WALLS_MAX; ++w) {
        mor_shape_free(context, &bodies->wholes[w]);
    }
    for (int g = 0; g < MOR_BODY_GROUPS_MAX; ++g) {
        if (bodies->groups[g] != NULL) {
            bodies->groups[g]->operations->destroy(context, bodies->groups[g]);
        }
        mor_material_destroy(context, &bodies->materials[g]);
    }
    for (int b = 0; b < bodies->n_motions; ++b) {
        mor_motion_clear(context, &bodies->motions[b]);
    }
    MOR_FREE(context, &bodies->motions);
    memset(bodies, 0, sizeof *bodies);
}

static mor_status show_to_soil(mor_context *context, const mor_case *c, mor_soil *soil, mor_body_group *group)
{
    const mor_soil_barrier barrier = {true, c->numerics.barrier_stiffness, c->numerics.barrier_radius};
    mor_boundary *boundary = &group->boundary;
    if (c->numerics.wall_normals == 1) {
        MOR_TRY(context,
                mor_body_group_use_normals(context, group, MOR_KERNEL_SUPPORT * soil->constants.smoothing_length));
    }
    MOR_TRY(context, mor_soil_add_boundary(context, soil, boundary, (mor_wall_stress)c->numerics.body_stress));
    return barrier.stiffness > 0.0 ? mor_soil_set_barrier(context, soil, boundary, &barrier) : MOR_OK;
}

/* Finds the added mass of soil of each body. A prescribed or clamped body does not move as a whole. */
static void find_added_masses(mor_simulation_bodies *bodies, const mor_case *c, const mor_soil *soil)
{
    enum { ALL = 0x3f, OUT_OF_PLANE = 0x1c };
    double density = 0.0; /* of the densest soil: a body may get into any */
    for (int k = 0; k < soil->n_kinds; ++k) {
        density = fmax(density, soil->kinds[k].reference_density);
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        const mor_case_body *it = &c->bodies[b];
        const mor_simulation_body *body = &bodies->of[b];
        unsigned locked = c->dimension == 2 ? OUT_OF_PLANE : 0u;
        for (int k = 0; k < 6; ++k) {
            locked |= it->is_locked[k] ? 1u << k : 0u;
        }
        locked = it->is_prescribed || it->clamp != NULL ? ALL : locked;
        mor_body_find_added_mass(body->group, body->index, density, soil->sound_speed, locked);
    }
}

mor_status mor_simulation_bodies_join(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                      mor_soil *soil, mor_schedule *schedule)
{
    for (int g = 0; g < bodies->n_groups; ++g) {
        mor_stepper stepper;
        uint64_t evolving = 0;
        bodies->groups[g]->operations->make_stepper(bodies->groups[g], &stepper, &evolving);
        MOR_TRY(context, mor_schedule_add(context, schedule, &stepper, evolving));
        bodies->groups[g]->is_unseen = soil == NULL;
        if (soil != NULL) {
            MOR_TRY(context, show_to_soil(context, the_case, soil, bodies->groups[g]));
        }
    }
    if (soil != NULL) {
        find_added_masses(bodies, the_case, soil);
    }
    schedule->exchange = bodies->has_contact ? &bodies->exchange : NULL;
    return MOR_OK;
}
