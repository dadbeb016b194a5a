/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_NPY_HEAD_H
#define CORE_PLUGIN_NPY_HEAD_H

#include <impinge/surface.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The head of a .npy file
 * =======================
 * The format is that of numpy.lib.format: a magic text, a version, the length of the head, and the
 * head, the text of a Python dictionary, behind which the numbers stand. */

enum {
    NPY_FRONT = 10,         /* bytes: magic text, version, and the first two of the length */
    NPY_HEAD_MOST = 1 << 16 /* bytes of the head: that of an array of numbers has 118 */
};

typedef struct npy_head {
    char kind;    /* f, i, u or b */
    size_t width; /* bytes of a number */
    bool is_big_endian, is_columns_first;
    uint32_t rank;
    size_t extent[IMP_RANK_MAX]; /* of the first dimensions, where there are more */
} npy_head;

/* How many bytes of the length follow the front; -1: it is no file of the format, -2: of no version
 * from 1 to 3. */
int npy_length_bytes(const unsigned char front[NPY_FRONT]);

/* Reads the head. NULL, or what is wrong with it. */
const char *npy_head_read(npy_head *h, const char *text);

/* Returns the number that stands in bytes[width]. Whole ones that no double holds become infinite,
 * which no parameter allows. */
double npy_number(const npy_head *h, const unsigned char *bytes);

#endif
