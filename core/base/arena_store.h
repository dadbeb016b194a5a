/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ARENA_STORE_H
#define CORE_BASE_ARENA_STORE_H

#include <stddef.h>

/* Blocks of cleared arenas, kept for the next
 * ===========================================
 * Freed memory at the heap's end goes back to the kernel, which clears each page of it anew: more
 * than a quarter of the time of a small query. A store keeps as much as a few small scenes use, and
 * frees other blocks beyond that. Several threads may use it at once; none waits for another,
 * nor does a process that was forked while one used it: who finds it in use does without. */

typedef struct arena_store arena_store;

#define ARENA_STORE_MOST ((size_t)1 << 20) /* bytes that it keeps */

arena_store *arena_store_new(void); /* NULL: no memory */
void arena_store_free(arena_store *store);

/* Counts the blocks that it keeps. Nobody may use it meanwhile. */
size_t arena_store_count(const arena_store *store);

struct arena_block;

/* Returns a block of exactly this capacity, or NULL. `store` may be NULL. */
struct arena_block *arena_store_take(arena_store *store, size_t capacity);

/* Takes over a block made by malloc: kept or freed. `store` may be NULL. */
void arena_store_give(arena_store *store, struct arena_block *block);

/* --- Rooms ------------------------------------------------------------------------------------
 *
 * Blocks of a store in the place of malloc and free, for what is made and freed with each query or
 * change of a scene: in the steady state of a loop none of it comes from the heap. A room is given
 * back to the store that it was taken from. `store` may be NULL: then it is of the heap. */

/* Returns a room for `bytes` with the alignment of a double. NULL: no memory. */
void *arena_store_room(arena_store *store, size_t bytes);
void *arena_store_zeroed(arena_store *store, size_t bytes);

/* Gives a room back; NULL: there is none. */
void arena_store_free_room(arena_store *store, void *room);

/* Makes a room larger; `used` bytes of it stay. NULL: no memory, and it is as it was. */
void *arena_store_regrow(arena_store *store, void *room, size_t used, size_t bytes);

/* Like array_reserve, for arrays that are rooms: makes room for item number `count` (from 0) of
 * `size` bytes. NULL: no memory, and the array is as it was. */
void *arena_store_reserve(arena_store *store, void *array, size_t count, size_t *capacity,
                          size_t size);

#endif
