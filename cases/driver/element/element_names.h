/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_NAMES_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_NAMES_H

#include "core/base/status.h"

/** @file
 *  How the user of a program writes a setting, so that messages name what was typed and not the key behind it. */

enum { MOR_ELEMENT_NAMES_MAX = 16, MOR_ELEMENT_NAMES_BYTES = 64 };

/** A list of names. A record filled with zeros is empty. */
typedef struct mor_element_names {
    char keys[MOR_ELEMENT_NAMES_MAX][MOR_ELEMENT_NAMES_BYTES];  /* shape [n] of zero-terminated keys */
    char names[MOR_ELEMENT_NAMES_MAX][MOR_ELEMENT_NAMES_BYTES]; /* shape [n] of zero-terminated names */
    int n;
} mor_element_names;

/** Sets the name of a key, in place of the one before.
 *  @param key  [in]  zero-terminated
 *  @param name [in]  zero-terminated; copied
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT beyond MOR_ELEMENT_NAMES_MAX keys, and for words of MOR_ELEMENT_NAMES_BYTES
 *  bytes and more. */
mor_status mor_element_names_set(mor_element_names *names, const char *key, const char *name);

/** Returns the name of a key; the key where it has none, or names is NULL.
 *  @param key [in]  zero-terminated; borrowed */
const char *mor_element_names_find(const mor_element_names *names, const char *key);

#endif
