/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_READER_CASE_INPUTS_H
#define MOR_CASES_DRIVER_CASE_READER_CASE_INPUTS_H

#include "cases/driver/case/case.h"

#include <stdint.h>

/** @file
 *  The files that a case was read with, beside its own. */

/** A file that a case refers to. */
typedef struct mor_case_input {
    const char *path; /* zero-terminated; borrowed from the case */
    uint64_t hash;    /* of its content when it was read */
} mor_case_input;

/** Lists the plug-ins of a case and the files that its shapes were made from, each once.
 *  @param the_case [in]   from mor_case_read
 *  @param inputs   [out]  shape [room]
 *  @param room     [in]   most files listed
 *  Returns: the number of files. */
int mor_case_inputs(const mor_case *the_case, mor_case_input *inputs, int room);

#endif
