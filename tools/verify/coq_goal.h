/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_COQ_GOAL_H
#define TOOLS_VERIFY_COQ_GOAL_H

#include <stdio.h>

#include "tools/verify/enclose.h"

/* A leaf as a theorem of Coq */

/* Boxes of a leaf that was drawn, one of either side of those that the prover enclosed: over them
 * n.A - s (t - mid) <= upper, and n.B - s (t - mid) >= lower, where lower - upper >= |n| apart. */
typedef struct goal {
    uint64_t leaf;
    place of[2];
    values when; /* that both places are of, once they are written */
    box3 where[2];
    double t[2]; /* that both have */
    double n[3], slope, mid, upper, lower, apart;
} goal;

/* Writes what stands before all theorems. */
void coq_put_head(FILE *to);

/* Writes a theorem, and the lemmas that bound either side. */
void coq_put_goal(FILE *to, goal *g);

#endif
