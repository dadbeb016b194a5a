/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PAIR_HEAP_H
#define CORE_PAIR_HEAP_H

#include "node.h"
#include "separation.h"

/* Pairs of nodes that may still touch, earliest first
 * ===================================================
 * Ordered by start of window (paper, eq. 5), then squared distance of centres at that time,
 * then serial number: a total order, so the same input always pops in the same order. */

typedef struct pair {
    time_window window; /* when they may be near; within both nodes' times */
    double distance2;   /* of the centres at window.lo; length^2 */
    uint64_t serial;    /* order of making */
    vec3 axis;          /* that parted the nodes best; 0: none yet */
    node *a, *b;
    uint32_t couple; /* which two surfaces of the scene: index of the query's list */
    uint32_t wait;   /* generations until a witness is sought again */
} pair;

typedef struct pair_heap {
    pair *pairs;
    size_t count, capacity;
} pair_heap; /* begins as {0}; pair_heap_clear frees */

/* Room for `more` pushes; false: no memory, the heap is as it was. */
bool pair_heap_reserve(pair_heap *heap, size_t more);

/* Precondition: there is room. */
void pair_heap_push(pair_heap *heap, const pair *p);

/* The earliest; precondition: count > 0. */
const pair *pair_heap_top(const pair_heap *heap);
pair pair_heap_pop(pair_heap *heap);

void pair_heap_clear(pair_heap *heap);

#endif
