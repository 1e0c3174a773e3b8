/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_PARTS_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_PARTS_H

#include "core/base/context.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  Connected parts of a body of particles. Theory: docs/theory/strength_reduction.md, The critical body. */

/** Takes out of a body the parts that are small beside its largest one, such as single grains that rolled.
 *  @param positions [in]      shape [n, 3], m
 *  @param n         [in]      particles
 *  @param reach     [in]      particles nearer than this are connected, m
 *  @param share     [in]      parts of fewer particles than this share of the largest are taken out, 1
 *  @param is_part   [in,out]  shape [n]; which particles are part of the body
 *  Returns: MOR_OK; MOR_ERROR_MEMORY, with is_part as it was. */
mor_status mor_safety_parts_keep(mor_context *context, const double *positions, int64_t n, double reach, double share,
                                 bool *is_part);

#endif
