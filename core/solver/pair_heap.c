/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_heap.h"

#include <assert.h>
#include <string.h>

static bool place_before(const pair_place *p, const pair_place *q)
{
    if (p->key[0] != q->key[0]) return p->key[0] < q->key[0];
    if (p->key[1] != q->key[1]) return p->key[1] < q->key[1];
    return p->serial < q->serial;
}

/* Most searches have few pairs waiting: their first block is one that malloc has ready. */
enum { CAPACITY_LEAST = 5 };

/* Beyond this many pairs room grows by an eighth, for which the heap of the process mostly moves
 * pages, not bytes; below it, room doubles. */
enum { CAPACITY_LARGE = 1 << 14 };

static size_t capacity_for(size_t count)
{
    return count < CAPACITY_LARGE ? 2 * count + CAPACITY_LEAST : count + count / 8;
}

bool pair_heap_grow(pair_heap *heap, size_t more)
{
    const size_t capacity = capacity_for(heap->count + more);
    const size_t used = heap->capacity * PAIR_HEAP_BYTES;
    pair_rest *slots =
        arena_store_regrow(heap->store, heap->slots, used, capacity * PAIR_HEAP_BYTES);
    if (slots == NULL) return false;
    pair_place *places = (pair_place *)(void *)(slots + capacity);
    memmove(places, slots + heap->capacity, heap->capacity * sizeof *places);
    heap->slots = slots;
    heap->places = places;
    for (size_t k = heap->capacity; k < capacity; ++k) places[k].slot = k;
    heap->capacity = capacity;
    return true;
}

void pair_heap_push(pair_heap *heap, const pair *p)
{
    assert(heap->count < heap->capacity);
    pair_place *places = heap->places;
    size_t hole = heap->count++;
    const pair_place place = {{p->key[0], p->key[1]}, p->serial, places[hole].slot};
    memcpy(&heap->slots[place.slot], (const char *)p + PAIR_REST, sizeof *heap->slots);
    while (hole > 0) {
        const size_t parent = (hole - 1) / 2;
        if (!place_before(&place, &places[parent])) break;
        places[hole] = places[parent];
        hole = parent;
    }
    places[hole] = place;
}

static inline void take_pair(const pair_heap *heap, const pair_place *place, pair *p)
{
    p->key[0] = place->key[0];
    p->key[1] = place->key[1];
    p->serial = place->serial;
    memcpy((char *)p + PAIR_REST, &heap->slots[place->slot], sizeof *heap->slots);
}

pair pair_heap_at(const pair_heap *heap, size_t index)
{
    pair p;
    assert(index < heap->count);
    take_pair(heap, &heap->places[index], &p);
    return p;
}

pair pair_heap_pop(pair_heap *heap)
{
    assert(heap->count > 0);
    pair first;
    pair_place *places = heap->places;
    take_pair(heap, &places[0], &first);
    const size_t count = --heap->count, free_slot = places[0].slot;
    const pair_place last = places[count];
    size_t hole = 0;
    for (;;) {
        size_t child = 2 * hole + 1;
        if (child >= count) break;
        if (child + 1 < count && place_before(&places[child + 1], &places[child])) ++child;
        if (!place_before(&places[child], &last)) break;
        places[hole] = places[child];
        hole = child;
    }
    places[hole] = last;
    places[count].slot = free_slot;
    return first;
}

void pair_heap_clear(pair_heap *heap)
{
    arena_store_free_room(heap->store, heap->slots);
    *heap = (pair_heap){.store = heap->store};
}
