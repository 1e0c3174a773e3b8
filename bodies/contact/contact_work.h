/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_CONTACT_CONTACT_WORK_H
#define MOR_BODIES_CONTACT_CONTACT_WORK_H

#include "bodies/body_surface.h"
#include "bodies/contact/contact.h"
#include "core/base/math.h"

#include <string.h>

/** @file
 *  What the files of contact share: lists, bounds and scratch. None of it is state: it is found anew on a resume, and
 *  no result depends on when. */

enum {
    MOR_CONTACT_SLOTS = 3,    /* partners of a node whose friction springs are kept */
    MOR_CONTACT_SUPPORT = 96, /* particles of an elastic body around a point, at most */
    MOR_CONTACT_WINDOW = 21   /* points across the surface around a node */
};

/** A body in the list of all bodies. */
typedef struct mor_contact_body {
    mor_body_group *group;
    int group_index;
    int body;                  /* in its group */
    double half[3];            /* half the sides of the box of its nodes, reference configuration, m */
    double middle[3];          /* of that box, from the center of mass, m */
    double radius;             /* half its diagonal plus the distance of the middle, m */
    double face;               /* largest side of its box in the shape's frame, m2 (m) */
    double softness;           /* elastic: squared frequency over stiffness per area, at most; m2/kg */
    double curvature;          /* rigid: median over its nodes, 1/m */
    double sharpest, flattest; /* rigid: largest and least curvature of its nodes, 1/m */
    double mean_weight;        /* rigid: mean stiffness per area of its nodes over that of the sharpest, 1 */
    double inverse_inertia[6]; /* rigid: symmetric tensor about the center, reference configuration, 1/(kg m2) */
    int n_touching;            /* pairs of it that touch in this evaluation */
    bool is_edged;             /* rigid: some nodes lie on edges or corners */
    double travel;             /* bound of the path of any of its points so far, m */
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
    double *clear;  /* shape [capacity]; of each node: it cannot touch until the pair has traveled so far, m */
    int64_t n_nodes, capacity;
} mor_contact_lane;

/** A pair that is near. Nodes of the first against the second, then the other way round; walls have no nodes. */
typedef struct mor_contact_near {
    int first, second; /* bodies; second >= n_bodies: wall second - n_bodies */
    int64_t pair;
    double travel; /* bound of the path of its points against each other so far, m */
    mor_contact_lane lanes[2];
} mor_contact_near;

/** One node against one body or wall. */
typedef struct mor_contact_touch {
    int near;                          /* index in the list of near pairs */
    int side;                          /* 0: node of the first; 1: of the second */
    int64_t node;                      /* in its group */
    int64_t entry;                     /* place of the node in its lane */
    double clearance;                  /* it cannot touch until the pair has traveled so much more, m; 0: unknown */
    double gap;                        /* of the node; negative: depth, m */
    double curvature, other_curvature; /* of the node's surface and of the other one there, 1/m */
    double depth;                      /* deepest point of the surface around the node, m; 0: no touch */
    double mean_depth;                 /* over the area of the node, m */
    double mean_square;                /* of the depth over that area, m2 */
    double place[3];                   /* m */
    double normal[3];                  /* out of the partner, 1 */
    double slip[3];                    /* velocity of the node minus that of the partner's surface, m/s */
    double stiffness;                  /* tangential, and normal before softening but for share, N/m (N/m2) */
    double share;                      /* normal stiffness before softening over the tangential one, 1 */
    int support_count;                 /* particles of an elastic partner */
    bool is_followed;                  /* the surface around the node was, and place lies where it touches */
} mor_contact_touch;

/** How deep two surfaces lie in one another. */
typedef struct mor_contact_depth {
    int first, second; /* bodies; second >= n_bodies: wall second - n_bodies */
    double depth;      /* m */
    double limit;      /* deepest that is allowed, m */
} mor_contact_depth;

/** Where a body first touched a wall at its edge. */
typedef struct mor_contact_edge {
    int first, second; /* body, and n_bodies plus the wall */
    double place[3];   /* m */
    bool is_found, is_told;
} mor_contact_edge;

