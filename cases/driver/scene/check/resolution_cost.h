/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_RESOLUTION_COST_H
#define MOR_CASES_DRIVER_SCENE_CHECK_RESOLUTION_COST_H

#include "cases/driver/scene/simulation.h"

#include <stddef.h>

/** @file
 *  What another spacing costs. Nothing is computed for it: an estimate from the number of particles. */

/** What a spacing costs, compared with that of the case. */
typedef struct mor_resolution_cost {
    double spacing;   /* m */
    double particles; /* of soil, 1 */
    double work;      /* over that of the case, 1: (spacing ratio)^(dimension + 1), as steps are longer, too */
} mor_resolution_cost;

/** Finds what a spacing costs. Estimate: particles fill volumes, and steps are in proportion to the spacing.
 *  @param spacing [in]   m, above 0
 *  @param cost    [out]  one cost */
void mor_resolution_find_cost(const mor_simulation *simulation, double spacing, mor_resolution_cost *cost);

/** Writes a cost in words: "0.25 m: about 104000 particles of soil, 16 times the work".
 *  @param text    [out]  shape [n_bytes]; zero-terminated */
void mor_resolution_describe_cost(const mor_simulation *simulation, double spacing, char *text, size_t n_bytes);

#endif
