/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_CONTACT_CONTACT_H
#define MOR_BODIES_CONTACT_CONTACT_H

#include "bodies/body.h"
#include "core/geometry/motion.h"
#include "core/time/stepper.h"

/** @file
 *  Contact of rocks with rocks and of rocks with walls, for bodies of any shape, elastic or rigid. Surface nodes of one
 *  body are tested against the level set of the other: the place of a node is mapped back into the other's reference
 *  configuration, where the level set gives depth and normal. Normal spring, restitution, and Coulomb friction with
 *  a tangential spring that sticks. Every force has its equal and opposite at the same point, so that linear and
 *  angular momentum are kept. docs/theory/contact.md. */

enum { MOR_CONTACT_WALLS_MAX = 64, MOR_CONTACT_PAIRS_MAX = 64, MOR_CONTACT_NAME_BYTES = 48 };

/** How two surfaces touch. */
typedef struct mor_contact_law {
    double friction_coefficient; /* Coulomb, >= 0, 1 */
    double restitution;          /* speed after / speed before, 0 < e <= 1, 1 */
} mor_contact_law;

/** A wall as bodies see it. */
typedef struct mor_contact_wall {
    char name[MOR_CONTACT_NAME_BYTES];
    const mor_shape *shape;   /* level set in the frame of the case; borrowed */
    double rotation[9];       /* shape [3,3]; frame of the case to frame of the run, 1 */
    double translation[3];    /* likewise, m */
    double velocity[3];       /* frame of the run, m/s; zero with a motion */
    const mor_motion *motion; /* frame of the run; borrowed, outlives the contact; NULL: the velocity above */
    double removed_at;        /* time from which the wall is not there any more, s; 0: it stays */
    double fastest;           /* with a motion: bound of the speed of its points near bodies at any time, m/s */
    mor_pose pose;            /* [by the contact] at the present time, where there is a motion */
    bool is_removed;          /* [by the contact] at the present time */
    double modulus;           /* Young's modulus of its surface; 0: it does not yield, Pa */
    double poisson;           /* Poisson's ratio of it, 0 <= nu < 0.5, 1 */
    int joined_to;          /* index, plus one, of the wall before it with which it makes one face: bodies touch both as
                             * that one; 0: none. Both move alike, yield alike and have the default law */
    const mor_shape *whole; /* union of the shapes of a wall and those joined to it; borrowed; NULL: shape is all */
    double force[3];        /* [out] of the bodies on the wall in the last sub-step, N (N/m) */
} mor_contact_wall;

/** A law for two bodies, or a body and a wall, by name; any other pair has the default law. */
typedef struct mor_contact_pair {
    char first[MOR_CONTACT_NAME_BYTES], second[MOR_CONTACT_NAME_BYTES];
    mor_contact_law law;
} mor_contact_pair;

/** Settings. */
typedef struct mor_contact_settings {
    mor_contact_law law;           /* of pairs without one of their own */
    const mor_contact_pair *pairs; /* shape [n_pairs]; borrowed for the life of the contact */
    int n_pairs;
    double slowest_impact;  /* speed under which a touch counts as this fast when it is damped, m/s */
    double reference_speed; /* of an impact in which the tangential springs of rigid sides are as stiff as the normal
                             * ones, m/s; no less than by a fall over the size of a body */
    bool has_removals;      /* walls or bodies are removed in the course of the run */
} mor_contact_settings;

/** A force of contact, as it acts in one sub-step. */
typedef struct mor_contact_load {
    const mor_body_group *group, *other_group; /* of the two sides; other_group NULL: a wall */
    int body, other_body;                      /* in their groups */
    int wall;                                  /* index of the wall; -1: a body */
    const double *place;                       /* shape [3]; where it acts, m */
    const double *force; /* shape [3]; on the first side; the opposite acts on the other, N (N/m) */
} mor_contact_load;

/** Looks at each force of contact when it is applied; nothing depends on whether anybody does. */
typedef struct mor_contact_watch {
    void *owner;
    void (*run)(void *owner, const mor_contact_load *load); /* takes one force; NULL: nobody looks */
} mor_contact_watch;

