/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_RANDOM_H
#define MOR_CORE_BASE_RANDOM_H

#include <stdint.h>

/** @file
 *  Counter-based random numbers: a pure function of (seed, particle id, purpose), so that they depend neither on the
 *  order of calls nor on threads. The mixer is the finalizer of SplitMix64 (Steele et al. 2014). */

/** Mixes 64 bits. */
static inline uint64_t mor_random_mix(uint64_t x)
{
    x += 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

/** Uniform number in [0, 1), 1, for a seed, an id and a purpose. */
static inline double mor_random_uniform(uint64_t seed, uint64_t id, uint64_t purpose)
{
    const uint64_t bits = mor_random_mix(mor_random_mix(mor_random_mix(seed) ^ id) ^ purpose);
    return (double)(bits >> 11) * (1.0 / 9007199254740992.0);
}

#endif
