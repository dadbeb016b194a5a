/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef IMPINGE_CORE_SOLID_CELL_HASH_H
#define IMPINGE_CORE_SOLID_CELL_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Returns the hash of a cell of space, which three numbers name. Equal numbers must have equal
 * bits: 0 is never -0. */
static inline size_t cell_hash(const double key[3])
{
    uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) {
        uint64_t bits;
        memcpy(&bits, &key[i], sizeof bits);
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 29;
    }
    return (size_t)hash;
}

#endif
