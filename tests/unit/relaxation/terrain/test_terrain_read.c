/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "relaxation/terrain/terrain.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_BYTES = 512, FILE_BYTES = 4096 };

static const char plane[] = "ncols 4\nnrows 3\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n"
                            "31 32 33 34\n21 22 23 24\n11 12 13 14\n";

/* A folder of its own, so that files the reader should not write are seen. */
static void make_path(const char *name, char *path)
{
    const char *parent = getenv("TMPDIR");
    char folder[PATH_BYTES / 2];
    snprintf(folder, sizeof folder, "%.200s/terrain_read", parent != NULL ? parent : "/tmp");
    mkdir(folder, 0777);
    snprintf(path, PATH_BYTES, "%s/%.100s", folder, name);
}

static mor_status read_bytes(mor_context *context, const char *name, const void *bytes, size_t n_bytes,
                             mor_terrain_request *request, mor_terrain *terrain)
{
    char path[PATH_BYTES];
    make_path(name, path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, n_bytes, file), n_bytes);
    assert_int_equal(fclose(file), 0);
    request->path = path;
    const mor_status status = mor_terrain_read(context, request, terrain);
    unlink(path);
    return status;
}

static mor_status read_text(mor_context *context, const char *text, mor_terrain *terrain)
{
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    return read_bytes(context, "raster.asc", text, strlen(text), &request, terrain);
}

static void ascii_grid_is_read_from_below(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain;
    assert_int_equal(read_text(&context, plane, &terrain), MOR_OK);
    assert_int_equal(terrain.n_x, 4);
    assert_int_equal(terrain.n_y, 3);
    assert_true(terrain.cell[0] == 10.0 && terrain.cell[1] == 10.0);
    /* nodes are cell centers; the first one and the lowest height become zero */
    assert_true(terrain.offset[0] == 105.0 && terrain.offset[1] == 205.0 && terrain.offset[2] == 11.0);
    assert_true(terrain.origin[0] == 0.0 && terrain.origin[1] == 0.0);
    for (int n = 0; n < 12; ++n) {
        assert_true(terrain.heights[n] == n % 4 + 10.0 * (n / 4));
    }
    assert_true(terrain.datum[0] == '\0');
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void crop_cell_and_offset_are_kept(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain;
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.crop_minimum[0] = 115.0; /* the second column of nodes, on the crop's edge */
    request.crop_maximum[1] = 220.0; /* below the third row */
    request.cell = 4.0;
    request.offset[0] = 100.0;
    request.offset[2] = 0.0;
    assert_int_equal(read_bytes(&context, "raster.asc", plane, sizeof plane - 1, &request, &terrain), MOR_OK);
    assert_int_equal(terrain.n_x, 6); /* 20 m in cells of 4 m */
    assert_int_equal(terrain.n_y, 3); /* 10 m in cells of 4 m, the rest left over */
    assert_true(terrain.origin[0] == 15.0 && terrain.origin[1] == 0.0 && terrain.offset[1] == 205.0);
    for (int n = 0; n < 18; ++n) {
        const double exact = 12.0 + 0.1 * 4.0 * (n % 6) + 1.0 * 4.0 * (n / 6);
        assert_true(fabs(terrain.heights[n] - exact) < 1e-13); /* rounding of numbers near 20 */
    }
    mor_terrain_clear(&context, &terrain);
}

static void holes_are_refused_or_filled_harmonically(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain;
    char text[FILE_BYTES];
    int n = snprintf(text, sizeof text, "ncols 12\nnrows 9\nxllcenter 0\nyllcenter 0\ncellsize 2\nNODATA_value -1\n");
    for (int row = 8; row >= 0; --row) {
        for (int column = 0; column < 12; ++column) {
            const int is_hole = column >= 3 && column <= 8 && row >= 2 && row <= 6;
            n += snprintf(text + n, sizeof text - (size_t)n, "%d ", is_hole ? -1 : 10 + 3 * column + 2 * row);
        }
    }
    assert_int_equal(read_text(&context, text, &terrain), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "30 of 108 nodes have no data, the first at (6, 4)"));
    assert_non_null(strstr(context.message, "fill_no_data = true"));
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.fills_no_data = true;
    request.offset[2] = 0.0;
    assert_int_equal(read_bytes(&context, "raster.asc", text, strlen(text), &request, &terrain), MOR_OK);
    for (int k = 0; k < 108; ++k) {
        /* a plane solves Laplace's equation; sweeps end at changes of 1e-7 of the relief of 49 m, the rest is a few
         * times that */
        assert_true(fabs(terrain.heights[k] - (10.0 + 3.0 * (k % 12) + 2.0 * (double)(k / 12))) < 5e-5);
    }
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void keep_line(void *user, mor_log_level level, const char *text)
{
    char *lines = user;
    if (level >= MOR_LOG_WARNING) {
        snprintf(lines + strlen(lines), FILE_BYTES - strlen(lines), "%s\n", text);
    }
}

/* A slope of 10 m per cell: degrees are suspected first where the relief is far above the extent. */
static void heights_over_degrees_without_a_system_are_told_from_marks(void **state)
{
    (void)state;
    static const struct {
        const char *cell;
        mor_status status;
        const char *words; /* in the message, or in the one warning */
    } all[] = {{"0.0001", MOR_ERROR_ARGUMENT, "degrees, project it with gdalwarp"},
               {"0.1", MOR_OK, "are its coordinates degrees, or does a number mark"},
               {"10", MOR_OK, NULL}};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_terrain terrain;
        char text[FILE_BYTES];
        char lines[FILE_BYTES] = "";
        context.log_sink = keep_line;
        context.log_user = lines;
        snprintf(text, sizeof text, "ncols 3\nnrows 2\nxllcorner 13\nyllcorner 47\ncellsize %s\n0 10 20\n0 10 20\n",
                 all[k].cell);
        assert_int_equal(read_text(&context, text, &terrain), all[k].status);
        const char *said = all[k].status == MOR_OK ? lines : context.message;
        assert_true(all[k].words != NULL ? strstr(said, all[k].words) != NULL : said[0] == '\0');
        const char *mark = strstr(said, "a_nodata");
        assert_true(mark == NULL || strstr(said, "degrees") < mark);
        mor_terrain_clear(&context, &terrain);
    }
}

