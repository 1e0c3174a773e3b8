/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_LOG_H
#define MOR_CORE_BASE_LOG_H

/** @file
 *  What a log line is, and who receives it. */

#ifdef __cplusplus
extern "C" {
#endif

/** Severity of a log line. */
typedef enum mor_log_level {
    MOR_LOG_DEBUG,
    MOR_LOG_INFO,     /* for the record */
    MOR_LOG_PROGRESS, /* for people who wait */
    MOR_LOG_WARNING,
    MOR_LOG_ERROR
} mor_log_level;

/** Receives one finished log line.
 *  @param user  [in,out]  what the installer of the sink passed; owned by the installer
 *  @param level [in]      severity
 *  @param text  [in]      zero-terminated line without a newline; valid during the call only */
typedef void (*mor_log_sink)(void *user, mor_log_level level, const char *text);

#ifdef __cplusplus
}
#endif

#endif
