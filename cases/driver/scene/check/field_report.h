/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_FIELD_REPORT_H
#define MOR_CASES_DRIVER_SCENE_CHECK_FIELD_REPORT_H

#include "cases/driver/scene/simulation.h"

#include <stdio.h>

/** @file
 *  Parameters of soils that vary in space, as a table. */

/** Prints what the parameters that vary in space came to in the particles; nothing where none does.
 *  @param out        [in,out]  one open stream
 *  @param simulation [in]      built */
void mor_field_report_print(FILE *out, const mor_simulation *simulation);

#endif
