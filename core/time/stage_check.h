/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_STAGE_CHECK_H
#define MOR_CORE_TIME_STAGE_CHECK_H

#include "core/time/stepper.h"

/** @file
 *  What a checked run (mor_context.is_checked) does around each stage to prove its declaration, whichever way it
 *  reaches its data: what it may not write has the same hash before and after; what it writes anew is filled with NaN
 *  before and looked at afterwards; what does not evolve is filled with NaN when a step begins. These NaN carry the
 *  number of their field, which arithmetic passes on, so that a value made from scratch names where it is from. */

/** Hashes before a stage. */
typedef struct mor_stage_check {
    uint64_t hashes[MOR_STAGE_BITS]; /* of each bit that the stage may not write */
    uint64_t generation;             /* of the set */
    int64_t n_particles;             /* likewise */
} mor_stage_check;

/** Fills all scratch with NaN; to be called when a step begins.
 *  @param stepper [in,out]  its fields and shared arrays that do not evolve */
void mor_stage_check_begin(mor_stepper *stepper);

/** Takes hashes of what a stage may not write, and fills with NaN what it is to write anew.
 *  @param check   [out]     for mor_stage_check_after
 *  @param stepper [in,out]  its fields and shared arrays
 *  @param stage   [in]      about to run */
void mor_stage_check_before(mor_stage_check *check, const mor_stepper *stepper, const mor_stage *stage);

/** Looks for what a stage has done against its declaration.
 *  @param check   [in]      from mor_stage_check_before
 *  @param stepper [in]      its fields and shared arrays
 *  @param stage   [in]      has run
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL naming stage, set and field. */
mor_status mor_stage_check_after(mor_context *context, const mor_stage_check *check, const mor_stepper *stepper,
                                 const mor_stage *stage);

#endif
