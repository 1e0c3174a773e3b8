/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The momentum loop once more, with pairs in single precision. */
#define MOR_SINGLE 1
#include "core/sph/pair/pair_momentum_isa.c"
