/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ARENA_STORE_H
#define CORE_BASE_ARENA_STORE_H

#include <stddef.h>

/* Blocks of cleared arenas, kept for the next
 * ===========================================
 * Freed memory at the heap's end goes back to the kernel, which clears each page of it anew: more
 * than a quarter of the time of a small query. A store keeps as much as a few small scenes use, and
 * frees the oldest blocks beyond that. Several threads may use it at once; none waits for another,
 * nor does a process that was forked while one used it: who finds it in use does without. */

typedef struct arena_store arena_store;

#define ARENA_STORE_MOST ((size_t)1 << 20) /* bytes that it keeps */

arena_store *arena_store_new(void); /* NULL: no memory */
void arena_store_free(arena_store *store);

struct arena_block;

/* Returns a block of exactly this capacity, or NULL. `store` may be NULL. */
struct arena_block *arena_store_take(arena_store *store, size_t capacity);

/* Takes over a block made by malloc: kept or freed. `store` may be NULL. */
void arena_store_give(arena_store *store, struct arena_block *block);

#endif
