/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_LANE_MATH_H
#define MOR_CORE_PARTICLE_LANE_MATH_H

#include "core/base/math.h"
#include "core/particle/lanes.h"

#include <math.h>
#include <stddef.h>

/** @file
 *  Choices between lanes, tensors in lanes, and rows of records read and written at once. Only files named *_isa.c
 *  include it; not for others: the names are short. */

/** A mask for each lane: all bits or none. */
typedef bits mask __attribute__((vector_size(WIDTH * sizeof(bits))));

/** Returns one number, any unit, in all lanes. */
INLINE vec broadcast(real a)
{
    return a - (vec){0.0};
}

/** Writes zeros to n_bytes at a, on a boundary of a register and a whole number of them. A compiler that knew of the
 *  zeros would call for a string move, which takes longer to start. */
INLINE void set_zero(void *a, const size_t n_bytes)
{
    typedef real any_vec __attribute__((vector_size(WIDTH * sizeof(real)), may_alias));
    any_vec zero = broadcast(0.0);
#if defined(__SSE2__)
    __asm__("" : "+x"(zero));
#endif
    for (size_t k = 0; k < n_bytes / sizeof zero; ++k) {
        ((any_vec *)a)[k] = zero;
    }
}

/** Returns a where the mask is set, b elsewhere; any unit. */
INLINE vec select_lanes(mask where, vec a, vec b)
{
    return (vec)(((mask)a & where) | ((mask)b & ~where));
}

/* The names of the instructions that fill a register, where there are any. */
#if TARGETS == 2
#define WIDE(operation) _mm512_##operation##_ps
typedef __m512 wide;
#elif defined(MOR_SINGLE) && defined(__AVX__) && defined(__FMA__)
#define WIDE(operation) _mm256_##operation##_ps
typedef __m256 wide;
#elif defined(__AVX512F__)
#define WIDE(operation) _mm512_##operation##_pd
typedef __m512d wide;
#define HAS_TRANSPOSE 1
#elif defined(__AVX__) && defined(__FMA__)
#define WIDE(operation) _mm256_##operation##_pd
typedef __m256d wide;
#endif

/** Returns the larger of two lanes, the second when one is no number; any unit. */
INLINE vec larger(vec a, vec b)
{
#if defined(WIDE)
    return (vec)WIDE(max)((wide)a, (wide)b);
#else
    return select_lanes(a > b, a, b);
#endif
}

/** Returns the smaller of two lanes, the second when one is no number; any unit. */
INLINE vec smaller(vec a, vec b)
{
#if defined(WIDE)
    return (vec)WIDE(min)((wide)a, (wide)b);
#else
    return select_lanes(a < b, a, b);
#endif
}

/** Returns the square roots; any unit. */
INLINE vec square_root(vec a)
{
#if TARGETS == 2
    return (vec)_mm512_sqrt_ps((__m512)a);
#else
    vec root;
    for (int lane = 0; lane < LANES; ++lane) {
        root[lane] = sizeof(real) == sizeof(float) ? (real)sqrtf((float)a[lane]) : (real)sqrt(a[lane]);
    }
    return root;
#endif
}

/** Returns the number of lanes from a first particle on that hold particles of the set, 1. */
INLINE int lanes_of(int64_t first, int64_t n_particles)
{
    const int64_t left = n_particles - first;
    return left < LANES ? (left > 0 ? (int)left : 0) : LANES;
}

#if defined(HAS_TRANSPOSE)
/** Returns a pointer whose rows the compiler addresses from it, and not each by a register of its own.
 *  @param records [in]  shape [8, any stride], any unit */
INLINE const double *as_base(const double *records)
{
    __asm__("" : "+r"(records));
    return records;
}

