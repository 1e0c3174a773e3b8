/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_LANES_H
#define MOR_CORE_MATERIAL_KIT_LANES_H

#include "core/base/isa.h"
#include "core/base/status.h"
#include "core/material/kit/batch.h"

/** @file
 *  For models that work on several particles at once: the number of lanes of a block. Such a model is one file
 *  *_isa.c, compiled once per instruction set, see core/base/isa.h; without fused multiply-add, so that all variants
 *  give the same bits. */

/** Particles per block; a multiple of the vector width of every instruction set below. */
enum { MOR_LANES = 16 };

/** For functions called from a loop over lanes: they must vanish into it. */
#define MOR_LANES_INLINE inline __attribute__((always_inline))

#endif
