/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_LANES_H
#define MOR_CORE_PARTICLE_LANES_H

#include "core/base/isa.h"
#include "core/particle/tree.h"

/** @file
 *  Numbers in lanes, for loops over clusters of eight particles that are compiled once per instruction set. Only files
 *  named *_isa.c include it; MOR_ISA is the name of the set. Not for others: the names are short. */

/* A file that defines MOR_SINGLE before it includes anything computes in single precision: real is its number, and
 * bits an integer as wide. */
#if defined(MOR_SINGLE)
typedef float real;
typedef int32_t bits;
#else
typedef double real;
typedef int64_t bits;
#endif

/* Numbers in one register. A cluster of eight is served in 8 / LANES parts, each with the arithmetic of the others, so
 * that a particle's sums do not depend on the width. Eight singles fill half of the widest register: a cluster has no
 * more. */
#if defined(__AVX512F__) || (defined(__AVX__) && defined(MOR_SINGLE))
#define LANES 8
#elif defined(MOR_SINGLE)
#define LANES 4
#elif defined(__AVX__)
#define LANES 4
#else
#define LANES 2
#endif
enum { PARTS = MOR_CLUSTER / LANES };

/** One number for each of LANES particles. */
typedef real vec __attribute__((vector_size(LANES * sizeof(real))));

#define INLINE static inline __attribute__((always_inline))

/** Returns one component of consecutive records, shape [LANES, stride]; any unit. */
INLINE vec load(const real *records, int stride, int component)
{
    vec a;
    for (int lane = 0; lane < LANES; ++lane) {
        a[lane] = records[lane * stride + component];
    }
    return a;
}

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
