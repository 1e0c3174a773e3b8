/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_folder.h"

#include "core/io/checkpoint.h"
#include "core/io/durable_file.h"
#include "core/io/summary/summary.h"

#include <fcntl.h>
#include <string.h>
#include <unistd.h>

bool mor_run_folder_has(mor_context *context, const char *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    return mor_durable_file_join(context, path, folder, name) == MOR_OK && access(path, F_OK) == 0;
}

bool mor_run_folder_has_checkpoint(mor_context *context, const char *folder)
{
    return mor_run_folder_has(context, folder, MOR_CHECKPOINT_FILE) ||
           mor_run_folder_has(context, folder, MOR_CHECKPOINT_PREVIOUS_FILE);
}

/* The user chose the folder, so it is the user's input that is refused. */
static mor_status make_folder(mor_context *context, const char *path)
{
    const mor_status status = mor_durable_file_make_folder(context, path);
    return status != MOR_ERROR_IO ? status
                                  : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s; choose another folder", context->message);
}

mor_status mor_run_folder_make(mor_context *context, const char *path)
{
    char part[MOR_PATH_BYTES];
    MOR_CHECK(context, strlen(path) < sizeof part, MOR_ERROR_CONFIG, "the name of the run's folder is too long: %s",
              path);
    strcpy(part, path);
    for (char *slash = strchr(part + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        MOR_TRY(context, make_folder(context, part));
        *slash = '/';
    }
    return make_folder(context, part);
}

mor_status mor_run_folder_refuse_run(mor_context *context, const char *folder, const char *advice)
{
    const bool holds_run =
        mor_run_folder_has_checkpoint(context, folder) || mor_run_folder_has(context, folder, MOR_SUMMARY_FILE);
    MOR_CHECK(context, !holds_run, MOR_ERROR_CONFIG, "the folder '%s' already holds a run; %s", folder, advice);
    return MOR_OK;
}

mor_status mor_run_folder_lock(mor_context *context, const char *folder, FILE **log)
{
    char path[MOR_PATH_BYTES];
    *log = NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_LOG_FILE));
    *log = fopen(path, "a");
    MOR_CHECK(context, *log != NULL, MOR_ERROR_IO, "'%s' cannot be written; check the folder's permissions", path);
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(*log), F_OFD_SETLK, &lock) != 0) {
        fclose(*log);
        *log = NULL;
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "another run is at work in '%s'; wait for its end, or choose another folder", folder);
    }
    return MOR_OK;
}

void mor_run_folder_unlock(FILE **log)
{
    if (*log == NULL) {
        return;
    }
    struct flock lock = {.l_type = F_UNLCK, .l_whence = SEEK_SET};
    (void)fflush(*log); /* what is not yet written belongs to the time of the lock */
    (void)fcntl(fileno(*log), F_OFD_SETLK, &lock);
    fclose(*log);
    *log = NULL;
}
