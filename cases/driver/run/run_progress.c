/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_progress.h"

enum { TERMINAL_WIDTH = 126 };

bool mor_run_progress_is_due(mor_run_progress *progress, double now)
{
    const double interval = progress->is_terminal ? MOR_RUN_PROGRESS_TERMINAL : MOR_RUN_PROGRESS_FILE;
    if (progress->stream == NULL || now - progress->last < interval) {
        return false;
    }
    progress->last = now;
    return true;
}

void mor_run_progress_show(mor_run_progress *progress, const char *line)
{
    if (progress->is_terminal) {
        fprintf(progress->stream, "\r%-*s", TERMINAL_WIDTH, line);
        progress->is_shown = true;
    } else {
        fprintf(progress->stream, "%s\n", line);
    }
    fflush(progress->stream);
}

void mor_run_progress_end(mor_run_progress *progress)
{
    if (progress->is_shown) {
        fprintf(progress->stream, "\r%*s\r", TERMINAL_WIDTH, "");
        progress->is_shown = false;
    }
}
