/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_LANE_MATH_H
#define MOR_MATERIALS_FRAME_LANE_MATH_H

#include "core/material/kit/lanes.h"

#include <stdint.h>
#include <string.h>

/** @file
 *  Exponential and logarithm without branches and calls, so that a loop over lanes stays one of vectors; the same bits
 *  with any instruction set. Relative error below 1e-15, or absolute near a logarithm of zero. */

/** Returns the bits of a number of any unit, 1. */
static MOR_LANES_INLINE uint64_t mor_lane_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/** Returns the number of any unit that has these bits, 1. */
static MOR_LANES_INLINE double mor_lane_number(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/** Returns exp(x); x is taken as -700 below and 700 above these; NaN gives some number. Unit 1.
 *  exp(x) = 2^k exp(r) with |r| <= ln(2)/2 and Taylor's polynomial of degree 13. */
static MOR_LANES_INLINE double mor_lane_exp(double x)
{
    static const double inverse_ln2 = 1.44269504088896340736;
    static const double ln2_high = 6.93147180369123816490e-01;
    static const double ln2_low = 1.90821492927058770002e-10;
    static const double shift = 6755399441055744.0; /* 1.5 * 2^52: the sum has k in its last bits */
    const double above = x > -700.0 ? x : -700.0;
    const double inside = above < 700.0 ? above : 700.0;
    const double sum = inside * inverse_ln2 + shift;
    const double k = sum - shift;
    const double r = (inside - k * ln2_high) - k * ln2_low;
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p = p * r + 1.0;
    return mor_lane_number(mor_lane_bits(p) + (mor_lane_bits(sum) << 52));
}

/** Returns ln(x) for a normal x > 0; for others some number. Unit 1.
 *  x = 2^k m with m from sqrt(1/2) to sqrt(2), ln(m) = 2 artanh((m - 1)/(m + 1)) by its series. */
static MOR_LANES_INLINE double mor_lane_log(double x)
{
    static const double ln2_high = 6.93147180369123816490e-01;
    static const double ln2_low = 1.90821492927058770002e-10;
    const uint64_t one = UINT64_C(0x3FF0000000000000);
    const uint64_t root_half = UINT64_C(0x3FE6A09E667F3BCD);
    const uint64_t bits = mor_lane_bits(x);
    const uint64_t biased = (bits + (one - root_half)) >> 52;
    const double m = mor_lane_number(bits - (biased << 52) + one);
    /* The bits of 2^52 + biased: a conversion that all instruction sets have. */
    const double k = mor_lane_number(biased | UINT64_C(0x4330000000000000)) - (4503599627370496.0 + 1023.0);
    const double f = (m - 1.0) / (m + 1.0);
    const double s = f * f;
    double p = 1.0 / 21.0;
    p = p * s + 1.0 / 19.0;
    p = p * s + 1.0 / 17.0;
    p = p * s + 1.0 / 15.0;
    p = p * s + 1.0 / 13.0;
    p = p * s + 1.0 / 11.0;
    p = p * s + 1.0 / 9.0;
    p = p * s + 1.0 / 7.0;
    p = p * s + 1.0 / 5.0;
    p = p * s + 1.0 / 3.0;
    p = p * s + 1.0;
    return k * ln2_high + (2.0 * f * p + k * ln2_low);
}

#endif
