/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Differences of stress once more, with pairs in single precision. */
#define MOR_SINGLE 1
#include "core/sph/pair/pair_differences_isa.c"
