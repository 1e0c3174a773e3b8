/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

#define STICK_DAMPING 0.2  /* damping ratio of the friction spring, 1 */
#define DAMPING_LIMIT 0.5  /* share of a relative velocity that damping may take away in a step, 1 */
#define KEPT_RADIANS 200.0 /* of phase of the contact's oscillation in which the stored speed of an impact decays, 1 */
#define NODES_LIMIT 0.8    /* likewise, of any motion of a rigid body, by all its contacts together, 1 */

/* Sums and properties of one pair for its forces. The pair force acts on the first body along normal. */
typedef struct pair_sums {
    const mor_contact_near *near;
    const mor_contact_law *law;
    double force;     /* sum of the nodes' normal forces, N */
    double center[3]; /* their centroid, m */
    double normal[3]; /* their mean direction, 1 */
    double stiffness; /* sum over touching nodes, N/m */
    double softening; /* factor on the nodes' normal forces, 1 */
    double factor;    /* damped over elastic normal force of the whole pair, 1 */
    double rate;      /* of damping, s/m */
    double closing;   /* mean speed of closing of the followed nodes, weighted by their forces, m/s */
    bool is_hertzian; /* two rigid sides */
    double length;    /* of the sub-step, s */
    int64_t begin;    /* its touches */
    int64_t end;
} pair_sums;

/* Center, velocity, inertia and spin of a body from its particles. */
static void observe_elastic(mor_contact_body *c)
{
    const mor_body *body = &c->group->bodies[c->body];
    const double *x = c->group->set.data[MOR_FIELD_POSITION] + 3 * body->first;
    const double *v = c->group->set.data[MOR_FIELD_VELOCITY] + 3 * body->first;
    const double *m = c->group->set.data[MOR_FIELD_MASS] + body->first;
    double mass = 0.0;
    double spin[3] = {0.0, 0.0, 0.0};
    memset(c->center, 0, sizeof c->center);
    memset(c->velocity, 0, sizeof c->velocity);
    memset(c->inertia, 0, sizeof c->inertia);
    for (int64_t i = 0; i < body->n_particles; ++i) {
        mass += m[i];
        for (int a = 0; a < 3; ++a) {
            c->center[a] += m[i] * x[3 * i + a];
            c->velocity[a] += m[i] * v[3 * i + a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        c->center[a] /= mass;
        c->velocity[a] /= mass;
    }
    for (int64_t i = 0; i < body->n_particles; ++i) {
        const double d[3] = {x[3 * i] - c->center[0], x[3 * i + 1] - c->center[1], x[3 * i + 2] - c->center[2]};
        double moment[3];
        mor_vector_cross(d, v + 3 * i, moment);
        for (int a = 0; a < 3; ++a) {
            spin[a] += m[i] * moment[a];
            c->inertia[a] += m[i] * (mor_vector_dot(d, d) - d[a] * d[a]);
            c->inertia[3 + a] -= m[i] * d[a] * d[(a + 1) % 3];
        }
    }
    mor_symmetric_solve(c->group->dimension, c->inertia, spin, c->spin);
}

static void observe_body(mor_contact_body *c)
{
    const mor_body *body = &c->group->bodies[c->body];
    if (c->is_observed) {
        return;
    }
    if (c->group->operations->is_deformable) {
        observe_elastic(c);
    } else {
        memcpy(c->center, body->center, sizeof c->center);
        memcpy(c->velocity, body->velocity, sizeof c->velocity);
        memcpy(c->spin, body->angular_velocity, sizeof c->spin);
    }
    c->is_observed = true;
}

/* Velocity of the point of a body, or wall, at a place as if it were rigid. */
static void whole_velocity(const mor_contact *contact, int second, const double *place, double *velocity)
{
    if (second >= contact->work->n_bodies) {
        mor_contact_wall_velocity(&contact->walls[second - contact->work->n_bodies], place, velocity);
        return;
    }
    mor_contact_body *c = &contact->work->bodies[second];
    observe_body(c);
    const double arm[3] = {place[0] - c->center[0], place[1] - c->center[1], place[2] - c->center[2]};
    mor_vector_cross(c->spin, arm, velocity);
    for (int a = 0; a < 3; ++a) {
        velocity[a] += c->velocity[a];
    }
}

/* Force at a place on a whole body: an elastic one is accelerated as if it were rigid. */
static void apply_to_whole(mor_contact *contact, int second, const double *place, const double *force)
{
    mor_contact_work *work = contact->work;
    if (second >= work->n_bodies) {
        return;
    }
    mor_contact_body *c = &work->bodies[second];
    mor_body_group *group = c->group;
    const mor_body *body = &group->bodies[c->body];
    if (!group->operations->is_deformable) {
        mor_body_point_apply_force(group, c->body, &(mor_body_support){0, NULL, NULL}, place, force);
        return;
    }
    const double arm[3] = {place[0] - c->center[0], place[1] - c->center[1], place[2] - c->center[2]};
    const double *x = group->set.data[MOR_FIELD_POSITION];
    const double *m = group->set.data[MOR_FIELD_MASS];
    double moment[3], rotation[3];
    double mass = 0.0;
    mor_vector_cross(arm, force, moment);
    mor_symmetric_solve(group->dimension, c->inertia, moment, rotation);
    for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
        mass += m[i];
    }
    for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
        const double d[3] = {x[3 * i] - c->center[0], x[3 * i + 1] - c->center[1], x[3 * i + 2] - c->center[2]};
        double around[3];
        mor_vector_cross(rotation, d, around);
        for (int a = 0; a < 3; ++a) {
            group->contact_force[3 * i + a] += m[i] * (force[a] / mass + around[a]);
        }
    }
}

