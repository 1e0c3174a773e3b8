/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_MESH_SIZE_H
#define MOR_RELAXATION_MESH_MESH_SIZE_H

#include "relaxation/mesh/mesh.h"

/** @file
 *  Message for a mesh that is too large because its file is not in meters. */

/** Puts the size of a mesh in front of a refusal of its level set, if it was not scaled and is so large that its unit
 *  is the likely reason.
 *  @param context [in,out]  holds the refusal
 *  @param status  [in]      what the level set returned
 *  @param meters  [in]      one length of the mesh in meters, 1
 *  @param spacing [in]      distance of particles, m
 *  @param advice  [in]      zero-terminated; how a size is given
 *  Returns: status. */
mor_status mor_mesh_size_annotate_error(mor_context *context, mor_status status, const mor_mesh *mesh, double meters,
                                        double spacing, const char *advice);

#endif
