/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_FIGURE_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_FIGURE_H

#include "cases/driver/element/element_record.h"

/** @file
 *  The figure of an element test, four charts: stress over strain, stress path, change of volume over strain, and void
 *  ratio over the logarithm of the mean stress (volumetric strain where no void ratio is known). Along a path of shear
 *  they are of the shear stress and strain, else of q, p and the deviatoric strain. */

/** Draws the figure.
 *  @param settings  [in]      of the test
 *  @param records   [in]      shape [n_records]; a line each
 *  @param n_records [in]      1 to MOR_ELEMENT_SPECIMENS_MAX
 *  @param data      [in]      drawn as points; NULL: none
 *  @param path      [in]      zero-terminated; an existing file is replaced
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_element_figure_write(mor_context *context, const mor_element_settings *settings,
                                    const mor_element_record *records, int n_records, const mor_element_record *data,
                                    const char *path);

#endif
