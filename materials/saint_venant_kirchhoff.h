/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_SAINT_VENANT_KIRCHHOFF_H
#define MOR_MATERIALS_SAINT_VENANT_KIRCHHOFF_H

#include "core/material/kit/material.h"

/** @file
 *  Hooke's law between Green-Lagrange strain E and second Piola-Kirchhoff stress: S = lambda tr(E) I + 2 mu E, P = F S.
 *  For large rotations and small strains; it softens in strong compression. docs/theory/elastic.md. */

/** The model. Parameters: materials/hooke.h. */
extern const mor_material mor_saint_venant_kirchhoff;

#endif
