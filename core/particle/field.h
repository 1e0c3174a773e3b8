/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_FIELD_H
#define MOR_CORE_PARTICLE_FIELD_H

#include <stdint.h>

/** @file
 *  What a particle field is: name, components, unit, flags, text. Who writes it follows from the stages
 *  (core/time/stage.h). The built-in ones stand in fields_core.def; materials and bodies declare more when a set is
 *  made. */

enum {
    MOR_FIELD_EVOLVES = 1, /* state: permuted by the sort, saved in checkpoints, part of the checksum */
    MOR_FIELD_OUTPUT = 2,  /* written to snapshots */
    MOR_FIELD_SCRATCH = 4, /* recomputed in each step before it is read */
    MOR_FIELD_STATE = 8,   /* state variable of the material */
    MOR_FIELD_MOTION = 16  /* zero where particles stand */
};

/** Built-in fields, in the order of fields_core.def. */
typedef enum mor_field_id {
#define FIELD(identifier, name, components, unit, flags, text) MOR_FIELD_##identifier,
#include "core/particle/fields_core.def"
#undef FIELD
    MOR_FIELD_CORE_COUNT
} mor_field_id;

enum { MOR_FIELDS_MAX = 48, MOR_FIELD_NAME_BYTES = 48 };

/** Describes one field. The strings are static or outlive the set. */
typedef struct mor_field_info {
    char name[MOR_FIELD_NAME_BYTES]; /* unique in a set */
    int n_components;                /* numbers per particle, 1 to 9 */
    const char *unit;                /* SI unit, "1" for dimensionless */
    unsigned flags;                  /* MOR_FIELD_EVOLVES, _OUTPUT, _SCRATCH, _STATE, _MOTION */
    const char *text;                /* one line for people */
} mor_field_info;

/** Returns the description of a built-in field.
 *  @param id [in]  0 <= id < MOR_FIELD_CORE_COUNT
 *  Returns: a static record, never NULL. */
const mor_field_info *mor_field_core_info(mor_field_id id);

#endif
