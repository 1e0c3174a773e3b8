/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_CHECKPOINT_VIEW_H
#define MOR_CORE_IO_CHECKPOINT_VIEW_H

#include "core/io/checkpoint.h"

/** @file
 *  Parts of a checkpoint for another run that begins where the first one ended. To go on with the same run see
 *  core/io/checkpoint.h. */

/** An open checkpoint. Owner: the caller. */
typedef struct mor_checkpoint_view mor_checkpoint_view;

/** Opens the newest checkpoint of a folder.
 *  @param folder [in]   zero-terminated path of the folder
 *  @param view   [out]  the address of one pointer; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_IO when it is missing or damaged; MOR_ERROR_UNSUPPORTED when it is of another version;
 *  MOR_ERROR_MEMORY. Cost: reads the file once; allocates. */
mor_status mor_checkpoint_view_open(mor_context *context, const char *folder, mor_checkpoint_view **view);

/** Closes it and sets the pointer NULL; accepts NULL.
 *  @param view [in,out]  the address of one pointer */
void mor_checkpoint_view_close(mor_context *context, mor_checkpoint_view **view);

/** Finds the number of particles of a set.
 *  @param set [in]   zero-terminated
 *  @param n   [out]  one number; -1: there is no such set
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_checkpoint_view_count(mor_context *context, mor_checkpoint_view *view, const char *set, int64_t *n);

/** Reads a field of a set.
 *  @param set          [in]   zero-terminated; is there
 *  @param field        [in]   zero-terminated
 *  @param n_components [in]   that the field must have
 *  @param values       [out]  shape [n, n_components], n particles, any unit; left alone where there is none
 *  @param is_there     [out]  one flag; whether the set has the field with so many components
 *  Returns: MOR_OK; MOR_ERROR_IO, also when it has not a row for each particle. */
mor_status mor_checkpoint_view_field(mor_context *context, mor_checkpoint_view *view, const char *set,
                                     const char *field, int n_components, double *values, bool *is_there);

/** Reads numbers beside the sets into an array of a list.
 *  @param array    [in]   what it points to is overwritten
 *  @param is_there [out]  one flag; whether the checkpoint has it with the same shape; else nothing is written
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_checkpoint_view_array(mor_context *context, mor_checkpoint_view *view, const mor_state_array *array,
                                     bool *is_there);

#endif
