/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_TEST_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_TEST_H

#include "cases/driver/element/element_record.h"

/** @file
 *  An element test from its settings to its tables and its summary. */

/** Makes the specimens of a test and leads them along its path, one after the other. A specimen that cannot follow to
 *  the end keeps the rows it has; why is logged as a warning.
 *  @param material [in]      the law
 *  @param settings [in]      of the test
 *  @param records  [out]     shape [n_specimens]; zeroed before; cleared by the caller, after a failure too
 *  Returns: MOR_OK, also when a specimen stopped; MOR_ERROR_CONFIG for parameters or a start that the law refuses;
 *  MOR_ERROR_MEMORY. */
mor_status mor_element_test_run(mor_context *context, const mor_material *material,
                                const mor_element_settings *settings, mor_element_record *records);

/** Prints what was found: for each specimen the largest q with p and the strain there, the largest mobilized friction
 *  angle, and the end.
 *  @param records [in]      shape [n_specimens]
 *  @param out     [in,out]  an open file */
void mor_element_test_print(const mor_material *material, const mor_element_settings *settings,
                            const mor_element_record *records, FILE *out);

#endif
