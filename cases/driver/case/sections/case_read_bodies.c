/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The lists of bodies and rocks, and their contact. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Contact ----------------------------------------------------------------------------------------------------- */

enum { PARTNERS_MAX = MOR_CASE_BODIES_MAX + MOR_CASE_WALLS_MAX };

/* Names of what can touch, bodies first. */
static int list_partners(const mor_case *the_case, const char **names)
{
    int n = 0;
    for (int k = 0; k < the_case->n_bodies; ++k) {
        names[n++] = the_case->bodies[k].name;
    }
    for (int k = 0; k < the_case->n_walls; ++k) {
        names[n++] = the_case->walls[k].name;
    }
    return n;
}

static mor_status find_partner(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                               const char *name, int *partner)
{
    const char *names[PARTNERS_MAX];
    const int n_names = list_partners(the_case, names);
    for (*partner = 0; *partner < n_names; ++*partner) {
        if (strcmp(names[*partner], name) == 0) {
            return MOR_OK;
        }
    }
    return mor_case_reader_refuse(reader, node, "name of a body or a wall", names, n_names);
}

static bool is_same_pair(const mor_case_contact_pair *a, const mor_case_contact_pair *b)
{
    return (strcmp(a->first, b->first) == 0 && strcmp(a->second, b->second) == 0) ||
           (strcmp(a->first, b->second) == 0 && strcmp(a->second, b->first) == 0);
}

static mor_status check_pair(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                             const mor_case_contact_pair *pair)
{
    int first = 0;
    int second = 0;
    const mor_case_node *second_node = mor_case_node_find(node, "second");
    MOR_TRY(reader->context, find_partner(reader, mor_case_node_find(node, "first"), the_case, pair->first, &first));
    MOR_TRY(reader->context, find_partner(reader, second_node, the_case, pair->second, &second));
    if (first >= the_case->n_bodies && second >= the_case->n_bodies) {
        return MOR_CASE_NODE_FAIL(reader->context, second_node,
                                  "found a pair of two walls, '%s' and '%s', which do not touch; allowed: two bodies, "
                                  "or a body and a wall; name a body",
                                  pair->first, pair->second);
    }
    if (first == second) {
        return MOR_CASE_NODE_FAIL(reader->context, second_node,
                                  "found a pair of '%s' with itself; allowed: two bodies, or a body and a wall; name "
                                  "another",
                                  pair->first);
    }
    for (const mor_case_contact_pair *other = the_case->contact.pairs; other < pair; ++other) {
        if (is_same_pair(other, pair)) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the pair of '%s' and '%s' again; allowed: each pair once (line %d has "
                                      "it); remove one",
                                      pair->first, pair->second, other->place.line);
        }
    }
    return MOR_OK;
}

static mor_status read_pair(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                            mor_case_contact_pair *pair)
{
    mor_case_reader_place(node, &pair->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_pair_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_pair_group, pair));
    if (!mor_case_reader_has(&mor_case_pair_group, pair->written, "friction_coefficient")) {
        pair->friction_coefficient = the_case->contact.friction_coefficient;
    }
    if (!mor_case_reader_has(&mor_case_pair_group, pair->written, "restitution")) {
        pair->restitution = the_case->contact.restitution;
    }
    return check_pair(reader, node, the_case, pair);
}

static mor_status read_contact(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *node = mor_case_node_find(root, "contact");
    const mor_case_node *list = NULL;
    if (node != NULL) {
        MOR_TRY(reader->context, mor_case_reader_member(reader, root, "contact", MOR_CASE_NODE_GROUP, &node));
        MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_contact_group, NULL, NULL));
        if (the_case->n_bodies == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found 'contact', which has no effect in a case without bodies; allowed: with "
                                      "bodies; remove it or add bodies");
        }
    }
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_contact_group, &the_case->contact));
    MOR_TRY(reader->context, mor_case_reader_list(reader, node, "pairs", MOR_CASE_PAIRS_MAX, &list));
    for (const mor_case_node *k = list == NULL ? NULL : list->first_child; k != NULL; k = k->next) {
        mor_case_contact_pair *pair = &the_case->contact.pairs[the_case->contact.n_pairs++];
        MOR_TRY(reader->context, read_pair(reader, k, the_case, pair));
    }
    return MOR_OK;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

/* A velocity that a lock removes would differ from the case file; so would a lock that the placement rotates away from
 * its axis, because locks are along the axes of the run. */
static mor_status check_locks(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                              const mor_case_body *body)
{
    const mor_case_node *list = mor_case_node_find(node, "locked");
    for (int k = 0; k < MOR_CASE_LOCKS; ++k) {
        const int axis = k % 3;
        const bool is_rotation = k >= 3;
        if (!body->is_locked[k]) {
            continue;
        }
        if ((is_rotation ? body->angular_velocity : body->velocity)[axis] != 0.0) {
            const char *key = is_rotation ? "angular_velocity" : "velocity";
            return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, key),
                                      "found %s with a component that '%s' in locked removes; "
                                      "allowed: zero in locked directions; set it to zero or unlock it",
                                      key, mor_case_lock_words[k]);
        }
        for (int other = 0; other < 3; ++other) {
            if (!body->is_locked[k - axis + other] && the_case->rotation[3 * other + axis] != 0.0) {
                return MOR_CASE_NODE_FAIL(reader->context, list,
                                          "found '%s' in locked, which the rotation of placement moves away from "
                                          "its axis; allowed: locks that this rotation keeps together, such as along "
                                          "its axis or across it in both directions; change the locks or the rotation",
                                          mor_case_lock_words[k]);
            }
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_bodies(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "bodies", MOR_CASE_BODIES_MAX, &list));
    MOR_TRY(reader->context,
            MOR_NEW(reader->context, &the_case->bodies, list == NULL ? 0 : list->n_children, "bodies of a case"));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        /* Counted before it is read, so that a half-read one is freed, too. */
        mor_case_body *body = &the_case->bodies[the_case->n_bodies++];
        MOR_TRY(reader->context, mor_case_reader_body(reader, node, body));
        MOR_TRY(reader->context, mor_case_reader_frictions(reader, node, the_case, &body->friction_with));
        MOR_TRY(reader->context, mor_case_reader_height(reader, the_case, body));
        MOR_TRY(reader->context, mor_case_reader_body_name(reader, node, the_case, body));
        MOR_TRY(reader->context, check_locks(reader, node, the_case, body));
    }
    the_case->n_listed_bodies = the_case->n_bodies;
    MOR_TRY(reader->context, mor_case_reader_rocks(reader, root, the_case));
    return read_contact(reader, root, the_case);
}
