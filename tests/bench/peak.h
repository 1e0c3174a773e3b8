/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_BENCH_PEAK_H
#define MOR_TESTS_BENCH_PEAK_H

#include "cases/driver/run/wall_time.h"
#include "core/base/isa.h"
#include "core/sph/pair/pair.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/** @file
 *  What one core of this processor can do at most, measured: a speed on one machine can be judged on another by the
 *  share of the peak that it reaches. */

/** Peaks of one core, with the widest registers that the loops over pairs use. */
typedef struct bench_peak {
    const char *instruction_set; /* as mor_isa_name */
    int register_bits;           /* of the registers, 1 */
    double double_gflops;        /* fused multiply-adds count as two, 1e9/s */
    double single_gflops;        /* the same in single precision, 1e9/s */
    double root_ns;              /* of a square root of a register of doubles, ns */
    double division_ns;          /* of a division of registers of doubles, ns */
    double memory_gb;            /* a = b + 3 c in memory, read and written, 1e9 bytes/s */
} bench_peak;

/** Runs n operations of one kind, each on registers that do not wait for one another; returns a number so that no
 *  compiler leaves them out. */
typedef double (*bench_operation)(int64_t n);

/* BENCH_TRIAD: numbers in an array, of which three must not fit into a cache. */
enum { BENCH_CHAINS = 12, BENCH_TRIALS = 5, BENCH_TRIAD = 32 << 20 };

/* The operations of one instruction set. Registers hold numbers near one throughout. */
#define BENCH_OPERATION(name, set, type, bytes, formula)                                                               \
    __attribute__((set, noinline)) static double name(int64_t n)                                                       \
    {                                                                                                                  \
        typedef type vec __attribute__((vector_size(bytes)));                                                          \
        vec a[BENCH_CHAINS];                                                                                           \
        vec x = (vec){0} + (type)0.999;                                                                                \
        vec y = (vec){0} + (type)0.001;                                                                                \
        __asm__ volatile("" : "+x"(x), "+x"(y));                                                                       \
        for (int k = 0; k < BENCH_CHAINS; ++k) {                                                                       \
            a[k] = x + (type)k * y;                                                                                    \
        }                                                                                                              \
        for (int64_t i = 0; i < n; i += BENCH_CHAINS) {                                                                \
            _Pragma("GCC unroll 12") for (int k = 0; k < BENCH_CHAINS; ++k)                                            \
            {                                                                                                          \
                a[k] = (formula);                                                                                      \
            }                                                                                                          \
        }                                                                                                              \
        double sum = 0.0;                                                                                              \
        for (int k = 0; k < BENCH_CHAINS; ++k) {                                                                       \
            sum += (double)a[k][0];                                                                                    \
        }                                                                                                              \
        return sum;                                                                                                    \
    }
