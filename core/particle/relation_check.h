/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_RELATION_CHECK_H
#define MOR_CORE_PARTICLE_RELATION_CHECK_H

#include "core/particle/relation.h"

/** @file
 *  Whether lists are complete, by comparing all with all: for the checked build. */

/** Two sets of points, the lists between them, and what they are called in messages. */
typedef struct mor_relation_check {
    const mor_relation *relation;
    mor_relation_points source, target;
    const char *source_name, *target_name;
    double support; /* nearer than this all must be listed, m */
} mor_relation_check;

/** Looks whether a cluster lists all that is near one of its points.
 *  @param check   [in]  sets with their present places, unit m
 *  @param cluster [in]  of the source
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL with both points where one is missing. Cost: compares eight points with all of
 *  the target. */
mor_status mor_relation_check_cluster(mor_context *context, const mor_relation_check *check, int64_t cluster);

#endif
