/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_GEOMETRY_DOMAIN_H
#define MOR_CORE_GEOMETRY_DOMAIN_H

#include "core/base/math.h"

#include <stdbool.h>
#include <stddef.h>

/** @file
 *  The box that particles may not leave. The box is placed together with the scene. */

/** A rotated and translated frame: a point x of it lies at rotation * x + translation. */
typedef struct mor_domain_frame {
    double rotation[9];    /* shape [3,3], rotation matrix, 1 */
    double translation[3]; /* m */
} mor_domain_frame;

/** Finds where a place lies in a frame.
 *  @param frame [in]   NULL: identity
 *  @param place [in]   shape [3], unit m
 *  @param local [out]  shape [3], unit m */
static inline void mor_domain_localize(const mor_domain_frame *frame, const double *place, double *local)
{
    for (int a = 0; a < 3; ++a) {
        local[a] = frame != NULL ? place[a] - frame->translation[a] : place[a];
    }
    if (frame != NULL) {
        const double moved[3] = {local[0], local[1], local[2]};
        mor_matrix_apply_transposed(frame->rotation, moved, local);
    }
}

/** Returns whether a place in the frame of a box lies in it; false for a place that is not a number.
 *  @param minimum   [in]  shape [3], unit m; lowest corner
 *  @param maximum   [in]  shape [3], unit m; highest corner
 *  @param dimension [in]  2 or 3; 2: whatever its z
 *  @param local     [in]  shape [3], unit m */
static inline bool mor_domain_holds(const double *minimum, const double *maximum, int dimension, const double *local)
{
    return local[0] >= minimum[0] && local[0] <= maximum[0] && local[1] >= minimum[1] && local[1] <= maximum[1] &&
           (dimension == 2 || (local[2] >= minimum[2] && local[2] <= maximum[2]));
}

#endif
