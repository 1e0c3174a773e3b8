/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How long a step contact allows: docs/theory/contact.md, "How long a step may be". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

/* Share of 1/frequency of a body on the springs of its contacts that a step may take, 1. */
#define STEP_SHARE 0.2

/* Likewise of rigid sides, whose stiffness is that of the contact and not a bound: some thirty steps an impact. */
#define HERTZ_SHARE 0.1

/* Likewise of the particles under the nodes of an elastic body: on top of the body's own waves. */
#define LAYER_SHARE 1.0

/* A pair limits the step when it could touch within so many such steps. */
#define STEPS_AHEAD 256.0

void mor_contact_find_boxes(mor_context *context, const mor_contact *contact, double *speeds)
{
    mor_contact_work *work = contact->work;
    MOR_PARALLEL_FOR (context, b, work->n_bodies, 4) {
        mor_contact_box(&work->bodies[b], work->boxes + 6 * b, &speeds[b]);
    }
}

/* Earliest time at which two bodies can touch, at their speeds and under gravity. */
static double time_apart(double gap, double speed, double gravity)
{
    return gap <= 0.0 ? 0.0 : gap / (speed + sqrt(gravity * gap));
}

/* Two sides of which the step of one is looked for. */
typedef struct pair {
    const mor_contact *contact;
    int own, first, second; /* the smaller number first */
    double inverse;         /* of their masses, 1/kg (m/kg) */
} pair;

/* Squared frequency of a pair, but for its damping: stiffness over mass, 1/s2. */
static double pair_rate2(const pair *p, double speed)
{
    const mor_contact_work *work = p->contact->work;
    const mor_contact_body *c = &work->bodies[p->own];
    if (!mor_contact_is_hertzian(p->contact, p->first, p->second)) {
        const double face =
            p->second < work->n_bodies ? mor_min(work->bodies[p->first].face, work->bodies[p->second].face) : c->face;
        return mor_contact_area_stiffness(p->contact, p->first, p->second) * face * p->inverse;
    }
    /* What the pair may store: its motion now, or a fall over its size. At the turning point of an impact, where
     * nothing moves, the stiffness is underestimated by its third to fifth root at most. */
    const double energy = 0.5 * (speed * speed + 4.0 * mor_contact_gravity(c) * c->radius) / p->inverse;
    const double finer = STEP_SHARE / HERTZ_SHARE;
    return finer * finer * mor_contact_largest_stiffness(p->contact, p->first, p->second, energy) * p->inverse;
}

/* The step that the contact of one pair allows. `rate2` gathers the squared frequencies of a body's pairs. */
static double limit_pair(const pair *p, double gap, double speed, double *rate2)
{
    const mor_contact_work *work = p->contact->work;
    const mor_contact_body *c = &work->bodies[p->own];
    const double y = work->rebound[work->law_of[mor_contact_pair_index(p->contact, p->first, p->second)]];
    const double apart = time_apart(gap, speed, mor_contact_gravity(c));
    /* Rigid sides too far apart to matter, whatever the stiffness: most pairs of many bodies are. */
    if (mor_contact_is_hertzian(p->contact, p->first, p->second) &&
        apart * sqrt(mor_contact_least_stiffness(p->contact, p->first, p->second) * p->inverse) >
            STEPS_AHEAD * HERTZ_SHARE) {
        return 0.25 * apart;
    }
    double step;
    double own_rate2 = 0.0;
    if (c->group->operations->is_deformable) {
        step =
            LAYER_SHARE / sqrt(mor_contact_area_stiffness(p->contact, p->first, p->second) * c->softness * (1.0 + y));
    } else {
        own_rate2 = pair_rate2(p, speed) * (1.0 + y);
        step = STEP_SHARE / sqrt(own_rate2);
    }
    if (apart > STEPS_AHEAD * step) {
        return 0.25 * apart;
    }
    *rate2 += own_rate2;
    return step;
}

/* Longest step of one body as all lie, or as if each pair by itself were in touch. */
static double find_longest_of(const mor_contact *contact, int own, bool is_touching)
{
    const mor_contact_work *work = contact->work;
    double longest = INFINITY;
    double rate2 = 0.0;
    for (int other = 0; other < work->n_bodies + contact->n_walls; ++other) {
        const pair p = {contact, own, own < other ? own : other, own < other ? other : own,
                        mor_contact_inverse_mass(contact, own) + mor_contact_inverse_mass(contact, other)};
        if (other == own || !mor_contact_is_side(contact, other) || p.inverse == 0.0) {
            continue;
        }
        const bool is_wall = other >= work->n_bodies;
        const double speed =
            work->speeds[own] +
            (is_wall ? mor_contact_wall_speed(&contact->walls[other - work->n_bodies]) : work->speeds[other]);
        const double gap = is_touching ? 0.0 : mor_contact_apart(contact, p.first, p.second, work->boxes);
        const double step = limit_pair(&p, gap, speed, &rate2);
        longest = step < longest ? step : longest;
    }
    /* No body touches all others at once. */
    return rate2 > 0.0 && !is_touching ? fmin(longest, STEP_SHARE / sqrt(rate2)) : longest;
}

static double find_longest(mor_context *context, const mor_contact *contact, const mor_body_group *group,
                           bool is_touching)
{
    const mor_contact_work *work = contact->work;
    mor_contact_find_boxes(context, contact, work->speeds);
    MOR_PARALLEL_FOR (context, own, work->n_bodies, 4) {
        const bool is_counted = work->bodies[own].group == group && mor_contact_is_side(contact, (int)own);
        work->longest[own] = is_counted ? find_longest_of(contact, (int)own, is_touching) : INFINITY;
    }
    double longest = INFINITY;
    for (int own = 0; own < work->n_bodies; ++own) {
        longest = fmin(longest, work->longest[own]);
    }
    return longest;
}

double mor_contact_longest_step(mor_context *context, const void *owner, const mor_body_group *group)
{
    return find_longest(context, owner, group, false);
}

double mor_contact_touching_step(mor_context *context, const void *owner, const mor_body_group *group)
{
    return fmin(find_longest(context, owner, group, false), find_longest(context, owner, group, true));
}
