/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_HEAP_H
#define CORE_SOLVER_PAIR_HEAP_H

#include <assert.h>

#include "core/base/arena_store.h"
#include "core/bounds/time_window.h"

/* Pairs of nodes that may still touch, the most urgent first
 * ==========================================================
 * The heap is ordered by two keys, then by serial number: a total order, so the same input always
 * pops in the same order. Each search chooses its keys: the time of impact uses the start of the
 * window (paper, eq. 5) and the squared distance of the centres at that time. */

typedef struct pair {
    time_window window; /* when they may be near; within both nodes' times */
    double key[2];      /* the least comes first; no NaN */
    double moment;   /* of the window, at which the distance may be least; axes are chosen for it */
    uint64_t serial; /* order of making */
    vec3 axis;       /* best separating axis at the window's start or moment; 0: none */
    node *a, *b;
    uint32_t candidate_pair; /* index in the query's list of candidate pairs */
    uint32_t wait;           /* generations until a witness is sought again */
    uint32_t divided;        /* upper_time's count when its paraboloid was tried; 0: never */
    bool is_seen_only;       /* only separation_first_look has tested it */
    bool lacks_nets;         /* nets of its nodes were not requested yet */
    bool slides;    /* a distance chose one node, of it or an ancestor, to be split alone */
    uint8_t step;   /* proof_step by which it was made of `proof`, a record (pair_note.h) */
    uint32_t proof; /* where a proof is kept */
} pair;

/* The keys of a pair, and the index of the pair itself, which never moves. */
typedef struct pair_place {
    double key[2];
    uint64_t serial;
    size_t slot;
} pair_place;

typedef struct pair_heap {
    arena_store *store; /* of that memory; NULL: the heap of the process */
    pair *slots;        /* one block of memory that also holds `places` */
    pair_place *places; /* the heap; from `count` on, the free slots */
    size_t count, capacity;
} pair_heap; /* begins as {0} or with its store; pair_heap_clear frees */

enum { PAIR_HEAP_BYTES = sizeof(pair_place) + sizeof(pair) }; /* for each pair of its capacity */

/* Allocates memory for `more` pushes, which the heap has no room for. False: no memory; the heap is
 * unchanged. */
bool pair_heap_grow(pair_heap *heap, size_t more);

/* Sees to it that there is room for `more` pushes. False: no memory; the heap is unchanged. */
static inline bool pair_heap_reserve(pair_heap *heap, size_t more)
{
    return more <= heap->capacity - heap->count || pair_heap_grow(heap, more);
}

/* Pushes a copy of the pair. Precondition: pair_heap_reserve. */
void pair_heap_push(pair_heap *heap, const pair *p);

/* Returns a pair: the first for index 0, the others in no particular order. Precondition: index <
 * count. */
static inline const pair *pair_heap_at(const pair_heap *heap, size_t index)
{
    assert(index < heap->count);
    return &heap->slots[heap->places[index].slot];
}

/* Return the first pair; pop also removes it. Precondition: count > 0. */
static inline const pair *pair_heap_top(const pair_heap *heap) { return pair_heap_at(heap, 0); }
pair pair_heap_pop(pair_heap *heap);

void pair_heap_clear(pair_heap *heap);

#endif
