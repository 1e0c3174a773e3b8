/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_STAGE_H
#define MOR_CORE_TIME_STAGE_H

#include "core/base/context.h"

#include <stdint.h>
#include <stdio.h>

/** @file
 *  A stage is one function of a time step with declared reads, writes and accumulations. The declarations are checked
 *  when a run is set up and printed by `moraine explain`.
 *
 *  A declaration is a set of bits: bit k stands for particle field k of the set the stage works on; the highest bits
 *  stand for shared data that is not a particle field. */

/** Data that stages hand on beside the particle fields. */
enum {
    MOR_RESOURCE_RECORDS = 60,    /* packed neighbor records */
    MOR_RESOURCE_LISTS = 61,      /* neighbor lists */
    MOR_RESOURCE_WALL_SUMS = 62,  /* kernel sums over walls */
    MOR_RESOURCE_SHORT_LISTS = 63 /* what of the lists is in reach in this step */
};

/** The bit of a field or a resource. */
#define MOR_BIT(number) ((uint64_t)1 << (number))

/** Everything a stage is told about the step it works in. */
typedef struct mor_step {
    double length;   /* length of the step, s */
    double time;     /* time at its start, s */
    uint64_t number; /* common steps done before it */
    int part;        /* number of the sub-step in the common step, from 0 */
    int n_parts;     /* sub-steps of the common step; 1 for a common step; 0 counts as 1 */
} mor_step;

/** One stage. Static or owned by the stepper. */
typedef struct mor_stage {
    const char *name;
    mor_status (*run)(mor_context *context, void *owner, const mor_step *step);
    uint64_t reads;       /* what it needs up to date */
    uint64_t writes;      /* what it sets anew for every particle */
    uint64_t accumulates; /* what it adds to; another stage must have written it earlier in the step */
    const char *text;     /* one line for people */
} mor_stage;

/** Checks the declarations of a step: whatever a stage reads or accumulates into must evolve (carry over from the step
 *  before) or have been written earlier in the step.
 *  @param stages   [in]      shape [n_stages]; in order of execution
 *  @param n_stages [in]      number of stages
 *  @param evolving [in]      bits that hold valid data when the step begins
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL naming stage and bit. */
mor_status mor_stage_verify(mor_context *context, const mor_stage *stages, int n_stages, uint64_t evolving);

#endif
