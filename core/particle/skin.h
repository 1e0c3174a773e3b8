/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_SKIN_H
#define MOR_CORE_PARTICLE_SKIN_H

#include "core/particle/tree.h"

#include <stdbool.h>

/** @file
 *  Whether lists that were built for a reach, support plus skin, still hold all who see one another within the support.
 *  Two points that were not listed may come nearer to one another by what they were apart beyond the support. How far
 *  they may have done so is bounded for nodes of their trees by the ranges of the displacements in these, so that soil
 *  that moves together keeps its lists; where bounds do not tell, points are compared. What is told is a function of
 *  places alone, and no sum depends on it: lists hold more than is seen. */

/** Points on one side of the lists. Everything is borrowed. */
typedef struct mor_skin_side {
    const mor_tree *tree;  /* fitted when the lists were built */
    const double *records; /* shape [n_points, stride]; where the points are now, x, y, z first, m; NULL: what bounds
                            * do not tell counts as seen */
    int stride;            /* doubles per record, 1 */
    const double *built;   /* shape [n_points, 3]; where they were when the lists were built, m; NULL: where they are */
    double *ranges;      /* shape [2 * n_clusters - 1, 6]; least, then largest displacement of the points of a node, by
                            * axis, m; NULL: none is longer than the displacement */
    double displacement; /* longest one, where there are no ranges, m */
} mor_skin_side;

/** Where particles were when lists of them were built, and a bound of how far they have moved since. Owner: whoever
 *  builds the lists. */
typedef struct mor_skin_places {
    const mor_tree *tree; /* fitted to them; borrowed */
    double *built;        /* shape [n_points, 3]; owned, m */
    double *ranges;       /* shape [2 * n_clusters - 1, 6]; scratch, which several may share; borrowed, m */
    double drift;         /* no particle has moved farther, m */
} mor_skin_places;

/** Makes room for the points of a tree.
 *  @param tree   [in]      outlives the places
 *  @param ranges [in]      shape [2 * n_clusters - 1, 6]; outlives the places, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_skin_places_init(mor_context *context, mor_skin_places *places, const mor_tree *tree, double *ranges);

/** Frees what it owns; accepts a zeroed one. */
void mor_skin_places_clear(mor_context *context, mor_skin_places *places);

/** Keeps the places at which lists are built.
 *  @param position [in]  shape [n_points, 3], unit m */
void mor_skin_places_keep(mor_context *context, mor_skin_places *places, const double *position);

/** Returns the side of particles that are elsewhere now, measured.
 *  @param position [in]  shape [n_points, 3], unit m */
mor_skin_side mor_skin_places_measure(mor_context *context, const mor_skin_places *places, const double *position);

/** Finds the ranges of a side that has them.
 *  @param side [in,out]  ranges are written */
void mor_skin_measure(mor_context *context, const mor_skin_side *side);

/** Returns whether a bound of the displacements of both sides says that lists hold. Without a skin they are built in
 *  each step.
 *  @param drift [in]  of the source, unit m
 *  @param other [in]  of the target, unit m
 *  @param skin  [in]  reach less support, unit m */
static inline bool mor_skin_is_bounded(double drift, double other, double skin)
{
    return skin > 0.0 && drift + other <= skin;
}

/** Returns whether all pairs within the support were within the reach when the lists were built.
 *  @param source  [in]  measured
 *  @param target  [in]  measured; the same object: who see one another
 *  @param support [in]  unit m
 *  @param reach   [in]  of the lists, >= support, unit m
 *  Returns: true; false where one was not, without a skin, or where it would cost more than new lists to find out. */
bool mor_skin_holds(mor_context *context, const mor_skin_side *source, const mor_skin_side *target, double support,
                    double reach);

#endif
