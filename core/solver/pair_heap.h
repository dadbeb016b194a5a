/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_HEAP_H
#define CORE_SOLVER_PAIR_HEAP_H

#include <assert.h>
#include <stddef.h>

#include "core/base/arena_store.h"
#include "core/bounds/time_window.h"

/* Pairs of nodes that may still touch, the most urgent first
 * ==========================================================
 * The heap is ordered by two keys, then by serial number: a total order, so the same input always
 * pops in the same order. Each search chooses its keys: the time of impact uses the start of the
 * window (paper, eq. 5) and the squared distance of the centres at that time. */

/* Whether a pair of surfaces that run around lines is searched along these (pair_tubes.h). */
typedef enum pair_tubes_state {
    TUBES_NONE,   /* no, and none of its halves */
    TUBES_WHOLE,  /* of whole surfaces, which were not looked at for this yet */
    TUBES_CLOSED, /* yes: its nodes are tubes, of which only u and t are cut */
    TUBES_OPEN    /* not any more: v is cut, too */
} pair_tubes_state;

typedef struct pair {
    double key[2];      /* the least comes first; no NaN */
    uint64_t serial;    /* order of making */
    time_window window; /* when they may be near; within both nodes' times */
    double moment; /* of the window, at which the distance may be least; axes are chosen for it */
    vec3 axis;     /* best separating axis at the window's start or moment; 0: none */
    node *a, *b;
    uint32_t candidate_pair; /* index in the query's list of candidate pairs */
    uint32_t wait;           /* generations until a witness is sought again */
    uint32_t divided;        /* upper_time's count when its paraboloid was tried; 0: never */
    bool is_seen_only;       /* only separation_first_look has tested it */
    bool lacks_nets;         /* nets of its nodes were not requested yet */
    bool slides;    /* a distance chose one node, of it or an ancestor, to be split alone */
    uint8_t step;   /* proof_step by which it was made of `proof`, a record (pair_note.h) */
    uint32_t proof; /* where a proof is kept */
    uint8_t tubes;  /* pair_tubes_state */
} pair;

/* What is kept of a waiting pair beside its keys and serial number. */
enum { PAIR_REST = offsetof(pair, window) };
typedef struct pair_rest {
    double bytes[(sizeof(pair) - PAIR_REST) / sizeof(double)];
} pair_rest;

/* The keys of a pair, and the index of its rest, which never moves. */
typedef struct pair_place {
    double key[2];
    uint64_t serial;
    size_t slot;
} pair_place;

typedef struct pair_heap {
    arena_store *store; /* of that memory; NULL: the heap of the process */
    pair_rest *slots;   /* one block of memory that also holds `places` */
    pair_place *places; /* the heap; from `count` on, the free slots */
    size_t count, capacity;
} pair_heap; /* begins as {0} or with its store; pair_heap_clear frees */

/* Bytes for each pair of its capacity. */
enum { PAIR_HEAP_BYTES = sizeof(pair_place) + sizeof(pair_rest) };

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
pair pair_heap_at(const pair_heap *heap, size_t index);

/* Returns the first key of the first pair. Precondition: count > 0. */
static inline double pair_heap_first(const pair_heap *heap)
{
    assert(heap->count > 0);
    return heap->places[0].key[0];
}

/* Returns the first pair and removes it. Precondition: count > 0. */
pair pair_heap_pop(pair_heap *heap);

void pair_heap_clear(pair_heap *heap);

#endif