/* Tells whoever looks of a force on the first side of a pair. */
static void tell_load(const mor_contact *contact, const mor_contact_near *near, const double *place,
                      const double *force)
{
    const mor_contact_work *work = contact->work;
    const bool is_wall = near->second >= work->n_bodies;
    const mor_contact_body *first = &work->bodies[near->first];
    if (contact->watch.run == NULL) {
        return;
    }
    const mor_contact_load load = {
        .group = first->group,
        .body = first->body,
        .other_group = mor_contact_group(contact, near->second),
        .other_body = is_wall ? -1 : work->bodies[near->second].body,
        .wall = is_wall ? mor_contact_find_part(contact, near->second - work->n_bodies, place) : -1,
        .place = place,
        .force = force};
    contact->watch.run(contact->watch.owner, &load);
}

static void apply_to_wall(mor_contact *contact, const mor_contact_near *near, const double *place, const double *force)
{
    const mor_contact_work *work = contact->work;
    if (near->second < work->n_bodies) {
        return;
    }
    const int group = work->bodies[near->first].group_index;
    const int wall = mor_contact_find_part(contact, near->second - work->n_bodies, place);
    const int64_t entry = 3 * ((int64_t)group * contact->n_walls + wall);
    for (int a = 0; a < 3; ++a) {
        contact->wall_force[entry + a] -= force[a];
    }
    mor_vector_cross_add(-1.0, place, force, contact->wall_moment + entry);
}

/* Spring energy of a pair, of which a body or a wall may be removed. */
static void note_pair_spring(mor_contact *contact, const mor_contact_near *near, double stored)
{
    if (contact->pair_spring != NULL) {
        contact->pair_spring[near->pair] += stored;
    }
}

/* Force on the node of a touch; the opposite on its partner. */
static void apply_to_both(mor_contact *contact, const mor_contact_near *near, int64_t index, const double *force)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_touch *touch = &work->touches[index];
    const double opposite[3] = {-force[0], -force[1], -force[2]};
    const mor_contact_body *owner = &work->bodies[touch->side == 0 ? near->first : near->second];
    const mor_body_support node = mor_body_node_support(owner->group, touch->node);
    mor_body_point_apply_force(owner->group, owner->body, &node, touch->place, force);
    const int other = touch->side == 0 ? near->second : near->first;
    if (other < work->n_bodies) {
        const mor_contact_body *partner = &work->bodies[other];
        const mor_body_support support = {touch->support_count, work->support_particles + MOR_CONTACT_SUPPORT * index,
                                          work->support_weights + MOR_CONTACT_SUPPORT * index};
        mor_body_point_apply_force(partner->group, partner->body, &support, touch->place, opposite);
    } else {
        apply_to_wall(contact, near, touch->place, force);
    }
    tell_load(contact, near, touch->place, touch->side == 0 ? force : opposite);
}

