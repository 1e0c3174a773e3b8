/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_warnings.h"

#include "core/base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char line_start[] = "warning: ";

/* Without memory there is no copy: the log has the text. What is being reported meanwhile stays the last error. */
static char *copy_text(mor_context *context, const char *text)
{
    const mor_context before = *context;
    const int64_t n_bytes = (int64_t)strlen(text) + 1;
    char *copy = NULL;
    if (MOR_NEW(context, &copy, n_bytes, "warning of a run") != MOR_OK) {
        mor_context_restore_error(context, &before);
        return NULL;
    }
    memcpy(copy, text, (size_t)n_bytes);
    return copy;
}

bool mor_run_warnings_add(mor_context *context, mor_run_warnings *warnings, const char *text)
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
    char *copy = copy_text(context, is_last ? "there are more warnings, of which the log tells" : text);
    if (copy == NULL) {
        return false;
    }
    warnings->texts[warnings->n++] = copy;
    return !is_last;
}

void mor_run_warnings_show(mor_run_warnings *warnings, const char *text)
{
    for (int k = 0; k < warnings->n; ++k) {
        warnings->is_shown[k] = warnings->is_shown[k] || strcmp(warnings->texts[k], text) == 0;
    }
}

/* Closes the log; NULL is accepted. */
static void add_lines(mor_context *context, mor_run_warnings *warnings, FILE *log)
{
    char *line = NULL;
    size_t room = 0;
    while (log != NULL && getline(&line, &room, log) > 0) {
        const char *text = line + sizeof line_start - 1;
        if (strncmp(line, line_start, sizeof line_start - 1) == 0 &&
            strncmp(text, MOR_RUN_WARNING_AT_END, sizeof MOR_RUN_WARNING_AT_END - 1) != 0) {
            line[strcspn(line, "\n")] = '\0';
            mor_run_warnings_add(context, warnings, text);
        }
    }
    free(line);
    if (log != NULL) {
        fclose(log);
    }
}

void mor_run_warnings_load(mor_context *context, mor_run_warnings *warnings, const char *path)
{
    add_lines(context, warnings, fopen(path, "rb"));
}

void mor_run_warnings_read(mor_context *context, mor_run_warnings *warnings, char *text, size_t n_bytes)
{
    add_lines(context, warnings, n_bytes > 0 ? fmemopen(text, n_bytes, "rb") : NULL);
}

void mor_run_warnings_clear(mor_context *context, mor_run_warnings *warnings)
{
    for (int k = 0; k < warnings->n; ++k) {
        MOR_FREE(context, &warnings->texts[k]);
    }
    memset(warnings, 0, sizeof *warnings);
}
