/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_SET_H
#define MOR_CORE_PARTICLE_SET_H

#include "core/base/context.h"
#include "core/base/schema.h"
#include "core/particle/field.h"

/** @file
 *  A particle set: named fields in aligned arrays, one record of ids. Permuting the set permutes every evolving field.
 *  It does not know what its particles are made of.
 *
 *  Fields are stored one array each, components interleaved: value a of particle i is data[i * n_components + a]. */

/** One set. Invariant between calls: every declared field has room for n_particles particles, ids are unique.
 *  Owner: the run. Field pointers are borrowed until the next resize or permute, which raise `generation`. */
typedef struct mor_set {
    char name[MOR_FIELD_NAME_BYTES];
    int64_t n_particles;                   /* number of particles */
    int64_t n_created;                     /* number at creation, for which there is room; >= n_particles */
    int n_fields;                          /* declared fields; the built-in ones come first */
    mor_field_info fields[MOR_FIELDS_MAX]; /* shape [n_fields] */
    double *data[MOR_FIELDS_MAX];          /* shape [n_fields] of [n_particles, n_components], NULL for unused
                                             fields; unit: of the field */
    int64_t *id;                           /* shape [n_particles]; number given at creation, unchanged by sorting */
    uint64_t borrowed;                     /* bit of each field whose memory is somebody else's */
    uint64_t generation;                   /* raised by every resize or permute */
} mor_set;

/** Makes a set with the given built-in fields.
 *  @param set         [out]     storage supplied by the caller
 *  @param name        [in]      zero-terminated; copied
 *  @param n_particles [in]      number of particles, >= 0; ids become 0 .. n_particles - 1
 *  @param field_mask  [in]      bit (1 << mor_field_id) set for each built-in field to have
 *  Returns: MOR_OK; MOR_ERROR_MEMORY.
 *  Cost: allocates. */
mor_status mor_set_init(mor_context *context, mor_set *set, const char *name, int64_t n_particles, uint64_t field_mask);

/** Frees everything the set owns; accepts a zeroed or half-made set. */
void mor_set_clear(mor_context *context, mor_set *set);

/** Adds a field declared by a material or a body; its values are zero.
 *  @param info    [in]      copied
 *  @param index   [out]     one number; the index of the field in set->data
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when the name is taken or the table is full; MOR_ERROR_MEMORY. */
mor_status mor_set_add_field(mor_context *context, mor_set *set, const mor_field_info *info, int *index);

/** Adds the state of a material as fields that evolve and come out.
 *  @param state   [in]      shape [n_state]
 *  @param n_state [in]      number of variables
 *  @param fields  [out]     shape [n_state]; indices of the fields in set->data
 *  Returns: as mor_set_add_field. */
mor_status mor_set_add_state(mor_context *context, mor_set *set, const mor_schema *state, int n_state, int *fields);

/** Returns the components of some fields together, of those that the set has.
 *  @param fields [in]  bit of each */
int mor_set_width(const mor_set *set, uint64_t fields);

/** Has fields one after another in memory of somebody else, for scratch that nobody needs while what else is there is
 *  needed. What they held is lost.
 *  @param set    [in,out]  those of the fields that it has
 *  @param fields [in]      bit of each
 *  @param memory [in,out]  shape [n_created padded to 8, mor_set_width], unit of each field; borrowed until they
 *                          are placed again or the set is cleared */
void mor_set_place(mor_context *context, mor_set *set, uint64_t fields, double *memory);

/** Returns the index of a field by name, or -1.
 *  @param name [in]  zero-terminated */
int mor_set_find_field(const mor_set *set, const char *name);

/** Reorders the particles: new place i holds what was at order[i]. Scratch fields are left as they are.
 *  @param order [in,out]  shape [n_particles]; a permutation of 0 .. n_particles - 1; marked meanwhile, and the same
 *                         afterwards
 *  Gives: generation + 1. Cost: O(n), allocates nothing. */
void mor_set_permute(mor_set *set, int32_t *order);

/** Removes particles; the others keep their order and their ids. All fields follow, scratch included.
 *  @param removed   [in]      shape [n_removed]; indices of particles, rising
 *  @param n_removed [in]      number of particles to remove
 *  Gives: generation + 1. Cost: O(n), allocates nothing. */
void mor_set_remove(mor_set *set, const int32_t *removed, int64_t n_removed);

/** Stops particles where they are: sets to zero all fields of their motion.
 *  @param first [in]  index of the first one
 *  @param n     [in]  number of particles, >= 0 */
void mor_set_stop(mor_set *set, int64_t first, int64_t n);

/** Returns a 64-bit hash of all evolving fields, bit patterns in particle-id order.
 *  Returns: the same value for the same state in any particle order and for any number of threads. */
uint64_t mor_set_checksum(const mor_set *set);

#endif
