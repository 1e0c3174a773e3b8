/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_MESH_DISTANCE_H
#define MOR_RELAXATION_MESH_MESH_DISTANCE_H

#include "relaxation/mesh/mesh.h"

/** @file
 *  Exact distance to a mesh, by Embree's point queries; inside test by a majority of rays. For geometry, only
 *  mesh_distance.c calls Embree. Distances are computed in double precision; only the search for the nearest triangle
 *  uses Embree's boxes, which are widened so that single precision loses none. */

typedef struct mor_mesh_distance mor_mesh_distance;

/** Makes the search structure of a mesh.
 *  @param mesh     [in]      copied
 *  @param distance [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a mesh without triangles or with corners that are not finite;
 *  MOR_ERROR_MEMORY; MOR_ERROR_INTERNAL when Embree refuses.
 *  Cost: O(n log n). */
mor_status mor_mesh_distance_new(mor_context *context, const mor_mesh *mesh, mor_mesh_distance **distance);

/** Frees it and sets the pointer to NULL. NULL is accepted.
 *  @param distance [in,out]  one pointer */
void mor_mesh_distance_free(mor_context *context, mor_mesh_distance **distance);

/** Distance to the nearest triangle, without sign, searched up to a limit.
 *  @param point    [in]   shape [3]; unit m
 *  @param limit    [in]   unit m; INFINITY: none
 *  @param nearest  [out]  shape [3]; unit m; the nearest point of the surface; may be NULL; untouched beyond the limit
 *  Returns: unit m; the limit when nothing is nearer. Threads: safe to call concurrently. */
double mor_mesh_distance_find(const mor_mesh_distance *distance, const double *point, double limit, double *nearest);

/** Whether a point is inside: the majority of several rays in fixed directions, by the number of triangles they cross,
 *  so that a ray along an edge, or through a slit in the mesh, does not change the result.
 *  @param point    [in]  shape [3]; unit m
 *  Threads: safe to call concurrently. */
bool mor_mesh_distance_is_inside(const mor_mesh_distance *distance, const double *point);

#endif
