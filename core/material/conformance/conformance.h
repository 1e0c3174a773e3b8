/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_H
#define MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_H

#include "core/material/kit/material.h"

/** @file
 *  The laws that every material must obey, built in or plugged in, tried with random, extreme and special input. It
 *  needs no particles, prints nothing, and gives the same figures in every run. */

enum { MOR_CONFORMANCE_ROWS_MAX = 40, MOR_CONFORMANCE_NOTE_BYTES = 256, MOR_CONFORMANCE_INPUT_BYTES = 4096 };

/** Outcome of one law. */
typedef enum mor_verdict { MOR_VERDICT_PASS, MOR_VERDICT_FAIL, MOR_VERDICT_SKIP } mor_verdict;

/** One line of the table. */
typedef struct mor_conformance_row {
    const char *law; /* a statement, static */
    mor_verdict verdict;
    double figure;                           /* worst value found; dimensionless, 1 */
    double tolerance;                        /* largest allowed figure; dimensionless, 1 */
    const char *reason;                      /* why this tolerance, static */
    char note[MOR_CONFORMANCE_NOTE_BYTES];   /* what went wrong, or why it was skipped; zero-terminated, may be empty */
    char input[MOR_CONFORMANCE_INPUT_BYTES]; /* what the first failure was found with: lines of parameters and density,
                                                start and step, '\n' between them; zero-terminated, empty: no failure */
} mor_conformance_row;

/** The table. */
typedef struct mor_conformance_report {
    mor_conformance_row rows[MOR_CONFORMANCE_ROWS_MAX]; /* shape [n_rows] */
    int n_rows;                                         /* laws tried */
    int n_failed;                                       /* of them failed */
} mor_conformance_report;

/** Tries all laws on a model.
 *  @param context    [in,out]  its seed decides the random input; left without an error on MOR_OK
 *  @param parameters [in]      shape [n_values] in schema order, units of the schema; NULL: several sets are drawn from
 *                              the ranges of the schema
 *  @param density    [in]      > 0; unit kg/m3
 *  @param report     [out]     complete even when laws failed
 *  Returns: MOR_OK when the laws could be tried, whatever the verdicts; MOR_ERROR_ARGUMENT when no instance can be made
 *  of the given (or of any drawn) parameters; MOR_ERROR_PLUGIN when the descriptor itself is refused; MOR_ERROR_MEMORY.
 *  Cost: well under a second for a closed-form law; allocates. Threads: not concurrently with the same context. */
mor_status mor_conformance_run(mor_context *context, const mor_material *material, const double *parameters,
                               double density, mor_conformance_report *report);

/** Writes one row as a line for people: verdict, law, figure, tolerance and its reason, note.
 *  The input is left out.
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0; 1024 always suffices */
void mor_conformance_format(const mor_conformance_row *row, char *text, size_t text_bytes);

#endif
