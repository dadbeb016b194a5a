/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_SIDES_H
#define TOOLS_VERIFY_SIDES_H

#include "tools/kernel/kernel.h"

/* Leaves whose sides are divided
 * ==============================
 * The kernel bounds n.A by the parts of A alone and n.B by those of B, so that parts cost their
 * sum, not their product. This looks for few parts that do for one axis. */

enum { SIDES_PARTS = 256 }; /* of both sides, with those that are divided */

typedef struct side_part {
    cell of;
    bound b;
    int half; /* the first of its halves; the other one follows. 0: it is whole */
    int side, along;
    double blur[CLAIM_CLOCKS]; /* what slopes by a clock leave open of n.x */
} side_part;

typedef struct sides {
    side_part parts[SIDES_PARTS]; /* number 0 and 1: the whole sides */
    int count;
    int clock;    /* whose values are to be divided, if the parts are not what is too wide; or -1 */
    size_t tests; /* enclosures of a part */
} sides;

/* Returns whether the kernel proves the leaf with this axis and the parts found. */
bool sides_find(sides *s, pair *p, const cell *c, const int16_t axis[3]);

/* Writes the tree of a side: an entry a byte; returns their number. */
size_t sides_write(const sides *s, int side, uint8_t entries[SIDES_PARTS]);

#endif
