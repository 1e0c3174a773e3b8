/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_LAWS_H
#define MOR_TESTS_COMMON_LAWS_H

#include "materials/builtin.h"

#include <assert.h>
#include <string.h>

/** @file
 *  The built-in laws by name. */

/** Returns a built-in law, static, as this processor takes it; name is zero-terminated. */
static inline const mor_material *law_named(const char *name)
{
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    int k = 0;
    while (k < list->n_materials - 1 && strcmp(list->materials[k]->name, name) != 0) {
        ++k;
    }
    assert(strcmp(list->materials[k]->name, name) == 0);
    return list->materials[k];
}

#endif
