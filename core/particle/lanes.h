/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_LANES_H
#define MOR_CORE_PARTICLE_LANES_H

#include "core/base/isa.h"
#include "core/particle/tree.h"

#if defined(__AVX__)
#include <immintrin.h>
#endif

/** @file
 *  Numbers in lanes, for loops over clusters of eight particles that are compiled once per instruction set. Only files
 *  named *_isa.c include it; MOR_ISA is the name of the set. Not for others: the names are short. */

/* A file that defines MOR_SINGLE before it includes anything computes in single precision: real is its number, and
 * bits an integer as wide. */
#if defined(MOR_SINGLE)
typedef float real;
typedef int32_t bits;
typedef uint32_t unsigned_bits;
#else
typedef double real;
typedef int64_t bits;
typedef uint64_t unsigned_bits;
#endif

/* Particles in one register. A cluster of eight is served in 8 / LANES parts, each with the arithmetic of the others,
 * so that a particle's sums do not depend on the width. Eight singles fill half of the widest register, and a cluster
 * has no more: there each particle has two lanes next to one another, for two TARGETS of a loop over pairs, unless the
 * file defines MOR_ONE_TARGET. */
#if defined(__AVX512F__) || (defined(__AVX__) && defined(MOR_SINGLE))
#define LANES 8
#elif defined(MOR_SINGLE)
#define LANES 4
#elif defined(__AVX__)
#define LANES 4
#else
#define LANES 2
#endif
#if defined(__AVX512F__) && defined(MOR_SINGLE) && !defined(MOR_ONE_TARGET)
#define TARGETS 2
#else
#define TARGETS 1
#endif
enum { PARTS = MOR_CLUSTER / LANES, WIDTH = LANES * TARGETS };

/** One number for each of LANES particles and each of TARGETS. */
typedef real vec __attribute__((vector_size(WIDTH * sizeof(real))));

#define INLINE static inline __attribute__((always_inline))

/* For functions that stay out of the loops that call them. GCC 12 drops calls whose effects it takes to be none. */
#if defined(__clang__)
#define OPAQUE __attribute__((noinline)) static
#else
#define OPAQUE __attribute__((noipa)) static
#endif

/** Returns a number other than zero when any lane of a is less than b, else zero; any unit. With two targets it has a
 *  bit for each lane that is. */
INLINE int any_less(vec a, real b)
{
#if TARGETS == 2
    return _mm512_cmp_ps_mask((__m512)a, _mm512_set1_ps(b), _CMP_LT_OQ);
#elif defined(MOR_SINGLE) && defined(__AVX__)
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)a, _mm256_set1_ps(b), _CMP_LT_OQ));
#elif defined(__AVX512F__)
    return _mm512_cmp_pd_mask((__m512d)a, _mm512_set1_pd(b), _CMP_LT_OQ);
#elif defined(__AVX__)
    return _mm256_movemask_pd(_mm256_cmp_pd((__m256d)a, _mm256_set1_pd(b), _CMP_LT_OQ));
#else
    int any = 0;
    for (int lane = 0; lane < LANES; ++lane) {
        any |= a[lane] < b;
    }
    return any;
#endif
}

/** One number for each of LANES particles. */
typedef real particles_vec __attribute__((vector_size(LANES * sizeof(real))));

/** Returns the numbers of particles, any unit, in all of their lanes. */
INLINE vec in_lanes(particles_vec a)
{
#if TARGETS == 2
    const __m512i particles = _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0);
    return (vec)_mm512_permutexvar_ps(particles, _mm512_castps256_ps512((__m256)a));
#else
    return a;
#endif
}

/** Returns one component of consecutive records, shape [LANES, stride]; any unit. */
INLINE vec load(const real *records, int stride, int component)
{
    particles_vec a;
    for (int lane = 0; lane < LANES; ++lane) {
        a[lane] = records[lane * stride + component];
    }
    return in_lanes(a);
}

#if TARGETS == 1
/** Writes the first n_lanes lanes to one component of records, shape [n_lanes, stride]; any unit. */
INLINE void store(real *out, int stride, int component, int n_lanes, vec a)
{
    if (n_lanes == LANES) {
        /* Straight from the register, whose lanes a loop of unknown length would look up in memory. */
        for (int lane = 0; lane < LANES; ++lane) {
            out[lane * stride + component] = a[lane];
        }
        return;
    }
    for (int lane = 0; lane < n_lanes; ++lane) {
        out[lane * stride + component] = a[lane];
    }
}
#endif

#endif
