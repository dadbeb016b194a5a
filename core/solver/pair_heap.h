/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_HEAP_H
#define CORE_SOLVER_PAIR_HEAP_H

#include "core/bounds/time_window.h"

/* Pairs of nodes that may still touch, the most urgent first
 * ==========================================================
 * Ordered by two keys, then serial number: a total order, so the same input always pops in the same
 * order. What the keys are is the search's: for the time of impact the start of the window (paper,
 * eq. 5) and the squared distance of the centres at that time. */

typedef struct pair {
    time_window window; /* when they may be near; within both nodes' times */
    double key[2];      /* the least comes first; no NaN */
    double moment;      /* of the window, that decides: where the distance may be least */
    uint64_t serial;    /* order of making */
    vec3 axis;          /* that parted the nodes best at the window's start or moment; 0: none */
    node *a, *b;
    uint32_t candidate_pair; /* which two surfaces of the scene: index of the query's list */
    uint32_t wait;           /* generations until a witness is sought again */
    bool is_seen_only;       /* separation_first_look may have left too much */
    bool lacks_nets;         /* its nodes were not asked for nets yet */
    bool slides; /* of it or an ancestor one node alone was worth halving (distance.h) */
} pair;

/* What decides a pair's place on the heap, and where the pair itself is, which never moves. */
typedef struct pair_place {
    double key[2];
    uint64_t serial;
    size_t slot;
} pair_place;

typedef struct pair_heap {
    pair *slots;        /* a block of memory, whose second part are */
    pair_place *places; /* in the order of a heap; from `count` on, the slots that are free */
    size_t count, capacity;
} pair_heap; /* begins as {0}; pair_heap_clear frees */

enum { PAIR_HEAP_BYTES = sizeof(pair_place) + sizeof(pair) }; /* for each of its capacity */

/* Room for `more` pushes; false: no memory, the heap is as it was. */
bool pair_heap_reserve(pair_heap *heap, size_t more);

/* Pushes a copy of the pair. Precondition: there is room. */
void pair_heap_push(pair_heap *heap, const pair *p);

/* Returns a pair: the first for index 0, the others in no particular order. Precondition: index <
 * count. */
const pair *pair_heap_at(const pair_heap *heap, size_t index);

/* Return the first pair; pop also removes it. Precondition: count > 0. */
const pair *pair_heap_top(const pair_heap *heap);
pair pair_heap_pop(pair_heap *heap);

void pair_heap_clear(pair_heap *heap);

#endif
