/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_INTERFACES_BAND_H
#define MOR_MATERIALS_INTERFACES_BAND_H

#include <stdbool.h>

/** @file
 *  A band of numbers behind an array that a law of another program gets, to see whether it reads or writes there. For
 *  materials/interfaces only. */

enum {
    MOR_EXTERNAL_BAND = 64,      /* behind what a law writes and may index beyond */
    MOR_EXTERNAL_NARROW_BAND = 8 /* behind the rest: bands cost time in each call */
};

/** Fills a band with signaling not-a-numbers of IEEE 754 that differ from each other, of both signs: arithmetic with
 *  one of them makes another number of it, so that it shows where it is written back, and a result that is not finite
 *  where it is only read.
 *  @param band [out]  shape [n]; 1
 *  @param n    [in]   one of the two widths, 1 */
void mor_external_band_fill(double *band, int n);

/** Whether each bit of a band is as it was filled.
 *  @param band [in]  shape [n]; 1
 *  @param n    [in]  as it was filled, 1 */
bool mor_external_band_is_whole(const double *band, int n);

#endif
