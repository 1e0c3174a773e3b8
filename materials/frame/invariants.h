/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_INVARIANTS_H
#define MOR_MATERIALS_FRAME_INVARIANTS_H

#include <float.h>
#include <math.h>

/** @file
 *  Tensor algebra that material models share: invariants, strain increment, objective rotation. Arguments and results
 *  go by value, so that a compiler can keep them in vector registers when the functions are called in a loop over
 *  lanes. No formula holds a dimensional constant: all results scale exactly under units changed by powers of two. */

/** 1 / sqrt(3). */
#define MOR_INVERSE_SQRT3 0.57735026918962576451

/** A symmetric tensor; components in the order of core/base/math.h. Unit: of the quantity. */
typedef struct mor_symmetric {
    double xx, yy, zz, xy, yz, zx;
} mor_symmetric;

/** A velocity gradient times a step, entry ab = dv_a/dx_b dt; unit 1. */
typedef struct mor_gradient {
    double xx, xy, xz, yx, yy, yz, zx, zy, zz;
} mor_gradient;

/** Reads a symmetric tensor, shape [6]; unit: of the quantity. */
static inline mor_symmetric mor_symmetric_read(const double *from)
{
    return (mor_symmetric){from[0], from[1], from[2], from[3], from[4], from[5]};
}

/** Writes a symmetric tensor, shape [6]; unit: of the quantity. */
static inline void mor_symmetric_write(mor_symmetric a, double *to)
{
    to[0] = a.xx;
    to[1] = a.yy;
    to[2] = a.zz;
    to[3] = a.xy;
    to[4] = a.yz;
    to[5] = a.zx;
}

/** a + factor * b; units: of a, and of a over b. */
static inline mor_symmetric mor_symmetric_add(mor_symmetric a, double factor, mor_symmetric b)
{
    return (mor_symmetric){a.xx + factor * b.xx, a.yy + factor * b.yy, a.zz + factor * b.zz,
                           a.xy + factor * b.xy, a.yz + factor * b.yz, a.zx + factor * b.zx};
}

/** a where the choice is not 0, else b; without a branch. Unit: of a and b. */
static inline mor_symmetric mor_symmetric_select(int choice, mor_symmetric a, mor_symmetric b)
{
    return (mor_symmetric){choice ? a.xx : b.xx, choice ? a.yy : b.yy, choice ? a.zz : b.zz,
                           choice ? a.xy : b.xy, choice ? a.yz : b.yz, choice ? a.zx : b.zx};
}

