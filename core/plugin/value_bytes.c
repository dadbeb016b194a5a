/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/value_bytes.h"

#include <stdlib.h>
#include <string.h>

static size_t padded(size_t size) { return (size + 7) / 8 * 8; }

size_t value_bytes_size(const imp_value *values, size_t count)
{
    size_t size = 0;
    for (size_t k = 0; k < count; ++k) {
        const imp_value *v = &values[k];
        size += padded(sizeof *v);
        if (v->number != NULL) size += v->count * sizeof *v->number;
        for (size_t j = 0; v->string != NULL && j < v->count; ++j)
            size += padded(strlen(v->string[j]) + 1);
    }
    return size;
}

static unsigned char *put(unsigned char *to, const void *from, size_t size)
{
    memcpy(to, from, size);
    memset(to + size, 0, padded(size) - size);
    return to + padded(size);
}

/* A value as it is written: its addresses only tell whether there is something. */
static imp_value without_addresses(const imp_value *v)
{
    static const double number;
    static const char *const string = "";
    imp_value written = *v;
    if (v->number != NULL) written.number = &number;
    if (v->string != NULL) written.string = &string;
    return written;
}

void value_bytes_write(const imp_value *values, size_t count, unsigned char *bytes)
{
    for (size_t k = 0; k < count; ++k) {
        const imp_value *v = &values[k], written = without_addresses(v);
        bytes = put(bytes, &written, sizeof written);
        if (v->number != NULL) bytes = put(bytes, v->number, v->count * sizeof *v->number);
        for (size_t j = 0; v->string != NULL && j < v->count; ++j)
            bytes = put(bytes, v->string[j], strlen(v->string[j]) + 1);
    }
}

/* Points a value at its numbers and strings, which follow it; returns the byte after them. Its
 * strings' addresses go to *strings. */
static const unsigned char *attach(imp_value *v, const unsigned char *bytes, const char ***strings)
{
    if (v->number != NULL) {
        v->number = (const double *)(const void *)bytes;
        bytes += v->count * sizeof *v->number;
    }
    if (v->string == NULL) return bytes;
    v->string = *strings;
    for (size_t j = 0; j < v->count; ++j) {
        *(*strings)++ = (const char *)bytes;
        bytes += padded(strlen((const char *)bytes) + 1);
    }
    return bytes;
}

static size_t count_strings(const unsigned char *bytes, size_t count)
{
    size_t strings = 0;
    for (size_t k = 0; k < count; ++k) {
        imp_value v;
        memcpy(&v, bytes, sizeof v);
        bytes += padded(sizeof v);
        if (v.number != NULL) bytes += v.count * sizeof *v.number;
        if (v.string == NULL) continue;
        strings += v.count;
        for (size_t j = 0; j < v.count; ++j) bytes += padded(strlen((const char *)bytes) + 1);
    }
    return strings;
}

imp_value *value_bytes_read(const unsigned char *bytes, size_t count)
{
    const size_t strings = count_strings(bytes, count);
    imp_value *values = malloc(count * sizeof *values + strings * sizeof(char *) + 1);
    if (values == NULL) return NULL;
    const char **next = (const char **)(void *)(values + count);
    for (size_t k = 0; k < count; ++k) {
        memcpy(&values[k], bytes, sizeof values[k]);
        bytes = attach(&values[k], bytes + padded(sizeof values[k]), &next);
    }
    return values;
}
