/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_RUN_PROGRESS_H
#define MOR_CASES_DRIVER_RUN_RUN_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

/** @file
 *  How far a run is: one line that is written over and over on a terminal, a line now and then elsewhere. */

/** Seconds between two lines on a terminal, and elsewhere: in a file they stay. */
#define MOR_RUN_PROGRESS_TERMINAL 0.5
#define MOR_RUN_PROGRESS_FILE 30.0

enum { MOR_RUN_PROGRESS_BYTES = 192 };

/** Where and when. Owner: the run. */
typedef struct mor_run_progress {
    FILE *stream; /* borrowed; NULL: quiet */
    bool is_terminal;
    bool is_shown; /* a line stands on the terminal */
    double last;   /* when the last line was written, or the run began, s */
} mor_run_progress;

/** Whether it is time for another line; if so, the interval starts again.
 *  @param now      [in]      of the clock, s */
bool mor_run_progress_is_due(mor_run_progress *progress, double now);

/** Writes a line.
 *  @param line     [in]      zero-terminated, without an end of line; at most MOR_RUN_PROGRESS_BYTES - 1 letters */
void mor_run_progress_show(mor_run_progress *progress, const char *line);

/** Takes the line off the terminal. */
void mor_run_progress_end(mor_run_progress *progress);

#endif
