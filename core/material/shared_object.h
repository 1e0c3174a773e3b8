/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_SHARED_OBJECT_H
#define MOR_CORE_MATERIAL_SHARED_OBJECT_H

#include "core/base/context.h"

/** @file
 *  Shared objects with code of others: opened by their path, asked for a function, closed. */

/** A function of a shared object; to be converted to its type before it is called. */
typedef void (*mor_shared_function)(void);

/** Opens a shared object.
 *  @param what   [in]      zero-terminated; what it is, for messages: "plug-in"
 *  @param path   [in]      zero-terminated; absolute, so that no folder is searched
 *  @param needs  [in]      zero-terminated; what such an object must be, for the message of a failure
 *  @param object [out]     one pointer; closed with mor_shared_object_close; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a file that is no shared library or cannot be read; MOR_ERROR_PLUGIN with the
 *  reason of the loader. Threads: not concurrently. */
mor_status mor_shared_object_open(mor_context *context, const char *what, const char *path, const char *needs,
                                  void **object);

/** Returns a function by its name, zero-terminated; NULL when the object does not export it. */
mor_shared_function mor_shared_object_find(void *object, const char *name);

/** Returns whether an object calls a function of others, as its table of symbols tells: 1 or 0.
 *  @param name [in]  zero-terminated; of the function */
int mor_shared_object_imports(void *object, const char *name);

/** Closes an object and sets the pointer to NULL; NULL is accepted. Its functions are gone afterwards.
 *  @param object [in,out]  the address of one pointer */
void mor_shared_object_close(void **object);

#endif
