/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair.h"

#include "core/base/isa.h"

MOR_ISA_DECLARE(const mor_pair_table *, mor_pair_table, (void));

const mor_pair_table *mor_pair_select(const char *name)
{
    static const mor_pair_table *(*const tables[MOR_ISA_COUNT])(void) = MOR_ISA_VARIANTS(mor_pair_table);
    const int isa = mor_isa_select(name);
    return isa < 0 ? NULL : tables[isa]();
}
