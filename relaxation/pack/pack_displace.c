/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/pack/pack_internal.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* Rocks too near to each other are translated and rotated pair by pair, in proportion to inverse mass and inertia,
 * until none is (the positions of Mueller et al. 2007, without velocities). */
enum { SPOTS = 200, ROUNDS = 2, SWEEPS = 400, PATIENCE = 40 };

static const double overshoot = 0.02; /* of the resolution: so that the sweeps come to an end */
static const double progress = 0.7;   /* the displacements must shrink to this in PATIENCE sweeps, or there is no
                                       * space */

/* What resolving one rock needs. */
typedef struct displace_work {
    mor_pack_state *state;
    int self;
    double way; /* displaced so far in this sweep, m */
} displace_work;

/* Inverse mass of a rock, 1 over the volume of a ball (disc) of its diameter; and of its inertia. */
static double find_mobility(const mor_pack_state *state, const mor_pack_item *item, double *angular)
{
    const bool is_flat = state->request->dimension == 2;
    const double inverse =
        1.0 / (is_flat ? item->diameter * item->diameter : item->diameter * item->diameter * item->diameter);
    *angular = inverse * (is_flat ? 8.0 : 10.0) / (item->diameter * item->diameter); /* of a disc, of a ball */
    return inverse;
}

static void find_lever(const mor_pack_item *item, const mor_pack_contact *contact, double *moment)
{
    double arm[3];
    for (int a = 0; a < 3; ++a) {
        arm[a] = contact->point[a] - item->position[a];
    }
    mor_vector_cross(arm, contact->normal, moment);
}

/* Translates and rotates a rock by an impulse along the normal at the point of a contact. */
static void give_impulse(const mor_pack_state *state, mor_pack_item *item, const mor_pack_contact *contact,
                         double impulse)
{
    double angular;
    double moment[3];
    const double mobility = find_mobility(state, item, &angular);
    find_lever(item, contact, moment);
    for (int a = 0; a < state->request->dimension; ++a) {
        item->position[a] += impulse * mobility * contact->normal[a];
    }
    double h[3];
    for (int a = 0; a < 3; ++a) {
        h[a] = 0.5 * impulse * angular * moment[a];
    }
    if (state->request->dimension == 2) {
        h[0] = h[1] = 0.0;
    }
    const double w = item->spin[0];
    const double v[3] = {item->spin[1], item->spin[2], item->spin[3]};
    item->spin[0] += -mor_vector_dot(h, v);
    item->spin[1] += w * h[0] + h[1] * v[2] - h[2] * v[1];
    item->spin[2] += w * h[1] + h[2] * v[0] - h[0] * v[2];
    item->spin[3] += w * h[2] + h[0] * v[1] - h[1] * v[0];
    mor_pack_item_rotate(item);
}

static double find_yield(const mor_pack_state *state, const mor_pack_item *item, const mor_pack_contact *contact)
{
    double angular;
    double moment[3];
    const double mobility = find_mobility(state, item, &angular);
    find_lever(item, contact, moment);
    return mobility + angular * mor_vector_dot(moment, moment);
}

/* Opens a contact to the required gap: the owner of the point moves along the normal, the other one (NULL: it is fixed)
 * against it. Returns the relative displacement, m. */
static double open_contact(const mor_pack_state *state, mor_pack_item *owner, mor_pack_item *other, double wanted,
                           mor_pack_contact *contact)
{
    if (mor_vector_dot(contact->normal, contact->normal) == 0.0) { /* at the deepest point: any direction */
        contact->normal[0] = 1.0;
    }
    const double way = wanted - contact->gap + overshoot * state->request->resolution;
    const double yield = find_yield(state, owner, contact) + (other != NULL ? find_yield(state, other, contact) : 0.0);
    give_impulse(state, owner, contact, way / yield);
    if (other != NULL) {
        give_impulse(state, other, contact, -way / yield);
    }
    return way;
}

static bool open_pair(void *user, const mor_pack_state *state, const mor_pack_item *item, int index)
{
    displace_work *work = user;
    const bool *is_awake = state->is_awake;
    if (index == work->self || (is_awake[index] && index < work->self)) { /* this pair has been treated */
        return true;
    }
    mor_pack_item *self = work->state->items + work->self;
    mor_pack_item *other = work->state->items + index;
    mor_pack_contact contact = {.gap = state->least_gap};
    const bool is_near = mor_pack_probe(state, item, other, -INFINITY, &contact);
    if (mor_pack_probe(state, other, item, -INFINITY, &contact)) {
        work->way += open_contact(state, other, self, state->least_gap, &contact);
    } else if (is_near) {
        work->way += open_contact(state, self, other, state->least_gap, &contact);
    } else {
        return true;
    }
    work->state->is_awake[state->n_items_max + work->self] = true;
    work->state->is_awake[state->n_items_max + index] = true;
    return true;
}

