/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair.h"

#include "core/base/isa.h"

#include <string.h>

MOR_ISA_DECLARE(const mor_pair_table *, mor_pair_table, (int has_halves));

const mor_pair_table *mor_pair_select(const char *name)
{
    static const mor_pair_table *(*const tables[MOR_ISA_COUNT])(int has_halves) = MOR_ISA_VARIANTS(mor_pair_table);
    const bool asks_for_halves = name != NULL && strcmp(name, "avx512-halves") == 0;
    const int isa = mor_isa_select(asks_for_halves ? "avx512" : name);
    const bool has_halves = asks_for_halves || (name == NULL && isa == MOR_ISA_AVX512 && mor_isa_has_halves());
    return isa < 0 ? NULL : tables[isa](has_halves);
}

static int find_soil_of_list(mor_relation_cursor cursor, const double *of_soil)
{
    const double *index = of_soil + MOR_PAIR_OF_SOIL_INDEX;
    int64_t k = mor_relation_next(&cursor);
    const double first = k >= 0 ? index[k * MOR_PAIR_OF_SOIL_SIZE] : -1.0;
    while (k >= 0 && index[k * MOR_PAIR_OF_SOIL_SIZE] == first) {
        k = mor_relation_next(&cursor);
    }
    return k < 0 ? (int)first : -1;
}

void mor_pair_find_one_soil(const mor_relation *relation, const double *of_soil, int64_t first, int64_t last,
                            int8_t *one_soil)
{
    for (int64_t cluster = first; cluster < last; ++cluster) {
        /* The list holds the particles of the cluster, too. */
        one_soil[cluster] = (int8_t)find_soil_of_list(mor_relation_begin(relation, cluster), of_soil);
    }
}
