/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_STRUCTURES_H
#define MOR_CASES_DRIVER_MAP_MAP_STRUCTURES_H

#include "cases/driver/case/case.h"

/** @file
 *  Where structures stand on the ground of the maps, such as the posts of a dam: walls beside the terrain that are
 *  bounded, neither move nor are removed, and do not cover the whole map. */

/** Finds what is covered by structures, seen from above.
 *  @param the_case [in]      maps are wanted
 *  @param size     [in]      shape [2]; columns and rows of pixels that share the map evenly, >= 1
 *  @param covered  [out]     the address of one array [size[1], size[0]], row 0 with the largest y; 1: a structure
 *                            stands there above the ground; NULL: none does, or the map has no terrain; owned by the
 *                            caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; as mor_map_grid_init. */
mor_status mor_map_structures_find(mor_context *context, const mor_case *the_case, const int *size, uint8_t **covered);

#endif
