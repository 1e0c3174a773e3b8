/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_STRENGTH_REPORT_H
#define MOR_CASES_DRIVER_SAFETY_STRENGTH_REPORT_H

#include "cases/driver/case/case.h"
#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  The strength of the soils of a case in plane strain, in words. */

/** Prints a line for each soil whose law has a friction angle or a cohesion: its strength in plane strain over that of
 *  Mohr and Coulomb, which need not be 1, or why it is not known.
 *  @param out        [in,out]  one open stream
 *  @param name_width [in]      of the column of names, characters
 *  Returns: MOR_OK; as mor_strength_compare. */
mor_status mor_strength_report_print(mor_context *context, FILE *out, const mor_case *the_case, int name_width);

#endif
