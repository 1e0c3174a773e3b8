/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_POOL_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_POOL_H

#include "core/base/context.h"

/** @file
 *  Jobs that do not know of one another, by threads of their own. Not by core/base/parallel.h: each job may have
 *  parallel loops itself, which count the threads of their own loop alone. */

enum { MOR_SWEEP_POOL_MAX = 1024 };

/** What is to be done. */
typedef struct mor_sweep_jobs {
    int n;         /* number of jobs */
    int n_threads; /* 1 to MOR_SWEEP_POOL_MAX */
    /** Does a job, in any of the threads. Jobs are begun in their order, each once.
     *  @param user [in,out]  as below
     *  @param job  [in]      0 <= job < n */
    void (*work)(void *user, int job);
    /** Is called by the thread that waits, ten times a second and once at the end.
     *  @param user [in,out]  as below */
    void (*watch)(void *user);
    void *user; /* handed to both; owned by the caller */
} mor_sweep_jobs;

/** Does all jobs and waits for them.
 *  @param jobs [in]  whole
 *  Returns: MOR_OK; MOR_ERROR_MEMORY when not even one thread can be made: then no job is done. */
mor_status mor_sweep_pool_run(mor_context *context, const mor_sweep_jobs *jobs);

#endif
