/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SCHEMA_CASE_COMPARE_H
#define MOR_CASES_DRIVER_CASE_SCHEMA_CASE_COMPARE_H

#include "cases/driver/case/case.h"

#include <stdbool.h>

/** @file
 *  Whether a run may go on with a case: two cases as mor_case_write_stream writes them, compared value by value. What
 *  was a default and what was given does not matter; the content of files does, by their hashes.
 *
 *  A run that goes on may get another `end` (whether it is not over yet is for the run to check), a larger `domain`,
 *  `outflow` from stop to remove, another `output`, other expectations, and more probes behind those that it has. */

enum { MOR_CASE_DIFFERENCE_BYTES = 256 };

/** The first difference that keeps a run from going on. */
typedef struct mor_case_difference {
    bool is_found;
    char found[MOR_CASE_DIFFERENCE_BYTES];    /* zero-terminated; in the case given, as "key = value" or "nothing" */
    char expected[MOR_CASE_DIFFERENCE_BYTES]; /* zero-terminated; in the case saved, likewise */
    const char *reason;                       /* static; why it matters, as a clause with a leading "; ", or "" */
} mor_case_difference;

/** Finds the first difference that keeps a run from going on.
 *  @param given      [in]   zero-terminated text of the case to go on with
 *  @param saved      [in]   zero-terminated text of the case the run was started with */
void mor_case_compare(mor_case_probe_catalog probe_types, const char *given, const char *saved,
                      mor_case_difference *difference);

/** Finds the first difference of any value, of those as well with which a run may go on.
 *  @param given      [in]   zero-terminated text of a case
 *  @param saved      [in]   zero-terminated text of another one
 *  @param difference [out]  one record; reason is "" or that a file has changed */
void mor_case_compare_whole(const char *given, const char *saved, mor_case_difference *difference);

/** Returns a hash of all values of a case and of the contents of its files: of equal cases it is the same, whatever was
 *  a default.
 *  @param text [in]  zero-terminated, as mor_case_write_stream writes it */
uint64_t mor_case_compare_hash(const char *text);

/** Whether the domains of two cases differ.
 *  @param given [in]  zero-terminated text
 *  @param saved [in]  zero-terminated text */
bool mor_case_compare_domains(const char *given, const char *saved);

#endif
