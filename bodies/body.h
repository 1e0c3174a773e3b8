/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_BODY_H
#define MOR_BODIES_BODY_H

#include "core/geometry/domain.h"
#include "core/geometry/motion.h"
#include "core/geometry/shape.h"
#include "core/particle/boundary.h"
#include "core/particle/set.h"
#include "core/particle/state.h"
#include "core/time/stepper.h"

/** @file
 *  Rocks. A group holds all bodies of one material in one particle set, each body one range of it. The group is plain
 *  data that everyone around it shares: the solver that moves it (elastic.h, rigid.h), contact among bodies
 *  (contact.h), and the soil, which sees the group as a moving boundary (core/particle/boundary.h).
 *
 *  Reference configuration: the placed positions at time zero. A body's level set is known there; the shape itself is
 *  described in a frame of its own: X = shape_rotation * x + shape_translation. */

enum {
    MOR_BODY_GROUPS_MAX = 8,
    MOR_BODY_NODE_PARTICLES = 32 /* particles that carry one surface node, at most */
};

struct mor_body_group;

/** How a body is put into motion at the start; all vectors in the frame of the run. Plain data. */
typedef struct mor_body_start {
    double velocity[3];         /* of the center of mass, m/s */
    double angular_velocity[3]; /* about it, rad/s */
    bool is_resting;            /* nothing moves yet */
    bool is_held;               /* stays in place until it is started again: no force moves it */
    bool is_prescribed;         /* keeps these velocities, whatever the forces on it */
    const mor_motion *path;     /* that it follows in place of them; borrowed, outlives the body; NULL: none */
    double removed_at;          /* time from which it is not there any more, s; 0: it stays */
    /** Adds the velocity beyond a rigid motion at a reference position, shape [3], m; NULL: none. Deformable bodies. */
    void (*add_velocity)(const void *user, const double *reference, double *velocity);
    /** Whether a reference position, shape [3], m, is in the clamp; NULL: there is none. Deformable bodies. */
    bool (*is_clamped)(const void *user, const double *reference);
    const void *user; /* first argument of both */
} mor_body_start;

/** What a kind of body is and does. One constant table per kind, in the file of its solver; all other code calls bodies
 *  through it and depends on no kind. bodies/README.md says how to add one. */
typedef struct mor_body_operations {
    const char *kind; /* for people */
    /** The surface follows the particles, which carry contact by the weights of the nodes and deform. Else it moves as
     *  a whole, forces act on the center, and contact is compliant by Hertz's law. */
    bool is_deformable;
    /** Ends the solver and frees it, the group included; accepts one that was not finished. */
    void (*destroy)(mor_context *context, struct mor_body_group *group);
    /** Fills in how it steps: proposal, begin, stages, finish, state, resume; evolving as in mor_schedule_add. */
    void (*make_stepper)(struct mor_body_group *group, mor_stepper *stepper, uint64_t *evolving);
    /** Sets the motion of one body. Returns the particles in its clamp. */
    int64_t (*start)(struct mor_body_group *group, int body, const mor_body_start *start);
    /** After all bodies of the group were started: updates what depends on their motion and sets all energy sums to
     *  zero. */
    mor_status (*prepare)(mor_context *context, struct mor_body_group *group);
    /** Momentum and angular momentum about the origin, shape [3] each. Returns the kinetic energy, J (J/m). */
    double (*momentum)(const struct mor_body_group *group, int body, double *momentum, double *angular_momentum);
    /** Strain energy of one body, or of all for -1, J (J/m); NULL: it has none. */
    double (*strain_energy)(const struct mor_body_group *group, int body);
    /** Energy of the springs that hold one body, J (J/m); NULL: there are none. */
    double (*spring_energy)(const struct mor_body_group *group, int body);
    /** Energy that viscous damping took from the group since the start, J (J/m); NULL: it has none. */
    double (*damped_energy)(const struct mor_body_group *group);
    /** Energy that a body that moves as prescribed took from contact and weight up to a time, s; J (J/m). NULL: bodies
     *  of this kind do not. */
    double (*driven_energy)(const struct mor_body_group *group, int body, double time);
    /** Writes further properties of the group for `moraine explain`, zero-terminated; NULL: nothing. */
    void (*describe)(const struct mor_body_group *group, char *text, size_t room);
} mor_body_operations;