/** Lists and scratch. */
typedef struct mor_contact_work {
    mor_contact_body *bodies; /* shape [n_bodies] */
    double *boxes;            /* shape [n_bodies, 6]; around each body at the last look; minimum, maximum, m */
    double *speeds;           /* shape [n_bodies]; scratch, m/s */
    double *longest;          /* shape [n_bodies]; scratch, s */
    int n_bodies;
    int first_body[MOR_BODY_GROUPS_MAX];     /* of each group */
    int64_t first_node[MOR_BODY_GROUPS_MAX]; /* of each group in the history */
    double wall_travel;                      /* bound of the path of any wall so far, m */
    double *free_until;                      /* shape [n_pairs]; a pair is apart until it has traveled so far, m */
    int32_t *near_of;                        /* shape [n_pairs]; place in near plus one; 0: not near */
    double *curvatures;                      /* shape [n_nodes] as the history; zero for elastic bodies, 1/m */
    double *normals;                         /* shape [n_nodes, 3]; of rigid bodies, reference configuration, 1 */
    double *node_distances;                  /* shape [n_nodes]; level set of a rigid body at its nodes, m */
    unsigned char *is_smooth;                /* shape [n_nodes]; of rigid bodies: not on an edge or a corner */
    int64_t *first_neighbor;                 /* shape [n_nodes + 1]; of each smooth node in neighbors */
    int32_t *neighbors;                /* shape [first_neighbor[n_nodes]]; nodes around smooth ones, in their group */
    double window[MOR_CONTACT_WINDOW]; /* weights of points around a node, 1 */
    unsigned char *law_of;             /* shape [n_pairs]; 0: default, else listed pair plus one */
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
    unsigned char *pair_mark; /* shape [n_pairs] */
    bool is_warm;             /* the lists of slots and pairs have been found from the state */
    mor_contact_depth group_worst[MOR_BODY_GROUPS_MAX]; /* the deepest for its limit */
    mor_contact_edge edge;
    mor_contact_depth driven;          /* deepest so far of sides that no force moves */
    int field_partners, field_springs; /* of the history */
} mor_contact_work;

/** Shows a checked run what contact remembers; see mor_body_group.visit_contact.
 *  @param owner [in]      a mor_contact
 *  @param visit [in]      called for each array
 *  @param job   [in,out]  handed to visit */
void mor_contact_visit(const void *owner, mor_shared_visit visit, void *job);

/** Index of a pair of bodies, first < second; or of a body and wall second - n_bodies.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
static inline int64_t mor_contact_pair_index(const mor_contact *contact, int first, int second)
{
    const int64_t n = contact->work->n_bodies + contact->n_walls;
    return (int64_t)first * n - (int64_t)first * (first + 1) / 2 + (second - first - 1);
}

/** Inverse mass of a body: zero for a held one and for walls; unit 1/kg (m/kg).
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

/** The larger spacing of a pair, unit m.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
double mor_contact_spacing(const mor_contact *contact, int first, int second);

/** Whether a pair of rigid bodies, or a rigid body and a wall, touches by Hertz's law; elastic bodies deform by
 *  themselves.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
bool mor_contact_is_hertzian(const mor_contact *contact, int first, int second);

/** Modulus of a pair of rigid sides, 1 / ((1 - nu1^2)/E1 + (1 - nu2^2)/E2), Johnson (1985) eq. 4.3a; unit Pa.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
double mor_contact_pair_modulus(const mor_contact *contact, int first, int second);

/** Stiffness of a pair per area. With an elastic side: harmonic mean of contact modulus over spacing; against a wall
 *  the body's own. Rigid: that of the node where the surface is most curved, before the contact is wider than a node.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall
 *  Returns: unit Pa/m. */
double mor_contact_area_stiffness(const mor_contact *contact, int first, int second);

/** Stiffness of one node of a pair, unit N/m (N/m2 in plane strain); it depends on nothing that moves.
 *  @param side    [in]  0: node of the first; 1: of the second
 *  @param node    [in]  index of the node in its group */
double mor_contact_stiffness(const mor_contact *contact, const mor_contact_near *near, int side, int64_t node);

/** Fills in curvature and share of a touch of rigid sides from the curvature of the other side at a place on it.
 *  @param curvature [in]      of the other side there, unit 1/m */
void mor_contact_set_curvature(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch,
                               double curvature);

/** Distance of a point from the surface of a shape, that of the union where parts overlap; unit m, negative inside.
 *  @param dimension [in]   2 or 3
 *  @param place     [in]   shape [3]; in the frame of the shape, unit m
 *  @param spacing   [in]   of the body that asks, unit m
 *  @param normal    [out]  shape [3]; outward, unit 1; may be NULL */
double mor_contact_shape_gap(const mor_shape *shape, int dimension, const double *place, double spacing,
                             double *normal);

