/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/stage_check.h"

/* A breach of the declaration is reported before what the stage itself returns, for it may be the cause. */
mor_status mor_stepper_run_stage(mor_context *context, const mor_stepper *stepper, int index, const mor_step *step)
{
    const mor_stage *stage = &stepper->stages[index];
    mor_stage_check check;
    if (context->is_checked && index == 0) {
        mor_stepper whole = *stepper;
        mor_stage_check_begin(&whole);
    }
    if (stage->is_active != NULL && !stage->is_active(stepper->owner)) {
        return MOR_OK;
    }
    if (context->is_checked) {
        mor_stage_check_before(&check, stepper, stage);
    }
    mor_view view = mor_view_open(stepper->set, stage);
    const mor_status status = stage->run(context, stepper->owner, &view, step);
    MOR_TRY(context, mor_view_close(context, &view));
    if (context->is_checked) {
        MOR_TRY(context, mor_stage_check_after(context, &check, stepper, stage));
    }
    return status;
}
