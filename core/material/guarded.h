/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_GUARDED_H
#define MOR_CORE_MATERIAL_GUARDED_H

#include "core/base/guard.h"
#include "core/material/kit/material.h"

/** @file
 *  Updates of a law that may crash, for it may be that of a plug-in. */

/** An update, for the guard. */
typedef struct mor_guarded_update {
    const mor_material_instance *material;
    const mor_batch *batch;
    mor_status status;
} mor_guarded_update;

/** Does it.
 *  @param job [in,out]  one mor_guarded_update */
static inline void mor_guarded_update_run(void *job)
{
    mor_guarded_update *it = job;
    it->status = it->material->operations.advance_rate(it->material, it->batch);
}

/** Advances a batch under a guard.
 *  @param guard    [in]  NULL: none
 *  @param material [in]  of a law in rate form
 *  @param batch    [in]  outputs are worthless after a crash
 *  Returns: what the law returns; MOR_ERROR_CRASH. */
static inline mor_status mor_material_advance_guarded(mor_guard guard, const mor_material_instance *material,
                                                      const mor_batch *batch)
{
    mor_guarded_update update = {material, batch, MOR_OK};
    return mor_guard_run(guard, mor_guarded_update_run, &update) == 0 ? update.status : MOR_ERROR_CRASH;
}

#endif
