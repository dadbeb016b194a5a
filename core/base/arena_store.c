/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/arena_store.h"

#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/arena.h"

/* Lists of blocks that are kept, each of the capacities of one hash: a scene of a few bodies has
 * fewer capacities of nets, nodes, shapes, spans and rooms. */
enum { SLOTS = 64 };

struct arena_store {
    atomic_flag in_use;
    size_t bytes;              /* of all that it keeps */
    size_t next;               /* list that is shortened next */
    arena_block *block[SLOTS]; /* the last one given first */
};

static size_t slot_of(size_t capacity)
{
    return (size_t)(((uint64_t)capacity * UINT64_C(0x9E3779B97F4A7C15)) >> 58) % SLOTS;
}

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

/* Takes the block that *link points to out of its list. */
static arena_block *unlink_block(arena_store *store, arena_block **link)
{
    arena_block *block = *link;
    *link = block->next;
    store->bytes -= block->capacity;
    permit(block);
    return block;
}

void arena_store_free(arena_store *store)
{
    if (store == NULL) return;
    for (size_t k = 0; k < SLOTS; ++k)
        while (store->block[k] != NULL) free(unlink_block(store, &store->block[k]));
    free(store);
}

size_t arena_store_count(const arena_store *store)
{
    size_t count = 0;
    for (size_t k = 0; k < SLOTS; ++k)
        for (const arena_block *b = store->block[k]; b != NULL; b = b->next) ++count;
    return count;
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
    if (!enter(store)) return NULL;
    arena_block **link = &store->block[slot_of(capacity)];
    while (*link != NULL && (*link)->capacity != capacity) link = &(*link)->next;
    arena_block *found = *link != NULL ? unlink_block(store, link) : NULL;
    leave(store);
    return found;
}

/* Frees blocks, list after list, until another one has room. */
static void make_room(arena_store *store, size_t bytes)
{
    for (; store->bytes + bytes > ARENA_STORE_MOST; store->next = (store->next + 1) % SLOTS)
        if (store->block[store->next] != NULL)
            free(unlink_block(store, &store->block[store->next]));
}

void arena_store_give(arena_store *store, arena_block *block)
{
    if (block->capacity > ARENA_STORE_MOST || !enter(store)) {
        free(block);
        return;
    }
    make_room(store, block->capacity);
    arena_block **list = &store->block[slot_of(block->capacity)];
    block->next = *list;
    *list = block;
    store->bytes += block->capacity;
    forbid(block);
    leave(store);
}

/* --- Rooms ------------------------------------------------------------------------------------ */

/* Rooms are of multiples of this many bytes, so that those of nearly the same size are reused. */
enum { ROOM_STEP = 64 };

void *arena_store_room(arena_store *store, size_t bytes)
{
    if (bytes > SIZE_MAX / 2) return NULL;
    const size_t capacity = (bytes + ROOM_STEP - 1) / ROOM_STEP * ROOM_STEP;
    arena_block *block = arena_store_take(store, capacity);
    if (block == NULL) {
        block = malloc(sizeof *block + capacity);
        if (block == NULL) return NULL;
        block->capacity = capacity;
    }
    return block->memory;
}

void *arena_store_zeroed(arena_store *store, size_t bytes)
{
    void *room = arena_store_room(store, bytes);
    return room != NULL ? memset(room, 0, bytes) : NULL;
}

/* From this size on an array grows in place where the heap can do so. */
enum { LARGE = 1 << 16 };

static arena_block *block_of(void *room)
{
    return (void *)((char *)room - offsetof(arena_block, memory));
}

void arena_store_free_room(arena_store *store, void *room)
{
    if (room != NULL) arena_store_give(store, block_of(room));
}

void *arena_store_regrow(arena_store *store, void *room, size_t used, size_t bytes)
{
    if (room == NULL || bytes < LARGE) {
        void *grown = arena_store_room(store, bytes);
        if (grown == NULL || room == NULL) return grown;
        memcpy(grown, room, used);
        arena_store_free_room(store, room);
        return grown;
    }
    if (bytes > SIZE_MAX / 2) return NULL;
    arena_block *grown = realloc(block_of(room), sizeof *grown + bytes);
    if (grown == NULL) return NULL;
    grown->capacity = bytes;
    return grown->memory;
}

void *arena_store_reserve(arena_store *store, void *array, size_t count, size_t *capacity,
                          size_t size)
{
    if (array != NULL && count < *capacity) return array;
    if (count > SIZE_MAX / 4 / size) return NULL;
    const size_t wanted = count < 4 ? 4 : 2 * count;
    void *grown = arena_store_regrow(store, array, count * size, wanted * size);
    if (grown != NULL) *capacity = wanted;
    return grown;
}
