/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_VALUE_BYTES_H
#define CORE_PLUGIN_VALUE_BYTES_H

#include <stdbool.h>
#include <stddef.h>

#include <impinge/surface.h>

/* Parameter values as bytes, for another process
 * ==============================================
 * For each value its imp_value, its numbers and its strings, each string with its NUL; every part
 * is padded to a multiple of 8 bytes. Both processes run the same program, so layouts agree. Within
 * one process equal values have equal bytes. */

/* Bytes that `count` values take. */
size_t value_bytes_size(const imp_value *values, size_t count);

/* Writes them to `bytes`, which has that size. */
void value_bytes_write(const imp_value *values, size_t count, unsigned char *bytes);

/* The values in `bytes`, which must be aligned for double and outlive them. NULL: no memory. Free
 * the result with free(). */
imp_value *value_bytes_read(const unsigned char *bytes, size_t count);

#endif