/** Contact among all groups and walls. Owner: the run. */
typedef struct mor_contact {
    mor_body_group *groups[MOR_BODY_GROUPS_MAX]; /* borrowed; group g belongs to the stepper with bit stepper_bits[g] */
    uint64_t stepper_bits[MOR_BODY_GROUPS_MAX];
    int n_groups;
    mor_contact_wall *walls; /* shape [n_walls]; owned */
    int n_walls;
    mor_contact_settings settings;
    mor_contact_watch watch; /* what it owns is borrowed */
    double time;             /* to which walls have moved; set by the exchange, s */
    double spring_energy;    /* stored in normal and tangential springs at the last sub-step, J (J/m) */
    double friction_energy;  /* lost to sliding since the start, J (J/m) */
    double damping_energy;   /* lost to restitution since the start, J (J/m) */
    double wall_energy;      /* that bodies gave to moving walls since the start, J (J/m) */
    double deepest;          /* deepest penetration at the last sub-step, m */
    double deepest_share;    /* largest so far of a penetration over what is allowed, 1 */
    double driven_share;     /* likewise, of sides that no force moves, when it was warned of, 1; 0: never */
    double *group_spring;    /* shape [n_groups]; spring energy of each at its last sub-step, J (J/m) */
    double *group_deepest;   /* shape [n_groups]; deepest penetration of each at its last sub-step, m */
    double *wall_force;      /* shape [n_groups, n_walls, 3]; of each on each wall at its last sub-step, N (N/m) */
    double *wall_moment;     /* shape [n_groups, n_walls, 3]; likewise about the origin of coordinates, N m (N) */
    mor_set history;         /* one entry per surface node of all groups: history of friction; its fields evolve */
    double *impacts;         /* shape [n_impacts]; impact speeds of touching pairs, m/s */
    double *pair_spring;     /* shape [n_impacts]; spring energy of pairs at the last sub-step of each, J (J/m); NULL
                             * without removals */
    int64_t n_impacts;
    struct mor_contact_work *work; /* lists and scratch; owned */
} mor_contact;

/** Makes the contact of some groups and walls.
 *  @param contact      [out]     cleared after a failure
 *  @param settings     [in]      copied
 *  @param groups       [in]      shape [n_groups]; borrowed
 *  @param stepper_bits [in]      shape [n_groups]; the bit of each group's stepper in the schedule
 *  @param n_groups     [in]      number of groups
 *  @param walls        [in]      shape [n_walls]; copied
 *  @param n_walls      [in]      number of walls
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a pair with an unknown name; MOR_ERROR_MEMORY. */
mor_status mor_contact_init(mor_context *context, mor_contact *contact, const mor_contact_settings *settings,
                            mor_body_group *const *groups, const uint64_t *stepper_bits, int n_groups,
                            const mor_contact_wall *walls, int n_walls);

/** Frees what the contact owns; accepts a zeroed one. */
void mor_contact_clear(mor_context *context, mor_contact *contact);

/** Fills in the exchange that the schedule runs among followers.
 *  @param contact  [in]   becomes the owner */
void mor_contact_exchange(mor_contact *contact, mor_exchange *exchange);

/** Sets the energy sums to zero and clears the impact speeds of touching pairs; friction springs are kept. */
void mor_contact_restart(mor_contact *contact);

/** Lists what contact carries from step to step.
 *  @param list    [in,out]  borrows from the contact
 *  Returns: as mor_state_add. */
mor_status mor_contact_list_state(mor_context *context, mor_contact *contact, mor_state_list *list);

/** After a state was put back: makes the rest of the contact follow.
 *  @param time    [in]      of that state, unit s */
void mor_contact_resume(mor_contact *contact, double time);

/** Writes the force on a wall in the last sub-step of some steppers, of their bodies alone.
 *  @param wall    [in]   index of the wall
 *  @param members [in]   bits of steppers
 *  @param force   [out]  shape [3], unit N (N/m) */
void mor_contact_wall_force(const mor_contact *contact, int wall, uint64_t members, double *force);

/** Longest step that the normal springs of a group's bodies allow, unit s; INFINITY when none of its bodies is near
 *  another or a wall. A function of the present state alone. mor_contact_init sets it in each group.
 *  @param contact [in]  a mor_contact */
double mor_contact_longest_step(mor_context *context, const void *contact, const mor_body_group *group);

/** The same once bodies touch, unit s: no longer than the step of any one pair of them, or body and wall, in touch,
 *  however far apart they are now; INFINITY without pairs. Bodies that touch several others at once may need shorter
 *  ones. May be set in a group in place of the above.
 *  @param contact [in]  a mor_contact */
double mor_contact_touching_step(mor_context *context, const void *contact, const mor_body_group *group);

#endif
