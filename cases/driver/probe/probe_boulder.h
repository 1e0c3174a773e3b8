/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_BOULDER_H
#define MOR_CASES_DRIVER_PROBE_PROBE_BOULDER_H

/** @file
 *  What probes of boulders remember of each body of the case, for those who write it into files. */

#define MOR_PROBE_TRAVEL "boulder_travel"
#define MOR_PROBE_PASSAGES "passages"
#define MOR_PROBE_DISPLACEMENT "displacement"

/** Of boulder_travel: shape [bodies of the case, MOR_PROBE_TRAVEL_NUMBERS]. */
enum {
    MOR_PROBE_TRAVEL_START = 0,   /* 3; center at the start, placed, m */
    MOR_PROBE_TRAVEL_LAST = 3,    /* 3; center at the last look, m */
    MOR_PROBE_TRAVEL_LENGTH = 6,  /* of the path of the center, m */
    MOR_PROBE_TRAVEL_FASTEST = 7, /* largest speed of the center, m/s */
    MOR_PROBE_TRAVEL_TIME = 8,    /* when that was, s */
    MOR_PROBE_TRAVEL_NUMBERS = 9
};

/** Of passages: shape [bodies of the case, MOR_PROBE_PASSAGE_NUMBERS]. */
enum {
    MOR_PROBE_PASSAGE_SIDE,   /* 1: beyond the plane; 0: before it */
    MOR_PROBE_PASSAGE_NET,    /* times it crossed forward, less those back, inside the region, 1 */
    MOR_PROBE_PASSAGE_TIME,   /* of the first crossing forward, s; NaN: none */
    MOR_PROBE_PASSAGE_ENERGY, /* kinetic energy then, J (J/m) */
    MOR_PROBE_PASSAGE_NUMBERS
};

#endif
