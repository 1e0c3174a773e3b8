/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_names.h"

#include <stdio.h>
#include <string.h>

static int find_place(const mor_element_names *names, const char *key)
{
    int place = 0;
    while (place < names->n && strcmp(names->keys[place], key) != 0) {
        ++place;
    }
    return place;
}

mor_status mor_element_names_set(mor_element_names *names, const char *key, const char *name)
{
    const int place = find_place(names, key);
    if (place >= MOR_ELEMENT_NAMES_MAX || strlen(key) >= MOR_ELEMENT_NAMES_BYTES ||
        strlen(name) >= MOR_ELEMENT_NAMES_BYTES) {
        return MOR_ERROR_ARGUMENT;
    }
    snprintf(names->keys[place], MOR_ELEMENT_NAMES_BYTES, "%s", key);
    snprintf(names->names[place], MOR_ELEMENT_NAMES_BYTES, "%s", name);
    names->n += place == names->n;
    return MOR_OK;
}

const char *mor_element_names_find(const mor_element_names *names, const char *key)
{
    const int place = names == NULL ? 0 : find_place(names, key);
    return names == NULL || place == names->n ? key : names->names[place];
}
