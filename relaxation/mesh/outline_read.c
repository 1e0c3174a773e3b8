/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/base/number.h"
#include "relaxation/mesh/outline_internal.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LINE_BYTES = 512, FIRST_ROOM = 256 };

/* A file being read. */
typedef struct outline_reader {
    FILE *file;
    const char *path;
    int line; /* from 1 */
    char text[LINE_BYTES];
    mor_outline_corners corners;
    int room; /* corners there is memory for */
} outline_reader;

/* Takes the next line without its comment into text; is_end: there is none. */
static mor_status read_line(mor_context *context, outline_reader *reader, bool *is_end)
{
    int n_bytes = 0;
    bool is_comment = false;
    int byte = getc(reader->file);
    *is_end = byte == EOF;
    ++reader->line;
    for (; byte != EOF && byte != '\n'; byte = getc(reader->file)) {
        is_comment = is_comment || byte == '#';
        if (is_comment) {
            continue;
        }
        MOR_CHECK(context, byte != '\0' && n_bytes < LINE_BYTES - 1, MOR_ERROR_IO,
                  "%s, line %d: this is not a text of corners; give a file with one corner \"x y\" per line",
                  reader->path, reader->line);
        reader->text[n_bytes++] = (char)byte;
    }
    reader->text[n_bytes] = '\0';
    MOR_CHECK(context, !ferror(reader->file), MOR_ERROR_IO, "%s could not be read: %s", reader->path, strerror(errno));
    /* Editors may put a byte order mark before the first line. */
    if (reader->line == 1 && strncmp(reader->text, "\xEF\xBB\xBF", 3) == 0) {
        memmove(reader->text, reader->text + 3, (size_t)n_bytes - 2);
    }
    return MOR_OK;
}

static const char separators[] = " \t\r\v\f,;";

static const char *skip_separators(const char *text)
{
    return text + strspn(text, separators);
}

static mor_status make_room(mor_context *context, outline_reader *reader)
{
    mor_outline_corners *corners = &reader->corners;
    if (corners->n_points < reader->room) {
        return MOR_OK;
    }
    MOR_CHECK(context, corners->n_points < MOR_OUTLINE_CORNERS_MAX, MOR_ERROR_ARGUMENT,
              "%s has more than %d corners: keep every second one, or fewer", reader->path, MOR_OUTLINE_CORNERS_MAX);
    const int room = reader->room == 0 ? FIRST_ROOM : 2 * reader->room;
    double *points = NULL;
    int *lines = NULL;
    MOR_TRY(context, MOR_NEW(context, &points, 2 * (int64_t)room, "corners of an outline"));
    const mor_status status = MOR_NEW(context, &lines, room, "lines of an outline");
    if (status != MOR_OK) {
        MOR_FREE(context, &points);
        return mor_context_pass(context, status, MOR_HERE);
    }
    for (int i = 0; i < corners->n_points; ++i) {
        memcpy(points + 2 * i, corners->points + 2 * i, 2 * sizeof *points);
        lines[i] = corners->lines[i];
    }
    MOR_FREE(context, &corners->points);
    MOR_FREE(context, &corners->lines);
    corners->points = points;
    corners->lines = lines;
    reader->room = room;
    return MOR_OK;
}

/* A line holds two numbers, or nothing. */
static mor_status read_corner(mor_context *context, outline_reader *reader)
{
    double place[2] = {0.0, 0.0};
    const char *text = skip_separators(reader->text);
    int n_numbers = 0;
    if (*text == '\0') {
        return MOR_OK;
    }
    while (*text != '\0') {
        double number;
        const size_t n_bytes = strcspn(text, separators);
        MOR_CHECK(context, mor_number_read(text, n_bytes, &number) && isfinite(number), MOR_ERROR_IO,
                  "%s, line %d, column %d: \"%.*s\" is no number; give one corner \"x y\" per line, '#' before a "
                  "comment",
                  reader->path, reader->line, (int)(text - reader->text) + 1, n_bytes < 20 ? (int)n_bytes : 20, text);
        if (n_numbers < 2) {
            place[n_numbers] = number;
        }
        ++n_numbers;
        text = skip_separators(text + n_bytes);
    }
    MOR_CHECK(context, n_numbers == 2, MOR_ERROR_IO,
              "%s, line %d: %d %s; give one corner \"x y\" per line, with decimal points", reader->path, reader->line,
              n_numbers, n_numbers == 1 ? "number" : "numbers");
    MOR_TRY(context, make_room(context, reader));
    memcpy(reader->corners.points + 2 * (size_t)reader->corners.n_points, place, sizeof place);
    reader->corners.lines[reader->corners.n_points++] = reader->line;
    return MOR_OK;
}

static mor_status read_corners(mor_context *context, outline_reader *reader)
{
    for (bool is_end = false; !is_end;) {
        MOR_TRY(context, read_line(context, reader, &is_end));
        MOR_TRY(context, read_corner(context, reader));
    }
    MOR_TRY(context, mor_outline_check(context, &reader->corners));
    return MOR_OK;
}

mor_status mor_outline_read(mor_context *context, const char *path, mor_outline *outline)
{
    *outline = (mor_outline){NULL, 0};
    outline_reader reader = {.path = path, .corners = {.name = path}};
    reader.file = fopen(path, "rb");
    MOR_CHECK(context, reader.file != NULL, MOR_ERROR_IO, "%s could not be opened: %s", path, strerror(errno));
    const mor_status status = read_corners(context, &reader);
    fclose(reader.file);
    MOR_FREE(context, &reader.corners.lines);
    if (status != MOR_OK) {
        MOR_FREE(context, &reader.corners.points);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *outline = (mor_outline){reader.corners.points, reader.corners.n_points};
    return MOR_OK;
}
