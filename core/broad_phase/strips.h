/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BROAD_PHASE_STRIPS_H
#define CORE_BROAD_PHASE_STRIPS_H

#include <stdint.h>

#include "core/base/arena_store.h"
#include "core/broad_phase/broad_phase.h"

/* Strips of a sweep
 * =================
 * A sweep along one axis compares each box with all that overlap it there: of n bodies spread in
 * space that is n^(5/3) pairs of boxes. Strips divide the other two axes, and a box is compared
 * within the few columns, each of one strip of either axis, that it lies in. A box in more than
 * STRIPS_OF_BOX strips of an axis is wide, and compared with all that overlap it along the first
 * axis. */

enum {
    STRIPS_OF_BOX = 4,
    STRIPS_BOXES_LEAST = 256 /* fewer boxes are swept without strips */
};

/* Where a box lies along either axis. */
typedef struct strips_of_box {
    uint16_t first[2]; /* strip, */
    uint8_t length[2]; /* and in how many it lies; 0: it is wide */
} strips_of_box;

typedef struct strips {
    size_t count[2]; /* of strips along either axis; 0: the sweep has none, because there are too
                        few boxes or all are wide */
    uint32_t *start; /* of each column's list in `box`, and the end of the last; columns of one
                        strip of the first of these axes are neighbours */
    uint32_t *box;   /* numbers of sorted boxes; each list ascends */
    uint32_t *wide;  /* numbers of the wide boxes, ascending */
    size_t wide_count;
    strips_of_box *of; /* for each sorted box */
    arena_store *store;
} strips; /* begins as {0} */

/* Makes strips for boxes that broad_phase_sort has sorted along `axis`, to be cleared in any case.
 * Their memory is of the store; NULL: of the heap. False: no memory. */
bool strips_make(strips *s, const swept_box *boxes, size_t count, int axis, double gamma_clear,
                 arena_store *store);
void strips_clear(strips *s);

/* Like broad_phase_visit_box, by the strips, which may have none. */
bool strips_visit_box(const strips *s, const swept_box *boxes, size_t count, int axis, size_t k,
                      double gamma_clear, const broad_phase_visitor *visitor);

#endif
