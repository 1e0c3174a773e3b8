/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_DURABLE_FILE_H
#define MOR_CORE_IO_DURABLE_FILE_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  Files that are either the old ones or the new ones, whatever happens: content goes to <path>.tmp, is synced to the
 *  disk, and takes the name by one rename, after which the folder is synced too. A process killed at any moment leaves
 *  at most a stale <path>.tmp, which the next attempt overwrites. One writer per path at a time. */

/** Room for a path, its terminating zero included. */
enum { MOR_PATH_BYTES = 4096 };

/** A file being written. Owner: the caller, who ends it with commit or discard. */
typedef struct mor_durable_file {
    FILE *stream;                   /* write here; NULL when no file is open */
    char path[MOR_PATH_BYTES];      /* the final name */
    char temporary[MOR_PATH_BYTES]; /* the name until the commit */
} mor_durable_file;

/** Starts a new content of a file; the file under its final name stays as it is.
 *  @param file    [out]     storage supplied by the caller
 *  @param path    [in]      zero-terminated final path; copied
 *  Returns: MOR_OK; MOR_ERROR_IO when the temporary file cannot be made. */
mor_status mor_durable_file_open(mor_context *context, mor_durable_file *file, const char *path);

/** Syncs what was written to the stream and gives it the final name. Errors of earlier writes to the stream are
 *  reported here; then the old file stays and the temporary one is removed.
 *  @param file    [in,out]  closed in any case
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_durable_file_commit(mor_context *context, mor_durable_file *file);

/** Discards the new content. Accepts a file that is already closed. */
void mor_durable_file_discard(mor_durable_file *file);

/** Gives a finished and synced file its final name, replacing the file of that name, and syncs the folder.
 *  @param temporary [in]      zero-terminated path of the finished file, in the same folder as path
 *  @param path      [in]      zero-terminated final path
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_durable_file_replace(mor_context *context, const char *temporary, const char *path);

/** Keeps a file under a second name, replacing the file of that name; the first name stays valid throughout where the
 *  file system has hard links, else the file is renamed.
 *  @param path    [in]      zero-terminated path of the file
 *  @param second  [in]      zero-terminated second path, in the same folder
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_durable_file_keep(mor_context *context, const char *path, const char *second);

/** Makes a folder unless it exists; its parent must exist.
 *  @param path    [in]      zero-terminated path of the folder
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_durable_file_make_folder(mor_context *context, const char *path);

/** Puts a folder and a name together: folder/name.
 *  @param path    [out]     shape [MOR_PATH_BYTES]; zero-terminated
 *  @param folder  [in]      zero-terminated; "" for none
 *  @param name    [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO when the path is too long. */
mor_status mor_durable_file_join(mor_context *context, char *path, const char *folder, const char *name);

/** Names the temporary file that stands for a path until it is finished: <path>.tmp.
 *  @param temporary [out]     shape [MOR_PATH_BYTES]; zero-terminated
 *  @param path      [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO when the path is too long. */
mor_status mor_durable_file_temporary(mor_context *context, char *temporary, const char *path);

#endif
