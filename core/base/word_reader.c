/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/word_reader.h"

#include "core/base/number.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <string.h>

enum { SHOWN_BYTES = 24, WHY_BYTES = 320 };

mor_status mor_word_reader_open(mor_context *context, const char *path, mor_word_reader *reader)
{
    *reader = (mor_word_reader){.context = context, .path = path, .next_line = 1, .next_column = 1};
    reader->file = fopen(path, "rb");
    MOR_CHECK(context, reader->file != NULL, MOR_ERROR_IO, "%s: cannot be read: %s; check the path", path,
              strerror(errno));
    return MOR_OK;
}

mor_status mor_word_reader_close(mor_word_reader *reader)
{
    const bool is_read = !ferror(reader->file);
    (void)fclose(reader->file);
    reader->file = NULL;
    MOR_CHECK(reader->context, is_read, MOR_ERROR_IO, "%s: cannot be read to its end; get it again", reader->path);
    return MOR_OK;
}

static int take_byte(mor_word_reader *it)
{
    const int byte = getc_unlocked(it->file);
    it->next_column = byte == '\n' ? 1 : it->next_column + 1;
    it->next_line += byte == '\n';
    return byte;
}

void mor_word_reader_next(mor_word_reader *reader)
{
    int byte;
    do {
        reader->line = reader->next_line;
        reader->column = reader->next_column;
        byte = take_byte(reader);
    } while (byte != EOF && isspace(byte));
    reader->n_bytes = 0;
    while (byte != EOF && !isspace(byte)) {
        if (reader->n_bytes < MOR_WORD_BYTES - 1) {
            reader->word[reader->n_bytes++] = (char)byte;
        }
        byte = take_byte(reader);
    }
    reader->word[reader->n_bytes] = '\0';
}

void mor_word_reader_next_line(mor_word_reader *reader)
{
    const long long line = reader->line;
    while (reader->n_bytes > 0 && reader->line == line) {
        mor_word_reader_next(reader);
    }
}

mor_status mor_word_reader_refuse(const mor_word_reader *reader, const char *why)
{
    char shown[SHOWN_BYTES + 1];
    size_t n = 0;
    for (; n < reader->n_bytes && n < SHOWN_BYTES; ++n) {
        shown[n] = isprint((unsigned char)reader->word[n]) ? reader->word[n] : '?';
    }
    shown[n] = '\0';
    return MOR_FAIL(reader->context, MOR_ERROR_IO, "%s, line %lld, column %lld: found '%s'%s", reader->path,
                    reader->line, reader->column, reader->n_bytes > 0 ? shown : "the end of the file", why);
}

mor_status mor_word_reader_number(const mor_word_reader *reader, const char *remedy, double *value)
{
    const bool is_number = mor_number_read(reader->word, reader->n_bytes, value);
    if (is_number && isfinite(*value)) {
        return MOR_OK;
    }
    char why[WHY_BYTES];
    snprintf(why, sizeof why, ", which is %s; allowed are finite decimal numbers with a point; %s",
             is_number ? "beyond the range of numbers" : "no number", remedy);
    return mor_word_reader_refuse(reader, why);
}
