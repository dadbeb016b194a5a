/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_ARRAY_H
#define CORE_COMMON_ARRAY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* Arrays that grow at the end
 * ===========================
 * Makes room for item number `count` (from 0) of `size` bytes. Answers where the array is now, or
 * NULL when memory ran out, and then the old array is as it was.
 *
 *     thing *grown = array_reserve(list->thing, list->count, &list->capacity, sizeof *grown);
 *     if (!grown) return false;
 *     list->thing = grown;
 *     list->thing[list->count++] = one;                                                   */
static inline void *array_reserve(void *array, size_t count, size_t *capacity, size_t size)
{
    if (array != NULL && count < *capacity) return array;
    size_t wanted = count < 4 ? 4 : 2 * count;
    if (count > SIZE_MAX / 4 / size) return NULL;
    void *grown = realloc(array, wanted * size);
    if (grown != NULL) *capacity = wanted;
    return grown;
}

#endif
