/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_PNG_FILE_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_PNG_FILE_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  The only interface to libpng: writes an image into an open file, compressed fast rather than small. No time stamp or
 *  other varying data goes into the file. */

/** Writes an image.
 *  @param stream       [in,out]  one open file; a write that fails is left to its error flag
 *  @param path         [in]      zero-terminated; for messages
 *  @param size         [in]      shape [2]; columns and rows, >= 1
 *  @param pixels       [in]      shape [rows, stride_bytes]; each pixel a native 32-bit number, 0xRRGGBB
 *  @param stride_bytes [in]      bytes from row to row
 *  Returns: MOR_OK, also when the file took not all; MOR_ERROR_MEMORY; MOR_ERROR_IO for what libpng says. */
mor_status mor_png_file_write(mor_context *context, FILE *stream, const char *path, const int *size,
                              const unsigned char *pixels, int64_t stride_bytes);

#endif
