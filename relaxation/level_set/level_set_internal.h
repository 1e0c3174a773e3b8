/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_LEVEL_SET_LEVEL_SET_INTERNAL_H
#define MOR_RELAXATION_LEVEL_SET_LEVEL_SET_INTERNAL_H

#include "core/geometry/shape.h"

/** @file
 *  The grid behind a level set, and how it is filled. For level_set.c and level_set_fill.c only. */

/** Nodes in order (z, y, x), x fastest; one layer in two dimensions. */
typedef struct mor_level_set_grid {
    int dimension;     /* 2 or 3 */
    int64_t counts[3]; /* shape [3]; nodes each way; 1 in z in two dimensions */
    double origin[3];  /* shape [3]; node (0, 0, 0), m */
    double cell;       /* distance of two nodes, m */
    double band;       /* values are between -band and band, m */
    double *values;    /* shape [counts z, counts y, counts x]; signed distance, m; owned */
} mor_level_set_grid;

/** Where distances come from. */
typedef struct mor_level_set_source {
    const void *object; /* first argument of the calls below; borrowed */
    /** Distance from a point, shape [3], unit m; one that is not below the limit, m, need not be exact. Signed, unless
     *  is_inside is there. Safe to call concurrently. */
    double (*measure)(const void *object, const double *point, double limit);
    /** Whether a point, shape [3], unit m, is inside; NULL when measure returns a signed distance. */
    bool (*is_inside)(const void *object, const double *point);
} mor_level_set_source;

/** Fills the values of a grid whose other members are set. Whole blocks of nodes far from the surface are not measured
 *  one by one. Where the source has no sign, adjacent nodes that cannot have a surface between them get theirs
 *  together.
 *  @param grid    [in,out]  values allocated here, owned by the caller also after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY.
 *  Threads: uses the context's; the result does not depend on them. */
mor_status mor_level_set_fill(mor_context *context, mor_level_set_grid *grid, const mor_level_set_source *source);

#endif
