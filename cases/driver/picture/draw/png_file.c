/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/png_file.h"

#include "core/base/memory.h"

#include <png.h>

#include <setjmp.h>
#include <string.h>

/* A third of the time of the usual 6, for files a tenth larger. */
enum { PACKING_LEVEL = 3, MESSAGE_BYTES = 128 };

/* Jump target of libpng, with the reason of an error. */
typedef struct rescue {
    jmp_buf place;
    char message[MESSAGE_BYTES];
} rescue;

static void give_up(png_structp png, png_const_charp message)
{
    rescue *back = png_get_error_ptr(png);
    snprintf(back->message, sizeof back->message, "%s", message);
    longjmp(back->place, 1);
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

/* A failed write sets the error flag of the file. */
static void write_bytes(png_structp png, png_bytep bytes, size_t n_bytes)
{
    (void)fwrite(bytes, 1, n_bytes, (FILE *)png_get_io_ptr(png));
}

static void flush_nothing(png_structp png)
{
    (void)png;
}

/* Holds no variable that a jump could spoil. */
static void write_rows(png_structp png, png_infop info, const int *size, const unsigned char *pixels,
                       int64_t stride_bytes, unsigned char *row)
{
    png_set_IHDR(png, info, (png_uint_32)size[0], (png_uint_32)size[1], 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, PACKING_LEVEL);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_write_info(png, info);
    for (int r = 0; r < size[1]; ++r) {
        for (int c = 0; c < size[0]; ++c) {
            uint32_t packed = 0;
            memcpy(&packed, pixels + r * stride_bytes + 4 * (int64_t)c, sizeof packed);
            for (int channel = 0; channel < 3; ++channel) {
                row[3 * c + channel] = (unsigned char)(packed >> (16 - 8 * channel));
            }
        }
        png_write_row(png, row);
    }
    png_write_end(png, NULL);
}

mor_status mor_png_file_write(mor_context *context, FILE *stream, const char *path, const int *size,
                              const unsigned char *pixels, int64_t stride_bytes)
{
    unsigned char *row = NULL;
    rescue back;
    MOR_TRY(context, MOR_NEW(context, &row, 3 * (int64_t)size[0], "a row of a picture"));
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &back, give_up, ignore_warning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    mor_status status = MOR_OK;
    if (info == NULL) {
        status = MOR_FAIL(context, MOR_ERROR_MEMORY, "%s: no memory to make the picture a PNG file", path);
    } else if (setjmp(back.place) == 0) {
        png_set_write_fn(png, stream, write_bytes, flush_nothing);
        write_rows(png, info, size, pixels, stride_bytes, row);
    } else {
        status = MOR_FAIL(context, MOR_ERROR_IO,
                          "%s: the picture cannot be made a PNG file: %s; draw a smaller one, or free some memory",
                          path, back.message);
    }
    png_destroy_write_struct(&png, &info);
    MOR_FREE(context, &row);
    return status;
}
