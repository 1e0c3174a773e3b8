/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_STRESS_LAW_REPORT_H
#define MOR_CORE_SPH_STRESS_LAW_REPORT_H

#include "core/base/reduce.h"
#include "core/material/kit/material.h"
#include "core/time/view.h"

/** @file
 *  Tells for which particle a law gave no answer, when it was asked for many at once. That of a stress update, which
 *  may be done again with smaller steps, is told by stress_update.h. */

/** Work with a law that failed for the particles [first, first + n). Borrowed. */
typedef struct mor_law_failure {
    mor_reduce_work run; /* fails for the particle alone, too */
    void *job;           /* its first argument */
    int64_t first, n;    /* cut at the number of particles */
    const char *what;    /* that the law did not give, zero-terminated */
} mor_law_failure;

/** Does the work again, particle by particle, to name the first one that it fails for.
 *  @param material [in]  of the particles
 *  @param view     [in]  of a set with position, density and stress
 *  @param step     [in]  that failed
 *  @param failure  [in]  one object
 *  Returns: MOR_ERROR_NUMERIC naming the particle; what a checked law has to tell. */
mor_status mor_law_report(mor_context *context, const mor_material_instance *material, const mor_view *view,
                          const mor_step *step, const mor_law_failure *failure);

#endif
