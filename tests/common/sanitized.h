/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SANITIZED_H
#define MOR_TESTS_COMMON_SANITIZED_H

/** @file
 *  Sanitizers make programs six to twenty times as slow. Tests that only repeat what memory errors others would show,
 *  with more particles or more often, leave that out there. */

#if defined(__SANITIZE_ADDRESS__)
enum { TEST_IS_SANITIZED = 1 };
#else
enum { TEST_IS_SANITIZED = 0 };
#endif

#endif
