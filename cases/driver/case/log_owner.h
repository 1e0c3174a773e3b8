/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_LOG_OWNER_H
#define MOR_CASES_DRIVER_CASE_LOG_OWNER_H

#include "core/base/context.h"

/** @file
 *  Log lines of modules that do not use the case, preceded by the item of the case that they concern. */

enum { MOR_LOG_OWNER_BYTES = 512 };

/** The text before each line. It must outlive the time between begin and end. */
typedef struct mor_log_owner {
    char text[MOR_LOG_OWNER_BYTES]; /* zero-terminated */
    mor_log_sink sink;              /* of the context before; NULL: none */
    void *user;                     /* its argument */
} mor_log_owner;

/** Prepends a text to all log lines until mor_log_owner_end.
 *  @param format  [in]      printf format, then its arguments; zero-terminated */
void mor_log_owner_begin(mor_log_owner *owner, mor_context *context, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/** Restores the sink of the context.
 *  @param owner   [in]      begun */
void mor_log_owner_end(const mor_log_owner *owner, mor_context *context);

#endif
