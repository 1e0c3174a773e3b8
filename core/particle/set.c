/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/set.h"

#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/base/random.h"

#include <stdio.h>
#include <string.h>

/* Room behind the last particle, so that vector code may read whole clusters. */
enum { PADDING = 8 };

/* Particles of a set: indices and sums of a few of them are 32-bit numbers. */
enum { LARGEST = INT32_MAX - 65 };

/* Components and bytes of the widest field. */
enum { COMPONENTS_MAX = 9, FIELD_BYTES_MAX = COMPONENTS_MAX * sizeof(double) };

mor_status mor_set_init(mor_context *context, mor_set *set, const char *name, int64_t n_particles, uint64_t field_mask)
{
    memset(set, 0, sizeof *set);
    MOR_CHECK(context, n_particles >= 0 && n_particles <= LARGEST, MOR_ERROR_ARGUMENT,
              "set '%s' was asked for with %lld particles; allowed are 0 to %d: take a larger spacing", name,
              (long long)n_particles, LARGEST);
    strncpy(set->name, name, sizeof set->name - 1);
    set->n_particles = n_particles;
    set->n_created = n_particles;
    set->n_fields = MOR_FIELD_CORE_COUNT;
    mor_status status = MOR_NEW(context, &set->id, n_particles + PADDING, "particle ids");
    for (int field = 0; field < MOR_FIELD_CORE_COUNT && status == MOR_OK; ++field) {
        set->fields[field] = *mor_field_core_info((mor_field_id)field);
        if ((field_mask >> field & 1u) != 0) {
            const int64_t n_values = (n_particles + PADDING) * set->fields[field].n_components;
            status = MOR_NEW(context, &set->data[field], n_values, set->fields[field].name);
        }
    }
    if (status != MOR_OK) {
        mor_set_clear(context, set);
        return status;
    }
    for (int64_t i = 0; i < n_particles; ++i) {
        set->id[i] = i;
    }
    return MOR_OK;
}

void mor_set_clear(mor_context *context, mor_set *set)
{
    for (int field = 0; field < MOR_FIELDS_MAX; ++field) {
        if ((set->borrowed >> field & 1u) == 0) {
            MOR_FREE(context, &set->data[field]);
        }
        set->data[field] = NULL;
    }
    set->borrowed = 0;
    MOR_FREE(context, &set->id);
    set->n_particles = 0;
    set->n_created = 0;
    set->n_fields = 0;
}

mor_status mor_set_add_field(mor_context *context, mor_set *set, const mor_field_info *info, int *index)
{
    *index = -1;
    MOR_CHECK(context, set->n_fields < MOR_FIELDS_MAX, MOR_ERROR_ARGUMENT,
              "set '%s' already has %d fields, the most allowed; field '%s' cannot be added", set->name, MOR_FIELDS_MAX,
              info->name);
    MOR_CHECK(context, mor_set_find_field(set, info->name) < 0, MOR_ERROR_ARGUMENT,
              "field '%s' is already declared in set '%s'; rename the material's state variable", info->name,
              set->name);
    MOR_CHECK(context, info->n_components >= 1 && info->n_components <= COMPONENTS_MAX, MOR_ERROR_ARGUMENT,
              "field '%s' has %d components; 1 to %d are allowed", info->name, info->n_components, COMPONENTS_MAX);
    const int field = set->n_fields;
    MOR_TRY(context, MOR_NEW(context, &set->data[field], (set->n_particles + PADDING) * info->n_components,
                             "a material's state variable"));
    set->fields[field] = *info;
    set->n_fields += 1;
    *index = field;
    return MOR_OK;
}

mor_status mor_set_add_state(mor_context *context, mor_set *set, const mor_schema *state, int n_state, int *fields)
{
    for (int k = 0; k < n_state; ++k) {
        mor_field_info info = {.n_components = state[k].n_components,
                               .unit = state[k].unit,
                               .flags = MOR_FIELD_EVOLVES | MOR_FIELD_OUTPUT | MOR_FIELD_STATE,
                               .text = state[k].text};
        snprintf(info.name, sizeof info.name, "%s", state[k].key);
        MOR_TRY(context, mor_set_add_field(context, set, &info, &fields[k]));
    }
    return MOR_OK;
}

int mor_set_width(const mor_set *set, uint64_t fields)
{
    int width = 0;
    for (int field = 0; field < set->n_fields; ++field) {
        width += (fields >> field & 1u) != 0 && set->data[field] != NULL ? set->fields[field].n_components : 0;
    }
    return width;
}

