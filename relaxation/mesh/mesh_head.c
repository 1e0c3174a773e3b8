/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Checks of the start of a file before its format is read. */
#include "relaxation/mesh/mesh_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The start of a file, zero-terminated. */
typedef struct head {
    mor_context *context;
    const char *path;
    const char *text;
    int64_t n_text;  /* without the zero */
    int64_t n_bytes; /* of the whole file */
} head;

static uint32_t read_word(const char *bytes)
{
    const uint8_t *b = (const uint8_t *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t\r\n");
}

/* Whether the text starts with a word, zero-terminated, that ends there. */
static bool starts_with(const char *text, const char *word)
{
    const size_t n = strlen(word);
    return strncmp(text, word, n) == 0 && strchr(" \t\r\n", text[n]) != NULL;
}

static mor_status check_is_text(const head *it)
{
    const size_t n = strlen(it->text);
    MOR_CHECK(
        it->context, n == (size_t)it->n_text, MOR_ERROR_IO,
        "%s: found a zero byte at %lld in what should be text; the content does not match the extension of the file",
        it->path, (long long)n);
    return MOR_OK;
}

/* ---- STL --------------------------------------------------------------------------------------------------------- */

enum { HEADER_BYTES = 84, TRIANGLE_BYTES = 50 };

bool mor_mesh_is_binary_stl(const char *text, int64_t n_bytes)
{
    return n_bytes >= HEADER_BYTES &&
           n_bytes == HEADER_BYTES + TRIANGLE_BYTES * (int64_t)read_word(text + HEADER_BYTES - 4);
}

static mor_status check_stl(const head *it)
{
    if (it->n_bytes >= HEADER_BYTES) {
        const int64_t n = read_word(it->text + HEADER_BYTES - 4);
        if (mor_mesh_is_binary_stl(it->text, it->n_bytes)) {
            MOR_CHECK(it->context, n > 0, MOR_ERROR_IO, "%s: found a binary STL file of no triangles", it->path);
            return MOR_OK;
        }
        if (!starts_with(skip_blanks(it->text), "solid")) {
            return MOR_FAIL(it->context, MOR_ERROR_IO,
                            "%s: found %lld bytes that are no STL file: text would begin with 'solid', and as a binary "
                            "file they would hold %lld triangles in %lld bytes; the file may be truncated",
                            it->path, (long long)it->n_bytes, (long long)n,
                            (long long)(HEADER_BYTES + TRIANGLE_BYTES * n));
        }
    }
    MOR_TRY(it->context, check_is_text(it));
    const char *first = skip_blanks(it->text);
    MOR_CHECK(it->context, starts_with(first, "solid") && strstr(first, "facet") != NULL, MOR_ERROR_IO,
              "%s: found no 'solid' with a 'facet' at the start; this is no STL file", it->path);
    return MOR_OK;
}

/* ---- OBJ --------------------------------------------------------------------------------------------------------- */

static bool is_obj_line(const char *line)
{
    static const char *const words[] = {"v",   "vn",     "vt",     "vp",     "f",      "g",    "o",    "s",    "l",
                                        "p",   "cstype", "deg",    "curv",   "curv2",  "surf", "parm", "trim", "hole",
                                        "end", "usemtl", "mtllib", "usemap", "maplib", "mg",   "lod",  "bevel"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        if (starts_with(line, words[k])) {
            return true;
        }
    }
    return false;
}

static mor_status check_obj(const head *it)
{
    bool has_corner = false;
    MOR_TRY(it->context, check_is_text(it));
    long long number = 1;
    for (const char *line = it->text; line != NULL && *line != '\0'; ++number) {
        const char *word = line + strspn(line, " \t\r");
        const char *end = strchr(word, '\n');
        const bool is_blank = *word == '\n' || *word == '\0' || *word == '#';
        /* The last line of the head may be truncated; a line may continue after a backslash. */
        if (end == NULL && it->n_bytes > it->n_text) {
            break;
        }
        const int n_shown = (int)strcspn(word, "\r\n");
        const bool goes_on = line > it->text + 2 && (line[-2] == '\\' || (line[-2] == '\r' && line[-3] == '\\'));
        MOR_CHECK(it->context, is_blank || goes_on || is_obj_line(word), MOR_ERROR_IO,
                  "%s: found '%.*s' in line %lld, which is no keyword of an OBJ file; this is no OBJ file", it->path,
                  n_shown < 16 ? n_shown : 16, word, number);
        has_corner = has_corner || starts_with(word, "v");
        line = end != NULL ? end + 1 : NULL;
    }
    MOR_CHECK(it->context, has_corner, MOR_ERROR_IO, "%s: found no line 'v x y z' at the start; this is no OBJ file",
              it->path);
    return MOR_OK;
}

/* ---- PLY --------------------------------------------------------------------------------------------------------- */

/* The lines of the header up to end_header: counts must fit into the file. */
static mor_status check_ply(const head *it)
{
    MOR_CHECK(it->context, starts_with(it->text, "ply"), MOR_ERROR_IO,
              "%s: found no 'ply' at the start; this is no PLY file", it->path);
    const char *end = strstr(it->text, "end_header");
    MOR_CHECK(it->context, end != NULL && strstr(it->text, "\nformat ") != NULL, MOR_ERROR_IO,
              "%s: found no 'format' and 'end_header' in the first %d bytes; this is no PLY file", it->path,
              MOR_MESH_HEAD_BYTES);
    const int64_t n_body = it->n_bytes - (end - it->text);
    int64_t n_items = 0;
    for (const char *line = strstr(it->text, "\nelement "); line != NULL && line < end;
         line = strstr(line + 1, "\nelement ")) {
        char name[32] = "";
        char count[24] = "";
        char *rest = count;
        const int n_read = sscanf(line, "\nelement %31s %23s", name, count);
        const long long n = n_read == 2 ? strtoll(count, &rest, 10) : -1;
        MOR_CHECK(it->context, n >= 0 && rest > count && *rest == '\0' && n <= n_body - n_items, MOR_ERROR_IO,
                  "%s: found '%s' of element '%s' in the header, but only %lld bytes after it; "
                  "the file may be truncated",
                  it->path, count, name, (long long)n_body);
        n_items += n;
    }
    MOR_CHECK(it->context, n_items > 0, MOR_ERROR_IO, "%s: found a PLY file without elements in its header", it->path);
    return MOR_OK;
}

/* ---- glTF -------------------------------------------------------------------------------------------------------- */

static mor_status check_gltf(const head *it)
{
    const char *first = skip_blanks(it->text);
    MOR_TRY(it->context, check_is_text(it));
    MOR_CHECK(it->context, *first == '{' && (strstr(first, "\"asset\"") != NULL || it->n_bytes > it->n_text),
              MOR_ERROR_IO, "%s: found no JSON object with \"asset\"; this is no glTF file", it->path);
    return MOR_OK;
}

static mor_status check_glb(const head *it)
{
    enum { GLB_HEADER_BYTES = 20 };
    const bool has_header = it->n_bytes >= GLB_HEADER_BYTES && memcmp(it->text, "glTF", 4) == 0;
    const int64_t n_said = has_header ? read_word(it->text + 8) : 0;
    MOR_CHECK(it->context, has_header && n_said == it->n_bytes, MOR_ERROR_IO,
              "%s: found %lld bytes with a glTF header of %lld; this is no GLB file, or it is truncated", it->path,
              (long long)it->n_bytes, (long long)n_said);
    return MOR_OK;
}

mor_status mor_mesh_check_head(mor_context *context, const char *path, const char *ending, const char *text,
                               int64_t n_text, int64_t n_bytes)
{
    static const struct {
        const char *ending;
        mor_status (*check)(const head *it);
    } kinds[] = {{"stl", check_stl}, {"obj", check_obj}, {"ply", check_ply}, {"gltf", check_gltf}, {"glb", check_glb}};
    const head it = {context, path, text, n_text, n_bytes};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        if (strcmp(ending, kinds[k].ending) == 0) {
            return kinds[k].check(&it);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_IO,
                    "%s: found the extension '%s'; a mesh is read from .stl, .obj, .ply, .gltf and .glb, an "
                    "outline from .txt",
                    path, ending);
}