/** One body. */
typedef struct mor_body {
    char name[MOR_FIELD_NAME_BYTES];
    int64_t first, n_particles;  /* range in the set */
    int64_t first_node, n_nodes; /* range in the group's surface nodes */
    const mor_shape *shape;      /* level set in the shape's frame; borrowed */
    double shape_rotation[9];    /* shape [3,3], rotation matrix, 1; shape's frame to reference configuration */
    double shape_translation[3]; /* m */
    double density;              /* kg/m3 */
    double mass;                 /* kg (kg/m) */
    mor_shape_moments geometry;  /* in the reference configuration */
    double contact_modulus;      /* Young's modulus of its surface in contact, Pa */
    double contact_poisson;      /* Poisson's ratio of a rigid body's surface in contact, 0 <= nu < 0.5, 1 */
    /* Motion as a whole. Rigid: kept current at the end of each sub-step. Elastic: the mean, found after each common
     * step. */
    double center[3];                 /* of mass, m */
    double velocity[3];               /* of the center, m/s */
    double angular_velocity[3];       /* rad/s */
    double rotation[9];               /* rotation since the reference configuration, shape [3,3], 1 */
    double rotation_angle[3];         /* integral of the angular velocity since the start, rad */
    double begin_velocity[3];         /* of the center when the last common step began, m/s */
    double begin_angular_velocity[3]; /* likewise, rad/s */
    bool is_held;            /* prescribed motion: forces do not move it; counts as infinitely heavy in contact */
    bool is_absent;          /* was removed before the run began: its energy does not count */
    double added_mass_ratio; /* added mass of soil over its own, see mor_body_find_added_mass, 1; 0: no soil */
    double slowing;          /* factor by which it shortens the soil's steps, 1 or more, 1; 0: no soil */
    /* Forces. */
    double contact_force[3];  /* of other bodies and walls on a rigid body, at its center, in this sub-step, N (N/m) */
    double contact_moment[3]; /* about its center, N m (N) */
    double
        soil_impulse[3]; /* received from the soil since the start, as integrated by the body's solver, N s (N s/m) */
    double contact_impulse[3]; /* received from contact since the start, likewise, N s (N s/m) */
} mor_body;

/** Up to MOR_BLOCK particles of one body: the unit of loops and sums, so that no sum depends on threads. */
typedef struct mor_body_piece {
    int64_t first, n_particles; /* range in the set */
    int body;                   /* index of the body */
} mor_body_piece;

/** Sums over particles of one body, by which its motion as a whole is observed. All are relative to its first particle:
 *  d is the current place, w the velocity, and D the place in the reference configuration relative to its mean. */
typedef struct mor_body_sums {
    double place[3];    /* d, m */
    double velocity[3]; /* w, m/s */
    double moment[3];   /* d x w, m2/s */
    double map[9];      /* shape [3,3]; d (x) D, m2 */
    double spread[6];   /* d_a d_a, then d_a d_(a+1), m2 */
} mor_body_sums;

