/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_FOLDER_H
#define MOR_CASES_DRIVER_RUN_RUN_FOLDER_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  The folder of a run: what it holds, and who is at work in it. */

#define MOR_RUN_LOG_FILE "log.txt"

/** Whether a folder has a file.
 *  @param folder  [in]      zero-terminated
 *  @param name    [in]      zero-terminated */
bool mor_run_folder_has(mor_context *context, const char *folder, const char *name);

/** Whether a folder has a checkpoint, the newest or the one before.
 *  @param folder  [in]      zero-terminated */
bool mor_run_folder_has_checkpoint(mor_context *context, const char *folder);

/** Makes a folder and the folders it lies in.
 *  @param path    [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a path that is too long or cannot be made. */
mor_status mor_run_folder_make(mor_context *context, const char *path);

/** Refuses a folder that holds a run.
 *  @param folder  [in]      zero-terminated
 *  @param advice  [in]      zero-terminated; what to do
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_run_folder_refuse_run(mor_context *context, const char *folder, const char *advice);

/** Opens the log of a folder behind what it holds and locks the folder with it: one run at a time works there, of
 *  this process or another.
 *  @param folder [in]   zero-terminated; there already
 *  @param log    [out]  one stream, to be ended with mor_run_folder_unlock; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when another run holds the lock; MOR_ERROR_IO. */
mor_status mor_run_folder_lock(mor_context *context, const char *folder, FILE **log);

/** Closes a log and frees the lock of its folder, which a child process that has inherited the file would otherwise
 *  hold on to.
 *  @param log [in,out]  one stream; NULL afterwards; NULL and one that locks nothing are accepted */
void mor_run_folder_unlock(FILE **log);

#endif
