/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_CONTACT_WORK_H
#define MOR_BODIES_CONTACT_WORK_H

#include "bodies/body_surface.h"
#include "bodies/contact.h"

/** @file
 *  What the files of contact share: lists, bounds and scratch. Nothing here is state: all of it is found anew after a
 *  resume, and no result depends on when. */

enum {
    MOR_CONTACT_SLOTS = 3,   /* partners whose friction a node remembers */
    MOR_CONTACT_SUPPORT = 96 /* particles of an elastic body around a point, at most */
};

/** A body in the list of all bodies. */
typedef struct mor_contact_body {
    mor_body_group *group;
    int group_index;
    int body;         /* in its group */
    double half[3];   /* half the sides of the box of its nodes, reference configuration, m */
    double middle[3]; /* of that box, from the center of mass, m */
    double radius;    /* half its diagonal plus the distance of the middle, m */
    double face;      /* largest side of its box in the shape's frame, m2 (m) */
    double softness;  /* elastic: squared frequency over stiffness per area, at most; m2/kg */
    double travel;    /* bound of the path of any of its points so far, m */
    double *previous; /* shape [n_particles, 3] of an elastic body, else [12]: where it was at the last look, m and 1 */
    bool is_seen;     /* previous is valid */
    mor_tree tree;    /* of an elastic body's particles */
    double tree_travel; /* travel when the tree was fitted, m; below zero: never */
    bool is_observed;   /* the following are valid for this evaluation */
    double center[3];   /* m */
    double velocity[3]; /* m/s */
    double spin[3];     /* rad/s */
    double inertia[6];  /* symmetric tensor, kg m2 (kg m) */
} mor_contact_body;

/** Nodes of one body that are near another body or a wall. */
typedef struct mor_contact_lane {
    double limit;   /* the list holds until the pair has traveled so far, m */
    int64_t *nodes; /* shape [capacity]; the first n_nodes are in use; in their group */
    int64_t n_nodes, capacity;
} mor_contact_lane;

/** A pair that is near. Nodes of the first against the second, then the other way round; walls have no nodes. */
typedef struct mor_contact_near {
    int first, second; /* bodies; second >= n_bodies: wall second - n_bodies */
    int64_t pair;
    mor_contact_lane lanes[2];
} mor_contact_near;

/** One node against one body or wall. */
typedef struct mor_contact_touch {
    int near;          /* index in the list of near pairs */
    int side;          /* 0: node of the first; 1: of the second */
    int64_t node;      /* in its group */
    double gap;        /* negative: depth, m */
    double place[3];   /* m */
    double normal[3];  /* out of the partner, 1 */
    double slip[3];    /* velocity of the node minus that of the partner's surface, m/s */
    double stiffness;  /* N/m (N/m2) */
    int support_count; /* particles of an elastic partner */
} mor_contact_touch;

/** Lists and scratch. */
typedef struct mor_contact_work {
    mor_contact_body *bodies; /* shape [n_bodies] */
    double *boxes;            /* shape [n_bodies, 6]; around each body at the last look; minimum, maximum, m */
    double *speeds;           /* shape [n_bodies]; scratch, m/s */
    int n_bodies;
    int first_body[MOR_BODY_GROUPS_MAX];     /* of each group */
    int64_t first_node[MOR_BODY_GROUPS_MAX]; /* of each group in the history */
    double wall_travel;                      /* bound of the path of any wall so far, m */
    double *free_until;                      /* shape [n_pairs]; a pair is apart until it has traveled so far, m */
    int32_t *near_of;                        /* shape [n_pairs]; place in near plus one; 0: not near */
    unsigned char *law_of;                   /* shape [n_pairs]; 0: default, else listed pair plus one */
    int64_t n_pairs;
    mor_contact_near *near; /* shape [near_capacity]; entries without pair are free */
    int n_near, near_capacity;
    double rebound[MOR_CONTACT_PAIRS_MAX + 1]; /* y of each law, docs/theory/contact.md, 1 */
    int *active;                               /* shape [near_capacity]; near pairs of this evaluation, by pair */
    int n_active;
    int64_t *first_touch; /* shape [near_capacity + 1]; touches of each active pair */
    mor_contact_touch *touches;
    int32_t *support_particles; /* shape [touch_capacity, MOR_CONTACT_SUPPORT] */
    double *support_weights;    /* likewise, 1 */
    int64_t n_touches, touch_capacity;
    int64_t *held_slots, *kept_slots; /* shape [SLOTS * n_nodes]; slots in use, before and in this evaluation */
    int64_t n_held, n_kept;
    unsigned char *slot_mark;        /* shape [SLOTS * n_nodes]; 1: in kept_slots */
    int64_t *hit_pairs, *kept_pairs; /* shape [n_pairs]; pairs with an impact speed, before and in this evaluation */
    int64_t n_hit, n_kept_pairs;
    unsigned char *pair_mark;                  /* shape [n_pairs] */
    bool is_warm;                              /* the lists of slots and pairs have been found from the state */
    double group_spring[MOR_BODY_GROUPS_MAX];  /* spring energy, J (J/m) */
    double group_deepest[MOR_BODY_GROUPS_MAX]; /* m */
    double *wall_force;                        /* shape [MOR_BODY_GROUPS_MAX, n_walls, 3], N (N/m) */
    int field_partners, field_springs;         /* of the history */
} mor_contact_work;

