/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_BOUNDARY_SOIL_WALL_H
#define MOR_CORE_SPH_BOUNDARY_SOIL_WALL_H

#include "core/sph/boundary/soil_contact.h"

/** @file
 *  A wall that has particles only where soil is near. All its particles are numbered and put into blocks when it is
 *  made: compact parts of the order that they would have as a whole. A block is filled when lists are built for soil in
 *  reach of it. Filled blocks stand in the order of the whole wall, and lists hold what is in reach alone, so that soil
 *  sees the same particles in the same order as if all were filled. Theory: docs/theory/walls.md. */

/** A block of particles of a wall. */
typedef struct mor_wall_block {
    int64_t first;  /* of its particles in the order of the whole wall */
    int32_t n;      /* particles */
    bool is_sorted; /* its numbers stand in the order of its particles */
    bool is_filled;
    int64_t at;    /* of its first particle among those that are filled; -1: it is not */
    double box[6]; /* minimum and maximum corner of its particles before any motion, m */
} mor_wall_block;

/** The blocks of a wall. Owner: the contact. */
typedef struct mor_wall_blocks {
    mor_wall_source source; /* its owner is borrowed */
    double point_volume;    /* of a whole particle, m3 (m2 in plane strain) */
    double velocity[3];     /* of particles that were not moved yet, m/s */
    int64_t n_points;       /* particles of the whole wall */
    int64_t n_blocks;
    mor_wall_block *blocks; /* shape [n_blocks]; by rising first */
    int64_t *numbers;       /* shape [n_points]; of the particles, by blocks */
    double *start;          /* shape [n_points, 3]; where they are before any motion, by blocks, m; NULL: forgotten */
    double box[6];          /* of all particles before any motion, m */
    int64_t capacity;       /* particles there is room for */
    mor_wall_points found;  /* of one block; scratch */
    int32_t *order;         /* of one block; scratch */
    int64_t *spare;         /* likewise, numbers */
    double moved_to;        /* time to which the wall was moved, s; not a number: it was not */
    double built_at;        /* likewise when the lists were built, s */
} mor_wall_blocks;

/** Divides a wall into blocks, of which none is filled.
 *  @param contact [in,out]  with a wall's arrays for at least one particle
 *  @param request [in]      with a source
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_wall_blocks_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request);

/** Frees what the blocks of a contact own; accepts a contact without. */
void mor_wall_blocks_clear(mor_context *context, mor_soil_contact *contact);

/** Fills the blocks that come within reach of the soil, and those a little farther with them; does nothing for a wall
 *  without blocks. New particles stand where they are before any motion.
 *  @param soil      [in]   its fitted tree
 *  @param reach     [in]   of the lists, unit m
 *  @param has_grown [out]  one flag: whether blocks were filled
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; what the source returns. Cost: allocates only for more particles than there is
 *  room for. */
mor_status mor_wall_blocks_fill(mor_context *context, mor_soil_contact *contact, const mor_tree *soil, double reach,
                                bool *has_grown);

/** Returns how far particles that are not filled may have moved at most since the lists were built, unit m. */
double mor_wall_blocks_drift(const mor_soil_contact *contact);

/** Returns whether no block that is not filled has come within the support of the soil since the lists were built.
 *  @param contact [in]  also one without blocks
 *  @param soil    [in]  measured
 *  @param displacement [in]  longest one of the wall since, unit m
 *  @param support [in]  of the kernel, unit m
 *  @param reach   [in]  of the lists, unit m */
bool mor_wall_blocks_hold(mor_context *context, const mor_soil_contact *contact, const mor_skin_side *soil,
                          double displacement, double support, double reach);

/** Finds the box of all particles of a wall that does not rotate, filled or not.
 *  @param contact [in]   with blocks
 *  @param box     [out]  shape [6]; minimum and maximum corner, unit m */
void mor_wall_blocks_bound(const mor_soil_contact *contact, double *box);

/** Checks that no soil is within the support of the kernel of a block that is not filled.
 *  @param records [in]  shape [n_particles, stride]; x, y, z first, unit m
 *  @param support [in]  unit m
 *  @param time    [in]  for the message, unit s
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL. Cost: O(particles times blocks), for checked runs. */
mor_status mor_wall_blocks_check(mor_context *context, const mor_soil_contact *contact, const mor_relation_points *soil,
                                 double support, double time);

#endif
