/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_BROAD_PHASE_H
#define CORE_BROAD_PHASE_BROAD_PHASE_H

#include <stdbool.h>
#include <stddef.h>

/* Which boxes are near each other? Sweep and prune along the axis on which the boxes crowd least:
 * every pair of the boxes of different groups whose gap along every axis is at most gamma_clear
 * is visited. A box with an infinity or a NaN is near all. */

typedef struct swept_box {
    double lo[3], hi[3]; /* over the whole query's times; length, world space */
    size_t owner;        /* caller's number, handed to the visitor */
    size_t group;        /* pairs within one group are not visited */
    size_t beyond;       /* once sorted: the next box of another group; the caller leaves it 0 */
} swept_box;

typedef struct broad_phase_visitor {
    /* Called before the pairs of each box, unless there are few boxes: whether to go on. */
    bool (*next_box)(void *context);
    bool (*visit)(void *context, size_t first, size_t second); /* whether to go on */
    void *context;
} broad_phase_visitor;

/* Visits the pairs in the order of the sweep, or in any order if there are few boxes. False from a
 * callback stops the visit and is returned. Sorts `boxes`. */
bool broad_phase_visit(swept_box *boxes, size_t count, double gamma_clear,
                       const broad_phase_visitor *visitor);

/* Do what broad_phase_visit does in two steps, of which several threads may take the second. The
 * first sorts the boxes along the axis that it answers; */
int broad_phase_sort(swept_box *boxes, size_t count);

/* the second visits the pairs of box k with those behind it. */
bool broad_phase_visit_box(const swept_box *boxes, size_t count, int axis, size_t k,
                           double gamma_clear, const broad_phase_visitor *visitor);

#endif
