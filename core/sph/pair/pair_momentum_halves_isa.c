/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The momentum loop in single precision with one target in a register of 256 bits, for processors that work on
 * registers of 512 bits in two halves. Of other instruction sets it is that of pair_momentum_mixed_isa.c. */
#define MOR_SINGLE 1
#define MOR_ONE_TARGET 1
#include "core/particle/lanes.h"

#if defined(__AVX512F__)
#include "core/sph/pair/pair_momentum_isa.c"
#endif
