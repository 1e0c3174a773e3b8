/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_MATH_H
#define MOR_CORE_BASE_MATH_H

#include <math.h>

/** @file
 *  Small inline vector and tensor algebra. Storage orders are stated here and nowhere else:
 *  vector [3] = (x, y, z); matrix [9] = row-major, m[3 * a + b]; symmetric tensor [6] = (xx, yy, zz, xy, yz, zx). */

#define MOR_PI 3.14159265358979323846

enum { MOR_XX, MOR_YY, MOR_ZZ, MOR_XY, MOR_YZ, MOR_ZX };

/** Part of its final value, 1, that something has reached which grows from zero over a length of time, unit s; all of
 *  it from the beginning where the length is 0. Evenly, or as x^2 (3 - 2 x) of the time over the length, without a jump
 *  of the rate at either end. */
static inline double mor_ramp(double time, double length, int is_smooth)
{
    const double x = length > 0.0 && time < length ? time / length : 1.0;
    return is_smooth ? x * x * (3.0 - 2.0 * x) : x;
}

/** Whether damping still acts at a time, unit s; end: time at which it ends, s; 0: never. */
static inline int mor_is_damped(double time, double end)
{
    return end <= 0.0 || time < end;
}

/** The smaller of two numbers of one unit, neither NaN: one instruction, where fmin is a call. */
static inline double mor_min(double a, double b)
{
    return a < b ? a : b;
}

/** The larger of two numbers of one unit, neither NaN. */
static inline double mor_max(double a, double b)
{
    return a > b ? a : b;
}

/** Inner product of two vectors, shape [3] each; unit: product of theirs. */
static inline double mor_vector_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** out = a x b, the vector product; a, b and out shape [3], out not aliased; unit of out: product of theirs. */
static inline void mor_vector_cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/** out += factor * a x b; a, b and out shape [3], out not aliased; unit of out: product of theirs. */
static inline void mor_vector_cross_add(double factor, const double *a, const double *b, double *out)
{
    out[0] += factor * (a[1] * b[2] - a[2] * b[1]);
    out[1] += factor * (a[2] * b[0] - a[0] * b[2]);
    out[2] += factor * (a[0] * b[1] - a[1] * b[0]);
}

/** Length of a vector, shape [3]; unit: that of the vector. */
static inline double mor_vector_length(const double *a)
{
    return sqrt(mor_vector_dot(a, a));
}

/** Takes from a rate of change the share of its size that opposes a motion, local non-viscous damping: motion that
 *  gains speed gains less, motion that loses speed loses more, and where nothing moves or changes there is no damping.
 *  motion and rate: shape [3], any units; share: 0 <= share < 1, 1.
 *  Theory: Cundall (1987), for vectors; docs/theory/settling.md (U5). */
static inline void mor_damp_locally(double share, const double *motion, double *rate)
{
    const double speed = mor_vector_length(motion);
    const double taken = speed > 0.0 ? share * mor_vector_length(rate) / speed : 0.0;
    for (int a = 0; a < 3; ++a) {
        rate[a] -= taken * motion[a];
    }
}

/** Puts back what mor_damp_locally took, (U6): the positive root of |n|^2 = |r + share |n| e|^2, e along the motion.
 *  motion and rate: shape [3], any units; share: 0 <= share < 1, 1. */
static inline void mor_undamp_locally(double share, const double *motion, double *rate)
{
    const double speed = mor_vector_length(motion);
    if (speed > 0.0 && share > 0.0) {
        const double along = share * mor_vector_dot(rate, motion) / speed;
        const double rest = 1.0 - share * share;
        const double size = (along + sqrt(along * along + rest * mor_vector_dot(rate, rate))) / rest;
        for (int a = 0; a < 3; ++a) {
            rate[a] += share * size * motion[a] / speed;
        }
    }
}
/** to = from + way * direction; all shape [3], to may be from; unit of to and from: way times direction. */
static inline void mor_vector_advance(const double *from, double way, const double *direction, double *to)
{
    for (int a = 0; a < 3; ++a) {
        to[a] = from[a] + way * direction[a];
    }
}

/** Two unit vectors across a unit vector n and each other, in plane strain the first one in the plane; n, first and
 *  second shape [3], not aliased, unit 1. */
