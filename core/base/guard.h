/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_GUARD_H
#define MOR_CORE_BASE_GUARD_H

#include <stddef.h>

/** @file
 *  Calls of code that may crash. Only a program can catch signals, so it supplies the function that does. */

/** Does work(job) and comes back, whatever work does: it returns 0, or the number of the signal that ended work.
 *  @param work [in]      may be left at any place; it holds no lock and owns nothing
 *  @param job  [in,out]  one object, handed to work
 *  Threads: safe to call concurrently. */
typedef int (*mor_guard)(void (*work)(void *job), void *job);

/** Does work(job) under a guard; without one, directly.
 *  @param guard [in]      NULL: none
 *  @param work  [in]      see mor_guard
 *  @param job   [in,out]  one object, handed to work
 *  Returns: 0, or the number of the signal that ended work. */
static inline int mor_guard_run(mor_guard guard, void (*work)(void *job), void *job)
{
    if (guard != NULL) {
        return guard(work, job);
    }
    work(job);
    return 0;
}

#endif
