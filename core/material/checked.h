/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_CHECKED_H
#define MOR_CORE_MATERIAL_CHECKED_H

#include "core/material/kit/material.h"

/** @file
 *  A decorator around any material instance that proves the contract of core/material/kit/material.h while a run goes
 *  on.
 *  Each batch is worked on in guarded copies: arrays that the operation has no business with are NULL, outputs are
 *  filled with NaN first and must all be finite afterwards, inputs must be unchanged, and marks around every array must
 *  stand. It is slower and otherwise invisible: the numbers are those of the inner material. */

/** Particles per guarded copy. */
enum { MOR_CHECKED_CHUNK = 32 };

/** Wraps an instance.
 *  @param inner         [in,out]  the address of one pointer; taken: set to NULL and owned by the wrapper, also freed
 *                                 with it; left to the caller on failure
 *  @param checks_splits [in]      non-zero: run each chunk again in two parts, which must give the same bits
 *  @param checked       [out]     one pointer; an instance for the host, freed by mor_material_destroy; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY.
 *  Gives: operations that return MOR_ERROR_PLUGIN after a breach and keep the first one for mor_checked_fault.
 *  Cost: allocates here, never in an operation. Threads: as the inner instance. */
mor_status mor_checked_create(mor_context *context, mor_material_instance **inner, int checks_splits,
                              mor_material_instance **checked);

/** Returns whether an instance was made by mor_checked_create and has seen a breach, and describes the first one.
 *  @param text       [out]  shape [text_bytes]; zero-terminated; empty when there was none
 *  @param text_bytes [in]   room in text in bytes, > 0
 *  Returns: 1 after a breach, 0 otherwise.
 *  Threads: after the parallel loop. */
int mor_checked_fault(const mor_material_instance *instance, char *text, size_t text_bytes);

/** Wraps the instance of a run that proves what it declares; leaves it as it is in other runs.
 *  @param instance [in,out]  the address of one pointer; afterwards the instance to be used and destroyed
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_checked_wrap(mor_context *context, mor_material_instance **instance);

/** Reports the first breach that an instance has seen.
 *  @param set  [in]  zero-terminated name of the particles it worked on
 *  @param time [in]  of the run, unit s
 *  Returns: MOR_OK when there was none, also for an instance that is not wrapped; MOR_ERROR_PLUGIN naming the model,
 *  the operation and the array. Threads: after the parallel loop. */
mor_status mor_checked_report(mor_context *context, const mor_material_instance *instance, const char *set,
                              double time);

#endif
