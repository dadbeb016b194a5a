/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURVEY_BOX_QUEUE_H
#define CORE_SURVEY_BOX_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Boxes of values that wait, the one of least key first; of equal keys, the one that came last:
 * where bodies touch for a whole range of values at one time, all of its boxes keep that key, and
 * the search is to reach a contact in one of them before it halves the others. */

typedef struct survey_box {
    double key;      /* proved so far: a time before which nothing is near, or a distance */
    uint64_t number; /* in the order of their making */
    size_t pair;     /* of bodies */
    double share;    /* of the whole box of values */
    double near; /* distance known at the middle of the box that it is a half of; INFINITY: none */
    uint64_t limit; /* pairs of its query with room, at most */
    uint64_t cost;  /* pairs that this took */
    double range[]; /* lo, hi of each parameter */
} survey_box;

typedef struct box_queue {
    survey_box **at;
    size_t count, capacity;
} box_queue;

bool box_queue_push(box_queue *queue, survey_box *box); /* takes it over; false: no memory */
survey_box *box_queue_pop(box_queue *queue);            /* NULL: none; the caller frees it */
const survey_box *box_queue_first(const box_queue *queue);
void box_queue_clear(box_queue *queue);

#endif
