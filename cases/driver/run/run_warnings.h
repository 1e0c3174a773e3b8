/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_WARNINGS_H
#define MOR_CASES_DRIVER_RUN_RUN_WARNINGS_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  What a run warned of, each text once and in order, so that it stands beside the results. Whatever is logged with
 *  MOR_LOG_WARNING while a run goes on arrives here. */

enum { MOR_RUN_WARNINGS_MAX = 64 };

/** Begins warnings that belong to the end of a run: a run that is resumed beyond its end finds them again. */
#define MOR_RUN_WARNING_AT_END "at the end of the run "

/** The texts of a run. Zeroed: none. Owner: the run's files, or a search for a factor of safety, which end it with
 *  mor_run_warnings_clear. */
typedef struct mor_run_warnings {
    char *texts[MOR_RUN_WARNINGS_MAX];   /* shape [n]; zero-terminated; owned */
    bool is_shown[MOR_RUN_WARNINGS_MAX]; /* shape [n]; to whoever runs it, when it arose */
    int n;
} mor_run_warnings;

/** Adds a text unless it is there already. The last place says that the log has more.
 *  @param text     [in]      zero-terminated
 *  Returns: whether the text was new and had room. */
bool mor_run_warnings_add(mor_context *context, mor_run_warnings *warnings, const char *text);

/** Notes that a text was shown when it arose, so that it need not be printed again.
 *  @param text     [in]      zero-terminated */
void mor_run_warnings_show(mor_run_warnings *warnings, const char *text);

/** Adds the warnings in the log of an earlier part of the run, but for those of its end.
 *  @param path     [in]      zero-terminated; of the log; a missing one has none */
void mor_run_warnings_load(mor_context *context, mor_run_warnings *warnings, const char *path);

/** Adds the warnings in a part of a log, as mor_run_warnings_load does.
 *  @param text     [in]      shape [n_bytes]; lines of a log
 *  @param n_bytes  [in]      length of text */
void mor_run_warnings_read(mor_context *context, mor_run_warnings *warnings, char *text, size_t n_bytes);

/** Frees the texts.
 *  @param warnings [in,out]  becomes zeroed */
void mor_run_warnings_clear(mor_context *context, mor_run_warnings *warnings);

#endif