/** Whether a surface has an edge within a reach of windows around a point near it: there its gradient changes.
 *  @param dimension [in]   2 or 3
 *  @param place     [in]   shape [3]; in the frame of the shape, unit m
 *  @param spacing   [in]   of the body that asks, unit m
 *  @param limit     [in]   difference of the gradients from which on it is an edge: the sine of half its bend, unit 1
 *  @param normal    [out]  shape [3]; the gradient at the point brought to length 1, unit 1 */
bool mor_contact_has_edge(const mor_shape *shape, int dimension, const double *place, double spacing, double limit,
                          double *normal);

/** Curvature of a surface at a point near it, mean of the two in space, unit 1/m; positive: convex.
 *  @param dimension [in]  2 or 3
 *  @param place     [in]  shape [3]; in the frame of the shape, unit m
 *  @param gap       [in]  of that point to the surface, unit m
 *  @param normal    [in]  shape [3]; of the surface there, outward, unit 1
 *  @param spacing   [in]  of the body that asks: curvature is resolved to this length, unit m */
double mor_contact_curvature(const mor_shape *shape, int dimension, const double *place, double gap,
                             const double *normal, double spacing);

/** Gap below which the surface around a node may touch though the node does not, unit m.
 *  @param touch           [in]  whose side and node are known
 *  @param other_curvature [in]  of the other surface, unit 1/m */
double mor_contact_reach(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch,
                         double other_curvature);

/** A point of the reference configuration in the frame of the body's shape.
 *  @param reference [in]   shape [3], unit m
 *  @param place     [out]  shape [3], unit m */
void mor_contact_shape_place(const mor_body *body, const double *reference, double *place);

/** Gap of a point of the reference configuration of a body, unit m.
 *  @param reference [in]   shape [3], unit m
 *  @param normal    [out]  shape [3]; in that configuration, unit 1; may be NULL
 *  @param curvature [out]  one number, unit 1/m; may be NULL; asks for a normal */
double mor_contact_reference_gap(const mor_body_group *group, const mor_body *body, const double *reference,
                                 double *normal, double *curvature);

/** Where a point now was in the reference configuration of a body that moves as a whole.
 *  @param point     [in]   shape [3], unit m
 *  @param reference [out]  shape [3], unit m */
void mor_contact_find_reference(const mor_body *body, const double *point, double *reference);

/** Inverts the inertia of a rigid body, for mor_contact_response. */
void mor_contact_measure_inertia(mor_contact_body *c);

/** Counts the pairs of each body that touch.
 *  @param contact [in,out]  whose touches have been found */
void mor_contact_count_pairs(mor_contact *contact);

/** Rate at which the motions of two rigid sides would change, over the speed of closing, if each touching node were
 *  damped by its undamped force times its speed of closing: a bound of the largest eigenvalue, unit N/kg.
 *  @param begin   [in]  first touch of the pair
 *  @param end     [in]  the one behind its last */
double mor_contact_response(const mor_contact *contact, const mor_contact_near *near, int64_t begin, int64_t end);

/** Gap of a point to a rigid body or a wall, unit m.
 *  @param asking  [in]  the group of the body that asks
 *  @param other   [in]  index of a rigid body, or n_bodies plus that of a wall
 *  @param point   [in]  shape [3], unit m */
double mor_contact_gap(const mor_contact *contact, const mor_body_group *asking, int other, const double *point);

/** Follows the surface around a node of a rigid body: fills in depth, mean_depth, mean_square, and moves place and
 *  normal to the center of the pressure. Elastic sides and edges: those of the node.
 *  @param touch   [in,out]  whose gap, normal and curvature are known */
void mor_contact_spread(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch);

/** Standard deviation of the window around a node, over the square root of its area. The windows of a square lattice of
 *  nodes add up to one within 4 % along one axis and 8 % along both. */
#define MOR_CONTACT_DEVIATION 0.45

/** Lists the nodes around each smooth node of the rigid bodies; their curvatures must be known.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_contact_list_neighbors(mor_context *context, mor_contact *contact);

/** Sum of the windows of all nodes at a place beside a smooth node, each as wide as the place is uncertain: what a node
 *  finds there is divided by it, so that a contact between nodes has the same stiffness as one at a node.
 *  @param owner    [in]  the body of the node
 *  @param node     [in]  index of the node in its group
 *  @param offset   [in]  shape [3]; from the node, unit m
 *  @param variance [in]  of what the node finds about that place, along one axis, unit m2
 *  Returns: unit 1, near 1. */
