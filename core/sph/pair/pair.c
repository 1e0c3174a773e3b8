/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair.h"

#include <string.h>

const mor_pair_table *mor_pair_table_baseline(void);
const mor_pair_table *mor_pair_table_avx2(void);
const mor_pair_table *mor_pair_table_avx512(void);

const mor_pair_table *mor_pair_select(const char *name)
{
#if defined(MOR_HAS_ISA_AVX512)
    const int has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    if (has_avx512 && (name == NULL || strcmp(name, "avx512") == 0)) {
        return mor_pair_table_avx512();
    }
#endif
#if defined(MOR_HAS_ISA_AVX2)
    const int has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (has_avx2 && (name == NULL || strcmp(name, "avx2") == 0)) {
        return mor_pair_table_avx2();
    }
#endif
    return name == NULL || strcmp(name, "baseline") == 0 ? mor_pair_table_baseline() : NULL;
}
