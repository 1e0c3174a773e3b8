/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How long a step contact allows: docs/theory/contact.md, "How long a step may be". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"

/* Share of 1/frequency of a body on the springs of its contacts that a step may take, 1. */
#define STEP_SHARE 0.2

/* Likewise of rigid sides, whose stiffness is that of the contact and not a bound: some thirty steps an impact. */
#define HERTZ_SHARE 0.1

/* Likewise of the particles under the nodes of an elastic body: on top of the body's own waves. */
#define LAYER_SHARE 1.0

/* A pair limits the step when it could touch within so many such steps. */
#define STEPS_AHEAD 256.0

void mor_contact_find_boxes(const mor_contact *contact, double *speeds)
{
    mor_contact_work *work = contact->work;
    for (int b = 0; b < work->n_bodies; ++b) {
        mor_contact_box(&work->bodies[b], work->boxes + 6 * (int64_t)b, &speeds[b]);
    }
}

/* Earliest time at which two bodies can touch, at their speeds and under gravity. */
static double time_apart(double gap, double speed, double gravity)
{
    return gap <= 0.0 ? 0.0 : gap / (speed + sqrt(gravity * gap));
}

/* Squared frequency of a pair, but for its damping: stiffness over mass, 1/s2. */
static double pair_rate2(const mor_contact *contact, int own, int other, double speed)
{
    const mor_contact_work *work = contact->work;
    const int first = own < other ? own : other;
    const int second = own < other ? other : own;
    const mor_contact_body *c = &work->bodies[own];
    const double inverse = mor_contact_inverse_mass(contact, own) + mor_contact_inverse_mass(contact, other);
    if (!mor_contact_is_hertzian(contact, first, second)) {
        const double face =
            second < work->n_bodies ? fmin(work->bodies[first].face, work->bodies[second].face) : c->face;
        return mor_contact_area_stiffness(contact, first, second) * face * inverse;
    }
    /* What the pair may store: its motion now, or a fall over its size. At the turning point of an impact, where
     * nothing moves, the stiffness is underestimated by its third to fifth root at most. */
    const double fall = 2.0 * mor_contact_gravity(c) * 2.0 * c->radius;
    const double energy = 0.5 * (speed * speed + fall) / inverse;
    const double finer = STEP_SHARE / HERTZ_SHARE;
    return finer * finer * mor_contact_largest_stiffness(contact, first, second, energy) * inverse;
}

/* Whether two rigid sides are too far apart to matter, whatever the stiffness: most pairs of many bodies are. */
static bool is_far(const mor_contact *contact, int own, int other, double apart)
{
    const int first = own < other ? own : other;
    const int second = own < other ? other : own;
    if (!mor_contact_is_hertzian(contact, first, second)) {
        return false;
    }
    const double inverse = mor_contact_inverse_mass(contact, own) + mor_contact_inverse_mass(contact, other);
    const double rate2 = mor_contact_least_stiffness(contact, first, second) * inverse;
    return apart * apart * rate2 > STEPS_AHEAD * STEPS_AHEAD * HERTZ_SHARE * HERTZ_SHARE;
}

/* The step that the contact of one pair allows. `rate2` gathers the squared frequencies of a body's pairs. */
static double limit_pair(const mor_contact *contact, int own, int other, double gap, double speed, double *rate2)
{
    const mor_contact_work *work = contact->work;
    const int first = own < other ? own : other;
    const int second = own < other ? other : own;
    const mor_contact_body *c = &work->bodies[own];
    const double y = work->rebound[work->law_of[mor_contact_pair_index(contact, first, second)]];
    const double apart = time_apart(gap, speed, mor_contact_gravity(c));
    if (is_far(contact, own, other, apart)) {
        return 0.25 * apart;
    }
    const double own_rate2 = pair_rate2(contact, own, other, speed) * (1.0 + y);
    double step = STEP_SHARE / sqrt(own_rate2);
    if (c->group->operations->is_deformable) {
        step = LAYER_SHARE / sqrt(mor_contact_area_stiffness(contact, first, second) * c->softness * (1.0 + y));
    }
    if (apart > STEPS_AHEAD * step) {
        return 0.25 * apart;
    }
    if (!c->group->operations->is_deformable) {
        *rate2 += own_rate2;
    }
    return step;
}

/* Longest step of a group as its bodies lie, or as if each pair by itself were in touch. */
static double find_longest(const mor_contact *contact, const mor_body_group *group, bool is_touching)
{
    const mor_contact_work *work = contact->work;
    double *speeds = work->speeds;
    double longest = INFINITY;
    mor_contact_find_boxes(contact, speeds);
    for (int own = 0; own < work->n_bodies; ++own) {
        if (work->bodies[own].group != group || !mor_contact_is_side(contact, own)) {
            continue;
        }
        double rate2 = 0.0;
        for (int other = 0; other < work->n_bodies + contact->n_walls; ++other) {
            if (other == own || !mor_contact_is_side(contact, other) ||
                mor_contact_inverse_mass(contact, own) + mor_contact_inverse_mass(contact, other) == 0.0) {
                continue;
            }
            const bool is_wall = other >= work->n_bodies;
            const double speed =
                speeds[own] +
                (is_wall ? mor_contact_wall_speed(&contact->walls[other - work->n_bodies]) : speeds[other]);
            const int first = own < other ? own : other;
            const int second = own < other ? other : own;
            const double gap = is_touching ? 0.0 : mor_contact_apart(contact, first, second, work->boxes);
            longest = fmin(longest, limit_pair(contact, own, other, gap, speed, &rate2));
        }
        /* No body touches all others at once. */
        longest = rate2 > 0.0 && !is_touching ? fmin(longest, STEP_SHARE / sqrt(rate2)) : longest;
    }
    return longest;
}

double mor_contact_longest_step(const void *owner, const mor_body_group *group)
{
    return find_longest(owner, group, false);
}

double mor_contact_touching_step(const void *owner, const mor_body_group *group)
{
    return fmin(find_longest(owner, group, false), find_longest(owner, group, true));
}
