/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The case of a run: kept in its folder and in its checkpoints, and compared when the run goes on. */
#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/case/write/case_write.h"
#include "cases/driver/run/run_files.h"
#include "core/base/memory.h"

#include <stdlib.h>
#include <string.h>

static mor_status format_case(mor_context *context, mor_run_files *files, const mor_registry *registry)
{
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&files->case_text, &n_bytes);
    MOR_CHECK(context, stream != NULL, MOR_ERROR_MEMORY, "no memory to print the case");
    const mor_status status = mor_case_write_stream(context, files->the_case, registry, stream);
    const int is_bad = fclose(stream);
    if (status != MOR_OK || is_bad != 0) { /* what is cut off is no case to compare with */
        free(files->case_text);
        files->case_text = NULL;
    }
    MOR_CHECK(context, status != MOR_OK || is_bad == 0, MOR_ERROR_MEMORY, "no memory to print the case");
    return status;
}

/* The content of a file, zero-terminated, "" when it cannot be read; freed with MOR_FREE. */
static mor_status load_text(mor_context *context, const char *path, char **text)
{
    FILE *file = fopen(path, "rb");
    long n_bytes = 0;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0) {
        n_bytes = ftell(file);
        rewind(file);
    }
    const mor_status status = MOR_NEW(context, text, (n_bytes > 0 ? n_bytes : 0) + 1, "the case of a run");
    if (status == MOR_OK && n_bytes > 0 && fread(*text, 1, (size_t)n_bytes, file) != (size_t)n_bytes) {
        (*text)[0] = '\0';
    }
    if (file != NULL) {
        fclose(file);
    }
    return status;
}

static mor_status store_case(mor_context *context, const mor_run_files *files, const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    fputs(files->case_text, file.stream);
    return mor_durable_file_commit(context, &file);
}

/* The case the folder was started with: that of the checkpoint the run goes on from. A folder without a checkpoint has
 * at most its case file. */
static mor_status find_saved(mor_context *context, mor_run_files *files, const char *path)
{
    const char *folder = files->options->folder;
    if (!mor_run_folder_has_checkpoint(context, folder)) {
        return load_text(context, path, &files->saved_text);
    }
    MOR_TRY(context, mor_checkpoint_read_identity(context, folder, &files->saved_text));
    MOR_CHECK(context, files->saved_text[0] != '\0', MOR_ERROR_CONFIG,
              "the checkpoint in '%s' does not say which case it belongs to; start a new run in another folder",
              folder);
    return MOR_OK;
}

mor_status mor_run_files_keep_case(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                   bool is_resume)
{
    char path[MOR_PATH_BYTES];
    mor_case_difference first;
    const char *folder = files->options->folder;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_CASE_FILE));
    if (files->case_text == NULL) {
        MOR_TRY(context, format_case(context, files, registry));
    }
    if (!is_resume) {
        return store_case(context, files, path);
    }
    MOR_FREE(context, &files->saved_text);
    MOR_TRY(context, find_saved(context, files, path));
    if (files->saved_text[0] == '\0') {
        return store_case(context, files, path);
    }
    mor_case_compare(files->the_case->probe_types, files->case_text, files->saved_text, &first);
    MOR_CHECK(context, !first.is_found, MOR_ERROR_CONFIG,
              "the case '%s' with its overrides is not the one that '%s' was started with; first difference: %s, was "
              "%s%s; resume with the same case and values, or start a new run in another folder",
              files->the_case->path, folder, first.found, first.expected, first.reason);
    return MOR_OK;
}

mor_status mor_run_files_hash_case(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                   uint64_t *hash)
{
    *hash = 0;
    if (files->case_text == NULL) {
        MOR_TRY(context, format_case(context, files, registry));
    }
    *hash = mor_case_compare_hash(files->case_text);
    return MOR_OK;
}

mor_status mor_run_files_hash_folder(mor_context *context, const char *folder, uint64_t *hash)
{
    char path[MOR_PATH_BYTES];
    char *text = NULL;
    *hash = 0;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_CASE_FILE));
    MOR_TRY(context, load_text(context, path, &text));
    *hash = text[0] != '\0' ? mor_case_compare_hash(text) : 0;
    MOR_FREE(context, &text);
    return MOR_OK;
}

mor_status mor_run_files_compare_folder(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                        const char *folder, mor_case_difference *difference)
{
    char path[MOR_PATH_BYTES];
    char *text = NULL;
    *difference = (mor_case_difference){.is_found = false, .reason = ""};
    if (files->case_text == NULL) {
        MOR_TRY(context, format_case(context, files, registry));
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_CASE_FILE));
    MOR_TRY(context, load_text(context, path, &text));
    if (text[0] != '\0') {
        mor_case_compare_whole(files->case_text, text, difference);
    }
    MOR_FREE(context, &text);
    return MOR_OK;
}

mor_status mor_run_files_renew_case(mor_context *context, mor_run_files *files)
{
    char path[MOR_PATH_BYTES];
    char *text = NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, files->options->folder, MOR_RUN_CASE_FILE));
    MOR_TRY(context, load_text(context, path, &text));
    const bool is_same = strcmp(text, files->case_text) == 0;
    if (!is_same) {
        mor_context_log(context, MOR_LOG_INFO, "%s is %s", path,
                        text[0] == '\0' ? "missing; it is written anew" : "written anew for the case as it goes on");
    }
    MOR_FREE(context, &text);
    return is_same ? MOR_OK : store_case(context, files, path);
}
