/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/state.h"

#include "core/base/memory.h"

#include <stdio.h>
#include <string.h>

enum { NUMBER = 8 /* bytes of a number of any kind */ };
_Static_assert(sizeof(int64_t) == NUMBER && sizeof(uint64_t) == NUMBER && sizeof(double) == NUMBER, "64-bit numbers");

static mor_status grow_sets(mor_context *context, mor_state_list *list)
{
    mor_set **sets = NULL;
    if (list->n_sets < list->sets_capacity) {
        return MOR_OK;
    }
    const int capacity = 2 * list->sets_capacity + 8;
    MOR_TRY(context, MOR_NEW(context, &sets, capacity, "list of state"));
    if (list->n_sets > 0) {
        memcpy(sets, list->sets, (size_t)list->n_sets * sizeof *sets);
    }
    MOR_FREE(context, &list->sets);
    list->sets = sets;
    list->sets_capacity = capacity;
    return MOR_OK;
}

static mor_status grow_arrays(mor_context *context, mor_state_list *list)
{
    mor_state_array *arrays = NULL;
    if (list->n_arrays < list->arrays_capacity) {
        return MOR_OK;
    }
    const int capacity = 2 * list->arrays_capacity + 32;
    MOR_TRY(context, MOR_NEW(context, &arrays, capacity, "list of state"));
    if (list->n_arrays > 0) {
        memcpy(arrays, list->arrays, (size_t)list->n_arrays * sizeof *arrays);
    }
    MOR_FREE(context, &list->arrays);
    list->arrays = arrays;
    list->arrays_capacity = capacity;
    return MOR_OK;
}

mor_status mor_state_add_set(mor_context *context, mor_state_list *list, mor_set *set)
{
    for (int k = 0; k < list->n_sets; ++k) {
        MOR_CHECK(context, strcmp(list->sets[k]->name, set->name) != 0, MOR_ERROR_INTERNAL,
                  "the set '%s' is listed as state twice; each set has one owner, who lists it", set->name);
    }
    MOR_TRY(context, grow_sets(context, list));
    list->sets[list->n_sets++] = set;
    return MOR_OK;
}

static mor_status add_array(mor_context *context, mor_state_list *list, const char *owner, const char *member,
                            mor_state_array array)
{
    const int n_bytes = snprintf(array.name, sizeof array.name, "%s.%s", owner, member);
    MOR_CHECK(context, n_bytes > 0 && n_bytes < (int)sizeof array.name, MOR_ERROR_INTERNAL,
              "the name of the state '%s' of '%s' has %d bytes; at most %d are allowed", member, owner, n_bytes,
              (int)sizeof array.name - 1);
    for (int k = 0; k < list->n_arrays; ++k) {
        MOR_CHECK(context, strcmp(list->arrays[k].name, array.name) != 0, MOR_ERROR_INTERNAL,
                  "'%s' is listed as state twice; give one of them another name", array.name);
    }
    MOR_TRY(context, grow_arrays(context, list));
    list->arrays[list->n_arrays++] = array;
    return MOR_OK;
}

mor_status mor_state_add(mor_context *context, mor_state_list *list, const char *owner, const char *member,
                         mor_state_kind kind, int64_t n, void *data)
{
    return add_array(context, list, owner, member,
                     (mor_state_array){.kind = kind, .n_rows = n, .n_columns = 1, .stride = 1, .data = data});
}

mor_status mor_state_add_member(mor_context *context, mor_state_list *list, const char *owner, const char *member,
                                int64_t n_rows, int n_columns, size_t stride_bytes, double *first)
{
    MOR_CHECK(context, stride_bytes % NUMBER == 0 && stride_bytes >= (size_t)n_columns * NUMBER, MOR_ERROR_INTERNAL,
              "'%s' of '%s' has rows of %d numbers %zu bytes apart; the distance must be a multiple of %d that they "
              "fit into",
              member, owner, n_columns, stride_bytes, NUMBER);
    return add_array(context, list, owner, member,
                     (mor_state_array){.kind = MOR_STATE_DOUBLE,
                                       .n_rows = n_rows,
                                       .n_columns = n_columns,
                                       .stride = (int64_t)(stride_bytes / NUMBER),
                                       .data = first});
}

void mor_state_clear(mor_context *context, mor_state_list *list)
{
    MOR_FREE(context, &list->sets);
    MOR_FREE(context, &list->arrays);
    memset(list, 0, sizeof *list);
}

