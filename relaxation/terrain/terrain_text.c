/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Checks rasters of text word by word. The library that reads them takes what is no number for 0, the first of two
 * header lines for both, and a header it does not know for none. */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/number.h"
#include "core/base/word_reader.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

static const char remedy[] =
    "correct it, or write the number that the header declares (NODATA_value, null:) where there is no data";

/* Values of header lines. A cell size sets two of them. */
typedef enum header_slot { COLUMNS, ROWS, X, Y, X_END, Y_END, X_CELL, Y_CELL, MARK, OTHER, N_SLOTS } header_slot;

typedef struct header_key {
    const char *word;
    header_slot slot;
    bool is_center; /* of a place: of the middle of the first cell, not of its corner */
} header_key;

static const header_key esri_keys[] = {{"ncols", COLUMNS, false},     {"nrows", ROWS, false},  {"xllcorner", X, false},
                                       {"xllcenter", X, true},        {"yllcorner", Y, false}, {"yllcenter", Y, true},
                                       {"cellsize", X_CELL, false},   {"dx", X_CELL, false},   {"dy", Y_CELL, false},
                                       {"nodata_value", MARK, false}, {NULL, N_SLOTS, false}};
static const header_key grass_keys[] = {{"cols:", COLUMNS, false}, {"rows:", ROWS, false},  {"west:", X, false},
                                        {"south:", Y, false},      {"east:", X_END, false}, {"north:", Y_END, false},
                                        {"null:", MARK, false},    {"type:", OTHER, false}, {NULL, N_SLOTS, false}};

/* A raster being read, and its header. */
typedef struct text_raster {
    mor_word_reader reader;
    const header_key *keys;
    bool has[N_SLOTS];
    bool is_center[N_SLOTS];
    double values[N_SLOTS];
} text_raster;

/* ---- Headers ----------------------------------------------------------------------------------------------------- */

static const header_key *find_key(const text_raster *it)
{
    const header_key *key = it->keys;
    while (key->word != NULL && strcasecmp(key->word, it->reader.word) != 0) {
        ++key;
    }
    return key->word != NULL ? key : NULL;
}

static mor_status check_value(const text_raster *it, header_slot slot, double value)
{
    if ((slot == COLUMNS || slot == ROWS) && !(value >= 1.0 && value == floor(value))) {
        return mor_word_reader_refuse(
            &it->reader, " as a number of columns or rows; allowed are whole numbers above zero; correct it");
    }
    if ((slot == X_CELL || slot == Y_CELL) && !(value > 0.0)) {
        return mor_word_reader_refuse(&it->reader,
                                      " as the size of a cell; allowed is a length above zero; correct it");
    }
    return MOR_OK;
}

/* A header line and its value. */
static mor_status read_value(text_raster *it, const header_key *key)
{
    mor_word_reader_next(&it->reader);
    double value = 0.0;
    if (key->slot == MARK && it->keys == esri_keys && mor_number_is_nan(it->reader.word, it->reader.n_bytes)) {
        value = NAN;
    } else if (key->slot != OTHER) {
        MOR_TRY(it->reader.context, mor_word_reader_number(&it->reader, remedy, &value));
    }
    MOR_TRY(it->reader.context, check_value(it, key->slot, value));
    it->has[key->slot] = true;
    it->is_center[key->slot] = key->is_center;
    it->values[key->slot] = value;
    if (strcmp(key->word, "cellsize") == 0) {
        it->has[Y_CELL] = true;
        it->values[Y_CELL] = value;
    }
    return MOR_OK;
}

/* Lines of a key and its value, up to the first word that begins like a number. */
static mor_status read_header(text_raster *it)
{
    for (mor_word_reader_next(&it->reader);
         it->reader.n_bytes > 0 && isalpha((unsigned char)it->reader.word[0]) &&
         !mor_number_is_nan(it->reader.word, it->reader.n_bytes) && strcasecmp(it->reader.word, "inf") != 0;
         mor_word_reader_next(&it->reader)) {
        const header_key *key = find_key(it);
        if (key == NULL) {
            return mor_word_reader_refuse(
                &it->reader, it->keys == esri_keys
                                 ? ", which is neither a number nor a key of the header; allowed are ncols, nrows, "
                                   "xllcorner, yllcorner (or xllcenter, yllcenter), cellsize (or dx, dy) and "
                                   "NODATA_value; correct it"
                                 : ", which is neither a number nor a key of the header; allowed are north:, south:, "
                                   "east:, west:, rows:, cols:, null: and type:; correct it");
        }
        if (it->has[key->slot] || (strcmp(key->word, "cellsize") == 0 && it->has[Y_CELL])) {
            return mor_word_reader_refuse(&it->reader,
                                          ", which repeats a key of the header; allowed is one of them; remove the "
                                          "other");
        }
        MOR_TRY(it->reader.context, read_value(it, key));
    }
    return MOR_OK;
}

