/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/seal.h"

#include "core/base/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { READ_BLOCK_BYTES = 65536 };

/* Contents of a seal. */
typedef struct seal {
    char what[MOR_SEAL_WHAT_BYTES];
    int version;
    uint64_t n_bytes;
    uint64_t content_hash;
} seal;

static void render_seal(const seal *says, char *text)
{
    memset(text, 0, MOR_SEAL_BYTES);
    char hash[MOR_HASH_TEXT_BYTES];
    mor_hash_format(says->content_hash, hash);
    const int n_bytes = snprintf(text, MOR_SEAL_BYTES, "moraine %s %d\nbytes %020" PRIu64 "\nxxh64 %s\n", says->what,
                                 says->version, says->n_bytes, hash);
    mor_hash_format(mor_hash_bytes(text, (size_t)n_bytes), hash);
    snprintf(text + n_bytes, MOR_SEAL_BYTES - (size_t)n_bytes, "seal %s\n", hash);
}

/* Accepts only what render_seal makes. */
static int parse_seal(const char *text, seal *says)
{
    char ended[MOR_SEAL_BYTES + 1];
    memcpy(ended, text, MOR_SEAL_BYTES);
    ended[MOR_SEAL_BYTES] = '\0';
    memset(says, 0, sizeof *says);
    if (sscanf(ended, "moraine %47s %9d bytes %20" SCNu64 " xxh64 %16" SCNx64, says->what, &says->version,
               &says->n_bytes, &says->content_hash) != 4) {
        return 0;
    }
    char again[MOR_SEAL_BYTES];
    render_seal(says, again);
    return memcmp(again, text, MOR_SEAL_BYTES) == 0;
}

/* Reads up to n_bytes; returns how many there were, -1 on an error. */
static ssize_t read_block(int descriptor, void *block, size_t n_bytes)
{
    size_t n_done = 0;
    while (n_done < n_bytes) {
        const ssize_t n_now = read(descriptor, (char *)block + n_done, n_bytes - n_done);
        if (n_now < 0 && errno == EINTR) {
            continue;
        }
        if (n_now < 0) {
            return -1;
        }
        if (n_now == 0) {
            break;
        }
        n_done += (size_t)n_now;
    }
    return (ssize_t)n_done;
}

/* Hashes all bytes after the seal and counts all bytes of the file. */
static mor_status hash_content(mor_context *context, int descriptor, const char *path, uint64_t *hash_value,
                               uint64_t *n_bytes)
{
    MOR_CHECK(context, lseek(descriptor, MOR_SEAL_BYTES, SEEK_SET) == MOR_SEAL_BYTES, MOR_ERROR_IO,
              "cannot read '%s': %s", path, strerror(errno));
    mor_hash hash;
    mor_hash_init(&hash);
    unsigned char block[READ_BLOCK_BYTES];
    ssize_t n_read = 0;
    while ((n_read = read_block(descriptor, block, sizeof block)) > 0) {
        mor_hash_add(&hash, block, (size_t)n_read);
    }
    MOR_CHECK(context, n_read == 0, MOR_ERROR_IO, "cannot read '%s': %s", path, strerror(errno));
    *hash_value = mor_hash_value(&hash);
    *n_bytes = hash.n_bytes + MOR_SEAL_BYTES;
    return MOR_OK;
}

/* Returns 0, or the error number of what failed. */
static int write_all(int descriptor, const char *bytes, size_t n_bytes)
{
    while (n_bytes > 0) {
        const ssize_t n_now = write(descriptor, bytes, n_bytes);
        if (n_now < 0 && errno != EINTR) {
            return errno;
        }
        if (n_now > 0) {
            bytes += n_now;
            n_bytes -= (size_t)n_now;
        }
    }
    return fsync(descriptor) != 0 ? errno : 0;
}

