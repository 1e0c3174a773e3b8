/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_NEO_HOOKEAN_H
#define MOR_MATERIALS_NEO_HOOKEAN_H

#include "core/material/kit/material.h"

/** @file
 *  Compressible Neo-Hookean solid, Zhang et al. (2024) eqs. 39 to 41:
 *  W = mu tr(E) - mu ln J + lambda/2 (ln J)^2, S = mu (I - C^-1) + lambda ln(J) C^-1, P = F S.
 *  W is zero without deformation. docs/theory/elastic.md. */

/** The model. Parameters: materials/hooke.h. */
extern const mor_material mor_neo_hookean;

#endif