double mor_contact_overlap(const mor_contact *contact, const mor_contact_body *owner, int64_t node,
                           const double *offset, double variance);

/** Writes the weights of the points around a node.
 *  @param weights [out]  shape [MOR_CONTACT_WINDOW], unit 1; they add up to 1 */
void mor_contact_window_weights(double *weights);

/** Factor on the normal forces of a pair of rigid sides: as the contact widens, each node carries less. Hertz's law as
 *  a function of the energy that its nodes would store without it, docs/theory/contact.md (C3b).
 *  @param energy  [in]   sum over nodes of half the stiffness times the squared depth, unit J (J/m)
 *  @param stored  [out]  one number; energy with the factor, unit J (J/m)
 *  Returns: unit 1, at most 1. */
double mor_contact_soften(const mor_contact *contact, const mor_contact_near *near, double energy, double *stored);

/** Stiffness of a pair of rigid sides as it begins to touch, unit N/m (N/m2).
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
double mor_contact_least_stiffness(const mor_contact *contact, int first, int second);

/** Largest stiffness, normal or tangential, of a pair of rigid sides once it has stored an energy, unit N/m (N/m2).
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall
 *  @param energy  [in]  unit J (J/m) */
double mor_contact_largest_stiffness(const mor_contact *contact, int first, int second, double energy);

/** Frequency of a pair of rigid sides on their normal contact in an impact, unit rad/s.
 *  @param speed   [in]  of the impact, unit m/s; 0: after a fall over the size of a body or at the reference speed */
double mor_contact_frequency(const mor_contact *contact, const mor_contact_near *near, double speed);

/** Measures the curvature of all rigid bodies at their nodes; the history and the list of bodies must be there.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_contact_measure_curvatures(mor_context *context, mor_contact *contact);

/** Finds boxes and travels of the bodies of the members.
 *  @param members [in]      bits of steppers */
void mor_contact_observe(mor_context *context, mor_contact *contact, uint64_t members);

/** Box and largest speed of a body now.
 *  @param box   [out]  shape [6]; minimum, maximum; unit m
 *  @param speed [out]  one number, unit m/s */
void mor_contact_box(const mor_contact_body *body, double *box, double *speed);

/** Lower bound of the gap of a pair, unit m.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall
 *  @param boxes   [in]  shape [n_bodies, 6]; boxes as mor_contact_box gives them, unit m */
double mor_contact_apart(const mor_contact *contact, int first, int second, const double *boxes);

/** Updates the lists of near pairs and nodes, and lists the touches to be evaluated.
 *  @param members [in]      bits of steppers
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_contact_search(mor_context *context, mor_contact *contact, uint64_t members);

/** Frees the lists of nodes of a near pair.
 *  @param near    [in,out]  owned lists become NULL */
void mor_contact_free_lanes(mor_context *context, mor_contact_near *near);

/** Finds how a node touches its partner: fills in gap, clearance and, when is_whole and it touches, all else; depth is
 *  zero when it does not.
 *  @param touch     [in,out]  near, side and node are set
 *  @param is_whole  [in]      also fill in what only touching nodes need
 *  @param particles [out]     shape [MOR_CONTACT_SUPPORT]; of an elastic partner
 *  @param weights   [out]     shape [MOR_CONTACT_SUPPORT], unit 1 */
void mor_contact_find_touch(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch,
                            bool is_whole, int32_t *particles, double *weights);

/** Stiffness of a friction spring over that of the normal spring, 1. */
#define MOR_CONTACT_TANGENTIAL_RATIO 0.8

/** Lists the entries of the history that are in use, once after a start or a resume. */
void mor_contact_list_history(mor_contact *contact);

/** Removes friction springs and speeds of impact of contacts that ended; those of other members' bodies stay.
 *  @param members [in]      bits of steppers */
void mor_contact_release_history(mor_contact *contact, uint64_t members);

/** Applies the forces of all touches, pair by pair, and accounts for their energy.
 *  @param members [in]      bits of steppers
 *  @param length  [in]      of the sub-step, unit s */
void mor_contact_apply_forces(mor_contact *contact, uint64_t members, double length);

/** Sums over the groups what each had in its last sub-step: spring energy, deepest penetration, forces on walls. */
void mor_contact_add_sums(mor_contact *contact);

/** Strength of the gravity that acts on a body, unit m/s2. */
double mor_contact_gravity(const mor_contact_body *c);

