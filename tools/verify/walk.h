/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_WALK_H
#define TOOLS_VERIFY_WALK_H

#include "tools/verify/apart.h"

/* The trees of a certificate, read and proved leaf by leaf */

/* Entries from 4 on (core/CERTIFICATE.md). */
enum { WALK_TIME = 4, WALK_AXIS, WALK_SAME, WALK_ALONE, WALK_CLOCK, WALK_SIDES };

/* Callbacks for the entries of a certificate's trees, in order. Trees of surfaces without formulas
 * are left out. */
typedef struct watch {
    void *context;
    void (*begun)(void *context);                                    /* a tree */
    void (*split)(void *context, const uint8_t *bytes, size_t size); /* an entry that divides */
    void (*leaf)(void *context, prover *p, const cell *c,
                 bool named);                                /* proved; axis of p, if named */
    void (*joined)(void *context, prover *p, const cell *c); /* both parts of a split ended */
    void (*ended)(void *context);                            /* a tree */
} watch;

typedef struct walk {
    input *in;
    const statement *says;
    unsigned long effort;             /* tests a leaf may take */
    unsigned share, shares;           /* this process proves every shares-th group of leaves */
    FILE *text;                       /* takes the tree, a line for each entry; NULL: none */
    void (*progress)(uint64_t bytes); /* called now and then; NULL: not */
    const watch *watch;               /* NULL: none */
    uint64_t leaves, pairs, tests;
    uint64_t stamps; /* given to values of clocks */
    bool *assumed;   /* by stage: it is needed, and the certificate has no formula for it */
} walk;

/* Reads all trees and the end of the file, and proves the leaves that are this process's share.
 * False: the input tells why. */
bool walk_trees(walk *w);

/* Proves that the two points of the claim are as near as it says. False: the input tells why. */
bool walk_points(walk *w);

#endif
