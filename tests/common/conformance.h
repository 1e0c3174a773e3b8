/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_CONFORMANCE_H
#define MOR_TESTS_COMMON_CONFORMANCE_H

#include "core/material/conformance/conformance.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  All laws of mechanics tried on a material. */

enum { CONFORMANCE_LINE_BYTES = 1024 };

/** Laws of which one given by its rates says nothing. */
#define CONFORMANCE_NO_DISSIPATION "dissipation is not negative; work is stored or dissipated"

/** The law that one without a yield surface says nothing of. */
#define CONFORMANCE_NO_YIELD_SURFACE "the stress ends admissible"

/** The row of a law that has words, zero-terminated, in its statement. */
static inline const mor_conformance_row *conformance_find(const mor_conformance_report *report, const char *words)
{
    for (int k = 0; k < report->n_rows; ++k) {
        if (strstr(report->rows[k].law, words) != NULL) {
            return &report->rows[k];
        }
    }
    fail_msg("no law is called '%s'", words);
    return NULL;
}

/** Tries all laws; parameters in schema order, NULL: several sets are drawn. */
static inline void conformance_run(const mor_material *material, const double *parameters,
                                   mor_conformance_report *report)
{
    mor_context context;
    mor_context_init(&context);
    const mor_status status = mor_conformance_run(&context, material, parameters, 2000.0, report);
    if (status != MOR_OK) {
        fail_msg("%s", context.message);
    }
    assert_int_equal(context.memory_bytes, 0);
    assert_int_equal(context.status, MOR_OK);
}

/** Every law must hold; those named may be skipped. */
static inline void conformance_check(const mor_material *material, const char *may_skip)
{
    mor_conformance_report report;
    conformance_run(material, NULL, &report);
    assert_true(report.n_rows >= 18);
    for (int k = 0; k < report.n_rows; ++k) {
        char line[CONFORMANCE_LINE_BYTES];
        mor_conformance_format(&report.rows[k], line, sizeof line);
        if (report.rows[k].verdict == MOR_VERDICT_FAIL) {
            fail_msg("%s: %s", material->name, line);
        }
        const int is_allowed =
            report.rows[k].verdict == MOR_VERDICT_PASS || strstr(may_skip, report.rows[k].law) != NULL;
        if (!is_allowed) {
            fail_msg("%s skipped: %s", material->name, line);
        }
    }
    assert_int_equal(report.n_failed, 0);
}

#endif
