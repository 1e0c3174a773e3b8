/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_WRITE_CASE_WRITE_H
#define MOR_CASES_DRIVER_CASE_WRITE_CASE_WRITE_H

#include "cases/driver/case/case.h"
#include "core/material/registry.h"

#include <stdio.h>

/** @file
 *  From struct mor_case back to a case file. */

/** Writes a case with every value that is used, in SI and with units, defaults marked by a comment. Reading it again
 *  gives the same case bit for bit (values stand before the scale, which is an exact factor). The path names the old
 *  file or the new one whole, at whatever moment the process is killed.
 *  @param the_case [in]      from mor_case_read
 *  @param registry [in]      the models the case was read with
 *  @param path     [in]      zero-terminated; replaced
 *  Returns: MOR_OK; MOR_ERROR_IO naming path and reason, and the old file stays. */
mor_status mor_case_write(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                          const char *path);

/** As mor_case_write, to an open stream.
 *  @param the_case [in]      from mor_case_read
 *  @param registry [in]      the models the case was read with
 *  @param stream   [in,out]  one open stream; its error flag reports failed writes
 *  Returns: MOR_OK; MOR_ERROR_IO when the unit tables are missing. */
mor_status mor_case_write_stream(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                                 FILE *stream);

#endif
