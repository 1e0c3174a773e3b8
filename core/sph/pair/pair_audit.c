/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair_audit.h"

#include "core/base/isa.h"

MOR_ISA_DECLARE(void, mor_pair_audit, (const mor_pair_audit_job *job, int64_t first, int64_t last));

mor_pair_audit_loop mor_pair_audit_select(const char *name)
{
    static const mor_pair_audit_loop loops[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(mor_pair_audit);
    const int isa = mor_isa_select(name);
    return isa < 0 ? NULL : loops[isa];
}
