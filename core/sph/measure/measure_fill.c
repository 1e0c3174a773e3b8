/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure_fill.h"

#include "core/base/isa.h"

extern const mor_measure_fill_table mor_measure_fill_baseline, mor_measure_fill_avx2, mor_measure_fill_avx512;

const mor_measure_fill_table *mor_measure_fills(void)
{
    static const mor_measure_fill_table *const tables[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(&mor_measure_fill);
    return tables[mor_isa_select(NULL)];
}
