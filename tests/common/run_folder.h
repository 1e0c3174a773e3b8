/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_RUN_FOLDER_H
#define MOR_TESTS_COMMON_RUN_FOLDER_H

#include "core/io/durable_file.h"

#include <ftw.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/** @file
 *  A scratch folder per test, whole files in memory, and a log that keeps its last line. For tests of files only. */

/** What a test of files works with. */
typedef struct run_folder {
    mor_context context;
    char path[MOR_PATH_BYTES];           /* the scratch folder */
    char log[MOR_CONTEXT_MESSAGE_BYTES]; /* last logged line */
    int n_logged;
} run_folder;

static inline void run_folder_log(void *user, mor_log_level level, const char *text)
{
    run_folder *folder = user;
    (void)level;
    folder->n_logged += 1;
    strncpy(folder->log, text, sizeof folder->log - 1);
}

/** cmocka set-up: makes the folder and a context that logs into it. state receives one run_folder. */
static inline int run_folder_setup(void **state)
{
    run_folder *folder = calloc(1, sizeof *folder);
    assert_non_null(folder);
    const char *parent = getenv("TMPDIR");
    snprintf(folder->path, sizeof folder->path, "%s/moraine_XXXXXX", parent == NULL ? "/tmp" : parent);
    assert_non_null(mkdtemp(folder->path));
    mor_context_init(&folder->context);
    folder->context.log_sink = run_folder_log;
    folder->context.log_user = folder;
    *state = folder;
    return 0;
}

static inline int run_folder_delete(const char *path, const struct stat *status, int type, struct FTW *place)
{
    (void)status;
    (void)type;
    (void)place;
    return remove(path);
}

/** cmocka tear-down: deletes the folder; fails when a test left memory behind. state holds one run_folder. */
static inline int run_folder_teardown(void **state)
{
    run_folder *folder = *state;
    const size_t n_bytes_left = folder->context.memory_bytes;
    nftw(folder->path, run_folder_delete, 16, FTW_DEPTH | FTW_PHYS);
    free(folder);
    return n_bytes_left == 0 ? 0 : -1;
}

/** Puts the path of a file in the folder into path, shape [MOR_PATH_BYTES], and returns it; name is zero-terminated. */
static inline const char *run_folder_file(run_folder *folder, char *path, const char *name)
{
    assert_int_equal(mor_durable_file_join(&folder->context, path, folder->path, name), MOR_OK);
    return path;
}

/** Reads a whole file; the caller frees the bytes, shape [*n_bytes], behind which stands a zero. NULL when missing. */
static inline unsigned char *run_folder_load(const char *path, size_t *n_bytes)
{
    *n_bytes = 0;
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return NULL;
    }
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *n_bytes = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = calloc(*n_bytes + 1, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *n_bytes, file), *n_bytes);
    fclose(file);
    return bytes;
}

/** Makes a file of these bytes, shape [n_bytes]. */
static inline void run_folder_store(const char *path, const void *bytes, size_t n_bytes)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, n_bytes, file), n_bytes);
    assert_int_equal(fclose(file), 0);
}

#endif
