/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Checks the coordinates in meshes in text form: the library that reads them takes the start of a word for a number, a
 * comma for a decimal point, and what is no number for 0. */
#include "core/base/number.h"
#include "core/base/word_reader.h"
#include "relaxation/mesh/mesh_internal.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char remedy[] = "correct it, or export the mesh again";

static bool is_word(const mor_word_reader *it, const char *word)
{
    return strcmp(it->word, word) == 0;
}

/* The three numbers behind a key. */
static mor_status take_place(mor_word_reader *it)
{
    for (int a = 0; a < 3; ++a) {
        double value;
        mor_word_reader_next(it);
        MOR_TRY(it->context, mor_word_reader_number(it, remedy, &value));
    }
    return MOR_OK;
}

/* ---- STL --------------------------------------------------------------------------------------------------------- */

static mor_status check_stl(mor_word_reader *it)
{
    mor_word_reader_next(it);
    while (it->n_bytes > 0) {
        if (strcasecmp(it->word, "vertex") == 0) {
            MOR_TRY(it->context, take_place(it));
        }
        if (strcasecmp(it->word, "solid") == 0 || strcasecmp(it->word, "endsolid") == 0) {
            mor_word_reader_next_line(it); /* a name of any words */
        } else {
            mor_word_reader_next(it);
        }
    }
    return MOR_OK;
}

/* ---- OBJ --------------------------------------------------------------------------------------------------------- */

/* A corner of a face: 7, 7/1, 7//3 or 7/1/3; counted from the last vertex backwards when negative. */
static mor_status take_corner(const mor_word_reader *it, long long n_vertices, long long *largest)
{
    const char *at = it->word;
    char *end = NULL;
    const long long corner = strtoll(at, &end, 10);
    bool is_corner = end > at && !isspace((unsigned char)*at) && corner != 0 && corner >= -n_vertices;
    for (int k = 0; k < 2 && is_corner && *end == '/'; ++k) {
        at = end + 1;
        end = (char *)at + (*at == '-');
        end += strspn(end, "0123456789");
    }
    if (!is_corner || *end != '\0') {
        return mor_word_reader_refuse(it, ", which is no corner of a face; allowed are numbers of vertices from 1, as "
                                          "in 7, 7/1, 7//3 or 7/1/3; correct it, or export the mesh again");
    }
    *largest = corner > *largest ? corner : *largest;
    return MOR_OK;
}

/* One line of a face or a vertex; a backslash at its end continues it on the next one. */
static mor_status check_obj_line(mor_word_reader *it, long long *n_vertices, long long *largest)
{
    const bool is_face = is_word(it, "f");
    long long line = it->line;
    int n_numbers = 0;
    for (mor_word_reader_next(it); it->n_bytes > 0 && it->line == line && it->word[0] != '#';
         mor_word_reader_next(it)) {
        double value;
        if (is_word(it, "\\")) {
            line = it->line + 1;
        } else if (is_face) {
            MOR_TRY(it->context, take_corner(it, *n_vertices, largest));
        } else {
            MOR_TRY(it->context, mor_word_reader_number(it, remedy, &value));
            ++n_numbers;
        }
    }
    if (!is_face && n_numbers < 3) {
        return mor_word_reader_refuse(it, " after a vertex of fewer than three numbers; allowed are 'v x y z'; correct "
                                          "it, or export the mesh again");
    }
    *n_vertices += !is_face;
    return MOR_OK;
}

static mor_status check_obj(mor_word_reader *it)
{
    long long n_vertices = 0;
    long long largest = 0;
    mor_word_reader_next(it);
    while (it->n_bytes > 0) {
        const long long line = it->line;
        if (is_word(it, "v") || is_word(it, "f")) {
            MOR_TRY(it->context, check_obj_line(it, &n_vertices, &largest));
        }
        if (it->line == line) {
            mor_word_reader_next_line(it);
        }
    }
    MOR_CHECK(it->context, largest <= n_vertices, MOR_ERROR_IO,
              "%s: a face refers to vertex %lld, but there are %lld; the file may be truncated: export the mesh again",
              it->path, largest, n_vertices);
    return MOR_OK;
}

/* ---- PLY --------------------------------------------------------------------------------------------------------- */

