/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_BOUNDARY_WALL_CLUSTERS_H
#define MOR_CORE_SPH_BOUNDARY_WALL_CLUSTERS_H

#include "core/base/context.h"
#include "core/particle/tree.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** @file
 *  What is kept of soil particles beside boundaries alone: room for those of clusters that list one, found anew with
 *  the lists. */

struct mor_soil_contact;

/** What a soil particle sees of faces with normals n, those of all boundaries together. */
typedef struct mor_contact_corner {
    double rest[3]; /* sum of kernel gradients, what is not along the faces of each; then what corners add, 1/m4 (m3) */
    double faces[6]; /* sum of V (1 - (q/2)^4) n (x) n, symmetric tensor, m3 (m2 in plane strain); then what projects on
                      * the directions in which several faces bear, 1; zero where one does */
    bool sees_any;   /* the two are current */
    bool is_solved;  /* they are those at last */
    bool is_limited; /* friction limits all that acts along some face, and each keeps the force along its own normals */
} mor_contact_corner;

/** The clusters that list boundaries, and what is kept of their particles. Owner: the soil. */
typedef struct mor_wall_clusters {
    int8_t *n_patches; /* shape [clusters]; patches of boundaries whose points the lists hold, at most 2, 1; NULL: not
                         * known */
    int32_t *places;   /* shape [clusters]; place of each in closed, continued and corners; -1: it lists no boundary;
                         * NULL: the cluster itself */
    int64_t n;         /* clusters that list any */
    int64_t room;      /* clusters that closed, continued and corners have room for */
    bool has_closed;   /* which of these are wanted; others stay NULL, as all do before the first lists */
    bool has_continued;
    bool has_corners;
    double *closed;    /* shape [room * 8, 6]; moments of the kernel gradient with what boundaries close of them, 1 */
    double *continued; /* shape [room * 8, 6]; what boundaries continue of them along themselves, 1 */
    mor_contact_corner *corners; /* shape [room * 8]; faces that each particle sees */
} mor_wall_clusters;

/** Allocates places and counts of patches; no cluster lists a boundary yet.
 *  @param at         [in,out]  zeroed, but for what is wanted
 *  @param n_clusters [in]      of the soil
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_wall_clusters_init(mor_context *context, mor_wall_clusters *at, int64_t n_clusters);

/** Frees what it owns; accepts a zeroed one. */
void mor_wall_clusters_clear(mor_context *context, mor_wall_clusters *at);

/** Begins to count anew which clusters list boundaries.
 *  @param n_clusters [in]  of the soil now */
void mor_wall_clusters_begin(mor_wall_clusters *at, int64_t n_clusters);

/** Counts the patches of a boundary that clusters list.
 *  @param contact [in]  with lists */
void mor_wall_clusters_count(mor_wall_clusters *at, const struct mor_soil_contact *contact);

/** Gives the clusters that list any their places, and room; what was kept is lost.
 *  @param n_clusters [in]  of the soil now
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates where the room is too small. */
mor_status mor_wall_clusters_end(mor_context *context, mor_wall_clusters *at, int64_t n_clusters);

/** Returns the place of the first particle of a cluster in what is kept, 1; below zero: it lists no boundary.
 *  @param places  [in]  shape [clusters]; as in mor_wall_clusters; NULL: that of the particle itself
 *  @param cluster [in]  of the soil */
static inline int64_t mor_wall_clusters_first(const int32_t *places, int64_t cluster)
{
    return (places != NULL ? places[cluster] : cluster) * MOR_CLUSTER;
}

/** Returns the bytes that are held, 1.
 *  @param n_clusters [in]  of the soil now */
double mor_wall_clusters_bytes(const mor_wall_clusters *at, int64_t n_clusters);

#endif
