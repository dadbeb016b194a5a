/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_BROAD_PHASE_H
#define CORE_BROAD_PHASE_BROAD_PHASE_H

#include <stdbool.h>
#include <stddef.h>

/* Sweep and prune along the axis on which the boxes overlap least: visits every pair of boxes of
 * different groups whose gap along every axis is at most gamma_clear. A box with an infinity or a
 * NaN is near all. */

typedef struct swept_box {
    double lo[3], hi[3]; /* over the whole query's times; length, world space */
    size_t owner;        /* the caller's number, passed to the visitor */
    size_t group;        /* pairs within one group are not visited */
    size_t beyond;       /* once sorted: the next box of another group; the caller leaves it 0 */
} swept_box;

typedef struct broad_phase_visitor {
    /* Called by broad_phase_least_distance before the pairs of each box. Returns whether to
     * continue. */
    bool (*next_box)(void *context);
    bool (*visit)(void *context, size_t first, size_t second); /* returns whether to continue */
    void *context;
} broad_phase_visitor;

/* Whether two boxes, each of lo and hi, are proved to be farther apart than gamma_clear along an
 * axis. A NaN never proves it. */
bool broad_phase_apart(const double lo[3], const double hi[3], const double other_lo[3],
                       const double other_hi[3], double gamma_clear);

enum { BROAD_PHASE_FEW = 6 }; /* up to so many boxes are not worth sorting */

/* Visits the pairs without a sweep, each box with each after it. False from the visitor stops this
 * and is returned, here and below. */
bool broad_phase_visit_all(const swept_box *boxes, size_t count, double gamma_clear,
                           const broad_phase_visitor *visitor);

/* The sweep has two steps, the second of which may run in several threads. The first sorts the
 * boxes along an axis, which it returns. */
int broad_phase_sort(swept_box *boxes, size_t count);

/* The second, for each box in their order, visits the pairs of box k with the boxes after it. */
bool broad_phase_visit_box(const swept_box *boxes, size_t count, int axis, size_t k,
                           double gamma_clear, const broad_phase_visitor *visitor);

/* Visits two of the sorted boxes, if they are of different groups and near each other; `later`
 * comes after `box`. *is_beyond: so far after it along the axis that no later box is near it. */
bool broad_phase_visit_two(const swept_box *box, const swept_box *later, int axis,
                           double gamma_clear, bool *is_beyond, const broad_phase_visitor *visitor);

/* Returns an upper bound of the least distance of two points in two boxes of different groups that
 * `visit` accepts. INFINITY: there are none, or `next_box` ended it. The boxes are sorted along
 * `axis`. */
double broad_phase_least_distance(const swept_box *boxes, size_t count, int axis,
                                  const broad_phase_visitor *visitor);

#endif
