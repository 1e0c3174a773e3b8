/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/lanes/soil_lanes.h"

#include "core/base/isa.h"

#include <stddef.h>

extern const mor_soil_lanes mor_soil_lanes_baseline, mor_soil_lanes_avx2, mor_soil_lanes_avx512;

const mor_soil_lanes *mor_soil_lanes_select(const char *name)
{
    static const mor_soil_lanes *const tables[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(&mor_soil_lanes);
    const int isa = mor_isa_select(name);
    return isa < 0 ? NULL : tables[isa];
}
