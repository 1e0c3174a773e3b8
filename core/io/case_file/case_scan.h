/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_CASE_FILE_CASE_SCAN_H
#define MOR_CORE_IO_CASE_FILE_CASE_SCAN_H

#include "core/base/context.h"

/** @file
 *  Checks the text of a case file before it is parsed: what the parser would follow endlessly, misread silently or
 *  report without a hint is refused here. It does not check the grammar. */

enum {
    MOR_CASE_SCAN_BYTES_MAX = 1 << 24,    /* bytes of a case file */
    MOR_CASE_SCAN_DEPTH_MAX = 64,         /* brackets inside brackets */
    MOR_CASE_SCAN_SETTINGS_MAX = 1 << 18, /* 'name = value' pairs in all: 64 for each of 4096 bodies */
    MOR_CASE_SCAN_GROUP_MAX = 10000,      /* those of one group: the parser compares each name with all others */
    MOR_CASE_SCAN_VALUES_MAX = 1 << 20    /* commas */
};

/** Checks size, bytes, brackets, strings, comments, @include and number literals.
 *  @param name    [in]      zero-terminated; the file's name, for messages
 *  @param text    [in]      shape [n_bytes]; need not be zero-terminated
 *  @param n_bytes [in]      length of text, >= 0
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "name:line: found ...; allowed ...; do ...".
 *  Cost: O(n_bytes). Threads: neither (reports into the context). */
mor_status mor_case_scan(mor_context *context, const char *name, const char *text, int64_t n_bytes);

/** Finds the first name on a line that its group has already had.
 *  @param context    [in,out]  as of mor_case_scan
 *  @param text       [in]   shape [n_bytes]; passed by mor_case_scan
 *  @param n_bytes    [in]   length of text, >= 0
 *  @param line       [in]   of the second one, > 0
 *  @param key        [out]  shape [key_bytes]; zero-terminated, cut when too long; "" where there is none
 *  @param key_bytes  [in]   room in key in bytes, > 0
 *  Returns: the line of the first one, > 0; 0 where there is none.
 *  Cost: O(n_bytes) for each name on the line. */
int mor_case_scan_duplicate(mor_context *context, const char *text, int64_t n_bytes, int line, char *key,
                            size_t key_bytes);

#endif
