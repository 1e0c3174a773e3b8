/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_FILES_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_FILES_H

#include "cases/driver/safety/safety.h"

/** @file
 *  What a search for the factor of safety leaves in its folder: trials.csv, history.csv, fos.json, and the table that
 *  is printed at its end. */

/** Where the numbers come from. */
typedef struct mor_safety_provenance {
    const char *version; /* of the program, zero-terminated, as all of these */
    const char *commit;
    const char *command;
} mor_safety_provenance;

/** Writes trials.csv, one line for each trial in the order of factors, and history.csv, one line for each sample.
 *  @param folder [in]  zero-terminated; there already
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_safety_write_tables(mor_context *context, const mor_safety *it, const char *folder);

/** Writes numbers with all their digits, each with a comma behind; one that is not finite leaves its cell empty.
 *  @param values [in]      shape [n], any unit
 *  @param out    [in,out]  one open stream */
void mor_safety_print_cells(const double *values, int n, FILE *out);

/** Writes fos.json.
 *  @param folder     [in]  zero-terminated; there already
 *  @param provenance [in]  one record
 *  @param request    [in]  what was asked
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_safety_write_summary(mor_context *context, const mor_safety *it, const mor_safety_request *request,
                                    const mor_safety_provenance *provenance, const char *folder);

/** Prints the band, what the criteria are, and the critical body.
 *  @param out [in,out]  one open stream */
void mor_safety_print(const mor_safety *it, FILE *out);

/** Writes the band as "1.375 to 1.383", with "above" or "below" where one end is missing.
 *  @param text       [out]  shape [text_bytes]; zero-terminated
 *  @param text_bytes [in]   room in bytes, > 0 */
void mor_safety_format_band(const mor_safety_band *band, char *text, size_t text_bytes);

#endif