bool mor_state_has_field(const mor_set *set, int field)
{
    return (set->fields[field].flags & MOR_FIELD_EVOLVES) != 0 && set->data[field] != NULL;
}

void mor_state_gather(const mor_state_array *array, void *packed)
{
    const bool is_dense = array->stride == array->n_columns; /* then all rows are as one */
    const int64_t n_rows = is_dense && array->n_rows > 1 ? 1 : array->n_rows;
    const size_t n_bytes = (size_t)(is_dense ? array->n_rows * array->n_columns : array->n_columns) * NUMBER;
    for (int64_t row = 0; row < n_rows; ++row) {
        memcpy((char *)packed + (size_t)row * n_bytes, (const char *)array->data + row * array->stride * NUMBER,
               n_bytes);
    }
}

void mor_state_scatter(const mor_state_array *array, const void *packed)
{
    const bool is_dense = array->stride == array->n_columns; /* then all rows are as one */
    const int64_t n_rows = is_dense && array->n_rows > 1 ? 1 : array->n_rows;
    const size_t n_bytes = (size_t)(is_dense ? array->n_rows * array->n_columns : array->n_columns) * NUMBER;
    for (int64_t row = 0; row < n_rows; ++row) {
        memcpy((char *)array->data + row * array->stride * NUMBER, (const char *)packed + (size_t)row * n_bytes,
               n_bytes);
    }
}

/* ---- A copy of everything: of each set the number of particles, ids, fields; then the arrays --------------------- */

static int64_t bytes_of_array(const mor_state_array *array)
{
    return array->n_rows * array->n_columns * NUMBER;
}

int64_t mor_state_bytes(const mor_state_list *list)
{
    int64_t n_bytes = 0;
    for (int k = 0; k < list->n_sets; ++k) {
        const mor_set *set = list->sets[k];
        int64_t n_numbers = 1 + set->n_created;
        for (int field = 0; field < set->n_fields; ++field) {
            n_numbers += mor_state_has_field(set, field) ? set->n_created * set->fields[field].n_components : 0;
        }
        n_bytes += n_numbers * NUMBER;
    }
    for (int k = 0; k < list->n_arrays; ++k) {
        n_bytes += bytes_of_array(&list->arrays[k]);
    }
    return n_bytes;
}

/* Copies numbers out or in and moves on behind them; an array of nothing has no place. */
static void store_numbers(char **bytes, const void *numbers, int64_t n)
{
    if (n > 0) {
        memcpy(*bytes, numbers, (size_t)(n * NUMBER));
    }
    *bytes += n * NUMBER;
}

static void load_numbers(const char **bytes, void *numbers, int64_t n)
{
    if (n > 0) {
        memcpy(numbers, *bytes, (size_t)(n * NUMBER));
    }
    *bytes += n * NUMBER;
}

void mor_state_store(const mor_state_list *list, char *bytes)
{
    for (int k = 0; k < list->n_sets; ++k) {
        const mor_set *set = list->sets[k];
        store_numbers(&bytes, &set->n_particles, 1);
        store_numbers(&bytes, set->id, set->n_particles);
        for (int field = 0; field < set->n_fields; ++field) {
            if (mor_state_has_field(set, field)) {
                store_numbers(&bytes, set->data[field], set->n_particles * set->fields[field].n_components);
            }
        }
    }
    for (int k = 0; k < list->n_arrays; ++k) {
        mor_state_gather(&list->arrays[k], bytes);
        bytes += bytes_of_array(&list->arrays[k]);
    }
}

void mor_state_load(const mor_state_list *list, const char *bytes)
{
    for (int k = 0; k < list->n_sets; ++k) {
        mor_set *set = list->sets[k];
        set->generation += 1;
        load_numbers(&bytes, &set->n_particles, 1);
        load_numbers(&bytes, set->id, set->n_particles);
        for (int field = 0; field < set->n_fields; ++field) {
            if (mor_state_has_field(set, field)) {
                load_numbers(&bytes, set->data[field], set->n_particles * set->fields[field].n_components);
            }
        }
    }
    for (int k = 0; k < list->n_arrays; ++k) {
        mor_state_scatter(&list->arrays[k], bytes);
        bytes += bytes_of_array(&list->arrays[k]);
    }
}
