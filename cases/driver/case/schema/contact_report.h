/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SCHEMA_CONTACT_REPORT_H
#define MOR_CASES_DRIVER_CASE_SCHEMA_CONTACT_REPORT_H

#include "cases/driver/case/case.h"

#include <stdio.h>

/** @file
 *  How stiff the surfaces of rigid bodies are, in words: forces of contacts depend on it, so whoever reads one is told
 *  whether the stiffness was given or chosen. */

/** Whether the modulus of a body's surface was chosen for speed because the case gives none. */
bool mor_contact_report_is_chosen(const mor_case_body *body);

/** Prints the moduli of all rigid bodies, from the least to the largest: one line for each Poisson's ratio, given or
 *  chosen.
 *  @param out      [in,out]  one open stream */
void mor_contact_report_print(const mor_case *the_case, FILE *out);

/** What is to be known of a force or a depth of contacts, a sentence without its stop: that their stiffness was chosen
 *  for speed, or that elastic bodies meet on springs between their nodes.
 *  @param probe    [in]  index of the probe
 *  @param is_late  [in]  whether its maximum or minimum is from when bodies of several clocks pressed on a wall
 *  Returns: a static text; NULL when there is nothing to be known. */
const char *mor_contact_report_remark(const mor_case *the_case, int probe, bool is_late);

#endif