enum { ELEMENTS_MAX = 16, PROPERTIES_MAX = 64 };

/* An element of the header: so many rows of scalars (s), of coordinates (c) and of lists (l). */
typedef struct ply_element {
    double n_rows;
    int n_properties;
    char kinds[PROPERTIES_MAX];
} ply_element;

static char find_kind(mor_word_reader *it)
{
    mor_word_reader_next(it);
    if (is_word(it, "list")) {
        return 'l';
    }
    mor_word_reader_next(it);
    return is_word(it, "x") || is_word(it, "y") || is_word(it, "z") ? 'c' : 's';
}

static mor_status read_ply_header(mor_word_reader *it, ply_element *elements, int *n_elements)
{
    *n_elements = 0;
    mor_word_reader_next(it);
    while (it->n_bytes > 0 && !is_word(it, "end_header")) {
        const long long line = it->line;
        ply_element *last = *n_elements > 0 ? &elements[*n_elements - 1] : NULL;
        if (is_word(it, "element") && *n_elements < ELEMENTS_MAX) {
            ply_element *element = &elements[(*n_elements)++];
            *element = (ply_element){.n_properties = 0};
            mor_word_reader_next(it);
            mor_word_reader_next(it);
            MOR_TRY(it->context, mor_word_reader_number(it, remedy, &element->n_rows));
        } else if (is_word(it, "property") && last != NULL && last->n_properties < PROPERTIES_MAX) {
            last->kinds[last->n_properties++] = find_kind(it);
        } else if (is_word(it, "element") || is_word(it, "property")) {
            return mor_word_reader_refuse(it, " beyond what a mesh has; allowed are 16 elements of 64 properties; "
                                              "export the mesh with positions and faces only");
        }
        if (it->line == line) {
            mor_word_reader_next_line(it);
        }
    }
    return MOR_OK;
}

/* One value, or a list: its length and then its values. */
static mor_status take_property(mor_word_reader *it, char kind)
{
    double value = 0.0;
    mor_word_reader_next(it);
    const bool may_be_nan = kind == 's' && mor_number_is_nan(it->word, it->n_bytes);
    if (!may_be_nan) {
        MOR_TRY(it->context, mor_word_reader_number(it, remedy, &value));
    }
    for (double n = kind == 'l' ? value : 0.0; n >= 1.0; n -= 1.0) {
        mor_word_reader_next(it);
        MOR_TRY(it->context, mor_word_reader_number(it, remedy, &value));
    }
    return MOR_OK;
}

static mor_status check_ply(mor_word_reader *it)
{
    ply_element elements[ELEMENTS_MAX];
    int n_elements = 0;
    MOR_TRY(it->context, read_ply_header(it, elements, &n_elements));
    for (int e = 0; e < n_elements; ++e) {
        for (double row = 0.0; row < elements[e].n_rows && elements[e].n_properties > 0; row += 1.0) {
            for (int p = 0; p < elements[e].n_properties; ++p) {
                MOR_TRY(it->context, take_property(it, elements[e].kinds[p]));
            }
        }
    }
    mor_word_reader_next(it);
    return it->n_bytes == 0
               ? MOR_OK
               : mor_word_reader_refuse(it, " after the last element that the "
                                            "header declares; correct the header, or export the mesh again");
}

/* ------------------------------------------------------------------------------------------------------------------ */

mor_status mor_mesh_check_text(mor_context *context, const char *path, const char *ending, const char *text,
                               int64_t n_bytes)
{
    const bool is_ply = strcmp(ending, "ply") == 0;
    const bool is_stl = strcmp(ending, "stl") == 0;
    const bool is_text = strcmp(ending, "obj") == 0 || (is_ply && strstr(text, "\nformat ascii") != NULL) ||
                         (is_stl && !mor_mesh_is_binary_stl(text, n_bytes));
    if (!is_text) {
        return MOR_OK;
    }
    mor_word_reader reader;
    MOR_TRY(context, mor_word_reader_open(context, path, &reader));
    mor_status status = is_ply ? check_ply(&reader) : is_stl ? check_stl(&reader) : check_obj(&reader);
    const mor_status closed = mor_word_reader_close(&reader);
    status = status == MOR_OK ? closed : status;
    MOR_TRY(context, status);
    return MOR_OK;
}
