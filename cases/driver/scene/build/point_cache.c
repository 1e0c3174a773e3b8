/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/point_cache.h"

#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/io/seal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Number of the layout: to be raised with any change of point_record. */
enum { LAYOUT = 1 };

static const char file_kind[] = "relaxed-points";

/* Behind the seal of a file; the positions follow. */
typedef struct point_record {
    uint64_t hash;
    int64_t n_points;
    double volume;
    double residual;
    int64_t n_steps;
    int64_t is_converged;
} point_record;

static size_t file_bytes(int64_t n_points)
{
    return MOR_SEAL_BYTES + sizeof(point_record) + (size_t)(3 * n_points) * sizeof(double);
}

void mor_point_cache_init(mor_point_cache *cache, const char *folder)
{
    memset(cache, 0, sizeof *cache);
    if (folder != NULL && strlen(folder) < sizeof cache->folder) {
        snprintf(cache->folder, sizeof cache->folder, "%s", folder);
    }
}

void mor_point_cache_clear(mor_context *context, mor_point_cache *cache)
{
    while (cache->first != NULL) {
        mor_point_cache_entry *entry = cache->first;
        cache->first = entry->next;
        mor_relax_clear(context, &entry->points);
        MOR_FREE(context, &entry);
    }
    memset(cache, 0, sizeof *cache);
}

static mor_status name_file(mor_context *context, const mor_point_cache *cache, uint64_t hash, char *path)
{
    char digits[MOR_HASH_TEXT_BYTES];
    char name[64];
    mor_hash_format(hash, digits);
    snprintf(name, sizeof name, "particles-%s", digits);
    return mor_durable_file_join(context, path, cache->folder, name);
}

/* Reads what lies behind the seal of a file that was found intact. */
static mor_status read_content(mor_context *context, const char *path, uint64_t hash, mor_relax_points *points)
{
    point_record record;
    struct stat about;
    FILE *file = fopen(path, "rb");
    MOR_CHECK(context, file != NULL, MOR_ERROR_IO, "'%s' cannot be opened", path);
    mor_status status = MOR_OK;
    if (fstat(fileno(file), &about) != 0 || fseek(file, MOR_SEAL_BYTES, SEEK_SET) != 0 ||
        fread(&record, sizeof record, 1, file) != 1 || record.hash != hash || record.n_points <= 0 ||
        record.n_points > (int64_t)about.st_size || file_bytes(record.n_points) != (size_t)about.st_size) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "'%s' does not hold what its name says", path);
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &points->positions, 3 * record.n_points, "relaxed positions");
    }
    if (status == MOR_OK) {
        const size_t n = (size_t)(3 * record.n_points);
        points->n_points = record.n_points;
        points->volume = record.volume;
        points->residual = record.residual;
        points->n_steps = (int)record.n_steps;
        points->is_converged = record.is_converged != 0;
        if (fread(points->positions, sizeof *points->positions, n, file) != n) {
            status = MOR_FAIL(context, MOR_ERROR_IO, "'%s' ends too early", path);
        }
    }
    fclose(file);
    if (status != MOR_OK) {
        mor_relax_clear(context, points);
    }
    return status;
}

/* Returns whether the particles could be taken from a file. A file that cannot be used is no failure of the run. */
static bool read_points(mor_context *context, const mor_point_cache *cache, uint64_t hash, mor_relax_points *points)
{
    char path[MOR_PATH_BYTES];
    memset(points, 0, sizeof *points);
    mor_status status = name_file(context, cache, hash, path);
    if (status == MOR_OK && access(path, F_OK) != 0) {
        return false;
    }
    if (status == MOR_OK) {
        status = mor_seal_verify(context, path, file_kind, LAYOUT, MOR_SEAL_CHECK_ALL);
    }
    if (status == MOR_OK) {
        status = read_content(context, path, hash, points);
    }
    if (status != MOR_OK) {
        mor_context_log(context, MOR_LOG_WARNING, "kept particles cannot be used and are found anew: %s",
                        context->message);
        mor_context_clear_error(context);
        return false;
    }
    return true;
}

/* Makes the folder, and the one it lies in. */
static mor_status make_folder(mor_context *context, mor_point_cache *cache)
{
    char parent[MOR_PATH_BYTES];
    snprintf(parent, sizeof parent, "%s", cache->folder);
    char *slash = strrchr(parent, '/');
    if (slash != NULL && slash != parent) {
        *slash = '\0';
        MOR_TRY(context, mor_durable_file_make_folder(context, parent));
    }
    MOR_TRY(context, mor_durable_file_make_folder(context, cache->folder));
    cache->is_folder_made = true;
    return MOR_OK;
}

