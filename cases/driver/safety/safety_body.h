/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_BODY_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_BODY_H

#include "cases/driver/safety/safety_measure.h"

/** @file
 *  The critical body: what has moved more than a share of the largest displacement when a trial failed, but for
 *  connected parts that are small beside the largest one.
 *  Theory: docs/theory/strength_reduction.md (F4). */

/** The body. Owner: the caller, who ends it with mor_safety_body_clear. */
typedef struct mor_safety_body {
    double share;  /* of the largest displacement, 1 */
    double limit;  /* the displacement above which a particle is part of it, m */
    double volume; /* m3; in plane strain the area, m2 */
    int64_t n;     /* particles that are part of it */
    bool *is_part; /* shape [particles at creation], by number; owned */
    bool has_ends; /* in plane strain, where it reaches the surface; never in a periodic domain */
    double top[2]; /* where it leaves the surface at its upper end, frame of the case, x and y, m; NaN without */
    double toe[2]; /* likewise at its lower end */
} mor_safety_body;

/** Finds the body.
 *  @param simulation [in]   at the end of a trial that failed
 *  @param reference  [in]   the state it started from
 *  @param largest    [in]   displacement that the smallest body that counts exceeds, m
 *  @param body       [out]  cleared after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_safety_body_find(mor_context *context, const mor_simulation *simulation,
                                const mor_safety_reference *reference, double largest, mor_safety_body *body);

/** Frees what it owns; accepts a zeroed one. */
void mor_safety_body_clear(mor_context *context, mor_safety_body *body);

#endif
