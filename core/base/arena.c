/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/arena.h"

#include <stdlib.h>

static size_t next_capacity(const arena_block *last, const arena_growth *growth, size_t bytes)
{
    const size_t wanted = last == NULL ? growth->first : growth->factor * last->capacity;
    const size_t capacity = wanted < growth->most ? wanted : growth->most;
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
