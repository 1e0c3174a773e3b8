/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_HYPOELASTIC_H
#define MOR_MATERIALS_HYPOELASTIC_H

#include "core/material/kit/material.h"

/** @file
 *  Hooke's law between the Jaumann rate of the Cauchy stress and the strain rate: the elastic solid of
 *  updated-Lagrangian SPH. Rotation is exact (Hughes and Winget (1980)). For strains well below 1: in simple shear the
 *  Jaumann rate makes the stress oscillate, G sin(gamma). docs/theory/elastic.md. */

/** The model. Parameters: materials/hooke.h. Stored energy is per current volume; no work is dissipated. */
extern const mor_material mor_hypoelastic;

#endif
