/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* In spacings of the coarser of two bodies. */
#define SKIN 1.0  /* nodes nearer than this are listed */
#define HOLD 0.4  /* a list holds until the pair has traveled so far: less than the skin, for deformed bodies */
#define LAYER 1.0 /* the surface is nearer than this to the outermost particles of an elastic body */

static void box_of_rigid(const mor_contact_body *c, double *box, double *speed)
{
    const mor_body *body = &c->group->bodies[c->body];
    double middle[3];
    mor_matrix_apply(body->rotation, c->middle, middle);
    for (int a = 0; a < 3; ++a) {
        const double *row = body->rotation + 3 * a;
        const double reach = fabs(row[0]) * c->half[0] + fabs(row[1]) * c->half[1] + fabs(row[2]) * c->half[2];
        box[a] = body->center[a] + middle[a] - reach;
        box[3 + a] = body->center[a] + middle[a] + reach;
    }
    *speed = mor_vector_length(body->velocity) + mor_vector_length(body->angular_velocity) * c->radius;
}

static void box_of_elastic(const mor_contact_body *c, double *box, double *speed)
{
    const mor_body *body = &c->group->bodies[c->body];
    const double *x = c->group->set.data[MOR_FIELD_POSITION] + 3 * body->first;
    const double *v = c->group->set.data[MOR_FIELD_VELOCITY] + 3 * body->first;
    double fastest = 0.0;
    for (int a = 0; a < 3; ++a) {
        box[a] = box[3 + a] = x[a];
    }
    for (int64_t i = 0; i < body->n_particles; ++i) {
        for (int a = 0; a < 3; ++a) {
            box[a] = x[3 * i + a] < box[a] ? x[3 * i + a] : box[a];
            box[3 + a] = x[3 * i + a] > box[3 + a] ? x[3 * i + a] : box[3 + a];
        }
        const double speed2 = mor_vector_dot(v + 3 * i, v + 3 * i);
        fastest = speed2 > fastest ? speed2 : fastest;
    }
    for (int a = 0; a < 3; ++a) {
        box[a] -= LAYER * c->group->spacing;
        box[3 + a] += LAYER * c->group->spacing;
    }
    *speed = sqrt(fastest);
}

void mor_contact_box(const mor_contact_body *body, double *box, double *speed)
{
    if (!body->group->operations->is_deformable) {
        box_of_rigid(body, box, speed);
    } else {
        box_of_elastic(body, box, speed);
    }
}

/* Adds to the travel a bound of how far any point went since the last look. */
static void measure_travel(mor_contact_body *c)
{
    const mor_body *body = &c->group->bodies[c->body];
    double far = 0.0;
    if (!c->group->operations->is_deformable) {
        double rotated = 0.0;
        for (int a = 0; a < 9; ++a) {
            const double d = body->rotation[a] - c->previous[3 + a];
            rotated += d * d;
        }
        const double d[3] = {body->center[0] - c->previous[0], body->center[1] - c->previous[1],
                             body->center[2] - c->previous[2]};
        far = mor_vector_length(d) + sqrt(rotated) * c->radius;
        memcpy(c->previous, body->center, sizeof body->center);
        memcpy(c->previous + 3, body->rotation, sizeof body->rotation);
    } else {
        const double *x = c->group->set.data[MOR_FIELD_POSITION] + 3 * body->first;
        for (int64_t i = 0; i < body->n_particles; ++i) {
            double *p = c->previous + 3 * i;
            const double d[3] = {x[3 * i] - p[0], x[3 * i + 1] - p[1], x[3 * i + 2] - p[2]};
            const double far2 = mor_vector_dot(d, d);
            far = far2 > far ? far2 : far;
            memcpy(p, x + 3 * i, sizeof d);
        }
        far = sqrt(far);
    }
    /* At the first look all lists are still to be made. */
    c->travel += c->is_seen ? far : 0.0;
    c->is_seen = true;
}

void mor_contact_observe(mor_context *context, mor_contact *contact, uint64_t members)
{
    mor_contact_work *work = contact->work;
    MOR_PARALLEL_FOR (context, b, work->n_bodies, 1) {
        mor_contact_body *c = &work->bodies[b];
        double speed;
        if ((contact->stepper_bits[c->group_index] & members) != 0) {
            measure_travel(c);
            mor_contact_box(c, work->boxes + 6 * b, &speed);
            c->is_observed = false;
        }
    }
}

