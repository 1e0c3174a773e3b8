/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/durable_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define TEMPORARY_SUFFIX ".tmp"

/* A rename is on the disk only after its folder is. */
static mor_status sync_folder_of(mor_context *context, const char *path)
{
    char folder[MOR_PATH_BYTES];
    const char *slash = strrchr(path, '/');
    if (slash == NULL) {
        memcpy(folder, ".", 2);
    } else {
        const size_t n_bytes = slash == path ? 1 : (size_t)(slash - path);
        memcpy(folder, path, n_bytes);
        folder[n_bytes] = '\0';
    }
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    MOR_CHECK(context, descriptor >= 0, MOR_ERROR_IO, "cannot open folder '%s' to sync it: %s", folder,
              strerror(errno));
    /* Some network file systems have no sync of folders and say so with EINVAL. */
    const int error = fsync(descriptor) != 0 && errno != EINVAL ? errno : 0;
    close(descriptor);
    MOR_CHECK(context, error == 0, MOR_ERROR_IO, "cannot sync folder '%s': %s; check the disk", folder,
              strerror(error));
    return MOR_OK;
}

mor_status mor_durable_file_join(mor_context *context, char *path, const char *folder, const char *name)
{
    const char *separator = folder[0] == '\0' || folder[strlen(folder) - 1] == '/' ? "" : "/";
    const int n_bytes = snprintf(path, MOR_PATH_BYTES, "%s%s%s", folder, separator, name);
    MOR_CHECK(context, n_bytes >= 0 && n_bytes < MOR_PATH_BYTES, MOR_ERROR_IO,
              "the path '%.200s...' has %d bytes, at most %d are allowed; use a shorter folder name", folder, n_bytes,
              MOR_PATH_BYTES - 1);
    return MOR_OK;
}

mor_status mor_durable_file_temporary(mor_context *context, char *temporary, const char *path)
{
    const int n_bytes = snprintf(temporary, MOR_PATH_BYTES, "%s" TEMPORARY_SUFFIX, path);
    MOR_CHECK(context, n_bytes >= 0 && n_bytes < MOR_PATH_BYTES, MOR_ERROR_IO,
              "the path '%.200s...' has %d bytes, at most %d are allowed; use a shorter folder name", path, n_bytes,
              MOR_PATH_BYTES - 1);
    return MOR_OK;
}

mor_status mor_durable_file_open(mor_context *context, mor_durable_file *file, const char *path)
{
    file->stream = NULL;
    MOR_TRY(context, mor_durable_file_join(context, file->path, "", path));
    MOR_TRY(context, mor_durable_file_temporary(context, file->temporary, path));
    file->stream = fopen(file->temporary, "wb");
    MOR_CHECK(context, file->stream != NULL, MOR_ERROR_IO,
              "cannot make '%s': %s; check that the folder exists and may be written", file->temporary,
              strerror(errno));
    return MOR_OK;
}

mor_status mor_durable_file_commit(mor_context *context, mor_durable_file *file)
{
    MOR_CHECK(context, file->stream != NULL, MOR_ERROR_ARGUMENT, "a file that is not open was to be committed");
    int error = 0;
    if (ferror(file->stream) != 0) {
        /* Why an earlier write failed is not kept; one more byte of a file that is lost anyway tells. */
        error = putc(0, file->stream) == EOF || fflush(file->stream) != 0 ? errno : EIO;
    } else if (fflush(file->stream) != 0 || fsync(fileno(file->stream)) != 0) {
        error = errno;
    }
    if (fclose(file->stream) != 0 && error == 0) {
        error = errno;
    }
    file->stream = NULL;
    if (error != 0) {
        unlink(file->temporary);
        return MOR_FAIL(context, MOR_ERROR_IO, "cannot write '%s': %s; check the free space of the disk",
                        file->temporary, strerror(error));
    }
    const mor_status status = mor_durable_file_replace(context, file->temporary, file->path);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

void mor_durable_file_discard(mor_durable_file *file)
{
    if (file->stream != NULL) {
        fclose(file->stream);
        file->stream = NULL;
        unlink(file->temporary);
    }
}

mor_status mor_durable_file_replace(mor_context *context, const char *temporary, const char *path)
{
    if (rename(temporary, path) != 0) {
        const int error = errno;
        unlink(temporary);
        return MOR_FAIL(context, MOR_ERROR_IO, "cannot rename '%s' to '%s': %s", temporary, path, strerror(error));
    }
    MOR_TRY(context, sync_folder_of(context, path));
    return MOR_OK;
}

mor_status mor_durable_file_keep(mor_context *context, const char *path, const char *second)
{
    char temporary[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_temporary(context, temporary, second));
    unlink(temporary);
    if (link(path, temporary) == 0) {
        /* Renaming one link of a file to another of the same file does nothing and leaves both: drop the spare. */
        const int error = rename(temporary, second) != 0 ? errno : 0;
        unlink(temporary);
        MOR_CHECK(context, error == 0, MOR_ERROR_IO, "cannot keep '%s' as '%s': %s", path, second, strerror(error));
    } else {
        MOR_CHECK(context, rename(path, second) == 0, MOR_ERROR_IO, "cannot keep '%s' as '%s': %s", path, second,
                  strerror(errno));
    }
    MOR_TRY(context, sync_folder_of(context, second));
    return MOR_OK;
}

mor_status mor_durable_file_make_folder(mor_context *context, const char *path)
{
    if (mkdir(path, 0777) == 0) {
        MOR_TRY(context, sync_folder_of(context, path));
        return MOR_OK;
    }
    const int error = errno;
    struct stat properties;
    if (error == EEXIST && stat(path, &properties) == 0 && S_ISDIR(properties.st_mode)) {
        return MOR_OK;
    }
    const int is_refused = error == EACCES || error == EPERM || error == EROFS;
    return MOR_FAIL(context, MOR_ERROR_IO, "cannot make folder '%s': %s; %s", path, strerror(error),
                    error == EEXIST ? "a file of that name is there: give another name"
                    : is_refused    ? "the folder it would lie in may not be written: give another"
                                    : "give another name, or check the disk");
}