/** Exchanges rows and columns, both shape [8, 8], any unit; columns that nobody reads cost nothing. */
INLINE void transpose(const __m512d *rows, __m512d *columns)
{
    for (int odd = 0; odd < 2; ++odd) {
        __m512d pairs[4];
        for (int k = 0; k < 4; ++k) {
            pairs[k] = odd ? _mm512_unpackhi_pd(rows[2 * k], rows[2 * k + 1])
                           : _mm512_unpacklo_pd(rows[2 * k], rows[2 * k + 1]);
        }
        const __m512d near_low = _mm512_shuffle_f64x2(pairs[0], pairs[1], 0x88);
        const __m512d near_high = _mm512_shuffle_f64x2(pairs[2], pairs[3], 0x88);
        const __m512d far_low = _mm512_shuffle_f64x2(pairs[0], pairs[1], 0xdd);
        const __m512d far_high = _mm512_shuffle_f64x2(pairs[2], pairs[3], 0xdd);
        columns[odd] = _mm512_shuffle_f64x2(near_low, near_high, 0x88);
        columns[odd + 2] = _mm512_shuffle_f64x2(far_low, far_high, 0x88);
        columns[odd + 4] = _mm512_shuffle_f64x2(near_low, near_high, 0xdd);
        columns[odd + 6] = _mm512_shuffle_f64x2(far_low, far_high, 0xdd);
    }
}
#endif

#if defined(HAS_TRANSPOSE)
/** Writes the first n numbers of a register to out, shape [n], any unit, by stores of whole words: a load that follows
 *  waits for a masked store that it overlaps, even where the mask is empty. */
INLINE void store_row(double *out, const int n, __m512d row)
{
    const __m256d high = _mm512_extractf64x4_pd(row, 1);
    const __m256d low = _mm512_castpd512_pd256(row);
    const __m256d rest = n & 4 ? high : low;
    const __m128d pair = n & 2 ? _mm256_extractf128_pd(rest, 1) : _mm256_castpd256_pd128(rest);
    if (n == 8) {
        _mm512_storeu_pd(out, row);
        return;
    }
    if (n & 4) {
        _mm256_storeu_pd(out, low);
    }
    if (n & 2) {
        _mm_storeu_pd(out + (n & 4), _mm256_castpd256_pd128(rest));
    }
    if (n & 1) {
        _mm_storel_pd(out + (n & 6), pair);
    }
}
#endif

#if defined(MOR_SINGLE) && defined(__AVX__)
/** Exchanges rows and columns, both shape [8, 8], any unit; columns that nobody reads cost nothing. */
INLINE void transpose_singles(const __m256 *rows, __m256 *columns)
{
    for (int half = 0; half < 2; ++half) {
        __m256 pairs[4]; /* rows k and k + 4 in the halves of a register */
        for (int k = 0; k < 4; ++k) {
            pairs[k] = half ? _mm256_permute2f128_ps(rows[k], rows[k + 4], 0x31)
                            : _mm256_insertf128_ps(rows[k], _mm256_castps256_ps128(rows[k + 4]), 1);
        }
        const __m256 low01 = _mm256_unpacklo_ps(pairs[0], pairs[1]);
        const __m256 low23 = _mm256_unpacklo_ps(pairs[2], pairs[3]);
        const __m256 high01 = _mm256_unpackhi_ps(pairs[0], pairs[1]);
        const __m256 high23 = _mm256_unpackhi_ps(pairs[2], pairs[3]);
        columns[4 * half] = _mm256_shuffle_ps(low01, low23, 0x44);
        columns[4 * half + 1] = _mm256_shuffle_ps(low01, low23, 0xee);
        columns[4 * half + 2] = _mm256_shuffle_ps(high01, high23, 0x44);
        columns[4 * half + 3] = _mm256_shuffle_ps(high01, high23, 0xee);
    }
}
#endif

/** Reads the first n components, at most 8, of consecutive records, shape [LANES, stride], any unit, into out,
 *  shape [n]. */