/* Normal force of a node without damping, N. */
static double normal_force(const pair_sums *sums, const mor_contact_touch *touch)
{
    return sums->softening * touch->share * touch->stiffness * touch->mean_depth;
}

/* The energy that the nodes store, and by it how stiff they are, docs/theory/contact.md (C3b). */
static void soften_pair(mor_contact *contact, pair_sums *sums)
{
    mor_contact_work *work = contact->work;
    double energy = 0.0;
    double deepest = 0.0;
    const double *place = NULL;
    double stored;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        if (touch->depth > 0.0) {
            energy += 0.5 * touch->share * touch->stiffness * touch->mean_square;
            place = touch->depth > deepest ? touch->place : place;
            deepest = fmax(deepest, touch->depth);
        }
    }
    sums->softening = mor_contact_soften(contact, sums->near, energy, &stored);
    if (deepest > 0.0) {
        contact->group_spring[work->bodies[sums->near->first].group_index] += stored;
        note_pair_spring(contact, sums->near, stored);
        mor_contact_note_depth(contact, sums->near, deepest, place);
    }
}

/* Sums the normal forces of a pair; false when nothing touches. */
static bool sum_pair(mor_contact *contact, pair_sums *sums)
{
    const mor_contact_work *work = contact->work;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        if (!(touch->depth > 0.0)) {
            continue;
        }
        mor_contact_note_edge(contact, sums->near, touch);
        const double force = normal_force(sums, touch);
        const double sign = touch->side == 0 ? 1.0 : -1.0;
        sums->force += force;
        sums->stiffness += touch->stiffness;
        for (int a = 0; a < 3; ++a) {
            sums->center[a] += force * touch->place[a];
            sums->normal[a] += sign * force * touch->normal[a];
        }
    }
    const double length = mor_vector_length(sums->normal);
    if (!(sums->force > 0.0) || !(length > 0.0)) {
        return sums->force > 0.0;
    }
    for (int a = 0; a < 3; ++a) {
        sums->center[a] /= sums->force;
        sums->normal[a] /= length;
    }
    return true;
}

/* Velocity of closing of a pair at the center of its forces, as if both were rigid, m/s. */
static double find_closing(mor_contact *contact, const pair_sums *sums)
{
    double own[3], other[3];
    whole_velocity(contact, sums->near->first, sums->center, own);
    whole_velocity(contact, sums->near->second, sums->center, other);
    const double difference[3] = {other[0] - own[0], other[1] - own[1], other[2] - own[2]};
    return mor_vector_dot(difference, sums->normal);
}

/* Adds the damping force of the whole pair, at its center: nodes of an elastic body have no dampers of their own. */
static void damp_whole(mor_contact *contact, pair_sums *sums, double closing, double inverse)
{
    const mor_contact_work *work = contact->work;
    sums->factor = fmax(0.0, 1.0 + sums->rate * closing);
    /* The nodes' forces need not be parallel; what is damped is their resultant. */
    double resultant = 0.0;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        const double sign = touch->side == 0 ? 1.0 : -1.0;
        resultant +=
            touch->depth > 0.0 ? sign * normal_force(sums, touch) * mor_vector_dot(touch->normal, sums->normal) : 0.0;
    }
    const double extra = resultant * (sums->factor - 1.0);
    const double force[3] = {extra * sums->normal[0], extra * sums->normal[1], extra * sums->normal[2]};
    const double opposite[3] = {-force[0], -force[1], -force[2]};
    apply_to_whole(contact, sums->near->first, sums->center, force);
    apply_to_whole(contact, sums->near->second, sums->center, opposite);
    apply_to_wall(contact, sums->near, sums->center, force);
    tell_load(contact, sums->near, sums->center, force);
    /* What the motion loses is force times the velocity in the middle of the kick; of that, the pair's own part, as
     * if nothing rotates. */
    const double kick = (resultant + extra) * inverse * sums->length;
    contact->damping_energy += extra * (closing - 0.5 * kick) * sums->length;
}

