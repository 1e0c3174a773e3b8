/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_RELAX_LATTICE_INTERNAL_H
#define MOR_RELAXATION_RELAX_LATTICE_INTERNAL_H

#include "relaxation/relax/lattice.h"

/** @file
 *  What the files of the lattice share. Not for other folders. */

/** Distances to a surface, relative to the spacing, below which a node counts as lying on it. */
#define MOR_LATTICE_TOLERANCE 1e-9

/** Node indices to visit: first[a] <= index < first[a] + count[a]. */
typedef struct mor_lattice_box {
    int64_t first[3];
    int64_t count[3];
} mor_lattice_box;

/** Points that fit into local indices. */
int64_t mor_lattice_limit(void);

/** Checks a request and finds the nodes to visit.
 *  @param margin  [in]      nodes to visit beyond the bounds of the shape, on each side
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_lattice_find_box(mor_context *context, const mor_lattice_request *request, int margin,
                                mor_lattice_box *box);

/** Refuses more points than there is room for.
 *  @param count   [in]      number of points
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_lattice_check_room(mor_context *context, const mor_lattice_request *request, int64_t count);

/** Whether a node on the surface of the shape lies inside of the shape and its siblings together, on the side of the
 *  shape.
 *  @param node    [in]   shape [3], unit m */
bool mor_lattice_is_shared(const mor_lattice_request *request, const double *node);

/** Finds the place of a node in the scene frame.
 *  @param index   [in]   shape [3]
 *  @param node    [out]  shape [3], unit m */
void mor_lattice_place_node(const mor_lattice_request *request, const int64_t *index, double *node);

/** Maps a place of the scene frame as finished points are.
 *  @param place    [in]   shape [3], unit m
 *  @param position [out]  shape [3], unit m */
void mor_lattice_map(const mor_lattice_request *request, const double *place, double *position);

#endif
