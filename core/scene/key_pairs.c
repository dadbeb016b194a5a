/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/key_pairs.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

static key_pair ordered(size_t x, size_t y) { return (key_pair){{x < y ? x : y, x < y ? y : x}}; }

/* Binary search for where the pair stands, or would stand. */
static size_t find(const key_pairs *pairs, key_pair wanted)
{
    size_t lo = 0, hi = pairs->count;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2, *there = pairs->at[middle].key;
        if (there[0] < wanted.key[0] || (there[0] == wanted.key[0] && there[1] < wanted.key[1]))
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

static bool stands_at(const key_pairs *pairs, size_t at, key_pair wanted)
{
    return at < pairs->count && memcmp(&pairs->at[at], &wanted, sizeof wanted) == 0;
}

bool key_pairs_have(const key_pairs *pairs, size_t x, size_t y)
{
    const key_pair wanted = ordered(x, y);
    return stands_at(pairs, find(pairs, wanted), wanted);
}

bool key_pairs_add(key_pairs *pairs, size_t x, size_t y)
{
    const key_pair added = ordered(x, y);
    const size_t at = find(pairs, added);
    if (stands_at(pairs, at, added)) return true;
    key_pair *grown = array_reserve(pairs->at, pairs->count, &pairs->capacity, sizeof *grown);
    if (grown == NULL) return false;
    memmove(grown + at + 1, grown + at, (pairs->count - at) * sizeof *grown);
    grown[at] = added;
    pairs->at = grown;
    pairs->count += 1;
    return true;
}

void key_pairs_clear(key_pairs *pairs)
{
    free(pairs->at);
    *pairs = (key_pairs){.count = 0};
}