void mor_set_place(mor_context *context, mor_set *set, uint64_t fields, double *memory)
{
    const int64_t n_rows = (set->n_created + PADDING - 1) / PADDING * PADDING;
    for (int field = 0; field < set->n_fields; ++field) {
        const uint64_t bit = (uint64_t)1 << field;
        if ((fields & bit) == 0 || set->data[field] == NULL) {
            continue;
        }
        if ((set->borrowed & bit) == 0) {
            MOR_FREE(context, &set->data[field]);
        }
        set->borrowed |= bit;
        set->data[field] = memory;
        memory += n_rows * set->fields[field].n_components;
    }
}

int mor_set_find_field(const mor_set *set, const char *name)
{
    for (int field = 0; field < set->n_fields; ++field) {
        if (strcmp(set->fields[field].name, name) == 0) {
            return field;
        }
    }
    return -1;
}

/* Moves rows of n_bytes along the cycles of a permutation. A place that is done is marked by the complement of its
 * entry; the second sweep takes the marks away. */
static void permute_rows(void *rows, size_t n_bytes, int64_t n, int32_t *order)
{
    char *bytes = rows;
    char kept[FIELD_BYTES_MAX];
    for (int64_t start = 0; start < n; ++start) {
        if (order[start] < 0) {
            continue;
        }
        memcpy(kept, bytes + (size_t)start * n_bytes, n_bytes);
        int64_t place = start;
        int64_t from = order[place];
        while (from != start) {
            memcpy(bytes + (size_t)place * n_bytes, bytes + (size_t)from * n_bytes, n_bytes);
            order[place] = ~order[place];
            place = from;
            from = order[place];
        }
        memcpy(bytes + (size_t)place * n_bytes, kept, n_bytes);
        order[place] = ~order[place];
    }
    for (int64_t i = 0; i < n; ++i) {
        order[i] = ~order[i];
    }
}

void mor_set_permute(mor_set *set, int32_t *order)
{
    const int64_t n = set->n_particles;
    for (int field = 0; field < set->n_fields; ++field) {
        if (set->data[field] != NULL && (set->fields[field].flags & MOR_FIELD_EVOLVES) != 0) {
            permute_rows(set->data[field], (size_t)set->fields[field].n_components * sizeof(double), n, order);
        }
    }
    permute_rows(set->id, sizeof *set->id, n, order);
    set->generation += 1;
}

/* Moves the rows between the removed ones to the front; rows of n_bytes. */
static void close_gaps(void *rows, size_t n_bytes, int64_t n, const int32_t *removed, int64_t n_removed)
{
    char *bytes = rows;
    for (int64_t k = 0; k < n_removed; ++k) {
        const int64_t first = removed[k] + 1;
        const int64_t last = k + 1 < n_removed ? removed[k + 1] : n;
        memmove(bytes + (size_t)(removed[k] - k) * n_bytes, bytes + (size_t)first * n_bytes,
                (size_t)(last - first) * n_bytes);
    }
}

void mor_set_remove(mor_set *set, const int32_t *removed, int64_t n_removed)
{
    const int64_t n = set->n_particles;
    for (int field = 0; field < set->n_fields; ++field) {
        if (set->data[field] != NULL) {
            close_gaps(set->data[field], (size_t)set->fields[field].n_components * sizeof(double), n, removed,
                       n_removed);
        }
    }
    close_gaps(set->id, sizeof *set->id, n, removed, n_removed);
    set->n_particles = n - n_removed;
    set->generation += 1;
}

void mor_set_stop(mor_set *set, int64_t first, int64_t n)
{
    for (int field = 0; field < set->n_fields; ++field) {
        const int64_t width = set->fields[field].n_components;
        if (set->data[field] != NULL && (set->fields[field].flags & MOR_FIELD_MOTION) != 0) {
            memset(set->data[field] + width * first, 0, (size_t)(width * n) * sizeof(double));
        }
    }
}

uint64_t mor_set_checksum(const mor_set *set)
{
    /* Each number is mixed with its id, field and place and the results are added: wrapping addition does not depend on
     * order, so no sort by id is needed. */
    uint64_t sum = mor_random_mix((uint64_t)set->n_particles);
    for (int field = 0; field < set->n_fields; ++field) {
        const double *data = set->data[field];
        if (data == NULL || (set->fields[field].flags & MOR_FIELD_EVOLVES) == 0) {
            continue;
        }
        const int n_components = set->fields[field].n_components;
        /* By its name, so that fields which others have do not change the checksum of a set. */
        const uint64_t name = mor_hash_bytes(set->fields[field].name, strlen(set->fields[field].name));
        for (int64_t i = 0; i < set->n_particles; ++i) {
            for (int a = 0; a < n_components; ++a) {
                uint64_t bits = 0;
                memcpy(&bits, &data[i * n_components + a], sizeof bits);
                const uint64_t place = (uint64_t)set->id[i] << 4 | (uint64_t)a;
                sum += mor_random_mix(bits ^ mor_random_mix(place ^ name));
            }
        }
    }
    return sum;
}
