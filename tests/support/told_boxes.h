/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_TOLD_BOXES_H
#define TESTS_SUPPORT_TOLD_BOXES_H

#include "tests/support/survey_helpers.h"

/* A sink of a survey that keeps a random sample of the proved boxes, in which each box has the same
 * chance. */

enum { VALUES_MAX = 8, TOLD_MAX = 64 };

/* A box of values and times. */
typedef struct region_box {
    double lo[VALUES_MAX], hi[VALUES_MAX], time[2];
} region_box;

typedef struct told_box {
    region_box in;
    double lower;
    size_t body[2];
} told_box;

typedef struct told_boxes {
    uint64_t *random;
    size_t most; /* boxes that are kept, up to TOLD_MAX */
    size_t count, seen;
    told_box at[TOLD_MAX];
} told_boxes;

/* Reservoir sampling: the n-th box replaces one of those kept with a chance of most / n. */
static inline void keep_box(void *context, const imp_survey_box *box)
{
    told_boxes *all = context;
    if (box->verdict != IMP_VERDICT_CLEAR) return;
    const size_t seen = all->seen++;
    const size_t k =
        seen < all->most ? seen : (size_t)(random_fraction(all->random) * (double)(seen + 1));
    if (k >= all->most) return;
    told_box *to = &all->at[k];
    if (k == all->count) all->count += 1;
    ck_assert_uint_le(box->count, VALUES_MAX);
    memcpy(to->in.lo, box->lo, box->count * sizeof *box->lo);
    memcpy(to->in.hi, box->hi, box->count * sizeof *box->hi);
    memcpy(to->body, box->body, sizeof to->body);
    to->in.time[0] = box->t_start, to->in.time[1] = box->t_end;
    to->lower = box->lower;
}

#endif
