/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_CONTEXT_H
#define MOR_CORE_BASE_CONTEXT_H

#include "core/base/guard.h"
#include "core/base/log.h"
#include "core/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** @file
 *  The per-run context: the last error with its call chain, the log sink, memory accounting, the
 *  number of threads and the seed. It is the first argument of every function that can fail.
 *  Not a place for simulation data. */

enum { MOR_CONTEXT_MESSAGE_BYTES = 2048, MOR_CONTEXT_FRAMES = 8, MOR_CONTEXT_NAME_BYTES = 64 };

/** Where an error passed through. */
typedef struct mor_frame {
    const char *file;     /* static string */
    const char *function; /* static string */
    int line;             /* 1-based line */
} mor_frame;

/** One run. Owned by the caller; one thread at a time may report errors into it. */
typedef struct mor_context {
    mor_status status;                         /* code of the last error, MOR_OK when none */
    char message[MOR_CONTEXT_MESSAGE_BYTES];   /* what was found, what is allowed, what to do */
    mor_frame frames[MOR_CONTEXT_FRAMES];      /* call chain, innermost first */
    int n_frames;                              /* valid entries in frames */
    int64_t particle;                          /* number of the particle that the last error is about; -1: none */
    char particle_set[MOR_CONTEXT_NAME_BYTES]; /* its set; "": none */
    mor_log_sink log_sink;                     /* NULL: log lines are dropped */
    void *log_user;                            /* passed to log_sink; owned by the installer */
    int n_threads;                             /* threads a parallel loop uses, >= 1 */
    const char *cache_folder;                  /* where relaxed particles are kept, zero-terminated; NULL or "":
                                                  nowhere; owned by the installer */
    mor_guard guard;                           /* for code of others that may crash; NULL: none */
    uint64_t seed;                             /* seed of all counter-based random numbers */
    bool is_checked;                           /* the run verifies what stages and materials declare; slow */
    size_t memory_bytes;                       /* bytes now held by mor_memory_new */
    size_t memory_peak_bytes;                  /* largest memory_bytes so far */
    uint64_t n_allocations;                    /* number of successful mor_memory_new so far */
    int item;                                  /* index of the item, of those that the failed function was given, that
                                                  the last error is about; -1: none */
} mor_context;

/** Makes the context ready: no error, no sink, one thread, seed 1.
 *  @param context [out]  storage supplied by the caller */
void mor_context_init(mor_context *context);

/** Forgets the last error. */
void mor_context_clear_error(mor_context *context);

/** Restores an earlier error as the last one: its handling may have failed, too.
 *  @param earlier [in]      a copy of the context as it was then */
void mor_context_restore_error(mor_context *context, const mor_context *earlier);

/** Records an error and returns its code. Use MOR_FAIL, which fills in the place.
 *  @param status  [in]      the code to record; must not be MOR_OK
 *  @param place   [in]      where the error arose
 *  @param format  [in]      printf format, then its arguments; zero-terminated
 *  Returns: status.
 *  Threads: not inside a parallel loop. */
mor_status mor_context_fail(mor_context *context, mor_status status, const mor_frame *place, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/** Records which particle the last error concerns.
 *  @param status   [in]      code of the error
 *  @param set      [in]      zero-terminated name of the particle's set; copied
 *  @param particle [in]      its number, >= 0
 *  Returns: status. */
mor_status mor_context_name_particle(mor_context *context, mor_status status, const char *set, int64_t particle);

/** Records which of the items that the failed function was given the last error concerns.
 *  @param status   [in]      code of the error
 *  @param item     [in]      its index, >= 0
 *  Returns: status. */
mor_status mor_context_name_item(mor_context *context, mor_status status, int item);

/** Adds a frame to the call chain of the last error and returns status.
 *  @param status  [in]      the code being passed on
 *  @param place   [in]      where it passes
 *  Returns: status, whatever it is. */
mor_status mor_context_pass(mor_context *context, mor_status status, const mor_frame *place);

/** Sends one line to the log sink.
 *  @param level   [in]  severity
 *  @param format  [in]  printf format, then its arguments; zero-terminated */
void mor_context_log(mor_context *context, mor_log_level level, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#define MOR_HERE (&(const mor_frame){__FILE__, __func__, __LINE__})

/** Records an error: MOR_FAIL(context, MOR_ERROR_IO, "format", ...) has the value of the code. */
#define MOR_FAIL(context, code, ...) mor_context_fail((context), (code), MOR_HERE, __VA_ARGS__)

/** Returns the code of a failing call from the calling function, after adding a frame. Only for functions that own
 *  nothing; owners test the status and go to their out: label. */
#define MOR_TRY(context, call)                                                                                         \
    do {                                                                                                               \
        mor_status mor_try_status_ = (call);                                                                           \
        if (mor_try_status_ != MOR_OK) {                                                                               \
            return mor_context_pass((context), mor_try_status_, MOR_HERE);                                             \
        }                                                                                                              \
    } while (0)

/** Creates an error and returns it unless the condition holds. Always compiled. */
#define MOR_CHECK(context, condition, code, ...)                                                                       \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            return mor_context_fail((context), (code), MOR_HERE, __VA_ARGS__);                                         \
        }                                                                                                              \
    } while (0)

#endif