static inline void mor_vector_tangents(const double *n, double *first, double *second)
{
    const int axis = fabs(n[2]) <= fabs(n[0]) || fabs(n[2]) <= fabs(n[1]) ? 2 : (fabs(n[0]) <= fabs(n[1]) ? 0 : 1);
    const double unit[3] = {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
    mor_vector_cross(unit, n, first);
    const double length = mor_vector_length(first);
    for (int a = 0; a < 3; ++a) {
        first[a] /= length > 0.0 ? length : 1.0;
    }
    mor_vector_cross(n, first, second);
}

/** out = matrix * a; matrix shape [3,3], a and out shape [3], not aliased; unit of out: product of theirs. */
static inline void mor_matrix_apply(const double *matrix, const double *a, double *out)
{
    for (int row = 0; row < 3; ++row) {
        out[row] = mor_vector_dot(matrix + 3 * row, a);
    }
}

/** out = transpose(matrix) * a; matrix shape [3,3], a and out shape [3], not aliased; unit of out: product of
 *  theirs. */
static inline void mor_matrix_apply_transposed(const double *matrix, const double *a, double *out)
{
    for (int column = 0; column < 3; ++column) {
        out[column] = matrix[column] * a[0] + matrix[3 + column] * a[1] + matrix[6 + column] * a[2];
    }
}

/** Determinant of a matrix, shape [3,3]; unit: cube of the matrix's. */
static inline double mor_matrix_determinant(const double *m)
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/** out = tensor * a; symmetric tensor shape [6], a and out shape [3], not aliased; unit of out: product of theirs. */
static inline void mor_symmetric_apply(const double *tensor, const double *a, double *out)
{
    out[0] = tensor[MOR_XX] * a[0] + tensor[MOR_XY] * a[1] + tensor[MOR_ZX] * a[2];
    out[1] = tensor[MOR_XY] * a[0] + tensor[MOR_YY] * a[1] + tensor[MOR_YZ] * a[2];
    out[2] = tensor[MOR_ZX] * a[0] + tensor[MOR_YZ] * a[1] + tensor[MOR_ZZ] * a[2];
}

/** Cofactors of a symmetric tensor, both shape [6], not aliased; unit: square of the tensor's. Returns its determinant,
 *  unit: cube of the tensor's; cofactors / determinant is the inverse. */
static inline double mor_symmetric_cofactors(const double *tensor, double *cofactors)
{
    const double *m = tensor;
    cofactors[MOR_XX] = m[MOR_YY] * m[MOR_ZZ] - m[MOR_YZ] * m[MOR_YZ];
    cofactors[MOR_YY] = m[MOR_XX] * m[MOR_ZZ] - m[MOR_ZX] * m[MOR_ZX];
    cofactors[MOR_ZZ] = m[MOR_XX] * m[MOR_YY] - m[MOR_XY] * m[MOR_XY];
    cofactors[MOR_XY] = m[MOR_ZX] * m[MOR_YZ] - m[MOR_XY] * m[MOR_ZZ];
    cofactors[MOR_YZ] = m[MOR_XY] * m[MOR_ZX] - m[MOR_XX] * m[MOR_YZ];
    cofactors[MOR_ZX] = m[MOR_XY] * m[MOR_YZ] - m[MOR_ZX] * m[MOR_YY];
    return m[MOR_XX] * cofactors[MOR_XX] + m[MOR_XY] * cofactors[MOR_XY] + m[MOR_ZX] * cofactors[MOR_ZX];
}

/** Solves tensor * x = b, about z only in plane strain; x is zero for a tensor that is not positive definite.
 *  dimension: 2 or 3; tensor: shape [6]; b and x: shape [3], not aliased; unit of x: that of b over the tensor's. */
static inline void mor_symmetric_solve(int dimension, const double *tensor, const double *b, double *x)
{
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(tensor, cofactors);
    x[0] = x[1] = x[2] = 0.0;
    if (dimension == 2) {
        x[2] = tensor[MOR_ZZ] > 0.0 ? b[2] / tensor[MOR_ZZ] : 0.0;
    } else if (determinant > 0.0) {
        mor_symmetric_apply(cofactors, b, x);
        for (int a = 0; a < 3; ++a) {
            x[a] /= determinant;
        }
    }
}

/** Trace of a symmetric tensor, shape [6]; unit: that of the tensor. */
static inline double mor_symmetric_trace(const double *tensor)
{
    return tensor[MOR_XX] + tensor[MOR_YY] + tensor[MOR_ZZ];
}

/** Rotation matrix, shape [3,3], for a rotation by angle [rad] about a unit axis, shape [3] (Rodrigues). */
static inline void mor_matrix_rotation(const double *axis, double angle, double *matrix)
{
    const double c = cos(angle);
    const double s = sin(angle);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            matrix[3 * a + b] = (1.0 - c) * axis[a] * axis[b] + (a == b ? c : 0.0);
        }
    }
    matrix[1] -= s * axis[2];
    matrix[2] += s * axis[1];
    matrix[3] += s * axis[2];
    matrix[5] -= s * axis[0];
    matrix[6] -= s * axis[1];
    matrix[7] += s * axis[0];
}

#endif