mor_status mor_seal_write(mor_context *context, const char *path, const char *what, int version, void *bytes,
                          size_t n_bytes)
{
    seal says = {.version = version, .n_bytes = n_bytes};
    snprintf(says.what, sizeof says.what, "%s", what);
    says.content_hash = mor_hash_bytes((char *)bytes + MOR_SEAL_BYTES, n_bytes - MOR_SEAL_BYTES);
    render_seal(&says, bytes);
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    MOR_CHECK(context, descriptor >= 0, MOR_ERROR_IO,
              "cannot make '%s': %s; check that the folder exists and may be written", path, strerror(errno));
    int error = write_all(descriptor, bytes, n_bytes);
    if (close(descriptor) != 0 && error == 0) {
        error = errno;
    }
    if (error != 0) {
        unlink(path);
        return MOR_FAIL(context, MOR_ERROR_IO, "cannot write '%s' to the disk: %s; check the free space", path,
                        strerror(error));
    }
    return MOR_OK;
}

static mor_status verify_seal(mor_context *context, int descriptor, const char *path, seal *says)
{
    char text[MOR_SEAL_BYTES];
    const ssize_t n_read = read_block(descriptor, text, sizeof text);
    MOR_CHECK(context, n_read >= 0, MOR_ERROR_IO, "cannot read '%s': %s", path, strerror(errno));
    MOR_CHECK(context, n_read == MOR_SEAL_BYTES, MOR_ERROR_IO,
              "'%s' is damaged: it ends after %lld bytes, within its header of %d bytes", path, (long long)n_read,
              MOR_SEAL_BYTES);
    MOR_CHECK(context, memcmp(text, "moraine ", 8) == 0, MOR_ERROR_IO,
              "'%s' is damaged or was not written by Moraine: it does not begin with the word moraine", path);
    MOR_CHECK(context, parse_seal(text, says), MOR_ERROR_IO,
              "'%s' is damaged: the header in its first %d bytes is inconsistent", path, MOR_SEAL_BYTES);
    struct stat properties;
    MOR_CHECK(context, fstat(descriptor, &properties) == 0, MOR_ERROR_IO, "cannot read '%s': %s", path,
              strerror(errno));
    MOR_CHECK(context, (uint64_t)properties.st_size == says->n_bytes, MOR_ERROR_IO,
              "'%s' is damaged: it has %lld bytes, its header states %llu", path, (long long)properties.st_size,
              (unsigned long long)says->n_bytes);
    return MOR_OK;
}

static mor_status verify_content(mor_context *context, int descriptor, const char *path, const seal *says)
{
    uint64_t content_hash = 0;
    uint64_t n_bytes = 0;
    MOR_TRY(context, hash_content(context, descriptor, path, &content_hash, &n_bytes));
    MOR_CHECK(context, content_hash == says->content_hash && n_bytes == says->n_bytes, MOR_ERROR_IO,
              "'%s' is damaged: the hash of its content is %016" PRIx64 ", its header states %016" PRIx64, path,
              content_hash, says->content_hash);
    return MOR_OK;
}

mor_status mor_seal_verify(mor_context *context, const char *path, const char *what, int version, mor_seal_check check)
{
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    MOR_CHECK(context, descriptor >= 0, MOR_ERROR_IO, "cannot open '%s': %s", path, strerror(errno));
    seal says;
    mor_status status = verify_seal(context, descriptor, path, &says);
    if (status == MOR_OK && check == MOR_SEAL_CHECK_ALL) {
        status = verify_content(context, descriptor, path, &says);
    }
    close(descriptor);
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    MOR_CHECK(context, strcmp(says.what, what) == 0, MOR_ERROR_IO, "'%s' holds a %s, not a %s", path, says.what, what);
    MOR_CHECK(context, says.version == version, MOR_ERROR_UNSUPPORTED,
              "'%s' is a %s of version %d, this program understands version %d only; use the program that wrote it",
              path, what, says.version, version);
    return MOR_OK;
}
