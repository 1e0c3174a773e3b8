/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_EIGEN_H
#define MOR_CORE_BASE_EIGEN_H

#include "core/base/math.h"

#include <math.h>
#include <stdbool.h>

/** @file
 *  Principal values and directions of a symmetric 3 x 3 tensor: the direction whose value is apart from the other two
 *  in closed form, these by one Jacobi rotation in the plane across it. Accurate for equal and nearly equal values,
 *  which soil at rest has everywhere, in a third of the time of rotations alone. */

/* A rotation by less than this changes no number: half of the sweeps would only make it smaller still. */
#define MOR_EIGEN_NOTHING 1e-18

/** Rotates in the plane of two axes so that the component between them vanishes. Constant axes make it fast.
 *  @param m          [in,out]  shape [3,3], symmetric; any unit
 *  @param directions [in,out]  shape [3,3], 1
 *  @param p          [in]      first axis, 0 to 2, 1
 *  @param q          [in]      second axis, p to 2, not p, 1
 *  Returns: whether there was anything to rotate. */
static inline bool mor_eigen_rotate(double *m, double *directions, int p, int q)
{
    const double off = m[3 * p + q];
    if (fabs(off) <= MOR_EIGEN_NOTHING * (fabs(m[4 * p]) + fabs(m[4 * q]))) {
        m[3 * p + q] = m[3 * q + p] = 0.0;
        return false;
    }
    const double ratio = (m[4 * q] - m[4 * p]) / (2.0 * off);
    const double t = (ratio >= 0.0 ? 1.0 : -1.0) / (fabs(ratio) + sqrt(ratio * ratio + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0);
    const double s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double a = m[3 * k + p];
        const double b = m[3 * k + q];
        m[3 * k + p] = c * a - s * b;
        m[3 * k + q] = s * a + c * b;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = m[3 * p + k];
        const double b = m[3 * q + k];
        m[3 * p + k] = c * a - s * b;
        m[3 * q + k] = s * a + c * b;
        const double u = directions[3 * k + p];
        const double v = directions[3 * k + q];
        directions[3 * k + p] = c * u - s * v;
        directions[3 * k + q] = s * u + c * v;
    }
    m[3 * p + q] = m[3 * q + p] = 0.0;
    return true;
}

/** Largest root of x^3 - 3 x = 2 half by Newton's method, which squares three times what a parabola is off, less than
 *  a thousandth. The root lies from sqrt(3) to 2, the others at most half as far from zero.
 *  @param half [in]  0 to 1, 1
 *  Returns: the root, unit 1. */
static inline double mor_eigen_root(double half)
{
    double x = 1.73205 + half * (0.32138 - 0.05343 * half);
    for (int k = 0; k < 3; ++k) {
        x -= ((x * x - 3.0) * x - 2.0 * half) / (3.0 * (x * x - 1.0));
    }
    return x;
}

/** Unit null vector of a symmetric tensor of rank 2 whose other values have the same sign: the largest column of its
 *  cofactors.
 *  @param t       [in]   shape [6]; any unit
 *  @param normal  [out]  shape [3], 1 */
static inline void mor_eigen_null(const double *t, double *normal)
{
    double c[6];
    mor_symmetric_cofactors(t, c);
    const bool is_first = c[MOR_XX] >= c[MOR_YY];
    const bool is_third = c[MOR_ZZ] > (is_first ? c[MOR_XX] : c[MOR_YY]);
    normal[0] = is_third ? c[MOR_ZX] : (is_first ? c[MOR_XX] : c[MOR_XY]);
    normal[1] = is_third ? c[MOR_YZ] : (is_first ? c[MOR_XY] : c[MOR_YY]);
    normal[2] = is_third ? c[MOR_ZZ] : (is_first ? c[MOR_ZX] : c[MOR_YZ]);
    const double inverse = 1.0 / mor_vector_length(normal);
    for (int a = 0; a < 3; ++a) {
        normal[a] *= inverse;
    }
}

/** Diagonalizes a deviator whose components do not exceed one.
 *  @param b          [in]   shape [6], 1; not zero
 *  @param values     [out]  shape [3], 1
 *  @param axes       [out]  shape [3,3]; column k is the unit direction of value k */