/* Lines that are no height raster, and a word the message must hold. */
typedef struct bad_text {
    const char *text;
    mor_status status;
    const char *word;
} bad_text;

#define HEADER(columns, rows) "ncols " columns "\nnrows " rows "\nxllcorner 0\nyllcorner 0\ncellsize 1\n"

#define GRASS(columns, rows) "north: 4\nsouth: 0\neast: 4\nwest: 0\nrows: " rows "\ncols: " columns "\n"

static const bad_text bad_rasters[] = {
    {"", MOR_ERROR_IO, "empty"},
    {"\x93 not a raster at all", MOR_ERROR_IO, "gdal_translate"},
    {HEADER("3", "3"), MOR_ERROR_IO, "gdal_translate"},
    {HEADER("3", "3") "1 2 3\n4 5 6\n7 8\n", MOR_ERROR_IO, "8 numbers"},
    {HEADER("2", "3") "1 2 3\n4 5 6\n7 8 9\n", MOR_ERROR_IO, "9 numbers"},
    {HEADER("2147483647", "2147483647") "1 2 3\n", MOR_ERROR_IO, "gdal_translate"},
    {HEADER("60000", "60000") "1 2 3\n", MOR_ERROR_IO, "3 numbers follow"},
    {HEADER("-3", "3") "1 2 3\n", MOR_ERROR_IO, "gdal_translate"},
    {HEADER("4", "1") "1 2 3 4\n", MOR_ERROR_ARGUMENT, "two or more"},
    {HEADER("2", "2") "NODATA_value 7\n7 7 7 7\n", MOR_ERROR_ARGUMENT, "none of the 4 nodes"},
    {HEADER("2", "2") "1 nan\n1 1\n", MOR_ERROR_ARGUMENT, "1 of 4 nodes"},
    {HEADER("2", "2") "1 1\n1 -99999\n", MOR_ERROR_ARGUMENT, "a_nodata"},
    {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2\n3 4\n", MOR_ERROR_IO, "line 5, column 10"},
    /* a word that is no number is none, wherever it stands; GDAL takes most of these for 0 */
    {HEADER("3", "2") "1 2 3\n4 abc 6\n", MOR_ERROR_IO, "line 7, column 3: found 'abc'"},
    {HEADER("3", "2") "1 2 3\n4 5 #N/A\n", MOR_ERROR_IO, "line 7, column 5: found '#N/A'"},
    {HEADER("3", "2") "1 2 3\n 4\t5 1.5m\n", MOR_ERROR_IO, "line 7, column 6: found '1.5m'"},
    {HEADER("3", "2") "abc 2 3\n4 5 6\n", MOR_ERROR_IO, "line 6, column 1: found 'abc'"},
    {HEADER("3", "2") "1 2 3\n4 - 6\n", MOR_ERROR_IO, "found '-'"},
    {HEADER("3", "2") "1 2 3\n4 1,5 6\n", MOR_ERROR_IO, "numbers with a point"},
    {HEADER("3", "2") "1 2 3\n4 0x10 6\n", MOR_ERROR_IO, "'0x10', which is no number"},
    {HEADER("3", "2") "1 2 3\n4 1e 6\n", MOR_ERROR_IO, "'1e', which is no number"},
    {HEADER("3", "2") "1 2 3\n4 1e999 6\n", MOR_ERROR_IO, "'1e999', which is beyond the range"},
    {HEADER("3", "2") "1 2 3\n4 inf 6\n", MOR_ERROR_IO, "'inf', which is no number"},
    {HEADER("3", "2") "1 2 3\n4 -1.#IND 6\n", MOR_ERROR_IO, "'-1.#IND', which is no number"},
    {HEADER("3", "2") "1 2 3\n4 5 6\nend\n", MOR_ERROR_IO, "line 8, column 1: found 'end'"},
    {HEADER("3", "2") "1 2 3 4\n4 5 6\n", MOR_ERROR_IO, "7 numbers follow"},
    /* exchanged sizes give as many numbers */
    {HEADER("3", "2") "1 2\n3 4\n5 6\n", MOR_ERROR_IO, "exchange"},
    {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nncols 3\n1 2\n3 4\n", MOR_ERROR_IO,
     "line 6, column 1: found 'ncols', which repeats"},
    {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ndy 1\ncellsize 1\n1 2\n3 4\n", MOR_ERROR_IO, "repeats"},
    {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize -1\n1 2\n3 4\n", MOR_ERROR_IO, "above zero"},
    {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1m\n1 2\n3 4\n", MOR_ERROR_IO, "found '1m'"},
    {"ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n", MOR_ERROR_IO, "whole numbers"},
    /* GDAL puts these at the origin */
    {"ncols 2\nnrows 2\nxllcorner 9\nyllcenter 9\ncellsize 1\n1 2\n3 4\n", MOR_ERROR_IO, "a center along"},
    {"ncols 2\nnrows 2\nxllcorner 9\ncellsize 1\n1 2\n3 4\n", MOR_ERROR_IO, "no line 'yllcorner'"},
    {"ncols 2\nnrows 2\nxllcorner 9\nylcorner 9\ncellsize 1\n1 2\n3 4\n", MOR_ERROR_IO, "found 'ylcorner'"},
    {HEADER("2", "2") "NODATA_value none\n1 2\n3 4\n", MOR_ERROR_IO, "found 'none'"},
    {GRASS("2", "2") "1 2\n3 x4\n", MOR_ERROR_IO, "line 8, column 3: found 'x4'"},
    {GRASS("2", "2") "multiplier: 10\n1 2\n3 4\n", MOR_ERROR_IO, "found 'multiplier:'"},
    {GRASS("2", "2") "1 2\n3 4 5\n", MOR_ERROR_IO, "5 numbers follow"},
    {GRASS("2", "2") "1 2\n3 *\n", MOR_ERROR_IO, "line 8, column 3: found '*'"}, /* read as 0 without a word */
    {GRASS("2", "2") "null: 9\n1 2\n3 9\n", MOR_ERROR_ARGUMENT, "the first at (3, 1) m (row 2, column 2 of the file)"},
    {"DSAA\n2 2\n0 1\n0 1\n1 4\n1 2\n3 4x\n", MOR_ERROR_IO, "line 7, column 3: found '4x'"},
    {"DSAA\n2 2\n0 1\n0 1\n1 4\n1 2\n3 4 5\n", MOR_ERROR_IO, "5 numbers follow"},
};

static void bad_rasters_are_refused_with_the_reason(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof bad_rasters / sizeof *bad_rasters; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_terrain terrain;
        const mor_status status = read_text(&context, bad_rasters[k].text, &terrain);
        if (status != bad_rasters[k].status || strstr(context.message, bad_rasters[k].word) == NULL) {
            print_message("raster %d: %d, %s\n", (int)k, status, context.message);
        }
        assert_int_equal(status, bad_rasters[k].status);
        assert_non_null(strstr(context.message, bad_rasters[k].word));
        assert_null(terrain.heights);
        assert_int_equal(context.memory_bytes, 0);
    }
}

/* What is missing is said by a mark or by nan; all formats of text give the same ground. */
static void words_for_missing_data_are_no_heights(void **state)
{
    (void)state;
    static const char *const all[] = {
        HEADER("3", "3") "NODATA_value -9999\n6 7 8\n3 -9999.0 5\n0 1 2\n", HEADER("3", "3") "6 7 8\n3 nan 5\n0 1 2\n",
        HEADER("3", "3") "NODATA_value NaN\n6 7 8\n3 NaN 5\n0 1 2\n",
        "north: 3\nsouth: 0\neast: 3\nwest: 0\nrows: 3\ncols: 3\nnull: -1\n6 7 8\n3 -1 5\n0 1 2\n",
        "DSAA\n3 3\n0.5 2.5\n0.5 2.5\n0 8\n0 1 2\n3 1.70141e+38 5\n6 7 8\n"};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_terrain terrain;
        mor_terrain_request request;
        mor_terrain_request_init(&request);
        request.fills_no_data = true;
        const mor_status status = read_bytes(&context, "raster.asc", all[k], strlen(all[k]), &request, &terrain);
        if (status != MOR_OK) {
            print_message("raster %d: %s\n", (int)k, context.message);
        }
        assert_int_equal(status, MOR_OK);
        for (int n = 0; n < 9; ++n) {
            if (terrain.heights[n] != n) {
                print_message("raster %d: %g at node %d\n", (int)k, terrain.heights[n], n);
            }
            assert_true(fabs(terrain.heights[n] - n) < 8e-7); /* a filled hole: 1e-7 of the relief */
        }
        mor_terrain_clear(&context, &terrain);
    }
}

static void other_places_than_files_are_refused(void **state)
{
    (void)state;
    static const char *const paths[] = {"/vsicurl/http://localhost/a.tif", "https://localhost/a.tif", "/vsimem/a.tif",
                                        "/no/such/file.tif", "/tmp"};
    for (size_t k = 0; k < sizeof paths / sizeof *paths; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_terrain terrain;
        mor_terrain_request request;
        mor_terrain_request_init(&request);
        request.path = paths[k];
        assert_int_equal(mor_terrain_read(&context, &request, &terrain), MOR_ERROR_IO);
    }
}

/* A GeoTIFF of one strip of single precision, little endian: header, entries, then what does not fit into entries. */
typedef struct tiff {
    unsigned char bytes[FILE_BYTES];
    size_t n_entries;
    size_t end; /* of what was appended behind the entries */
} tiff;

enum { TIFF_ENTRIES_MAX = 20, TIFF_DATA = 8 + 2 + 12 * TIFF_ENTRIES_MAX + 4 };

static void put_number(unsigned char *at, unsigned long value, int n_bytes)
{
    for (int k = 0; k < n_bytes; ++k) {
        at[k] = (unsigned char)(value >> 8 * k);
    }
}

/* Types: 2 text, 3 short, 4 long, 12 double. Values of more than 4 bytes are appended. */
static void add_entry(tiff *it, int tag, int type, size_t count, const void *values)
{
    static const size_t sizes[] = {[2] = 1, [3] = 2, [4] = 4, [12] = 8};
    unsigned char *entry = it->bytes + 10 + 12 * it->n_entries++;
    const size_t n_bytes = count * sizes[type];
    put_number(entry, (unsigned long)tag, 2);
    put_number(entry + 2, (unsigned long)type, 2);
    put_number(entry + 4, count, 4);
    if (n_bytes <= 4) {
        memcpy(entry + 8, values, n_bytes);
        return;
    }
    put_number(entry + 8, it->end, 4);
    memcpy(it->bytes + it->end, values, n_bytes);
    it->end += n_bytes + n_bytes % 2;
}

static void add_short(tiff *it, int tag, unsigned short value)
{
    add_entry(it, tag, 3, 1, &value);
}

/* Heights 10 row + column on 5 x 4 nodes, in the case's words for the reference system: a map code, 0 for none. */
static size_t make_tiff(tiff *it, const double *map, int code, const char *missing)
{
    memset(it, 0, sizeof *it);
    it->end = TIFF_DATA;
    memcpy(it->bytes, "II*\0\x08\0\0\0", 8);
    float heights[20];
    for (int n = 0; n < 20; ++n) {
        heights[n] = (float)(10 * (3 - n / 5) + n % 5);
    }
    const unsigned int size = sizeof heights;
    unsigned int start = (unsigned int)it->end;
    memcpy(it->bytes + start, heights, size);
    it->end += size;
    add_short(it, 256, 5);
    add_short(it, 257, 4);
    add_short(it, 258, 32);
    add_short(it, 259, 1);
    add_short(it, 262, 1);
    add_entry(it, 273, 4, 1, &start);
    add_short(it, 277, 1);
    add_short(it, 278, 4);
    add_entry(it, 279, 4, 1, &size);
    add_short(it, 339, 3);
    add_entry(it, 34264, 12, 16, map);
    /* model type (1 map, 2 degrees), cells are areas, code of the system, a compound one with heights in meters */
    const unsigned short keys[] = {1,
                                   1,
                                   0,
                                   5,
                                   1024,
                                   0,
                                   1,
                                   (unsigned short)(code == 4326 ? 2 : 1),
                                   1025,
                                   0,
                                   1,
                                   1,
                                   (unsigned short)(code == 4326 ? 2048 : 3072),
                                   0,
                                   1,
                                   (unsigned short)code,
                                   4096,
                                   0,
                                   1,
                                   5773,
                                   4099,
                                   0,
                                   1,
                                   9001};
    if (code != 0) {
        add_entry(it, 34735, 3, sizeof keys / sizeof *keys, keys);
    }
    if (missing != NULL) {
        add_entry(it, 42113, 2, strlen(missing) + 1, missing);
    }
    put_number(it->bytes + 8, it->n_entries, 2);
    return it->end;
}

static const double north_up[16] = {2, 0, 0, 500000, 0, -3, 0, 5000012, 0, 0, 0, 0, 0, 0, 0, 1};

static void geotiff_keeps_place_and_datum(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    tiff file;
    mor_terrain terrain;
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    const size_t n_bytes = make_tiff(&file, north_up, 32633, NULL);
    assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, n_bytes, &request, &terrain), MOR_OK);
    assert_int_equal(terrain.n_x, 5);
    assert_int_equal(terrain.n_y, 4);
    assert_true(terrain.cell[0] == 2.0 && terrain.cell[1] == 3.0);
    assert_true(terrain.offset[0] == 500001.0 && terrain.offset[1] == 5000001.5 && terrain.offset[2] == 0.0);
    for (int n = 0; n < 20; ++n) {
        assert_true(terrain.heights[n] == 10.0 * (n / 5) + n % 5);
    }
    print_message("datum: %s\n", terrain.datum);
    assert_non_null(strstr(terrain.datum, "UTM zone 33N"));
    assert_non_null(strstr(terrain.datum, "heights: EGM96"));
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

/* A raster may keep heights in other steps than meters: number times scale plus offset. */
static void scale_and_offset_of_the_numbers_are_applied(void **state)
{
    (void)state;
    static const char scaled[] = "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">100</Item>"
                                 "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item></GDALMetadata>";
    mor_context context;
    mor_context_init(&context);
    tiff file;
    mor_terrain terrain;
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    make_tiff(&file, north_up, 32633, NULL);
    add_entry(&file, 42112, 2, sizeof scaled, scaled);
    put_number(file.bytes + 8, file.n_entries, 2);
    assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, file.end, &request, &terrain), MOR_OK);
    assert_true(terrain.offset[2] == 100.0); /* the lowest height */
    for (int n = 0; n < 20; ++n) {
        assert_true(terrain.heights[n] == 0.5 * (10.0 * (n / 5) + n % 5));
    }
    mor_terrain_clear(&context, &terrain);
    assert_int_equal(context.memory_bytes, 0);
}

