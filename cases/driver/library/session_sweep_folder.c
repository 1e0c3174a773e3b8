/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The folder of a sweep: whose it is, and which members have ended. */
#include "cases/driver/library/session_sweep_internal.h"

#include "core/base/memory.h"

#include <stdlib.h>
#include <string.h>

#define DESIGN_FILE "design.txt"
#define DONE_FILE "done.txt"

static mor_status make_folders(mor_session_sweeper *it)
{
    static const char *const names[] = {"members", "images"};
    mor_context *context = &it->session->context;
    char path[MOR_PATH_BYTES];
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        MOR_TRY(context, mor_durable_file_join(context, path, it->folder, names[k]));
        MOR_TRY(context, mor_run_folder_make(context, path));
    }
    return MOR_OK;
}

static mor_status refuse_sweep(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    MOR_TRY(context, mor_run_folder_refuse_run(context, it->folder, "choose another folder for the sweep"));
    MOR_CHECK(context, it->is_resume || !mor_run_folder_has(context, it->folder, DESIGN_FILE), MOR_ERROR_CONFIG,
              "the folder '%s' already holds a sweep; resume it, or choose another folder", it->folder);
    return MOR_OK;
}

static mor_status keep_design(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, it->folder, DESIGN_FILE));
    if (mor_run_folder_has(context, it->folder, DESIGN_FILE)) {
        return mor_session_sweep_compare(it, path);
    }
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    mor_sweep_write_design(&it->design, &it->provenance, it->case_hashes, file.stream);
    return mor_durable_file_commit(context, &file);
}

/* ---- Members that have ended ------------------------------------------------------------------------------------- */

/* A last line without its end, which a killed program leaves, is none. */
static void read_done(mor_session_sweeper *it, const char *path)
{
    char line[32];
    FILE *file = fopen(path, "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const int member = atoi(line);
        if (strchr(line, '\n') != NULL && member >= 1 && member <= it->design.n_members) {
            it->is_done[member - 1] = true;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

/* The list is written anew, whole, and then grows. */
static mor_status open_done(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_join(context, path, it->folder, DONE_FILE));
    read_done(it, path);
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    for (int m = 0; m < it->design.n_members; ++m) {
        if (it->is_done[m]) {
            fprintf(file.stream, "%d\n", m + 1);
        }
    }
    MOR_TRY(context, mor_durable_file_commit(context, &file));
    it->done = fopen(path, "a");
    MOR_CHECK(context, it->done != NULL, MOR_ERROR_IO, "'%s' cannot be written; check the folder's permissions", path);
    return MOR_OK;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

mor_status mor_session_sweep_open(mor_session_sweeper *it)
{
    mor_context *context = &it->session->context;
    MOR_TRY(context, refuse_sweep(it)); /* before anything is made in the folder of another run */
    MOR_TRY(context, make_folders(it));
    MOR_TRY(context, mor_run_folder_lock(context, it->folder, &it->log));
    MOR_TRY(context, refuse_sweep(it)); /* again: another sweep may have been there until now */
    fprintf(it->log, "moraine %s, commit %s: %s\n", it->provenance.version, it->provenance.commit,
            it->provenance.command);
    MOR_TRY(context, keep_design(it));
    return open_done(it);
}

void mor_session_sweep_close(mor_session_sweeper *it)
{
    if (it->done != NULL) {
        fclose(it->done);
        it->done = NULL;
    }
    mor_run_folder_unlock(&it->log);
}
