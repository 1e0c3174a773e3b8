/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_PICTURES_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_PICTURES_H

#include "cases/driver/safety/safety.h"

/** @file
 *  Pictures of a search for the factor of safety: displacement against factor, speed over time around the answer, and
 *  the mechanism with the critical body outlined. */

/** Draws images/displacement.png, images/speed.png and, in plane strain, where a trial failed,
 *  images/mechanism-displacement.png and images/mechanism-strain.png.
 *  @param folder [in]      zero-terminated; has a folder images
 *  @param output [in,out]  one open stream; paths are printed to it
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_safety_draw(mor_context *context, const mor_safety *it, const char *folder, FILE *output);

#endif
