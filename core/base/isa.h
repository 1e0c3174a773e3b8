/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_ISA_H
#define MOR_CORE_BASE_ISA_H

#include <stddef.h>
#include <string.h>

/** @file
 *  One source text for several instruction sets. A file named *_isa.c is compiled once for each, with MOR_ISA as its
 *  name; what it exports it names with MOR_ISA_NAME, so that the variants live side by side. Whoever calls them asks
 *  mor_isa_select which one this processor takes. The only place that asks about the processor.
 *
 *  The build tells with MOR_HAS_ISA_AVX2 and MOR_HAS_ISA_AVX512, 1 or undefined, which variants exist beside baseline.
 *  A plug-in does the same: it compiles its file several times, with -DMOR_ISA=baseline, then -DMOR_ISA=avx2 -mavx2
 *  -mfma, and one more with -DMOR_HAS_ISA_AVX2=1 that chooses. All functions are inline: no library is needed. */

#ifndef MOR_ISA
#define MOR_ISA baseline
#endif

#define MOR_ISA_JOIN_(stem, name) stem##_##name
#define MOR_ISA_JOIN(stem, name) MOR_ISA_JOIN_(stem, name)
#define MOR_ISA_TEXT_(name) #name
#define MOR_ISA_TEXT(name) MOR_ISA_TEXT_(name)

/** The name of something in the variant that is being compiled: stem_baseline, stem_avx2 or stem_avx512. */
#define MOR_ISA_NAME(stem) MOR_ISA_JOIN(stem, MOR_ISA)

/** Instruction sets, from the slowest to the fastest. */
enum { MOR_ISA_BASELINE, MOR_ISA_AVX2, MOR_ISA_AVX512, MOR_ISA_COUNT };

#if defined(MOR_HAS_ISA_AVX2)
#define MOR_ISA_AVX2_OF(stem) stem##_avx2
#else
#define MOR_ISA_AVX2_OF(stem) NULL
#endif
#if defined(MOR_HAS_ISA_AVX512)
#define MOR_ISA_AVX512_OF(stem) stem##_avx512
#else
#define MOR_ISA_AVX512_OF(stem) NULL
#endif

/** Initializer of an array [MOR_ISA_COUNT] of the variants of a function or object; NULL where one was not built. */
#define MOR_ISA_VARIANTS(stem)                                                                                         \
    {                                                                                                                  \
        stem##_baseline, MOR_ISA_AVX2_OF(stem), MOR_ISA_AVX512_OF(stem)                                                \
    }

/** Declares all variants of a function: MOR_ISA_DECLARE(const table *, table_of, (void)); */
#define MOR_ISA_DECLARE(type, stem, arguments)                                                                         \
    type stem##_baseline arguments;                                                                                    \
    type stem##_avx2 arguments;                                                                                        \
    type stem##_avx512 arguments

/** Name of an instruction set, as in MOR_ISA.
 *  @param isa [in]  0 <= isa < MOR_ISA_COUNT
 *  Returns: a static text. */
static inline const char *mor_isa_name(int isa)
{
    static const char *const names[MOR_ISA_COUNT] = {"baseline", "avx2", "avx512"};
    return names[isa];
}

/** Whether a variant was built and runs on this processor: 1 or 0.
 *  @param isa [in]  0 <= isa < MOR_ISA_COUNT */
static inline int mor_isa_is_usable(int isa)
{
#if defined(MOR_HAS_ISA_AVX512)
    if (isa == MOR_ISA_AVX512) {
        __builtin_cpu_init();
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    }
#endif
#if defined(MOR_HAS_ISA_AVX2)
    if (isa == MOR_ISA_AVX2) {
        __builtin_cpu_init();
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    }
#endif
    return isa == MOR_ISA_BASELINE;
}

/** Whether this processor works on registers of 512 bits in two halves, so that they take as long as two of 256 bits:
 *  1 or 0. Those of AMD's family 25 that have AVX-512 do (Zen 4). */
static inline int mor_isa_has_halves(void)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_is("amdfam19h");
#else
    return 0;
#endif
}

/** The variant to take: the fastest that was built and runs on this processor, always the same on one machine; or the
 *  one asked for, as tests do.
 *  @param name [in]  zero-terminated; "baseline", "avx2", "avx512"; nullable: the fastest
 *  Returns: its place in MOR_ISA_VARIANTS; -1 when the one asked for is unknown, was not built, or does not run here.
 *  Threads: safe to call concurrently. */
static inline int mor_isa_select(const char *name)
{
    int isa = MOR_ISA_COUNT - 1;
    while (isa >= 0 && !(mor_isa_is_usable(isa) && (name == NULL || strcmp(name, mor_isa_name(isa)) == 0))) {
        --isa;
    }
    return isa;
}

#endif
