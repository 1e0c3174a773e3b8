/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How deep surfaces may lie in one another: docs/theory/contact.md, "How deep". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"

#include <math.h>

/* Depth that stops a run: a share of the spacing, or of the thickness of the thinner body where that is more. */
#define LIMIT_SPACINGS 0.5
#define LIMIT_THICKNESS 0.05

/* Share of that limit that is warned of: a tenth of a spacing. */
#define WARNING_SHARE 0.2

/* Curvature of a wall, times spacing, from which on it is checked for an edge, 1. */
#define EDGE_BEND 0.05
/* Sine of half the bend of an edge that is reported, 20 degrees; natural ground has many that bend less. */
#define EDGE_SHARP 0.17

/* Least side of the box around a body, m. */
static double thickness(const mor_contact_body *c)
{
    double least = INFINITY;
    for (int a = 0; a < c->group->dimension; ++a) {
        least = fmin(least, 2.0 * c->half[a]);
    }
    return least;
}

double mor_contact_depth_limit(const mor_contact *contact, int first, int second)
{
    const mor_contact_work *work = contact->work;
    const double thin = second < work->n_bodies
                            ? fmin(thickness(&work->bodies[first]), thickness(&work->bodies[second]))
                            : thickness(&work->bodies[first]);
    return fmax(LIMIT_SPACINGS * mor_contact_spacing(contact, first, second), LIMIT_THICKNESS * thin);
}

/* Index of the second side, of walls that are touched as one the part at a place. */
static int find_second(const mor_contact *contact, const mor_contact_near *near, const double *place)
{
    const int n_bodies = contact->work->n_bodies;
    return near->second < n_bodies ? near->second
                                   : n_bodies + mor_contact_find_part(contact, near->second - n_bodies, place);
}

void mor_contact_note_depth(mor_contact *contact, const mor_contact_near *near, double depth, const double *place)
{
    mor_contact_work *work = contact->work;
    const int group = work->bodies[near->first].group_index;
    const double limit = mor_contact_depth_limit(contact, near->first, near->second);
    mor_contact_depth *worst = &work->group_worst[group];
    contact->group_deepest[group] = fmax(contact->group_deepest[group], depth);
    if (depth * worst->limit > worst->depth * limit || worst->limit == 0.0) {
        *worst = (mor_contact_depth){near->first, find_second(contact, near, place), depth, limit};
    }
}

void mor_contact_note_driven(mor_contact *contact, const mor_contact_near *near, int64_t begin, int64_t end)
{
    mor_contact_work *work = contact->work;
    for (int64_t k = begin; k < end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        const bool is_moving = touch->depth > 0.0 && mor_vector_dot(touch->slip, touch->slip) > 0.0;
        if (is_moving && touch->depth > work->driven.depth) {
            work->driven = (mor_contact_depth){near->first, near->second, touch->depth,
                                               mor_contact_depth_limit(contact, near->first, near->second)};
        }
    }
}

void mor_contact_note_edge(mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch)
{
    mor_contact_work *work = contact->work;
    const double spacing = mor_contact_spacing(contact, near->first, near->second);
    if (near->second < work->n_bodies || work->edge.is_found || !(fabs(touch->other_curvature) * spacing > EDGE_BEND)) {
        return;
    }
    const mor_contact_wall *wall = &contact->walls[near->second - work->n_bodies];
    double place[3], normal[3];
    mor_contact_wall_place(contact, wall, touch->place, place);
    if (mor_contact_has_edge(mor_contact_wall_shape(wall), contact->groups[0]->dimension, place, spacing, EDGE_SHARP,
                             normal)) {
        work->edge = (mor_contact_edge){
            .first = near->first,
            .second = find_second(contact, near, touch->place),
            .place = {touch->place[0], touch->place[1], touch->place[2]},
            .is_found = true,
        };
    }
}

