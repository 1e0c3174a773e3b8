/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_PACK_PACK_H
#define MOR_RELAXATION_PACK_PACK_H

#include "core/geometry/shape.h"

/** @file
 *  Rocks at random positions in a region, rotated at random, with a minimum gap between any two, to a share of the
 *  region's volume (area in two dimensions) and a size distribution. Largest rocks first; positions are drawn until one
 *  is free. */

enum { MOR_PACK_SIZES_MAX = 64 };

/** What to place. Made ready by mor_pack_request_init. Everything pointed to is borrowed during the call. */
typedef struct mor_pack_request {
    int dimension;                 /* 2 (in x-y) or 3 */
    const mor_shape *region;       /* bounded */
    double region_volume;          /* m3 (m2); NaN: by integration */
    const mor_shape *const *forms; /* shape [n_forms]; each with its center of volume at the origin, of diameter 1 m,
                                    * that is of volume pi/6 m3 (area pi/4 m2) */
    int n_forms;                   /* >= 1; each rock draws one */
    double content;                /* rocks' volume over the region's, 1; 0 < content < 1; not read with a count */
    int count;                     /* of rocks, from the size distribution; 0: as many as fill the content */
    const double *diameters;       /* shape [n_sizes]; rising; of the ball (disc) of the same volume, m */
    const double *passing;         /* shape [n_sizes]; share of the rocks' volume of rocks up to that diameter, 1;
                                    * rising, the last 1. One size: all rocks have it. Several: the first is where the
                                    * curve starts, and between two the volume is distributed evenly over the
                                    * diameter */
    int n_sizes;                   /* 1 to MOR_PACK_SIZES_MAX */
    double gap;                    /* least distance between two rocks, m; >= 0 */
    double margin;                 /* least depth of a rock under the region's surface, m; < 0: may protrude by as
                                    * much */
    const mor_shape *obstacle;     /* rocks keep the gap to it; NULL: none */
    double resolution;             /* of the exact check: points on a rock's surface are its crossings with a grid of
                                    * cells of at most half of it, and so far apart stay any two rocks, m; > 0 */
    int most_tries;                /* places drawn for one rock, fewer after failed draws, before others are displaced
                                    * to make space for it; >= 1. No more are displaced when that takes too long */
    uint64_t seed;
} mor_pack_request;

/** One rock. */
typedef struct mor_pack_rock {
    int form;           /* index into forms */
    double diameter;    /* m: the form is scaled by diameter / 1 m */
    double position[3]; /* of the center, m */
    double axis[3];     /* of its rotation, unit vector, 1; z in 2D */
    double angle;       /* rad */
} mor_pack_rock;

/** What was placed. Owner: the caller, who ends it with mor_pack_clear. */
typedef struct mor_pack_result {
    mor_pack_rock *rocks; /* shape [n_rocks]; largest first */
    int n_rocks;
    int n_given_up;                     /* rocks for which no position was found */
    double largest_given_up;            /* diameter of the largest of them, m; 0: there is none */
    double content;                     /* reached: by exact volumes of the rocks, 1 */
    double passing[MOR_PACK_SIZES_MAX]; /* reached, by volume, 1 */
    double smallest_gap;                /* between any two rocks, by the exact check, m; INFINITY for one rock */
} mor_pack_result;

/** Sets what is not written to: no gap, no margin, no obstacle, 20000 tries, seed 1. */
void mor_pack_request_init(mor_pack_request *request);

/** Places rocks. The number and the sizes are drawn first, so that content and size distribution are as accurate as
 *  whole rocks allow; the last rock of a size class is the one that comes nearest. If there is no free position for a
 *  rock, the rest of its volume is tried with smaller ones of the size distribution; what is missing at the end is
 *  reported by n_given_up and content, and logged as a warning with a remedy.
 *  @param result  [out]     empty after a failure
 *  Returns: MOR_OK, also when the content was not reached; MOR_ERROR_ARGUMENT for a wrong request; MOR_ERROR_MEMORY.
 *  Threads: the result does not depend on them. */
mor_status mor_pack(mor_context *context, const mor_pack_request *request, mor_pack_result *result);

/** Frees the rocks; accepts an empty result. */
void mor_pack_clear(mor_context *context, mor_pack_result *result);

#endif
