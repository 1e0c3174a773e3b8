/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_LEVEL_SET_LEVEL_SET_H
#define MOR_RELAXATION_LEVEL_SET_LEVEL_SET_H

#include "relaxation/mesh/mesh.h"

/** @file
 *  Signed distance on a grid: fast to evaluate and smooth, for shapes whose own distance is slow. Between grid points
 *  the value is that of tricubic (bicubic in two dimensions) interpolation, so that normals are continuous. Nodes
 *  within a band about the surface hold the exact distance; beyond the band the magnitude is a lower bound, the sign is
 *  right. A level set of a mesh keeps the mesh: mor_shape_exact_distance evaluates it. The value changes by at most 1.1
 *  m per m over two cells and more; within a cell of a kink (edges, inside) by 1.4. */

/** Resolution. */
typedef struct mor_level_set_request {
    int dimension; /* 2 or 3 */
    double cell;   /* grid spacing, unit m; > 0 */
    double band;   /* half width of the band, unit m; at least 3 cells */
} mor_level_set_request;

/** Makes the level set of a mesh, as a shape with exact moments (those of the mesh).
 *  @param mesh    [in]      closed and oriented; not kept
 *  @param request [in]      dimension 3
 *  @param shape   [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a wrong request or a grid of more than 5e8 nodes, with what to do;
 *  MOR_ERROR_MEMORY.
 *  Cost: distances at the nodes of the band only. Threads: uses the context's; the result does not depend on them. */
mor_status mor_shape_new_mesh(mor_context *context, const mor_mesh *mesh, const mor_level_set_request *request,
                              mor_shape **shape);

/** Makes the level set of any bounded shape. It has the moments of the source if the source provides them.
 *  @param source  [in]      not kept; in two dimensions evaluated at z = 0
 *  @param shape   [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: as mor_shape_new_mesh; MOR_ERROR_ARGUMENT also for an unbounded shape. */
mor_status mor_shape_new_level_set(mor_context *context, const mor_shape *source, const mor_level_set_request *request,
                                   mor_shape **shape);

#endif
