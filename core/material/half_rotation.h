/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_HALF_ROTATION_H
#define MOR_CORE_MATERIAL_HALF_ROTATION_H

#include "core/base/math.h"

/** @file
 *  Half of the rotation of a step: rates are integrated in the axes of its middle. */

/** Turns a symmetric tensor in place.
 *  @param rotation [in]      shape [3,3], 1
 *  @param tensor   [in,out]  shape [6], xx, yy, zz, xy, yz, zx; any unit */
static inline void mor_half_rotation_turn(const double *rotation, double *tensor)
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2};
    static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};
    double product[9]; /* row a: tensor times row a of the rotation */
    for (int a = 0; a < 3; ++a) {
        mor_symmetric_apply(tensor, rotation + 3 * a, product + 3 * a);
    }
    for (int m = 0; m < 6; ++m) {
        tensor[m] = mor_vector_dot(product + 3 * ROW[m], rotation + 3 * COLUMN[m]);
    }
}

/** Half of the rotation of a step by Cayley's formula, with q a quarter of its vector: I + 2/(1 + q.q) ([q] + [q][q]).
 *  Two halves are the step's angle up to a part of angle^2/48.
 *  @param l        [in]   shape [3,3], velocity gradient, 1/s
 *  @param length   [in]   of the step, s
 *  @param rotation [out]  shape [3,3], 1
 *  Returns: whether there is any. */
static inline int mor_half_rotation_find(const double *l, double length, double *rotation)
{
    const double w = 0.125 * length;
    const double q[3] = {w * (l[7] - l[5]), w * (l[2] - l[6]), w * (l[3] - l[1])};
    const double square = mor_vector_dot(q, q);
    const double f = 2.0 / (1.0 + square);
    for (int a = 0; a < 3; ++a) {
        for (int c = 0; c < 3; ++c) {
            rotation[3 * a + c] = f * q[a] * q[c] + (a == c ? 1.0 - f * square : 0.0);
        }
    }
    rotation[1] -= f * q[2];
    rotation[2] += f * q[1];
    rotation[3] += f * q[2];
    rotation[5] -= f * q[0];
    rotation[6] -= f * q[1];
    rotation[7] += f * q[0];
    return square > 0.0;
}

#endif
