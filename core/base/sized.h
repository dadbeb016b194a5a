/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_SIZED_H
#define CORE_BASE_SIZED_H

#include <assert.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "core/base/status.h"

/* Structs of the program's that grow at the end
 * =============================================
 * Such a struct begins with a uint32_t, its size as the program was compiled. The library's own
 * may be longer (then the program is older) or shorter (then it is newer). `first` is the size of
 * the first release, below which no program can be. */

enum { SIZED_MAX = 4096 }; /* bytes; a greater size was never set */

static inline uint32_t sized_size(const void *sized)
{
    uint32_t size;
    memcpy(&size, sized, sizeof size);
    return size;
}

static inline imp_code sized_check(const char *name, const void *sized, size_t first,
                                   imp_error *error)
{
    if (sized == NULL) return error_set(error, IMP_ERROR_USAGE, "%s: got NULL", name);
    const uint32_t size = sized_size(sized);
    if (size >= first && size <= SIZED_MAX) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE,
                     "%s.struct_size: got %lu, must be from %zu to %d: set it to sizeof(%s)", name,
                     (unsigned long)size, first, SIZED_MAX, name);
}

/* Copies the program's struct over the library's own, which keeps its size and the values of fields
 * that the program does not know. Fields that only a newer library would understand are refused. */
static inline imp_code sized_read(const char *name, void *own, const void *given, size_t first,
                                  imp_error *error)
{
    const uint32_t known = sized_size(own);
    const imp_code code = sized_check(name, given, first, error);
    if (code != IMP_SUCCESS) return code;
    const uint32_t size = sized_size(given), both = size < known ? size : known;
    const unsigned char *bytes = given;
    for (uint32_t i = known; i < size; ++i)
        if (bytes[i] != 0)
            return error_set(error, IMP_ERROR_USAGE,
                             "%s: byte %lu is not 0, and this library knows only the first %lu: it "
                             "is older than the header the program was compiled with",
                             name, (unsigned long)i, (unsigned long)known);
    memcpy((unsigned char *)own + sizeof known, bytes + sizeof known, both - sizeof known);
    return IMP_SUCCESS;
}

/* Copies the library's struct to the program's, as far as that reaches; the rest of the program's
 * becomes 0. */
static inline void sized_write(void *to, const void *own)
{
    const uint32_t size = sized_size(to), known = sized_size(own);
    const uint32_t both = size < known ? size : known;
    assert(both >= sizeof size);
    memcpy((unsigned char *)to + sizeof size, (const unsigned char *)own + sizeof size,
           both - sizeof size);
    if (size > both) memset((unsigned char *)to + both, 0, size - both);
}

#endif