/* A side of a pair in words. */
static void name_side(const mor_contact *contact, int side, const char **kind, const char **name)
{
    const mor_contact_work *work = contact->work;
    const bool is_wall = side >= work->n_bodies;
    *kind = is_wall ? "wall" : "body";
    *name = is_wall ? contact->walls[side - work->n_bodies].name
                    : work->bodies[side].group->bodies[work->bodies[side].body].name;
}

/* No contact force acts between sides that no force moves, as a body that is driven into a wall. */
static void warn_of_driven(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const mor_contact_depth *it = &work->driven;
    if (contact->driven_share > 0.0 || !(it->depth > 0.0) || !(it->depth > WARNING_SHARE * it->limit)) {
        return;
    }
    const char *kind, *name, *other_kind, *other_name;
    name_side(contact, it->first, &kind, &name);
    name_side(contact, it->second, &other_kind, &other_name);
    contact->driven_share = it->depth / it->limit;
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s '%s' is driven %.3g m deep into %s '%s' at t = %.6g s; forces move neither, so that no contact "
                    "force acts between them: shorten the prescribed motion if that is not intended",
                    kind, name, it->depth, other_kind, other_name, contact->time);
}

/* Walls have no nodes: where an edge of a wall touches a body between its nodes, forces act at these nodes, along the
 * faces of the wall. */
static void warn_of_edge(mor_context *context, mor_contact *contact)
{
    mor_contact_edge *it = &contact->work->edge;
    if (!it->is_found || it->is_told) {
        return;
    }
    const char *kind, *name, *other_kind, *other_name;
    name_side(contact, it->first, &kind, &name);
    name_side(contact, it->second, &other_kind, &other_name);
    it->is_told = true;
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s '%s' touches %s '%s' at an edge or a corner, (%.4g, %.4g, %.4g) m, at t = %.6g s; contact with "
                    "walls is computed along their faces, so that it may rebound or rotate wrongly there: use a finer "
                    "spacing, or, if '%s' lies within the domain, make it a body with motion = \"prescribed\"",
                    kind, name, other_kind, other_name, it->place[0], it->place[1], it->place[2], contact->time,
                    other_name);
}

mor_status mor_contact_check_depth(mor_context *context, mor_contact *contact)
{
    const mor_contact_depth *worst = &contact->work->group_worst[0];
    warn_of_driven(context, contact);
    warn_of_edge(context, contact);
    for (int g = 1; g < contact->n_groups; ++g) {
        const mor_contact_depth *it = &contact->work->group_worst[g];
        if (it->limit > 0.0 && (worst->limit == 0.0 || it->depth * worst->limit > worst->depth * it->limit)) {
            worst = it;
        }
    }
    if (worst->limit == 0.0) {
        return MOR_OK;
    }
    const double share = worst->depth / worst->limit;
    const bool is_new = share > WARNING_SHARE && contact->deepest_share <= WARNING_SHARE;
    contact->deepest_share = fmax(contact->deepest_share, share);
    if (!is_new && share <= 1.0) {
        return MOR_OK;
    }
    const char *kind, *name, *other_kind, *other_name;
    name_side(contact, worst->first, &kind, &name);
    name_side(contact, worst->second, &other_kind, &other_name);
    const double spacing = mor_contact_spacing(contact, worst->first, worst->second);
    MOR_CHECK(context, share <= 1.0, MOR_ERROR_NUMERIC,
              "%s '%s' lies %.3g m deep in %s '%s' at t = %.6g s, %.2g spacings; allowed is up to %.3g m, half a "
              "spacing or a twentieth of the thickness of the body; raise contact_modulus, or lower what presses them "
              "together",
              kind, name, worst->depth, other_kind, other_name, contact->time, worst->depth / spacing, worst->limit);
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s '%s' lies %.3g m deep in %s '%s' at t = %.6g s, %.2g spacings; below a tenth of a spacing is "
                    "advisable, and above %.3g m the run stops: raise contact_modulus if it was not the material's own",
                    kind, name, worst->depth, other_kind, other_name, contact->time, worst->depth / spacing,
                    worst->limit);
    return MOR_OK;
}