/** Index of a pair of bodies, first < second; or of a body and wall second - n_bodies.
 *  @param contact [in]  one object
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
static inline int64_t mor_contact_pair_index(const mor_contact *contact, int first, int second)
{
    const int64_t n = contact->work->n_bodies + contact->n_walls;
    return (int64_t)first * n - (int64_t)first * (first + 1) / 2 + (second - first - 1);
}

/** How easily a body is moved by a force: one over its mass, zero for a held one and for walls; unit 1/kg (m/kg).
 *  @param contact [in]  one object
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
static inline double mor_contact_inverse_mass(const mor_contact *contact, int second)
{
    if (second >= contact->work->n_bodies) {
        return 0.0;
    }
    const mor_contact_body *c = &contact->work->bodies[second];
    const mor_body *body = &c->group->bodies[c->body];
    return body->is_held ? 0.0 : 1.0 / body->mass;
}

/** Stiffness of a pair per area: harmonic mean of contact modulus over spacing; against a wall the body's own.
 *  @param contact [in]  one object
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall
 *  Returns: unit Pa/m. */
double mor_contact_bedding(const mor_contact *contact, int first, int second);

/** Stiffness of one node of a pair, unit N/m (N/m2 in plane strain).
 *  @param contact [in]  one object
 *  @param near    [in]  one object
 *  @param side    [in]  0: node of the first; 1: of the second
 *  @param node    [in]  index of the node in its group */
double mor_contact_stiffness(const mor_contact *contact, const mor_contact_near *near, int side, int64_t node);

/** Finds boxes and travels of the bodies of the members.
 *  @param context [in]      one object
 *  @param contact [in,out]  one object
 *  @param members [in]      bits of steppers */
void mor_contact_observe(mor_context *context, mor_contact *contact, uint64_t members);

/** Box and largest speed of a body now.
 *  @param body  [in]   one object
 *  @param box   [out]  shape [6]; minimum, maximum; unit m
 *  @param speed [out]  one number, unit m/s */
void mor_contact_box(const mor_contact_body *body, double *box, double *speed);

/** Lower bound of the gap of a pair, unit m.
 *  @param contact [in]  one object
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall
 *  @param boxes   [in]  shape [n_bodies, 6]; boxes as mor_contact_box gives them, unit m */
double mor_contact_apart(const mor_contact *contact, int first, int second, const double *boxes);

/** Brings the lists of near pairs and nodes up to date, and lists the touches to look at.
 *  @param context [in,out]  one object
 *  @param contact [in,out]  one object
 *  @param members [in]      bits of steppers
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_contact_search(mor_context *context, mor_contact *contact, uint64_t members);

/** Looks one node up in its partner: fills in gap and, when that is below zero or is_whole, all else.
 *  @param contact   [in]      one object
 *  @param near      [in]      one object
 *  @param touch     [in,out]  one object; near, side and node are set
 *  @param is_whole  [in]      also fill in what only touching nodes need
 *  @param particles [out]     shape [MOR_CONTACT_SUPPORT]; of an elastic partner
 *  @param weights   [out]     shape [MOR_CONTACT_SUPPORT], unit 1 */
void mor_contact_look_up(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch,
                         bool is_whole, int32_t *particles, double *weights);

/** Turns touches into forces, pair by pair; keeps the books.
 *  @param contact [in,out]  one object
 *  @param members [in]      bits of steppers
 *  @param length  [in]      of the sub-step, unit s */
void mor_contact_act(mor_contact *contact, uint64_t members, double length);

/** Returns the group of a body or NULL for a wall.
 *  @param contact [in]  one object
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
static inline mor_body_group *mor_contact_group(const mor_contact *contact, int second)
{
    return second < contact->work->n_bodies ? contact->work->bodies[second].group : NULL;
}

#endif
