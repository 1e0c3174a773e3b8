/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_warnings.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char line_start[] = "warning: ";

bool mor_run_warnings_add(mor_run_warnings *warnings, const char *text)
{
    for (int k = 0; k < warnings->n; ++k) {
        if (strcmp(warnings->texts[k], text) == 0) {
            return false;
        }
    }
    if (warnings->n == MOR_RUN_WARNINGS_MAX) {
        return false;
    }
    const bool is_last = warnings->n == MOR_RUN_WARNINGS_MAX - 1;
    char *copy = strdup(is_last ? "there are more warnings: see log.txt" : text);
    if (copy == NULL) {
        return false; /* the log has it */
    }
    warnings->texts[warnings->n++] = copy;
    return !is_last;
}

void mor_run_warnings_load(mor_run_warnings *warnings, const char *path)
{
    char *line = NULL;
    size_t room = 0;
    FILE *log = fopen(path, "rb");
    while (log != NULL && getline(&line, &room, log) > 0) {
        const char *text = line + sizeof line_start - 1;
        if (strncmp(line, line_start, sizeof line_start - 1) == 0 &&
            strncmp(text, MOR_RUN_WARNING_AT_END, sizeof MOR_RUN_WARNING_AT_END - 1) != 0) {
            line[strcspn(line, "\n")] = '\0';
            mor_run_warnings_add(warnings, text);
        }
    }
    free(line);
    if (log != NULL) {
        fclose(log);
    }
}

void mor_run_warnings_clear(mor_run_warnings *warnings)
{
    for (int k = 0; k < warnings->n; ++k) {
        free(warnings->texts[k]);
    }
    memset(warnings, 0, sizeof *warnings);
}