/* Damped over elastic normal force of one node, 1. Of rigid sides each node on an edge is damped by its own speed of
 * closing, so that rocking decays as bouncing does; those on a smooth surface by their mean speed, else rolling would
 * be braked: it closes in front and opens behind. */
static double node_factor(const pair_sums *sums, const mor_contact_touch *touch)
{
    const double closing = touch->is_followed ? sums->closing : -mor_vector_dot(touch->slip, touch->normal);
    return sums->is_hertzian ? fmax(0.0, 1.0 + sums->rate * closing) : sums->factor;
}

static double find_mean_closing(const mor_contact *contact, const pair_sums *sums)
{
    double force = 0.0;
    double sum = 0.0;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &contact->work->touches[k];
        if (touch->depth > 0.0 && touch->is_followed) {
            const double share = normal_force(sums, touch);
            force += share;
            sum -= share * mor_vector_dot(touch->slip, touch->normal);
        }
    }
    return force > 0.0 ? sum / force : 0.0;
}

/* Adds up the energy dissipated by damping of each node, with the speed in the middle of the kick as above. */
static void record_nodes(mor_contact *contact, const pair_sums *sums, double inverse)
{
    const mor_contact_work *work = contact->work;
    double whole = 0.0;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        whole += touch->depth > 0.0 ? normal_force(sums, touch) * node_factor(sums, touch) : 0.0;
    }
    const double kick = whole * inverse * sums->length;
    for (int64_t k = sums->begin; k < sums->end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        if (touch->depth > 0.0) {
            const double extra = normal_force(sums, touch) * (node_factor(sums, touch) - 1.0);
            const double closing = -mor_vector_dot(touch->slip, touch->normal);
            contact->damping_energy += extra * (closing - 0.5 * kick) * sums->length;
        }
    }
}

/* Decay of the stored speed of an impact: between rigid sides within some periods of the contact, so that oscillations
 * that go on after a hard landing are damped by their own speed. */
static double keep_impact(const mor_contact *contact, const pair_sums *sums, double impact)
{
    if (!sums->is_hertzian || !(impact > 0.0)) {
        return impact;
    }
    return impact * exp(-sums->length * mor_contact_frequency(contact, sums->near, impact) / KEPT_RADIANS);
}

/* Slowest impact: no faster than the oscillation of a body at rest on the contact, which would else hardly be
 * damped. */
static double slowest_impact(const mor_contact *contact, const pair_sums *sums)
{
    const double given = contact->settings.slowest_impact;
    const double gravity = mor_contact_gravity(&contact->work->bodies[sums->near->first]);
    return sums->is_hertzian && gravity > 0.0 ? fmin(given, gravity / mor_contact_frequency(contact, sums->near, 0.0))
                                              : given;
}

/* Largest rate of damping that takes no more than its share of a motion in one step, s/m. */
static double limit_damping(const mor_contact *contact, const pair_sums *sums, double inverse)
{
    if (!sums->is_hertzian) {
        return DAMPING_LIMIT / (sums->force * inverse * sums->length);
    }
    const mor_contact_near *near = sums->near;
    const mor_contact_work *work = contact->work;
    int n_touching = work->bodies[near->first].n_touching;
    if (near->second < work->n_bodies && work->bodies[near->second].n_touching > n_touching) {
        n_touching = work->bodies[near->second].n_touching;
    }
    const double response = sums->softening * mor_contact_response(contact, near, sums->begin, sums->end);
    return NODES_LIMIT / (n_touching * response * sums->length);
}

/* Restitution: the normal force of the pair grows with the speed of closing, docs/theory/contact.md. */
static void damp_pair(mor_contact *contact, pair_sums *sums)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_near *near = sums->near;
    const double inverse =
        mor_contact_inverse_mass(contact, near->first) + mor_contact_inverse_mass(contact, near->second);
    const double y = work->rebound[work->law_of[near->pair]];
    double *impact = &contact->impacts[near->pair];
    sums->factor = 1.0;
    sums->rate = 0.0;
    if (!(y > 0.0) || mor_vector_dot(sums->normal, sums->normal) == 0.0) {
        return;
    }
    const double closing = find_closing(contact, sums);
    /* The fastest closing during one touch is its impact: a contact at rest may be hit later. */
    *impact = fmax(keep_impact(contact, sums, *impact), fmax(closing, slowest_impact(contact, sums)));
    if (!(*impact > 0.0)) {
        return;
    }
    sums->rate = fmin(y / *impact, limit_damping(contact, sums, inverse));
    if (sums->is_hertzian) {
        sums->closing = find_mean_closing(contact, sums);
        record_nodes(contact, sums, inverse);
    } else {
        damp_whole(contact, sums, closing, inverse);
    }
}