static void geotiff_in_degrees_or_rotated_is_refused(void **state)
{
    (void)state;
    static const double rotated[16] = {2, 1, 0, 500000, 1, -2, 0, 5000012, 0, 0, 0, 0, 0, 0, 0, 1};
    mor_context context;
    mor_context_init(&context);
    tiff file;
    mor_terrain terrain;
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    size_t n_bytes = make_tiff(&file, north_up, 4326, NULL);
    assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, n_bytes, &request, &terrain), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "degrees"));
    assert_non_null(strstr(context.message, "gdalwarp"));
    n_bytes = make_tiff(&file, rotated, 32633, NULL);
    assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, n_bytes, &request, &terrain), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "rotated"));
    n_bytes = make_tiff(&file, north_up, 32633, "0");
    assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, n_bytes, &request, &terrain), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "1 of 20 nodes"));
    for (size_t cut = 0; cut < n_bytes; cut += 7) {
        /* a file cut anywhere is refused or read; it never crashes */
        if (read_bytes(&context, "raster.tif", file.bytes, cut, &request, &terrain) == MOR_OK) {
            mor_terrain_clear(&context, &terrain);
        }
        assert_int_equal(context.memory_bytes, 0);
    }
}

/* A height that is not a number is missing; an infinite one is a mistake, unless it is declared as missing. */
static void heights_of_geotiff_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    static const struct {
        float height;
        const char *missing, *words;
    } all[] = {{INFINITY, NULL, "row 1, column 2: found an infinite height"},
               {INFINITY, "inf", "1 of 20 nodes have no data, the first at (500003, 5.00001e+06) m (row 1, column 2"},
               {NAN, NULL, "1 of 20 nodes have no data, the first at (500003, 5.00001e+06) m (row 1, column 2"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        mor_context context;
        mor_context_init(&context);
        tiff file;
        mor_terrain terrain;
        mor_terrain_request request;
        mor_terrain_request_init(&request);
        const size_t n_bytes = make_tiff(&file, north_up, 32633, all[k].missing);
        memcpy(file.bytes + TIFF_DATA + sizeof all[k].height, &all[k].height, sizeof all[k].height);
        assert_int_equal(read_bytes(&context, "raster.tif", file.bytes, n_bytes, &request, &terrain),
                         MOR_ERROR_ARGUMENT);
        if (strstr(context.message, all[k].words) == NULL) {
            print_message("%s\n", context.message);
        }
        assert_non_null(strstr(context.message, all[k].words));
    }
}

