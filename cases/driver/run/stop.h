/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_STOP_H
#define MOR_CASES_DRIVER_RUN_STOP_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/** @file
 *  How a signal stops a run. It may arrive at any moment; what the program does then depends on what it is doing. Every
 *  file of a run is whole at any moment, so that only a state in memory can be lost. */

/** What the program is doing, and what the first signal does. */
enum {
    MOR_STOP_AT_ONCE,      /* nothing that a checkpoint would keep: the program ends at once */
    MOR_STOP_AFTER_STEP,   /* a step of a run: it is finished and saved, or dropped when it takes too long */
    MOR_STOP_AFTER_WRITING /* files of a run: they are finished */
};

/** One program that can be stopped. Written by a signal handler or another thread, and by the run: both may touch an
 *  atomic object at any time, a handler one that needs no lock. */
typedef struct mor_stop {
    atomic_int is_requested; /* non-zero once somebody wants the run to end in an orderly way */
    atomic_int phase;        /* one of the words above */
} mor_stop;

_Static_assert(ATOMIC_INT_LOCK_FREE == 2, "a signal handler may not wait for a lock");

/** Whether a run is to stop.
 *  @param stop [in]  NULL: never */
static inline bool mor_stop_is_requested(const mor_stop *stop)
{
    return stop != NULL && stop->is_requested != 0;
}

/** Sets what the program is doing.
 *  @param stop  [in,out]  NULL: no effect
 *  @param phase [in]      one of the words above */
static inline void mor_stop_enter(mor_stop *stop, int phase)
{
    if (stop != NULL) {
        stop->phase = phase;
    }
}

#endif