#define BENCH_OPERATIONS(isa, set, bytes, doubles, singles, root)                                                      \
    BENCH_OPERATION(bench_doubles_##isa, set, double, bytes, (vec)doubles)                                             \
    BENCH_OPERATION(bench_singles_##isa, set, float, bytes, (vec)singles)                                              \
    BENCH_OPERATION(bench_root_##isa, set, double, bytes, (vec)root)                                                   \
    BENCH_OPERATION(bench_division_##isa, set, double, bytes, x / a[k])

#if defined(__SSE2__)
/* Without fused operations a multiplication and an addition take their place. */
BENCH_OPERATIONS(baseline, unused, 16, (a[k] * x + y), (a[k] * x + y), _mm_sqrt_pd((__m128d)a[k]))
BENCH_OPERATIONS(avx2, target("avx2,fma"), 32, _mm256_fmadd_pd((__m256d)a[k], (__m256d)x, (__m256d)y),
                 _mm256_fmadd_ps((__m256)a[k], (__m256)x, (__m256)y), _mm256_sqrt_pd((__m256d)a[k]))
BENCH_OPERATIONS(avx512, target("avx512f,fma"), 64, _mm512_fmadd_pd((__m512d)a[k], (__m512d)x, (__m512d)y),
                 _mm512_fmadd_ps((__m512)a[k], (__m512)x, (__m512)y), _mm512_sqrt_pd((__m512d)a[k]))
#endif

/* The shortest time of an operation, ns. */
static inline double bench_time_operation(bench_operation run)
{
    static volatile double sink;
    const int64_t n = (int64_t)BENCH_CHAINS * 400000;
    double least = INFINITY;
    for (int trial = 0; trial < BENCH_TRIALS; ++trial) {
        const double start = mor_wall_time();
        sink = run(n);
        least = fmin(least, mor_wall_time() - start);
    }
    (void)sink;
    return 1.0e9 * least / (double)n;
}

/* The memory bandwidth of a thread, 1e9 bytes/s; not a number where there is no room to measure it. */
static inline double bench_time_memory(void)
{
    double *a = malloc((size_t)BENCH_TRIAD * 3 * sizeof *a);
    double least = INFINITY;
    if (a == NULL) {
        return NAN;
    }
    double *b = a + BENCH_TRIAD;
    double *c = b + BENCH_TRIAD;
    for (int64_t i = 0; i < (int64_t)BENCH_TRIAD * 3; ++i) { /* pages that nobody has written are all the same one */
        a[i] = 1.0 + (double)(i % 7);
    }
    for (int trial = 0; trial < BENCH_TRIALS; ++trial) {
        const double start = mor_wall_time();
        for (int64_t i = 0; i < BENCH_TRIAD; ++i) {
            a[i] = b[i] + 3.0 * c[i];
        }
        __asm__ volatile("" : : "r"(a) : "memory");
        least = fmin(least, mor_wall_time() - start);
    }
    free(a);
    return 1.0e-9 * 3.0 * sizeof(double) * BENCH_TRIAD / least;
}

/** Returns the instruction set of the loops over pairs on this processor, MOR_ISA_.... */
static inline int bench_instruction_set(void)
{
    const mor_pair_table *table = mor_pair_select(NULL);
    int isa = MOR_ISA_COUNT - 1;
    while (isa > MOR_ISA_BASELINE && strcmp(table->instruction_set, mor_isa_name(isa)) != 0) {
        --isa;
    }
    return isa;
}

/** Measures the peaks of one core; takes about two seconds and 800 MB. */
static inline bench_peak bench_measure_peak(void)
{
    const int isa = bench_instruction_set();
    bench_peak it = {.instruction_set = mor_isa_name(isa), .memory_gb = bench_time_memory()};
#if defined(__SSE2__)
    static const bench_operation operations[MOR_ISA_COUNT][4] = {
        {bench_doubles_baseline, bench_singles_baseline, bench_root_baseline, bench_division_baseline},
        {bench_doubles_avx2, bench_singles_avx2, bench_root_avx2, bench_division_avx2},
        {bench_doubles_avx512, bench_singles_avx512, bench_root_avx512, bench_division_avx512},
    };
    it.register_bits = 128 << isa;
    it.double_gflops = 2.0 * it.register_bits / 64.0 / bench_time_operation(operations[isa][0]);
    it.single_gflops = 2.0 * it.register_bits / 32.0 / bench_time_operation(operations[isa][1]);
    it.root_ns = bench_time_operation(operations[isa][2]);
    it.division_ns = bench_time_operation(operations[isa][3]);
#endif
    return it;
}

/** Prints peaks as one line. */
static inline void bench_print_peak(FILE *file, const bench_peak *it)
{
    if (it->register_bits > 0) {
        fprintf(file,
                "one core, %s: %.0f GFlop/s in double, %.0f in single precision; square root %.2f ns, division %.2f ns "
                "of %d bits; ",
                it->instruction_set, it->double_gflops, it->single_gflops, it->root_ns, it->division_ns,
                it->register_bits);
    }
    fprintf(file, "%.0f GB/s from memory\n", it->memory_gb);
}

#endif
