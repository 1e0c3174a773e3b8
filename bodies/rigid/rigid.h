/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_RIGID_RIGID_H
#define MOR_BODIES_RIGID_RIGID_H

#include "bodies/body.h"
#include "core/time/stepper.h"

/** @file
 *  Rigid bodies: six degrees of freedom, a quaternion, mass and inertia of the true shape. Free, on a spring, with
 *  locked axes, or moved as prescribed. docs/theory/rigid.md. */

/** How one rigid body moves. Plain data; all vectors in the frame of the run. */
typedef struct mor_rigid_motion {
    bool is_prescribed;         /* moves as given by the next three, whatever the forces on it */
    double velocity[3];         /* prescribed, m/s */
    double angular_velocity[3]; /* prescribed, about the center of mass, rad/s */
    const mor_motion *path;     /* prescribed in place of both; borrowed, outlives the group; NULL: none */
    double removed_at;          /* time from which the body is not there any more, s; 0: it stays */
    unsigned locked;            /* bit a: no motion along axis a; bit 3 + a: no rotation about axis a */
    bool has_spring;            /* spring and damper between a point of the body and a fixed point */
    double spring_point[3];     /* of the body, reference configuration, m */
    double spring_anchor[3];    /* fixed, m */
    double spring_length;       /* at rest, m */
    double spring_stiffness;    /* N/m (N/m2 in plane strain) */
    double spring_damping;      /* N s/m (N s/m2) */
} mor_rigid_motion;

/** What evolves of a rigid body, beside its particles. */
typedef struct mor_rigid_state {
    double center[3];                  /* m */
    double velocity[3];                /* m/s */
    double quaternion[4];              /* w, x, y, z; rotation since the reference configuration, 1 */
    double angular_momentum[3];        /* about the center, kg m2/s (kg m/s) */
    double rotation_angle[3];          /* integral of the angular velocity, rad */
    double soil_impulse[3];            /* N s */
    double contact_impulse[3];         /* N s */
    double contact_angular_impulse[3]; /* about the center, N m s (N s) */
    double contact_work;               /* of contact on a body that moves as prescribed, J (J/m) */
    double removed;                    /* 1: it is not there any more, and stays as it was then; else 0 */
} mor_rigid_state;

/** A group of rigid bodies. Owner: the run. */
typedef struct mor_rigid {
    mor_body_group group;
    mor_rigid_motion *motions;   /* shape [n_bodies] */
    mor_rigid_state *states;     /* shape [n_bodies] */
    double courant;              /* share of a spring's period that a step may take, 1 */
    struct mor_rigid_work *work; /* constants of the bodies and forces held over a common step; owned */
    int field_removed;           /* field of the set: 1 on particles of bodies that were removed, else 0; 1 */
} mor_rigid;

/** What rigid bodies are and do. A group that ends by its operation `destroy` lies in memory of its own. */
extern const mor_body_operations mor_rigid_operations;

/** Makes a group of rigid bodies.
 *  @param rigid     [out]     cleared after a failure
 *  @param name      [in]      zero-terminated
 *  @param dimension [in]      2 (rotates about z only) or 3
 *  @param spacing   [in]      unit m
 *  @param requests  [in]      shape [n_bodies]
 *  @param motions   [in]      shape [n_bodies]; copied
 *  @param n_bodies  [in]      number of bodies
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT, with the index of the body as the item of the error; MOR_ERROR_MEMORY. */
mor_status mor_rigid_init(mor_context *context, mor_rigid *rigid, const char *name, int dimension, double spacing,
                          const mor_body_request *requests, const mor_rigid_motion *motions, int n_bodies);

/** Frees what the group owns; accepts a zeroed one. */
void mor_rigid_clear(mor_context *context, mor_rigid *rigid);

/** To be called when states were set from outside: sets particles and bodies from the states, and the velocities that
 *  the soil sees to the present ones. */
void mor_rigid_prepare(mor_context *context, mor_rigid *rigid);

/** Returns the group as a stepper (a follower).
 *  @param rigid    [in]   becomes the owner
 *  @param evolving [out]  one number; bits valid at the start of a step */
void mor_rigid_stepper(mor_rigid *rigid, mor_stepper *stepper, uint64_t *evolving);

/** Kinetic energy and momenta of one body with its true inertia.
 *  @param body             [in]   index of the body
 *  @param momentum         [out]  shape [3], unit kg m/s (kg/s)
 *  @param angular_momentum [out]  shape [3], about the origin of coordinates, unit kg m2/s (kg m/s)
 *  Returns: kinetic energy, unit J (J/m); spring energy not included. */
double mor_rigid_energy(const mor_rigid *rigid, int body, double *momentum, double *angular_momentum);

#endif