double mor_contact_apart(const mor_contact *contact, int first, int second, const double *boxes)
{
    const double *p = boxes + 6 * (int64_t)first;
    if (!mor_contact_is_side(contact, first) || !mor_contact_is_side(contact, second)) {
        return INFINITY;
    }
    if (second >= contact->work->n_bodies) {
        const mor_contact_wall *wall = &contact->walls[second - contact->work->n_bodies];
        double middle[3], place[3], half[3];
        for (int a = 0; a < 3; ++a) {
            middle[a] = 0.5 * (p[a] + p[3 + a]);
            half[a] = 0.5 * (p[3 + a] - p[a]);
        }
        mor_contact_wall_place(contact, wall, middle, place);
        if (contact->groups[contact->work->bodies[first].group_index]->dimension == 2) {
            half[2] = 0.0;
        }
        return mor_shape_distance(mor_contact_wall_shape(wall), place) - mor_vector_length(half);
    }
    const double *q = boxes + 6 * (int64_t)second;
    double d[3];
    for (int a = 0; a < 3; ++a) {
        d[a] = mor_max(mor_max(q[a] - p[3 + a], p[a] - q[3 + a]), 0.0);
    }
    return mor_vector_length(d);
}

static double pair_travel(const mor_contact *contact, int first, int second)
{
    const mor_contact_work *work = contact->work;
    return work->bodies[first].travel + (second < work->n_bodies ? work->bodies[second].travel : work->wall_travel);
}

static mor_status grow_near(mor_context *context, mor_contact_work *work)
{
    if (work->n_near < work->near_capacity) {
        return MOR_OK;
    }
    const int capacity = 2 * work->near_capacity + 16;
    mor_contact_near *near = NULL;
    int *active = NULL;
    int64_t *first_touch = NULL;
    mor_status status = MOR_NEW(context, &near, capacity, "near bodies");
    status = status == MOR_OK ? MOR_NEW(context, &active, capacity, "near bodies") : status;
    status = status == MOR_OK ? MOR_NEW(context, &first_touch, capacity + 1, "near bodies") : status;
    if (status != MOR_OK) {
        MOR_FREE(context, &near);
        MOR_FREE(context, &active);
        return mor_context_pass(context, status, MOR_HERE);
    }
    if (work->n_near > 0) {
        memcpy(near, work->near, (size_t)work->n_near * sizeof *near);
        memcpy(active, work->active, (size_t)work->n_active * sizeof *active);
    }
    MOR_FREE(context, &work->near);
    MOR_FREE(context, &work->active);
    MOR_FREE(context, &work->first_touch);
    work->near = near;
    work->active = active;
    work->first_touch = first_touch;
    work->near_capacity = capacity;
    return MOR_OK;
}

void mor_contact_free_lanes(mor_context *context, mor_contact_near *near)
{
    for (int side = 0; side < 2; ++side) {
        MOR_FREE(context, &near->lanes[side].nodes);
        MOR_FREE(context, &near->lanes[side].clear);
    }
}

/* Takes a pair into the list of near ones. Room for all nodes of both, so that lists never grow. */
static mor_status open_near(mor_context *context, mor_contact *contact, int first, int second, int64_t pair)
{
    mor_contact_work *work = contact->work;
    int place = 0;
    while (place < work->n_near && work->near[place].pair >= 0) {
        ++place;
    }
    if (place == work->n_near) {
        MOR_TRY(context, grow_near(context, work));
        work->n_near += 1;
    }
    mor_contact_near *near = &work->near[place];
    memset(near, 0, sizeof *near);
    near->pair = -1;
    near->first = first;
    near->second = second;
    for (int side = 0; side < (second < work->n_bodies ? 2 : 1); ++side) {
        const mor_contact_body *owner = &work->bodies[side == 0 ? first : second];
        mor_contact_lane *lane = &near->lanes[side];
        lane->capacity = owner->group->bodies[owner->body].n_nodes;
        lane->limit = -INFINITY;
        mor_status status = MOR_NEW(context, &lane->nodes, lane->capacity, "near nodes");
        status = status == MOR_OK ? MOR_NEW(context, &lane->clear, lane->capacity, "near nodes") : status;
        if (status != MOR_OK) {
            mor_contact_free_lanes(context, near);
            return mor_context_pass(context, status, MOR_HERE);
        }
    }
    near->pair = pair;
    work->near_of[pair] = place + 1;
    return MOR_OK;
}