/** Double contraction a : b; unit: of a times that of b. */
static inline double mor_symmetric_product(mor_symmetric a, mor_symmetric b)
{
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

/** First invariant, the trace; unit: of a. */
static inline double mor_invariant_i1(mor_symmetric a)
{
    return a.xx + a.yy + a.zz;
}

/** Second invariant of the deviator, s:s/2; unit: of a, squared. Written with differences of the normal components, so
 *  that a large mean part causes no cancellation. */
static inline double mor_invariant_j2(mor_symmetric a)
{
    const double xy = a.xx - a.yy;
    const double yz = a.yy - a.zz;
    const double zx = a.zz - a.xx;
    return (xy * xy + yz * yz + zx * zx) * (1.0 / 6.0) + (a.xy * a.xy + a.yz * a.yz + a.zx * a.zx);
}

/** Part of an increment that is taken half before the rotation of a step and half after it, 0 to 1, unit 1: 2 w of (D6)
 *  of docs/theory/drucker_prager.md. The rest comes after the rotation.
 *  @param old   [in]  second invariant of the stress or elastic strain at the start, >= 0; any unit
 *  @param added [in]  that of the increment, >= 0; unit of old */
static inline double mor_invariant_turning(double old, double added)
{
    const double share = old * old / (old * old + added * added + DBL_MIN); /* 0 where both are 0 */
    return share * share;
}

/** The tensor with the mean [unit of a] and the deviator of a scaled by factor [1]. */
static inline mor_symmetric mor_symmetric_rescale(mor_symmetric a, double factor, double mean)
{
    const double third = 1.0 / 3.0;
    return (mor_symmetric){factor * (((a.xx - a.yy) - (a.zz - a.xx)) * third) + mean,
                           factor * (((a.yy - a.zz) - (a.xx - a.yy)) * third) + mean,
                           factor * (((a.zz - a.xx) - (a.yy - a.zz)) * third) + mean,
                           factor * a.xy,
                           factor * a.yz,
                           factor * a.zx};
}

/** The symmetric part of a gradient: the strain increment; unit 1. */
static inline mor_symmetric mor_gradient_strain(mor_gradient l)
{
    return (mor_symmetric){l.xx, l.yy, l.zz, 0.5 * (l.xy + l.yx), 0.5 * (l.yz + l.zy), 0.5 * (l.zx + l.xz)};
}

/** The square of the Frobenius norm of a gradient; unit 1. */
static inline double mor_gradient_norm2(mor_gradient l)
{
    return (l.xx * l.xx + l.yy * l.yy + l.zz * l.zz) + (l.xy * l.xy + l.yz * l.yz + l.zx * l.zx) +
           (l.yx * l.yx + l.zy * l.zy + l.xz * l.xz);
}

/** Returns R a R^T with the rotation R = (I - W/2)^-1 (I + W/2), W the skew part of the gradient (Hughes and Winget
 *  (1980)); unit: of a. With w the axial vector of W/2, R = I + E, E = 2/(1 + w.w) ([w] + [w][w]); the increment E a +
 *  (E a)^T + E a E^T is added to a, so that a small rotation loses no digits and zero rotation is the exact
 *  identity. */
static inline mor_symmetric mor_symmetric_spin(mor_symmetric a, mor_gradient l)
{
    const double wx = 0.25 * (l.zy - l.yz);
    const double wy = 0.25 * (l.xz - l.zx);
    const double wz = 0.25 * (l.yx - l.xy);
    const double xx = wx * wx;
    const double yy = wy * wy;
    const double zz = wz * wz;
    const double f = 2.0 / (1.0 + (xx + yy + zz));
    const double fx = f * wx;
    const double fy = f * wy;
    const double e_xx = -f * (yy + zz);
    const double e_yy = -f * (zz + xx);
    const double e_zz = -f * (xx + yy);
    const double e_xy = fx * wy - f * wz;
    const double e_yx = fx * wy + f * wz;
    const double e_yz = fy * wz - fx;
    const double e_zy = fy * wz + fx;
    const double e_xz = fx * wz + fy;
    const double e_zx = fx * wz - fy;
    /* m = E a */
    const double m_xx = e_xx * a.xx + e_xy * a.xy + e_xz * a.zx;
    const double m_xy = e_xx * a.xy + e_xy * a.yy + e_xz * a.yz;
    const double m_xz = e_xx * a.zx + e_xy * a.yz + e_xz * a.zz;
    const double m_yx = e_yx * a.xx + e_yy * a.xy + e_yz * a.zx;
    const double m_yy = e_yx * a.xy + e_yy * a.yy + e_yz * a.yz;
    const double m_yz = e_yx * a.zx + e_yy * a.yz + e_yz * a.zz;
    const double m_zx = e_zx * a.xx + e_zy * a.xy + e_zz * a.zx;
    const double m_zy = e_zx * a.xy + e_zy * a.yy + e_zz * a.yz;
    const double m_zz = e_zx * a.zx + e_zy * a.yz + e_zz * a.zz;
    return (mor_symmetric){a.xx + (2.0 * m_xx + (m_xx * e_xx + m_xy * e_xy + m_xz * e_xz)),
                           a.yy + (2.0 * m_yy + (m_yx * e_yx + m_yy * e_yy + m_yz * e_yz)),
                           a.zz + (2.0 * m_zz + (m_zx * e_zx + m_zy * e_zy + m_zz * e_zz)),
                           a.xy + ((m_xy + m_yx) + (m_xx * e_yx + m_xy * e_yy + m_xz * e_yz)),
                           a.yz + ((m_yz + m_zy) + (m_yx * e_zx + m_yy * e_zy + m_yz * e_zz)),
                           a.zx + ((m_zx + m_xz) + (m_zx * e_xx + m_zy * e_xy + m_zz * e_xz))};
}

#endif
