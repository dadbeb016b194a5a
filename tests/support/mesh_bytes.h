/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MESH_BYTES_H
#define TESTS_SUPPORT_MESH_BYTES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/mesh/mesh_file.h"
#include "plugins/mesh/polygon.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

/* Files of meshes that are made here, byte by byte. */

/* A file that is being written. */
typedef struct bytes {
    char at[4096];
    size_t length;
} bytes;

static inline void add(bytes *b, const void *data, size_t size)
{
    ck_assert(b->length + size <= sizeof b->at);
    memcpy(b->at + b->length, data, size);
    b->length += size;
}

static inline void add_text(bytes *b, const char *text) { add(b, text, strlen(text)); }

/* `size` bytes of a number, the last first if the file wants it so. */
static inline void add_number(bytes *b, const void *data, size_t size, bool is_big_endian)
{
    const char *from = data;
    for (size_t k = 0; k < size; ++k) add(b, from + (is_big_endian ? size - 1 - k : k), 1);
}

static inline void add_float(bytes *b, float x, bool is_big_endian)
{
    add_number(b, &x, sizeof x, is_big_endian);
}

static inline void add_word(bytes *b, uint32_t x, bool is_big_endian)
{
    add_number(b, &x, sizeof x, is_big_endian);
}

static inline imp_status read_all(mesh_format format, const bytes *b, triangles *to,
                                  triangles_fault *why)
{
    *to = (triangles){.count = 0};
    *why = (triangles_fault){0, "", 0};
    char *exact = malloc(b->length + (b->length == 0)); /* reading beyond it shows */
    ck_assert(exact != NULL);
    memcpy(exact, b->at, b->length);
    const imp_status status = mesh_read_bytes(format, exact, b->length, NULL, to, why);
    free(exact);
    return status;
}

/* The file has that many points and triangles, and left out that much. */
static inline void check_read(mesh_format format, const bytes *b, size_t points, size_t count,
                              size_t left_out)
{
    triangles t;
    triangles_fault why;
    ck_assert_msg(read_all(format, b, &t, &why) == IMP_STATUS_OK, "%s", why.text);
    ck_assert_uint_eq(t.point_count, points);
    ck_assert_uint_eq(t.count, count);
    ck_assert_uint_eq(t.left_out.count, left_out);
    triangles_clear(&t);
}

/* The file is refused with a text that has these words in it, at that line or byte (from 0). */
static inline void check_refused(mesh_format format, const bytes *b, size_t line, long byte,
                                 const char *words)
{
    triangles t;
    triangles_fault why;
    ck_assert_int_eq(read_all(format, b, &t, &why), IMP_STATUS_PARAMETER);
    ck_assert_msg(strstr(why.text, words) != NULL, "got: %s", why.text);
    ck_assert_uint_eq(why.line, line);
    ck_assert_int_eq((long)why.byte - 1, byte);
    triangles_clear(&t);
}

static inline bytes text_of(const char *text)
{
    bytes b = {.length = 0};
    add_text(&b, text);
    return b;
}

#define READ(FORMAT, TEXT, POINTS, COUNT, LEFT_OUT)                                                \
    check_read(FORMAT, &(const bytes[]){text_of(TEXT)}[0], POINTS, COUNT, LEFT_OUT)
#define REFUSED(FORMAT, TEXT, LINE, WORDS)                                                         \
    check_refused(FORMAT, &(const bytes[]){text_of(TEXT)}[0], LINE, -1, WORDS)

#endif
