/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_heap.h"

#include <assert.h>
#include <stdlib.h>

static bool pair_before(const pair *p, const pair *q)
{
    for (int k = 0; k < 2; ++k)
        if (p->key[k] != q->key[k]) return p->key[k] < q->key[k];
    return p->serial < q->serial;
}

bool pair_heap_reserve(pair_heap *heap, size_t more)
{
    if (more <= heap->capacity - heap->count) return true;
    const size_t capacity = 2 * (heap->count + more) + 64;
    pair *pairs = realloc(heap->pairs, capacity * sizeof *pairs);
    if (pairs == NULL) return false;
    heap->pairs = pairs;
    heap->capacity = capacity;
    return true;
}

void pair_heap_push(pair_heap *heap, const pair *p)
{
    assert(heap->count < heap->capacity);
    size_t hole = heap->count++;
    while (hole > 0) {
        const size_t parent = (hole - 1) / 2;
        if (!pair_before(p, &heap->pairs[parent])) break;
        heap->pairs[hole] = heap->pairs[parent];
        hole = parent;
    }
    heap->pairs[hole] = *p;
}

const pair *pair_heap_top(const pair_heap *heap)
{
    assert(heap->count > 0);
    return &heap->pairs[0];
}

pair pair_heap_pop(pair_heap *heap)
{
    assert(heap->count > 0);
    const pair top = heap->pairs[0], last = heap->pairs[--heap->count];
    size_t hole = 0;
    for (;;) {
        size_t child = 2 * hole + 1;
        if (child >= heap->count) break;
        if (child + 1 < heap->count && pair_before(&heap->pairs[child + 1], &heap->pairs[child]))
            ++child;
        if (!pair_before(&heap->pairs[child], &last)) break;
        heap->pairs[hole] = heap->pairs[child];
        hole = child;
    }
    heap->pairs[hole] = last;
    return top;
}

void pair_heap_clear(pair_heap *heap)
{
    free(heap->pairs);
    *heap = (pair_heap){0};
}
