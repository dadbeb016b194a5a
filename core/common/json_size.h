/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_JSON_SIZE_H
#define CORE_COMMON_JSON_SIZE_H

#include <stddef.h>
#include <stdint.h>

/* Estimates the bytes of what jansson makes of a text of JSON, or of a part of one: each value and
 * each key follows one of four characters, and takes about 48 bytes, a block of 32 and its places
 * in an array that doubles. */
static inline uint64_t json_size_parsed(const char *text, size_t length)
{
    enum { VALUE = 48 };
    uint64_t values = 0;
    for (size_t k = 0; k < length; ++k) {
        const char c = text[k];
        values += c == ',' || c == ':' || c == '[' || c == '{';
    }
    return VALUE * values;
}

#endif