static void close_near(mor_context *context, mor_contact_work *work, mor_contact_near *near)
{
    mor_contact_free_lanes(context, near);
    work->near_of[near->pair] = 0;
    near->pair = -1;
}

/* The tree serves queries widened by what its body has traveled since it was fitted. */
static void refit_tree(mor_contact_body *c)
{
    if (!c->group->operations->is_deformable) {
        return;
    }
    if (c->tree_travel < 0.0 || c->travel - c->tree_travel > HOLD * c->group->spacing) {
        const mor_body *body = &c->group->bodies[c->body];
        mor_tree_fit(&c->tree, c->group->set.data[MOR_FIELD_POSITION] + 3 * body->first, 3);
        c->tree_travel = c->travel;
    }
}

static bool is_in_box(const double *place, const double *box, double rim)
{
    for (int a = 0; a < 3; ++a) {
        if (place[a] < box[a] - rim || place[a] > box[3 + a] + rim) {
            return false;
        }
    }
    return true;
}

/* Lists the nodes of one side that are nearer than the skin. */
static void fill_lane(const mor_contact *contact, mor_contact_near *near, int side)
{
    const mor_contact_work *work = contact->work;
    mor_contact_lane *lane = &near->lanes[side];
    const mor_contact_body *owner = &work->bodies[side == 0 ? near->first : near->second];
    const int other = side == 0 ? near->second : near->first;
    const double spacing = mor_contact_spacing(contact, near->first, near->second);
    const mor_body *body = &owner->group->bodies[owner->body];
    int32_t particles[MOR_CONTACT_SUPPORT];
    double weights[MOR_CONTACT_SUPPORT];
    const double travel = pair_travel(contact, near->first, near->second);
    lane->n_nodes = 0;
    for (int64_t node = body->first_node; node < body->first_node + body->n_nodes; ++node) {
        mor_contact_touch touch = {.side = side, .node = node};
        if (other < work->n_bodies) {
            mor_body_node_place(owner->group, owner->body, node, touch.place);
            if (!is_in_box(touch.place, work->boxes + 6 * (int64_t)other, SKIN * spacing)) {
                continue;
            }
        }
        mor_contact_find_touch(contact, near, &touch, false, particles, weights);
        if (touch.gap <= SKIN * spacing) {
            lane->clear[lane->n_nodes] = travel + touch.clearance;
            lane->nodes[lane->n_nodes++] = node;
        }
    }
    lane->limit = travel + HOLD * spacing;
}

/* Decides whether a pair is near; makes or drops its lists. */
static mor_status visit_pair(mor_context *context, mor_contact *contact, int first, int second, int64_t pair)
{
    mor_contact_work *work = contact->work;
    const double travel = pair_travel(contact, first, second);
    if (travel < work->free_until[pair]) {
        return MOR_OK;
    }
    const double gap = mor_contact_apart(contact, first, second, work->boxes);
    if (gap > SKIN * mor_contact_spacing(contact, first, second)) {
        /* Half of it, since nodes that are extrapolated from particles go farther than these. */
        work->free_until[pair] = travel + 0.5 * gap;
        if (work->near_of[pair] > 0) {
            close_near(context, work, &work->near[work->near_of[pair] - 1]);
        }
        return MOR_OK;
    }
    if (work->near_of[pair] == 0) {
        MOR_TRY(context, open_near(context, contact, first, second, pair));
    }
    refit_tree(&work->bodies[first]);
    if (second < work->n_bodies) {
        refit_tree(&work->bodies[second]);
    }
    work->active[work->n_active++] = work->near_of[pair] - 1;
    return MOR_OK;
}

