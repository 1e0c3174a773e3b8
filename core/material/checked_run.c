/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The guarded material in a run: who is wrapped, and how a breach stops the run. */
#include "core/material/checked.h"

enum { FAULT_BYTES = 256 };

mor_status mor_checked_wrap(mor_context *context, mor_material_instance **instance)
{
    mor_material_instance *checked = NULL;
    if (!context->is_checked) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_checked_create(context, instance, 1, &checked));
    *instance = checked;
    return MOR_OK;
}

mor_status mor_checked_report(mor_context *context, const mor_material_instance *instance, const char *set, double time)
{
    char fault[FAULT_BYTES];
    if (!mor_checked_fault(instance, fault, sizeof fault)) {
        return MOR_OK;
    }
    return MOR_FAIL(context, MOR_ERROR_PLUGIN,
                    "%s, in set '%s' at t = %.6g s; a material must keep the contract of core/material/kit/material.h. "
                    "Mend it, and let the check of materials try it",
                    fault, set, time);
}
