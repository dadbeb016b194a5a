/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ARENA_H
#define CORE_BASE_ARENA_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

#include "core/base/arena_store.h"

/* Arenas: rooms of memory that are freed all together
 * ===================================================
 * Rooms are taken from the newest block by counting, without a lock; what goes beyond the block's
 * capacity is no room. A new block is made under a lock of the caller's. An arena begins zeroed. */

typedef struct arena_block {
    struct arena_block *next;
    _Atomic(size_t) used; /* bytes; more than the capacity where rooms were refused */
    size_t capacity;      /* bytes */
    double memory[];
} arena_block;

typedef struct arena {
    _Atomic(arena_block *) newest; /* NULL: there is none yet */
} arena;

/* Capacities of an arena's blocks: that of the first, what each next one adds to all so far, in
 * multiples of a unit, and the greatest. The more it adds, the fewer blocks there are, and the more
 * of the last one is left unused: by half, a fifth of an arena on average. */
typedef struct arena_growth {
    size_t first, unit, percent, most; /* bytes, bytes, 1, bytes */
} arena_growth;

/* Takes room of `bytes`, a multiple of 8, in the newest block. NULL: too little is left there.
 * Several threads may call it at once. */
static inline void *arena_next(arena *a, size_t bytes)
{
    arena_block *newest = atomic_load_explicit(&a->newest, memory_order_acquire);
    if (newest == NULL) return NULL;
    const size_t at = atomic_fetch_add_explicit(&newest->used, bytes, memory_order_relaxed);
    return at + bytes <= newest->capacity ? (char *)newest->memory + at : NULL;
}

/* Takes room of `bytes` in the newest block or in a new one, from the store or, if that is NULL or
 * has none, from the heap; the size of a new block is added to *made. NULL: no memory. Only one
 * thread at a time may call it; others may call arena_next meanwhile. */
void *arena_take(arena *a, const arena_growth *growth, size_t bytes, size_t *made,
                 arena_store *store);

/* Returns the bytes of all blocks. No other thread may take room meanwhile. */
size_t arena_bytes(const arena *a);

/* Gives all blocks to the store or, if that is NULL, frees them. */
void arena_clear(arena *a, arena_store *store);

#endif
