/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* 1 in the program moraine_checked, whose contexts check from the start. */
#ifndef MOR_CHECKED
#define MOR_CHECKED 0
#endif

enum { LOG_LINE_BYTES = 2048 };

void mor_context_init(mor_context *context)
{
    memset(context, 0, sizeof *context);
    context->particle = -1;
    context->item = -1;
    context->n_threads = 1;
    context->seed = 1;
    context->is_checked = MOR_CHECKED != 0;
}

void mor_context_clear_error(mor_context *context)
{
    context->status = MOR_OK;
    context->message[0] = '\0';
    context->n_frames = 0;
    context->particle = -1;
    context->item = -1;
    context->particle_set[0] = '\0';
}

void mor_context_restore_error(mor_context *context, const mor_context *earlier)
{
    context->status = earlier->status;
    memcpy(context->message, earlier->message, sizeof context->message);
    memcpy(context->frames, earlier->frames, sizeof context->frames);
    context->n_frames = earlier->n_frames;
    context->particle = earlier->particle;
    context->item = earlier->item;
    memcpy(context->particle_set, earlier->particle_set, sizeof context->particle_set);
}

mor_status mor_context_fail(mor_context *context, mor_status status, const mor_frame *place, const char *format, ...)
{
    /* Formatted aside first: an argument may be the message itself. */
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    memcpy(context->message, text, sizeof text);
    context->status = status;
    context->n_frames = 0;
    context->particle = -1;
    context->item = -1;
    context->particle_set[0] = '\0';
    return mor_context_pass(context, status, place);
}

mor_status mor_context_name_particle(mor_context *context, mor_status status, const char *set, int64_t particle)
{
    snprintf(context->particle_set, sizeof context->particle_set, "%s", set);
    context->particle = particle;
    return status;
}

mor_status mor_context_name_item(mor_context *context, mor_status status, int item)
{
    context->item = item;
    return status;
}

mor_status mor_context_pass(mor_context *context, mor_status status, const mor_frame *place)
{
    if (context->n_frames < MOR_CONTEXT_FRAMES) {
        context->frames[context->n_frames++] = *place;
    }
    return status;
}

void mor_context_log(mor_context *context, mor_log_level level, const char *format, ...)
{
    if (context->log_sink == NULL) {
        return;
    }
    char text[LOG_LINE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    context->log_sink(context->log_user, level, text);
}