static mor_status check_header(const text_raster *it)
{
    static const header_slot esri[] = {COLUMNS, ROWS, X, Y, X_CELL, Y_CELL, N_SLOTS};
    static const header_slot grass[] = {COLUMNS, ROWS, X, Y, X_END, Y_END, N_SLOTS};
    for (const header_slot *slot = it->keys == esri_keys ? esri : grass; *slot != N_SLOTS; ++slot) {
        const header_key *key = it->keys;
        while (key->slot != *slot) {
            ++key;
        }
        MOR_CHECK(it->reader.context, it->has[*slot], MOR_ERROR_IO,
                  "%s: its header has no line '%s', without which the raster has no position; add it", it->reader.path,
                  key->word);
    }
    MOR_CHECK(it->reader.context, it->is_center[X] == it->is_center[Y], MOR_ERROR_IO,
              "%s: its header gives a corner along one axis and a center along the other; allowed are xllcorner with "
              "yllcorner, or xllcenter with yllcenter; correct it",
              it->reader.path);
    return MOR_OK;
}

/* Name, sizes and three ranges, without keys. */
static mor_status read_surfer_header(text_raster *it)
{
    static const header_slot slots[] = {COLUMNS, ROWS, X, X_END, Y, Y_END, OTHER, OTHER};
    mor_word_reader_next(&it->reader);
    for (size_t k = 0; k < sizeof slots / sizeof *slots; ++k) {
        double value;
        mor_word_reader_next(&it->reader);
        MOR_TRY(it->reader.context, mor_word_reader_number(&it->reader, remedy, &value));
        MOR_TRY(it->reader.context, check_value(it, slots[k], value));
        it->values[slots[k]] = value;
    }
    mor_word_reader_next(&it->reader);
    return MOR_OK;
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* How many numbers the lines hold. */
typedef struct line_count {
    long long n_lines, n_in_line, line;
    bool is_even; /* every line but the current one holds as many as the first */
    long long n_in_first;
} line_count;

static void count_word(line_count *it, long long line)
{
    if (it->n_lines == 0 || line != it->line) {
        it->is_even = it->n_lines < 2 || (it->is_even && it->n_in_line == it->n_in_first);
        it->n_in_first = it->n_lines == 1 ? it->n_in_line : it->n_in_first;
        it->n_in_line = 0;
        ++it->n_lines;
        it->line = line;
    }
    ++it->n_in_line;
}

static mor_status check_numbers(text_raster *it)
{
    const double n_columns = it->values[COLUMNS];
    const double n_rows = it->values[ROWS];
    line_count lines = {.is_even = true};
    double n = 0.0;
    for (; it->reader.n_bytes > 0; mor_word_reader_next(&it->reader)) {
        double value;
        if (!mor_number_is_nan(it->reader.word, it->reader.n_bytes)) {
            MOR_TRY(it->reader.context, mor_word_reader_number(&it->reader, remedy, &value));
        }
        count_word(&lines, it->reader.line);
        n += 1.0;
    }
    MOR_CHECK(it->reader.context, n == n_columns * n_rows, MOR_ERROR_IO,
              "%s: its header declares %.17g columns in %.17g rows, but %.17g numbers follow, the last in line %lld; "
              "correct the header, or get the file again",
              it->reader.path, n_columns, n_rows, n, lines.line);
    /* Columns and rows that are exchanged give as many numbers, and shear the ground. */
    const bool is_exchanged = lines.n_lines == n_columns && lines.n_in_line == n_rows && lines.n_in_first == n_rows &&
                              lines.is_even && n_columns != n_rows;
    MOR_CHECK(it->reader.context, !is_exchanged, MOR_ERROR_IO,
              "%s: its header declares %.17g columns in %.17g rows, but %lld lines of %lld numbers follow; exchange "
              "columns and rows in the header",
              it->reader.path, n_columns, n_rows, lines.n_lines, lines.n_in_line);
    return MOR_OK;
}

static mor_status check_words(text_raster *it, mor_terrain_format format)
{
    if (format == MOR_TERRAIN_SURFER) {
        MOR_TRY(it->reader.context, read_surfer_header(it));
    } else {
        it->keys = format == MOR_TERRAIN_ESRI ? esri_keys : grass_keys;
        MOR_TRY(it->reader.context, read_header(it));
        MOR_TRY(it->reader.context, check_header(it));
    }
    MOR_TRY(it->reader.context, check_numbers(it));
    return MOR_OK;
}

mor_status mor_terrain_check_text(mor_context *context, const char *path, mor_terrain_format format, const int *n)
{
    text_raster it = {.keys = NULL};
    MOR_TRY(context, mor_word_reader_open(context, path, &it.reader));
    mor_status status = check_words(&it, format);
    const mor_status closed = mor_word_reader_close(&it.reader);
    status = status == MOR_OK ? closed : status;
    MOR_TRY(context, status);
    MOR_CHECK(context, it.values[COLUMNS] == n[0] && it.values[ROWS] == n[1], MOR_ERROR_IO,
              "%s: its header declares %.17g columns in %.17g rows, but reads as %d in %d; write it in the order of "
              "the format, one key and value in each line",
              path, it.values[COLUMNS], it.values[ROWS], n[0], n[1]);
    return MOR_OK;
}
