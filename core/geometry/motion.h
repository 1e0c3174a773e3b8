/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_MOTION_H
#define MOR_CORE_GEOMETRY_MOTION_H

#include "core/base/context.h"
#include "core/base/math.h"

#include <stdbool.h>

/** @file
 *  A prescribed rigid motion: a table of times, translations and angles about one axis, linear or smooth in between,
 *  held before the first and after the last time. Pose and velocity are functions of time alone.
 *  Theory: docs/theory/motion.md, whose equations are cited as (M...). */

enum { MOR_MOTION_ROWS_MAX = 100000 };

/** One row: a point X of the solid lies at point + R(angle) (X - point) + translation, (M1). */
typedef struct mor_motion_row {
    double time;           /* s */
    double translation[3]; /* m */
    double angle;          /* about the axis, right-handed, any number of revolutions, rad */
} mor_motion_row;

/** A motion. Owner: the caller, who ends it with mor_motion_clear. Zeroed: no motion. */
typedef struct mor_motion {
    mor_motion_row *rows; /* shape [n_rows]; by rising time; owned */
    double *slopes;       /* shape [n_rows, 4]; of translation [m/s] and angle [rad/s] at the rows; NULL: linear */
    int n_rows;
    double point[3]; /* of the axis, where it is before any translation, m */
    double axis[3];  /* unit vector, 1 */
} mor_motion;

/** Where a moving solid is, and how fast. */
typedef struct mor_pose {
    double rotation[9];         /* shape [3,3], rotation matrix, 1; with the next: X -> rotation X + translation */
    double translation[3];      /* m */
    double velocity[3];         /* of the point of the solid that is at the origin of coordinates, m/s */
    double angular_velocity[3]; /* rad/s */
    double angle;               /* about the axis, rad */
} mor_pose;

/** Makes a motion.
 *  @param motion    [out]  zeroed after a failure
 *  @param rows      [in]   shape [n_rows]; copied
 *  @param n_rows    [in]   >= 1, at most MOR_MOTION_ROWS_MAX
 *  @param point     [in]   shape [3], unit m
 *  @param axis      [in]   shape [3]; any length but zero, unit 1
 *  @param is_smooth [in]   a cubic between rows whose velocity does not jump and that overshoots no row; else linear
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for times that do not rise, numbers that are not finite, or an axis of length
 *  zero; MOR_ERROR_MEMORY. */
mor_status mor_motion_init(mor_context *context, mor_motion *motion, const mor_motion_row *rows, int n_rows,
                           const double *point, const double *axis, bool is_smooth);

/** Frees what a motion owns; accepts a zeroed one. */
void mor_motion_clear(mor_context *context, mor_motion *motion);

/** Whether two motions are the same, number by number. */
bool mor_motion_equals(const mor_motion *first, const mor_motion *second);

/** Whether a motion ever rotates the solid. */
bool mor_motion_rotates(const mor_motion *motion);

/** Returns a bound of the speed of points at any time, unit m/s.
 *  @param radius [in]  largest distance of a point from the axis before the motion, unit m; of no meaning without
 *                      rotation */
double mor_motion_fastest(const mor_motion *motion, double radius);

/** Distance of a point from the axis before the motion, unit m.
 *  @param place [in]  shape [3], unit m */
double mor_motion_radius(const mor_motion *motion, const double *place);

/** Finds the pose at a time; the velocity is the derivative of the place, to the right where it jumps.
 *  @param time [in]   unit s
 *  @param pose [out]  one pose */
void mor_motion_find(const mor_motion *motion, double time, mor_pose *pose);

/** The pose of a solid that moves uniformly without rotation.
 *  @param velocity [in]  shape [3], unit m/s
 *  @param time     [in]  since the start, unit s */
mor_pose mor_pose_uniform(const double *velocity, double time);

/** Where a point of the solid is.
 *  @param start [in]   shape [3]; before the motion, unit m
 *  @param place [out]  shape [3], not aliased, unit m */
static inline void mor_pose_place(const mor_pose *pose, const double *start, double *place)
{
    mor_matrix_apply(pose->rotation, start, place);
    for (int a = 0; a < 3; ++a) {
        place[a] += pose->translation[a];
    }
}

/** Where the point of the solid that is at a place was before the motion.
 *  @param place [in]   shape [3], unit m
 *  @param start [out]  shape [3], not aliased, unit m */
static inline void mor_pose_take_back(const mor_pose *pose, const double *place, double *start)
{
    const double offset[3] = {place[0] - pose->translation[0], place[1] - pose->translation[1],
                              place[2] - pose->translation[2]};
    mor_matrix_apply_transposed(pose->rotation, offset, start);
}

/** Velocity of the point of the solid that is at a place, v + omega x r (M2).
 *  @param place    [in]   shape [3], unit m
 *  @param velocity [out]  shape [3], not aliased, unit m/s */
static inline void mor_pose_velocity(const mor_pose *pose, const double *place, double *velocity)
{
    for (int a = 0; a < 3; ++a) {
        velocity[a] = pose->velocity[a];
    }
    mor_vector_cross_add(1.0, pose->angular_velocity, place, velocity);
}

#endif