static inline void mor_eigen_deviator(const double *b, double *values, double *axes)
{
    double c[6], t[6], n[3], u[3], v[3], image[3];
    const double off2 = b[MOR_XY] * b[MOR_XY] + b[MOR_YZ] * b[MOR_YZ] + b[MOR_ZX] * b[MOR_ZX];
    const double p2 = (b[MOR_XX] * b[MOR_XX] + b[MOR_YY] * b[MOR_YY] + b[MOR_ZZ] * b[MOR_ZZ] + 2.0 * off2) / 6.0;
    const double p = sqrt(p2);
    const double half = 0.5 * mor_symmetric_cofactors(b, c) / (p2 * p);
    const double apart = mor_eigen_root(mor_min(1.0, fabs(half))) * (half < 0.0 ? -p : p);
    for (int a = 0; a < 6; ++a) {
        t[a] = b[a] - (a < 3 ? apart : 0.0);
    }
    mor_eigen_null(t, n);
    const bool is_wide = fabs(n[0]) > fabs(n[1]);
    const double across = 1.0 / sqrt(n[2] * n[2] + (is_wide ? n[0] * n[0] : n[1] * n[1]));
    u[0] = is_wide ? -n[2] * across : 0.0;
    u[1] = is_wide ? 0.0 : n[2] * across;
    u[2] = is_wide ? n[0] * across : -n[1] * across;
    mor_vector_cross(n, u, v);
    mor_symmetric_apply(b, n, image);
    values[0] = mor_vector_dot(n, image);
    mor_symmetric_apply(b, u, image);
    double m[9] = {0.0}, plane[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    m[0] = mor_vector_dot(u, image);
    m[1] = m[3] = mor_vector_dot(v, image);
    mor_symmetric_apply(b, v, image);
    m[4] = mor_vector_dot(v, image);
    mor_eigen_rotate(m, plane, 0, 1);
    values[1] = m[0];
    values[2] = m[4];
    for (int a = 0; a < 3; ++a) {
        axes[3 * a] = n[a];
        axes[3 * a + 1] = plane[0] * u[a] + plane[3] * v[a];
        axes[3 * a + 2] = plane[1] * u[a] + plane[4] * v[a];
    }
}

/** Diagonalizes a symmetric tensor, shape [6]. One with an axis across the third keeps it, without rounding.
 *  @param tensor     [in]   shape [6], (xx, yy, zz, xy, yz, zx); any unit
 *  @param values     [out]  shape [3], unit of the tensor; in no order
 *  @param directions [out]  shape [3,3]; column k is the unit direction of value k */
static inline void mor_symmetric_eigen(const double *tensor, double *values, double *directions)
{
    double m[9] = {tensor[MOR_XX], tensor[MOR_XY], tensor[MOR_ZX], tensor[MOR_XY], tensor[MOR_YY],
                   tensor[MOR_YZ], tensor[MOR_ZX], tensor[MOR_YZ], tensor[MOR_ZZ]};
    double b[6];
    double size = 0.0;
    for (int k = 0; k < 9; ++k) {
        directions[k] = k % 4 == 0 ? 1.0 : 0.0;
    }
    const double mean = (tensor[MOR_XX] + tensor[MOR_YY] + tensor[MOR_ZZ]) / 3.0;
    for (int a = 0; a < 6; ++a) {
        b[a] = tensor[a] - (a < 3 ? mean : 0.0);
        size = mor_max(size, fabs(b[a]));
    }
    if ((tensor[MOR_YZ] == 0.0 && tensor[MOR_ZX] == 0.0) || !(size > 0.0)) {
        mor_eigen_rotate(m, directions, 0, 1);
        for (int k = 0; k < 3; ++k) {
            values[k] = m[4 * k];
        }
        return;
    }
    for (int a = 0; a < 6; ++a) {
        b[a] /= size;
    }
    mor_eigen_deviator(b, values, directions);
    for (int k = 0; k < 3; ++k) {
        values[k] = mean + size * values[k];
    }
}

#endif
