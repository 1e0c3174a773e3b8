/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_RIGID_RIGID_INTERNAL_H
#define MOR_BODIES_RIGID_RIGID_INTERNAL_H

#include "bodies/rigid/rigid.h"
#include "core/time/view.h"

/** @file
 *  What the files of the rigid solver share: constants of a body and its rotation. docs/theory/rigid.md. */

/** What does not change of a body. Inverse moments of inertia are written as one common to all axes and two
 *  differences, 1/I = common 1 + sum rates_k axes_k (x) axes_k: the common part rotates a body about its angular
 *  momentum, each difference about its own axis. */
typedef struct mor_rigid_constants {
    double inertia[6];     /* about the center, reference configuration, kg m2 (kg m) */
    double common;         /* 1/(kg m2) */
    double rates[2];       /* the larger first, 1/(kg m2) */
    double axes[2][3];     /* shape [2,3], unit vectors of the reference configuration, 1 */
    double outermost;      /* distance of the outermost point from the center, m */
    unsigned locked;       /* as in mor_rigid_motion, with what plane strain adds */
    int n_rotation_axes;   /* number of free axes of rotation */
    int rotation_axes[3];  /* the free axes, then the locked ones */
    double start_energy;   /* kinetic, of a body on a path when it starts, J (J/m) */
    double held_force[3];  /* of the soil, held over a common step, N (N/m) */
    double held_moment[3]; /* likewise, about the origin of coordinates, N m (N) */
} mor_rigid_constants;

/** What a group needs beside its state. */
struct mor_rigid_work {
    mor_rigid_constants *constants; /* shape [n_bodies] */
};

/** Finds the constants of a body; held forces are zero.
 *  @param body      [in]      index of the body
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a body without mass or inertia. */
mor_status mor_rigid_find_constants(mor_context *context, const mor_rigid *rigid, int body,
                                    mor_rigid_constants *constants);

/** Rotation matrix of a unit quaternion.
 *  @param quaternion [in]   shape [4], unit 1
 *  @param rotation   [out]  shape [3,3], unit 1 */
void mor_rigid_matrix(const double *quaternion, double *rotation);

/** Quaternion of a rotation vector.
 *  @param vector     [in]   shape [3], unit rad
 *  @param quaternion [out]  shape [4], unit 1 */
void mor_rigid_quaternion(const double *vector, double *quaternion);

/** Angular velocity of a body that has an angular momentum, without the locked axes.
 *  @param quaternion       [in]   shape [4], unit 1
 *  @param angular_momentum [in]   shape [3]; of locked axes without meaning, unit kg m2/s (kg m/s)
 *  @param angular_velocity [out]  shape [3], unit rad/s */
void mor_rigid_angular_velocity(const mor_rigid_constants *constants, const double *quaternion,
                                const double *angular_momentum, double *angular_velocity);

/** Angular momentum of a body that has an angular velocity.
 *  @param quaternion       [in]   shape [4], unit 1
 *  @param angular_velocity [in]   shape [3], unit rad/s
 *  @param angular_momentum [out]  shape [3], unit kg m2/s (kg m/s) */
void mor_rigid_angular_momentum(const mor_rigid_constants *constants, const double *quaternion,
                                const double *angular_velocity, double *angular_momentum);

/** Rotates a body on which no moment acts.
 *  @param length    [in]      time, unit s
 *  @param state     [in,out]  quaternion and rotation angle */
void mor_rigid_rotate(const mor_rigid_constants *constants, double length, mor_rigid_state *state);

/** Sets the state of a body on a path to that at a time.
 *  @param body [in]  index of the body
 *  @param time [in]  unit s */
void mor_rigid_follow_path(mor_rigid *rigid, int body, double time);

/** Sets bodies and particles from the states. */
void mor_rigid_place(mor_context *context, mor_rigid *rigid, mor_view *view);

/** Spring of a body as it is now.
 *  @param body      [in]   index of the body; it has a spring
 *  @param arm       [out]  shape [3]; from the center to the point, unit m
 *  @param direction [out]  shape [3]; from the anchor to the point, unit vector or zero, unit 1
 *  @param flexion   [out]  one number; speed of the point along the direction per unit of impulse, unit 1/kg (m/kg)
 *  Returns: how much longer than at rest the spring is, unit m. */
double mor_rigid_spring(const mor_rigid *rigid, int body, double *arm, double *direction, double *flexion);

/** Stages of a step; see mor_stage. */
mor_status mor_rigid_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_rigid_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_rigid_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step);

#endif
