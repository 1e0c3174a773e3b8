/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Rotation of rigid bodies. The angular momentum in the fixed frame is what evolves, so that a free body keeps it to
 * the last bit; the orientation follows from it. */
#include "bodies/rigid/rigid_internal.h"

#include "core/base/eigen.h"

#include <string.h>

static void multiply_quaternions(const double *a, const double *b, double *out)
{
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

static void normalize_quaternion(double *q)
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; ++k) {
        q[k] /= length;
    }
}

void mor_rigid_quaternion(const double *vector, double *quaternion)
{
    const double angle = mor_vector_length(vector);
    const double part = angle > 0.0 ? sin(0.5 * angle) / angle : 0.5;
    quaternion[0] = cos(0.5 * angle);
    for (int a = 0; a < 3; ++a) {
        quaternion[a + 1] = part * vector[a];
    }
}

void mor_rigid_matrix(const double *q, double *rotation)
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        rotation[3 * a + a] = 1.0 - 2.0 * (q[b + 1] * q[b + 1] + q[c + 1] * q[c + 1]);
        rotation[3 * a + b] = 2.0 * (q[a + 1] * q[b + 1] - q[0] * q[c + 1]);
        rotation[3 * b + a] = 2.0 * (q[a + 1] * q[b + 1] + q[0] * q[c + 1]);
    }
}

/* Splits the inverse inertia so that the differences are small: the middle moment is the common one, and for bodies of
 * revolution one difference is zero, which makes their rotation exact. */
static void split_inertia(mor_rigid_constants *constants)
{
    double values[3];
    double directions[9];
    mor_symmetric_eigen(constants->inertia, values, directions);
    int order[3] = {0, 1, 2};
    for (int k = 0; k < 3; ++k) {
        const int j = k == 1 ? 1 : 0; /* three exchanges sort three numbers */
        if (values[order[j]] > values[order[j + 1]]) {
            const int swap = order[j];
            order[j] = order[j + 1];
            order[j + 1] = swap;
        }
    }
    constants->common = 1.0 / values[order[1]];
    const double fast = 1.0 / values[order[0]] - constants->common;
    const double slow = 1.0 / values[order[2]] - constants->common;
    const bool is_fast_first = fabs(fast) >= fabs(slow);
    constants->rates[0] = is_fast_first ? fast : slow;
    constants->rates[1] = is_fast_first ? slow : fast;
    for (int k = 0; k < 2; ++k) {
        const int column = order[(k == 0) == is_fast_first ? 0 : 2];
        for (int a = 0; a < 3; ++a) {
            constants->axes[k][a] = directions[3 * a + column];
        }
    }
}

mor_status mor_rigid_find_constants(mor_context *context, const mor_rigid *rigid, int body,
                                    mor_rigid_constants *constants)
{
    const mor_body_group *group = &rigid->group;
    const mor_body *b = &group->bodies[body];
    memset(constants, 0, sizeof *constants);
    constants->locked = rigid->motions[body].locked | (group->dimension == 2 ? 1u << 2 | 1u << 3 | 1u << 4 : 0u);
    int n_locked = 0;
    for (int a = 0; a < 3; ++a) {
        if ((constants->locked >> (3 + a) & 1u) == 0) {
            constants->rotation_axes[constants->n_rotation_axes++] = a;
        } else {
            constants->rotation_axes[2 - n_locked++] = a;
        }
    }
    for (int k = 0; k < 6; ++k) {
        constants->inertia[k] = b->density * b->geometry.inertia[k];
    }
    for (int a = group->dimension == 2 ? 2 : 0; a < 3; ++a) {
        MOR_CHECK(context, b->mass > 0.0 && isfinite(b->mass) && constants->inertia[a] > 0.0, MOR_ERROR_ARGUMENT,
                  "rigid body '%s' has mass %g kg and moment of inertia %g kg m2 about %c; both must be positive and "
                  "finite",
                  b->name, b->mass, constants->inertia[a], 'x' + a);
    }
    if (constants->n_rotation_axes == 3) {
        split_inertia(constants);
    }
    for (int64_t i = b->first; i < b->first + b->n_particles; ++i) {
        const double *x = group->reference + 3 * i;
        const double arm[3] = {x[0] - b->geometry.center[0], x[1] - b->geometry.center[1],
                               x[2] - b->geometry.center[2]};
        constants->outermost = fmax(constants->outermost, mor_vector_length(arm));
    }
    constants->outermost += 0.5 * group->spacing;
    return MOR_OK;
}

/* Entry of the inertia about fixed axes. */
static double find_inertia(const mor_rigid_constants *constants, const double *rotation, int a, int b)
{
    double half[3];
    mor_symmetric_apply(constants->inertia, rotation + 3 * b, half);
    return mor_vector_dot(rotation + 3 * a, half);
}

