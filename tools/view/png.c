/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/png.h"

#ifdef HAVE_LIBPNG

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>

bool png_is_available(void) { return true; }

/* Replaces libpng's own message on standard error. The caller reports the error. */
_Noreturn static void leave(png_structp png, png_const_charp text)
{
    (void)text;
    png_longjmp(png, 1);
}

static void keep_quiet(png_structp png, png_const_charp text) { (void)png, (void)text; }

/* libpng leaves by longjmp; variables used afterwards are not changed in between. */
static bool write_rows(png_structp png, png_infop info, FILE *file, const raster *r, uint8_t *row)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)r->width, (png_uint_32)r->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (size_t y = 0; y < r->height; ++y) {
        raster_row(r, y, row);
        png_write_row(png, row);
    }
    png_write_end(png, info);
    return true;
}

bool png_write_raster(FILE *file, const raster *r)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, leave, keep_quiet);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    uint8_t *row = malloc(3 * r->width);
    const bool written = info != NULL && row != NULL && write_rows(png, info, file, r, row);
    free(row);
    if (png != NULL) png_destroy_write_struct(&png, info != NULL ? &info : NULL);
    return written;
}

#else

bool png_is_available(void) { return false; }

bool png_write_raster(FILE *file, const raster *r)
{
    (void)file, (void)r;
    return false;
}

#endif

exit_status png_check(const char *path, const char *verb)
{
    if (png_is_available()) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, verb,
                    "'%s': this impinge was built without libpng; write .svg instead, or install "
                    "libpng-dev, configure and build again",
                    path);
}
