/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_STATUS_H
#define MOR_CORE_BASE_STATUS_H

/** @file
 *  The status codes every function that can fail returns. Zero is success, a positive code means
 *  "try again with a smaller step", a negative code is fatal. Messages live in the context
 *  (core/base/context.h), not here. */

/** The one list of codes: name, number, text. */
#define MOR_STATUS_LIST(X)                                                                                             \
    X(OK, 0, "ok")                                                                                                     \
    X(RETRY_SMALLER_STEP, 1, "retry with a smaller time step")                                                         \
    X(NOT_CONVERGED, 2, "an iteration did not converge")                                                               \
    X(ERROR_ARGUMENT, -1, "wrong argument")                                                                            \
    X(ERROR_MEMORY, -2, "out of memory")                                                                               \
    X(ERROR_IO, -3, "file cannot be read or written")                                                                  \
    X(ERROR_CONFIG, -4, "the case file is wrong")                                                                      \
    X(ERROR_PLUGIN, -5, "a plug-in cannot be used")                                                                    \
    X(ERROR_NUMERIC, -6, "the computation failed")                                                                     \
    X(ERROR_UNSUPPORTED, -7, "not supported")                                                                          \
    X(ERROR_INTERNAL, -8, "internal error")                                                                            \
    X(ERROR_CRASH, -9, "the code of the material crashed")                                                             \
    X(ERROR_BOUNDS, -10, "the code of the material wrote outside its arrays")

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mor_status {
#define MOR_STATUS_ENUM(name, code, text) MOR_##name = code,
    MOR_STATUS_LIST(MOR_STATUS_ENUM)
#undef MOR_STATUS_ENUM
} mor_status;

#pragma GCC visibility push(default) /* the shared library shows it */

/** Returns the text of a status code.
 *  @param status [in]  any code; unknown codes give "unknown status"
 *  Returns: a static string, never NULL.
 *  Threads: safe to call concurrently. */
const char *mor_status_text(mor_status status);

#pragma GCC visibility pop

#ifdef __cplusplus
}
#endif

#endif