void mor_rigid_angular_velocity(const mor_rigid_constants *constants, const double *quaternion,
                                const double *angular_momentum, double *angular_velocity)
{
    const int *axes = constants->rotation_axes;
    const double *l = angular_momentum;
    double rotation[9];
    mor_rigid_matrix(quaternion, rotation);
    memset(angular_velocity, 0, 3 * sizeof *angular_velocity);
    if (constants->n_rotation_axes == 3) {
        for (int a = 0; a < 3; ++a) {
            angular_velocity[a] = constants->common * l[a];
        }
        for (int k = 0; k < 2; ++k) {
            double axis[3];
            mor_matrix_apply(rotation, constants->axes[k], axis);
            const double rate = constants->rates[k] * mor_vector_dot(axis, l);
            for (int a = 0; a < 3; ++a) {
                angular_velocity[a] += rate * axis[a];
            }
        }
    } else if (constants->n_rotation_axes == 2) {
        const double first = find_inertia(constants, rotation, axes[0], axes[0]);
        const double second = find_inertia(constants, rotation, axes[1], axes[1]);
        const double mixed = find_inertia(constants, rotation, axes[0], axes[1]);
        const double determinant = first * second - mixed * mixed;
        angular_velocity[axes[0]] = (second * l[axes[0]] - mixed * l[axes[1]]) / determinant;
        angular_velocity[axes[1]] = (first * l[axes[1]] - mixed * l[axes[0]]) / determinant;
    } else if (constants->n_rotation_axes == 1) {
        /* A rotation about the axis does not change the inertia about it. */
        angular_velocity[axes[0]] = l[axes[0]] / constants->inertia[axes[0]];
    }
}

void mor_rigid_angular_momentum(const mor_rigid_constants *constants, const double *quaternion,
                                const double *angular_velocity, double *angular_momentum)
{
    double rotation[9];
    double local[3];
    double local_momentum[3];
    mor_rigid_matrix(quaternion, rotation);
    mor_matrix_apply_transposed(rotation, angular_velocity, local);
    mor_symmetric_apply(constants->inertia, local, local_momentum);
    mor_matrix_apply(rotation, local_momentum, angular_momentum);
}

/* Rotates about an axis of the body with the part of the angular velocity that is due to it: exact. */
static void rotate_about_axis(const double *axis, double rate, const double *angular_momentum, double *quaternion)
{
    double rotation[9];
    double local[3];
    mor_rigid_matrix(quaternion, rotation);
    mor_matrix_apply_transposed(rotation, angular_momentum, local);
    const double half_angle = 0.5 * rate * mor_vector_dot(axis, local);
    const double part = sin(half_angle);
    const double factor[4] = {cos(half_angle), part * axis[0], part * axis[1], part * axis[2]};
    const double before[4] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    multiply_quaternions(before, factor, quaternion);
}

/* Splitting of fourth order by Blanes and Moan (2002), S6: symmetric in time, and symplectic, so that the energy does
 * not drift. The part common to all axes commutes with the others and is taken whole. */
static void rotate_freely(const mor_rigid_constants *constants, double length, const double *angular_momentum,
                          double *quaternion)
{
    static const double first[] = {0.0792036964311957, 0.353172906049774, -0.0420650803577195, 0.2193769557534996};
    static const double second[] = {0.209515106613362, -0.143851773179818, 0.434336666566456};
    enum { N_SECOND = 6 };
    const double before[4] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    double vector[3];
    double factor[4];
    for (int a = 0; a < 3; ++a) {
        vector[a] = length * constants->common * angular_momentum[a];
    }
    mor_rigid_quaternion(vector, factor);
    multiply_quaternions(factor, before, quaternion);
    if (constants->rates[1] == 0.0) {
        rotate_about_axis(constants->axes[0], length * constants->rates[0], angular_momentum, quaternion);
        return;
    }
    for (int k = 0; k <= N_SECOND; ++k) {
        const double share = first[k <= 3 ? k : N_SECOND - k];
        rotate_about_axis(constants->axes[0], share * length * constants->rates[0], angular_momentum, quaternion);
        if (k < N_SECOND) {
            const double other = second[k < 3 ? k : N_SECOND - 1 - k];
            rotate_about_axis(constants->axes[1], other * length * constants->rates[1], angular_momentum, quaternion);
        }
    }
}

/* With one axis locked: the classical method of Runge and Kutta for the quaternion. */
static void rotate_with_lock(const mor_rigid_constants *constants, double length, const double *angular_momentum,
                             double *quaternion)
{
    static const double places[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weights[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    double rate[4] = {0.0};
    double sum[4] = {quaternion[0], quaternion[1], quaternion[2], quaternion[3]};
    for (int k = 0; k < 4; ++k) {
        double place[4];
        double spin[4] = {0.0};
        for (int j = 0; j < 4; ++j) {
            place[j] = quaternion[j] + places[k] * length * rate[j];
        }
        normalize_quaternion(place);
        mor_rigid_angular_velocity(constants, place, angular_momentum, spin + 1);
        multiply_quaternions(spin, place, rate);
        for (int j = 0; j < 4; ++j) {
            rate[j] *= 0.5;
            sum[j] += weights[k] * length * rate[j];
        }
    }
    memcpy(quaternion, sum, sizeof sum);
}

void mor_rigid_rotate(const mor_rigid_constants *constants, double length, mor_rigid_state *state)
{
    double before[3];
    double after[3];
    double *q = state->quaternion;
    mor_rigid_angular_velocity(constants, q, state->angular_momentum, before);
    if (constants->n_rotation_axes == 3) {
        rotate_freely(constants, length, state->angular_momentum, q);
    } else if (constants->n_rotation_axes == 2) {
        rotate_with_lock(constants, length, state->angular_momentum, q);
    } else if (constants->n_rotation_axes == 1) {
        const double vector[3] = {length * before[0], length * before[1], length * before[2]};
        const double old[4] = {q[0], q[1], q[2], q[3]};
        double factor[4];
        mor_rigid_quaternion(vector, factor);
        multiply_quaternions(factor, old, q);
    }
    normalize_quaternion(q);
    mor_rigid_angular_velocity(constants, q, state->angular_momentum, after);
    for (int a = 0; a < 3; ++a) {
        state->rotation_angle[a] += 0.5 * length * (before[a] + after[a]);
    }
}