/** All bodies of one material, or of one kind without. Owner: the solver of the group. */
typedef struct mor_body_group {
    const mor_body_operations *operations;
    void *owner;        /* the solver, which the group is part of */
    double sound_speed; /* of waves in its bodies, m/s; INFINITY: they do not deform */
    int dimension;      /* 2 (plane strain in x, y) or 3 */
    double spacing;     /* m */
    mor_set set;        /* particles in the order (body, cluster); never permuted. Fields in use: POSITION, VELOCITY,
                            * MASS, DENSITY, and those the solver adds */
    double *reference;  /* shape [n_particles, 3], reference positions, m */
    double *reference_normals; /* shape [n_particles, 3]; of the face nearest to each, 1, zero where none is near; NULL:
                                * soil sees faces as the particles lie */
    int field_gradient;        /* index of the field deformation_gradient [9] in the set; deformable bodies only */
    double *volume;   /* shape [n_particles], in the reference configuration, m3 (m2); each body's add up to its own */
    int32_t *body_of; /* shape [n_particles], index of the body */
    double *contact_force; /* shape [n_particles, 3]; of contact in this sub-step, N (N/m); NULL unless deformable */
    mor_body *bodies;      /* shape [n_bodies] */
    int n_bodies;
    mor_boundary boundary;  /* what the soil sees; patch b is body b; boundary.force is the soil's force on particles */
    bool is_unseen;         /* no soil sees the group: its boundary is not kept up to date */
    double *start;          /* shape [n_particles, 3]; positions at the start of the common step, for eq. 60, m */
    double *begin_velocity; /* shape [n_particles, 3]; at the start of the common step, m/s */
    double *mean_velocity;  /* shape [n_particles, 3]; over the last common step, eq. 60, m/s */
    /* Surface nodes carry contact. A node is a weighted mean of particles of its body, exact for linear fields:
     * sum w = 1, sum w X_particle = X_node. */
    int64_t n_nodes;
    double *node_reference;                      /* shape [n_nodes, 3], on the surface, reference configuration, m */
    double *node_area;                           /* shape [n_nodes], m2 (m); each body's add up to about its surface */
    int32_t *node_count;                         /* shape [n_nodes], particles in use; 0 unless deformable */
    int32_t *node_particles;                     /* shape [n_nodes, MOR_BODY_NODE_PARTICLES] */
    double *node_weights;                        /* shape [n_nodes, MOR_BODY_NODE_PARTICLES], 1 */
    double gravity[3];                           /* m/s2 */
    double gravity_ramp;                         /* time over which gravity grows from zero, s */
    bool has_smooth_ramp;                        /* it grows without a kick at either end, see mor_ramp */
    double damping;                              /* rate of velocity damping, for settling, 1/s */
    double local_damping;                        /* share of the net force that opposes motion, 1 */
    double damping_time;                         /* when both end, s; 0: never */
    double domain_minimum[3], domain_maximum[3]; /* m, before the placement */
    const mor_domain_frame *placement;           /* of the domain; borrowed; NULL: neither rotated nor translated */
    /* Longest step that contact allows, unit s (INFINITY: any); NULL without contact. Set by mor_contact_init. */
    double (*longest_contact_step)(mor_context *context, const void *contact, const struct mor_body_group *group);
    /** Of a checked run: shows what contact remembers. Likewise. */
    void (*visit_contact)(const void *contact, mor_shared_visit visit, void *job);
    const void *contact;    /* what both are handed; borrowed */
    mor_body_piece *pieces; /* shape [n_pieces]; by rising range, without gaps */
    int64_t n_pieces;
    /* Scratch of loops over pieces. */
    mor_body_sums *piece_sums; /* shape [n_pieces] */
    double *piece_speed2;      /* shape [n_pieces]; largest squared speed, m2/s2 */
    int64_t *piece_stray;      /* shape [n_pieces]; first particle outside the domain, -1: none */
    double *reference_centers; /* shape [n_bodies, 3]; mean of a body's reference positions, m */
    double *reference_spreads; /* shape [n_bodies, 9]; inverse of the sum of (X - center) (x) (X - center) over a body's
                                * particles, zero when they lie in a plane (on a line); 1/m2 */
} mor_body_group;

/** What a body is made from. Borrowed during mor_body_group_init, but for the shape. */
typedef struct mor_body_request {
    const char *name;        /* zero-terminated */
    const double *positions; /* shape [n_particles, 3], reference configuration, m */
    int64_t n_particles;
    const mor_shape *shape;      /* borrowed for the life of the group */
    double shape_rotation[9];    /* shape [3,3], 1 */
    double shape_translation[3]; /* m */
    double density;              /* kg/m3 */
    mor_shape_moments geometry; /* of the shape, in the reference configuration (mor_shape_find_moments, then placed) */
    double velocity[3];         /* of the center of mass, m/s */
    double angular_velocity[3]; /* about the center of mass, rad/s */
    mor_wall_friction soil_friction;
    double soil_friction_coefficient; /* Coulomb only, 1 */
    double contact_modulus;           /* Young's modulus of its surface in contact, Pa */
    double contact_poisson;           /* Poisson's ratio of a rigid body's surface in contact, 1 */
} mor_body_request;

/** Makes a group: sorts each body's particles into clusters, gives them volume and mass so that each body's add up to
 *  the true ones, sets the motion at the start (velocity + angular velocity x arm), makes surface nodes.
 *  @param group      [out]     cleared after a failure
 *  @param name       [in]      zero-terminated; of the set and the boundary
 *  @param operations [in]      of their kind; borrowed
 *  @param owner      [in]      the solver that the group is part of; borrowed
 *  @param dimension  [in]      2 or 3
 *  @param spacing    [in]      unit m
 *  @param requests   [in]      shape [n_bodies]
 *  @param n_bodies   [in]      number of bodies, >= 1
 *  @param field_mask [in]      built-in fields beside POSITION, VELOCITY, MASS, DENSITY; see mor_set_init
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a body of no particles, with its index among the requests as the item of the
 *  error; MOR_ERROR_MEMORY. */
