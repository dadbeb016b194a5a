/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/arena_store.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "core/base/arena.h"

/* Blocks that are kept: one scene of a few bodies has fewer sorts of nets, nodes, shapes and spans,
 * at several capacities. */
enum { SLOTS = 64 };

struct arena_store {
    atomic_flag in_use;
    size_t bytes;           /* of all that it keeps */
    size_t oldest;          /* slot that is emptied next, and filled then */
    size_t capacity[SLOTS]; /* 0: the slot is empty */
    arena_block *block[SLOTS];
};

/* The sanitizers' view of memory that is kept: nobody may touch it. */
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
static void forbid(arena_block *b) { __asan_poison_memory_region(b->memory, b->capacity); }
static void permit(arena_block *b) { __asan_unpoison_memory_region(b->memory, b->capacity); }
#else
static void forbid(arena_block *b) { (void)b; }
static void permit(arena_block *b) { (void)b; }
#endif

arena_store *arena_store_new(void)
{
    arena_store *store = calloc(1, sizeof *store);
    if (store != NULL) atomic_flag_clear(&store->in_use);
    return store;
}

static arena_block *empty_slot(arena_store *store, size_t slot)
{
    arena_block *block = store->block[slot];
    if (store->capacity[slot] == 0) return NULL;
    store->bytes -= store->capacity[slot];
    store->capacity[slot] = 0;
    permit(block);
    return block;
}

void arena_store_free(arena_store *store)
{
    if (store == NULL) return;
    for (size_t k = 0; k < SLOTS; ++k) free(empty_slot(store, k));
    free(store);
}

/* False: another thread uses it, or one did when this process was forked. */
static bool enter(arena_store *store)
{
    return store != NULL &&
           !atomic_flag_test_and_set_explicit(&store->in_use, memory_order_acquire);
}

static void leave(arena_store *store)
{
    atomic_flag_clear_explicit(&store->in_use, memory_order_release);
}

arena_block *arena_store_take(arena_store *store, size_t capacity)
{
    arena_block *found = NULL;
    if (!enter(store)) return NULL;
    for (size_t k = 0; k < SLOTS && found == NULL; ++k)
        if (store->capacity[k] == capacity) found = empty_slot(store, k);
    leave(store);
    return found;
}

void arena_store_give(arena_store *store, arena_block *block)
{
    if (block->capacity > ARENA_STORE_MOST || !enter(store)) {
        free(block);
        return;
    }
    size_t slot;
    do {
        slot = store->oldest;
        store->oldest = (slot + 1) % SLOTS;
        free(empty_slot(store, slot));
    } while (store->bytes + block->capacity > ARENA_STORE_MOST);
    store->block[slot] = block;
    store->capacity[slot] = block->capacity;
    store->bytes += block->capacity;
    forbid(block);
    leave(store);
}
