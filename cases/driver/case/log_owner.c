/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/log_owner.h"

#include <stdarg.h>
#include <stdio.h>

static void pass_line(void *user, mor_log_level level, const char *text)
{
    const mor_log_owner *owner = user;
    char line[MOR_CONTEXT_MESSAGE_BYTES + MOR_LOG_OWNER_BYTES];
    snprintf(line, sizeof line, "%s: %s", owner->text, text);
    owner->sink(owner->user, level, line);
}

void mor_log_owner_begin(mor_log_owner *owner, mor_context *context, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(owner->text, sizeof owner->text, format, arguments);
    va_end(arguments);
    owner->sink = context->log_sink;
    owner->user = context->log_user;
    if (owner->sink != NULL) {
        context->log_sink = pass_line;
        context->log_user = owner;
    }
}

void mor_log_owner_end(const mor_log_owner *owner, mor_context *context)
{
    context->log_sink = owner->sink;
    context->log_user = owner->user;
}
