/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/snapshot.h"

#include <string.h>

const mor_snapshot_set *mor_snapshot_find_set(const mor_snapshot *snapshot, const char *name)
{
    for (int set = 0; set < snapshot->n_sets; ++set) {
        if (strcmp(snapshot->sets[set].name, name) == 0) {
            return &snapshot->sets[set];
        }
    }
    return NULL;
}

const mor_snapshot_field *mor_snapshot_find_field(const mor_snapshot_set *set, const char *name)
{
    for (int field = 0; field < set->n_fields; ++field) {
        if (strcmp(set->fields[field].name, name) == 0) {
            return &set->fields[field];
        }
    }
    return NULL;
}
