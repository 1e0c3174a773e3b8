/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The files that a mesh consists of: a glTF file may keep its corners in others, which count as its content. */
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "relaxation/mesh/mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { WORD_BYTES = 4096, GLB_HEAD_BYTES = 20, OBJECT_DEPTH = 1, BUFFER_DEPTH = 3 };

/* What is hashed: the mesh file, then the buffers it names. */
typedef struct content {
    mor_context *context;
    const char *path;
    mor_hash hash;
    int n_buffers; /* in files of their own */
} content;

static void add_file(content *it, uint64_t hash)
{
    unsigned char bytes[sizeof hash];
    for (size_t k = 0; k < sizeof hash; ++k) {
        bytes[k] = (unsigned char)(hash >> (8 * k));
    }
    mor_hash_add(&it->hash, bytes, sizeof bytes);
}

static int read_hex(const char *digits, int n)
{
    int value = 0;
    for (int k = 0; k < n; ++k) {
        const char *all = "0123456789abcdef";
        const char *found =
            digits[k] == '\0' ? NULL : strchr(all, digits[k] | ('A' <= digits[k] && digits[k] <= 'F' ? 32 : 0));
        if (found == NULL) {
            return -1;
        }
        value = 16 * value + (int)(found - all);
    }
    return value;
}

/* A relative reference as a path: %20 is a blank. */
static void decode_reference(char *word)
{
    char *out = word;
    for (const char *in = word; *in != '\0';) {
        const int value = *in == '%' ? read_hex(in + 1, 2) : -1;
        *out++ = value > 0 ? (char)value : *in;
        in += value > 0 ? 3 : 1;
    }
    *out = '\0';
}

static mor_status add_buffer(content *it, char *reference)
{
    char path[2 * WORD_BYTES];
    struct stat about;
    uint64_t hash = 0;
    if (strncmp(reference, "data:", strlen("data:")) == 0) {
        return MOR_OK;
    }
    decode_reference(reference);
    const char *slash = strrchr(it->path, '/');
    snprintf(path, sizeof path, "%.*s%s", slash == NULL ? 0 : (int)(slash + 1 - it->path), it->path, reference);
    /* A device or a pipe may never end. */
    MOR_CHECK(
        it->context, stat(path, &about) == 0 && S_ISREG(about.st_mode), MOR_ERROR_IO,
        "%s: found a buffer in the file '%s', which is missing or no file; put it there, or save the mesh as .glb, "
        "which is whole in one file",
        it->path, path);
    MOR_TRY(it->context, mor_hash_file(it->context, path, &hash));
    add_file(it, hash);
    it->n_buffers += 1;
    return MOR_OK;
}

/* Writes a character of the basic plane in UTF-8; returns its bytes. */
static size_t put_code(unsigned code, char *out)
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        out[0] = (char)(0xc0 | code >> 6);
        out[1] = (char)(0x80 | (code & 0x3f));
        return 2;
    }
    out[0] = (char)(0xe0 | code >> 12);
    out[1] = (char)(0x80 | (code >> 6 & 0x3f));
    out[2] = (char)(0x80 | (code & 0x3f));
    return 3;
}

/* Reads a text of JSON in quotes; returns what follows it. What does not fit is truncated. */
static const char *read_word(const char *at, const char *end, char *word)
{
    size_t n = 0;
    for (++at; at < end && *at != '"'; ++at) {
        const bool is_escape = *at == '\\' && at + 1 < end;
        const int code = is_escape && at[1] == 'u' && end - at > 6 ? read_hex(at + 2, 4) : -1;
        at += code >= 0 ? 5 : is_escape ? 1 : 0;
        if (n + 4 < WORD_BYTES) {
            word[n] = *at;
            n += code >= 0 ? put_code((unsigned)code, word + n) : 1;
        }
    }
    word[n] = '\0';
    return at < end ? at + 1 : end;
}

static const char *skip_blanks(const char *at, const char *end)
{
    while (at < end && strchr(" \t\r\n", *at) != NULL && *at != '\0') {
        ++at;
    }
    return at;
}

/* Visits every value of buffers[...].uri. What is no JSON is refused by the mesh reader. */
static mor_status visit_buffers(content *it, const char *at, const char *end)
{
    char word[WORD_BYTES];
    bool is_in_buffers = false;
    bool is_reference = false;
    int depth = 0;
    while (at < end) {
        if (*at != '"') {
            depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
            is_reference = is_reference && *at != ',';
            ++at;
            continue;
        }
        at = skip_blanks(read_word(at, end, word), end);
        const bool is_key = at < end && *at == ':';
        if (is_key && depth == OBJECT_DEPTH) {
            is_in_buffers = strcmp(word, "buffers") == 0;
        } else if (is_key) {
            is_reference = depth == BUFFER_DEPTH && is_in_buffers && strcmp(word, "uri") == 0;
        } else if (is_reference && depth == BUFFER_DEPTH) {
            MOR_TRY(it->context, add_buffer(it, word));
            is_reference = false;
        }
    }
    return MOR_OK;
}

static uint32_t read_size(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The JSON of a glTF file, or of the first chunk of a GLB file; NULL with 0 bytes where there is none. */
static mor_status load_json(mor_context *context, const char *path, bool is_binary, char **text, int64_t *n_bytes)
{
    FILE *file = fopen(path, "rb");
    char head[GLB_HEAD_BYTES] = "";
    struct stat about;
    *n_bytes = 0;
    MOR_CHECK(context, file != NULL && fstat(fileno(file), &about) == 0, MOR_ERROR_IO, "cannot read '%s'", path);
    int64_t n = about.st_size;
    if (is_binary) {
        const bool has_head = fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, "glTF", 4) == 0;
        const int64_t n_left = n - GLB_HEAD_BYTES;
        n = has_head ? read_size(head + 12) : 0;
        n = n < n_left ? n : n_left > 0 ? n_left : 0;
    }
    mor_status status = MOR_NEW(context, text, n, "the description of a mesh");
    if (status == MOR_OK && n > 0) {
        *n_bytes = (int64_t)fread(*text, 1, (size_t)n, file);
    }
    fclose(file);
    return status;
}

mor_status mor_mesh_hash(mor_context *context, const char *path, uint64_t *hash)
{
    const char *ending = strrchr(path, '.');
    const bool is_binary = ending != NULL && strcasecmp(ending, ".glb") == 0;
    content it = {.context = context, .path = path};
    char *text = NULL;
    int64_t n_bytes = 0;
    MOR_TRY(context, mor_hash_file(context, path, hash));
    if (!is_binary && (ending == NULL || strcasecmp(ending, ".gltf") != 0)) {
        return MOR_OK;
    }
    mor_hash_init(&it.hash);
    add_file(&it, *hash);
    mor_status status = load_json(context, path, is_binary, &text, &n_bytes);
    if (status == MOR_OK && n_bytes > 0) {
        status = visit_buffers(&it, text, text + n_bytes);
    }
    MOR_FREE(context, &text);
    *hash = it.n_buffers > 0 ? mor_hash_value(&it.hash) : *hash;
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