/** Finds boxes and largest speeds of all bodies now.
 *  @param contact [in]   its boxes are written
 *  @param speeds  [out]  shape [n_bodies], unit m/s */
void mor_contact_find_boxes(mor_context *context, const mor_contact *contact, double *speeds);

/** Depth of a pair that stops a run, unit m.
 *  @param first   [in]  index of a body
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
double mor_contact_depth_limit(const mor_contact *contact, int first, int second);

/** Keeps the depth that is nearest to its limit.
 *  @param depth   [in]      deepest of the pair, unit m
 *  @param place   [in]      shape [3]; of that touch, unit m */
void mor_contact_note_depth(mor_contact *contact, const mor_contact_near *near, double depth, const double *place);

/** Of a wall and those joined to it, the one whose surface is nearest to a place.
 *  @param leader  [in]  index of a wall that is joined to no other
 *  @param place   [in]  shape [3]; frame of the run, unit m */
int mor_contact_find_part(const mor_contact *contact, int leader, const double *place);

/** Keeps how deep one of two sides that no force moves has been driven into the other.
 *  @param begin   [in]      first touch of the pair
 *  @param end     [in]      the one behind its last */
void mor_contact_note_driven(mor_contact *contact, const mor_contact_near *near, int64_t begin, int64_t end);

/** Keeps the first touch of a wall where that is bent by an edge: walls have no nodes, so those of the body decide. */
void mor_contact_note_edge(mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch);

/** Looks at the deepest touch of the last evaluation: warns once, docs/theory/contact.md "How deep".
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC, naming both sides, when surfaces lie too deep in one another. */
mor_status mor_contact_check_depth(mor_context *context, mor_contact *contact);

/** Returns the shape that bodies touch of a wall that is joined to no other: with those that are joined to it. */
static inline const mor_shape *mor_contact_wall_shape(const mor_contact_wall *wall)
{
    return wall->whole != NULL ? wall->whole : wall->shape;
}

/** Whether a side may touch others: it is there still, and walls that are joined to another one are touched as that
 *  one.
 *  @param side  [in]  index of a body, or n_bodies plus that of a wall */
static inline bool mor_contact_is_side(const mor_contact *contact, int side)
{
    if (side < contact->work->n_bodies) {
        const mor_contact_body *body = &contact->work->bodies[side];
        return !body->group->boundary.patches[body->body].is_removed;
    }
    const mor_contact_wall *wall = &contact->walls[side - contact->work->n_bodies];
    return wall->joined_to == 0 && !wall->is_removed;
}

/** Moves all walls to where they are at a time, and takes away those that are removed by then.
 *  @param time    [in]      unit s */
void mor_contact_move_walls(mor_contact *contact, double time);

/** Adds the work of the members' bodies on walls that move as prescribed.
 *  @param members [in]      bits of steppers
 *  @param length  [in]      of the sub-step, unit s */
void mor_contact_add_wall_energy(mor_contact *contact, uint64_t members, double length);

/** Counts the energy that springs against removed sides had stored as lost, and clears that of the members' pairs.
 *  @param members [in]      bits of steppers */
void mor_contact_release_removed(mor_contact *contact, uint64_t members);

/** Velocity of the point of a wall at a place.
 *  @param place    [in]   shape [3], unit m
 *  @param velocity [out]  shape [3], unit m/s */
static inline void mor_contact_wall_velocity(const mor_contact_wall *wall, const double *place, double *velocity)
{
    if (wall->motion != NULL) {
        mor_pose_velocity(&wall->pose, place, velocity);
    } else {
        memcpy(velocity, wall->velocity, 3 * sizeof *velocity);
    }
}

/** Bound of the speed of a wall near bodies, unit m/s. */
static inline double mor_contact_wall_speed(const mor_contact_wall *wall)
{
    return wall->motion != NULL ? wall->fastest : mor_vector_length(wall->velocity);
}

/** A point in the frame of a wall's shape.
 *  @param point   [in]   shape [3]; frame of the run, unit m
 *  @param place   [out]  shape [3], unit m */
void mor_contact_wall_place(const mor_contact *contact, const mor_contact_wall *wall, const double *point,
                            double *place);

/** Returns the group of a body or NULL for a wall.
 *  @param second  [in]  index of a body, or n_bodies plus that of a wall */
static inline mor_body_group *mor_contact_group(const mor_contact *contact, int second)
{
    return second < contact->work->n_bodies ? contact->work->bodies[second].group : NULL;
}

#endif
