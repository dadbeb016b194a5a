/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/npy_head.h"

#include <math.h>
#include <string.h>

int npy_length_bytes(const unsigned char front[NPY_FRONT])
{
    if (memcmp(front, "\x93NUMPY", 6) != 0) return -1;
    if (front[6] < 1 || front[6] > 3) return -2;
    return front[6] == 1 ? 0 : 2;
}

static const char *skip(const char *at) { return at + strspn(at, " \t\r\n"); }

/* Reads a text in quotes, without escapes. NULL: there is none. */
static const char *read_quoted(const char *at, char *to, size_t size)
{
    const char quote = *at;
    if (quote != '\'' && quote != '"') return NULL;
    const char *end = strchr(at + 1, quote);
    if (end == NULL || (size_t)(end - at) > size) return NULL;
    memcpy(to, at + 1, (size_t)(end - at) - 1);
    to[end - at - 1] = '\0';
    return end + 1;
}

/* Reads '<f8' and the like. */
static const char *read_descr(npy_head *h, const char *at)
{
    char text[16];
    at = read_quoted(at, text, sizeof text);
    if (at == NULL || strlen(text) != 3 || strchr("<>|=", text[0]) == NULL) return NULL;
    const bool is_byte = text[2] == '1';
    h->is_big_endian = text[0] == '>' || (text[0] == '=' && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    h->kind = text[1];
    h->width = (size_t)(text[2] - '0');
    const bool known = h->kind == 'f' ? h->width == 4 || h->width == 8
                       : h->kind == 'b'
                           ? is_byte
                           : (h->kind == 'i' || h->kind == 'u') && strchr("1248", text[2]) != NULL;
    return known && (is_byte || text[0] != '|') ? at : NULL;
}

static const char *read_truth(npy_head *h, const char *at)
{
    h->is_columns_first = strncmp(at, "True", 4) == 0;
    if (h->is_columns_first) return at + 4;
    return strncmp(at, "False", 5) == 0 ? at + 5 : NULL;
}

/* Reads (16, 3), (5,) or (). NULL: it is no shape. Of one of more dimensions than any row has, only
 * the rank is kept. */
static const char *read_shape(npy_head *h, const char *at)
{
    if (*at != '(') return NULL;
    at = skip(at + 1);
    for (h->rank = 0; *at != ')'; ++h->rank) {
        size_t extent = 0, digits = 0;
        for (; *at >= '0' && *at <= '9'; ++at, ++digits)
            if (__builtin_mul_overflow(extent, (size_t)10, &extent) ||
                __builtin_add_overflow(extent, (size_t)(*at - '0'), &extent))
                return NULL;
        if (digits == 0) return NULL;
        if (h->rank < IMP_RANK_MAX) h->extent[h->rank] = extent;
        at = skip(*at == 'L' ? at + 1 : at); /* as Python 2 wrote it */
        if (*at == ',')
            at = skip(at + 1);
        else if (*at != ')')
            return NULL;
    }
    return at + 1;
}

enum { DESCR = 1, ORDER = 2, SHAPE = 4, ALL = 7 };

const char *npy_head_read(npy_head *h, const char *text)
{
    unsigned seen = 0;
    const char *at = skip(text);
    if (*at != '{') return "its head is no dictionary";
    for (at = skip(at + 1); *at != '}';) {
        char key[32];
        unsigned which = 0;
        at = read_quoted(at, key, sizeof key);
        if (at != NULL) at = skip(at);
        if (at == NULL || *at != ':') return "its head is no dictionary";
        at = skip(at + 1);
        if (strcmp(key, "descr") == 0)
            which = DESCR, at = read_descr(h, at);
        else if (strcmp(key, "fortran_order") == 0)
            which = ORDER, at = read_truth(h, at);
        else if (strcmp(key, "shape") == 0)
            which = SHAPE, at = read_shape(h, at);
        if (which == 0 || (seen & which) != 0)
            return "its head has an entry that is not known, or one twice";
        if (at == NULL)
            return which == DESCR
                       ? "its numbers are none of float32, float64, integers and booleans"
                   : which == SHAPE ? "its shape cannot be read"
                                    : "its fortran_order is neither True nor False";
        seen |= which;
        at = skip(at);
        if (*at == ',')
            at = skip(at + 1);
        else if (*at != '}')
            return "its head is no dictionary";
    }
    return seen == ALL ? NULL : "its head lacks descr, fortran_order or shape";
}

double npy_number(const npy_head *h, const unsigned char *bytes)
{
    uint64_t bits = 0;
    for (size_t k = 0; k < h->width; ++k)
        bits |= (uint64_t)bytes[h->is_big_endian ? h->width - 1 - k : k] << (8 * k);
    if (h->kind == 'f' && h->width == 8) {
        double x;
        memcpy(&x, &bits, sizeof x);
        return x;
    }
    if (h->kind == 'f') {
        const uint32_t half = (uint32_t)bits;
        float x;
        memcpy(&x, &half, sizeof x);
        return (double)x;
    }
    const uint64_t sign = UINT64_C(1) << (8 * h->width - 1), exact = UINT64_C(1) << 53;
    const bool is_below = h->kind == 'i' && (bits & sign) != 0;
    const uint64_t magnitude = is_below ? (sign - (bits & (sign - 1))) : bits;
    if (magnitude > exact) return INFINITY;
    return is_below ? -(double)magnitude : (double)magnitude;
}
