/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/arena.h"

#include <stdlib.h>

static size_t next_capacity(const arena_block *last, const arena_growth *growth, size_t bytes)
{
    size_t all = 0, capacity = growth->first;
    for (const arena_block *b = last; b != NULL; b = b->next) all += b->capacity;
    if (last != NULL) {
        const size_t units = (all * growth->percent / 100 + growth->unit - 1) / growth->unit;
        capacity = (units > 0 ? units : 1) * growth->unit;
    }
    if (capacity > growth->most) capacity = growth->most;
    return capacity < bytes ? bytes : capacity;
}

void *arena_take(arena *a, const arena_growth *growth, size_t bytes, size_t *made,
                 arena_store *store)
{
    void *room = arena_next(a, bytes);
    if (room != NULL) return room;
    arena_block *const last = atomic_load_explicit(&a->newest, memory_order_relaxed);
    const size_t capacity = next_capacity(last, growth, bytes);
    arena_block *fresh = arena_store_take(store, capacity);
    if (fresh == NULL) fresh = malloc(sizeof *fresh + capacity);
    if (fresh == NULL) return NULL;
    fresh->next = last;
    fresh->capacity = capacity;
    atomic_init(&fresh->used, bytes);
    atomic_store_explicit(&a->newest, fresh, memory_order_release);
    *made += sizeof *fresh + capacity;
    return fresh->memory;
}

size_t arena_bytes(const arena *a)
{
    size_t all = 0;
    for (const arena_block *b = atomic_load_explicit(&a->newest, memory_order_relaxed); b != NULL;
         b = b->next)
        all += sizeof *b + b->capacity;
    return all;
}

void arena_clear(arena *a, arena_store *store)
{
    arena_block *block = atomic_load_explicit(&a->newest, memory_order_relaxed);
    while (block != NULL) {
        arena_block *next = block->next;
        arena_store_give(store, block);
        block = next;
    }
    atomic_store_explicit(&a->newest, NULL, memory_order_relaxed);
}
