/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_SINGLE_H
#define MOR_CORE_SPH_PAIR_PAIR_SINGLE_H

#include "core/particle/images.h"
#include "core/sph/pair/pair.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  Copies in single precision of what the pair loops read, for those in mixed precision. The state stays in double: the
 *  copies are made before the sums of momentum, which those of stress differences at boundaries follow; before those of
 *  the velocity gradient velocities are copied again. Theory: docs/theory/soil.md, mixed precision. */

/** Room for the copies. Owner: the soil solver. Zeroed: none. */
typedef struct mor_pair_singles {
    float *records;           /* shape [capacity, 16]; units of these as in mor_pair_single_arrays */
    float *extra;             /* shape [capacity, 16], units as there; or NULL */
    float *artificial_stress; /* shape [capacity, 6], units as there; or NULL */
    float *strain_rate;       /* shape [capacity, MOR_PAIR_SINGLE_STRAIN], units as there; or NULL */
    float *of_soil;           /* shape [capacity, MOR_PAIR_OF_SOIL_SIZE], units as there; or NULL */
    uint8_t *is_wide;         /* shape [capacity / 8]; see mor_pair_singles_is_wide */
    int64_t capacity;         /* particles and images there is room for */
} mor_pair_singles;

/** Makes copies of what arrays hold in double, for particles, the lanes behind the last one, and images, and lets the
 *  loops read them. An image is at exactly one rounded period from its owner, so that two particles see one another at
 *  opposite places.
 *  @param constants [in]      the smoothing length gives the units
 *  @param images    [in]      of the particles; zeroed: none
 *  @param singles   [in,out]  room, made larger where it does not suffice, and then all is copied; else copies of
 *                             clusters whose flag in arrays->changing is 0 stay, and with arrays->has_singles all but
 *                             velocities
 *  @param arrays    [in,out]  their singles are written; NULL in them for what is NULL in arrays, extra
 *                             without accelerations, too
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates only when there are more images than ever before. */
mor_status mor_pair_singles_pack(mor_context *context, const mor_pair_constants *constants, const mor_images *images,
                                 mor_pair_singles *singles, mor_pair_arrays *arrays);

/** Returns whether a cluster is so wide, along any axis, that places modulo 2^32 would show it soil that is far away
 *  as near: a sum over its pairs must be one in double. Depends on places alone.
 *  @param singles [in]  packed
 *  @param cluster [in]  of the particles */
static inline bool mor_pair_singles_is_wide(const mor_pair_singles *singles, int64_t cluster)
{
    return singles->is_wide[cluster] != 0;
}

/** Frees what is owned; accepts a zeroed one. */
void mor_pair_singles_clear(mor_context *context, mor_pair_singles *singles);

/** Memory of the copies for each particle or image, bytes, by which arrays there are. */
double mor_pair_singles_bytes(bool has_extra, bool has_artificial_stress, bool has_strain_rate, bool has_soils);

#endif
