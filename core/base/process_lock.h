/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_PROCESS_LOCK_H
#define MOR_CORE_BASE_PROCESS_LOCK_H

/** @file
 *  One lock for the whole process, around calls of outside libraries that keep one state per process. It is the only
 *  variable that sessions share. For doors alone, in their .c file; never around anything that may lock it again. */

/** Waits for the lock and takes it.
 *  Threads: safe to call concurrently. */
void mor_process_lock(void);

/** Gives the lock back. */
void mor_process_unlock(void);

#endif