static void open_shape(displace_work *work, const mor_shape *shape, double sign, double wanted)
{
    mor_pack_state *state = work->state;
    mor_pack_contact contact = {.gap = wanted};
    if (mor_pack_probe_shape(state, state->items + work->self, shape, sign, -INFINITY, &contact)) {
        work->way += open_contact(state, state->items + work->self, NULL, wanted, &contact);
        state->is_awake[state->n_items_max + work->self] = true;
    }
}

/* Displaces the rocks that moved in the last sweep from what they are too near to; returns the sum of the
 * displacements, m. */
static double sweep(mor_pack_state *state)
{
    const mor_pack_request *request = state->request;
    bool *moved = state->is_awake + state->n_items_max;
    displace_work work = {.state = state};
    mor_pack_list(state);
    for (work.self = 0; work.self < state->n_items; ++work.self) {
        if (!state->is_awake[work.self]) {
            continue;
        }
        state->n_evaluations += 1;
        open_shape(&work, request->region, -1.0, request->margin);
        if (request->obstacle != NULL) {
            open_shape(&work, request->obstacle, 1.0, request->gap);
        }
        mor_pack_visit(state, state->items + work.self, state->least_gap, open_pair, &work);
    }
    memcpy(state->is_awake, moved, (size_t)state->n_items * sizeof *moved);
    memset(moved, 0, (size_t)state->n_items * sizeof *moved);
    return work.way;
}

static bool settle(mor_pack_state *state)
{
    memset(state->is_awake, 0, 2 * (size_t)state->n_items_max * sizeof *state->is_awake);
    state->is_awake[state->n_items - 1] = true;
    double before = INFINITY;
    for (int k = 0; k < SWEEPS; ++k) {
        const double way = sweep(state);
        if (k % PATIENCE == PATIENCE - 1) {
            if (way > progress * before) {
                return false;
            }
            before = way;
        }
        if (way == 0.0) {
            for (int i = 0; i < state->n_items; ++i) {
                const mor_pack_item *item = state->items + i;
                const double depth = -mor_shape_distance(state->request->region, item->position);
                if (depth <= state->request->margin || !mor_pack_clears_obstacle(state, item)) {
                    return false;
                }
            }
            return true;
        }
    }
    return false;
}

static bool note_room(void *user, const mor_pack_state *state, const mor_pack_item *item, int index)
{
    double *room = user;
    const mor_pack_item *other = state->items + index;
    double offset[3];
    double local[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = (item->position[a] - other->position[a]) / other->diameter;
    }
    mor_matrix_apply_transposed(other->rotation, offset, local);
    *room = fmin(*room, other->diameter * mor_shape_distance(state->forms[other->form].shape, local));
    return true;
}

/* Draws some positions and takes the one farthest from all surfaces. */
static void find_spot(const mor_pack_state *state, int n_before, int round, mor_pack_item *item)
{
    const mor_pack_request *request = state->request;
    mor_pack_item best = *item;
    double most = -INFINITY;
    for (int k = 0; k < SPOTS; ++k) {
        mor_pack_draw(state, mor_pack_draw_id(n_before, (int64_t)request->most_tries + round * SPOTS + k), item);
        double room = -mor_shape_distance(request->region, item->position) - request->margin;
        if (request->obstacle != NULL) {
            room = fmin(room, mor_shape_distance(request->obstacle, item->position));
        }
        mor_pack_visit(state, item, state->least_gap, note_room, &room);
        if (room > most) {
            most = room;
            best = *item;
        }
    }
    *item = best;
}

bool mor_pack_displace(mor_pack_state *state, int n_before, const mor_pack_item *item)
{
    const size_t bytes = (size_t)state->n_items * sizeof *state->items;
    memcpy(state->kept, state->items, bytes);
    for (int round = 0; round < ROUNDS; ++round) {
        mor_pack_item *added = state->items + state->n_items;
        *added = *item;
        find_spot(state, n_before, round, added);
        state->n_items += 1;
        if (settle(state)) {
            mor_pack_list(state);
            return true;
        }
        state->n_items -= 1;
        memcpy(state->items, state->kept, bytes);
        mor_pack_list(state);
    }
    return false;
}
