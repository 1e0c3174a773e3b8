/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_EIGEN_H
#define MOR_CORE_BASE_EIGEN_H

#include "core/base/math.h"

#include <math.h>
#include <stdbool.h>

/** @file
 *  Principal values and directions of a symmetric 3 x 3 tensor by cyclic Jacobi rotations: slower than a closed form
 *  but accurate for equal and nearly equal values, which soil at rest has everywhere. */

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

/** Diagonalizes a symmetric tensor, shape [6].
 *  @param tensor     [in]   shape [6], (xx, yy, zz, xy, yz, zx); any unit
 *  @param values     [out]  shape [3], unit of the tensor; in no order
 *  @param directions [out]  shape [3,3]; column k is the unit direction of value k */
static inline void mor_symmetric_eigen(const double *tensor, double *values, double *directions)
{
    enum { SWEEPS = 12 };
    double m[9] = {tensor[MOR_XX], tensor[MOR_XY], tensor[MOR_ZX], tensor[MOR_XY], tensor[MOR_YY],
                   tensor[MOR_YZ], tensor[MOR_ZX], tensor[MOR_YZ], tensor[MOR_ZZ]};
    for (int k = 0; k < 9; ++k) {
        directions[k] = k % 4 == 0 ? 1.0 : 0.0;
    }
    bool has_more = true;
    for (int sweep = 0; has_more && sweep < SWEEPS; ++sweep) {
        has_more = mor_eigen_rotate(m, directions, 0, 1);
        has_more |= mor_eigen_rotate(m, directions, 0, 2);
        has_more |= mor_eigen_rotate(m, directions, 1, 2);
    }
    for (int k = 0; k < 3; ++k) {
        values[k] = m[4 * k];
    }
}

#endif