static mor_status visit_pairs(mor_context *context, mor_contact *contact, uint64_t members)
{
    mor_contact_work *work = contact->work;
    int64_t pair = 0;
    work->n_active = 0;
    for (int first = 0; first < work->n_bodies; ++first) {
        const bool is_member = (contact->stepper_bits[work->bodies[first].group_index] & members) != 0;
        for (int second = first + 1; second < work->n_bodies + contact->n_walls; ++second, ++pair) {
            const bool is_wall = second >= work->n_bodies;
            if (is_member && (is_wall || (contact->stepper_bits[work->bodies[second].group_index] & members) != 0)) {
                MOR_TRY(context, visit_pair(context, contact, first, second, pair));
            }
        }
    }
    return MOR_OK;
}

static void fill_lanes(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    MOR_PARALLEL_FOR (context, k, 2 * (int64_t)work->n_active, 1) {
        mor_contact_near *near = &work->near[work->active[k / 2]];
        mor_contact_lane *lane = &near->lanes[k % 2];
        if (lane->nodes != NULL && pair_travel(contact, near->first, near->second) >= lane->limit) {
            fill_lane(contact, near, (int)(k % 2));
        }
    }
}

static mor_status grow_touches(mor_context *context, mor_contact_work *work, int64_t n)
{
    if (n <= work->touch_capacity) {
        return MOR_OK;
    }
    const int64_t capacity = 2 * n + 64;
    MOR_FREE(context, &work->touches);
    MOR_FREE(context, &work->support_particles);
    MOR_FREE(context, &work->support_weights);
    work->touch_capacity = 0;
    MOR_TRY(context, MOR_NEW(context, &work->touches, capacity, "touching nodes"));
    MOR_TRY(context, MOR_NEW(context, &work->support_particles, capacity * MOR_CONTACT_SUPPORT, "touching nodes"));
    MOR_TRY(context, MOR_NEW(context, &work->support_weights, capacity * MOR_CONTACT_SUPPORT, "touching nodes"));
    work->touch_capacity = capacity;
    return MOR_OK;
}

/* Lists the nodes of a pair that may touch by now. */
static int64_t list_nodes(const mor_contact *contact, int which, mor_contact_touch *touches)
{
    mor_contact_near *near = &contact->work->near[which];
    int64_t n = 0;
    near->travel = pair_travel(contact, near->first, near->second);
    for (int side = 0; side < 2; ++side) {
        const mor_contact_lane *lane = &near->lanes[side];
        for (int64_t m = 0; m < lane->n_nodes; ++m) {
            if (lane->clear[m] <= near->travel) {
                touches[n++] = (mor_contact_touch){.near = which, .side = side, .node = lane->nodes[m], .entry = m};
            }
        }
    }
    return n;
}

/* Lists the nodes to look at, pair by pair; pairs without any are skipped until their lists expire. */
static mor_status list_touches(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    int n_near = 0;
    int64_t n = 0;
    for (int k = 0; k < work->n_active; ++k) {
        mor_contact_near *near = &work->near[work->active[k]];
        const int64_t n_nodes = near->lanes[0].n_nodes + near->lanes[1].n_nodes;
        if (n_nodes == 0) {
            const bool is_wall = near->second >= work->n_bodies;
            work->free_until[near->pair] =
                is_wall ? near->lanes[0].limit : fmin(near->lanes[0].limit, near->lanes[1].limit);
            continue;
        }
        work->active[n_near++] = work->active[k];
        n += n_nodes;
    }
    MOR_TRY(context, grow_touches(context, work, n));
    work->n_active = 0;
    work->n_touches = 0;
    for (int k = 0; k < n_near; ++k) {
        const int which = work->active[k];
        const int64_t n_touches = list_nodes(contact, which, work->touches + work->n_touches);
        if (n_touches > 0) {
            work->first_touch[work->n_active] = work->n_touches;
            work->active[work->n_active++] = which;
            work->n_touches += n_touches;
        }
    }
    if (work->n_active > 0) {
        work->first_touch[work->n_active] = work->n_touches;
    }
    return MOR_OK;
}

mor_status mor_contact_search(mor_context *context, mor_contact *contact, uint64_t members)
{
    MOR_TRY(context, visit_pairs(context, contact, members));
    fill_lanes(context, contact);
    return list_touches(context, contact);
}
