/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_MEMORY_ROOM_H
#define MOR_CASES_DRIVER_SCENE_BUILD_MEMORY_ROOM_H

#include <stdint.h>

/** @file
 *  How many particles fit into the memory that is free. A system may grant more memory than it has and kill the program
 *  later without a message; so filling a shape asks here first. */

enum {
    MOR_MEMORY_ROOM_SOIL = 720, /* bytes a particle of soil takes in a run, neighbor lists included */
    MOR_MEMORY_ROOM_BODY = 720, /* a particle of a body */
    MOR_MEMORY_ROOM_WALL = 96   /* a particle of a wall */
};

/** Returns the memory that is free for this program, bytes, 1; INFINITY where the system does not tell. */
double mor_memory_room(void);

/** Returns how many particles of so many bytes fit beside some that are still to get theirs, >= 1.
 *  @param bytes_each [in]  bytes of one particle, 1; > 0
 *  @param reserved   [in]  bytes that others will take, 1 */
int64_t mor_memory_room_particles(double bytes_each, double reserved);

#endif
