/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_XDMF_H
#define MOR_CORE_IO_XDMF_H

#include "core/io/snapshot.h"

/** @file
 *  The XDMF description of a series of snapshots, for ParaView and VisIt: for each set one temporal collection of
 *  particles (polyvertex grids). It holds no numbers itself but points into the snapshot files.
 *
 *  Symmetric tensors are attributes of type Matrix with six columns in the order of the file, xx yy zz xy yz zx: every
 *  reader of ParaView passes six columns on unchanged and labels them XX YY ZZ XY YZ XZ. The type Tensor6 is avoided
 *  because the two readers of ParaView take different orders for it.
 *
 *  ParaView 5.11 reads it with both; choose "XDMF Reader", since the Xdmf3 readers give the points no cells, so that
 *  they are drawn only through a glyph filter. */

/** Replaces the description of a series.
 *  @param path    [in]      zero-terminated path of the description, in the run's folder
 *  @param list    [in]      the series. A set without particles or without the field "position" is left out
 *  Returns: MOR_OK; MOR_ERROR_IO, then the old description stays. */
mor_status mor_xdmf_write(mor_context *context, const char *path, const mor_snapshot_list *list);

#endif