static void reading_leaves_no_files(void **state)
{
    (void)state;
    char path[PATH_BYTES];
    make_path("", path);
    DIR *folder = opendir(path);
    assert_non_null(folder);
    int n_files = 0;
    for (struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        n_files += entry->d_name[0] != '.';
    }
    closedir(folder);
    assert_int_equal(n_files, 0);
    assert_int_equal(rmdir(path), 0);
}

static void volcano_has_its_known_range(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_terrain terrain;
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.path = MOR_SOURCE_DIR "/../shared/data/terrain/maungawhau.asc";
    if (access(request.path, R_OK) != 0) {
        print_message("left out: %s is not there\n", request.path);
        return;
    }
    request.offset[2] = 0.0;
    assert_int_equal(mor_terrain_read(&context, &request, &terrain), MOR_OK);
    assert_int_equal(terrain.n_x, 87);
    assert_int_equal(terrain.n_y, 61);
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (int n = 0; n < 87 * 61; ++n) {
        lowest = fmin(lowest, terrain.heights[n]);
        highest = fmax(highest, terrain.heights[n]);
    }
    assert_true(lowest == 94.0 && highest == 195.0);
    mor_terrain_clear(&context, &terrain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_grid_is_read_from_below),
        cmocka_unit_test(crop_cell_and_offset_are_kept),
        cmocka_unit_test(holes_are_refused_or_filled_harmonically),
        cmocka_unit_test(bad_rasters_are_refused_with_the_reason),
        cmocka_unit_test(words_for_missing_data_are_no_heights),
        cmocka_unit_test(other_places_than_files_are_refused),
        cmocka_unit_test(geotiff_keeps_place_and_datum),
        cmocka_unit_test(scale_and_offset_of_the_numbers_are_applied),
        cmocka_unit_test(heights_over_degrees_without_a_system_are_told_from_marks),
        cmocka_unit_test(geotiff_in_degrees_or_rotated_is_refused),
        cmocka_unit_test(heights_of_geotiff_that_are_not_finite_are_refused),
        cmocka_unit_test(reading_leaves_no_files),
        cmocka_unit_test(volcano_has_its_known_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
