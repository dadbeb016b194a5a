/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_JSON_SIZE_H
#define CORE_COMMON_JSON_SIZE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum {
    JSON_SIZE_LANES = 16,
    JSON_SIZE_BLOCKS = INT8_MAX, /* whose counts fit their lanes */
};
typedef int8_t json_size_bytes __attribute__((vector_size(JSON_SIZE_LANES)));

/* Counts such characters in n <= JSON_SIZE_BLOCKS blocks of JSON_SIZE_LANES bytes. A lane that is
 * equal has -1; '[' | 0x20 is '{', and no other byte but '{' is. */
static inline uint64_t json_size_values(const char *text, size_t n)
{
    json_size_bytes count = {0};
    uint64_t values = 0;
    for (size_t k = 0; k < n; ++k) {
        json_size_bytes c;
        memcpy(&c, text + JSON_SIZE_LANES * k, sizeof c);
        count -= (c == ',') + (c == ':') + ((c | 0x20) == '{');
    }
    for (int lane = 0; lane < JSON_SIZE_LANES; ++lane) values += (uint64_t)count[lane];
    return values;
}

/* Estimates the bytes of what jansson makes of a text of JSON, or of a part of one: each value and
 * each key follows one of four characters, and takes about 48 bytes, a block of 32 and its places
 * in an array that doubles. */
static inline uint64_t json_size_parsed(const char *text, size_t length)
{
    enum { VALUE = 48 };
    uint64_t values = 0;
    size_t k = 0;
    while (length - k >= JSON_SIZE_LANES) {
        const size_t rest = (length - k) / JSON_SIZE_LANES;
        const size_t n = rest < JSON_SIZE_BLOCKS ? rest : JSON_SIZE_BLOCKS;
        values += json_size_values(text + k, n);
        k += n * JSON_SIZE_LANES;
    }
    for (; k < length; ++k) {
        const char c = text[k];
        values += c == ',' || c == ':' || c == '[' || c == '{';
    }
    return VALUE * values;
}

#endif