/* Place of a partner among the slots of a node: its own, else a free one, else -1. */
static int find_slot(const double *partners, double partner)
{
    int empty = -1;
    for (int s = MOR_CONTACT_SLOTS - 1; s >= 0; --s) {
        if (partners[s] == partner) {
            return s;
        }
        empty = partners[s] == 0.0 ? s : empty;
    }
    return empty;
}

/* Mass that a friction spring moves on one side, inverted: a share of a rigid body, the layer under an elastic node. */
static double inverse_share(const mor_contact *contact, const pair_sums *sums, int second, double stiffness)
{
    const double inverse = mor_contact_inverse_mass(contact, second);
    if (inverse == 0.0) {
        return 0.0;
    }
    const mor_contact_body *c = &contact->work->bodies[second];
    if (!c->group->operations->is_deformable) {
        return inverse * sums->stiffness / stiffness;
    }
    const double area = stiffness / mor_contact_area_stiffness(contact, sums->near->first, sums->near->second);
    return 1.0 / (c->group->bodies[c->body].density * c->group->spacing * area);
}

/* Tangential spring and damper of one node, capped by Coulomb's law. */
static void apply_tangential_force(mor_contact *contact, const pair_sums *sums, int64_t index)
{
    mor_contact_work *work = contact->work;
    const mor_contact_touch *touch = &work->touches[index];
    const int own = touch->side == 0 ? sums->near->first : sums->near->second;
    const int other = touch->side == 0 ? sums->near->second : sums->near->first;
    const int group = work->bodies[own].group_index;
    const int64_t entry = work->first_node[group] + touch->node;
    double *partners = contact->history.data[work->field_partners] + MOR_CONTACT_SLOTS * entry;
    const int slot = find_slot(partners, (double)(other + 1));
    double none[3] = {0.0, 0.0, 0.0};
    double *spring =
        slot < 0 ? none : contact->history.data[work->field_springs] + 3 * (MOR_CONTACT_SLOTS * entry + slot);
    const double stiffness = MOR_CONTACT_TANGENTIAL_RATIO * touch->stiffness;
    const double inverse =
        inverse_share(contact, sums, own, touch->stiffness) + inverse_share(contact, sums, other, touch->stiffness);
    const double cap = sums->law->friction_coefficient * node_factor(sums, touch) * normal_force(sums, touch);
    const double before2 = mor_vector_dot(spring, spring);
    const double along = mor_vector_dot(spring, touch->normal);
    const double off = mor_vector_dot(touch->slip, touch->normal);
    double rotated[3], slide[3], force[3];
    for (int a = 0; a < 3; ++a) {
        rotated[a] = spring[a] - along * touch->normal[a];
        slide[a] = touch->slip[a] - off * touch->normal[a];
    }
    /* The spring rotates with the tangent plane and keeps its length. */
    const double rotated2 = mor_vector_dot(rotated, rotated);
    const double stretch = rotated2 > 0.0 ? sqrt(before2 / rotated2) : 0.0;
    const double damping =
        inverse > 0.0 ? fmin(2.0 * STICK_DAMPING * sqrt(stiffness / inverse), DAMPING_LIMIT / (inverse * sums->length))
                      : 0.0;
    for (int a = 0; a < 3; ++a) {
        spring[a] = rotated[a] * stretch + slide[a] * sums->length;
        force[a] = -stiffness * spring[a] - damping * slide[a];
    }
    /* Spring and whole force are capped each on its own: a damper must not load the spring. */
    const double size = mor_vector_length(force);
    const double pull = stiffness * mor_vector_length(spring);
    for (int a = 0; a < 3; ++a) {
        force[a] *= size > cap ? cap / size : 1.0;
        spring[a] *= pull > cap ? cap / pull : 1.0;
    }
    const double stored = 0.5 * stiffness * mor_vector_dot(spring, spring);
    contact->friction_energy -=
        mor_vector_dot(force, slide) * sums->length + (slot < 0 ? 0.0 : stored - 0.5 * stiffness * before2);
    if (slot >= 0) {
        partners[slot] = other + 1;
        contact->group_spring[group] += stored;
        note_pair_spring(contact, sums->near, stored);
        work->slot_mark[MOR_CONTACT_SLOTS * entry + slot] = 1;
        work->kept_slots[work->n_kept++] = MOR_CONTACT_SLOTS * entry + slot;
    }
    apply_to_both(contact, sums->near, index, force);
}