mor_status mor_body_group_init(mor_context *context, mor_body_group *group, const char *name,
                               const mor_body_operations *operations, void *owner, int dimension, double spacing,
                               const mor_body_request *requests, int n_bodies, uint64_t field_mask);

/** Lets soil see the faces of the bodies by their normals, from the level sets of their shapes; in a body that deforms
 *  they follow its deformation. Before the boundary is added to a soil.
 *  @param group [in,out]  initialized
 *  @param reach [in]      of soil into a body: points deeper than this have no normal, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: some distances for each particle; allocates. */
mor_status mor_body_group_use_normals(mor_context *context, mor_body_group *group, double reach);

/** Frees what the group owns; accepts a zeroed one. */
void mor_body_group_clear(mor_context *context, mor_body_group *group);

/** Sets the positions that the soil sees to those in the middle of the coming common step, and stores the present ones
 *  and the motion of the bodies; normals are those of the start of the step.
 *  Velocities stay those that the last common step ended with (at the start: the initial ones).
 *  @param length  [in]      length of the common step, unit s */
void mor_body_group_begin(mor_context *context, mor_body_group *group, double length);

/** After the sub-steps: gives the soil the velocities it is to see (docs/theory/coupling.md, C6b): of rigid bodies the
 *  present ones, of elastic ones half of that and half of the means over the common step, Zhang et al. (2024) eq. 60,
 *  without their lag; and the largest speed of all.
 *  @param length  [in]      length of the common step, unit s */
void mor_body_group_finish(mor_context *context, mor_body_group *group, double length);

/** Lists what every kind of body carries from step to step: the set, what the soil sees, and the forces and impulses of
 *  the soil. A solver adds its own state.
 *  @param list    [in,out]  borrows from the group
 *  Returns: as mor_state_add. */
mor_status mor_body_group_list_state(mor_context *context, mor_body_group *group, mor_state_list *list);

/** Shows a checked run the arrays that every kind of body has beside the fields of its set, those of contact included;
 *  see mor_stepper.visit_shared. A solver adds what is its own.
 *  @param visit [in]      called for each array
 *  @param job   [in,out]  handed to visit */
void mor_body_group_visit_shared(mor_body_group *group, mor_shared_visit visit, void *job);

/** Finds the added mass of soil of a body over its own mass: the soil within one spacing of its surface, that which
 *  slides along a face counting a third, for the free motion of the body as a whole for which the ratio is
 *  largest. Of an elastic body also the square of half the soil's impedance over its own. The soil takes
 *  steps shorter by the root of the ratio, of an elastic body by 1.2 times that, where this factor is above 1
 *  (core/particle/boundary.h). To be called before the first step.
 *  @param group           [in,out]  made by mor_body_group_init
 *  @param body            [in]      index of the body
 *  @param density         [in]      of the soil, unit kg/m3
 *  @param sound_speed     [in]      of the soil, unit m/s
 *  @param locked          [in]      bit a: no motion along axis a; bit 3 + a: no rotation about axis a */
void mor_body_find_added_mass(mor_body_group *group, int body, double density, double sound_speed, unsigned locked);

/** Finds an elastic body's motion as a whole from its particles: center, mean velocity, angular velocity (angular
 *  momentum over inertia of the particles), rotation (polar decomposition of the best linear map), rotation angle.
 *  @param length  [in]      time since the last call, unit s; for the rotation angle */
void mor_body_group_observe(mor_context *context, mor_body_group *group, double length);

/** Kinetic energy and momenta of one body from its particles.
 *  @param body             [in]   index of the body
 *  @param momentum         [out]  shape [3], unit kg m/s (kg/s)
 *  @param angular_momentum [out]  shape [3], about the origin of coordinates, unit kg m2/s (kg m/s)
 *  Returns: kinetic energy, unit J (J/m). For a body of any kind: its operation `momentum`. */
double mor_body_group_momentum(const mor_body_group *group, int body, double *momentum, double *angular_momentum);

#endif
