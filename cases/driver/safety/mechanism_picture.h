/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_MECHANISM_PICTURE_H
#define MOR_CASES_DRIVER_SAFETY_MECHANISM_PICTURE_H

#include "cases/driver/safety/safety.h"

/** @file
 *  The mechanism of a failure in plane strain: particles where they were at the start, colored by what happened to
 *  them, with the critical body outlined. */

/** What particles are colored by. */
typedef enum mor_mechanism_color {
    MOR_MECHANISM_DISPLACEMENT, /* since the start, m */
    MOR_MECHANISM_STRAIN        /* plastic strain since the start, 1; only of laws that tell it */
} mor_mechanism_color;

/** Draws the picture.
 *  @param it   [in]  with a mechanism, in plane strain
 *  @param path [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_mechanism_draw(mor_context *context, const mor_safety *it, mor_mechanism_color color, const char *path);

#endif