INLINE void load_first(const real *records, int stride, const int n, vec *out)
{
#if defined(MOR_SINGLE) && defined(__AVX__)
    __m256 rows[8];
    __m256 columns[8];
    for (int lane = 0; lane < 8; ++lane) {
        rows[lane] = _mm256_loadu_ps(records + lane * stride);
    }
    transpose_singles(rows, columns);
    for (int a = 0; a < n; ++a) {
        out[a] = in_lanes((particles_vec)columns[a]);
    }
#elif defined(HAS_TRANSPOSE)
    __m512d rows[8];
    __m512d columns[8];
    const double *base = as_base(records);
    for (int lane = 0; lane < 8; ++lane) {
        rows[lane] = _mm512_maskz_loadu_pd((__mmask8)((1 << n) - 1), base + lane * stride);
    }
    transpose(rows, columns);
    for (int a = 0; a < n; ++a) {
        out[a] = (vec)columns[a];
    }
#else
    for (int a = 0; a < n; ++a) {
        out[a] = load(records, stride, a);
    }
#endif
}

#if TARGETS == 1
/** Writes the first n_lanes lanes of a, shape [n], any unit, to the first n components, at most 8, of consecutive
 *  records, shape [n_lanes, stride]. */
INLINE void store_first(real *records, int stride, const int n, int n_lanes, const vec *a)
{
#if defined(HAS_TRANSPOSE)
    __m512d columns[8];
    __m512d rows[8];
    for (int k = 0; k < 8; ++k) {
        columns[k] = (__m512d)(k < n ? a[k] : broadcast(0.0));
    }
    transpose(columns, rows);
    double *base = (double *)as_base(records);
    for (int lane = 0; lane < 8 && n_lanes == 8; ++lane) {
        store_row(base + lane * stride, n, rows[lane]);
    }
    for (int lane = 0; lane < n_lanes && n_lanes < 8; ++lane) {
        store_row(base + lane * stride, n, rows[lane]);
    }
#else
    for (int k = 0; k < n; ++k) {
        store(records, stride, k, n_lanes, a[k]);
    }
#endif
}
#endif

/** Finds the cofactors of symmetric tensors, both shape [6], not aliased; unit: square of the tensors'. Returns their
 *  determinants, unit: cube of the tensors'. Of dimension 2: yz and zx are zero. */
INLINE vec symmetric_cofactors(const vec *m, vec *cofactors, const int dimension)
{
    vec *c = cofactors;
    c[MOR_ZZ] = m[MOR_XX] * m[MOR_YY] - m[MOR_XY] * m[MOR_XY];
    if (dimension == 2) {
        c[MOR_XX] = m[MOR_YY] * m[MOR_ZZ];
        c[MOR_YY] = m[MOR_XX] * m[MOR_ZZ];
        c[MOR_XY] = -m[MOR_XY] * m[MOR_ZZ];
        c[MOR_YZ] = c[MOR_ZX] = broadcast(0.0);
        return m[MOR_XX] * c[MOR_XX] + m[MOR_XY] * c[MOR_XY];
    }
    c[MOR_XX] = m[MOR_YY] * m[MOR_ZZ] - m[MOR_YZ] * m[MOR_YZ];
    c[MOR_YY] = m[MOR_XX] * m[MOR_ZZ] - m[MOR_ZX] * m[MOR_ZX];
    c[MOR_XY] = m[MOR_ZX] * m[MOR_YZ] - m[MOR_XY] * m[MOR_ZZ];
    c[MOR_YZ] = m[MOR_XY] * m[MOR_ZX] - m[MOR_XX] * m[MOR_YZ];
    c[MOR_ZX] = m[MOR_XY] * m[MOR_YZ] - m[MOR_ZX] * m[MOR_YY];
    return m[MOR_XX] * c[MOR_XX] + m[MOR_XY] * c[MOR_XY] + m[MOR_ZX] * c[MOR_ZX];
}

#endif