static void apply_to_pair(mor_contact *contact, int k, double length)
{
    mor_contact_work *work = contact->work;
    pair_sums sums = {.near = &work->near[work->active[k]], .length = length};
    const int law = work->law_of[sums.near->pair];
    sums.law = law == 0 ? &contact->settings.law : &contact->settings.pairs[law - 1].law;
    sums.is_hertzian = mor_contact_is_hertzian(contact, sums.near->first, sums.near->second);
    sums.begin = work->first_touch[k];
    sums.end = work->first_touch[k + 1];
    if (mor_contact_inverse_mass(contact, sums.near->first) + mor_contact_inverse_mass(contact, sums.near->second) ==
        0.0) {
        mor_contact_note_driven(contact, sums.near, sums.begin, sums.end);
        return;
    }
    soften_pair(contact, &sums);
    if (!sum_pair(contact, &sums)) {
        return;
    }
    damp_pair(contact, &sums);
    work->pair_mark[sums.near->pair] = 1;
    work->kept_pairs[work->n_kept_pairs++] = sums.near->pair;
    for (int64_t index = sums.begin; index < sums.end; ++index) {
        const mor_contact_touch *touch = &work->touches[index];
        if (!(touch->depth > 0.0)) {
            continue;
        }
        double force[3];
        for (int a = 0; a < 3; ++a) {
            force[a] =
                normal_force(&sums, touch) * (sums.is_hertzian ? node_factor(&sums, touch) : 1.0) * touch->normal[a];
        }
        apply_to_both(contact, sums.near, index, force);
        if (sums.law->friction_coefficient > 0.0) {
            apply_tangential_force(contact, &sums, index);
        }
    }
}

/* Sets the sums of the members' groups to zero. */
static void clear_sums(mor_contact *contact, uint64_t members)
{
    mor_contact_work *work = contact->work;
    const int64_t n = 3 * (int64_t)contact->n_walls;
    for (int g = 0; g < contact->n_groups; ++g) {
        if ((contact->stepper_bits[g] & members) == 0) {
            continue;
        }
        contact->group_spring[g] = 0.0;
        contact->group_deepest[g] = 0.0;
        work->group_worst[g] = (mor_contact_depth){0, 0, 0.0, 0.0};
        if (n > 0) {
            memset(contact->wall_force + n * g, 0, (size_t)n * sizeof *contact->wall_force);
            memset(contact->wall_moment + n * g, 0, (size_t)n * sizeof *contact->wall_moment);
        }
    }
    work->n_kept = 0;
    work->n_kept_pairs = 0;
}

void mor_contact_add_sums(mor_contact *contact)
{
    contact->spring_energy = 0.0;
    contact->deepest = 0.0;
    for (int g = 0; g < contact->n_groups; ++g) {
        contact->spring_energy += contact->group_spring[g];
        contact->deepest = fmax(contact->deepest, contact->group_deepest[g]);
    }
    for (int w = 0; w < contact->n_walls; ++w) {
        mor_contact_wall_force(contact, w, ~(uint64_t)0, contact->walls[w].force);
    }
}

void mor_contact_apply_forces(mor_contact *contact, uint64_t members, double length)
{
    mor_contact_list_history(contact);
    clear_sums(contact, members);
    mor_contact_release_removed(contact, members);
    mor_contact_count_pairs(contact);
    for (int k = 0; k < contact->work->n_active; ++k) {
        apply_to_pair(contact, k, length);
    }
    mor_contact_release_history(contact, members);
    mor_contact_add_wall_energy(contact, members, length);
    mor_contact_add_sums(contact);
}
