/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_RUN_TEXT_H
#define MOR_TESTS_COMMON_RUN_TEXT_H

#include "core/io/summary/summary.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/** @file
 *  Runs of cases that a test writes down as text. */

/* Runs a case, zero-terminated text, with settings up to a NULL; the exit code must be as expected: 3 where an
 * expectation of the case is missed. */
static inline program_outcome run_text(run_folder *folder, const char *text, const char *name,
                                       const char *const *settings, int exit_code)
{
    char path[MOR_PATH_BYTES], results[MOR_PATH_BYTES];
    const char *words[PROGRAM_ARGUMENTS_MAX] = {"run", path, "-o", results, "-t", "1"};
    int n = 6;
    finished_run_store_text(folder, text, path);
    run_folder_file(folder, results, name);
    for (int k = 0; settings[k] != NULL; ++k) {
        words[n++] = "--set";
        words[n++] = settings[k];
    }
    words[n] = NULL;
    return program_run(folder, words, exit_code);
}

/* What a probe of a run did in all steps. */
static inline mor_summary_statistics read_statistics(run_folder *folder, const char *name, const char *probe)
{
    char path[MOR_PATH_BYTES], remark[256];
    mor_summary_statistics it;
    finished_run_file(folder, path, name, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_statistics(&folder->context, path, probe, &it, remark, sizeof remark), MOR_OK);
    return it;
}

/* Largest value that a probe of a run took, in every step. */
static inline double read_maximum(run_folder *folder, const char *name, const char *probe)
{
    return read_statistics(folder, name, probe).maximum;
}

/* Integral of a force over time, N s. */
static inline double read_impulse(run_folder *folder, const char *name, const char *probe)
{
    return read_statistics(folder, name, probe).impulse;
}

/* No settings. */
static const char *const as_it_is[] = {NULL};

#endif