/* Two runs, of one process or of two, may find the same particles at the same time: each writes to a name of its own
 * first. */
static mor_status write_file(mor_context *context, const mor_point_cache *cache, uint64_t hash,
                             const mor_relax_points *points)
{
    char path[MOR_PATH_BYTES];
    char temporary[MOR_PATH_BYTES];
    unsigned char *bytes = NULL;
    const point_record record = {
        hash, points->n_points, points->volume, points->residual, points->n_steps, points->is_converged};
    const size_t n_bytes = file_bytes(points->n_points);
    MOR_TRY(context, name_file(context, cache, hash, path));
    const int length = snprintf(temporary, sizeof temporary, "%s.%ld.tmp", path, (long)gettid());
    MOR_CHECK(context, length > 0 && (size_t)length < sizeof temporary, MOR_ERROR_IO, "the path '%s' is too long",
              path);
    MOR_TRY(context, MOR_NEW(context, &bytes, (int64_t)n_bytes, "file of relaxed positions"));
    memcpy(bytes + MOR_SEAL_BYTES, &record, sizeof record);
    memcpy(bytes + MOR_SEAL_BYTES + sizeof record, points->positions,
           (size_t)(3 * points->n_points) * sizeof *points->positions);
    mor_status status = mor_seal_write(context, temporary, file_kind, LAYOUT, bytes, n_bytes);
    if (status == MOR_OK) {
        status = mor_durable_file_replace(context, temporary, path);
    }
    MOR_FREE(context, &bytes);
    return status;
}

/* A folder that cannot be written is no failure of the run; it is not tried again. */
static void write_points(mor_context *context, mor_point_cache *cache, uint64_t hash, const mor_relax_points *points)
{
    mor_status status = cache->is_folder_made ? MOR_OK : make_folder(context, cache);
    if (status == MOR_OK) {
        status = write_file(context, cache, hash, points);
    }
    if (status != MOR_OK) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "relaxed particles cannot be kept for the next run: %s; "
                        "keep them in another folder, or nowhere",
                        context->message);
        mor_context_clear_error(context);
        cache->folder[0] = '\0';
    }
}

static mor_status find_points(mor_context *context, mor_point_cache *cache, const mor_relax_request *request,
                              uint64_t hash, mor_relax_points *points)
{
    if (cache->folder[0] != '\0' && read_points(context, cache, hash, points)) {
        cache->n_read += 1;
        mor_context_log(context, MOR_LOG_INFO, "%lld relaxed particles of a shape (%s) taken from %s",
                        (long long)points->n_points, request->shape->operations->kind, cache->folder);
        return MOR_OK;
    }
    MOR_TRY(context, mor_relax(context, request, points));
    cache->n_found += 1;
    mor_context_log(context, MOR_LOG_INFO, "%lld particles of a shape (%s) relaxed in %d steps to %.2g spacings",
                    (long long)points->n_points, request->shape->operations->kind, points->n_steps, points->residual);
    if (cache->folder[0] != '\0') {
        write_points(context, cache, hash, points);
    }
    return MOR_OK;
}

mor_status mor_point_cache_relax(mor_context *context, mor_point_cache *cache, const mor_relax_request *request,
                                 mor_relax_points *points)
{
    uint64_t hash = 0;
    mor_point_cache_entry *entry = NULL;
    memset(points, 0, sizeof *points);
    MOR_CHECK(context, request->shape != NULL, MOR_ERROR_ARGUMENT, "there is no shape to fill: give one");
    mor_relax_request_hash(request, &hash);
    for (entry = cache->first; entry != NULL; entry = entry->next) {
        if (entry->hash == hash) {
            cache->n_shared += 1;
            *points = entry->points;
            return MOR_OK;
        }
    }
    MOR_TRY(context, MOR_NEW(context, &entry, 1, "kept particles"));
    const mor_status status = find_points(context, cache, request, hash, &entry->points);
    if (status != MOR_OK) {
        MOR_FREE(context, &entry);
        return status;
    }
    entry->hash = hash;
    entry->next = cache->first;
    cache->first = entry;
    *points = entry->points;
    return MOR_OK;
}
