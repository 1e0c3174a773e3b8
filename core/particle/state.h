/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_STATE_H
#define MOR_CORE_PARTICLE_STATE_H

#include "core/particle/set.h"

#include <stdbool.h>

/** @file
 *  A list of what evolves: particle sets, and arrays of numbers beside them. Whoever owns state adds it, by name, place
 *  and shape; whoever saves or restores it walks the list and knows none of the owners. Everything that is not in the
 *  list must follow from the case and from what is in it. */

enum { MOR_STATE_NAME_BYTES = 2 * MOR_FIELD_NAME_BYTES };

/** Kinds of numbers, 64 bits each. */
typedef enum mor_state_kind { MOR_STATE_INT64, MOR_STATE_UINT64, MOR_STATE_DOUBLE } mor_state_kind;

/** An array beside the particle sets. Its rows may lie apart, as a member of each of several structs does. */
typedef struct mor_state_array {
    char name[MOR_STATE_NAME_BYTES]; /* <owner>.<member>, unique in its list, without '/' */
    mor_state_kind kind;
    int64_t n_rows; /* >= 0 */
    int n_columns;  /* numbers of a row, >= 1 */
    int64_t stride; /* numbers from the start of a row to that of the next, >= n_columns */
    void *data;     /* the first number; shape [n_rows, n_columns] with that stride; borrowed */
} mor_state_array;

/** The list. Owner: whoever has it filled, who ends it with mor_state_clear. Zeroed: empty. */
typedef struct mor_state_list {
    mor_set **sets; /* shape [n_sets]; ids and evolving fields are state; borrowed */
    int n_sets, sets_capacity;
    mor_state_array *arrays; /* shape [n_arrays] */
    int n_arrays, arrays_capacity;
} mor_state_list;

/** Adds a particle set: number of particles, ids and evolving fields.
 *  @param set     [in]      borrowed; outlives the list
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL when a set of that name is in the list; MOR_ERROR_MEMORY. */
mor_status mor_state_add_set(mor_context *context, mor_state_list *list, mor_set *set);

/** Adds numbers that lie side by side.
 *  @param owner   [in]      zero-terminated; part of the name
 *  @param member  [in]      zero-terminated; part of the name
 *  @param kind    [in]      of the numbers
 *  @param n       [in]      number of numbers, >= 0
 *  @param data    [in]      shape [n] of int64_t, uint64_t or double as kind says; outlives the list
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL for a name that is too long or taken; MOR_ERROR_MEMORY. */
mor_status mor_state_add(mor_context *context, mor_state_list *list, const char *owner, const char *member,
                         mor_state_kind kind, int64_t n, void *data);

/** Adds a member that each of several equal structs, or records, has.
 *  @param owner        [in]      zero-terminated; part of the name
 *  @param member       [in]      zero-terminated; part of the name
 *  @param n_rows       [in]      number of structs, >= 0
 *  @param n_columns    [in]      doubles of the member, >= 1
 *  @param stride_bytes [in]      size of a struct, a multiple of that of a double
 *  @param first        [in]      shape [n_columns], any unit; the member of the first struct; outlives the list
 *  Returns: as mor_state_add. */
mor_status mor_state_add_member(mor_context *context, mor_state_list *list, const char *owner, const char *member,
                                int64_t n_rows, int n_columns, size_t stride_bytes, double *first);

/** Frees the list, not what it lists; accepts a zeroed one. */
void mor_state_clear(mor_context *context, mor_state_list *list);

/** Whether a field of a set belongs to the state.
 *  @param field [in]  index of the field */
bool mor_state_has_field(const mor_set *set, int field);

/** Gathers the rows of an array side by side, or puts them back.
 *  @param array  [in]   whose data is read
 *  @param packed [out]  shape [n_rows, n_columns] of 64-bit numbers; not of another kind than the array's */
void mor_state_gather(const mor_state_array *array, void *packed);

/** Puts rows that lie side by side back into an array.
 *  @param array  [in]  whose data is written
 *  @param packed [in]  shape [n_rows, n_columns] of 64-bit numbers */
void mor_state_scatter(const mor_state_array *array, const void *packed);

/** Bytes of a copy of all that is listed, with room for sets as they were made. */
int64_t mor_state_bytes(const mor_state_list *list);

/** Copies all that is listed.
 *  @param bytes [out]  shape [mor_state_bytes(list)] */
void mor_state_store(const mor_state_list *list, char *bytes);

/** Puts a copy back, bit for bit; sets get the number of particles they had and the next generation.
 *  @param bytes [in]  shape [mor_state_bytes(list)]; filled by mor_state_store with a list of the same shape */
void mor_state_load(const mor_state_list *list, const char *bytes);

#endif
