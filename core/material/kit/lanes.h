/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_LANES_H
#define MOR_CORE_MATERIAL_KIT_LANES_H

#include "core/base/status.h"
#include "core/material/kit/batch.h"

/** @file
 *  For models that work on several particles at once: the number of lanes of a block, and one source text compiled for
 *  several instruction sets, chosen once when an instance is made. The only file here that asks about the processor. */

/** Particles per block; a multiple of the vector width of every instruction set below. */
enum { MOR_LANES = 8 };

/** For functions called from a loop over lanes: they must vanish into it. */
#define MOR_LANES_INLINE inline __attribute__((always_inline))

/** Defines choose_<function>(), which returns the fastest variant of
 *  `static MOR_LANES_INLINE mor_status function(const data_type *, const mor_batch *)` for the machine it runs on; on
 *  one machine the choice is always the same. No variant fuses multiplications with additions, so that all give the
 *  same bits. */
#if defined(__x86_64__) && defined(__GNUC__)
#define MOR_LANES_VARIANTS(function, data_type)                                                                        \
    static mor_status function##_baseline(const data_type *data, const mor_batch *batch)                               \
    {                                                                                                                  \
        return function(data, batch);                                                                                  \
    }                                                                                                                  \
    __attribute__((target("avx2"))) static mor_status function##_avx2(const data_type *data, const mor_batch *batch)   \
    {                                                                                                                  \
        return function(data, batch);                                                                                  \
    }                                                                                                                  \
    static mor_status (*choose_##function(void))(const data_type *, const mor_batch *)                                 \
    {                                                                                                                  \
        __builtin_cpu_init();                                                                                          \
        return __builtin_cpu_supports("avx2") ? function##_avx2 : function##_baseline;                                 \
    }
#else
#define MOR_LANES_VARIANTS(function, data_type)                                                                        \
    static mor_status function##_baseline(const data_type *data, const mor_batch *batch)                               \
    {                                                                                                                  \
        return function(data, batch);                                                                                  \
    }                                                                                                                  \
    static mor_status (*choose_##function(void))(const data_type *, const mor_batch *)                                 \
    {                                                                                                                  \
        return function##_baseline;                                                                                    \
    }
#endif

#endif
