/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_NEAR_H
#define MOR_TESTS_COMMON_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/** @file
 *  Comparison of numbers in double precision: assert_float_equal of cmocka compares in single precision. */

/** Fails with both numbers, any unit, unless they are within a tolerance. */
static inline void assert_near(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("%.17g, expected %.17g, off by %.3g, allowed %.3g", found, expected, found - expected, tolerance);
    }
}

#endif
