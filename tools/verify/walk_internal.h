/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_WALK_INTERNAL_H
#define TOOLS_VERIFY_WALK_INTERNAL_H

#include "tools/verify/walk.h"

/* What walk.c consists of: walk_tree.c has the tree of a pair and its leaves, walk_points.c the two
 * points of a claim, walk.c the pairs. */

typedef struct pair {
    walk *w;
    const chain *chain[2];
    prover prover;
    double *deviations; /* of maps that are left out from being rigid; NAN: not known */
    uint32_t *order[2];
    bool is_said;
    bool has_axis; /* of a leaf before in this tree */
    double axis[3];
} pair;

/* Reads the tree of a pair, whose root is c, and proves its leaves. False: the input tells why. */
bool walk_take_tree(pair *p, const cell *c);

/* Notes which stages of a surface have no formula. */
void walk_note_assumed(walk *w, const chain *c);

#endif
